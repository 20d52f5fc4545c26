"""Reading what is stored changes nothing, and is possible at any time."""

from __future__ import annotations

import shutil
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

from kiosk import UserInputError
from kiosk.experiment import events as happened
from kiosk.experiment.outcomes import Status
from kiosk.export.columns import ExportOption
from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import PsychDs
from kiosk.store.chain import read_heads
from kiosk.store.database import FILE
from kiosk.store.queries import open_repository
from kiosk.store.recorder import Provenance, Recorder
from tests.experiment.driver import Driver, with_memory
from tests.samples import plan

START = happened.SessionStarted(at_ms=0)


def write(folder: Path, provenance: Provenance, played: Driver) -> int:
    """Write what was played of a session."""
    with Recorder(folder) as recorder:
        return recorder.begin(provenance, played.events).session


def test_a_session_at_a_glance(folder: Path, provenance: Provenance, played: Driver) -> None:
    write(folder, provenance, played)
    with open_repository(folder) as stored:
        (session,) = stored.sessions()
    measures = played.session.measures
    assert session.to_json() == {
        "session": 1,
        "visit": 1,
        "participant": "1",
        "status": "completed",
        "stage": "questions",
        "allocation_source": None,
        "condition": "tom",
        "embodiment": "avatar",
        "flips": measures.flips,
        "moves": measures.moves,
        "pairs": 12,
        "hints": measures.hints,
        "duration_s": round(played.events[-1].at_ms / 1000),
        "simulated": True,
        "trial": False,
        "record_sha256": read_heads(folder)[0].hash.hex(),
    }


