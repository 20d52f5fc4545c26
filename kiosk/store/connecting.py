"""Connections to a database file, and folders that are written whole or not at all."""

from __future__ import annotations

import os
import shutil
import sqlite3
import stat
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager, suppress
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from weakref import WeakSet

from kiosk import DISK_FULL, StorageError, UserInputError, is_nearly_full, unwritable, why
from kiosk.files import make_folder, sync_folder, sync_tree

PRIVATE = 0o600
"""What people said is for the user who runs the kiosk alone. SQLite gives its logs the mode of the database."""

LOGS = ("-wal", "-shm", "-journal")
"""What SQLite keeps beside a database."""

_DAMAGED = "it is damaged: the text of its schema cannot be read"

_UNABLE = {sqlite3.SQLITE_CANTOPEN, sqlite3.SQLITE_READONLY, sqlite3.SQLITE_IOERR, sqlite3.SQLITE_FULL}
"""What SQLite says where it may not or cannot make the files that it needs for reading."""

_PASSING = {
    *(sqlite3.SQLITE_FULL, sqlite3.SQLITE_IOERR, sqlite3.SQLITE_BUSY, sqlite3.SQLITE_LOCKED),
    *(sqlite3.SQLITE_NOMEM, sqlite3.SQLITE_PROTOCOL),
}
"""What is the fault of the disk or of another program, and not of the database."""

LONGEST_BYTES = 64 * 1024 * 1024
"""No text of a session comes near it; a file from elsewhere may have one that fills the memory."""

STEPS, STEPS_PER_BYTE = 50_000_000, 100
"""How many steps of SQLite's machine all reading of a connection may take, for any file and for each byte of it.

To verify a database takes 0.5 steps a byte, to export it 0.1. A file whose pages were linked by hand can be read
without end. Steps are counted and not seconds, so that a slow machine refuses nothing.
"""
_STEPS_AT_ONCE = 1_000_000
"""How often they are counted: some 100 times a second."""

_LONGEST_SQL = 1_000_000
"""A statement of the schema is at most 2 KiB."""

TOO_LONG = "a text in it is longer than any that Recollect writes"
TOO_MANY_STEPS = "it takes longer to read than any database of its size that Recollect wrote"

_TRIES = 20
_WAIT_S = 0.05
"""How often, and after which pause, a file is copied again because it changed meanwhile."""

_writers: WeakSet[Connection] = WeakSet()


class Connection(sqlite3.Connection):
    """A connection that has words for a damaged schema, and clears up when it is closed."""

    path: Path
    clear_up: Callable[[], None] | None = None

    def execute(self, sql: str, parameters: Any = (), /) -> sqlite3.Cursor:
        """Run a statement; raises sqlite3.Error where Python cannot decode what SQLite says."""
        try:
            return super().execute(sql, parameters)
        except UnicodeDecodeError as error:
            # SQLite quotes the schema in its message, and damaged bytes are no text.
            damaged = sqlite3.DatabaseError(_DAMAGED)
            damaged.sqlite_errorcode = sqlite3.SQLITE_CORRUPT
            raise damaged from error

    def close(self) -> None:
        """Close it, and clear up after it once."""
        super().close()
        _writers.discard(self)
        clear_up, self.clear_up = self.clear_up, None
        if clear_up is not None:
            clear_up()


def for_writing(path: Path) -> Connection:
    """Connect to a database, made if need be, so that only its owner may read it and its logs."""
    with suppress(FileExistsError):
        path.touch(mode=PRIVATE, exist_ok=False)
        give_to_owner_of_folder(path)
    for file in (path, *(_beside(path, log) for log in LOGS)):
        make_private(file)
    # With uri=True another database can be attached for reading only; a path that is absolute is never taken for a URI.
    # The kiosk writes on a thread of its own; the recorder has one thread at a time use the connection.
    connection = sqlite3.connect(
        path.absolute(), uri=True, isolation_level=None, factory=Connection, check_same_thread=False
    )
    connection.path = path.resolve()
    _writers.add(connection)
    return connection


