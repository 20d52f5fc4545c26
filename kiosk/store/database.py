"""Opening the one database file: created, migrated, or refused in words and left as it is."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from datetime import UTC, datetime
from pathlib import Path

from filelock import FileLock, Timeout

from kiosk import BadInput
from kiosk.store.migrations import MIGRATIONS, SCHEMA

FILE = "recollect.db"
LOCK = "recollect.lock"
LOCK_WAIT_S = 1.0
APPLICATION_ID = int.from_bytes(b"Rclt")
"""Stands in the file's header, so that a database of another program is never touched."""

CACHE_KIB = 256

BUSY = (sqlite3.SQLITE_BUSY, sqlite3.SQLITE_LOCKED)
"""What SQLite answers where another connection holds the database."""
PRIMARY_CODE = 0xFF
"""The bits of one of SQLite's answers that tell its kind; the others tell more of it."""


def lock(folder: Path) -> FileLock:
    """Be the only one who writes in a data folder, until the lock is released; raises BadInput if somebody else does.

    It comes before the database is opened: a newer program must not migrate it under a kiosk that runs.
    """
    held = FileLock(folder / LOCK)
    try:
        _make(folder)
        # Whoever reads looks at the lock for a moment, and is no reason to give up.
        held.acquire(timeout=LOCK_WAIT_S)
    except Timeout as error:
        raise BadInput(f"another Recollect is writing in {folder}") from error
    except OSError as error:
        raise BadInput(f"the data folder {folder} cannot be used: {error.strerror}") from error
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


def open_for_writing(folder: Path) -> sqlite3.Connection:
    """Open the database of a data folder, made or migrated as needed.

    Every transaction is on the disk when it is committed (WAL, synchronous FULL). Raises BadInput, and leaves the
    file as it is, if it is foreign, newer or unreadable.
    """
    path = folder / FILE
    try:
        _make(folder)
        _refuse_foreign_or_newer(path)
        connection = sqlite3.connect(path, isolation_level=None)
        try:
            _prepare(connection)
        except BaseException:
            connection.close()
            raise
    except OSError as error:
        raise BadInput(f"the data folder {folder} cannot be used: {error.strerror}") from error
    except sqlite3.Error as error:
        raise BadInput(f"the database {path} cannot be used: {error}") from error
    return connection


def open_for_reading(folder: Path, *, briefly: bool = False) -> sqlite3.Connection:
    """Open the database of a data folder without any right to change it; raises BadInput if that cannot be done.

    Of an older one a copy in memory is opened, which has taken the steps that it lacks. Whoever looks only ``briefly``
    leaves no file beside one that nobody writes, but does not see a writer who comes meanwhile.
    """
    connection = open_as_it_is(folder, briefly=briefly)
    if connection.execute("PRAGMA user_version").fetchone()[0] == SCHEMA:
        return connection
    copy = sqlite3.connect(":memory:", isolation_level=None)
    try:
        with closing(connection):
            connection.backup(copy)
        _migrate(copy)
        copy.execute("PRAGMA query_only = ON")
    except sqlite3.Error as error:
        copy.close()
        raise BadInput(f"the database {folder / FILE} cannot be read: {error}") from error
    return copy


def open_as_it_is(folder: Path, *, briefly: bool = False) -> sqlite3.Connection:
    """The same, but an older one is opened as it was written."""
    path = folder / FILE
    if not path.is_file():
        raise BadInput(f"there is no database in {folder}")
    try:
        _refuse_foreign_or_newer(path)
        connection = _read_only(path, briefly=briefly)
        try:
            connection.execute("SELECT 1 FROM migration")
        except sqlite3.Error:
            connection.close()
            raise
    except OSError as error:
        raise BadInput(f"the database {path} cannot be read: {error.strerror}") from error
    except sqlite3.Error as error:
        raise BadInput(f"the database {path} cannot be read: {error}") from error
    return connection


def _make(folder: Path) -> None:
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    except FileExistsError as error:
        raise BadInput(f"the data folder {folder} cannot be used: it is a file") from error


def _read_only(path: Path, *, briefly: bool) -> sqlite3.Connection:
    # Where no log lies beside it nobody writes, and SQLite would make one and leave it: as a file of whoever looks,
    # which another user's kiosk could not open.
    logged = any(path.with_name(f"{path.name}-{log}").exists() for log in ("wal", "journal"))
    how = "mode=ro&immutable=1" if briefly and not logged else "mode=ro"
    return sqlite3.connect(f"{path.resolve().as_uri()}?{how}", uri=True, isolation_level=None)


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


def _refuse_foreign_or_newer(path: Path) -> None:
    """Look at the header alone: even opening a database can change it, or the files beside it."""
    if not path.exists() or path.stat().st_size == 0:
        return
    # Never read it as a file: whoever closes one loses all locks that this process has on it, also those of SQLite,
    # and the next program that looks into the database takes away the log under the kiosk's hands.
    try:
        with closing(sqlite3.connect(f"{path.resolve().as_uri()}?mode=ro&immutable=1", uri=True)) as connection:
            application = connection.execute("PRAGMA application_id").fetchone()[0]
            schema = connection.execute("PRAGMA user_version").fetchone()[0]
    except sqlite3.DatabaseError as error:
        if error.sqlite_errorcode != sqlite3.SQLITE_NOTADB:
            raise
        application, schema = 0, 0
    if application != APPLICATION_ID:
        raise BadInput(f"{path} is not a Recollect database; it was left as it is")
    _refuse_newer(schema, path)
    if path.with_name(f"{path.name}-wal").exists():
        # A newer number may still stand in the write-ahead log alone; only a connection that may write would move it.
        with closing(_read_only(path, briefly=True)) as connection:
            _refuse_newer(connection.execute("PRAGMA user_version").fetchone()[0], path)


def _refuse_newer(schema: int, path: Path) -> None:
    if schema > SCHEMA:
        raise BadInput(
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
