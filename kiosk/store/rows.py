"""Rows of sessions and events as the database has them; callers have a transaction open."""

from __future__ import annotations

import json
import sqlite3
import time
from collections.abc import Mapping, Sequence
from typing import Any

from kiosk import UserInputError
from kiosk.experiment.event_records import to_record
from kiosk.experiment.events import Event, SessionEnded, WorldEvent
from kiosk.experiment.outcomes import Status
from kiosk.store.chain import next_hash


def insert(connection: sqlite3.Connection, table: str, row: Mapping[str, str | int | bytes | None]) -> int:
    """Write one row, told by its columns' names; returns its number."""
    marks = ", ".join("?" * len(row))
    columns = ", ".join(row)
    cursor = connection.execute(
        f"INSERT INTO {table} ({columns}) VALUES ({marks})",  # noqa: S608 - the names are ours
        tuple(row.values()),
    )
    return cursor.lastrowid or 0


def insert_audit_event(
    connection: sqlite3.Connection, kind: str, payload: Mapping[str, Any], wall_ms: int | None = None
) -> None:
    """Write an event of the booth; ``wall_ms`` is when that was, in ms since 1970, by default now."""
    row: dict[str, str | int | bytes | None] = {
        "wall_ms": now_ms() if wall_ms is None else wall_ms,
        "type": kind,
        "payload": json_text(payload),
    }
    insert(connection, "audit_event", row)


EventRow = tuple[int, int, int, str, str, str, int, bytes]
"""The columns of an event, in the order of the table; the last one is its hash."""


INSERT_EVENT = (
    "INSERT INTO event (session, seq, at_ms, origin, type, payload, wall_ms, hash) VALUES (?, ?, ?, ?, ?, ?, ?, ?)"
)


def event_rows(session: int, first_seq: int, events: Sequence[Event], before: bytes) -> list[EventRow]:
    """Return the rows of a session's next events; ``before`` is the hash that the first of them is chained to."""
    written_ms = now_ms()
    rows: list[EventRow] = []
    for seq, event in enumerate(events, first_seq):
        origin, (kind, payload) = _origin(event), _type_and_payload(event)
        before = next_hash(before, (seq, event.at_ms, origin, kind, written_ms, payload))
        rows.append((session, seq, event.at_ms, origin, kind, payload, written_ms, before))
    return rows


def mark_interrupted(connection: sqlite3.Connection) -> tuple[int, ...]:
    """End every session whose last event is not its end, where that event left it; returns their numbers."""
    open_sessions = connection.execute(
        """
        SELECT under_way.session, last.seq, last.at_ms, last.hash FROM session_summary AS under_way
        JOIN event AS last ON last.session = under_way.session
        AND last.seq = (SELECT max(seq) FROM event WHERE event.session = under_way.session)
        WHERE under_way.status IS NULL ORDER BY under_way.session
        """
    ).fetchall()
    for session, seq, at_ms, before in open_sessions:
        kind, payload = _type_and_payload(SessionEnded(at_ms=at_ms, status=Status.INTERRUPTED))
        written_ms = now_ms()
        sha256 = next_hash(before, (seq + 1, at_ms, "recovery", kind, written_ms, payload))
        row = (session, seq + 1, at_ms, "recovery", kind, payload, written_ms, sha256)
        connection.execute(INSERT_EVENT, row)
    return tuple(session for session, *_ in open_sessions)


def interrupted_at(connection: sqlite3.Connection, session: int) -> int:
    """Return the seq of the end of a session that was interrupted; raises UserInputError if it was not."""
    last = connection.execute(
        "SELECT seq, type, payload FROM event WHERE session = ? ORDER BY seq DESC LIMIT 1", (session,)
    ).fetchone()
    if last is None:
        raise UserInputError(f"there is no session {session}")
    seq, kind, payload = last
    if kind != SessionEnded.__name__ or json.loads(payload)["status"] != Status.INTERRUPTED.value:
        raise UserInputError(f"session {session} was not interrupted, so it cannot be gone on with")
    return int(seq)


def json_text(record: Mapping[str, Any]) -> str:
    """Return a record as it stands in the database."""
    text = json.dumps(record, ensure_ascii=False, separators=(",", ":"))
    # What the system says may hold lone surrogates, which no file can; written out, they are JSON's own escapes.
    return text.encode("utf-8", "backslashreplace").decode()


def now_ms() -> int:
    """Return the wall's clock, in ms since 1970; it may be set back, so nothing is ever sorted by it."""
    return time.time_ns() // 1_000_000


def _origin(event: Event) -> str:
    return "world" if isinstance(event, WorldEvent) else "session"


def _type_and_payload(event: Event) -> tuple[str, str]:
    """Return an event's class, and its own fields as JSON; the time and the class have columns of their own."""
    record = to_record(event)
    kind = str(record.pop("type"))
    del record["at_ms"]
    return kind, json_text(record)
