"""Open the database of a data folder: created, migrated, or refused in one sentence."""

from __future__ import annotations

import os
import sqlite3
import sys
from contextlib import closing, suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING

from kiosk import UserInputError
from kiosk.experiment.outcomes import SessionKind
from kiosk.files import make_folder
from kiosk.store.connecting import (
    Connection,
    failure,
    for_reading,
    for_writing,
    give_to_owner_of_folder,
    in_memory,
    make_private,
    primary_code,
    reason,
)
from kiosk.store.migrations import MIGRATIONS, SCHEMA

if TYPE_CHECKING:
    from filelock import FileLock

FILE = "recollect.db"
LOCK = "recollect.lock"
BACKUPS = "backups"
"""Where copies are kept in a data folder, unless told otherwise."""

_OURS = ("recollect*", f"{BACKUPS}/recollect*", f"{BACKUPS}/*.lock", "status.json")
"""What an earlier version, a copy by hand or another system may have left open to others."""

LOCK_WAIT_S = 1.0
APPLICATION_ID = int.from_bytes(b"Rclt")
"""Stands in the file's header, so that a database of another program is never touched."""

CACHE_KIB = 256

BUSY = (sqlite3.SQLITE_BUSY, sqlite3.SQLITE_LOCKED)
"""What SQLite answers where another connection holds the database."""


class Foreign(UserInputError):
    """A file in the place of the database that no Recollect made."""


class Newer(UserInputError):
    """A database that a newer Recollect wrote."""


def lock_folder(folder: Path) -> FileLock:
    """Lock a data folder for writing until the lock is released; raise UserInputError if another program writes in it.

    It comes before the database is opened: a newer program must not migrate it under a kiosk that runs. Raises
    StorageError on a full disk.
    """
    from filelock import FileLock, Timeout  # noqa: PLC0415 - readers only look at the lock

    held = FileLock(folder / LOCK)
    try:
        _make(folder)
        # A reader holds the lock for a moment, which is no reason to give up.
        held.acquire(timeout=LOCK_WAIT_S)
        give_to_owner_of_folder(folder / LOCK)
        for pattern in _OURS:
            for file in folder.glob(pattern):
                make_private(file)
    except Timeout as error:
        raise UserInputError(f"another Recollect is writing in {folder}") from error
    except OSError as error:
        raise failure(f"the data folder {folder} cannot be used", error, folder) from error
    return held


def in_use(folder: Path) -> bool:
    """Whether another process is writing in a data folder."""
    try:
        return (folder / LOCK).exists() and _is_locked(folder / LOCK)
    except OSError:
        # Where the lock cannot even be looked at, no process can be writing.
        return False


