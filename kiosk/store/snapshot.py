"""A snapshot of a data folder for the console, and sessions that were interrupted."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import field
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from kiosk import UserInputError
from kiosk.experiment.booth_status import DayCounts, EndedSession, utc
from kiosk.experiment.condition import Condition
from kiosk.experiment.events import WorldEvent
from kiosk.experiment.experimenter import DEVIATIONS, AuditEvent
from kiosk.experiment.outcomes import SessionKind, Stage, Status
from kiosk.lazy_dataclass import dataclass
from kiosk.store.allocation import AllocationLists
from kiosk.store.database import open_for_reading, unreadable
from kiosk.store.listing import participant_name
from kiosk.store.participants import EnrolmentCounts, count_enrolment
from kiosk.store.recorder import Provenance
from kiosk.units import MS_PER_HOUR, MS_PER_SECOND

LAST = 8
"""How many sessions are shown."""

LOOKED_BACK = 40
"""Among how many sessions those are looked for that could go on."""


@dataclass(frozen=True)
class SnapshotSession:
    """One session in a line; ``status`` is None while it is under way, ``participant`` empty in old records."""

    number: int
    participant: str
    started_at: str
    condition: Condition
    stage: Stage | None
    status: Status | None
    robot_lost: bool
    resumable: bool
    reason: str = ""
    """Why the experimenter ended it; empty if they did not."""


@dataclass(frozen=True)
class SnapshotAuditEvent:
    """One audit event."""

    wall_ms: int
    kind: AuditEvent
    payload: dict[str, Any]


@dataclass(frozen=True)
class DashboardSnapshot:
    """The state of a data folder; sessions and notes are the newest first."""

    counts: EnrolmentCounts
    sessions: tuple[SnapshotSession, ...]
    resumable: tuple[SnapshotSession, ...]
    deviations: tuple[SnapshotAuditEvent, ...]
    packs: frozenset[tuple[str, str]] = frozenset()
    """The language and the hash of every pack of clips that spoke in the newest sessions."""
    today: DayCounts = field(default_factory=DayCounts)


def read_snapshot(folder: Path, now: datetime, *, kind: SessionKind) -> DashboardSnapshot:
    """Look at a data folder that is being written.

    The day and its deviations are those of ``now``, which has a time zone. Raises UserInputError if there is no folder
    that can be read.
    """
    with _looking_at(folder) as connection:
        seen = tuple(_seen(connection, kind=kind))
        return DashboardSnapshot(
            count_enrolment(connection, kind=kind, in_use=True),
            seen[:LAST],
            tuple(session for session in seen if session.resumable),
            tuple(_deviations(connection, _midnight_ms(now))),
            frozenset(connection.execute(_PACKS, {"kind": int(kind), "limit": LOOKED_BACK})),
            _read_day(connection, now, kind=kind)[0],
        )


def read_day(folder: Path, now: datetime, *, kind: SessionKind) -> tuple[DayCounts, tuple[EndedSession, ...]]:
    """Count the sessions that began since midnight of ``now`` (with a time zone), and list the newest that ended.

    Raises UserInputError if there is no database to read.
    """
    with _looking_at(folder) as connection:
        return _read_day(connection, now, kind=kind)


def _read_day(
    connection: sqlite3.Connection, now: datetime, *, kind: SessionKind
) -> tuple[DayCounts, tuple[EndedSession, ...]]:
    hour_ago = now.timestamp() * MS_PER_SECOND - MS_PER_HOUR
    midnight = datetime.fromtimestamp(_midnight_ms(now) / MS_PER_SECOND, UTC).isoformat(timespec="milliseconds")
    rows = connection.execute(_DAY, {"kind": int(kind), "since": midnight}).fetchall()
    begun = [_ms(began) for began, *_ in rows]
    today = [ending for _, *ending in rows]
    completed = [ended_ms for status, ended_ms, _ in today if status == Status.COMPLETED.value]
    ended = [(status, ended_ms, stage) for status, ended_ms, stage in today if status is not None]
    counts = DayCounts(
        begun=len(today),
        completed=len(completed),
        ended_early=len(ended) - len(completed),
        last_hour=sum(ended_ms >= hour_ago for ended_ms in completed),
        since=utc(round(min(begun))) if begun else None,
    )
    return counts, tuple(EndedSession(utc(ended_ms), status, stage or "") for status, ended_ms, stage in ended[:LAST])


def _midnight_ms(now: datetime) -> int:
    return round(now.replace(hour=0, minute=0, second=0, microsecond=0).timestamp() * MS_PER_SECOND)


def _ms(iso: str) -> float:
    return datetime.fromisoformat(iso).timestamp() * MS_PER_SECOND


_DAY = """
    SELECT started_at, status, ended_ms, stage FROM session
    JOIN session_summary ON session_summary.session = session.id
    WHERE kind = :kind AND started_at >= :since ORDER BY session.id DESC