def test_the_events_of_a_session_as_the_command_line_prints_them(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        number = recorder.begin(provenance, [START]).session
        recorder.append([happened.TimerExpired(at_ms=9, timer=happened.Timer.IDLE), happened.IdleTimedOut(at_ms=9)])
        with open_repository(folder) as stored:
            assert stored.records(number) == [
                {"seq": 1, "at_ms": 0, "type": "SessionStarted", "origin": "world", "setup": None},
                {"seq": 2, "at_ms": 9, "type": "TimerExpired", "origin": "world", "timer": "idle"},
                {"seq": 3, "at_ms": 9, "type": "IdleTimedOut", "origin": "session"},
            ]


@pytest.mark.parametrize(
    ("status", "word"),
    [(Status.COMPLETED, "completed"), (Status.ABANDONED, "abandoned"), (Status.INTERRUPTED, "interrupted")],
)
def test_a_session_ended_as_it_says(folder: Path, provenance: Provenance, status: Status, word: str) -> None:
    with Recorder(folder) as recorder:
        number = recorder.begin(provenance, [START, happened.SessionEnded(at_ms=1, status=status)]).session
        with open_repository(folder) as stored:
            assert stored.session(number).status is status
            assert stored.session(number).to_json()["status"] == word


def test_while_somebody_writes_a_session_without_an_end_is_running(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        number = recorder.begin(provenance, [START]).session
        with open_repository(folder) as stored:
            assert stored.session(number).status is None
            assert stored.session(number).to_json()["status"] == "running"
            recorder.append([happened.ContinuePressed(at_ms=4)])
            assert len(stored.events(number)) == 2
        recorder.append([happened.ContinuePressed(at_ms=5)])


def test_after_a_crash_it_was_interrupted_though_nobody_has_said_so_yet(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        number = recorder.begin(provenance, [START]).session
    with open_repository(folder) as stored:
        assert stored.session(number).status is Status.INTERRUPTED
        assert [event for event in stored.events(number) if isinstance(event, happened.SessionEnded)] == []


def test_looking_changes_nothing(folder: Path, provenance: Provenance, played: Driver) -> None:
    write(folder, provenance, played)
    before = (folder / FILE).read_bytes()
    with open_repository(folder) as stored:
        stored.sessions()
        stored.records(1)
        stored.plan(1)
    assert (folder / FILE).read_bytes() == before


def test_looking_at_what_a_crash_left_changes_nothing_either(
    folder: Path, tmp_path: Path, provenance: Provenance
) -> None:
    """A copy made during a write is what a power cut leaves: a database and its log."""
    crashed = tmp_path / "crashed"
    with Recorder(folder) as recorder:
        recorder.begin(provenance, [START])
        shutil.copytree(folder, crashed)
    kept = {name: (crashed / name).read_bytes() for name in (FILE, f"{FILE}-wal")}
    assert kept[f"{FILE}-wal"]
    for _ in range(2):
        with open_repository(crashed) as stored:
            assert stored.session(1).status is Status.INTERRUPTED
            assert stored.events(1) == [START]
    assert {name: (crashed / name).read_bytes() for name in kept} == kept
    with Recorder(crashed) as recorder:
        assert recorder.recovered == (1,)


def test_looking_does_not_keep_anybody_from_writing(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, [START])
    with open_repository(folder) as stored:
        assert len(stored.sessions()) == 1
        with Recorder(folder) as recorder:
            recorder.begin(provenance, [START])
        assert len(stored.sessions()) == 2


def test_sessions_stand_in_the_order_in_which_they_began(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        numbers = [recorder.begin(provenance, [START]).session for _ in range(12)]
        with open_repository(folder) as stored:
            assert [session.id for session in stored.sessions()] == numbers == list(range(1, 13))


def test_a_session_that_does_not_exist_is_refused_in_words(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, [START])
    with open_repository(folder) as stored:
        for look in (stored.session, stored.records, stored.events, stored.plan, stored.seed):
            with pytest.raises(UserInputError, match="there is no session 2"):
                look(2)


def test_what_was_never_kept_is_refused_in_words(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, [START])
    with open_repository(folder) as stored, pytest.raises(UserInputError, match="nothing is kept under the hash abc"):
        stored.source("abc")


def test_what_a_session_followed_can_be_rebuilt(folder: Path, provenance: Provenance, played: Driver) -> None:
    number = write(folder, provenance, played)
    with open_repository(folder) as stored:
        rebuilt, seed = stored.plan(number), stored.seed(number)
    plan = provenance.plan
    assert seed == provenance.seed
    assert (rebuilt.settings, rebuilt.condition, rebuilt.policy) == (plan.settings, plan.condition, plan.policy)
    assert (rebuilt.about_you, rebuilt.questionnaires) == (plan.about_you, plan.questionnaires)
    assert (rebuilt.information, rebuilt.deck, rebuilt.practice_deck) == (
        plan.information,
        plan.deck,
        plan.practice_deck,
    )
    assert (rebuilt.catalogue.language, rebuilt.catalogue.sources) == (plan.catalogue.language, plan.catalogue.sources)


def test_every_session_has_its_own_measures(folder: Path, provenance: Provenance) -> None:
    measures = []
    with Recorder(folder) as recorder:
        for seed in range(3):
            driver = Driver(plan(), seed)
            driver.to_the_game()
            driver.play(with_memory(seed))
            measures.append(driver.session.measures)
            recorder.begin(provenance, [event for step in driver.steps for event in (step.event, *step.outcome.events)])
        with open_repository(folder) as stored:
            told = [(session.flips, session.moves, session.pairs, session.hints) for session in stored.sessions()]
    assert told == [(each.flips, each.moves, each.pairs, each.hints) for each in measures]


def test_a_database_that_is_damaged_is_refused_in_words(
    folder: Path, provenance: Provenance, played: Driver, tmp_path: Path
) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, played.events)
    damage(folder / FILE, "event")
    with pytest.raises(UserInputError, match="cannot be read"), open_repository(folder) as stored:
        stored.events(1)
    with pytest.raises(UserInputError, match="cannot be read"):
        export_dataset(folder, tmp_path / "out", PsychDs, frozenset({ExportOption.REHEARSALS}))
    assert not (tmp_path / "out").exists()


def damage(database: Path, table: str) -> None:
    """Write over the first page of a table."""
    with closing(sqlite3.connect(database)) as connection:
        [page] = connection.execute("SELECT rootpage FROM sqlite_master WHERE name = ?", (table,)).fetchone()
        [size] = connection.execute("PRAGMA page_size").fetchone()
    with database.open("r+b") as file:
        file.seek((page - 1) * size)
        file.write(b"\xff" * size)
