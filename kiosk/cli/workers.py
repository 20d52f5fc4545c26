"""Commands that the program starts itself, each in a process of its own: checks of the display, voice, splash.

None of them loads what it does not need: the voice is to begin soon, and a check is to say which library Qt lacks.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterable
from pathlib import Path

import click

from kiosk.cli.composition import read_settings
from kiosk.cli.main import BAD_INPUT
from kiosk.cli.options import read_catalogue, shipped_languages, study_option
from kiosk.preflight import CheckResult
from kiosk.sd_notify import relay
from kiosk.ui.qt_platform import missing_library, obstacle

# Each command loads what it needs. Qt is loaded by the look itself: where the system lacks a library of Qt's, that is
# what is found.
# ruff: noqa: PLC0415


@click.group(hidden=True)
def display_command() -> None:
    """Look at the display and print what was found; a check starts it."""


@display_command.command()
@click.argument("number", type=int)
def screens_command(number: int) -> None:
    """Look at the screens, of which the kiosk is to cover this one."""

    def look() -> Iterable[CheckResult]:
        from kiosk.ui.checks import screens_check as look_at

        return look_at(number)

    _print("screen", look)


@display_command.command()
def pictures() -> None:
    """Draw the pictures that are named on standard input."""
    from kiosk.ui.checks import draw_files as draw_pictures

    draw_pictures(sys.stdin, sys.stdout)


@display_command.command()
def cards() -> None:
    """Draw the cards that are named on standard input, each into a file."""
    from kiosk.ui.checks import draw_files

    draw_files(sys.stdin, sys.stdout, cards=True)


@display_command.command()
def fonts() -> None:
    """Find the characters on standard input that no font can draw."""
    from kiosk.ui.fonts import try_fonts

    try_fonts(sys.stdin, sys.stdout)


@display_command.command()
@study_option
def frame_command(study: Path | None) -> None:
    """Draw the kiosk off screen."""

    def look() -> Iterable[CheckResult]:
        from kiosk.study.loader import read_study
        from kiosk.ui.checks import frame_check as draw

        return draw(read_study(read_settings(study)))

    _print("drawing", look)


def _print(what: str, look: Callable[[], Iterable[CheckResult]]) -> None:
    from kiosk.ui.checks import to_json

    try:
        found = to_json(look())
    except ImportError as error:
        missing = missing_library(error)
        if missing is None:
            raise
        found = to_json([CheckResult.error(what, missing.words, missing.remedy)])
    click.echo(found)


@click.command(hidden=True)
@click.argument("options")
def voice_command(options: str) -> None:
    """Be the voice, in a process of its own; the kiosk starts it."""
    from kiosk.robots.tts_worker import run_tts_worker

    run_tts_worker(json.loads(options))


@click.command(hidden=True)
@click.argument("name")
@click.argument("source")
def markers_command(name: str, source: str) -> None:
    """Send the markers on standard input as a stream; the kiosk starts it."""
    from kiosk.robots.lsl_worker import run_lsl_worker

    run_lsl_worker(name, source)


@click.command(hidden=True, context_settings={"ignore_unknown_options": True})
@click.argument("command", nargs=-1, required=True, type=click.UNPROCESSED)
def relay_command(command: tuple[str, ...]) -> None:
    """Run a command and send its notices on to systemd; recollect-cage@.service starts it."""
    code = relay(command)
    sys.exit(code if code >= 0 else _BY_SIGNAL - code)


_BY_SIGNAL = 128
"""A shell's exit code for a program that a signal ended is this and the signal's number."""


@click.command(hidden=True)
def splash_command() -> None:
    """Show the calm window that lies underneath the kiosk; the supervisor starts it."""
    if obstacle() is not None:
        # The kiosk, which meets it as well, says what to do.
        sys.exit(BAD_INPUT)
    from kiosk.ui.splash import show_splash

    show_splash([read_catalogue(language).text("splash-line") for language in shipped_languages()])
