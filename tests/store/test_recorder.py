"""What happened is on the disk when it is acknowledged, whole, once, and for ever."""

from __future__ import annotations

import json
import os
import signal
import sqlite3
import threading
import time
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from random import Random
from typing import Any

import pytest

from kiosk import StorageError, UserInputError, __version__
from kiosk.experiment import events as happened
from kiosk.experiment.condition import Condition
from kiosk.experiment.events import Event
from kiosk.experiment.outcomes import NotRecordedReason, SessionKind, Status
from kiosk.experiment.questionnaire import QUESTIONNAIRES
from kiosk.game import Position
from kiosk.store import recorder as recorder_module
from kiosk.store.database import FILE, open_for_writing
from kiosk.store.queries import open_repository
from kiosk.store.recorder import Provenance, Recorder, StoreBusy
from tests import patience
from tests.experiment.driver import Driver, replay
from tests.patience import PATIENCE_S, Program
from tests.store.writer import GONE

A_TOMBSTONE = (
    "INSERT INTO tombstone VALUES (:session, '', :session, 1, 'tom', NULL, NULL, NULL, 'completed', 1, '2026-01-31', 1)"
)
START = happened.SessionStarted(at_ms=0)


def rows(folder: Path, query: str) -> list[tuple[Any, ...]]:
    """Return what stands in the database of a folder."""
    with closing(sqlite3.connect(folder / FILE)) as connection:
        return connection.execute(query).fetchall()


def write(recorder: Recorder, provenance: Provenance, played: Driver) -> int:
    """Write a session as it is played: a transaction for every event and what followed from it."""
    first, *others = played.steps
    number = recorder.begin(provenance, [first.event, *first.outcome.events]).session
    for step in others:
        recorder.append([step.event, *step.outcome.events])
    return number


def limited(connection: sqlite3.Connection) -> None:
    """Fill the disk: the database may grow no further."""
    pages = connection.execute("PRAGMA page_count").fetchone()[0]
    connection.execute(f"PRAGMA max_page_count = {pages}")


def unlimited(connection: sqlite3.Connection) -> None:
    """Make room again."""
    connection.execute("PRAGMA max_page_count = 1000000")


@pytest.fixture
def connections(monkeypatch: pytest.MonkeyPatch) -> list[sqlite3.Connection]:
    """Return the connections of every recorder opened from here on, for a test to look at or to limit."""
    opened: list[sqlite3.Connection] = []

    def opening(folder: Path) -> sqlite3.Connection:
        opened.append(open_for_writing(folder))
        return opened[-1]

    monkeypatch.setattr(recorder_module, "open_for_writing", opening)
    return opened


def many(size: int) -> list[Event]:
    """Events that need a good deal of room."""
    return [happened.SpeechFailed(at_ms=number, utterance=number, why="x" * 1000) for number in range(size)]


# What is written


def test_a_session_comes_back_as_it_was_written(folder: Path, provenance: Provenance, played: Driver) -> None:
    with Recorder(folder) as recorder:
        number = write(recorder, provenance, played)
    with open_repository(folder) as stored:
        assert stored.events(number) == played.events


def test_a_stored_session_can_be_replayed_from_the_database_alone(
    folder: Path, provenance: Provenance, played: Driver
) -> None:
    with Recorder(folder) as recorder:
        number = write(recorder, provenance, played)
    with open_repository(folder) as stored:
        plan, seed = stored.plan(number), stored.seed(number)
        world = [event for event in stored.events(number) if isinstance(event, happened.WorldEvent)]
    assert replay(plan, seed, world) == [step.outcome for step in played.steps]


def test_events_are_numbered_from_one_without_a_gap(folder: Path, provenance: Provenance, played: Driver) -> None:
    with Recorder(folder) as recorder:
        write(recorder, provenance, played)
    numbers = [seq for (seq,) in rows(folder, "SELECT seq FROM event ORDER BY seq")]
    assert numbers == list(range(1, len(played.events) + 1))


