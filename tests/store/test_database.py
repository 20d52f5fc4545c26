"""A database is made, migrated, or refused in words and left exactly as it is."""

from __future__ import annotations

import shutil
import sqlite3
import subprocess
import sys
import threading
import zipfile
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import pytest

from kiosk import UserInputError
from kiosk.store import database
from kiosk.store.database import (
    APPLICATION_ID,
    FILE,
    in_use,
    lock_folder,
    open_for_reading,
    open_for_writing,
    wait_until_free,
)
from kiosk.store.migrations import MIGRATIONS, SCHEMA, Migration
from kiosk.store.queries import open_repository
from kiosk.store.recorder import Recorder
from tests.patience import PATIENCE_S

ONE_MORE = Migration(SCHEMA + 1, "one more step", ("CREATE TABLE more (id INTEGER PRIMARY KEY) STRICT",))
BROKEN = Migration(
    SCHEMA + 1, "a step that fails", ("CREATE TABLE half (id INTEGER) STRICT", "CREATE TABLE event (id INTEGER)")
)


def contents(folder: Path) -> dict[str, bytes]:
    """Every file that holds data, byte by byte; the shared memory beside a log holds none."""
    return {file.name: file.read_bytes() for file in folder.iterdir() if not file.name.endswith(("-shm", ".lock"))}


def ask(folder: Path, query: str) -> list[tuple[object, ...]]:
    """Return what stands in the database of a folder."""
    with closing(sqlite3.connect(folder / FILE)) as connection:
        return connection.execute(query).fetchall()


def made(folder: Path) -> Path:
    """Return the database of a folder in which a recorder has been."""
    with Recorder(folder):
        pass
    return folder / FILE


def with_steps(monkeypatch: pytest.MonkeyPatch, *steps: Migration) -> None:
    """Act as a later program, which knows more steps."""
    monkeypatch.setattr(database, "MIGRATIONS", (*MIGRATIONS, *steps))
    monkeypatch.setattr(database, "SCHEMA", SCHEMA + len(steps))


# Made and migrated


def test_the_first_recorder_makes_folder_and_database(folder: Path) -> None:
    assert made(folder).is_file()
    assert ask(folder, "PRAGMA application_id") == [(int.from_bytes(b"Rclt"),)]
    assert ask(folder, "PRAGMA user_version") == [(SCHEMA,)]


def test_a_folder_of_data_is_for_its_owner_alone(folder: Path) -> None:
    made(folder)
    assert folder.stat().st_mode & 0o077 == 0


def test_every_step_leaves_a_receipt(folder: Path) -> None:
    made(folder)
    receipts = ask(folder, "SELECT number, name, sha256 FROM migration ORDER BY number")
    assert receipts == [(step.number, step.name, step.sha256) for step in MIGRATIONS]


def test_steps_are_numbered_without_a_gap() -> None:
    assert [step.number for step in MIGRATIONS] == list(range(MIGRATIONS[0].number, SCHEMA + 1))


def test_a_step_that_is_edited_has_another_hash() -> None:
    assert len({ONE_MORE.sha256, BROKEN.sha256, Migration(SCHEMA + 1, "", (*ONE_MORE.statements, "")).sha256}) == 3


def test_opening_again_takes_no_step_twice(folder: Path) -> None:
    made(folder)
    before = ask(folder, "SELECT * FROM migration")
    made(folder)
    assert ask(folder, "SELECT * FROM migration") == before