"""


def last_written_ms(folder: Path) -> int:
    """When anything was written last, by the wall's clock, in ms since 1970; 0 if nothing was."""
    with _looking_at(folder) as connection:
        return _last_ms(connection)


def wrong_pins(folder: Path) -> int:
    """Return how many PINs were tried since the last right one.

    An attempt without an answer, because the kiosk was killed while it checked, counts as a wrong one.
    """
    with _looking_at(folder) as connection:
        times: int = connection.execute(
            """
            SELECT max(count(*) FILTER (WHERE type = ?), count(*) FILTER (WHERE type = ?)) FROM audit_event
            WHERE id > (SELECT coalesce(max(id), 0) FROM audit_event WHERE type = ?)
            """,
            (AuditEvent.PIN_ATTEMPTED.value, AuditEvent.PIN_REFUSED.value, AuditEvent.PIN_ACCEPTED.value),
        ).fetchone()[0]
    return times


@dataclass(frozen=True)
class OpenBreak:
    """A break between visitors that was not ended."""

    minutes: int
    back_ms: int
    """When the experimenter wanted to be back, in ms since 1970."""


LONGEST_BREAK_MS = 12 * MS_PER_HOUR
"""A break that began before that was forgotten the day before."""


def open_break(folder: Path, now_ms: int) -> OpenBreak | None:
    """Return the break that a failed kiosk left open, or None. Leaving the kiosk ends a break."""
    kinds = (AuditEvent.BREAK_BEGAN, AuditEvent.BREAK_ENDED, AuditEvent.APPLICATION_QUIT)
    with _looking_at(folder) as connection:
        row = connection.execute(
            """
            SELECT type, payload FROM audit_event WHERE type IN (?, ?, ?) AND wall_ms >= ? ORDER BY id DESC LIMIT 1
            """,
            (*(kind.value for kind in kinds), now_ms - LONGEST_BREAK_MS),
        ).fetchone()
    if row is None or row[0] != AuditEvent.BREAK_BEGAN.value:
        return None
    payload = json.loads(row[1])
    return OpenBreak(payload["minutes"], payload["back_ms"])


@contextmanager
def _looking_at(folder: Path) -> Iterator[sqlite3.Connection]:
    with closing(open_for_reading(folder)) as connection:
        try:
            yield connection
        except sqlite3.Error as error:
            raise unreadable(error, folder) from error


def _seen(connection: sqlite3.Connection, *, kind: SessionKind) -> Iterator[SnapshotSession]:
    rows = connection.execute(_SESSIONS, {"kind": int(kind), "limit": LOOKED_BACK}).fetchall()
    for place, (number, started_at, condition, site, slot, person, stage, ending, finished) in enumerate(rows):
        status = Status(ending) if ending else None
        entered = stage if status else _stage_now(connection, number)
        reached = Stage(entered) if entered else None
        cut_short = status is Status.INTERRUPTED and bool(person) and reached not in (None, Stage.GAME)
        # All events of a session are gone through for it, so it is asked of those alone that are shown.
        lost, reason = _troubles(connection, number) if place < LAST or cut_short else (False, "")
        yield SnapshotSession(
            number,
            participant_name(site, person) if person else "",
            started_at,
            Condition(condition),
            reached,
            status,
            lost,
            # Whether the slot is free is asked last: for the few that were cut short, not for all of every look.
            resumable=cut_short
            and bool(slot is None or finished or not AllocationLists(connection, site, kind=kind).is_consumed(slot)),
            reason=reason,
        )


