"""Options that several commands share."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import click

from kiosk.cli.wiring import DATA
from kiosk.store.database import has_database, has_sittings

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
        if is_there(DATA) or not is_there(REHEARSALS):
            return DATA
        click.echo(f"Nothing is stored in {DATA} yet, so this is about the rehearsals in {REHEARSALS}.", err=True)
        return REHEARSALS

    return click.option(
        "--data",
        type=click.Path(path_type=Path),
        callback=choose,
        help=f"The data folder; by default {DATA} or, as long as nothing is stored there, its rehearsals.",
    )


sittings_data_option = _stored_data_option(has_sittings)
database_data_option = _stored_data_option(has_database)
json_option = click.option("--json", "as_json", is_flag=True, help="Print JSON, for programs.")
robot_host_option = click.option("--robot-host", help="The robot's name or address; a Furhat unless told otherwise.")
robot_port_option = click.option("--robot-port", type=click.IntRange(1, 65535), help="The robot's port.")
study_option = click.option("--study", type=click.Path(path_type=Path), help="The study file (TOML).")
site_option = click.option(
    "--site", default="", help="Where this kiosk stands, if data of several will be merged: A, B, ROME."
)
