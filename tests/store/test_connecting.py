"""A database is read wherever it lies and whatever was cut off; nothing is left, and damage is named in words."""

from __future__ import annotations

import os
import shutil
import signal
import sqlite3
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager, suppress
from pathlib import Path
from types import SimpleNamespace

import pytest

from kiosk import StorageError, UserInputError, is_nearly_full
from kiosk.export.columns import ExportOption
from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import PsychDs
from kiosk.preflight import Severity
from kiosk.store import connecting, database
from kiosk.store.checks import database_check as probe
from kiosk.store.database import FILE, open_for_reading, open_for_writing
from kiosk.store.maintenance import FOLDER, back_up
from kiosk.store.queries import open_repository
from kiosk.store.recorder import Provenance, Recorder
from kiosk.store.verify import verify
from kiosk.store.withdrawal import withdraw
from tests.patience import PATIENCE_S
from tests.store.visitors import BEGUN, COMPLETED, a_day

POSIX = pytest.mark.skipif(sys.platform == "win32", reason="owners and rights are those of POSIX")


def contents(folder: Path) -> dict[str, bytes]:
    """Every file of a folder, byte by byte."""
    return {file.name: file.read_bytes() for file in folder.iterdir() if file.is_file()}


def left_by_a_kill(folder: Path, provenance: Provenance, into: Path) -> Path:
    """Return a folder as a kiosk leaves it that is killed: all that was written stands in the log."""
    with Recorder(folder) as recorder:
        recorder.begin(provenance, BEGUN)
        shutil.copytree(folder, into)
    return into


def at_rest(folder: Path, provenance: Provenance, into: Path) -> Path:
    """Return a folder as a kiosk leaves it that is closed."""
    with Recorder(folder) as recorder:
        recorder.begin(provenance, BEGUN)
    return Path(shutil.copytree(folder, into))


def without_shared_memory(folder: Path, provenance: Provenance, into: Path) -> Path:
    """Return a folder that was copied after a kill, with the log and without what only a running program needs."""
    left_by_a_kill(folder, provenance, into)
    (into / f"{FILE}-shm").unlink()
    return into


Left = Callable[[Path, Provenance, Path], Path]
LEFT = pytest.mark.parametrize(
    "left", [at_rest, left_by_a_kill, without_shared_memory], ids=lambda each: str(each.__name__)
)


def check_readable(folder: Path, out: Path) -> None:
    """Hold that all that a kiosk has written can be verified, listed, copied, looked at and exported."""
    assert verify(folder) == []
    with open_repository(folder) as stored:
        assert [len(stored.events(session.id)) for session in stored.sessions()] == [1]
    assert Severity.ERROR not in {found.severity for found in probe(folder, busy=False)}
    with closing(sqlite3.connect(back_up(folder, out / "copies"))) as copy:
        assert copy.execute("SELECT count(*) FROM event").fetchone() == (1,)
    assert export_dataset(folder, out / "data-set", PsychDs, frozenset(ExportOption)).participants == 1


# Where nothing may be written


@contextmanager
def read_only(folder: Path) -> Iterator[Path]:
    """Provide the folder where no file can be written, as on a medium that is read only."""
    if os.geteuid() != 0:
        folder.chmod(0o500)
        try:
            yield folder
        finally:
            folder.chmod(0o700)
        return
    mounted = folder.with_name("mounted")
    mounted.mkdir()
    mount = ["mount", "--bind", str(folder), str(mounted)], ["mount", "-o", "remount,ro,bind", str(mounted)]
    try:
        for command in mount:
            subprocess.run(command, check=True, capture_output=True, timeout=PATIENCE_S)
    except (OSError, subprocess.CalledProcessError):
        pytest.skip("nothing can be mounted here")
    try:
        yield mounted
    finally:
        subprocess.run(["umount", "-l", mounted], check=True, timeout=PATIENCE_S)  # noqa: S607 - the system's own


@POSIX
@LEFT
def test_a_database_that_is_read_only_can_be_verified_listed_copied_and_exported(
    left: Left, folder: Path, provenance: Provenance, tmp_path: Path
) -> None:
    there = left(folder, provenance, tmp_path / "there")
    before = contents(there)
    with read_only(there) as data:
        check_readable(data, tmp_path / "out")
        with closing(open_for_reading(data)) as connection, pytest.raises(sqlite3.OperationalError, match="readonly"):
            connection.execute("INSERT INTO source VALUES ('a', 'b')")
    assert contents(there) == before


@POSIX
def test_a_kiosk_does_not_open_on_a_folder_that_is_read_only(
    folder: Path, provenance: Provenance, tmp_path: Path
) -> None:
    there = at_rest(folder, provenance, tmp_path / "there")
    with read_only(there) as data, pytest.raises(UserInputError, match="cannot be used"):
        Recorder(data)


# What a reader leaves


