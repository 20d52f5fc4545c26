"""What the experimenter sees at a glance, read in a few milliseconds while a recorder writes; nothing is changed.

It opens its own connection for each look, so it may run in any thread.
"""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from kiosk.store.database import open_for_reading, unreadable
from kiosk.store.people.counting import Counts, counts
from kiosk.store.people.lists import Lists
from kiosk.store.people.participants import participant_name
from kiosk.study.booth.notes import DEVIATIONS, Note
from kiosk.study.booth.pin import Wrong
from kiosk.study.condition import Condition
from kiosk.study.events import Stage, Status
from kiosk.study.session_kind import SessionKind

LAST = 8
"""How many sittings are shown."""

LOOKED_BACK = 40
"""Among how many sittings those are looked for that could go on."""


@dataclass(frozen=True)
class Seen:
    """One sitting in a line; ``status`` is None while it is under way, ``participant`` empty in old records."""

    number: int
    participant: str
    started_at: str
    condition: Condition
    stage: Stage | None
    status: Status | None
    robot_lost: bool
    resumable: bool


@dataclass(frozen=True)
class Noted:
    """One booth event."""

    wall_ms: int
    note: Note
    body: dict[str, Any]


@dataclass(frozen=True)
class Glance:
    """The state of a data folder; sittings and notes are the newest first."""

    counts: Counts
    sittings: tuple[Seen, ...]
    resumable: tuple[Seen, ...]
    deviations: tuple[Noted, ...]


def glance(folder: Path, since_ms: int, *, simulated: bool | SessionKind) -> Glance:
    """Look at a data folder that is being written; deviations are those since ``since_ms``.

    Raises BadInput if there is none that can be read.
    """
    with _looking_at(folder) as connection:
        seen = tuple(_seen(connection, simulated=simulated))
        return Glance(
            counts(connection, simulated=simulated, in_use=True),
            seen[:LAST],
            tuple(sitting for sitting in seen if sitting.resumable),
            tuple(_deviations(connection, since_ms)),
        )


def last_written_ms(folder: Path) -> int:
    """When anything was written last, by the wall's clock, in ms since 1970; 0 if nothing was."""
    with _looking_at(folder) as connection:
        return _last_ms(connection)


def wrong_pins(folder: Path) -> Wrong:
    """The wrong PINs since the last right one."""
    with _looking_at(folder) as connection:
        times, last_ms = connection.execute(
            """
            SELECT count(*), coalesce(max(wall_ms), 0) FROM booth_event WHERE type = ?
            AND id > (SELECT coalesce(max(id), 0) FROM booth_event WHERE type = ?)
            """,
            (Note.PIN_REFUSED.value, Note.PIN_ACCEPTED.value),
        ).fetchone()
    return Wrong(times, last_ms)


@contextmanager
def _looking_at(folder: Path) -> Iterator[sqlite3.Connection]:
    with closing(open_for_reading(folder)) as connection:
        try:
            yield connection
        except sqlite3.Error as error:
            raise unreadable(error, folder) from error


def _seen(connection: sqlite3.Connection, *, simulated: bool | SessionKind) -> Iterator[Seen]:
    rows = connection.execute(_SITTINGS, {"simulated": int(simulated), "limit": LOOKED_BACK}).fetchall()
    for number, started_at, condition, site, place, person, stage, ending, lost, finished in rows:
        status = Status(ending) if ending else None
        reached = Stage(stage) if stage else None
        lists = Lists(connection, site, simulated=simulated)
        cut_short = status is Status.INTERRUPTED and bool(person) and reached not in (None, Stage.GAME)
        yield Seen(
            number,
            participant_name(site, person) if person else "",
            started_at,
            Condition(condition),
            reached,
            status,
            bool(lost),
            # Whether the place is free is asked last: for the few that were cut short, not for all of every look.
            resumable=cut_short and bool(place is None or finished or place not in lists.consumed()),
        )


_SITTINGS = """
    SELECT sitting.id, started_at, condition, sitting.site, place, participant.number,
        (SELECT json_extract(body, '$.stage') FROM event WHERE event.sitting = sitting.id AND type = 'StageEntered'
            AND json_extract(body, '$.stage') <> 'over' ORDER BY seq DESC LIMIT 1),
        (SELECT CASE type WHEN 'SittingEnded' THEN json_extract(body, '$.status') END
            FROM event WHERE event.sitting = sitting.id ORDER BY seq DESC LIMIT 1),
        EXISTS (SELECT 1 FROM event WHERE event.sitting = sitting.id AND type = 'RobotLost'),
        EXISTS (SELECT 1 FROM event WHERE event.sitting = sitting.id AND type = 'GameFinished')
    FROM sitting LEFT JOIN participant ON participant.sitting = sitting.id
    WHERE sitting.simulated = :simulated ORDER BY sitting.id DESC LIMIT :limit
"""


def _deviations(connection: sqlite3.Connection, since_ms: int) -> Iterator[Noted]:
    known = {note.value: note for note in DEVIATIONS}
    rows = connection.execute(
        "SELECT wall_ms, type, body FROM booth_event WHERE wall_ms >= ? ORDER BY id DESC", (since_ms,)
    )
    for wall_ms, kind, body in rows:
        if kind in known:
            yield Noted(wall_ms, known[kind], json.loads(body))


def _last_ms(connection: sqlite3.Connection) -> int:
    # The newest rows alone: the clock may have been set back since, which is what is looked for.
    event, booth = connection.execute(
        """
        SELECT (SELECT max(wall_ms) FROM event WHERE sitting = (SELECT max(sitting) FROM event)),
            (SELECT wall_ms FROM booth_event ORDER BY id DESC LIMIT 1)
        """
    ).fetchone()
    return max(event or 0, booth or 0)
