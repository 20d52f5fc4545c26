"""A withdrawal deletes a participant to the last byte; a tombstone stays, and nothing is half deleted."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import pytest

from kiosk import StorageError, UserInputError
from kiosk.experiment.outcomes import AllocationSource, SessionKind
from kiosk.store import withdrawal as withdraw_module
from kiosk.store.database import FILE, open_for_writing
from kiosk.store.maintenance import FOLDER, back_up, list_backups
from kiosk.store.queries import open_repository
from kiosk.store.recorder import Provenance, Recorder
from kiosk.store.verify import verify
from kiosk.store.withdrawal import find_withdrawal, withdraw
from tests.store.visitors import BEGUN, COMPLETED, FOUR, LEFT, a_day, rows, saying

ANSWER = "a quite unmistakable answer"
OTHERS = "somebody else's answer"


@pytest.fixture
def code(folder: Path, provenance: Provenance) -> str:
    """Return the code of a participant with long answers, between two others; copies were made before and after."""
    with Recorder(folder) as recorder:
        recorder.create_allocation_list(FOUR, 4, 7, kind=SessionKind.STUDY)
        place = recorder.next_slot(kind=SessionKind.STUDY)
        assert place is not None
        plan = replace(provenance.plan, condition=place.condition)
        person = replace(
            provenance, plan=plan, slot=place, allocation_source=AllocationSource.LIST, kind=SessionKind.STUDY
        )
        recorder.begin(provenance, saying(OTHERS))
        participant = recorder.begin(person, saying(ANSWER))
        back_up(folder, folder / FOLDER)
        recorder.append(saying(ANSWER * 500)[2:])
        recorder.begin(provenance, saying(OTHERS))
    back_up(folder, folder / FOLDER)
    return participant.code


def holding(folder: Path, words: str) -> list[str]:
    """Every file of a folder, and of those within, in which these words stand."""
    return sorted(file.name for file in folder.rglob("*") if file.is_file() and words.encode() in file.read_bytes())


def state(folder: Path) -> list[list[tuple[object, ...]]]:
    """All that could go, and what would come in its place."""
    return [rows(folder, f"SELECT * FROM {table}") for table in ("event", "session", "participant", "tombstone")]  # noqa: S608


def test_what_will_go_is_told_and_nothing_goes(folder: Path, code: str) -> None:
    before = state(folder)
    going = find_withdrawal(folder, code.lower())
    assert (going.session, going.participant, going.events, going.backups) == (2, "1", 6, 2)
    assert state(folder) == before


def test_every_row_goes_and_a_tombstone_comes(folder: Path, code: str) -> None:
    condition = rows(folder, "SELECT condition FROM session WHERE id = 2")[0][0]
    assert withdraw(folder, code).session == 2
    for table, key in (("event", "session"), ("participant", "session"), ("session", "id")):
        assert rows(folder, f"SELECT DISTINCT {key} FROM {table} ORDER BY {key}") == [(1,), (3,)]  # noqa: S608
    today = datetime.now(UTC).date().isoformat()
    assert rows(folder, "SELECT * FROM tombstone") == [
        (2, "", 1, 0, condition, 1, 1, "list", "completed", 1, today, 1),
    ]


@pytest.mark.parametrize(
    ("events", "status", "completed"), [(LEFT, "abandoned", 0), (BEGUN, "interrupted", 0), (COMPLETED, "completed", 1)]
)
def test_a_tombstone_says_how_the_session_ended(
    folder: Path, provenance: Provenance, events: tuple[object, ...], status: str, completed: int
) -> None:
    with Recorder(folder, "MI") as recorder:
        code = recorder.begin(provenance, events).code  # type: ignore[arg-type]  # events they are
    withdraw(folder, code)
    assert rows(folder, "SELECT site, number, status, game_completed FROM tombstone") == [
        ("MI", 1, status, completed),
    ]


def test_a_tombstone_tells_no_time_of_day_and_no_code(folder: Path, code: str) -> None:
    withdraw(folder, code)
    (tombstone,) = rows(folder, "SELECT * FROM tombstone")
    assert code not in tombstone
    assert not [value for value in tombstone if isinstance(value, str) and ":" in value]


def test_not_a_byte_is_left_in_any_file_of_the_folder(folder: Path, code: str) -> None:
    assert len(holding(folder, ANSWER)) == 3
    withdraw(folder, code)
    assert holding(folder, ANSWER) == []
    assert holding(folder, code) == []
    assert len(holding(folder, OTHERS)) == 2


def test_the_copies_are_replaced_by_a_fresh_one(folder: Path, code: str) -> None:
    before = list_backups(folder / FOLDER)
    withdraw(folder, code)
    (copy,) = list_backups(folder / FOLDER)
    assert copy not in before
    with closing(sqlite3.connect(copy)) as connection:
        assert connection.execute("SELECT session FROM tombstone").fetchall() == [(2,)]


def test_where_there_was_no_copy_none_is_made(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        code = recorder.begin(provenance, COMPLETED).code
    withdraw(folder, code)
    assert not (folder / FOLDER).exists()


def test_what_is_left_is_sound_and_a_kiosk_goes_on_with_it(folder: Path, code: str, provenance: Provenance) -> None:
    withdraw(folder, code)
    assert verify(folder) == []
    with Recorder(folder) as recorder:
        assert recorder.recovered == ()
        assert recorder.begin(provenance, BEGUN).session == 4
    with open_repository(folder) as stored:
        assert [session.id for session in stored.sessions()] == [1, 3, 4]
        with pytest.raises(UserInputError, match="there is no session 2"):
            stored.events(2)


def test_everybody_may_withdraw(folder: Path, provenance: Provenance) -> None:
    people = a_day(folder, provenance, "MI")
    for person in people:
        withdraw(folder, person.code)
    assert state(folder)[:3] == [[], [], []]
    assert verify(folder) == []
    with open_repository(folder) as stored:
        assert sum(cell.begun for cell in stored.counts(kind=SessionKind.STUDY).cells.values()) == 3


# Refused


def test_nobody_withdraws_twice(folder: Path, code: str) -> None:
    withdraw(folder, code)
    with pytest.raises(UserInputError, match="the participant with this code has been withdrawn from"):
        withdraw(folder, code)


def test_a_person_without_a_code_is_withdrawn_by_the_number_of_their_session(folder: Path, code: str) -> None:
    with pytest.raises(UserInputError, match=r"no participant in .* has the session 9"):
        withdraw(folder, 9)
    assert withdraw(folder, 2).session == 2
    assert holding(folder, ANSWER) == []
    with pytest.raises(UserInputError, match="the participant with this code has been withdrawn from"):
        find_withdrawal(folder, code)


@pytest.mark.parametrize(
    ("typed", "words"),
    [
        ("7KQ2M-XR4T4", "no participant in .* has this code"),
        ("7KQ2M-XR4T5", "is mistyped"),
        ("hello", "no participant's code"),
    ],
)
def test_a_code_that_nobody_has_is_refused_and_nothing_goes(folder: Path, code: str, typed: str, words: str) -> None:
    assert typed != code
    before = state(folder)
    for attempt in (find_withdrawal, withdraw):
        with pytest.raises(UserInputError, match=words):
            attempt(folder, typed)
    assert state(folder) == before


def test_while_a_kiosk_is_writing_nobody_is_taken_out(folder: Path, code: str) -> None:
    with Recorder(folder):
        before = state(folder)
        for attempt in (find_withdrawal, withdraw):
            with pytest.raises(UserInputError, match=r"a kiosk is writing in .*: close it first, then withdraw"):
                attempt(folder, code)
        assert state(folder) == before


def test_while_somebody_is_looking_nobody_is_taken_out(
    folder: Path, code: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(withdraw_module, "READER_WAIT_MS", 1)
    before = state(folder)
    with open_repository(folder) as stored:
        assert len(stored.sessions()) == 3
        with pytest.raises(UserInputError, match=r"another program is looking at the data in .*: close it, then"):
            withdraw(folder, code)
        assert len(stored.sessions()) == 3
    assert state(folder) == before
    withdraw(folder, code)
    assert holding(folder, ANSWER) == []


def test_where_there_are_no_data_none_are_made(folder: Path) -> None:
    for attempt in (find_withdrawal, withdraw):
        with pytest.raises(UserInputError, match="there is no database in"):
            attempt(folder, "7KQ2M-XR4T4")
    assert not folder.exists()


# Failed


def test_a_disk_that_does_not_take_it_keeps_everything(
    folder: Path, code: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = state(folder)

    def unwritable(where: Path) -> sqlite3.Connection:
        connection = open_for_writing(where)
        connection.execute("PRAGMA query_only = ON")
        return connection

    with monkeypatch.context() as patched:
        patched.setattr(withdraw_module, "open_for_writing", unwritable)
        with pytest.raises(StorageError, match="nothing was withdrawn: "):
            withdraw(folder, code)
    assert state(folder) == before
    assert len(list_backups(folder / FOLDER)) == 2
    withdraw(folder, code)


def test_copies_that_could_not_be_replaced_are_told(folder: Path, code: str, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object, **__: object) -> Path:
        raise StorageError("the disk is full")

    monkeypatch.setattr(withdraw_module, "back_up", full)
    with pytest.raises(
        StorageError, match=r"the participant was withdrawn, but the 2 copies in .* still hold them: the disk is full"
    ):
        withdraw(folder, code)
    assert ANSWER.encode() not in (folder / FILE).read_bytes()
