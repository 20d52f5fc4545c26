"""Opening the one database file: created, migrated, or refused in words and left as it is."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from datetime import UTC, datetime
from pathlib import Path

from filelock import FileLock, Timeout

from kiosk import BadInput
from kiosk.store.connecting import (
    Connection,
    failure,
    for_reading,
    for_writing,
    give_to_owner_of_folder,
    in_memory,
    primary_code,
    reason,
)
from kiosk.store.migrations import MIGRATIONS, SCHEMA

FILE = "recollect.db"
LOCK = "recollect.lock"
LOCK_WAIT_S = 1.0
APPLICATION_ID = int.from_bytes(b"Rclt")
"""Stands in the file's header, so that a database of another program is never touched."""

CACHE_KIB = 256

BUSY = (sqlite3.SQLITE_BUSY, sqlite3.SQLITE_LOCKED)
"""What SQLite answers where another connection holds the database."""


class Foreign(BadInput):
    """A file in the place of the database that no Recollect made."""


class Newer(BadInput):
    """A database that a newer Recollect wrote."""


def lock(folder: Path) -> FileLock:
    """Be the only one who writes in a data folder, until the lock is released; raises BadInput if somebody else does.

    It comes before the database is opened: a newer program must not migrate it under a kiosk that runs. Raises
    StoreFailed on a full disk.
    """
    held = FileLock(folder / LOCK)
    try:
        _make(folder)
        # Whoever reads looks at the lock for a moment, and is no reason to give up.
        held.acquire(timeout=LOCK_WAIT_S)
        give_to_owner_of_folder(folder / LOCK)
    except Timeout as error:
        raise BadInput(f"another Recollect is writing in {folder}") from error
    except OSError as error:
        raise failure(f"the data folder {folder} cannot be used", error, folder) from error
    return held


def in_use(folder: Path) -> bool:
    """Whether somebody is writing in a data folder."""
    try:
        if not (folder / LOCK).exists():
            return False
        with FileLock(folder / LOCK, blocking=False):
            return False
    except Timeout:
        return True
    except OSError:
        # Where the lock cannot even be looked at, nobody can be writing.
        return False


def open_for_writing(folder: Path) -> Connection:
    """Open the database of a data folder, made or migrated as needed.

    Every transaction is on the disk when it is committed (WAL, synchronous FULL). Raises BadInput, and leaves the
    file as it is, if it is foreign, newer or unreadable; StoreFailed if the disk does not take it, as when it is full.
    """
    path = folder / FILE
    try:
        _make(folder)
        if path.exists():
            if not path.is_file():
                raise BadInput(f"the database {path} cannot be used: it is not a file")
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
    """Open the database of a data folder without any right to change it; raises BadInput if that cannot be done.

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


def has_sittings(folder: Path) -> bool:
    """Tell whether a data folder has stored sittings, or a database that cannot be looked into."""
    if not has_database(folder):
        return False
    try:
        with closing(open_for_reading(folder)) as connection:
            return bool(connection.execute("SELECT EXISTS (SELECT 1 FROM sitting)").fetchone()[0])
    except (BadInput, sqlite3.Error):
        return True


def open_as_it_is(folder: Path) -> Connection:
    """The same, but an older one is opened as it was written."""
    path = folder / FILE
    if not path.is_file():
        raise BadInput(f"there is no database in {folder}")
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


def unreadable(error: OSError | sqlite3.Error, folder: Path) -> BadInput:
    """Return what to raise when the database of a folder cannot be read."""
    return BadInput(f"the database {folder / FILE} cannot be read: {reason(error, folder)}")


def _make(folder: Path) -> None:
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    except FileExistsError as error:
        raise BadInput(f"the data folder {folder} cannot be used: it is a file") from error


def _prepare(connection: sqlite3.Connection) -> None:
    _migrate(connection)
    durable(connection)
    connection.execute("PRAGMA foreign_keys = ON")
    # It only ever adds rows: the usual cache of 2 MB would fill over a day and look like a leak.
    connection.execute(f"PRAGMA cache_size = -{CACHE_KIB}")


def durable(connection: sqlite3.Connection) -> None:
    """Have every transaction of a connection on the disk when it is committed."""
    connection.execute("PRAGMA journal_mode = WAL")
    connection.execute("PRAGMA synchronous = FULL")


def _ours(path: Path) -> Connection:
    """Connect to a database for reading; raises BadInput, and leaves it as it is, if it is foreign or newer."""
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
    _refuse_newer(connection.execute("PRAGMA user_version").fetchone()[0], path)


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
        for migration in MIGRATIONS[schema:]:
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
