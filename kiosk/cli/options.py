"""Options, progress bars and prompts that several commands share."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

import click

from kiosk import UserInputError
from kiosk.cli.composition import DATA
from kiosk.cli.terminal import console, tell_line
from kiosk.places import ASSETS

if TYPE_CHECKING:
    from kiosk.assistance.wording import Catalogue

# Every process that Recollect starts reads this module, so it loads at once only what all of them need.
# ruff: noqa: PLC0415

REHEARSALS = DATA / "rehearsals"
"""Where rehearsals go unless told otherwise."""

data_option = click.option(
    "--data", type=click.Path(path_type=Path), default=DATA, show_default=True, help="The data folder."
)
rehearsal_data_option = click.option(
    "--data",
    type=click.Path(path_type=Path),
    default=REHEARSALS,
    show_default=True,
    help="The data folder; not the one of the study.",
)


def _stored_data_option(is_there: Callable[[Path], bool]) -> Callable[..., Any]:
    """Make the option of a command about what is stored: where nothing is yet, it is about the rehearsals."""

    def choose(_context: click.Context, _option: click.Parameter, given: Path | None) -> Path:
        if given is not None:
            return given
        if not is_there(REHEARSALS):
            return DATA
        if is_there(DATA):
            if _has_only_trials(DATA):
                tell_line(f"Only trials are stored in {DATA}. For the rehearsals, add --data {REHEARSALS}", err=True)
            return DATA
        tell_line(f"Nothing is stored in {DATA} yet, so this is about the rehearsals in {REHEARSALS}.", err=True)
        return REHEARSALS

    return click.option(
        "--data",
        type=click.Path(path_type=Path),
        callback=choose,
        help=f"The data folder; by default {DATA} or, as long as nothing is stored there, its rehearsals.",
    )


def _has_sessions(folder: Path) -> bool:
    from kiosk.store.database import has_sessions

    return has_sessions(folder)


def _has_only_trials(folder: Path) -> bool:
    from kiosk.store.database import has_only_trials

    return has_only_trials(folder)


def _has_database(folder: Path) -> bool:
    from kiosk.store.database import has_database

    return has_database(folder)


sessions_data_option = _stored_data_option(_has_sessions)
database_data_option = _stored_data_option(_has_database)
json_option = click.option("--json", "as_json", is_flag=True, help="Print JSON, for programs.")
robot_host_option = click.option("--robot-host", help="The robot's name or address; a Furhat unless told otherwise.")
robot_port_option = click.option("--robot-port", type=click.IntRange(1, 65535), help="The robot's port.")
study_option = click.option("--study", type=click.Path(path_type=Path), help="The study file (TOML).")
site_option = click.option(
    "--site", default="", help="Where this kiosk stands, if data of several will be merged: A, B, ROME."
)


class ProgressCallback(Protocol):
    """Called with how much is done; of how much, where that was not known before."""

    def __call__(self, done: int, of: int | None = None, /) -> None:
        """Draw it."""
        ...


@contextmanager
def progress_bar(what: str, total: int | None = None, *, hidden: bool) -> Iterator[ProgressCallback]:
    """Provide a bar with rate and time left on the error stream; nothing without a terminal, or when ``hidden``."""
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (
        TextColumn(what),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("{task.fields[rate]}"),
        TimeRemainingColumn(),
    )
    drawn = console(stderr=True)
    with Progress(*columns, console=drawn, disable=hidden or not drawn.is_terminal, transient=True) as bar:
        task = bar.add_task(what, total=total, rate="")

        def tell(done: int, of: int | None = None, /) -> None:
            speed = bar.tasks[0].speed
            bar.update(task, completed=done, total=of, rate=f"{speed:,.0f}/s" if speed else "")

        yield tell


@click.command()
@json_option
def set_pin_command(*, as_json: bool) -> None:
    """Choose the experimenter's PIN and print its two lines.

    They belong in the study file.
    """
    import secrets

    from kiosk.experiment.experimenter import LEAST, MOST, SALT_BYTES, hash_pin

    chosen = _ask(f"PIN ({LEAST} to {MOST} digits)")
    if _ask("The same again") != chosen:
        raise UserInputError("the two PINs are not the same; nothing was changed")
    line = hash_pin(chosen, secrets.token_bytes(SALT_BYTES))
    click.echo(json.dumps({"pin_hash": line}) if as_json else f'[experimenter]\npin_hash = "{line}"')


def _ask(prompt: str) -> str:
    """Return what was typed, unseen; what is asked goes where it is not taken for the answer."""
    answer: str = click.prompt(prompt, hide_input=True, err=True, default="", show_default=False)
    return answer


def read_catalogue(language: str) -> Catalogue:
    """Return the catalogue of a language; raises UserInputError with all the languages there are."""
    from kiosk.assistance.wording import Catalogue

    if language not in shipped_languages():
        raise UserInputError(f"there is no language {language!r}; there are {', '.join(shipped_languages())}")
    return Catalogue(ASSETS / "sentences" / language)


def shipped_languages() -> tuple[str, ...]:
    """Every language that has a folder of sentences, English first, as everything else is measured against it."""
    names = sorted(folder.name for folder in (ASSETS / "sentences").iterdir() if folder.is_dir())
    return tuple(sorted(names, key=lambda name: name != "en"))
