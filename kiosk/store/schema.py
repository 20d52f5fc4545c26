"""Whether a database is laid out as this program makes it, and holds nothing that is too long to read."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator, Mapping
from contextlib import closing
from functools import cache
from pathlib import Path

from kiosk import UserInputError
from kiosk.store.connecting import TOO_LONG, Connection
from kiosk.store.database import open_as_it_is, open_for_reading, unreadable
from kiosk.store.migrations import MIGRATIONS

READ_FROM = frozenset({"table", "view"})
"""The kinds of a schema's parts that rows are read from; any other part changes nothing for a reader."""

NONE_OF_OURS = "is none of ours"

ALL = READ_FROM | {"index", "trigger"}

_Parts = Mapping[tuple[str, str], tuple[str, str]]
"""Each table, index, trigger and view by its kind and name: the table that it belongs to, and the statement."""

_COUNTS_OF_ANALYZE = ("sqlite_stat1", "sqlite_stat4")
"""The tables that SQLite makes where a user types ANALYZE; they say how many rows there are."""


def schema_flaws(connection: sqlite3.Connection) -> Iterator[tuple[str, str, str]]:
    """Hold the schema against that of a database made on the spot; yield kind, name and what is wrong."""
    expected, there = _made(connection.execute("PRAGMA user_version").fetchone()[0]), _parts(connection)
    for kind, name in sorted({*expected, *there}, key=lambda part: (part[0] not in READ_FROM, part)):
        if (kind, name) not in there:
            yield kind, name, "is missing"
        elif (kind, name) not in expected:
            yield kind, name, NONE_OF_OURS
        elif there[kind, name] != expected[kind, name]:
            yield kind, name, "is not as it was made"


def refuse_other_schema(connection: sqlite3.Connection, folder: Path, kinds: frozenset[str] = ALL) -> None:
    """Raise UserInputError if any part of these kinds is missing, changed or added."""
    try:
        found = [f"{kind} {name} {what}" for kind, name, what in schema_flaws(connection) if kind in kinds]
    except sqlite3.Error as error:
        raise unreadable(error, folder) from error
    if found:
        more = f", and {len(found) - 1} more" if len(found) > 1 else ""
        raise UserInputError(f"{folder} is not as it was written: {found[0]}{more}; see 'recollect verify'")


def open_checked(folder: Path) -> Connection:
    """Open a database for reading; raise UserInputError also if its tables or views are not ours."""
    connection = open_for_reading(folder)
    try:
        refuse_other_schema(connection, folder, READ_FROM)
    except BaseException:
        connection.close()
        raise
    return connection


def check_readable(folder: Path) -> None:
    """Raise UserInputError if a database has another schema, or a text that is too long to be read."""
    with closing(open_as_it_is(folder)) as connection:
        refuse_other_schema(connection, folder)
        most = connection.getlimit(sqlite3.SQLITE_LIMIT_LENGTH)
        try:
            for table in (name for kind, name in _parts(connection) if kind == "table"):
                columns = [f'length("{column}")' for _, column, *_ in connection.execute(f"PRAGMA table_info({table})")]
                longest = f"SELECT max({', '.join(f'coalesce({each}, 0)' for each in columns)}, 0) FROM {table}"  # noqa: S608
                for (length,) in connection.execute(longest):
                    if length > most:
                        raise UserInputError(f"the database of {folder} cannot be read: {TOO_LONG}")
        except sqlite3.Error as error:
            raise unreadable(error, folder) from error


@cache
def _made(steps: int) -> _Parts:
    with closing(sqlite3.connect(":memory:")) as made:
        for migration in (step for step in MIGRATIONS if step.number <= steps):
            for statement in migration.statements:
                made.execute(statement)
        return _parts(made)


def _parts(connection: sqlite3.Connection) -> _Parts:
    rows = connection.execute("SELECT type, name, tbl_name, sql FROM sqlite_master").fetchall()
    return {
        # Damaged bytes are no text.
        (str(kind), str(name)): (str(table), " ".join(str(sql or "").split()))
        for kind, name, table, sql in rows
        if not (kind == "table" and name in _COUNTS_OF_ANALYZE)
    }
