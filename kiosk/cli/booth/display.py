"""``recollect display``, which ``recollect check`` starts: looking at the display, where Qt may end the process."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from kiosk.cli.options import study_option
from kiosk.cli.wiring import read_settings
from kiosk.study.declared.checked.whole import read_study
from kiosk.ui.probes.asked import to_json
from kiosk.ui.probes.frame import frame as draw
from kiosk.ui.probes.pictures import draw as draw_pictures
from kiosk.ui.probes.screens import screens as look


@click.group(hidden=True)
def display() -> None:
    """Look at the display and print what was found; a check starts it."""


@display.command()
@click.argument("number", type=int)
def screens(number: int) -> None:
    """Look at the screens, of which the kiosk is to cover this one."""
    click.echo(to_json(look(number)))


@display.command()
def pictures() -> None:
    """Draw the pictures that are named on standard input."""
    draw_pictures(sys.stdin, sys.stdout)


@display.command()
@study_option
def frame(study: Path | None) -> None:
    """Draw the kiosk where nobody sees it."""
    click.echo(to_json(draw(read_study(read_settings(study)))))