def _stage_now(connection: sqlite3.Connection, session: int) -> str | None:
    """Return the stage of a session that is under way; its summary has one once it has ended."""
    row = connection.execute(
        "SELECT json_extract(payload, '$.stage') FROM event WHERE session = ? AND type = 'StageEntered'"
        " AND json_extract(payload, '$.stage') <> 'over' ORDER BY seq DESC LIMIT 1",
        (session,),
    ).fetchone()
    return row[0] if row else None


def _troubles(connection: sqlite3.Connection, session: int) -> tuple[bool, str]:
    """Return whether the robot was lost, and why the experimenter ended the session; "" if they did not."""
    rows = connection.execute(
        "SELECT type, json_extract(payload, '$.reason') FROM event WHERE session = ?"
        " AND type IN ('RobotDisconnected', 'AbortRequested') ORDER BY seq",
        (session,),
    ).fetchall()
    reasons = [reason or "" for kind, reason in rows if kind == "AbortRequested"]
    return len(rows) > len(reasons), reasons[-1] if reasons else ""


_SESSIONS = """
    SELECT session.id, started_at, condition, session.site, allocation_slot, participant.number, stage, status,
        game_completed
    FROM session JOIN session_summary ON session_summary.session = session.id
    LEFT JOIN participant ON participant.session = session.id
    WHERE session.kind = :kind ORDER BY session.id DESC LIMIT :limit
"""


_PACKS = """
    SELECT DISTINCT language, json_extract(event.payload, '$.pack')
    FROM event JOIN session ON session.id = event.session
    WHERE type = 'SpeechStarted' AND json_extract(event.payload, '$.pack') <> '' AND session.id IN
        (SELECT id FROM session WHERE kind = :kind ORDER BY id DESC LIMIT :limit)
"""


def _deviations(connection: sqlite3.Connection, since_ms: int) -> Iterator[SnapshotAuditEvent]:
    known = {note.value: note for note in DEVIATIONS}
    rows = connection.execute(
        "SELECT wall_ms, type, payload FROM audit_event WHERE wall_ms >= ? ORDER BY id DESC", (since_ms,)
    )
    for wall_ms, kind, payload in rows:
        if kind in known:
            yield SnapshotAuditEvent(wall_ms, known[kind], json.loads(payload))


def _last_ms(connection: sqlite3.Connection) -> int:
    # The newest rows alone: the clock may have been set back since, which is what is looked for.
    event, booth = connection.execute(
        """
        SELECT (SELECT max(wall_ms) FROM event WHERE session = (SELECT max(session) FROM event)),
            (SELECT wall_ms FROM audit_event ORDER BY id DESC LIMIT 1)
        """
    ).fetchone()
    return max(event or 0, booth or 0)


@dataclass(frozen=True)
class InterruptedSession:
    """What it followed, and what had happened to it from outside, the closing of the kiosk included."""

    number: int
    session: Provenance
    past: tuple[WorldEvent, ...]


@dataclass(frozen=True)
class UnreadableSession:
    """Why it cannot be read."""

    why: str


def read_interrupted_session(folder: Path, number: int) -> InterruptedSession | UnreadableSession:
    """Read a session; it takes its time, so it is done on a thread of its own."""
    from kiosk.store.queries import open_repository  # noqa: PLC0415 - a third of a second that opening need not pay

    try:
        with open_repository(folder) as stored:
            seen = stored.session(number)
            story = stored.story(number)
            session = Provenance(stored.plan(number), stored.seed(number), seen.embodiment, "", kind=seen.kind)
    except UserInputError as failure:
        return UnreadableSession(str(failure))
    return InterruptedSession(number, session, tuple(event for event in story if isinstance(event, WorldEvent)))
