"""Examples of every command and the page about it, for its help and for the reference of all commands."""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path

import click

PAGES_ADDRESS = "docs/"
"""Where the pages are, in a checkout."""


@dataclass(frozen=True, slots=True)
class Guide:
    """The page about a command, examples without the word ``recollect``, and why there is no ``--json``."""

    page: str
    examples: tuple[str, ...]
    why_no_json: str = ""


GUIDES = {
    "study new": Guide("new-study.md", ("study new my-study", "study new my-study --template fair --language it")),
    "study check": Guide("study-file.md", ("study check study.toml", "study check study.toml --pages")),
    "study preview": Guide("preview.md", ("study preview study.toml",), "It shows a window."),
    "study cards": Guide(
        "own-cards.md", ("study cards study.toml --sheet cards.png", "study cards study.toml --names")
    ),
    "study translations": Guide(
        "add-a-language.md",
        ("study translations study.toml", "study translations study.toml --language it --write italian.csv"),
    ),
    "study import": Guide(
        "import.md", ("study import items.csv --id trust --version 1 --out questionnaires/trust.toml",)
    ),
    "study dossier": Guide("dossier.md", ("study dossier study.toml --out dossier.pdf",)),
    "study diff": Guide("one-file.md", ("study diff pilot.toml study.toml",)),
    "study pack": Guide("one-file.md", ("study pack study.toml --out study.recollect",)),
    "study set-pin": Guide("experimenter.md", ("study set-pin",)),
    "study reference": Guide(
        "study-file.md",
        ("study reference", "study reference --toml"),
        "It prints a page or, with --toml, a study file.",
    ),
    "plan new": Guide("plan.md", ("plan new plan.toml",)),
    "plan check": Guide("plan.md", ("plan check plan.toml",)),
    "plan power": Guide("plan.md", ("plan power plan.toml --n 40 --studies 200",)),
    "plan show": Guide("plan.md", ("plan show plan.toml",)),
    "plan freeze": Guide("plan.md", ("plan freeze plan.toml",)),
    "plan look": Guide("plan.md", ("plan look plan.toml",)),
    "plan simulate": Guide("plan.md", ("plan simulate plan.toml --out simulated --people 40",)),
    "voice render": Guide("voice.md", ("voice render", "voice render --study study.toml --language it")),
    "voice script": Guide("voice.md", ("voice script --study study.toml --language it",)),
    "voice import": Guide("voice.md", ("voice import recordings --out voices/anna --speaker Anna",)),
    "voice missing": Guide("voice.md", ("voice missing voices/anna --study study.toml",)),
    "voice check": Guide("voice.md", ("voice check voices/anna",)),
    "voice play": Guide("voice.md", ('voice play "The lion is in the second row."',)),
    "run": Guide("booth.md", ("run --study study.toml", "run --supervise --study study.toml")),
    "check": Guide("booth.md", ("check --study study.toml", "check --say")),
    "rehearse": Guide(
        "booth.md",
        ("rehearse --headless --seed 1 --shots pictures", "rehearse --headless --sessions 200 --study study.toml"),
    ),
    "robot": Guide("embodiments.md", ("robot --host 192.168.1.50", "robot --study study.toml")),
    "status": Guide("booth.md", ("status", "status --json")),
    "sessions": Guide("data-set.md", ("sessions", "sessions --codes")),
    "events": Guide("data-set.md", ("events 1", "events 1 --json")),
    "replay": Guide("how-it-works.md", ("replay 1", "replay 1 --headless --frames pictures")),
    "explain": Guide("mentaliser.md", ("explain 1 --flip 14", "explain case.json")),
    "day": Guide("booth.md", ("day", "day --date 2026-05-09 --out saturday.html")),
    "backup": Guide("booth.md", ("backup", "backup --to stick")),
    "verify": Guide("booth.md", ("verify",)),
    "browse": Guide("booth.md", ("browse --open",), "It serves a page until Ctrl+C."),
    "withdraw": Guide("data-set.md", ("withdraw ABCD-EFGH",)),
    "merge": Guide("booth.md", ("merge booth-1 booth-2 --out both",)),
    "export": Guide("data-set.md", ("export --out data-set", "export --out data-set --bids --with-rehearsals")),
    "report": Guide("report.md", ("report data-set --out report", "report data-set --plan plan.toml --out report")),
    "calibrate": Guide("calibrate.md", ("calibrate data-set",)),
    "train": Guide("learning.md", ("train --out table.json", "train --reward paper --episodes 5000 --out paper.json")),
    "simulate": Guide("learning.md", ("simulate --games 500", "simulate --policy table.json --condition tom")),
    "policy show": Guide("learning.md", ("policy show default", "policy show table.json --figure table.svg")),
    "policy compare": Guide("learning.md", ("policy compare default table.json",)),
    "policy card": Guide("learning.md", ("policy card table.json",)),
    "policy evidence": Guide("learning.md", ("policy evidence --games 200",)),
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
command are those of `run`: `recollect --study study.toml` opens the kiosk. What stands in capitals is yours to fill in.

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
    yield f"\nRead on: [{guide.page}]({guide.page})\n"


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
    below = [name for name in GUIDES if name.split()[-1] == mistyped and " " in name]
    first_words = dict.fromkeys(name.split()[0] for name in GUIDES)
    near = (
        below or get_close_matches(mistyped, first_words) or get_close_matches(f"study {mistyped}", GUIDES, cutoff=0.85)
    )
    if not near:
        return "'recollect --help' lists all commands"
    return f"did you mean {' or '.join(f'{each!r}' for each in near)}?"
