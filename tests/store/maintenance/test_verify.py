"""Whatever is not as this program wrote it is found, and named, and left as it is."""

from __future__ import annotations

import shutil
import sqlite3
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from kiosk import UserInputError
from kiosk.experiment.events import SpeechStarted
from kiosk.experiment.outcomes import SessionKind
from kiosk.store.chain import FILE as HEADS
from kiosk.store.chain import read_heads
from kiosk.store.database import FILE
from kiosk.store.maintenance import back_up
from kiosk.store.migrations import SCHEMA
from kiosk.store.recorder import Provenance, Recorder
from kiosk.store.verify import Verification, verify
from tests.store.visitors import BEGUN, COMPLETED, a_day

_OF_A_SESSION = (
    ("event", "session"),
    ("participant", "session"),
    ("withdrawal_code", "session"),
    ("session", "id"),
    ("head", "session"),
)


def tamper(folder: Path, *statements: str) -> None:
    """Change what is stored in spite of everything, and put the triggers back."""
    with closing(sqlite3.connect(folder / FILE)) as connection, connection:
        triggers = connection.execute("SELECT name, sql FROM sqlite_master WHERE type = 'trigger'").fetchall()
        for name, _ in triggers:
            connection.execute(f"DROP TRIGGER {name}")
        for statement in statements:
            connection.execute(statement)
        for _, text in triggers:
            connection.execute(text)


def found(folder: Path) -> dict[Verification, list[str]]:
    """Return what is found, as where and what, by check."""
    told: dict[Verification, list[str]] = {}
    for flaw in verify(folder):
        told.setdefault(flaw.check, []).append(f"{flaw.where}: {flaw.what}")
    return told


def test_what_this_program_wrote_is_sound(day: Path) -> None:
    assert verify(day) == []


def test_a_kiosk_may_be_writing_meanwhile(folder: Path, provenance: Provenance) -> None:
    a_day(folder, provenance, "MI")
    with Recorder(folder):
        assert verify(folder) == []


def test_it_says_how_far_it_is(day: Path) -> None:
    told: list[tuple[int, int]] = []
    verify(day, lambda done, of: told.append((done, of)))
    assert told == [(done, len(Verification)) for done in range(len(Verification))]


