"""The command `check`. What it tries is loaded when it runs, so that its help comes at once."""

from __future__ import annotations

from pathlib import Path

import click

from kiosk.cli.options import data_option, json_option, robot_host_option, robot_port_option, site_option, study_option

WATCH_S = 10
"""Seconds between two looks at the booth."""


@click.command()
@data_option
@study_option
@site_option
@robot_host_option
@robot_port_option
@click.option("--say", is_flag=True, help="Say a test sentence in every language, so that you hear the voice.")
@click.option("--watch", is_flag=True, help=f"Check again every {WATCH_S} s until Ctrl+C, and say what has changed.")
@json_option
@click.pass_context
def check_command(
    context: click.Context,
    data: Path,
    study: Path | None,
    site: str,
    robot_host: str | None,
    robot_port: int | None,
    *,
    say: bool,
    watch: bool,
    as_json: bool,
) -> None:
    """Try everything that a booth needs, and say what to do.

    What fails comes first. The exit code is 1 if no session can be held. Nothing is shown or kept, and nothing is heard
    without --say.
    """
    if watch and say:
        raise click.UsageError("choose --watch or --say: a sentence every few seconds is no help")
    from kiosk.cli.check import check_booth  # noqa: PLC0415 - it loads the whole kiosk

    watch_s = WATCH_S if watch else None
    context.exit(check_booth(data, study, site, robot_host, robot_port, say=say, watch_s=watch_s, as_json=as_json))
