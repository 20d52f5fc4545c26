"""Write the pages of the documentation that are made from the code.

``python packaging/reference.py`` writes them all; tests/test_docs.py compares them with what the code gives.
"""

import ast
import sys
from collections.abc import Callable, Iterator
from dataclasses import fields, is_dataclass
from importlib.metadata import EntryPoint
from pathlib import Path

from kiosk.cli.composition import DATA
from kiosk.cli.guide import commands_page
from kiosk.cli.main import recollect
from kiosk.config import Settings
from kiosk.experiment import booth_status
from kiosk.experiment.events import Event, SessionEvent, WorldEvent
from kiosk.export.codebook import codebook_markdown
from kiosk.export.records import StudyMaterials
from kiosk.export.tables import all_tables
from kiosk.extensions import ExtensionGroup, installed
from kiosk.study.loader import read_study
from kiosk.study.reference import as_page

ROOT = Path(__file__).resolve().parent.parent
DOCS = ROOT / "docs"
API = ("kiosk/game.py", "kiosk/assistance", "kiosk/training")
"""What the page on the Python API covers."""
CUT_OFF = "…"
"""Stands where a message has a value that only the machine knows."""
GENERATED_BY = "This page is written by `python packaging/reference.py`; change the code, not the page."


def events_page() -> str:
    """Return every kind of event with its fields and their types."""
    head = [
        "# Events",
        "",
        GENERATED_BY,
        "",
        "A session is its list of events: `recollect events SESSION --json` prints them. Every event has `at_ms`, the",
        "milliseconds since the session's first event. It is written before anything of it is shown.",
    ]
    parts = {
        "From outside": ("What the visitor, the experimenter, a device or the clock did.", WorldEvent),
        "What the session concluded": (
            "They follow from the events from outside, and replay gives them again.",
            SessionEvent,
        ),
    }
    for title, (about, base) in parts.items():
        head += ["", f"## {title}", "", about, "", "| event | what happened | fields |", "|---|---|---|"]
        head += [_event_row(kind) for kind in base.__subclasses__()]
    return "\n".join([*head, ""])


def _event_row(kind: type[Event]) -> str:
    """Return the row about a kind of event."""
    given = ", ".join(f"`{field.name}: {field.type}`" for field in fields(kind) if field.name != "at_ms")
    return _row(f"`{kind.__name__}`", _in_one_line(kind.__doc__ or ""), given)


def columns_page() -> str:
    """Return the codebook of the study that comes with the program."""
    tables = all_tables(StudyMaterials(read_study(Settings()).plans), frozenset())
    codebook = codebook_markdown(
        tables.shapes, {shape.name: f"task-concentration_description-{shape.name}_data.csv" for shape in tables.shapes}
    )
    about = (
        "These are the columns of the study that comes with Recollect. Your study's own questionnaires and options add"
        "\ncolumns; the codebook beside each data set has them all. [The data set](data-set.md) explains the tables."
    )
    columns = codebook.partition("\n## Kinds of events")[0].replace("# Codebook\n", "", 1).strip()
    return f"# Columns of an export\n\n{GENERATED_BY}\n\n{about}\n\n{columns}\n"


def status_page() -> str:
    """Return the keys of status.json."""
    name, closed, after_s = booth_status.FILE, booth_status.CLOSED, booth_status.STALE_S
    lines = [
        "# status.json",
        "",
        GENERATED_BY,
        "",
        f"A running kiosk writes `{name}` in its data folder at each change, and every",
        f"{booth_status.WRITE_EVERY_S} seconds. A file older than {after_s} seconds means that the kiosk hangs or",
        f"ended without saying so. When it is left, its stage is `{closed}`. The key `format` is",
        f"`{booth_status.FORMAT}`.",
        "The file never has a condition, a code or an answer. `recollect status` reads it.",
    ]
    parts = (booth_status.BoothStatus, booth_status.DayCounts, booth_status.EndedSession)
    for kind in (*parts, booth_status.PartStatus, booth_status.AlarmStatus):
        assert is_dataclass(kind)  # noqa: S101 - for the type checker
        lines += [
            "",
            f"## {kind.__name__}",
            "",
            _in_one_line(kind.__doc__ or ""),
            "",
            "| key | type |",
            "|---|---|",
        ]
        lines += [_row(f"`{field.name}`", f"`{field.type}`") for field in fields(kind)]
    return "\n".join([*lines, ""])


