"""``recollect display``, which ``recollect check`` starts: looking at the display, where Qt may end the process."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable
from pathlib import Path

import click

from kiosk.cli.options import study_option
from kiosk.cli.wiring import read_settings
from kiosk.findings import Finding
from kiosk.study.declared.checked.whole import read_study
from kiosk.ui.probes.asked import to_json
from kiosk.ui.qt_platform import missing_library

# Qt is loaded by the look itself: where the system lacks a library that it needs, that is what is found.
# ruff: noqa: PLC0415


@click.group(hidden=True)
def display() -> None:
    """Look at the display and print what was found; a check starts it."""


@display.command()
@click.argument("number", type=int)
def screens(number: int) -> None:
    """Look at the screens, of which the kiosk is to cover this one."""

    def look() -> Iterable[Finding]:
        from kiosk.ui.probes.screens import screens as look_at

        return look_at(number)

    _print("screen", look)


@display.command()
def pictures() -> None:
    """Draw the pictures that are named on standard input."""
    from kiosk.ui.probes.pictures import draw as draw_pictures

    draw_pictures(sys.stdin, sys.stdout)


@display.command()
@study_option
def frame(study: Path | None) -> None:
    """Draw the kiosk where nobody sees it."""

    def look() -> Iterable[Finding]:
        from kiosk.ui.probes.frame import frame as draw

        return draw(read_study(read_settings(study)))

    _print("drawing", look)


def _print(what: str, look: Callable[[], Iterable[Finding]]) -> None:
    try:
        found = to_json(look())
    except ImportError as error:
        missing = missing_library(error)
        if missing is None:
            raise
        found = to_json([Finding.bad(what, missing.words, missing.remedy)])
    click.echo(found)