def test_an_event_s_row_can_be_read_without_the_program(folder: Path, provenance: Provenance) -> None:
    ignored = happened.CardSelectionRejected(at_ms=7, position=Position(1, 2), why=None)
    with Recorder(folder) as recorder:
        recorder.begin(provenance, [START])
        recorder.append([happened.CardSelected(at_ms=7, position=Position(1, 2)), ignored])
    assert rows(folder, "SELECT session, seq, at_ms, origin, type, payload FROM event ORDER BY seq") == [
        (1, 1, 0, "world", "SessionStarted", '{"setup":null}'),
        (1, 2, 7, "world", "CardSelected", '{"position":{"row":1,"column":2},"device":null,"trace":[]}'),
        (1, 3, 7, "session", "CardSelectionRejected", '{"position":{"row":1,"column":2},"why":null}'),
    ]


def test_an_event_says_when_it_was_written_by_the_clock_on_the_wall(folder: Path, provenance: Provenance) -> None:
    before = time.time_ns() // 1_000_000
    with Recorder(folder) as recorder:
        recorder.begin(provenance, [START])
        recorder.append([happened.ContinuePressed(at_ms=5)])
    with Recorder(folder):
        pass
    walls = [wall for (wall,) in rows(folder, "SELECT wall_ms FROM event ORDER BY seq")]
    assert len(walls) == 3
    assert before <= walls[0]
    assert walls == sorted(walls)


def test_words_in_any_script_are_kept_as_they_are(folder: Path, provenance: Provenance) -> None:
    failed = happened.SpeechFailed(at_ms=1, utterance=1, why="kein Ton — 音がない 🔇")
    with Recorder(folder) as recorder:
        number = recorder.begin(provenance, [START, failed]).session
    with open_repository(folder) as stored:
        assert stored.events(number)[1] == failed


def test_words_that_are_not_quite_text_are_kept_all_the_same(folder: Path, provenance: Provenance) -> None:
    """The operating system's messages may hold lone surrogates, in the name of a device or a file."""
    failed = happened.SpeechFailed(at_ms=1, utterance=1, why="no device \udcff")
    with Recorder(folder) as recorder:
        number = recorder.begin(provenance, [START, failed]).session
    with open_repository(folder) as stored:
        assert stored.events(number)[1] == failed


def test_a_session_s_row_says_what_it_followed(folder: Path, provenance: Provenance) -> None:
    plan = replace(provenance.plan, study_sha256="e" * 64)
    with Recorder(folder) as recorder:
        recorder.begin(replace(provenance, plan=plan), [START])
    with closing(sqlite3.connect(folder / FILE)) as connection:
        connection.row_factory = sqlite3.Row
        row = dict(connection.execute("SELECT * FROM session").fetchone())
        kept = dict(connection.execute("SELECT sha256, content FROM source").fetchall())
    assert (row["id"], row["seed"], row["condition"], row["embodiment"], row["language"]) == (
        1,
        4,
        "tom",
        "avatar",
        "en",
    )
    assert (row["kind"], row["version"], row["code_commit"]) == (1, __version__, "abc123")
    assert tuple(json.loads(row["deck"])) == plan.deck
    assert row["policy_sha256"] == plan.policy.sha256
    assert row["settings_sha256"] == plan.settings.sha256
    assert row["study_sha256"] == plan.study_sha256 == "e" * 64
    assert kept[row["settings_sha256"]] == plan.settings.model_dump_json()
    assert kept[row["policy_source"]] == plan.policy.to_json()
    assert kept[row["questionnaire_source"]] == QUESTIONNAIRES.dump_json(plan.questionnaires).decode()
    assert kept[row["about_you_source"]] == plan.about_you.model_dump_json()
    assert kept[row["information_source"]] == plan.information.model_dump_json()
    assert tuple(json.loads(row["practice_deck"])) == plan.practice_deck
    assert json.loads(kept[row["sentences_source"]]) == plan.catalogue.sources
    assert row["started_at"].endswith("+00:00")