def make_private(file: Path) -> None:
    """Have only its owner read and write a file, whatever the umask was when it was made."""
    # A file of another user, or one that has just gone, stays as it is.
    with suppress(PermissionError, FileNotFoundError):
        if stat.S_ISREG(mode := file.lstat().st_mode) and stat.S_IMODE(mode) != PRIVATE:
            file.chmod(PRIVATE)


def give_to_owner_of_folder(path: Path) -> None:
    """Give a file that root has made to the user whose folder it is in.

    Their kiosk has to open it later.
    """
    if sys.platform == "win32" or os.geteuid() != 0:
        return
    owner = path.parent.stat()
    # Not every file system knows owners.
    with suppress(PermissionError):
        os.chown(path, owner.st_uid, owner.st_gid, follow_symlinks=False)


def distrust(connection: sqlite3.Connection, size: int) -> None:
    """Guard against a file of this many bytes that was made to harm, by its lengths or its links.

    Whether its schema is ours is looked at by the module schema.
    """
    connection.setlimit(sqlite3.SQLITE_LIMIT_LENGTH, LONGEST_BYTES)
    connection.setlimit(sqlite3.SQLITE_LIMIT_SQL_LENGTH, _LONGEST_SQL)
    steps_left = STEPS + STEPS_PER_BYTE * size

    def count() -> bool:
        nonlocal steps_left
        steps_left -= _STEPS_AT_ONCE
        return steps_left < 0

    connection.set_progress_handler(count, _STEPS_AT_ONCE)
    connection.execute("PRAGMA cell_size_check = ON")


def in_memory() -> Connection:
    """Connect to an empty database in memory."""
    return sqlite3.connect(":memory:", isolation_level=None, factory=Connection)


def for_reading(path: Path) -> Connection:
    """Connect to a database without any right to change it; raises sqlite3.Error or OSError.

    No file is left behind. Where the folder is read only, or its disk full, what is read is a copy in memory. The file
    is not trusted: what is read has limits.
    """
    if _would_be_in_the_way(path) and not _is_written_here(path):
        return _copy(path)
    at_rest = not _has_log(path)
    connection = sqlite3.connect(
        f"{path.resolve().as_uri()}?mode=ro", uri=True, isolation_level=None, factory=Connection
    )
    if at_rest:
        connection.clear_up = partial(_remove_empty_logs, path)
    try:
        distrust(connection, sum(size for _, size, _ in _state(path).values()))
        connection.execute("PRAGMA user_version").fetchone()
    except sqlite3.Error as error:
        connection.close()
        if primary_code(error) not in _UNABLE or _is_written_here(path):
            raise
        return _copy(path)
    return connection


def primary_code(error: BaseException) -> int | None:
    """Return SQLite's code for an error without its details; None where it gave none."""
    code = getattr(error, "sqlite_errorcode", None)
    return None if code is None else code & 0xFF


def reason(error: BaseException, folder: Path) -> str:
    """Say in words why a database in a folder cannot be used; a full disk is always called one."""
    if isinstance(error, OSError):
        return why(error)
    code = primary_code(error)
    if code == sqlite3.SQLITE_FULL or (code in _UNABLE and is_nearly_full(folder)):
        return DISK_FULL
    return {sqlite3.SQLITE_TOOBIG: TOO_LONG, sqlite3.SQLITE_INTERRUPT: TOO_MANY_STEPS}.get(code or 0, str(error))


def failure(what: str, error: sqlite3.Error | OSError, folder: Path) -> UserInputError | StorageError:
    """Return what to raise when a database cannot be written: StorageError where it may be possible later."""
    words = reason(error, folder)
    passing = words == DISK_FULL or primary_code(error) in _PASSING
    return StorageError(f"{what}: {words}") if passing else UserInputError(f"{what}: {words}")


def _beside(path: Path, log: str) -> Path:
    return path.with_name(path.name + log)


def _has_log(path: Path) -> bool:
    """Return whether a log with anything in it lies beside a database."""
    return any(size for file, (_, size, _) in _state(path).items() if file != path)


