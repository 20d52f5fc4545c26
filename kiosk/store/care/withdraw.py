"""Taking out one participant: every row goes, and every byte, and a tombstone stays so that counts still add up."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from kiosk import BadInput
from kiosk.store.care.backup import FOLDER, back_up, backups
from kiosk.store.database import in_use, lock, open_for_reading, open_for_writing
from kiosk.store.people.participants import checked_code, participant_name
from kiosk.store.recorder import StoreFailed

READER_WAIT_MS = 1000


@dataclass(frozen=True)
class Withdrawal:
    """What goes when a participant withdraws."""

    sitting: int
    participant: str
    started_at: str
    events: int
    backups: int
    """How many copies in the folder's own place for copies are replaced by a fresh one."""

    def to_json(self) -> dict[str, Any]:
        """The withdrawal as the command line prints it."""
        return {
            "sitting": self.sitting,
            "participant": self.participant,
            "started_at": self.started_at,
            "events": self.events,
            "backups": self.backups,
        }


def find(folder: Path, code: str) -> Withdrawal:
    """What would go with this code; raises BadInput if nobody has it, or if a kiosk is writing there."""
    with closing(open_for_reading(folder)) as connection:
        if in_use(folder):
            raise BadInput(f"a kiosk is writing in {folder}: close it first, then withdraw")
        return _found(connection, folder, code)


def withdraw(folder: Path, code: str) -> Withdrawal:
    """Take out whoever has this code, and replace the copies of the database by a fresh one; returns what went.

    Raises BadInput if nobody has the code, or if anybody else is at the data; nothing has gone then. Raises StoreFailed
    if the disk did not do all of it; the message says how far it came.
    """
    found = find(folder, code)
    held = lock(folder)
    try:
        with closing(open_for_writing(folder)) as connection:
            with _alone(connection, folder):
                _bury(connection, found.sitting)
            _clean(connection)
        _replace_backups(folder)
    finally:
        held.release()
    return found


def _found(connection: sqlite3.Connection, folder: Path, code: str) -> Withdrawal:
    row = connection.execute(
        """
        SELECT sitting.id, sitting.site, number, started_at, (SELECT count(*) FROM event WHERE sitting = sitting.id)
        FROM participant JOIN sitting ON sitting.id = participant.sitting WHERE code = ?
        """,
        (checked_code(code),),
    ).fetchone()
    if row is None:
        raise BadInput(f"nobody in {folder} has the code {code}")
    sitting, site, number, started_at, events = row
    return Withdrawal(sitting, participant_name(site, number), started_at, events, len(backups(folder / FOLDER)))


@contextmanager
def _alone(connection: sqlite3.Connection, folder: Path) -> Iterator[None]:
    """One transaction in which nobody else even looks: a reader could keep what is to go in the write-ahead log."""
    connection.execute(f"PRAGMA busy_timeout = {READER_WAIT_MS}")
    connection.execute("PRAGMA locking_mode = EXCLUSIVE")
    connection.execute("PRAGMA secure_delete = ON")
    try:
        connection.execute("BEGIN EXCLUSIVE")
        yield
        connection.execute("COMMIT")
    except sqlite3.Error as error:
        if getattr(error, "sqlite_errorcode", None) == sqlite3.SQLITE_BUSY:
            raise BadInput(f"another program is looking at the data in {folder}: close it, then withdraw") from error
        raise StoreFailed(f"nothing was withdrawn: {error}") from error
    finally:
        if connection.in_transaction:
            connection.execute("ROLLBACK")


def _bury(connection: sqlite3.Connection, sitting: int) -> None:
    connection.execute(
        """
        INSERT INTO tombstone
        SELECT sitting.id, sitting.site, number, sitting.simulated, condition, list, place, allotted,
            coalesce(
                (SELECT CASE type WHEN 'SittingEnded' THEN json_extract(body, '$.status') END
                 FROM event WHERE event.sitting = sitting.id ORDER BY seq DESC LIMIT 1),
                'interrupted'
            ),
            EXISTS (SELECT 1 FROM event WHERE event.sitting = sitting.id AND type = 'GameFinished'),
            ?2
        FROM sitting JOIN participant ON participant.sitting = sitting.id WHERE sitting.id = ?1
        """,
        (sitting, datetime.now(UTC).date().isoformat()),
    )
    connection.execute("DELETE FROM event WHERE sitting = ?", (sitting,))
    connection.execute("DELETE FROM participant WHERE sitting = ?", (sitting,))
    connection.execute("DELETE FROM sitting WHERE id = ?", (sitting,))


def _clean(connection: sqlite3.Connection) -> None:
    """Leave no page with what has gone: not in the log, and not among the pages that are free."""
    try:
        connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
        connection.execute("VACUUM")
        connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    except sqlite3.Error as error:
        raise StoreFailed(f"the participant was withdrawn, but the file could not be cleaned up: {error}") from error


def _replace_backups(folder: Path) -> None:
    into = folder / FOLDER
    older = backups(into)
    if not older:
        return
    try:
        back_up(folder, into, keep=1)
        for copy in older:
            copy.unlink(missing_ok=True)
    except (StoreFailed, BadInput, OSError) as error:
        raise StoreFailed(
            f"the participant was withdrawn, but the {len(older)} copies in {into} still hold them: {error}"
        ) from error