def test_sessions_are_numbered_and_share_what_they_followed(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        assert [recorder.begin(provenance, [START]).session for _ in range(3)] == [1, 2, 3]
    assert rows(folder, "SELECT count(*) FROM source") == [(8,)]
    assert rows(folder, "SELECT session, seq FROM event WHERE type = 'SessionStarted'") == [(1, 1), (2, 1), (3, 1)]


def test_what_was_written_before_another_session_began_stays_with_its_own(folder: Path, provenance: Provenance) -> None:
    tapped = happened.ContinuePressed(at_ms=5)
    end = happened.SessionEnded(at_ms=9, status=Status.COMPLETED)
    with Recorder(folder) as recorder:
        for _ in range(2):
            recorder.begin(provenance, [START, START])
            recorder.append([tapped])
            recorder.append([tapped, end])
    assert rows(folder, "SELECT session, max(seq), count(*) FROM event GROUP BY session") == [(1, 5, 5), (2, 5, 5)]


# Nothing is ever changed


@pytest.mark.parametrize(
    "table",
    ["event", "session", "source", "migration", "participant", "allocation_list", "visit", "audit_event", "tombstone"],
)
def test_what_is_recorded_is_never_changed_or_deleted(folder: Path, provenance: Provenance, table: str) -> None:
    with Recorder(folder) as recorder:
        recorder.create_allocation_list({Condition.TOM: 2, Condition.NOTOM: 2}, 2, None, kind=SessionKind.SIMULATED)
        recorder.begin(provenance, [START])
        recorder.count_visit(NotRecordedReason.LEFT, kind=SessionKind.SIMULATED)
        recorder.add_audit_event("deviation", {"why": "the robot fell over"})
    with closing(sqlite3.connect(folder / FILE)) as connection, connection:
        connection.execute(A_TOMBSTONE, {"session": 7})
    before = rows(folder, f"SELECT * FROM {table}")  # noqa: S608 - a table of ours
    assert before
    with closing(sqlite3.connect(folder / FILE)) as connection:
        column = connection.execute(f"SELECT name FROM pragma_table_info('{table}')").fetchone()[0]  # noqa: S608
        for action in (f"UPDATE {table} SET {column} = {column}", f"DELETE FROM {table}"):  # noqa: S608
            with pytest.raises(sqlite3.IntegrityError, match="what is recorded is never changed"):
                connection.execute(action)
    assert rows(folder, f"SELECT * FROM {table}") == before  # noqa: S608


@pytest.mark.parametrize(
    "action",
    [
        "INSERT OR REPLACE INTO event SELECT session, seq, 99, origin, type, payload, 0, hash FROM event",
        "INSERT OR REPLACE INTO source SELECT sha256, 'forged' FROM source",
        "INSERT OR REPLACE INTO migration SELECT number, 'forged', sha256, applied_at FROM migration",
        "REPLACE INTO participant SELECT session, site, kind, 9, 1 FROM participant",
        "REPLACE INTO participant SELECT 9, site, kind, number, visit FROM participant",
        "REPLACE INTO withdrawal_code SELECT hash, 9 FROM withdrawal_code",
        "REPLACE INTO allocation_list "
        "SELECT id, site, kind, 99, block_size, quotas, slots, fixed_at FROM allocation_list",
        "REPLACE INTO visit SELECT id, 'declined', kind FROM visit",
        "REPLACE INTO audit_event SELECT id, 0, type, payload FROM audit_event",
        "REPLACE INTO event VALUES (1, 1, 99, 'world', 'SessionStarted', '{}', 0, zeroblob(32))",
    ],
)
def test_what_is_recorded_is_not_replaced_either(folder: Path, provenance: Provenance, action: str) -> None:
    """SQLite's REPLACE deletes the old row without a word to the triggers of DELETE."""
    with Recorder(folder) as recorder:
        recorder.create_allocation_list({Condition.TOM: 2, Condition.NOTOM: 2}, 2, None, kind=SessionKind.SIMULATED)
        recorder.begin(provenance, [START])
        recorder.count_visit(NotRecordedReason.LEFT, kind=SessionKind.SIMULATED)
        recorder.add_audit_event("deviation", {"why": "the robot fell over"})
    with (
        closing(sqlite3.connect(folder / FILE)) as connection,
        pytest.raises(sqlite3.IntegrityError, match="what is recorded is never changed"),
    ):
        connection.execute(action)


@pytest.mark.parametrize("table", ["event", "participant", "session", "withdrawal_code"])
def test_only_a_tombstone_lets_a_session_go(folder: Path, provenance: Provenance, table: str) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, [START])
        recorder.begin(provenance, [START])
    with closing(sqlite3.connect(folder / FILE)) as connection, connection:
        connection.execute(A_TOMBSTONE, {"session": 1})
        key = "id" if table == "session" else "session"
        connection.execute(f"DELETE FROM {table} WHERE {key} = 1")  # noqa: S608 - a table of ours
        with pytest.raises(sqlite3.IntegrityError, match="what is recorded is never changed"):
            connection.execute(f"DELETE FROM {table} WHERE {key} = 2")  # noqa: S608


