"""Taking out one participant: every row goes, and every byte, and a tombstone stays so that counts still add up.

The hash of the code is put down first, in the list beside the database. The rows go in one transaction, which also
notes that bytes of them are still to be cleared away: from the log, from free pages and from the copies. The note goes
last. Where the program is cut off in between, the next start of the kiosk, or the same command again, finds the list
or the note and does the rest.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from kiosk import StorageError, UserInputError
from kiosk.lazy_dataclass import dataclass
from kiosk.store.codes import session_with_code, session_withdrawn_with
from kiosk.store.connecting import primary_code, reason
from kiosk.store.database import FILE, in_use, lock_folder, open_for_reading, open_for_writing
from kiosk.store.listing import participant_name
from kiosk.store.maintenance import FOLDER, back_up, list_backups, remove_all_but
from kiosk.store.participants import visits_of
from kiosk.store.remnants import clear_remnants
from kiosk.store.tombstones import add_tombstones, copies_with, sessions_of, withdrawn_hashes

READER_WAIT_MS = 1000

_LOOKED_AT = "another program is looking at the data"


@dataclass(frozen=True)
class Withdrawal:
    """What goes when a participant withdraws."""

    session: int
    """That of the first visit, if there are several."""
    participant: str
    started_at: str | None
    """None if the rows have gone already."""
    events: int
    """Those of all visits."""
    backups: int
    """How many copies in the folder's own place for copies are replaced by a fresh one."""
    cut_off: bool = False
    """Whether it was begun before, and only the rest is to be done."""
    sessions: tuple[int, ...] = ()
    """Those of all visits of the participant."""

    def to_json(self) -> dict[str, Any]:
        """Return the withdrawal as the command line prints it."""
        return {
            "session": self.session,
            "sessions": list(self.sessions),
            "participant": self.participant,
            "started_at": self.started_at,
            "events": self.events,
            "backups": self.backups,
            "cut_off_before": self.cut_off,
        }


def find_withdrawal(folder: Path, who: str | int) -> Withdrawal:
    """Return what would go with this code, or this number of a session.

    Raises UserInputError if it is unknown, or a kiosk is writing there.
    """
    with closing(open_for_reading(folder)) as connection:
        if in_use(folder):
            raise UserInputError(f"a kiosk is writing in {folder}: close it first, then withdraw")
        return _found(connection, folder, who)


def withdraw(folder: Path, who: str | int) -> Withdrawal:
    """Remove the participant with this code or session, and replace the database copies; returns what went.

    All visits of the participant go.

    A withdrawal that was cut off before is finished. Raises UserInputError if there is no such participant, or if
    another program uses the data; nothing is deleted then. Raises StorageError if the disk did not do all of it; the
    message says how far it came.
    """
    found = find_withdrawal(folder, who)
    held = lock_folder(folder)
    try:
        with closing(open_for_writing(folder)) as connection:
            _keep_to_oneself(connection)
            if not found.cut_off:
                note_intention(connection, folder, *found.sessions)
                with _alone(connection, folder):
                    for session in found.sessions:
                        bury(connection, session)
            _clean(connection, folder)
        _clear_remnants(folder)
        _replace_backups(folder)
        _forget(folder)
    finally:
        held.release()
    return found


def codes_withdrawn(folder: Path, gone: Withdrawal) -> frozenset[bytes]:
    """Return the hashes of the codes of a participant who was withdrawn."""
    with closing(open_for_reading(folder)) as connection:
        rows = connection.execute("SELECT session, hash FROM withdrawn_code").fetchall()
    return frozenset(found for session, found in rows if session in {gone.session, *gone.sessions})


def note_intention(connection: sqlite3.Connection, folder: Path, *sessions: int) -> None:
    """Put down that sessions are withdrawn, before anything of them is deleted; raises StorageError."""
    codes = [
        row
        for session in sessions
        for row in connection.execute("SELECT hash FROM withdrawal_code WHERE session = ?", (session,))
    ]
    try:
        add_tombstones(folder, (code for (code,) in codes))
    except OSError as error:
        raise StorageError(f"nothing was withdrawn: {reason(error, folder)}") from error


