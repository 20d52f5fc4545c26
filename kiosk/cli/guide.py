"""The documentation from the command line: examples and a page for every command, and the built pages."""

from __future__ import annotations

import inspect
import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import click

from kiosk import UserInputError
from kiosk.cli.options import json_option
from kiosk.places import beside_or_inside

PAGES_ADDRESS = "docs/"
"""Where the pages are, in a checkout."""
KINDS = ("tutorials", "how-to", "reference", "explanation")
"""The folders of the pages, by kind."""


@dataclass(frozen=True, slots=True)
class Guide:
    """The page about a command, examples without the word ``recollect``, and why there is no ``--json``."""

    page: str
    examples: tuple[str, ...]
    why_no_json: str = ""


GUIDES = {
    "study new": Guide(
        "how-to/new-study.md", ("study new my-study", "study new fair-study --template fair --language it")
    ),
    "study check": Guide("reference/study-file.md", ("study check study.toml", "study check study.toml --pages")),
    "study preview": Guide("how-to/preview.md", ("study preview study.toml",), "It shows a window."),
    "study cards": Guide(
        "how-to/own-cards.md", ("study cards study.toml --sheet cards.png", "study cards study.toml --names")
    ),
    "study translations": Guide(
        "how-to/add-a-language.md",
        ("study translations study.toml", "study translations study.toml --language it --write italian.po"),
    ),
    "study wording draft": Guide(
        "how-to/wording.md",
        ('study wording draft study.toml --server http://127.0.0.1:8080/v1 --style "warm and short"',),
    ),
    "study wording review": Guide(
        "how-to/wording.md", ("study wording review study.toml", "study wording review study.toml --list")
    ),
    "study wording sign": Guide("how-to/wording.md", ('study wording sign study.toml --name "Ada Byron"',)),
    "study import": Guide(
        "how-to/import.md", ("study import items.csv --id trust --version 1 --out questionnaires/trust.toml",)
    ),
    "study dossier": Guide("how-to/dossier.md", ("study dossier study.toml --out study.pdf",)),
    "study diff": Guide("how-to/one-file.md", ("study diff pilot.toml study.toml",)),
    "study pack": Guide("how-to/one-file.md", ("study pack study.toml --out study.recollect",)),
    "study set-pin": Guide("how-to/experimenter.md", ("study set-pin",)),
    "study reference": Guide(
        "reference/study-file.md",
        ("study reference", "study reference --toml"),
        "It prints a page or, with --toml, a study file.",
    ),
    "plan new": Guide("how-to/plan.md", ("plan new plan.toml",)),
    "plan check": Guide("how-to/plan.md", ("plan check plan.toml",)),
    "plan power": Guide("how-to/plan.md", ("plan power plan.toml --n 40 --studies 200",)),
    "plan show": Guide("how-to/plan.md", ("plan show plan.toml",)),
    "plan freeze": Guide("how-to/plan.md", ("plan freeze plan.toml",)),
    "plan look": Guide("how-to/plan.md", ("plan look plan.toml",)),
    "plan simulate": Guide("how-to/plan.md", ("plan simulate plan.toml --out simulated --people people.json",)),
    "voice render": Guide("how-to/voice.md", ("voice render", "voice render --study study.toml --language it")),
    "voice script": Guide("how-to/voice.md", ("voice script --study study.toml --language it",)),
    "voice import": Guide("how-to/voice.md", ("voice import recordings --out voices/anna --speaker Anna",)),
    "voice missing": Guide("how-to/voice.md", ("voice missing voices/anna --study study.toml",)),
    "voice check": Guide("how-to/voice.md", ("voice check voices/anna",)),
    "voice play": Guide("how-to/voice.md", ('voice play "The lion is in the second row."',)),
    "run": Guide("how-to/booth.md", ("run --study study.toml", "run --supervise --study study.toml")),
    "open-day": Guide("how-to/booth.md", ("open-day --study study.toml", "open-day --study study.toml --to stick")),
    "check": Guide("how-to/booth.md", ("check --study study.toml", "check --say", "check --watch")),
    "rehearse": Guide(
        "how-to/booth.md",
        ("rehearse --headless --seed 1 --shots pictures", "rehearse --headless --sessions 200 --study study.toml"),
    ),
    "robot": Guide(
        "explanation/embodiments.md", ("robot --host 192.168.1.50", "robot --study study.toml", "robot --pretend")
    ),
    "status": Guide("how-to/booth.md", ("status", "status --json")),
    "sessions": Guide("reference/data-set.md", ("sessions", "sessions --since 2026-05-01 --status abandoned")),
    "watch": Guide(
        "how-to/remote.md",
        ("watch --broker mqtts://broker.lab.example", "watch --broker mqtts://broker.lab.example --web"),
    ),
    "events": Guide("reference/data-set.md", ("events 1", "events 1 --json")),
    "replay": Guide(
        "explanation/how-it-works.md",
        ("replay 1", "replay 1 --memory", "replay 1 --headless --frames pictures", "replay 12 --film session.webm"),
    ),
    "explain": Guide(
        "explanation/mentaliser.md", ("explain 1 --picture boards.svg", "explain 1 --flip 14", "explain case.json")
    ),
    "day": Guide("how-to/booth.md", ("day", "day --date 2026-05-09 --out saturday.html")),
    "backup": Guide("how-to/booth.md", ("backup", "backup --to stick")),
    "verify": Guide("how-to/booth.md", ("verify",)),
    "browse": Guide("how-to/booth.md", ("browse --open",), "It serves a page until Ctrl+C."),
    "withdraw": Guide("how-to/withdraw.md", ("withdraw 7KQ2M-XR4T4", "withdraw --session 12")),
    "merge": Guide("how-to/booth.md", ("merge booth-1 booth-2 --out both",)),
    "export": Guide(
        "reference/data-set.md", ("export --out data-set", "export --out data-set --bids --with-rehearsals")
    ),
    "report": Guide(
        "how-to/report.md", ("report data-set --out report", "report data-set --plan plan.toml --out report")
    ),
    "calibrate": Guide("how-to/calibrate.md", ("calibrate data-set",)),
    "train": Guide(
        "explanation/learning.md", ("train --out table.json", "train --reward paper --episodes 5000 --out paper.json")
    ),
    "simulate": Guide(
        "explanation/learning.md", ("simulate --games 500", "simulate --policy table.json --condition tom")
    ),
    "policy show": Guide(
        "explanation/learning.md", ("policy show default", "policy show table.json --figure table.svg")
    ),
    "policy compare": Guide("explanation/learning.md", ("policy compare default table.json",)),
    "policy card": Guide("explanation/learning.md", ("policy card table.json",)),
    "policy evidence": Guide("explanation/learning.md", ("policy evidence --games 200",)),
    "docs": Guide("README.md", ("docs", "docs check", "docs study-file")),
}
"""The guide of every command that does something, by its name with that of its group."""