@pytest.mark.parametrize(
    ("check", "words", "statements"),
    [
        (Verification.NUMBERING, "session 1: has 3 events, numbered from 1 to 4", ["DELETE FROM event WHERE seq = 2"]),
        (
            Verification.NUMBERING,
            "numbered from 2 to 5",
            ["UPDATE event SET seq = seq + 10", "UPDATE event SET seq = seq - 9"],
        ),
        (Verification.NUMBERING, "session 1: has no events", ["DELETE FROM event"]),
        (
            Verification.TIME,
            "session 1, event 4: is at 1 ms, after one at 7 ms",
            ["UPDATE event SET at_ms = 1 WHERE seq = 4"],
        ),
        (Verification.TIME, "session 1, event 1: is at -1 ms, after", ["UPDATE event SET at_ms = -1 WHERE seq = 1"]),
        (Verification.READABLE, "event 1: Hacked cannot be read: ", ["UPDATE event SET type = 'Hacked' WHERE seq = 1"]),
        (
            Verification.READABLE,
            "event 1: SessionStarted cannot be read",
            ["UPDATE event SET payload = '[1]' WHERE seq = 1"],
        ),
        (
            Verification.READABLE,
            "SessionStarted cannot be read",
            ["UPDATE event SET payload = '{\"x\": 1}' WHERE seq = 1"],
        ),
        (
            Verification.CHAIN,
            "session 1, event 3: it is not what was recorded: it does not match its hash",
            ["UPDATE event SET payload = replace(payload, 'one', 'two') WHERE session = 1"],
        ),
        (Verification.CHAIN, "session 1, event 2: ", ["UPDATE event SET at_ms = 6 WHERE session = 1 AND seq = 2"]),
        (Verification.CHAIN, "session 1, event 2: ", ["UPDATE event SET wall_ms = 6 WHERE session = 1 AND seq = 2"]),
        (
            Verification.CHAIN,
            "session 1, event 2: ",
            ["UPDATE event SET origin = 'recovery' WHERE session = 1 AND seq = 2"],
        ),
        (
            Verification.CHAIN,
            "session 1, event 2: ",
            ["UPDATE event SET hash = zeroblob(32) WHERE session = 1 AND seq = 2"],
        ),
        (
            Verification.CHAIN,
            "session 1, event 1: it, or what the session followed, is not what",
            ["UPDATE session SET seed = seed + 1 WHERE id = 1"],
        ),
        (Verification.CHAIN, "event 1: it, or what", ["UPDATE session SET started_at = '1999-01-01' WHERE id = 1"]),
        (
            Verification.HEADS,
            "session 1: had 4 events, of which the last is missing or changed",
            ["DELETE FROM event WHERE session = 1 AND seq = 4"],
        ),
        (Verification.HEADS, "session 1: had 4 events", ["UPDATE event SET hash = zeroblob(32) WHERE seq = 4"]),
        (Verification.HEADS, "session 1: has no head", ["DELETE FROM head"]),
        (
            Verification.HEADS,
            "session 1: is missing; it had 4 events",
            [f"DELETE FROM {table} WHERE {key} = 1" for table, key in _OF_A_SESSION[:4]],  # noqa: S608
        ),
        (
            Verification.HEADS,
            "session 4: is missing; its number was given out",
            [f"DELETE FROM {table} WHERE {key} = 4" for table, key in _OF_A_SESSION],  # noqa: S608
        ),
        (Verification.SOURCES, "is not what its hash says", ["UPDATE source SET content = content || ' '"]),
        (
            Verification.RECEIPTS,
            f"step {SCHEMA}: has no receipt, or that of another",
            ["UPDATE migration SET sha256 = 'x'"],
        ),
        (Verification.RECEIPTS, f"step {SCHEMA}: has no receipt", ["DELETE FROM migration"]),
        (Verification.RECEIPTS, "step 99: has a receipt", ["INSERT INTO migration VALUES (99, '', '', '')"]),
        (Verification.REFERENCES, "points at nothing in source", ["DELETE FROM source"]),
        (
            Verification.PARTICIPANTS,
            "session 1: its participant has no code",
            ["DELETE FROM withdrawal_code WHERE session = 1"],
        ),
        (Verification.PARTICIPANTS, "of another site", ["UPDATE participant SET site = 'GI' WHERE number = 3"]),
        (
            Verification.PARTICIPANTS,
            "of another site, or another kind",
            ["UPDATE participant SET kind = 1 WHERE number = 3"],
        ),
        (Verification.PARTICIPANTS, "has the number 0", ["UPDATE participant SET number = 0 WHERE number = 3"]),
        (
            Verification.PARTICIPANTS,
            "participant 2 of site 'MI': stands there 2 times",
            ["UPDATE participant SET number = 2 WHERE number = 3"],
        ),
        (
            Verification.ALLOCATION,
            "list 1: does not meet its quotas",
            ['UPDATE allocation_list SET quotas = \'{"tom": 4, "notom": 5}\''],
        ),
        (
            Verification.ALLOCATION,
            "and slot 9 of list 1 is not",
            ["UPDATE session SET allocation_slot = 9 WHERE id = 1"],
        ),
        (
            Verification.ALLOCATION,
            "session 1: is no_assistance, and",
            ["UPDATE session SET condition = 'no_assistance' WHERE id = 1"],
        ),
        (
            Verification.WITHDRAWN,
            "session 1: was withdrawn, and 1 rows of it are left in session",
            ["UPDATE tombstone SET session = 1"],
        ),
    ],
)
def test_what_was_tampered_with_is_found(day: Path, check: Verification, words: str, statements: list[str]) -> None:
    tamper(day, *statements)
    before = (day / FILE).read_bytes()
    assert [told for told in found(day)[check] if words in told]
    assert (day / FILE).read_bytes() == before


@pytest.mark.parametrize(
    ("words", "statements"),
    [
        ("trigger event_is_never_updated: is missing", ["DROP TRIGGER event_is_never_updated"]),
        ("index game_finished: is missing", ["DROP INDEX game_finished"]),
        ("table spy: is none of ours", ["CREATE TABLE spy (what TEXT)"]),
        (
            "trigger spy: is none of ours",
            ["CREATE TRIGGER spy AFTER INSERT ON event BEGIN SELECT 1; END"],
        ),
        (
            "trigger visit_is_never_updated: is not as it was made",
            [
                "DROP TRIGGER visit_is_never_updated",
                "CREATE TRIGGER visit_is_never_updated BEFORE UPDATE ON visit BEGIN SELECT 1; END",
            ],
        ),
    ],
)
def test_a_schema_that_is_not_ours_is_found(day: Path, words: str, statements: list[str]) -> None:
    with closing(sqlite3.connect(day / FILE)) as connection, connection:
        for statement in statements:
            connection.execute(statement)
    assert found(day) == {Verification.SCHEMA: [words]}


@pytest.mark.parametrize(
    ("first", "second", "words"),
    [
        (
            {"pack": "a" * 64},
            {"pack": "b" * 64},
            "'en' is spoken by the pack bbbbbbbbbbbb (anna of person); in session 1",
        ),
        ({}, {"engine_version": "2"}, "'en' is spoken by anna of person 2; in session 1 it was anna of person"),
        ({"pack": "a"}, {"pack": "a"}, ""),
        ({"pack": "a"}, {}, ""),
    ],
)
def test_a_voice_that_changed_in_the_middle_of_a_study_is_found(
    folder: Path, provenance: Provenance, first: dict[str, Any], second: dict[str, Any], words: str
) -> None:
    with Recorder(folder) as recorder:
        for number, told in enumerate((first, second, second)):
            spoken = SpeechStarted(at_ms=0, utterance=1, **({"engine": "person", "voice": "anna"} | told))
            session = replace(provenance, seed=number, kind=SessionKind.STUDY)
            recorder.begin(session, (*BEGUN, spoken))
    flaws = found(folder).get(Verification.VOICE, [])
    assert len(flaws) == bool(words)
    assert not words or flaws[0].startswith(f"session 2: {words}")