def _would_be_in_the_way(path: Path) -> bool:
    """Return whether reading would leave files of this user where the kiosk of another user could not open them."""
    if sys.platform == "win32":
        return False
    # What root makes beside a database, SQLite gives to its owner.
    another = os.geteuid() not in {0, path.stat().st_uid}
    return another and not all(_beside(path, log).exists() for log in ("-wal", "-shm"))


def _remove_empty_logs(path: Path) -> None:
    """Let SQLite take the empty log away that it made for a reader, unless another program uses it."""
    with (
        suppress(sqlite3.Error),
        closing(sqlite3.connect(f"{path.resolve().as_uri()}?mode=rw", uri=True, timeout=0)) as last,
    ):
        last.execute("PRAGMA user_version").fetchone()


def _is_written_here(path: Path) -> bool:
    """Return whether this very process has the database open for writing."""
    place = path.resolve()
    return any(writer.path == place for writer in list(_writers))


def _copy(path: Path) -> Connection:
    """Read a database and its logs as plain files, and open the copy in memory.

    This is never done where this process itself writes the database: when a file is closed, the process loses all locks
    that it has on it, those of SQLite as well.
    """
    for _ in range(_TRIES):
        seen = _state(path)
        content = {file.name: file.read_bytes() for file, (_, size, _) in seen.items() if size}
        if _state(path) == seen:
            return _opened(path.name, content)
        time.sleep(_WAIT_S)
    raise sqlite3.OperationalError("another program writes it all the time; try again later")


def _state(path: Path) -> dict[Path, tuple[int, int, int]]:
    """Return the files that a copy needs, and what changes when one of them is written."""
    state: dict[Path, tuple[int, int, int]] = {}
    for file in (path, _beside(path, "-wal"), _beside(path, "-journal")):
        with suppress(FileNotFoundError):
            found = file.stat()
            state[file] = found.st_ino, found.st_size, found.st_mtime_ns
    return state


def _opened(name: str, content: dict[str, bytes]) -> Connection:
    memory = in_memory()
    try:
        if len(content) > 1:
            _replay_logs(name, content, memory)
        elif database := bytearray(content.get(name, b"")):
            # Bytes 18 and 19 say that there is a write-ahead log, which a database in memory cannot have.
            database[18:20] = b"\1\1" if database[18:20] == b"\2\2" else database[18:20]
            memory.deserialize(bytes(database))
        distrust(memory, sum(map(len, content.values())))
        memory.execute("PRAGMA query_only = ON")
    except BaseException:
        memory.close()
        raise
    return memory


def _replay_logs(name: str, content: dict[str, bytes], memory: Connection) -> None:
    """Let SQLite put a database and its log together, in a folder that is gone afterwards."""
    with TemporaryDirectory(prefix="recollect-read-") as folder:
        for file, data in content.items():
            copy = Path(folder, file)
            copy.touch(mode=PRIVATE)
            copy.write_bytes(data)
        with closing(sqlite3.connect(Path(folder, name), isolation_level=None, factory=Connection)) as together:
            # A copy of nothing would be a database with a page.
            if together.execute("PRAGMA page_count").fetchone()[0]:
                together.backup(memory)


UNFINISHED = ".unfinished"


@contextmanager
def atomic_directory(out: Path) -> Iterator[Path]:
    """Provide a new folder beside ``out``, which takes its place at the end and is gone if anything goes wrong.

    It has its name once all of it is on the disk. Raises UserInputError if it cannot be made, or if the end of the
    program cut off an earlier one there: it may hold what people said, so a person should know of it. Raises OSError if
    the disk does not take all of it.
    """
    made = out.with_name(out.name + UNFINISHED)
    if made.exists():
        raise UserInputError(f"{made} was left unfinished; remove it first")
    try:
        make_folder(made)
    except OSError as error:
        raise unwritable(f"the folder {out} cannot be used", error) from error
    try:
        yield made
        # Else a power cut in the next half minute would leave files of no length under their final names.
        sync_tree(made)
        if out.exists():
            out.rmdir()
        made.rename(out)
        sync_folder(out.parent)
    finally:
        shutil.rmtree(made, ignore_errors=True)
