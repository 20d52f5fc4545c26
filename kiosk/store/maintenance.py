"""Back up the database, and watch the free disk space."""

from __future__ import annotations

import os
import shutil
import sqlite3
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from datetime import UTC, datetime
from enum import Enum
from math import ceil
from pathlib import Path

from filelock import FileLock, Timeout

from kiosk import StorageError, UserInputError
from kiosk.files import make_folder, sync_folder
from kiosk.lazy_dataclass import dataclass
from kiosk.store.codes import keys_of
from kiosk.store.connecting import failure, for_reading, for_writing, give_to_owner_of_folder, reason
from kiosk.store.database import BACKUPS, FILE, open_as_it_is
from kiosk.store.tombstones import add_tombstones, withdrawn_hashes
from kiosk.units import MIB

WARN_MIB = 512
"""A session takes some 30 KiB; if it took twice that, a day of 200 would take 12 MiB, and each copy that is kept as
much again. 512 MiB is days of that, and what else a system writes in them: time enough to make room in the evening."""

REFUSE_MIB = 64
"""One session, the write-ahead log (4 MiB), the program's logs (4 MB) and one more copy of the database must fit in, or
the session that begins now could be lost in its middle. Below this no new one begins."""


class SpaceLevel(Enum):
    """What the room that is left allows."""

    ENOUGH = "enough"
    WARN = "warn"
    REFUSE = "refuse"


@dataclass(frozen=True)
class FreeSpace:
    """The room that is left on the disk of a data folder, in MiB."""

    free_mib: int
    hour_mib: int = REFUSE_MIB
    """What the next hour may need, the room below which no session begins included."""

    @property
    def level(self) -> SpaceLevel:
        """What it allows."""
        if self.free_mib < REFUSE_MIB:
            return SpaceLevel.REFUSE
        return SpaceLevel.WARN if self.free_mib < WARN_MIB else SpaceLevel.ENOUGH


SESSIONS_PER_HOUR = 20
"""More do not fit into an hour; with the way of the pointer each may take a MiB."""


def free_space(folder: Path, copies_per_hour: int = 1) -> FreeSpace:
    """Return the free space of a data folder, whether or not it exists yet; raise UserInputError if it is unknown."""
    there = next((place for place in (folder, *folder.absolute().parents) if place.is_dir()), folder)
    try:
        database = folder / FILE
        copy_mib = ceil(database.stat().st_size / MIB) if database.exists() else 0
        need = REFUSE_MIB + SESSIONS_PER_HOUR + copies_per_hour * copy_mib
        return FreeSpace(shutil.disk_usage(there).free // MIB, need)
    except OSError as error:
        raise UserInputError(f"the room that is left for {folder} cannot be told: {error.strerror}") from error


FOLDER = BACKUPS
"""Where copies are kept in a data folder, unless told otherwise."""

KEPT = 10
STEP_PAGES = 64
"""256 KiB at a time, so that a thread that copies lets the others go on."""

_PATTERN = "recollect-*.db"
UNFINISHED = ".unfinished"
_LOCK = "backup.lock"

Progress = Callable[[int, int], None]
"""Called with how much is done, of how much."""


def back_up(
    folder: Path,
    into: Path,
    keep: int = KEPT,
    tell: Progress = lambda _done, _of: None,
    amend: Callable[[sqlite3.Connection], None] = lambda _copy: None,
) -> Path:
    """Copy the database of a data folder, check the copy, and remove all of its copies but the newest ``keep``.

    It opens its own connection, so it may run in any thread or process while a recorder writes. Returns the copy.
    ``amend`` may change the copy before it is checked. Raises UserInputError if there is nothing to copy or no place,
    StorageError if the copy could not be written whole; older copies are then as they were.
    """
    if keep < 1:
        raise UserInputError(f"at least 1 copy must be kept, not {keep}")
    with closing(open_as_it_is(folder)) as source, alone(into):
        unfinished = into / f"{copy_name()}{UNFINISHED}"
        try:
            _copy(source, unfinished, tell, amend)
            copy = unfinished.replace(unfinished.with_suffix(""))
            add_tombstones(into, withdrawn_hashes(source, folder))
            sync_folder(into)
            _remove_older(into, copy, keep, frozenset(keys_of(source)))
        except (OSError, sqlite3.Error) as error:
            raise StorageError(f"the copy in {into} could not be written: {reason(error, into)}") from error
        finally:
            unfinished.unlink(missing_ok=True)
    return copy


def list_backups(into: Path) -> list[Path]:
    """Return the copies that a folder holds, oldest first."""
    return sorted(into.glob(_PATTERN))


def remove_all_but(kept: Path | None, into: Path) -> None:
    """Remove every copy but one, finished or not, with what SQLite may have left beside it; raises OSError."""
    for file in into.glob(f"{_PATTERN}*"):
        if kept is None or not file.name.startswith(kept.name):
            file.unlink(missing_ok=True)
    if into.is_dir():
        sync_folder(into)


@contextmanager
def alone(into: Path) -> Iterator[None]:
    """Be the only one who copies into a folder, and clear what a copy that was cut off has left."""
    try:
        if not into.is_dir():
            make_folder(into)
            give_to_owner_of_folder(into)
        with FileLock(into / _LOCK, blocking=False):
            give_to_owner_of_folder(into / _LOCK)
            for unfinished in into.glob(f"{_PATTERN}{UNFINISHED}*"):
                unfinished.unlink()
            yield
    except Timeout as error:
        raise UserInputError(f"another copy is just being made in {into}") from error
    except OSError as error:
        raise failure(f"copies cannot be kept in {into}", error, into) from error


def _remove_older(into: Path, copy: Path, keep: int, keys: frozenset[bytes]) -> None:
    # Two kiosks may keep copies in one folder, and each removes only its own.
    own = [each for each in list_backups(into) if each == copy or _is_of(each, keys)]
    for older in own[:-keep]:
        # A clock that was set back makes the newest look like the oldest.
        if older != copy:
            older.unlink()


def _is_of(copy: Path, keys: frozenset[bytes]) -> bool:
    """Whether a copy is of the database with these keys; one that cannot be read is of none."""
    try:
        with closing(for_reading(copy)) as connection:
            return not keys.isdisjoint(keys_of(connection))
    except (OSError, sqlite3.Error):
        return False


def copy_name() -> str:
    """Return the name of a copy that is made now."""
    return f"recollect-{datetime.now(UTC):%Y%m%dT%H%M%S.%f}Z.db"


def _copy(source: sqlite3.Connection, path: Path, tell: Progress, amend: Callable[[sqlite3.Connection], None]) -> None:
    # One look at the database for all steps: otherwise every write of the kiosk would make the copy start anew.
    source.execute("BEGIN")
    source.execute("SELECT count(*) FROM sqlite_master").fetchone()
    with closing(for_writing(path)) as target:
        source.backup(target, pages=STEP_PAGES, progress=lambda _, left, of: tell(of - left, of))
        # One file that can be carried away, with no log beside it.
        target.execute("PRAGMA journal_mode = DELETE")
        amend(target)
        answers = [answer for (answer,) in target.execute("PRAGMA integrity_check")]
    source.execute("ROLLBACK")
    if answers != ["ok"]:
        raise StorageError(f"the copy of {path.name} is not whole: {answers[0]}")
    with path.open("r+b") as file:
        os.fsync(file.fileno())
