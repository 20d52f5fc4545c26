"""A session that was cut off can be gone on with, be cut off again, and ends where its last event says."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import pytest

from kiosk import UserInputError
from kiosk.experiment import events as happened
from kiosk.experiment.condition import Condition
from kiosk.experiment.outcomes import AllocationSource, SessionKind, Status
from kiosk.store.database import FILE
from kiosk.store.queries import open_repository
from kiosk.store.recorder import Provenance, Recorder

START = happened.SessionStarted(at_ms=0)
ON = happened.ContinuePressed(at_ms=90)
END = happened.SessionEnded(at_ms=99, status=Status.COMPLETED)


def kinds(folder: Path, number: int) -> list[tuple[int, str]]:
    """Return the events of a session by seq and type."""
    with closing(sqlite3.connect(folder / FILE)) as connection:
        return connection.execute("SELECT seq, type FROM event WHERE session = ? ORDER BY seq", (number,)).fetchall()


def status(folder: Path, number: int = 1) -> Status | None:
    """How a session ended, as a reader sees it."""
    with open_repository(folder) as stored:
        return stored.session(number).status


def cut_off(folder: Path, provenance: Provenance) -> None:
    """Store a session that has no end, and one more that has."""
    with Recorder(folder) as recorder:
        recorder.begin(provenance, [START, happened.ContinuePressed(at_ms=70)])
    with Recorder(folder) as recorder:
        recorder.begin(provenance, [START, END])


def test_its_next_events_follow_its_last_one(folder: Path, provenance: Provenance) -> None:
    cut_off(folder, provenance)
    with Recorder(folder) as recorder:
        participant = recorder.resume(1)
        assert (participant.session, participant.number) == (1, 1)
        recorder.append([ON])
        recorder.append([END])
        assert recorder.sessions_recorded == 1
    assert kinds(folder, 1) == [
        (1, "SessionStarted"),
        (2, "ContinuePressed"),
        (3, "SessionEnded"),
        (4, "ContinuePressed"),
        (5, "SessionEnded"),
    ]
    assert kinds(folder, 2) == [(1, "SessionStarted"), (2, "SessionEnded")]


def test_its_status_is_what_its_last_event_says(folder: Path, provenance: Provenance) -> None:
    cut_off(folder, provenance)
    assert status(folder) is Status.INTERRUPTED
    with Recorder(folder) as recorder:
        recorder.resume(1)
        assert status(folder) is Status.INTERRUPTED
        recorder.append([ON])
        assert status(folder) is None
        recorder.append([END])
        assert status(folder) is Status.COMPLETED


def test_it_can_be_cut_off_again(folder: Path, provenance: Provenance) -> None:
    cut_off(folder, provenance)
    with Recorder(folder) as recorder:
        recorder.resume(1)
        recorder.append([ON])
    assert status(folder) is Status.INTERRUPTED
    with Recorder(folder) as recorder:
        assert recorder.recovered == (1,)
        recorder.resume(1)
    assert [kind for _, kind in kinds(folder, 1)].count("SessionEnded") == 2
    with Recorder(folder) as recorder:
        assert recorder.recovered == ()


def test_what_was_under_way_is_ended_when_another_is_gone_on_with(folder: Path, provenance: Provenance) -> None:
    cut_off(folder, provenance)
    with Recorder(folder) as recorder:
        recorder.begin(provenance, [START])
        recorder.resume(1)
        recorder.append([ON, END])
    assert kinds(folder, 3) == [(1, "SessionStarted"), (2, "SessionEnded")]
    assert status(folder, 1) is Status.COMPLETED


def test_one_whose_end_the_disk_did_not_take_can_be_gone_on_with_at_once(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, [START])
        recorder.resume(1)
        recorder.append([ON])
    assert kinds(folder, 1) == [(1, "SessionStarted"), (2, "SessionEnded"), (3, "ContinuePressed")]


def test_one_that_ended_otherwise_is_left_alone(folder: Path, provenance: Provenance) -> None:
    cut_off(folder, provenance)
    with Recorder(folder) as recorder:
        recorder.begin(provenance, [START])
        with pytest.raises(UserInputError, match="session 2 was not interrupted, so it cannot be gone on with"):
            recorder.resume(2)
        with pytest.raises(UserInputError, match="there is no session 9"):
            recorder.resume(9)
        recorder.append([ON])
    assert kinds(folder, 3) == [(1, "SessionStarted"), (2, "ContinuePressed")]


def test_one_whose_place_was_given_out_again_is_left_alone(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.create_allocation_list({Condition.TOM: 2}, 1, 1, kind=SessionKind.SIMULATED)
        placed = replace(
            provenance, slot=recorder.next_slot(kind=SessionKind.SIMULATED), allocation_source=AllocationSource.LIST
        )
        for _ in range(2):
            recorder.begin(placed, [START])
        recorder.resume(1)
        recorder.append([happened.GameFinished(at_ms=9)])
        with pytest.raises(UserInputError, match="the slot of session 2 was given out again"):
            recorder.resume(2)
        assert recorder.resume(1).session == 1