def lost(folder: Path) -> list[str]:
    """Return what verify says of missing sessions and ends."""
    return found(folder).get(Verification.HEADS, [])


def test_a_log_that_was_deleted_is_found(folder: Path, provenance: Provenance) -> None:
    """The database is then whole, as it stood some events ago."""
    with Recorder(folder) as recorder:
        recorder.begin(provenance, BEGUN)
        with closing(sqlite3.connect(folder / FILE)) as connection:
            connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
        recorder.append(COMPLETED[1:])
        left = shutil.copytree(folder, folder.with_name("left"))
    (left / f"{FILE}-wal").unlink()
    assert lost(left) == ["session 1: 3 events of it were written here, and 1 are left"]
    with Recorder(left) as recorder:
        recorder.begin(provenance, COMPLETED)
    assert lost(left) == ["session 1: 3 events of it were written here, and 2 are left"]


def test_an_older_copy_in_place_of_the_database_is_found(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, COMPLETED)
        copy = back_up(folder, folder.with_name("copies"))
        recorder.begin(replace(provenance, seed=5), COMPLETED)
    shutil.copy(copy, folder / FILE)
    assert lost(folder) == ["session 2: is missing; 3 events of it were written here"]
    with Recorder(folder) as recorder:
        recorder.begin(replace(provenance, seed=6), COMPLETED)
    assert lost(folder) == ["session 2: event 3 is not the one that was written here"]


def test_a_new_database_in_place_of_one_that_was_deleted_is_found(day: Path) -> None:
    (day / FILE).unlink()
    with Recorder(day):
        pass
    assert [words.partition(":")[0] for words in lost(day)] == ["session 1", "session 2", "session 3", "session 4"]


def test_a_session_that_goes_on_is_written_on_a_line_of_its_own(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, BEGUN)
    with Recorder(folder) as recorder:
        recorder.resume(1)
        recorder.append(COMPLETED[1:])
    assert [(head.session, head.events) for head in read_heads(folder)] == [(1, 1), (1, 4)]
    assert verify(folder) == []


def test_a_line_that_a_crash_has_torn_is_no_flaw_and_is_written_over(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, COMPLETED)
    with (folder / HEADS).open("ab") as file:
        file.write(b"         2      ")
    assert verify(folder) == []
    with Recorder(folder) as recorder:
        recorder.begin(replace(provenance, seed=5), COMPLETED)
    assert [(head.session, head.events) for head in read_heads(folder)] == [(1, 3), (2, 3)]
    assert verify(folder) == []


def test_a_line_that_cannot_be_read_is_found_unless_it_is_the_last(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, COMPLETED)
        recorder.begin(replace(provenance, seed=5), COMPLETED)
    whole = (folder / HEADS).read_bytes()
    (folder / HEADS).write_bytes(whole[:-8] + b"\0" * 8)
    assert verify(folder) == []
    (folder / HEADS).write_bytes(b"\0" * 8 + whole[8:])
    assert lost(folder) == ["recollect.heads: has lines that cannot be read: 1"]


def test_a_whole_line_that_a_crash_has_torn_is_written_over(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, COMPLETED)
    torn = (folder / HEADS).read_bytes()[:-8] + b"\0" * 8
    (folder / HEADS).write_bytes(torn)
    with Recorder(folder) as recorder:
        recorder.begin(replace(provenance, seed=5), COMPLETED)
    assert [(head.session, head.events) for head in read_heads(folder)] == [(2, 3)]
    assert verify(folder) == []


def test_a_file_of_heads_that_cannot_be_written_costs_no_session(folder: Path, provenance: Provenance) -> None:
    (folder / HEADS).mkdir(parents=True)
    with Recorder(folder) as recorder:
        recorder.begin(provenance, BEGUN)
        recorder.append(COMPLETED[1:])
    assert verify(folder) == []


def test_a_page_that_is_damaged_is_found(day: Path) -> None:
    with closing(sqlite3.connect(day / FILE)) as connection:
        root = connection.execute("SELECT rootpage FROM sqlite_master WHERE name = 'event'").fetchone()[0]
        size = connection.execute("PRAGMA page_size").fetchone()[0]
    damaged = bytearray((day / FILE).read_bytes())
    damaged[(root - 1) * size : root * size] = b"\xff" * size
    (day / FILE).write_bytes(damaged)
    assert Verification.FILE in found(day)


def test_where_there_is_nothing_to_check_it_is_said(folder: Path) -> None:
    with pytest.raises(UserInputError, match="there is no database in"):
        verify(folder)
    assert not folder.exists()