def test_a_session_that_was_withdrawn_does_not_come_back(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, [START])
    with closing(sqlite3.connect(folder / FILE)) as connection, connection:
        connection.execute("CREATE TEMP TABLE kept AS SELECT * FROM session")
        connection.execute(A_TOMBSTONE, {"session": 1})
        connection.execute("DELETE FROM session")
        with pytest.raises(sqlite3.IntegrityError, match="what was withdrawn does not come back"):
            connection.execute("INSERT INTO session SELECT * FROM kept")


def test_an_event_s_number_is_taken_once(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, [START])
    with closing(sqlite3.connect(folder / FILE)) as connection, pytest.raises(sqlite3.IntegrityError):
        connection.execute("INSERT INTO event VALUES (1, 1, 0, 'world', 'SessionStarted', '{}', 0, zeroblob(32))")


# On the disk


def test_every_transaction_is_on_the_disk_when_it_is_committed(
    folder: Path, connections: list[sqlite3.Connection]
) -> None:
    with Recorder(folder):
        answers = [connections[0].execute(f"PRAGMA {name}").fetchone()[0] for name in ("journal_mode", "synchronous")]
    assert answers == ["wal", 2]


def test_one_append_is_one_transaction(
    folder: Path, provenance: Provenance, connections: list[sqlite3.Connection]
) -> None:
    statements: list[str] = []
    with Recorder(folder) as recorder:
        recorder.begin(provenance, [START])
        connections[0].set_trace_callback(statements.append)
        recorder.append(many(3))
        connections[0].set_trace_callback(None)
    assert (statements[0], statements[-1]) == ("BEGIN IMMEDIATE", "COMMIT")
    assert not {"BEGIN IMMEDIATE", "COMMIT"} & set(statements[1:-1])


def test_a_full_disk_fails_in_words_and_nothing_is_half_written(
    folder: Path, provenance: Provenance, connections: list[sqlite3.Connection]
) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, [START])
        limited(connections[0])
        with pytest.raises(StorageError, match="what happened could not be written: disk full"):
            recorder.append(many(100))
        assert rows(folder, "SELECT count(*) FROM event") == [(1,)]
        unlimited(connections[0])
        recorder.append(many(2))
    assert rows(folder, "SELECT seq FROM event ORDER BY seq") == [(1,), (2,), (3,)]


def test_a_disk_that_is_full_when_a_session_begins_keeps_nothing_of_it(
    folder: Path, provenance: Provenance, connections: list[sqlite3.Connection]
) -> None:
    with Recorder(folder) as recorder:
        limited(connections[0])
        with pytest.raises(StorageError, match="disk full"):
            recorder.begin(provenance, [START])
        assert rows(folder, "SELECT count(*) FROM session") == [(0,)]
        assert rows(folder, "SELECT count(*) FROM source") == [(0,)]
        unlimited(connections[0])
        assert recorder.begin(provenance, [START]).session == 1


def test_an_event_without_a_session_is_not_written(folder: Path) -> None:
    with Recorder(folder) as recorder, pytest.raises(StorageError, match="FOREIGN KEY"):
        recorder.append([START])
    assert rows(folder, "SELECT count(*) FROM event") == [(0,)]