def is_unfinished(connection: sqlite3.Connection, folder: Path) -> bool:
    """Return whether a data folder may hold bytes of people who withdrew.

    That is so after a withdrawal that was cut off, and where an older copy was put back.
    """
    if connection.execute("SELECT EXISTS (SELECT 1 FROM unfinished_withdrawal)").fetchone()[0]:
        return True
    gone = withdrawn_hashes(connection, folder)
    return bool(sessions_of(connection, gone)) or any(copies_with(folder, gone))


def finish_cut_off(folder: Path) -> int:
    """Delete all that a data folder still holds of people who withdrew; the caller holds its lock.

    Returns how many of them still stood in the database. Raises StorageError or UserInputError if it cannot be done
    now.
    """
    with closing(open_for_writing(folder)) as connection:
        _keep_to_oneself(connection)
        back = sessions_of(connection, withdrawn_hashes(connection, folder))
        if back:
            with _alone(connection, folder):
                for session in back:
                    bury(connection, session)
        _clean(connection, folder)
    _clear_remnants(folder)
    _replace_backups(folder)
    _forget(folder)
    return len(back)


def finish_at_rest(folder: Path) -> int:
    """Do the same in a folder that no kiosk writes in, if there is anything to do."""
    held = lock_folder(folder)
    try:
        with closing(open_for_reading(folder)) as connection:
            unfinished = is_unfinished(connection, folder)
        return finish_cut_off(folder) if unfinished else 0
    finally:
        held.release()


def check_none_is_back(folder: Path) -> None:
    """Raise UserInputError if a database holds people who withdrew, as after an older copy was put back."""
    with closing(open_for_reading(folder)) as connection:
        back = sessions_of(connection, withdrawn_hashes(connection, folder))
    if back:
        sessions = ", ".join(map(str, back))
        raise UserInputError(
            f"{folder} still holds people who withdrew (session {sessions}): 'recollect verify --data {folder}' "
            "deletes them, and so does the next start of the kiosk"
        )


def _found(connection: sqlite3.Connection, folder: Path, who: str | int) -> Withdrawal:
    copies = len(list_backups(folder / FOLDER))
    session = who if isinstance(who, int) else session_with_code(connection, who)
    if session is None and not isinstance(who, int):
        # One of several visits may have been deleted at once, when its visitor stopped it.
        session = session_withdrawn_with(connection, who)
    visits = () if session is None else visits_of(connection, session)
    if visits:
        site, number, started_at = connection.execute(
            "SELECT session.site, number, started_at FROM participant"
            " JOIN session ON session.id = participant.session WHERE session.id = ?",
            visits[:1],
        ).fetchone()
        marks = ", ".join("?" * len(visits))
        (events,) = connection.execute(
            f"SELECT count(*) FROM event WHERE session IN ({marks})",  # noqa: S608 - marks
            visits,
        ).fetchone()
        name = participant_name(site, number)
        return Withdrawal(visits[0], name, started_at, events, copies, sessions=visits)
    row = connection.execute(
        "SELECT session, site, number FROM unfinished_withdrawal JOIN tombstone USING (session) WHERE session = ?",
        (who if isinstance(who, int) else session_withdrawn_with(connection, who),),
    ).fetchone()
    if row is not None:
        session, site, number = row
        return Withdrawal(session, participant_name(site, number), None, 0, copies, cut_off=True)
    if isinstance(who, int):
        raise UserInputError(f"no participant in {folder} has the session {who}")
    if session_withdrawn_with(connection, who) is not None:
        raise UserInputError(f"the participant with this code has been withdrawn from {folder}; nothing is left to do")
    raise UserInputError(f"no participant in {folder} has this code")


def _keep_to_oneself(connection: sqlite3.Connection) -> None:
    """Keep other programs out from the next transaction on, and write zeros over everything that is deleted."""
    connection.execute(f"PRAGMA busy_timeout = {READER_WAIT_MS}")
    connection.execute("PRAGMA locking_mode = EXCLUSIVE")
    connection.execute("PRAGMA secure_delete = ON")


@contextmanager
def _alone(connection: sqlite3.Connection, folder: Path) -> Iterator[None]:
    """Open one transaction that no other program sees: a reader could keep what is to go in the write-ahead log."""
    try:
        connection.execute("BEGIN EXCLUSIVE")
        yield
        connection.execute("COMMIT")
    except sqlite3.Error as error:
        if primary_code(error) == sqlite3.SQLITE_BUSY:
            raise UserInputError(
                f"another program is looking at the data in {folder}: close it, then withdraw"
            ) from error
        raise StorageError(f"nothing was withdrawn: {reason(error, folder)}") from error
    finally:
        if connection.in_transaction:
            connection.execute("ROLLBACK")