@LEFT
def test_a_reader_leaves_no_file_where_none_was(
    left: Left, folder: Path, provenance: Provenance, tmp_path: Path
) -> None:
    there = left(folder, provenance, tmp_path / "there")
    before = contents(there)
    check_readable(there, tmp_path / "out")
    after = contents(there)
    # The shared memory is for programs that run, and a log that has something in it is not to be put away.
    assert {name: content for name, content in after.items() if not name.endswith("-shm")} == {
        name: content for name, content in before.items() if not name.endswith("-shm")
    }
    assert left is without_shared_memory or after.keys() == before.keys()


@POSIX
@LEFT
def test_a_reader_who_is_another_user_makes_no_file_at_all(
    left: Left, folder: Path, provenance: Provenance, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    there = left(folder, provenance, tmp_path / "there")
    before = contents(there)
    monkeypatch.setattr(os, "geteuid", lambda: 54321)
    for _ in range(2):
        with closing(open_for_reading(there)) as connection:
            assert connection.execute("SELECT count(*) FROM event").fetchone() == (1,)
            assert contents(there).keys() == before.keys()
    assert contents(there).keys() == before.keys()


def test_two_readers_at_once_leave_nothing_when_both_have_gone(folder: Path, provenance: Provenance) -> None:
    a_day(folder, provenance)
    before = contents(folder)
    first, second = open_for_reading(folder), open_for_reading(folder)
    first.close()
    assert second.execute("SELECT count(*) FROM session").fetchone() == (4,)
    second.close()
    assert contents(folder).keys() == before.keys()


def test_a_kiosk_that_opens_beside_a_reader_keeps_its_log(folder: Path, provenance: Provenance) -> None:
    a_day(folder, provenance)
    reader = open_for_reading(folder)
    with Recorder(folder) as recorder:
        recorder.begin(provenance, COMPLETED)
        reader.close()
        assert (folder / f"{FILE}-wal").stat().st_size > 0
        recorder.append(BEGUN)
    with open_repository(folder) as stored:
        assert len(stored.sessions()) == 5


def test_a_process_that_writes_a_database_never_reads_it_as_a_plain_file(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    connect = sqlite3.connect

    def unable(where: object, **how: object) -> sqlite3.Connection:
        if "mode=ro" in str(where):
            error = sqlite3.OperationalError("unable to open database file")
            error.sqlite_errorcode = sqlite3.SQLITE_CANTOPEN
            raise error
        return connect(where, **how)  # type: ignore[call-overload, no-any-return]  # as it was called

    with closing(open_for_writing(folder)) as kiosk:
        with monkeypatch.context() as patched:
            patched.setattr(sqlite3, "connect", unable)
            with pytest.raises(UserInputError, match="unable to open"):
                open_for_reading(folder)
        kiosk.execute("CREATE TABLE more (id INTEGER) STRICT")
        look = "import sqlite3, sys; c = sqlite3.connect(sys.argv[1]); c.execute('SELECT 1 FROM migration'); c.close()"
        subprocess.run([sys.executable, "-c", look, folder / FILE], check=True, timeout=PATIENCE_S)
        assert folder.joinpath(f"{FILE}-wal").exists()


@POSIX
@pytest.mark.skipif(sys.platform != "win32" and os.geteuid() != 0, reason="only root can do so for another user")
def test_what_root_does_for_another_user_leaves_that_user_s_files(folder: Path, provenance: Provenance) -> None:
    folder.mkdir(mode=0o700)
    os.chown(folder, 54321, 54321)
    person = a_day(folder, provenance)[0]
    back_up(folder, folder / FOLDER)
    withdraw(folder, person.code)
    with closing(open_for_reading(folder)):
        assert {path.stat().st_uid for path in folder.rglob("*")} == {54321}
    assert {path.stat().st_uid for path in folder.rglob("*")} == {54321}
    assert len(list((folder / FOLDER).iterdir())) == 3


# Cut off before there was a write-ahead log

SPILLED = """
import os, signal, sqlite3, sys
c = sqlite3.connect(sys.argv[1], isolation_level=None)
c.execute("PRAGMA journal_mode = DELETE")
c.execute("PRAGMA cache_size = 1")
c.execute("BEGIN")
c.execute("CREATE TABLE half (words TEXT)")
c.executemany("INSERT INTO half VALUES (?)", ((str(n) * 900,) for n in range(300)))
os.kill(os.getpid(), signal.SIGKILL)
"""


def cut_off_in_a_transaction(path: Path) -> None:
    """Have a transaction killed of which some pages stand in the file already, and a journal to take them back."""
    done = subprocess.run([sys.executable, "-c", SPILLED, path], check=False, timeout=PATIENCE_S)
    assert done.returncode == -signal.SIGKILL
    assert path.with_name(f"{path.name}-journal").stat().st_size > 0


@POSIX
def test_a_transaction_that_was_cut_off_is_taken_back_for_readers_and_then_for_the_kiosk(
    folder: Path, provenance: Provenance, tmp_path: Path
) -> None:
    there = at_rest(folder, provenance, tmp_path / "there")
    cut_off_in_a_transaction(there / FILE)
    before = contents(there)
    check_readable(there, tmp_path / "out")
    assert contents(there) == before
    with Recorder(there) as recorder:
        recorder.begin(provenance, COMPLETED)
    assert verify(there) == []


@POSIX
def test_a_database_whose_making_was_cut_off_is_made_anew(folder: Path, provenance: Provenance) -> None:
    folder.mkdir()
    cut_off_in_a_transaction(folder / FILE)
    with Recorder(folder) as recorder:
        recorder.begin(provenance, COMPLETED)
    assert verify(folder) == []


# Damaged, and full


def with_a_schema_that_is_no_text(folder: Path, provenance: Provenance) -> None:
    """Damage the text of the schema, which SQLite quotes when it complains."""
    a_day(folder, provenance)
    content = (folder / FILE).read_bytes()
    assert b"CREATE TABLE visit" in content
    (folder / FILE).write_bytes(content.replace(b"CREATE TABLE visit", b"CREATE TABL\xea vi\xffit"))


def test_damage_that_sqlite_quotes_is_told_in_a_sentence(folder: Path, provenance: Provenance, tmp_path: Path) -> None:
    with_a_schema_that_is_no_text(folder, provenance)
    looks: tuple[Callable[[], object], ...] = (
        lambda: verify(folder),
        lambda: back_up(folder, tmp_path / "copies"),
        lambda: open_for_reading(folder),
        lambda: Recorder(folder),
    )
    for look in looks:
        with pytest.raises(UserInputError, match="it is damaged: the text of its schema cannot be read"):
            look()
    (found,) = probe(folder, busy=False)
    assert (found.severity, "backups" in found.remedy) == (Severity.ERROR, True)


def failing_with(code: int, words: str) -> Callable[..., connecting.Connection]:
    """Return what connects and fails so."""

    def fail(*_: object, **__: object) -> connecting.Connection:
        error = sqlite3.OperationalError(words)
        error.sqlite_errorcode = code
        raise error

    return fail


FULL = (sqlite3.SQLITE_FULL, "database or disk is full")
NO_ROOM_FOR_SHARED_MEMORY = (sqlite3.SQLITE_IOERR_SHMSIZE, "disk I/O error")
NO_ROOM_FOR_A_LOG = (sqlite3.SQLITE_CANTOPEN, "unable to open database file")


@pytest.mark.parametrize("what", [FULL, NO_ROOM_FOR_SHARED_MEMORY, NO_ROOM_FOR_A_LOG], ids=lambda what: what[1])
def test_a_full_disk_is_called_one_whatever_sqlite_says(
    what: tuple[int, str], folder: Path, provenance: Provenance, monkeypatch: pytest.MonkeyPatch
) -> None:
    a_day(folder, provenance)
    monkeypatch.setattr(connecting, "is_nearly_full", lambda _: True)
    monkeypatch.setattr(database, "for_writing", failing_with(*what))
    with pytest.raises(StorageError, match=r"the database .* cannot be used: disk full"):
        Recorder(folder)
    monkeypatch.setattr(database, "for_reading", failing_with(*what))
    with pytest.raises(UserInputError, match=r"the database .* cannot be read: disk full"):
        verify(folder)
    (found,) = probe(folder, busy=False)
    assert found.severity is Severity.ERROR
    assert found.remedy == "make room on the disk; what is stored is intact"


@pytest.mark.parametrize(
    "what",
    [(sqlite3.SQLITE_IOERR, "disk I/O error"), (sqlite3.SQLITE_BUSY, "database is locked"), FULL],
    ids=lambda what: what[1],
)
def test_no_remedy_advises_to_leave_a_folder_that_may_be_intact(
    what: tuple[int, str], folder: Path, provenance: Provenance, monkeypatch: pytest.MonkeyPatch
) -> None:
    a_day(folder, provenance)
    monkeypatch.setattr(database, "for_reading", failing_with(*what))
    (found,) = probe(folder, busy=False)
    assert found.severity is Severity.ERROR
    assert not [words for words in ("--data", FOLDER, "copy", "another folder") if words in found.remedy]


@POSIX
def test_a_medium_that_is_read_only_is_not_called_full(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shutil, "disk_usage", lambda _: SimpleNamespace(free=0))
    assert is_nearly_full(tmp_path)
    monkeypatch.setattr(os, "statvfs", lambda _: SimpleNamespace(f_flag=os.ST_RDONLY))
    assert not is_nearly_full(tmp_path)


def test_a_disk_that_fails_for_now_is_not_called_bad_input(
    folder: Path, provenance: Provenance, monkeypatch: pytest.MonkeyPatch
) -> None:
    a_day(folder, provenance)
    monkeypatch.setattr(database, "for_writing", failing_with(sqlite3.SQLITE_BUSY, "database is locked"))
    with pytest.raises(StorageError, match="database is locked"):
        Recorder(folder)
    monkeypatch.undo()
    with suppress(StorageError), Recorder(folder) as recorder:
        assert recorder.begin(provenance, COMPLETED).session == 5