def extensions_page() -> str:
    """Return the groups of entry points, with what comes in each of them."""
    lines = [
        "# Extension points",
        "",
        GENERATED_BY,
        "",
        "A package adds to Recollect by an entry point in one of these groups.",
        "[Packages that add to Recollect](../how-to/extend.md#packages-that-add-to-recollect) shows them whole.",
        "`recollect check` lists what is installed, and says what is wrong with it.",
    ]
    for group in ExtensionGroup:
        lines += ["", f"## {group.value}", "", f"One entry adds one {group.noun}. These come with Recollect:", ""]
        lines += ["| name | what it is | where |", "|---|---|---|"]
        lines += [
            _row(f"`{each.name}`", _about_entry(each.entry), f"`{each.entry.value}`")
            for each in installed(group)
            if each.is_built_in
        ]
    return "\n".join([*lines, ""])


def _about_entry(entry: EntryPoint) -> str:
    """Return the first line about a class, or what an action's precision and target are."""
    found = ast.parse(ROOT.joinpath(*entry.module.split(".")).with_suffix(".py").read_text("utf-8"))
    docs = [
        ast.get_docstring(node) for node in found.body if isinstance(node, ast.ClassDef) and node.name == entry.attr
    ]
    return (docs[0] or "").partition("\n")[0] if docs else f"the action `{entry.attr}`"


def api_page() -> str:
    """Return what the game, the assistance and the training offer to other programs."""
    lines = [
        "# Python API",
        "",
        GENERATED_BY,
        "",
        "These modules have no window, clock, socket or database. Use them in a notebook or a simulation. The first",
        "paragraph of each docstring is shown here, and `help()` shows the rest, with shapes, units and errors. Until",
        "version 1.0 they may change with a new minor version ([versions](versions.md)).",
    ]
    files = [
        file
        for place in API
        for file in ([ROOT / place] if place.endswith(".py") else sorted(ROOT.glob(f"{place}/*.py")))
    ]
    for file in files:
        module = ast.parse(file.read_text("utf-8"))
        rows = [row for node in module.body for row in _api_rows(node)]
        if rows and file.name != "__init__.py":
            name = ".".join(file.relative_to(ROOT).with_suffix("").parts)
            lines += ["", f"## {name}", "", (ast.get_docstring(module) or "").partition("\n")[0], ""]
            lines += ["| name | what it does |", "|---|---|", *rows]
    return "\n".join([*lines, ""])


def _api_rows(node: ast.stmt, of: str = "") -> Iterator[str]:
    """Yield a row for a public class or function, then for its public methods."""
    if not isinstance(node, ast.ClassDef | ast.FunctionDef) or node.name.startswith("_"):
        return
    signature = "" if isinstance(node, ast.ClassDef) else f"({_parameters(node.args)})"
    yield _row(f"`{of}{node.name}{signature}`", _in_one_line((ast.get_docstring(node) or "").partition("\n\n")[0]))
    if isinstance(node, ast.ClassDef):
        for inside in node.body:
            yield from _api_rows(inside, f"{node.name}.")


def _parameters(arguments: ast.arguments) -> str:
    """Return the names that a caller gives, with ``*`` before those that must be named."""
    given = [each.arg for each in [*arguments.posonlyargs, *arguments.args] if each.arg not in {"self", "cls"}]
    if arguments.vararg:
        given.append(f"*{arguments.vararg.arg}")
    elif arguments.kwonlyargs:
        given.append("*")
    return ", ".join([*given, *(each.arg for each in arguments.kwonlyargs)])


