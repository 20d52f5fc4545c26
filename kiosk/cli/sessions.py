"""Commands that list and print stored sessions, and tell how the booth is now."""

from __future__ import annotations

import json
from collections.abc import Iterator
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import click
from rich.console import Console
from rich.table import Table

from kiosk import UserInputError
from kiosk.cli.options import data_option, json_option, sessions_data_option
from kiosk.experiment.booth_status import CLOSED, FILE, BoothStatus
from kiosk.store.queries import StoredSession, open_repository
from kiosk.units import MS_PER_SECOND

WIDTH = 150
"""Characters that a line of the list may need."""

_WORDS = ("condition", "embodiment", "status", "stage", "allocation_source")
_COUNTS = ("pairs", "moves", "flips", "hints")


@click.command()
@sessions_data_option
@click.option("--codes", is_flag=True, help="Show the participants' codes as well; they are the visitors' own.")
@json_option
def sessions_command(data: Path, *, codes: bool, as_json: bool) -> None:
    """List the stored sessions and how they ended.

    Each has its time, condition and stage.
    """
    with open_repository(data) as stored:
        rows = [_row(session, with_code=codes) for session in stored.sessions()]
    if as_json:
        click.echo(json.dumps(rows))
        return
    table = Table(box=None)
    own = ("participant", "code") if codes else ("participant",)
    for heading in ("session", *own, "started (UTC)", *_WORDS, "visitor", *_COUNTS):
        table.add_column(heading, no_wrap=True, justify="right" if heading in _COUNTS else "left")
    for row in rows:
        started = row["started_at"][:16].replace("T", " ")
        visitor = "simulated" if row["simulated"] else "trial" if row["trial"] else "person"
        cells = (row["session"], *(row[key] for key in own), started, *(row[key] for key in _WORDS), visitor)
        table.add_row(*(_word(cell) for cell in cells), *(str(row[key]) for key in _COUNTS))
    # Without a terminal, or in a narrow window, lines may be long, but no word is cut.
    Console(width=max(Console().width, WIDTH)).print(table)


def _row(session: StoredSession, *, with_code: bool) -> dict[str, Any]:
    return session.to_json() | {"started_at": session.started_at} | ({"code": session.code} if with_code else {})


def _word(value: object) -> str:
    return "-" if value is None else str(value)


@click.command()
@click.argument("session", type=int)
@sessions_data_option
@json_option
def events_command(session: int, data: Path, *, as_json: bool) -> None:
    """List what happened in a SESSION, in order."""
    with open_repository(data) as stored:
        records = stored.records(session)
    if as_json:
        click.echo(json.dumps(records))
        return
    for record in records:
        seq, at_ms, kind = (record.pop(key) for key in ("seq", "at_ms", "type"))
        origin = record.pop("origin")
        details = "  ".join(f"{key}={json.dumps(value, ensure_ascii=False)}" for key, value in record.items())
        mark = "<" if origin == "world" else ">"
        click.echo(f"{seq:5} {at_ms / MS_PER_SECOND:9.3f} s {mark} {kind:18} {details}")


NOT_ALIVE, TROUBLE = 3, 1
"""Exit codes of ``status``: no kiosk runs, or it hangs; it runs, and something is not well."""


@click.command()
@data_option
@json_option
@click.pass_context
def status_command(context: click.Context, data: Path, *, as_json: bool) -> None:
    """Show how the booth is now, while the kiosk runs.

    It shows stage, today's sessions, robot, voice, disk and backup. Exit code 0 if the kiosk runs and all is well,
    1 if something is not, 3 if no kiosk runs or it hangs.
    """
    status = _read_status(data)
    now = datetime.now(UTC)
    alive = status.is_alive(now)
    if as_json:
        click.echo(json.dumps(json.loads(status.to_json()) | {"alive": alive, "age_s": round(status.age_s(now), 1)}))
    else:
        click.echo("\n".join(_status_lines(status, now, alive=alive)))
    context.exit(NOT_ALIVE if not alive else TROUBLE if status.failing else 0)


def _read_status(data: Path) -> BoothStatus:
    file = data / FILE
    try:
        return BoothStatus.from_json(file.read_text("utf-8"))
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
        yield f"{'OK' if part.ok else 'WARN':6}{part.name:12}{_printable(part.message)}"
    yield f"{'OK' if status.supervised else 'WARN':6}supervisor  {'yes' if status.supervised else 'no'}"
    for ended in status.ended:
        yield f"      {_minutes(ended.at, now)} ago: {ended.status}{f' in {ended.stage}' if ended.stage else ''}"


def _minutes(iso: str, now: datetime) -> str:
    minutes = (now - datetime.fromisoformat(iso)) // timedelta(minutes=1)
    hours, rest = divmod(minutes, 60)
    return f"{hours} h {rest} min" if hours else f"{minutes} min"


def _printable(text: str) -> str:
    return "".join(letter if letter.isprintable() else "\N{REPLACEMENT CHARACTER}" for letter in text)
