"""The summaries of sessions and their counts say what the events say, whatever happens to a session."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from dataclasses import replace
from datetime import date, timedelta
from pathlib import Path

import pytest

from kiosk.experiment import events as happened
from kiosk.experiment.condition import Condition
from kiosk.experiment.outcomes import AllocationSource, Disposition, EmbodimentName, SessionKind, Stage, Status
from kiosk.experiment.projections import measure
from kiosk.store.allocation import AllocationLists
from kiosk.store.database import FILE
from kiosk.store.listing import RUNNING, SessionFilter
from kiosk.store.queries import open_repository
from kiosk.store.recorder import Provenance, Recorder
from kiosk.store.verify import Verification, verify
from kiosk.store.withdrawal import withdraw
from tests.experiment.driver import Driver, with_memory
from tests.samples import whole
from tests.store.visitors import BEGUN, COMPLETED, FINISHED, FOUR, LEFT, seated

KIND = SessionKind.SIMULATED
COLUMNS = "status, game_completed, stage, flips, pairs, hints, duration_ms"


def summary(folder: Path, session: int = 1) -> tuple[object, ...]:
    """Return what is kept of a session at a glance."""
    with closing(sqlite3.connect(folder / FILE)) as connection:
        query = f"SELECT {COLUMNS} FROM session_summary WHERE session = ?"  # noqa: S608
        return tuple(connection.execute(query, (session,)).fetchone())


def flaws(folder: Path) -> list[str]:
    """Return what ``verify`` finds wrong with the summaries."""
    return [flaw.what for flaw in verify(folder) if flaw.check is Verification.SUMMARIES]


def change(folder: Path, statement: str) -> None:
    """Change what is kept."""
    with closing(sqlite3.connect(folder / FILE)) as connection, connection:
        connection.execute(statement)


def test_the_practice_is_no_part_of_the_game_s_numbers(folder: Path, provenance: Provenance) -> None:
    driver = Driver(whole(), 3)
    driver.to(Stage.PRACTICE)
    driver.flip(driver.view.closed[0])
    driver.to_the_game()
    driver.play(with_memory(3))
    driver.end()
    with Recorder(folder) as recorder:
        recorder.begin(replace(provenance, plan=driver.plan), driver.events)
    played = measure(driver.events)
    kept = summary(folder)
    assert kept[3:] == (played.flips, played.pairs, played.hints, driver.events[-1].at_ms)
    assert (kept[1], played.pairs) == (1, 12)
    assert flaws(folder) == []


def test_a_session_under_way_has_numbers_and_no_status(folder: Path, provenance: Provenance, played: Driver) -> None:
    last = next(n for n, event in enumerate(played.events) if isinstance(event, happened.CardFlipped) and event.matched)
    with Recorder(folder) as recorder:
        recorder.begin(provenance, played.events[: last + 1])
        with open_repository(folder) as stored:
            (session,) = stored.sessions(SessionFilter(status=RUNNING))
            assert stored.totals().by_status == {RUNNING: 1}
        assert (session.status, session.pairs, session.flips % 2) == (None, 1, 0)
        assert summary(folder)[0] is None
    assert flaws(folder) == []
    with open_repository(folder) as stored:
        assert [each.id for each in stored.sessions(SessionFilter(status="interrupted"))] == [1]
        assert stored.sessions(SessionFilter(status=RUNNING)) == []


def test_a_session_that_was_resumed_is_under_way_until_it_ends_again(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, FINISHED)
    with Recorder(folder) as recorder:
        assert recorder.recovered == (1,)
        recorder.resume(1)
        recorder.append([happened.SessionResumed(at_ms=6, embodiment=EmbodimentName.AVATAR)])
        assert summary(folder)[:2] == (None, 1)
        recorder.append([happened.SessionEnded(at_ms=9, status=Status.COMPLETED)])
        assert summary(folder)[:2] == ("completed", 1)
    assert flaws(folder) == []


def test_counts_follow_every_outcome_and_a_withdrawal(folder: Path, provenance: Provenance) -> None:
    study = SessionKind.STUDY
    with Recorder(folder) as recorder:
        recorder.create_allocation_list(FOUR, 4, 1, kind=study)
        for events in (COMPLETED, LEFT, COMPLETED):
            seated(recorder, provenance, events, kind=study)
        seated(recorder, provenance, kind=study, allocation_source=AllocationSource.BEYOND)
        seated(recorder, provenance, BEGUN, kind=study)
        with open_repository(folder) as stored:
            cells = stored.counts(kind=study).cells.values()
    fates = {fate: sum(cell.fates[fate] for cell in cells) for fate in Disposition}
    assert {fate: number for fate, number in fates.items() if number} == {
        Disposition.CONSUMED: 2,
        Disposition.DROPPED_OUT: 1,
        Disposition.UNDER_WAY: 1,
        Disposition.BEYOND: 1,
    }
    withdraw(folder, 1)
    with open_repository(folder) as stored:
        after = stored.counts(kind=study).cells.values()
    assert sum(cell.fates[Disposition.CONSUMED] for cell in after) == 2
    assert sum(cell.withdrawn for cell in after) == 1
    assert flaws(folder) == []


def test_a_slot_that_was_left_free_in_between_comes_next(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.create_allocation_list(FOUR, 4, 1, kind=KIND)
        assert [seated(recorder, provenance).number for _ in range(2)] == [1, 2]  # type: ignore[union-attr]
        slots = AllocationLists(recorder._connection, "", kind=KIND).latest()
        assert slots is not None
        fourth = slots.slots[3]
        plan = replace(provenance.plan, condition=fourth.condition)
        session = replace(provenance, plan=plan, slot=fourth, allocation_source=AllocationSource.LIST, kind=KIND)
        recorder.begin(session, COMPLETED)
        following = [seated(recorder, provenance) for _ in range(5)]
        assert [slot and slot.number for slot in following] == [3, 5, 6, 7, 8]
        assert recorder.next_slot(kind=KIND) is None


@pytest.mark.parametrize(
    ("statement", "what"),
    [
        ("UPDATE session_summary SET flips = flips + 1", "is not what its events say: flips"),
        ("UPDATE session_tally SET sessions = sessions + 1", "are not what the summaries say"),
        ("DELETE FROM session_summary", "is not what its events say: status"),
    ],
)
def test_verify_finds_a_summary_that_is_wrong(folder: Path, provenance: Provenance, statement: str, what: str) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, COMPLETED)
    assert flaws(folder) == []
    change(folder, statement)
    assert any(found.startswith(what) for found in flaws(folder))


def test_sessions_are_found_by_what_is_asked_for(folder: Path, provenance: Provenance) -> None:
    notom = replace(provenance, plan=replace(provenance.plan, condition=Condition.NOTOM), kind=SessionKind.STUDY)
    with Recorder(folder, "MI") as recorder:
        for each, events in ((provenance, COMPLETED), (notom, LEFT), (notom, COMPLETED)):
            recorder.begin(each, events)
    today = date.today()
    day = timedelta(days=1)
    asked = {
        SessionFilter(): [1, 2, 3],
        SessionFilter(kind=SessionKind.STUDY): [2, 3],
        SessionFilter(condition="tom"): [1],
        SessionFilter(status="completed", kind=SessionKind.STUDY): [3],
        SessionFilter(site="MI"): [1, 2, 3],
        SessionFilter(site="RM"): [],
        SessionFilter(since=today, until=today): [1, 2, 3],
        SessionFilter(since=today + day): [],
        SessionFilter(until=today - day): [],
    }
    with open_repository(folder) as stored:
        assert {which: [each.id for each in stored.sessions(which)] for which in asked} == asked
        assert [each.id for each in stored.sessions(newest=2)] == [2, 3]
        assert [each.id for each in stored.sessions(newest=2, skip=2)] == [1]
        assert stored.totals(SessionFilter(kind=SessionKind.STUDY)).by_status == {"completed": 1, "abandoned": 1}
        assert stored.totals().median_ms == COMPLETED[-1].at_ms