def bury(connection: sqlite3.Connection, session: int) -> None:
    """Replace the rows of a session by a tombstone; the caller has a transaction open."""
    connection.execute(
        """
        INSERT INTO tombstone
        SELECT session.id, session.site, number, session.kind, condition,
            allocation_list, allocation_slot, allocation_source,
            coalesce(
                (SELECT CASE type WHEN 'SessionEnded' THEN json_extract(payload, '$.status') END
                 FROM event WHERE event.session = session.id ORDER BY seq DESC LIMIT 1),
                'interrupted'
            ),
            EXISTS (SELECT 1 FROM event WHERE event.session = session.id AND type = 'GameFinished'),
            :today, visit
        FROM session JOIN participant ON participant.session = session.id WHERE session.id = :session
        """,
        {"session": session, "today": datetime.now(UTC).date().isoformat()},
    )
    connection.execute("INSERT INTO unfinished_withdrawal VALUES (?)", (session,))
    connection.execute(
        "INSERT INTO withdrawn_code SELECT * FROM withdrawal_code WHERE session = ?"
        " AND hash NOT IN (SELECT hash FROM withdrawn_code)",
        (session,),
    )
    for table in ("head", "event", "withdrawal_code", "participant"):
        connection.execute(f"DELETE FROM {table} WHERE session = ?", (session,))  # noqa: S608 - ours
    connection.execute("DELETE FROM session WHERE id = ?", (session,))


def _clean(connection: sqlite3.Connection, folder: Path) -> None:
    """Leave no page with what has gone in the log."""
    try:
        # Not every statement that follows takes the lock that keeps other programs out.
        connection.execute("BEGIN EXCLUSIVE")
        connection.execute("COMMIT")
        _empty_log(connection)
        if connection.execute("PRAGMA auto_vacuum").fetchone()[0]:
            # In such a database, which SQLite has to be built for to make, remnants are not looked for page by page.
            connection.execute("VACUUM")
            _empty_log(connection)
    except sqlite3.Error as error:
        words = _LOOKED_AT if primary_code(error) == sqlite3.SQLITE_BUSY else reason(error, folder)
        raise _unfinished("the file could not be cleaned up", words) from error


def _clear_remnants(folder: Path) -> None:
    try:
        clear_remnants(folder / FILE)
    except (OSError, ValueError) as error:
        words = reason(error, folder) if isinstance(error, OSError) else str(error)
        raise _unfinished("the file could not be cleaned up", words) from error


def _empty_log(connection: sqlite3.Connection) -> None:
    busy, *_ = connection.execute("PRAGMA wal_checkpoint(TRUNCATE)").fetchone()
    if busy:
        raise sqlite3.OperationalError(_LOOKED_AT)


def _replace_backups(folder: Path) -> None:
    into = folder / FOLDER
    older = list_backups(into)
    try:
        fresh = back_up(folder, into, keep=1, amend=_delete_notes) if older else None
        remove_all_but(fresh, into)
    except (StorageError, UserInputError, OSError) as error:
        words = reason(error, into) if isinstance(error, OSError) else str(error)
        raise _unfinished(f"the {len(older)} copies in {into} still hold them", words) from error


def _forget(folder: Path) -> None:
    """Note that nothing is left to be done."""
    try:
        with closing(open_for_writing(folder)) as connection:
            _delete_notes(connection)
    except (sqlite3.Error, StorageError, UserInputError) as error:
        words = reason(error, folder) if isinstance(error, sqlite3.Error) else str(error)
        raise _unfinished("that it is finished could not be noted", words) from error


def _delete_notes(connection: sqlite3.Connection) -> None:
    connection.execute("PRAGMA secure_delete = ON")
    connection.execute("DELETE FROM unfinished_withdrawal")


def _unfinished(what: str, words: str) -> StorageError:
    return StorageError(
        f"the participant was withdrawn, but {what}: {words}; "
        "give the same command again, or open the kiosk, to finish it"
    )
