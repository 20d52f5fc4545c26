"""Options that several commands share."""

from __future__ import annotations

from pathlib import Path

import click

from kiosk.cli.wiring import DATA

data_option = click.option(
    "--data", type=click.Path(path_type=Path), default=DATA, show_default=True, help="The data folder."
)
rehearsal_data_option = click.option(
    "--data",
    type=click.Path(path_type=Path),
    default=DATA / "rehearsals",
    show_default=True,
    help="The data folder; not the one of the study.",
)
json_option = click.option("--json", "as_json", is_flag=True, help="Print JSON, for programs.")
robot_host_option = click.option("--robot-host", help="The robot's name or address; a Furhat unless told otherwise.")
robot_port_option = click.option("--robot-port", type=click.IntRange(1, 65535), help="The robot's port.")
study_option = click.option("--study", type=click.Path(path_type=Path), help="The study file (TOML).")
site_option = click.option(
    "--site", default="", help="Where this kiosk stands, if data of several will be merged: A, B, ROME."
)