def add_guide(name: str, command: click.Command) -> None:
    """Put examples and page below the help of a command, or of each command in a group."""
    if isinstance(command, click.Group):
        for below, subcommand in command.commands.items():
            add_guide(f"{name} {below}", subcommand)
    elif name in GUIDES:
        command.epilog = as_epilog(GUIDES[name])


def as_epilog(guide: Guide) -> str:
    """Return the end of a help text."""
    return "\n".join(["\b", *_lines(guide)])  # \b keeps click from wrapping the lines


def _lines(guide: Guide) -> Iterator[str]:
    yield "Examples:" if len(guide.examples) > 1 else "Example:"
    for example in guide.examples:
        yield f"  recollect {example}"
    yield f"Read on: {PAGES_ADDRESS}{guide.page}"


def every_command(group: click.Group, path: str = "") -> Iterator[tuple[str, click.Command]]:
    """Yield every command that does something, with its name and that of its group; hidden ones are left out."""
    context = click.Context(group)
    for name in group.list_commands(context):
        command = group.get_command(context, name)
        if isinstance(command, click.Group):
            yield from every_command(command, f"{path}{name} ")
        elif command is not None and not command.hidden:
            yield f"{path}{name}", command


def commands_page(group: click.Group, data: Path) -> str:
    """Return the reference of all commands in Markdown, without the path of this machine's data folder."""
    sections = (line for name, command in every_command(group) for line in _section(name, command))
    return "\n".join([_HEAD, *sections]).replace(str(data), "your data folder")


_HEAD = """# Every command

This page is written by `python packaging/reference.py`; change the commands in `kiosk/cli`, not the page.

`recollect --help` lists the commands in groups, and `recollect COMMAND --help` shows one of them. Options without a
command are those of `run`: `recollect --study study.toml` opens the kiosk. Replace words in capitals with your own.

| exit code | what it means |
|---|---|
| 0 | The command did what it says. |
| 1 | It found something wrong that its page names, or the disk did not take something: try again later. |
| 2 | The input cannot be used; one sentence says what and where. Nothing is half written. |
| 3 | Only of `recollect status`: no kiosk runs, or it hangs. |

With `--json` a command prints JSON for programs.
"""


