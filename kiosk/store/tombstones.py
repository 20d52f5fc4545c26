"""The list of people who withdrew, as keyed hashes of their codes.

It lies beside a database and beside its copies. A hash is put down before the first row is deleted, so a withdrawal
that is cut off is known, and so is an older copy that still holds the person.
"""

from __future__ import annotations

import hashlib
import sqlite3
from collections.abc import Iterable, Iterator
from contextlib import closing
from pathlib import Path

from kiosk import UserInputError
from kiosk.files import read_bytes, replace_file
from kiosk.store.connecting import PRIVATE, give_to_owner_of_folder, make_private
from kiosk.store.database import BACKUPS, open_copy
from kiosk.store.migrations import SCHEMA

FILE = "recollect.withdrawn"
_DIGITS, _CHECK_DIGITS = 64, 8


def read_tombstones(folder: Path) -> frozenset[bytes]:
    """Return the hashes that lie beside a database and beside the copies in its folder.

    A line that is damaged is passed over.
    """
    return frozenset(found for place in (folder, folder / BACKUPS) for found in _read(place / FILE))


def add_tombstones(folder: Path, hashes: Iterable[bytes]) -> None:
    """Have hashes on the disk, beside the others; raises OSError and leaves the list as it was.

    The list is made even if it has no entry: a database without one was carried here without it.
    """
    file = folder / FILE
    before = frozenset(_read(file))
    after = before | frozenset(hashes)
    if after == before and file.exists():
        return
    replace_file(file, "".join(f"{each.hex()} {_check(each)}\n" for each in sorted(after)), PRIVATE)
    make_private(file)
    give_to_owner_of_folder(file)


def list_flaws(connection: sqlite3.Connection, folder: Path) -> Iterator[str]:
    """Yield what is wrong with the list of a folder whose database has sessions."""
    lists = [place / FILE for place in (folder, folder / BACKUPS)]
    if not is_list_there(connection, folder):
        yield (
            "is missing: put the one that lay beside this database with it, for people may have withdrawn since; if "
            "there is none, open the kiosk once"
        )
        return
    torn = sum(len(_lines(file)) - len(list(_read(file))) for file in lists)
    if torn:
        yield f"has {torn} lines that cannot be read"
    there = {found for (found,) in connection.execute("SELECT hash FROM withdrawn_code")}
    lacking = len(there - read_tombstones(folder))
    if lacking:
        yield f"lacks {lacking} codes of people who withdrew by the database"


def is_list_there(connection: sqlite3.Connection, folder: Path) -> bool:
    """Return whether a list lies beside a database, or beside its copies; a database without sessions needs none."""
    if any((place / FILE).exists() for place in (folder, folder / BACKUPS)):
        return True
    has_rows = "SELECT EXISTS (SELECT 1 FROM session) OR EXISTS (SELECT 1 FROM tombstone)"
    return not connection.execute(has_rows).fetchone()[0]


def withdrawn_hashes(connection: sqlite3.Connection, folder: Path) -> frozenset[bytes]:
    """Return the hashes of all who withdrew, by a database and the lists of its folder."""
    there = (found for (found,) in connection.execute("SELECT hash FROM withdrawn_code"))
    return read_tombstones(folder).union(there)


def sessions_of(connection: sqlite3.Connection, hashes: frozenset[bytes]) -> list[int]:
    """Return the sessions that a database still holds of people who withdrew."""
    if not hashes:
        return []
    codes = connection.execute("SELECT session, hash FROM withdrawal_code")
    return sorted({session for session, code in codes if code in hashes})


def copies_with(folder: Path, hashes: frozenset[bytes]) -> Iterator[tuple[Path, list[int]]]:
    """Yield the copies in a data folder that hold people who withdrew, and their sessions there."""
    for copy in sorted((folder / BACKUPS).glob("recollect-*.db")) if hashes else ():
        sessions = sessions_in(copy, hashes)
        if sessions:
            yield copy, sessions


def sessions_in(database: Path, hashes: frozenset[bytes]) -> list[int] | None:
    """Return the sessions that a copy holds of people who withdrew; None if it cannot be read."""
    try:
        with closing(open_copy(database)) as connection:
            # Earlier schemas were never released, and have no codes.
            known = connection.execute("PRAGMA user_version").fetchone()[0] == SCHEMA
            return sessions_of(connection, hashes) if known else None
    except (OSError, sqlite3.Error, UserInputError):
        return None


def _lines(file: Path) -> list[str]:
    try:
        return read_bytes(file).decode("ascii", "replace").splitlines()
    except OSError:
        return []


def _read(file: Path) -> Iterator[bytes]:
    for line in _lines(file):
        digits, _, check = line.partition(" ")
        if len(digits) == _DIGITS and not set(digits) - set("0123456789abcdef"):
            found = bytes.fromhex(digits)
            if check == _check(found):
                yield found


def _check(found: bytes) -> str:
    return hashlib.sha256(found).hexdigest()[:_CHECK_DIGITS]