def test_an_older_database_takes_the_steps_it_lacks(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    made(folder)
    with_steps(monkeypatch, ONE_MORE)
    made(folder)
    assert ask(folder, "SELECT number, name FROM migration") == [
        *((step.number, step.name) for step in MIGRATIONS),
        (SCHEMA + 1, "one more step"),
    ]
    assert ask(folder, "PRAGMA user_version") == [(SCHEMA + 1,)]
    assert ask(folder, "SELECT * FROM more") == []


def test_a_step_that_fails_leaves_nothing_behind(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    made(folder)
    with_steps(monkeypatch, BROKEN)
    with pytest.raises(UserInputError, match=r"the database .* cannot be used: table event already exists"):
        open_for_writing(folder)
    assert ask(folder, "SELECT name FROM sqlite_master WHERE name = 'half'") == []
    assert ask(folder, "PRAGMA user_version") == ask(folder, "SELECT max(number) FROM migration") == [(SCHEMA,)]
    monkeypatch.undo()
    made(folder)


def test_an_empty_file_becomes_a_database(folder: Path) -> None:
    folder.mkdir()
    (folder / FILE).touch()
    made(folder)
    assert ask(folder, "SELECT max(number) FROM migration") == [(SCHEMA,)]


# Refused


def a_text(path: Path) -> None:
    path.write_text("Dear diary, " * 50)


def a_short_text(path: Path) -> None:
    path.write_text("hi")


def another_program_s(path: Path) -> None:
    with closing(sqlite3.connect(path)) as connection:
        connection.execute("CREATE TABLE contacts (name TEXT)")
        connection.execute("PRAGMA application_id = 7")


def nobody_s(path: Path) -> None:
    with closing(sqlite3.connect(path)) as connection:
        connection.execute("CREATE TABLE contacts (name TEXT)")


def a_zip(path: Path) -> None:
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("hello.txt", "hello " * 100)


def a_headless_database(path: Path) -> None:
    made(path.parent)
    path.write_bytes(b"\0" * 100 + path.read_bytes()[100:])


@pytest.mark.parametrize(
    "foreign", [a_text, a_short_text, another_program_s, nobody_s, a_zip, a_headless_database], ids=lambda f: f.__name__
)
@pytest.mark.parametrize("open_it", [open_for_writing, open_for_reading], ids=lambda f: f.__name__)
def test_a_foreign_file_is_refused_and_left_as_it_is(
    folder: Path, foreign: Callable[[Path], None], open_it: Callable[[Path], sqlite3.Connection]
) -> None:
    folder.mkdir()
    foreign(folder / FILE)
    before = contents(folder)
    with pytest.raises(UserInputError, match=r"recollect\.db is not a Recollect database; it was left as it is"):
        open_it(folder)
    assert contents(folder) == before


def newer_in_the_header(folder: Path) -> None:
    with closing(sqlite3.connect(made(folder))) as connection:
        connection.execute("PRAGMA user_version = 99")


def newer_in_the_log_alone(folder: Path) -> None:
    """As a newer program that was killed would leave it: the number stands in the write-ahead log, not yet moved."""
    other = folder.parent / "other"
    with closing(sqlite3.connect(made(other))) as connection:
        connection.execute("PRAGMA user_version = 99")
        shutil.copytree(other, folder)
    (folder / f"{FILE}-shm").unlink()
    assert int.from_bytes((folder / FILE).read_bytes()[60:64]) == SCHEMA


@pytest.mark.parametrize("newer", [newer_in_the_header, newer_in_the_log_alone], ids=lambda f: f.__name__)
@pytest.mark.parametrize("open_it", [open_for_writing, open_for_reading], ids=lambda f: f.__name__)
def test_a_newer_database_is_refused_and_left_as_it_is(
    folder: Path, newer: Callable[[Path], None], open_it: Callable[[Path], sqlite3.Connection]
) -> None:
    newer(folder)
    before = contents(folder)
    with pytest.raises(
        UserInputError, match=rf"was written by a newer Recollect \(schema 99, this one knows {SCHEMA}\)"
    ):
        open_it(folder)
    assert contents(folder) == before


def test_a_database_of_this_very_schema_is_not_newer(folder: Path) -> None:
    made(folder)
    open_for_writing(folder).close()
    open_for_reading(folder).close()


def test_a_damaged_database_is_refused_in_words(folder: Path) -> None:
    path = made(folder)
    path.write_bytes(path.read_bytes()[:100] + b"\xff" * 5000)
    with pytest.raises(UserInputError, match="cannot be used: "):
        Recorder(folder)
    with pytest.raises(UserInputError, match="cannot be read: "):
        open_for_reading(folder)


def test_a_folder_that_cannot_be_made_is_refused_in_words(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    for folder in (tmp_path / "file" / "data", tmp_path / "file"):
        with pytest.raises(UserInputError, match=r"the data folder .* cannot be used: "):
            Recorder(folder)


def test_a_folder_in_the_place_of_the_database_is_refused_in_words(folder: Path) -> None:
    (folder / FILE).mkdir(parents=True)
    with pytest.raises(UserInputError, match="cannot be used: "):
        Recorder(folder)
    with pytest.raises(UserInputError, match="there is no database in"):
        open_for_reading(folder)


def test_a_refused_database_can_be_put_right(folder: Path) -> None:
    newer_in_the_header(folder)
    for _ in range(2):
        with pytest.raises(UserInputError):
            Recorder(folder)
    ask(folder, f"PRAGMA user_version = {SCHEMA}")
    made(folder)


def test_the_number_in_the_header_is_the_program_s() -> None:
    assert APPLICATION_ID == 0x52636C74


def test_a_database_opened_for_reading_cannot_be_written(folder: Path) -> None:
    made(folder)
    with closing(open_for_reading(folder)) as connection, pytest.raises(sqlite3.OperationalError, match="readonly"):
        connection.execute("INSERT INTO source VALUES ('a', 'b')")


@pytest.mark.parametrize("there", [True, False])
def test_where_there_is_no_database_none_is_made_by_looking(folder: Path, *, there: bool) -> None:
    if there:
        folder.mkdir()
    with pytest.raises(UserInputError, match="there is no database in"), open_repository(folder):
        pass
    assert folder.exists() is there
    assert not there or not list(folder.iterdir())


def test_an_empty_file_is_not_a_database_to_read(folder: Path) -> None:
    folder.mkdir()
    (folder / FILE).touch()
    with pytest.raises(UserInputError, match="cannot be read: no such table"):
        open_for_reading(folder)
    assert contents(folder) == {FILE: b""}


def test_what_a_kiosk_reads_of_its_database_never_lets_another_program_take_its_log_away(folder: Path) -> None:
    with closing(open_for_writing(folder)) as kiosk:
        open_for_reading(folder).close()
        kiosk.execute("CREATE TABLE more (id INTEGER) STRICT")
        look = "import sqlite3, sys; c = sqlite3.connect(sys.argv[1]); c.execute('SELECT 1 FROM migration'); c.close()"
        subprocess.run([sys.executable, "-c", look, folder / FILE], check=True, timeout=PATIENCE_S)

        assert folder.joinpath(f"{FILE}-wal").exists()


def test_a_folder_that_another_program_leaves_meanwhile_is_waited_for_and_no_longer_than_allowed(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    wait_until_free(folder, 0)
    assert not folder.exists()
    held, seen = threading.Event(), threading.Event()

    def hold() -> None:
        lock = lock_folder(folder)
        held.set()
        seen.wait(PATIENCE_S)
        lock.release()

    holding = threading.Thread(target=hold, daemon=True)
    holding.start()
    assert held.wait(PATIENCE_S)
    wait_until_free(folder, 0)
    assert in_use(folder)

    def look(_: Path) -> bool:
        """Say that it is in use, and have it left."""
        seen.set()
        return True

    monkeypatch.setattr(database, "in_use", look)
    wait_until_free(folder, 60)
    holding.join(PATIENCE_S)
    assert not in_use(folder)