def test_an_event_that_cannot_be_written_leaves_the_recorder_usable(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, [START])
        with pytest.raises(OverflowError):
            recorder.append([happened.ContinuePressed(at_ms=1), happened.ContinuePressed(at_ms=2**63)])
        recorder.append([happened.ContinuePressed(at_ms=2)])
    assert rows(folder, "SELECT seq, at_ms FROM event ORDER BY seq") == [(1, 0), (2, 2)]


# Interrupted


def test_a_session_that_was_cut_off_is_marked_where_its_last_event_left_it(
    folder: Path, provenance: Provenance
) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, [START])
        recorder.append([happened.ContinuePressed(at_ms=70), happened.BoardUnlocked(at_ms=70)])
    with Recorder(folder) as recorder:
        assert recorder.recovered == (1,)
    assert rows(folder, "SELECT session, seq, at_ms, origin, type, payload FROM event WHERE seq > 3") == [
        (1, 4, 70, "recovery", "SessionEnded", '{"status":"interrupted"}')
    ]


def test_it_is_marked_once(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, [START])
    recovered = []
    for _ in range(3):
        with Recorder(folder) as recorder:
            recovered.append(recorder.recovered)
    assert recovered == [(1,), (), ()]
    assert rows(folder, "SELECT count(*) FROM event WHERE type = 'SessionEnded'") == [(1,)]


def test_a_session_that_ended_is_left_alone(folder: Path, provenance: Provenance, played: Driver) -> None:
    with Recorder(folder) as recorder:
        write(recorder, provenance, played)
    with Recorder(folder) as recorder:
        assert recorder.recovered == ()
    with open_repository(folder) as stored:
        assert stored.events(1) == played.events


def test_every_session_that_was_cut_off_is_marked(folder: Path, provenance: Provenance, played: Driver) -> None:
    with Recorder(folder) as recorder:
        write(recorder, provenance, played)
        recorder.begin(provenance, [START])
    with Recorder(folder) as recorder:
        assert recorder.recovered == (2,)
        recorder.begin(provenance, [START])
    with Recorder(folder) as recorder:
        assert recorder.recovered == (3,)


def test_a_session_whose_end_the_disk_did_not_take_is_marked_when_the_next_begins(
    folder: Path, provenance: Provenance
) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, [START])
        recorder.begin(provenance, [START])
        recorder.append([happened.ContinuePressed(at_ms=5)])
    assert rows(folder, "SELECT session, seq, type FROM event ORDER BY session, seq") == [
        (1, 1, "SessionStarted"),
        (1, 2, "SessionEnded"),
        (2, 1, "SessionStarted"),
        (2, 2, "ContinuePressed"),
    ]


def test_a_database_that_cannot_be_written_when_a_crash_is_to_be_marked_is_refused_in_words(
    folder: Path, provenance: Provenance, monkeypatch: pytest.MonkeyPatch
) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, [START])

    def unwritable(where: Path) -> sqlite3.Connection:
        connection = open_for_writing(where)
        connection.execute("PRAGMA query_only = ON")
        return connection

    with monkeypatch.context() as patched:
        patched.setattr(recorder_module, "open_for_writing", unwritable)
        with pytest.raises(UserInputError, match=r"the data folder .* cannot be written"):
            Recorder(folder)
    with Recorder(folder) as recorder:
        assert recorder.recovered == (1,)


# Two at once


def test_a_second_recorder_on_the_same_folder_is_refused(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, [START])
        for _ in range(2):
            with pytest.raises(UserInputError, match="another Recollect is writing in"):
                Recorder(folder)
        recorder.append([happened.ContinuePressed(at_ms=1)])
    with Recorder(folder) as recorder:
        assert recorder.recovered == (1,)
        recorder.begin(provenance, [START])


def test_a_recorder_that_is_refused_lets_go_of_the_database(
    folder: Path, connections: list[sqlite3.Connection]
) -> None:
    with Recorder(folder), pytest.raises(UserInputError):
        Recorder(folder)
    for connection in connections:
        with pytest.raises(sqlite3.ProgrammingError, match="closed"):
            connection.execute("SELECT 1")