def check_page() -> str:
    """Return every warning and failure of ``recollect check`` with its remedy, read from the calls that make them."""
    lines = [
        "# Messages of recollect check",
        "",
        GENERATED_BY,
        "",
        "`recollect check` prints a line for each thing that a booth needs. `OK` means that it works. `WARN` may stay,",
        f"and `FAIL` must be fixed before a session can be held. `{CUT_OFF}` stands for a value of your machine.",
        "[Troubleshooting](../how-to/troubleshooting.md) lists what you may see elsewhere.",
        "",
        "| | about | message | what to do |",
        "|---|---|---|---|",
    ]
    rows = {
        _row(*cells)
        for file in sorted((ROOT / "kiosk").rglob("*.py"))
        for cells in check_messages(file.read_text("utf-8"))
    }
    return "\n".join([*lines, *sorted(rows), ""])


def check_messages(source: str) -> Iterator[tuple[str, str, str, str]]:
    """Yield mark, subject, message and remedy of every ``CheckResult.warning`` and ``.error`` whose words are known."""
    if "CheckResult" not in source:
        return
    tree = ast.parse(source)
    shared = _assigned(tree.body)
    for function in ast.walk(tree):
        if not isinstance(function, ast.FunctionDef):
            continue
        known = shared | _assigned(list(ast.walk(function)))
        for call in ast.walk(function):
            match call:
                case ast.Call(
                    func=ast.Attribute(value=ast.Name(id="CheckResult"), attr="warning" | "error" as mark),
                    args=[subject, message, remedy],
                ):
                    words = [_in_words(each, known) for each in (subject, message, remedy)]
                    if any(character.isalpha() for character in words[1] + words[2]):
                        yield ("FAIL" if mark == "error" else "WARN", words[0], words[1], words[2])
                case _:
                    pass


def _assigned(nodes: list[ast.stmt] | list[ast.AST]) -> dict[str, ast.expr]:
    """Return what names are set to; a name that is set twice to different things is left out."""
    found: dict[str, list[ast.expr]] = {}
    for node in nodes:
        match node:
            case ast.Assign(targets=[ast.Name(id=name)], value=value):
                found.setdefault(name, []).append(value)
            case ast.Assign(targets=[ast.Tuple(elts=names)], value=ast.Tuple(elts=values)):
                for target, value in zip(names, values, strict=True):
                    if isinstance(target, ast.Name):
                        found.setdefault(target.id, []).append(value)
            case _:
                pass
    return {name: values[0] for name, values in found.items() if len(values) == 1}


def _in_words(node: ast.expr, known: dict[str, ast.expr]) -> str:
    """Return the text that an expression gives, with CUT_OFF for what is not known before the program runs."""
    match node:
        case ast.Constant(value=str() | int() | float() as text):
            return str(text)
        case ast.JoinedStr(values=parts):
            return "".join(_in_words(part, known) for part in parts)
        case ast.FormattedValue(value=ast.Name(id=name)) if name in known:
            return _in_words(known[name], known)
        case ast.Name(id=name) if name in known:
            return _in_words(known[name], {key: value for key, value in known.items() if key != name})
        case _:
            return CUT_OFF


def _row(*cells: str) -> str:
    """Return a row of a table."""
    inside = " | ".join(cell.replace("|", r"\|") for cell in cells)
    return f"| {inside} |"


def _in_one_line(text: str) -> str:
    """Return a docstring as it stands in a cell."""
    return " ".join(text.replace("``", "`").split())


GENERATED: dict[str, Callable[[], str]] = {
    "reference/commands.md": lambda: commands_page(recollect, DATA),
    "reference/study-file.md": lambda: as_page(Settings),
    "reference/events.md": events_page,
    "reference/columns.md": columns_page,
    "reference/status-json.md": status_page,
    "reference/extension-points.md": extensions_page,
    "reference/python-api.md": api_page,
    "reference/check-messages.md": check_page,
}
"""What gives each page that is generated, by its place in the documentation."""


def main() -> int:
    """Write every page that is not as the code gives it, and print which."""
    for name, page in GENERATED.items():
        text, file = page(), DOCS / name
        if not file.exists() or file.read_text("utf-8") != text:
            file.write_text(text, encoding="utf-8")
            print(f"{file} was written.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
