"""How rows are written, and how a sitting that was cut off gets its end; whoever asks has a transaction open."""

from __future__ import annotations

import json
import sqlite3
import time
from collections.abc import Mapping, Sequence
from typing import Any

from kiosk import BadInput
from kiosk.study.events import Event, SittingEnded, Status, WorldEvent, to_record


def insert(connection: sqlite3.Connection, table: str, row: Mapping[str, str | int | None]) -> int:
    """Write one row, told by its columns' names; returns its number."""
    marks = ", ".join("?" * len(row))
    columns = ", ".join(row)
    cursor = connection.execute(
        f"INSERT INTO {table} ({columns}) VALUES ({marks})",  # noqa: S608 - the names are ours
        tuple(row.values()),
    )
    return cursor.lastrowid or 0


def insert_events(connection: sqlite3.Connection, sitting: int, first_seq: int, events: Sequence[Event]) -> None:
    """Write the next events of a sitting."""
    written_ms = now_ms()
    connection.executemany(
        _INSERT_EVENT,
        (
            (sitting, seq, event.at_ms, _origin(event), *_type_and_body(event), written_ms)
            for seq, event in enumerate(events, first_seq)
        ),
    )


def mark_interrupted(connection: sqlite3.Connection) -> tuple[int, ...]:
    """End every sitting whose last event is not its end, where that event left it; returns their numbers."""
    open_sittings = connection.execute(
        """
        SELECT sitting.id, last.seq, last.at_ms FROM sitting JOIN event AS last ON last.sitting = sitting.id
        AND last.seq = (SELECT max(seq) FROM event WHERE event.sitting = sitting.id)
        WHERE last.type <> 'SittingEnded' ORDER BY sitting.id
        """
    ).fetchall()
    for sitting, seq, at_ms in open_sittings:
        end = SittingEnded(at_ms=at_ms, status=Status.INTERRUPTED)
        connection.execute(_INSERT_EVENT, (sitting, seq + 1, at_ms, "recovery", *_type_and_body(end), now_ms()))
    return tuple(sitting for sitting, *_ in open_sittings)


def interrupted_at(connection: sqlite3.Connection, sitting: int) -> int:
    """The seq of the end of a sitting that was interrupted; raises BadInput if it was not."""
    last = connection.execute(
        "SELECT seq, type, body FROM event WHERE sitting = ? ORDER BY seq DESC LIMIT 1", (sitting,)
    ).fetchone()
    if last is None:
        raise BadInput(f"there is no sitting {sitting}")
    seq, kind, body = last
    if kind != SittingEnded.__name__ or json.loads(body)["status"] != Status.INTERRUPTED.value:
        raise BadInput(f"sitting {sitting} was not interrupted, so it cannot be gone on with")
    return int(seq)


def json_text(record: Mapping[str, Any]) -> str:
    """A record as it stands in the database."""
    text = json.dumps(record, ensure_ascii=False, separators=(",", ":"))
    # What the system says may hold lone surrogates, which no file can; written out, they are JSON's own escapes.
    return text.encode("utf-8", "backslashreplace").decode()


def now_ms() -> int:
    """The wall's clock, in ms since 1970; it may be set back, so nothing is ever sorted by it."""
    return time.time_ns() // 1_000_000


_INSERT_EVENT = "INSERT INTO event (sitting, seq, at_ms, origin, type, body, wall_ms) VALUES (?, ?, ?, ?, ?, ?, ?)"


def _origin(event: Event) -> str:
    return "world" if isinstance(event, WorldEvent) else "session"


def _type_and_body(event: Event) -> tuple[str, str]:
    """An event's class, and its own fields as JSON; the time and the class have columns of their own."""
    record = to_record(event)
    kind = str(record.pop("type"))
    del record["at_ms"]
    return kind, json_text(record)