def test_a_database_is_not_migrated_under_a_recorder_that_is_at_work(folder: Path, provenance: Provenance) -> None:
    """A newer program that is refused leaves the older one that runs its database as it knows it."""
    with Recorder(folder) as recorder:
        recorder.begin(provenance, [START])
        with closing(sqlite3.connect(folder / FILE)) as connection:
            connection.execute("PRAGMA user_version = 1")
        with pytest.raises(UserInputError, match="another Recollect is writing in"):
            Recorder(folder)
        assert rows(folder, "PRAGMA user_version") == [(1,)]


# Killed in the middle


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs a system that can fork")
@pytest.mark.parametrize("attempt", range(20))
def test_a_process_killed_while_it_writes_loses_nothing_that_it_acknowledged(
    folder: Path, writer: Program, attempt: int
) -> None:
    acknowledged = kill_in_the_middle(writer, folder, after=Random(attempt).randrange(1, 60))
    with Recorder(folder) as recorder:
        assert recorder.recovered == (1,)
    with Recorder(folder) as recorder:
        assert recorder.recovered == ()
    assert rows(folder, "PRAGMA integrity_check") == [("ok",)]
    *written, end = [kind for (kind,) in rows(folder, "SELECT type FROM event ORDER BY seq")]
    assert end == "SessionEnded"
    assert len(written) in (acknowledged, acknowledged + 2)
    assert written == ["SessionStarted", *["CardSelected", "CardSelectionRejected"] * ((len(written) - 1) // 2)]


def kill_in_the_middle(writer: Program, folder: Path, after: int) -> int:
    """Have a session written, kill the writer after so many batches, and say how many events it had acknowledged."""
    with patience.limited(writer):
        writer.stdin.write(f"{folder}\n")
        writer.stdin.flush()
        process, *said = [int(writer.stdout.readline()) for _ in range(1 + after)]
        os.kill(process, signal.SIGKILL)
        said += [int(line) for line in iter(writer.stdout.readline, f"{GONE}\n")]
    return said[-1]


# Another program


def test_a_recorder_never_waits_for_another_program_unless_it_is_told_to(tmp_path: Path) -> None:
    with Recorder(tmp_path) as recorder, closing(sqlite3.connect(tmp_path / FILE, isolation_level=None)) as other:
        other.execute("BEGIN IMMEDIATE")
        with pytest.raises(StoreBusy, match="another program holds the database"):
            recorder.add_audit_event("PanelOpened", {})
        other.execute("ROLLBACK")
        recorder.add_audit_event("PanelOpened", {}, wall_ms=5)
    assert rows(tmp_path, "SELECT type, wall_ms FROM audit_event") == [("PanelOpened", 5)]


def test_a_recorder_that_is_told_to_wait_writes_when_the_other_program_lets_go(
    tmp_path: Path, connections: list[sqlite3.Connection]
) -> None:
    begun = threading.Event()
    with (
        Recorder(tmp_path, wait_ms=60_000) as recorder,
        closing(sqlite3.connect(tmp_path / FILE, isolation_level=None, check_same_thread=False)) as other,
    ):
        connections[0].set_trace_callback(lambda _: begun.set())
        other.execute("BEGIN IMMEDIATE")

        def let_go() -> None:
            begun.wait(PATIENCE_S)
            other.execute("ROLLBACK")

        letting_go = threading.Thread(target=let_go, daemon=True)
        letting_go.start()
        recorder.add_audit_event("PanelOpened", {})
        letting_go.join(PATIENCE_S)
    assert rows(tmp_path, "SELECT type FROM audit_event") == [("PanelOpened",)]


def test_the_next_place_is_read_while_another_program_writes(tmp_path: Path) -> None:
    with Recorder(tmp_path) as recorder, closing(sqlite3.connect(tmp_path / FILE, isolation_level=None)) as other:
        listed = recorder.create_allocation_list(
            {Condition("tom"): 1, Condition("notom"): 1}, 2, 1, kind=SessionKind.STUDY
        )
        other.execute("BEGIN IMMEDIATE")
        assert recorder.next_slot(kind=SessionKind.STUDY) == listed[0]
        other.execute("ROLLBACK")
