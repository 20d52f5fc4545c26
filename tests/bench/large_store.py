"""A data folder with as many sessions as are asked for: games that were really played, written down again and again."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import closing
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from itertools import cycle
from pathlib import Path

from kiosk.experiment.condition import Condition
from kiosk.experiment.outcomes import AllocationSource, SessionKind
from kiosk.store.allocation import AllocationLists
from kiosk.store.chain import EventFields, first_hash, next_hash
from kiosk.store.database import FILE, open_for_writing
from kiosk.store.recorder import Provenance, Recorder
from kiosk.store.remnants import clear_remnants
from tests.experiment.driver import Driver, with_memory
from tests.samples import mixed, plan

PLAYED = 4
"""Different games; the others say the same as one of these, with other numbers, codes and times."""
BEGAN = datetime(2026, 5, 1, 8, tzinfo=UTC)
A_SESSION = timedelta(minutes=12)


def fill(folder: Path, sessions: int) -> None:
    """Write a study of this many completed sessions, at least PLAYED."""
    quotas = {Condition.TOM: sessions, Condition.NOTOM: sessions}
    with Recorder(folder) as recorder:
        recorder.create_allocation_list(quotas, 4, 1, kind=SessionKind.STUDY)
        for seed in range(PLAYED):
            slot = recorder.next_slot(kind=SessionKind.STUDY)
            assert slot is not None
            driver = Driver(plan(slot.condition, mixed(seed)), seed)
            driver.whole_session(with_memory(seed))
            source = Provenance(driver.plan, seed, "avatar", "a bench", SessionKind.STUDY)
            recorder.begin(replace(source, slot=slot, allocation_source=AllocationSource.LIST), driver.events)
    with closing(open_for_writing(folder)) as connection:
        connection.execute("PRAGMA cache_size = -65536")
        connection.execute("PRAGMA synchronous = OFF")
        connection.execute("BEGIN")
        names = [row[1] for row in connection.execute("PRAGMA table_info(session)")]
        kept = ", ".join(name for name in names if name not in ("id", "started_at", "seed", "allocation_slot"))
        games = [connection.execute(_EVENTS, (first,)).fetchall() for first in range(1, PLAYED + 1)]
        listed = AllocationLists(connection, "", kind=SessionKind.STUDY).latest()
        assert listed is not None
        first_played: dict[Condition, list[int]] = {condition: [] for condition in quotas}
        for slot in listed.slots[:PLAYED]:
            first_played[slot.condition].append(slot.number)
        playing = {condition: cycle(numbers) for condition, numbers in first_played.items()}
        for number in range(PLAYED + 1, sessions + 1):
            first = next(playing[listed.slots[number - 1].condition])
            began = (BEGAN + number * A_SESSION).isoformat(timespec="milliseconds")
            connection.execute(
                f"INSERT INTO session (id, started_at, seed, allocation_slot, {kept})"  # noqa: S608 - ours
                f" SELECT ?, ?, ?, ?, {kept} FROM session WHERE id = ?",
                (number, began, number, number, first),
            )
            connection.executemany(_INSERT_EVENT, _chained(number, games[first - 1], first_hash(connection, number)))
            connection.execute("INSERT INTO participant VALUES (?, '', 0, ?, 1)", (number, number))
            connection.execute("INSERT INTO withdrawal_code VALUES (randomblob(32), ?)", (number,))
        connection.execute("COMMIT")
    # A kiosk does this bit by bit, whenever it is closed.
    clear_remnants(folder / FILE)


_EVENTS = "SELECT seq, at_ms, origin, type, wall_ms, payload FROM event WHERE session = ? ORDER BY seq"
_INSERT_EVENT = (
    "INSERT INTO event (session, seq, at_ms, origin, type, wall_ms, payload, hash) VALUES (?, ?, ?, ?, ?, ?, ?, ?)"
)


def _chained(session: int, events: Sequence[EventFields], before: bytes) -> Iterator[tuple[object, ...]]:
    """Yield the rows of a session's events, each chained to the one before."""
    for event in events:
        before = next_hash(before, event)
        yield (session, *event, before)
