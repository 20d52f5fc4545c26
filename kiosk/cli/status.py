"""The commands `status` and `check`: how the booth is now, by its status file and by trying everything.

They load little, so that their help and the status come at once.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from datetime import UTC, datetime, timedelta
from pathlib import Path

import click

from kiosk import UserInputError
from kiosk.cli.options import data_option, json_option, robot_host_option, robot_port_option, site_option, study_option
from kiosk.cli.terminal import one_line
from kiosk.experiment.booth_status import CLOSED, FILE, BoothStatus
from kiosk.files import read_bytes

NOT_ALIVE, TROUBLE = 3, 1
"""Exit codes of ``status``: no kiosk runs, or it hangs; it runs, and something is not well."""

WATCH_S = 10
"""Seconds between two looks of ``check --watch`` at the booth."""


@click.command()
@data_option
@json_option
@click.pass_context
def status_command(context: click.Context, data: Path, *, as_json: bool) -> None:
    """Show the state of the booth while the kiosk runs.

    It shows stage, today's sessions, robot, voice, disk and backup. Exit code 0 if the kiosk runs and all is well,
    1 if something is not, 3 if no kiosk runs or it hangs.
    """
    status = read_status(data)
    now = datetime.now(UTC)
    alive = status.is_alive(now)
    if as_json:
        click.echo(json.dumps(json.loads(status.to_json()) | {"alive": alive, "age_s": round(status.age_s(now), 1)}))
    else:
        click.echo("\n".join(_status_lines(status, now, alive=alive)))
    context.exit(NOT_ALIVE if not alive else TROUBLE if status.failing else 0)


def read_status(data: Path) -> BoothStatus:
    """Read the status of the kiosk with a data folder; raises UserInputError."""
    file = data / FILE
    try:
        return BoothStatus.from_json(read_bytes(file).decode("utf-8"))
    except FileNotFoundError:
        raise UserInputError(f"no kiosk has run with the data folder {data}: there is no {FILE}") from None
    except (OSError, ValueError) as error:
        raise UserInputError(f"the status file {file} cannot be read: {error}") from error


def _status_lines(status: BoothStatus, now: datetime, *, alive: bool) -> Iterator[str]:
    since = _minutes(status.stage_since, now)
    if alive:
        yield f"OK    kiosk       {'paused' if status.paused else status.stage} since {since}"
    elif status.stage == CLOSED:
        yield f"FAIL  kiosk       closed since {_minutes(status.at, now)}"
    else:
        yield f"FAIL  kiosk       silent since {_minutes(status.at, now)}; it was in the stage {status.stage}"
    today = status.today
    yield (
        f"OK    today       {today.begun} begun, {today.completed} completed ({today.last_hour} in the last hour), "
        f"{today.ended_early} ended early"
    )
    for part in status.parts:
        yield f"{'OK' if part.ok else 'WARN':6}{part.name:12}{one_line(part.message)}"
    yield f"{'OK' if status.supervised else 'WARN':6}supervisor  {'yes' if status.supervised else 'no'}"
    for ended in status.ended:
        yield f"      {_minutes(ended.at, now)} ago: {ended.status}{f' in {ended.stage}' if ended.stage else ''}"


def _minutes(iso: str, now: datetime) -> str:
    minutes = (now - datetime.fromisoformat(iso)) // timedelta(minutes=1)
    hours, rest = divmod(minutes, 60)
    return f"{hours} h {rest} min" if hours else f"{minutes} min"


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
