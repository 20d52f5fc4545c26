"""The chain of hashes that proves the record of a session, and the file of heads.

Every event carries a SHA-256 hash of itself and of the hash before it; the first one goes on from what the session
followed. The hash of the last event is the head of the session. The database keeps the heads, and so does a file beside
it, which is written after each commit: where the database lost its end, or a whole session, the file still knows.
"""

from __future__ import annotations

import hashlib
import json
import logging
import os
import sqlite3
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import BinaryIO

from kiosk.files import read_bytes
from kiosk.lazy_dataclass import dataclass
from kiosk.store.connecting import PRIVATE, give_to_owner_of_folder, make_private

FILE = "recollect.heads"
"""The file of heads, beside the database."""

_ANCHORED = (
    *("started_at", "seed", "condition", "embodiment", "language", "kind", "version", "code_commit", "deck"),
    *("policy_sha256", "study_sha256", "settings_sha256", "policy_source", "questionnaire_source", "sentences_source"),
    *("information_source", "about_you_source", "practice_deck", "translations"),
    *("allocation_slot", "allocation_source"),
)
"""What the first hash stands for, without what a merge changes: the number, the site and the list of a session."""

_GAPS = 100
"""How many missing sessions in a row are named one by one; a changed number could make them millions."""

_CHECK_DIGITS = 8
_LINE = 10 + 1 + 10 + 1 + 64 + 1 + _CHECK_DIGITS + 1

_log = logging.getLogger(__name__)


@dataclass(frozen=True)
class Head:
    """The end of a session's record: how many events it has, and the hash of the last one."""

    session: int
    events: int
    hash: bytes


def first_hash(connection: sqlite3.Connection, session: int) -> bytes:
    """Return the hash of what a session followed, to which its first event is chained."""
    row = connection.execute(
        f"SELECT {', '.join(_ANCHORED)} FROM session WHERE id = ?",  # noqa: S608 - the names are ours
        (session,),
    ).fetchone()
    return _anchor(row)


def _anchor(values: Sequence[object] | None) -> bytes:
    return hashlib.sha256(json.dumps(values, ensure_ascii=False, separators=(",", ":")).encode()).digest()


EventFields = tuple[int, int, str, str, int | None, str]
"""What is stored of an event: seq, at_ms, origin, type, wall_ms and payload."""


def next_hash(before: bytes, event: EventFields) -> bytes:
    """Return the hash of an event, from the one before it and all that is stored.

    It is SHA-256. All but the payload are free of spaces, so no two events come out as the same bytes.
    """
    seq, at_ms, origin, kind, wall_ms, payload = event
    return hashlib.sha256(before + f"{seq} {at_ms} {origin} {kind} {wall_ms} {payload}".encode()).digest()


def last_hash(connection: sqlite3.Connection, session: int) -> bytes:
    """Return the hash of the last event of a session."""
    row = connection.execute(
        "SELECT hash FROM event WHERE session = ? ORDER BY seq DESC LIMIT 1", (session,)
    ).fetchone()
    return bytes(row[0]) if row else first_hash(connection, session)


def broken_links(connection: sqlite3.Connection, only: int | None = None) -> Iterator[tuple[int, int]]:
    """Yield the session and the number of every event, of all sessions or of one, whose hash does not fit."""
    for session, seq, *_, fits in chained_events(connection, only):
        if not fits:
            yield session, seq


ChainedEvent = tuple[int, int, int, str, str, bool]
"""The session, seq, at_ms, type and payload of an event, and whether its hash fits."""


def chained_events(connection: sqlite3.Connection, only: int | None = None) -> Iterator[ChainedEvent]:
    """Yield every event, of all sessions or of one, in order, and whether its hash fits."""
    session, before = None, b""
    sha256 = hashlib.sha256
    which, values = ("", ()) if only is None else (" WHERE session = ?", (only,))
    for number, seq, at_ms, origin, kind, wall_ms, payload, written in connection.execute(
        "SELECT session, seq, at_ms, origin, type, wall_ms, payload, hash FROM event"  # noqa: S608 - the words are ours
        f"{which} ORDER BY session, seq",
        values,
    ):
        if number != session:
            session, before = number, first_hash(connection, number)
        # As in next_hash: millions of events are looked at, and a call for each takes as long as the hash.
        told = f"{seq} {at_ms} {origin} {kind} {wall_ms} {payload}".encode()
        yield number, seq, at_ms, kind, payload, sha256(before + told).digest() == written
        before = written if isinstance(written, bytes) else b""


LinkedEvent = tuple[int, int, str, str, int | None, str, bytes]
"""What is stored of an event, and its hash."""


def is_unbroken(session: Mapping[str, object], events: Iterable[LinkedEvent]) -> bool:
    """Return whether every hash fits, of all events of a session with this row of the database."""
    before = _anchor([session[name] for name in _ANCHORED])
    sha256 = hashlib.sha256
    for seq, at_ms, origin, kind, wall_ms, payload, written in events:
        # As in next_hash: millions of events are looked at.
        before = sha256(before + f"{seq} {at_ms} {origin} {kind} {wall_ms} {payload}".encode()).digest()
        if before != written:
            return False
    return True