def _section(name: str, command: click.Command) -> Iterator[str]:
    """Yield the lines about one command: what it does, examples, options, where to read on."""
    guide = GUIDES[name]
    pieces = command.collect_usage_pieces(click.Context(command, info_name=name))
    told = inspect.cleandoc(command.help or "")
    yield f"## recollect {name}\n"
    yield f"{told}\n"
    yield f"    recollect {' '.join([name, *pieces])}\n"
    yield "For example:\n"
    yield from (f"    recollect {example}" for example in guide.examples)
    yield "\n| option | what it is |\n|---|---|"
    for option in command.params:
        if isinstance(option, click.Option) and not option.hidden:
            names = ", ".join(f"`{each}`" for each in [*option.opts, *option.secondary_opts])
            yield f"| {names} | {_about(option)} |"
    if guide.why_no_json:
        yield f"\nThere is no `--json`. {guide.why_no_json}"
    yield f"\nRead on: [{guide.page}](../{guide.page})\n"


def _about(option: click.Option) -> str:
    """Return the help of an option, with its choices or range and its default."""
    told = [option.help or ""]
    if isinstance(option.type, click.Choice):
        told.append(f"One of {', '.join(f'`{each}`' for each in option.type.choices)}.")
    elif isinstance(option.type, click.IntRange | click.FloatRange):
        least, most = option.type.min, option.type.max
        told.append(f"From {least} to {most}." if most is not None else f"At least {least}.")
    if option.required:
        told.append("It must be given.")
    elif isinstance(option.default, (str, int, float)) and not option.is_flag:
        told.append(f"Default: `{option.default}`.")
    return " ".join(told).replace("|", "\\|")


def suggestion(mistyped: str) -> str:
    """Return what may be meant by a name that no command has, as the end of a sentence."""
    from difflib import get_close_matches  # noqa: PLC0415 - only a mistyped name needs it

    below = [name for name in GUIDES if name.split()[-1] == mistyped and " " in name]
    first_words = dict.fromkeys(name.split()[0] for name in GUIDES)
    near = (
        below or get_close_matches(mistyped, first_words) or get_close_matches(f"study {mistyped}", GUIDES, cutoff=0.85)
    )
    if not near:
        return "'recollect --help' lists all commands"
    return f"did you mean {' or '.join(f'{each!r}' for each in near)}?"


@click.command("docs")
@click.argument("topic", required=False)
@json_option
def docs_command(topic: str | None, *, as_json: bool) -> None:
    """Open the documentation in the browser, without a network.

    TOPIC is a command or the name of a page, such as 'check', "study new" or 'glossary'. With --json it opens nothing
    and prints where each page is.
    """
    found = built_pages(beside_or_inside("site")) or pages_as_text(beside_or_inside("docs"))
    if not found:
        raise UserInputError("the documentation is not part of this installation; its pages are in docs/ of a checkout")
    if as_json:
        click.echo(json.dumps({name: str(file) for name, file in found.items()}))
        return
    page = found[page_about(topic, found) if topic else "README"]
    click.echo(page)
    if page.suffix == ".md":
        click.echo("In a checkout 'python3 packaging/bootstrap.py docs' makes pages for the browser of this text.")
    elif not _opened(page):
        click.echo("No browser could be opened here; any browser shows this file.")


def built_pages(site: Path) -> dict[str, Path]:
    """Return the pages for a browser by their names; none where they were not built."""
    index = site / "index.html"
    below = {file.stem: file for file in sorted(site.glob("*/*.html")) if file.parent.name in KINDS}
    return {"README": index, **below} if index.exists() else {}


def pages_as_text(docs: Path) -> dict[str, Path]:
    """Return the pages as they are written in a checkout, by their names."""
    return {file.stem: file for file in [*sorted(docs.glob("*.md")), *sorted(docs.glob("*/*.md"))]}


def page_about(topic: str, pages: Mapping[str, object]) -> str:
    """Return the name of the page about a command or a subject; raise UserInputError if there is none."""
    if topic in pages:
        return topic
    guide = GUIDES.get(topic) or next((each for name, each in GUIDES.items() if name.split()[0] == topic), None)
    if guide is not None:
        return Path(guide.page).stem
    from difflib import get_close_matches  # noqa: PLC0415 - only a mistyped name needs it

    near = get_close_matches(topic, [*pages, *GUIDES])
    meant = f"did you mean {' or '.join(map(repr, near))}?" if near else "'recollect docs' opens the list of all pages"
    raise UserInputError(f"there is no page about {topic!r}; {meant}")


def _opened(page: Path) -> bool:
    """Open a file in the browser and return whether there is one."""
    import webbrowser  # noqa: PLC0415 - no other command needs it

    return webbrowser.open(page.as_uri())
