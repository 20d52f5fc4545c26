"""What older programs wrote is opened, brought up to date, and tells the same as it told then."""

from __future__ import annotations

import shutil
import sqlite3
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import pytest

from kiosk.store.care.verify import verify
from kiosk.store.care.withdraw import withdraw
from kiosk.store.database import FILE
from kiosk.store.migrations import MIGRATIONS, SCHEMA
from kiosk.store.reading import archive
from kiosk.store.recorder import Provenance, Recorder
from kiosk.study.after.measures import Measures
from kiosk.study.events import StartTapped, Status
from kiosk.study.session_kind import SessionKind

MUSEUM = Path(__file__).parent / "museum"


@pytest.fixture
def first(folder: Path) -> Path:
    """A data folder as the first schema left it."""
    folder.mkdir()
    shutil.copy(MUSEUM / "schema-1.db", folder / FILE)
    return folder


def test_the_first_schema_takes_the_steps_it_lacks(first: Path) -> None:
    with Recorder(first) as recorder:
        assert recorder.recovered == (3,)
    with closing(sqlite3.connect(first / FILE)) as connection:
        receipts = connection.execute("SELECT number, name, sha256 FROM migration ORDER BY number").fetchall()
        assert connection.execute("PRAGMA integrity_check").fetchall() == [("ok",)]
        assert connection.execute("PRAGMA foreign_key_check").fetchall() == []
        assert connection.execute("PRAGMA user_version").fetchall() == [(SCHEMA,)]
    assert receipts == [(step.number, step.name, step.sha256) for step in MIGRATIONS]


def test_its_sittings_are_listed_and_measured_as_they_were(first: Path) -> None:
    with Recorder(first), archive(first) as stored:
        completed, marked, cut_off = stored.sittings()
        assert [len(stored.events(sitting.id)) for sitting in (completed, marked, cut_off)] == [206, 3, 3]
    assert completed.measures == Measures(
        flips=40,
        moves=20,
        pairs=12,
        hints=8,
        completion_ms=98044,
        completion_without_speech_ms=46636,
        assistance_per_flip=0.1375,
        followed=1.0,
        first_followed=1.0,
        first_led_to_match=1.0,
    )
    assert completed.started_at == "2026-11-22T13:22:35.926+00:00"
    assert [sitting.status for sitting in (completed, marked, cut_off)] == [
        Status.COMPLETED,
        Status.INTERRUPTED,
        Status.INTERRUPTED,
    ]
    assert [(sitting.participant, sitting.allotted) for sitting in (completed, marked, cut_off)] == [(None, None)] * 3


def test_its_events_are_as_they_were(first: Path) -> None:
    columns = "sitting, seq, at_ms, origin, type, body"
    query = f"SELECT {columns} FROM event ORDER BY sitting, seq"  # noqa: S608 - the names are ours
    with closing(sqlite3.connect(first / FILE)) as connection:
        before = connection.execute(query).fetchall()
    with Recorder(first), closing(sqlite3.connect(first / FILE)) as connection:
        after = connection.execute(query).fetchall()
    assert after[: len(before)] == before
    assert [kind for *_, kind, _ in after[len(before) :]] == ["SittingEnded"]


def test_new_sittings_follow_the_old_ones(first: Path, provenance: Provenance) -> None:
    with Recorder(first) as recorder:
        participant = recorder.begin(provenance, [StartTapped(at_ms=0)])
    assert (participant.sitting, participant.number) == (4, 1)


def test_it_is_read_before_it_is_brought_up_to_date(first: Path) -> None:
    """Looking may not migrate, and old data may lie where nobody may write."""
    before = (first / FILE).read_bytes()
    with archive(first) as stored:
        assert stored.sitting(1).status is Status.COMPLETED
        assert stored.sitting(1).participant is None
    assert (first / FILE).read_bytes() == before


@pytest.fixture(params=["schema-2.db", "schema-3.db"])
def later(folder: Path, request: pytest.FixtureRequest) -> Path:
    """A data folder as a later schema left it."""
    folder.mkdir()
    shutil.copy(MUSEUM / request.param, folder / FILE)
    return folder


def test_a_later_schema_takes_the_steps_it_lacks_and_is_sound_before_and_after(later: Path) -> None:
    assert verify(later) == []
    with archive(later) as stored:
        before = stored.sittings()
    with Recorder(later) as recorder:
        assert recorder.recovered == ()
    assert verify(later) == []
    with archive(later) as stored:
        assert stored.sittings() == before
        assert [(sitting.id, sitting.participant, sitting.status) for sitting in before] == [
            (1, "1", Status.COMPLETED),
            (3, "3", Status.ABANDONED),
        ]
        assert stored.counts(simulated=True).cells
    with closing(sqlite3.connect(later / FILE)) as connection:
        assert connection.execute("PRAGMA user_version").fetchall() == [(SCHEMA,)]
        assert connection.execute("SELECT sitting FROM tombstone").fetchall() == [(2,)]


def test_a_participant_of_a_later_schema_can_withdraw(later: Path) -> None:
    withdraw(later, "GJ6EESU")
    assert verify(later) == []
    with archive(later) as stored:
        assert [sitting.id for sitting in stored.sittings()] == [3]


def test_a_database_from_before_trials_takes_them_and_nothing_else_that_it_does_not_know(
    first: Path, provenance: Provenance
) -> None:
    with Recorder(first) as recorder:
        recorder.begin(replace(provenance, simulated=SessionKind.TRIAL), [StartTapped(at_ms=0)])
    with archive(first) as stored:
        assert [sitting.kind for sitting in stored.sittings()] == [*[SessionKind.SIMULATED] * 3, SessionKind.TRIAL]
    with (
        closing(sqlite3.connect(first / FILE)) as connection,
        pytest.raises(sqlite3.IntegrityError, match="CHECK constraint failed"),
    ):
        connection.execute("INSERT INTO visit (why, simulated) VALUES ('left', 3)")