def _is_locked(file: Path) -> bool:
    """Whether another process holds a lock file; raises OSError where it cannot be looked at."""
    if sys.platform == "win32":
        from filelock import FileLock, Timeout  # noqa: PLC0415 - as above

        try:
            with FileLock(file, blocking=False):
                return False
        except Timeout:
            return True
    import fcntl  # noqa: PLC0415 - there is none on Windows

    # What FileLock does, which takes longer to load than a list of sessions to print.
    looking = os.open(file, os.O_RDWR)
    try:
        fcntl.flock(looking, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    finally:
        os.close(looking)
    return False


def wait_until_free(folder: Path, within_s: float) -> None:
    """Wait so long, and no longer, for another program that is writing in a data folder."""
    if not in_use(folder):
        return
    from filelock import FileLock, Timeout  # noqa: PLC0415 - as above

    with suppress(Timeout, OSError), FileLock(folder / LOCK, timeout=within_s):
        pass


def open_for_writing(folder: Path) -> Connection:
    """Open the database of a data folder, made or migrated as needed.

    Every transaction is on the disk when it is committed (WAL, synchronous FULL). Raises UserInputError, and leaves the
    file as it is, if it is foreign, newer or unreadable; StorageError if the disk does not take it, as when it is full.
    """
    path = folder / FILE
    try:
        _make(folder)
        if path.exists():
            if not path.is_file():
                raise UserInputError(f"the database {path} cannot be used: it is not a file")
            _ours(path).close()
        connection = for_writing(path)
        try:
            _prepare(connection)
        except BaseException:
            connection.close()
            raise
    except OSError as error:
        raise failure(f"the data folder {folder} cannot be used", error, folder) from error
    except sqlite3.Error as error:
        raise failure(f"the database {path} cannot be used", error, folder) from error
    return connection


def open_for_reading(folder: Path) -> Connection:
    """Open the database of a data folder without any right to change it; raises UserInputError if that cannot be done.

    Of an older one a copy in memory is opened, which has taken the steps that it lacks.
    """
    connection = open_as_it_is(folder)
    if connection.execute("PRAGMA user_version").fetchone()[0] == SCHEMA:
        return connection
    copy = in_memory()
    try:
        with closing(connection):
            connection.backup(copy)
        _migrate(copy)
        copy.execute("PRAGMA query_only = ON")
    except sqlite3.Error as error:
        copy.close()
        raise unreadable(error, folder) from error
    return copy


def has_database(folder: Path) -> bool:
    """Tell whether a data folder has a database, whatever it is like."""
    return (folder / FILE).is_file()


def has_sessions(folder: Path) -> bool:
    """Tell whether a data folder has stored sessions, or a database that cannot be looked into."""
    kinds = _kinds_of_sessions(folder)
    return kinds is None or bool(kinds)


def has_only_trials(folder: Path) -> bool:
    """Tell whether all stored sessions of a data folder are trials, and there is one."""
    return _kinds_of_sessions(folder) == {SessionKind.TRIAL}


def _kinds_of_sessions(folder: Path) -> set[int] | None:
    """Return the kinds of the stored sessions; None for a database that cannot be looked into."""
    if not has_database(folder):
        return set()
    try:
        with closing(open_for_reading(folder)) as connection:
            return {kind for (kind,) in connection.execute("SELECT DISTINCT kind FROM session")}
    except (UserInputError, sqlite3.Error):
        return None


def open_as_it_is(folder: Path) -> Connection:
    """Open a database for reading as ``open_for_reading`` does, but leave an older one as it was written."""
    path = folder / FILE
    if not path.is_file():
        raise UserInputError(f"there is no database in {folder}")
    try:
        connection = _ours(path)
        try:
            connection.execute("SELECT 1 FROM migration")
        except BaseException:
            connection.close()
            raise
    except (OSError, sqlite3.Error) as error:
        raise unreadable(error, folder) from error
    return connection


def open_copy(path: Path) -> Connection:
    """Open a copy of a database for reading; raises UserInputError, sqlite3.Error or OSError if it cannot be read."""
    return _ours(path)


def unreadable(error: OSError | sqlite3.Error, folder: Path) -> UserInputError:
    """Return what to raise when the database of a folder cannot be read."""
    return UserInputError(f"the database {folder / FILE} cannot be read: {reason(error, folder)}")


def _make(folder: Path) -> None:
    try:
        make_folder(folder)
    except FileExistsError as error:
        raise UserInputError(f"the data folder {folder} cannot be used: it is a file") from error


def _prepare(connection: sqlite3.Connection) -> None:
    _migrate(connection)
    make_durable(connection)
    connection.execute("PRAGMA foreign_keys = ON")
    # It only ever adds rows: the usual cache of 2 MB would fill over a day and look like a leak.
    connection.execute(f"PRAGMA cache_size = -{CACHE_KIB}")


def make_durable(connection: sqlite3.Connection) -> None:
    """Have every transaction of a connection on the disk when it is committed."""
    connection.execute("PRAGMA journal_mode = WAL")
    connection.execute("PRAGMA synchronous = FULL")


def _ours(path: Path) -> Connection:
    """Connect to a database for reading; raises UserInputError, and leaves it as it is, if it is foreign or newer."""
    try:
        connection = for_reading(path)
        try:
            _refuse_foreign_or_newer(connection, path)
        except BaseException:
            connection.close()
            raise
    except sqlite3.DatabaseError as error:
        if primary_code(error) != sqlite3.SQLITE_NOTADB:
            raise
        raise _foreign(path) from error
    return connection


def _refuse_foreign_or_newer(connection: Connection, path: Path) -> None:
    # One without a page is neither: its making was cut off, or has not begun.
    if connection.execute("PRAGMA page_count").fetchone()[0] == 0:
        return
    if connection.execute("PRAGMA application_id").fetchone()[0] != APPLICATION_ID:
        raise _foreign(path)
    schema = connection.execute("PRAGMA user_version").fetchone()[0]
    _refuse_newer(schema, path)
    if schema < MIGRATIONS[0].number:
        raise Foreign(f"{path} has the schema {schema}, which no released Recollect wrote; it was left as it is")


def _foreign(path: Path) -> Foreign:
    return Foreign(f"{path} is not a Recollect database; it was left as it is")


def _refuse_newer(schema: int, path: Path) -> None:
    if schema > SCHEMA:
        raise Newer(
            f"{path} was written by a newer Recollect (schema {schema}, this one knows {SCHEMA}); it was left as it is"
        )


def _migrate(connection: sqlite3.Connection) -> None:
    """Apply the steps that are missing, all or none of them."""
    schema: int = connection.execute("PRAGMA user_version").fetchone()[0]
    if schema == SCHEMA:
        return
    connection.execute("BEGIN IMMEDIATE")
    try:
        for migration in (step for step in MIGRATIONS if step.number > schema):
            for statement in migration.statements:
                connection.execute(statement)
            connection.execute(
                "INSERT INTO migration VALUES (?, ?, ?, ?)",
                (migration.number, migration.name, migration.sha256, datetime.now(UTC).isoformat()),
            )
        connection.execute(f"PRAGMA application_id = {APPLICATION_ID}")
        connection.execute(f"PRAGMA user_version = {SCHEMA}")
        connection.execute("COMMIT")
    except BaseException:
        connection.execute("ROLLBACK")
        raise
    connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