def lost_ends(connection: sqlite3.Connection) -> Iterator[tuple[int, str]]:
    """Yield every session that is missing or does not reach its head, and what is wrong."""
    heads = {session: (events, head) for session, events, head in connection.execute("SELECT * FROM head")}
    for (session,) in connection.execute("SELECT id FROM session ORDER BY id"):
        if session not in heads:
            yield session, "has no head, which tells where its events end"
            continue
        events, head = heads.pop(session)
        last = connection.execute(
            "SELECT seq, hash FROM event WHERE session = ? ORDER BY seq DESC LIMIT 1", (session,)
        ).fetchone()
        if last != (events, head):
            yield session, f"had {events} events, of which the last is missing or changed"
    for session, (events, _) in heads.items():
        yield session, f"is missing; it had {events} events"
    yield from _gaps(connection)


def _gaps(connection: sqlite3.Connection) -> Iterator[tuple[int, str]]:
    there = {number for (number,) in connection.execute("SELECT id FROM session UNION SELECT session FROM tombstone")}
    there |= {number for (number,) in connection.execute("SELECT session FROM head")}
    given = connection.execute("SELECT seq FROM sqlite_sequence WHERE name = 'session'").fetchone()
    before = 0
    for number in sorted({*there, 1 + max([*there, *(given or (0,))], default=0)}):
        gap = range(before + 1, number)
        if len(gap) > _GAPS:
            yield gap[0], f"is missing, and so are all up to {gap[-1]}; their numbers were given out"
        else:
            yield from ((missing, "is missing; its number was given out") for missing in gap)
        before = number


def missing_since_written(connection: sqlite3.Connection, folder: Path) -> Iterator[tuple[int, str]]:
    """Yield every session that the database lacks, in whole or in part, by the file of heads."""
    gone = {number for (number,) in connection.execute("SELECT session FROM tombstone")}
    for head in read_heads(folder):
        if head.session in gone:
            continue
        row = connection.execute(
            "SELECT (SELECT count(*) FROM event WHERE session = :session),"
            " (SELECT hash FROM event WHERE session = :session AND seq = :events)",
            {"session": head.session, "events": head.events},
        ).fetchone()
        there, written = row
        if not there:
            yield head.session, f"is missing; {head.events} events of it were written here"
        elif written is None:
            yield head.session, f"{head.events} events of it were written here, and {there} are left"
        elif written != head.hash:
            yield head.session, f"event {head.events} is not the one that was written here"


def read_heads(folder: Path) -> list[Head]:
    """Return the heads in the file of a data folder; lines that cannot be read are left out."""
    return [head for head in _lines(_content(folder)) if head is not None]


def unreadable_lines(folder: Path) -> int:
    """Count the lines that cannot be read, without the last one, which a crash may have torn."""
    return _lines(_content(folder))[:-1].count(None)


def _content(folder: Path) -> bytes:
    try:
        return read_bytes(folder / FILE)
    except OSError:
        return b""


def _lines(content: bytes) -> list[Head | None]:
    return [_head(content[start : start + _LINE]) for start in range(0, len(content), _LINE)]


def _head(line: bytes) -> Head | None:
    """Read a line of the file of heads; None if it is not as it was written."""
    with suppress(ValueError):
        told, _, check = line.decode("ascii").rstrip("\n").rpartition(" ")
        session, events, sha256 = told.split()
        if check == _check(told):
            return Head(int(session), int(events), bytes.fromhex(sha256))
    return None


def _check(told: str) -> str:
    return hashlib.sha256(told.encode()).hexdigest()[:_CHECK_DIGITS]


class HeadsFile:
    """Writes the head of the session under way, on a line that changes with every commit.

    It follows the database and is not waited for: where it cannot be written, that is logged and costs no session.
    """

    def __init__(self, folder: Path) -> None:
        """Write in a data folder; the file is opened for the first session."""
        self._path = folder / FILE
        self._file: BinaryIO | None = None
        self._at = 0

    def begin(self) -> None:
        """Start a new line, for a session that begins or goes on; earlier lines stay."""
        self.close()
        try:
            if not self._path.exists():
                self._path.touch(mode=PRIVATE)
                make_private(self._path)
                give_to_owner_of_folder(self._path)
            self._file = self._path.open("r+b", buffering=0)
            # Only the last line may be torn after a crash, so the earlier ones must be on the disk.
            os.fsync(self._file.fileno())
            self._at = self._file.seek(0, 2) // _LINE * _LINE
            # What a crash left of a line is written over.
            if self._at:
                self._file.seek(self._at - _LINE)
                if _head(self._file.read(_LINE)) is None:
                    self._at -= _LINE
        except OSError as error:
            self._give_up(error)

    def write(self, head: Head) -> None:
        """Write the head of the session over the one that it had before."""
        if self._file is None:
            return
        told = f"{head.session:>10} {head.events:>10} {head.hash.hex()}"
        try:
            self._file.seek(self._at)
            self._file.write(f"{told} {_check(told)}\n".encode("ascii"))
        except OSError as error:
            self._give_up(error)

    def close(self) -> None:
        """Close the file."""
        if self._file is not None:
            self._file.close()
            self._file = None

    def _give_up(self, error: OSError) -> None:
        _log.error("the file of heads cannot be written: %s", error)
        with suppress(OSError):
            self.close()
