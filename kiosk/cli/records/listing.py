"""Commands that look at what is stored."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import click
from rich.console import Console
from rich.table import Table

from kiosk.cli.options import json_option, sittings_data_option
from kiosk.store.reading import Sitting, archive
from kiosk.units import MS_PER_SECOND

WIDTH = 150
"""Characters that a line of the list may need."""

_WORDS = ("condition", "body", "status", "stage", "allotted")
_COUNTS = ("pairs", "moves", "flips", "hints")


@click.command()
@sittings_data_option
@click.option("--codes", is_flag=True, help="Show the participants' codes as well; they are the visitors' own.")
@json_option
def sittings(data: Path, *, codes: bool, as_json: bool) -> None:
    """List the stored sittings: when, in which condition, how and where they ended."""
    with archive(data) as stored:
        rows = [_row(sitting, with_code=codes) for sitting in stored.sittings()]
    if as_json:
        click.echo(json.dumps(rows))
        return
    table = Table(box=None)
    own = ("participant", "code") if codes else ("participant",)
    for heading in ("sitting", *own, "started (UTC)", *_WORDS, "visitor", *_COUNTS):
        table.add_column(heading, no_wrap=True, justify="right" if heading in _COUNTS else "left")
    for row in rows:
        started = row["started_at"][:16].replace("T", " ")
        visitor = "simulated" if row["simulated"] else "trial" if row["trial"] else "person"
        cells = (row["sitting"], *(row[key] for key in own), started, *(row[key] for key in _WORDS), visitor)
        table.add_row(*(_word(cell) for cell in cells), *(str(row[key]) for key in _COUNTS))
    # Where nobody looks, or the window is narrow, lines may be long, but no word is cut.
    Console(width=max(Console().width, WIDTH)).print(table)


def _row(sitting: Sitting, *, with_code: bool) -> dict[str, Any]:
    return sitting.to_json() | {"started_at": sitting.started_at} | ({"code": sitting.code} if with_code else {})


def _word(value: object) -> str:
    return "-" if value is None else str(value)


@click.command()
@click.argument("sitting", type=int)
@sittings_data_option
@json_option
def events(sitting: int, data: Path, *, as_json: bool) -> None:
    """List what happened in a SITTING, in the order in which it was written."""
    with archive(data) as stored:
        records = stored.records(sitting)
    if as_json:
        click.echo(json.dumps(records))
        return
    for record in records:
        seq, at_ms, kind = (record.pop(key) for key in ("seq", "at_ms", "type"))
        origin = record.pop("origin")
        details = "  ".join(f"{key}={json.dumps(value, ensure_ascii=False)}" for key, value in record.items())
        mark = "<" if origin == "world" else ">"
        click.echo(f"{seq:5} {at_ms / MS_PER_SECOND:9.3f} s {mark} {kind:18} {details}")
