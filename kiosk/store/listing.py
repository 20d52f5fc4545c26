"""List the stored sessions and count them, without reading what happened in them."""

from __future__ import annotations

import sqlite3
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from contextlib import closing, contextmanager
from dataclasses import dataclass
from datetime import UTC, date, datetime, time, timedelta
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from kiosk import UserInputError
from kiosk.experiment.outcomes import CARDS_IN_A_MOVE, AllocationSource, SessionKind, Stage, Status
from kiosk.store.database import in_use, unreadable
from kiosk.store.schema import open_checked
from kiosk.store.summaries import numbers_so_far
from kiosk.units import MS_PER_SECOND

if TYPE_CHECKING:
    from kiosk.store.participants import EnrolmentCounts


def participant_name(site: str, number: int) -> str:
    """Return a participant's number with the site, if it has one."""
    return f"{site}-{number}" if site else str(number)


@dataclass(frozen=True)
class StoredSession:
    """A stored session at a glance; ``status`` is None while it is under way.

    ``participant`` is None in sessions from before people were numbered, ``allocation_source`` where no allocation list
    was followed. ``stage`` is where it ended, or is; None if it got nowhere. ``flips``, ``pairs`` and
    ``hints`` are those of the game. ``started_at`` is in UTC; ``duration_ms`` is from its first event to its last.
    """

    id: int
    started_at: str
    condition: str
    embodiment: str
    status: Status | None
    kind: SessionKind
    flips: int
    pairs: int
    hints: int
    duration_ms: int
    participant: str | None
    stage: Stage | None
    allocation_source: AllocationSource | None
    visit: int = 1
    """Which visit of the participant it was."""
    record_sha256: str | None = None
    """The end of the chain of hashes over its events; None if the database has lost it."""

    @property
    def moves(self) -> int:
        """How many moves of two flips were made."""
        return self.flips // CARDS_IN_A_MOVE

    @property
    def began(self) -> datetime:
        """When it began, in the time zone of this machine."""
        return datetime.fromisoformat(self.started_at).astimezone()

    def to_json(self) -> dict[str, Any]:
        """Return the session as the command line prints it."""
        return {
            "session": self.id,
            "participant": self.participant,
            "visit": self.visit,
            "status": self.status.value if self.status else RUNNING,
            "stage": self.stage.value if self.stage else None,
            "allocation_source": self.allocation_source.value if self.allocation_source else None,
            "condition": self.condition,
            "embodiment": self.embodiment,
            "flips": self.flips,
            "moves": self.moves,
            "pairs": self.pairs,
            "hints": self.hints,
            "duration_s": round(self.duration_ms / MS_PER_SECOND),
            "simulated": self.kind is SessionKind.SIMULATED,
            "trial": self.kind is SessionKind.TRIAL,
            "record_sha256": self.record_sha256,
        }


RUNNING = "running"
"""The status of a session that is under way."""


@dataclass(frozen=True)
class SessionFilter:
    """Which sessions are meant: all of them, unless something is said.

    ``since`` and ``until`` are local days, of which the last one belongs to it. ``status`` is a value of Status, or
    RUNNING.
    """

    kind: SessionKind | None = None
    condition: str | None = None
    status: str | None = None
    site: str | None = None
    since: date | None = None
    until: date | None = None

    def where(self, *, in_use: bool) -> tuple[str, dict[str, str | int]]:
        """Return the condition in SQL and its values; without ``in_use`` no session is under way."""
        asked: dict[str, tuple[str, str | int | None]] = {
            "kind": ("session.kind = :kind", None if self.kind is None else int(self.kind)),
            "condition": ("condition = :condition", self.condition),
            "site": ("session.site = :site", self.site),
            "since": ("started_at >= :since", _began(self.since)),
            "until": ("started_at < :until", _began(self.until and self.until + timedelta(days=1))),
            "status": (_STATUS.format(RUNNING if in_use else Status.INTERRUPTED.value), self.status),
        }
        given = {name: (words, value) for name, (words, value) in asked.items() if value is not None}
        words = " AND ".join(words for words, _ in given.values()) or "true"
        return words, {name: value for name, (_, value) in given.items()}


_STATUS = "coalesce(status, '{}') = :status"


def _began(day: date | None) -> str | None:
    """Return the first moment of a local day as ``started_at`` says it."""
    if day is None:
        return None
    return datetime.combine(day, time.min).astimezone(UTC).isoformat(timespec="milliseconds")


@dataclass(frozen=True)
class SessionTotals:
    """How many sessions there are, by status, and the median duration of the completed ones in ms."""

    by_status: Mapping[str, int]
    median_ms: float | None

    @property
    def sessions(self) -> int:
        """All of them."""
        return sum(self.by_status.values())


def _median(durations: list[int]) -> float | None:
    """Return the median; the library's loads fractions and decimals, which takes longer than the list."""
    if not durations:
        return None
    ordered, half = sorted(durations), len(durations) // 2
    return float(ordered[half] if len(durations) % 2 else (ordered[half - 1] + ordered[half]) / 2)


class SessionList:
    """The sessions of one data folder, at a glance."""

    def __init__(self, connection: sqlite3.Connection, *, in_use: bool) -> None:
        """``in_use``: a kiosk is writing, so that a session without an end may still get one."""
        self._connection = connection
        self._unended = None if in_use else Status.INTERRUPTED

    def sessions(
        self,
        which: SessionFilter = SessionFilter(),
        *,
        newest: int = -1,
        skip: int = 0,
        tell: Callable[[str], None] | None = None,
    ) -> list[StoredSession]:
        """Return sessions in the order in which they began.

        Of those that ``which`` means it returns the ``newest``, or all if that is -1, without the last ``skip``. One
        that cannot be read raises UserInputError; if ``tell`` is given, it hears of it, and the session is left out.
        """
        where, values = self._where(which)
        query = f"{_SESSIONS} WHERE {where} ORDER BY session.id DESC LIMIT :newest OFFSET :skip"
        found: list[StoredSession] = []
        for row in self._rows(query, values | {"newest": newest, "skip": skip}):
            try:
                found.append(self._session(row))
            except UserInputError as error:
                if tell is None:
                    raise
                tell(str(error))
        return found[::-1]

    def totals(self, which: SessionFilter = SessionFilter()) -> SessionTotals:
        """Count sessions by status."""
        where, values = self._where(which)
        unended = RUNNING if self._unended is None else self._unended.value
        columns = "coalesce(status, :unended) AS status, duration_ms FROM session"
        query = f"SELECT {columns} JOIN session_summary ON session_summary.session = session.id WHERE {where}"
        rows = self._connection.execute(query, values | {"unended": unended}).fetchall()
        durations = [duration_ms for status, duration_ms in rows if status == Status.COMPLETED.value]
        return SessionTotals(Counter(status for status, _ in rows), _median(durations))

    def conditions(self) -> list[str]:
        """Every condition that a stored session had, by name."""
        query = "SELECT DISTINCT condition FROM session_tally WHERE sessions > 0 ORDER BY 1"
        return [condition for (condition,) in self._connection.execute(query)]

    def counts(self, *, kind: SessionKind) -> EnrolmentCounts:
        """How many came, by condition and by what became of them: people, rehearsals or trials."""
        # The conditions of lists come with all that a condition does.
        from kiosk.store.participants import count_enrolment  # noqa: PLC0415

        return count_enrolment(self._connection, kind=kind, in_use=self._unended is None)

    def has_list(self, *, kind: SessionKind) -> bool:
        """Whether an allocation list says how many are to come: people, rehearsals or trials."""
        query = "SELECT EXISTS (SELECT 1 FROM allocation_list WHERE kind = ?)"
        return bool(self._connection.execute(query, (int(kind),)).fetchone()[0])

    def listed(self, number: int) -> StoredSession:
        """Return a session of which it is known that it is there."""
        (row,) = self._rows(f"{_SESSIONS} WHERE session.id = :number", {"number": number})
        return self._session(row)

    def _rows(self, query: str, values: dict[str, str | int]) -> Iterator[dict[str, Any]]:
        """Yield each row by the names of its columns."""
        cursor = self._connection.execute(query, values)
        names = [column[0] for column in cursor.description]
        for row in cursor:
            yield dict(zip(names, row, strict=True))

    def _where(self, which: SessionFilter) -> tuple[str, dict[str, str | int]]:
        return which.where(in_use=self._unended is None)

    def _session(self, row: dict[str, Any]) -> StoredSession:
        try:
            return self._read_session(row)
        except (ValueError, TypeError, sqlite3.OperationalError) as error:
            raise UserInputError(
                f"session {row['id']} cannot be read: {error}; 'recollect verify' says what is wrong"
            ) from error

    def _read_session(self, row: dict[str, Any]) -> StoredSession:
        status = Status(row["status"]) if row["status"] else self._unended
        if row["status"] is None:
            row = row | numbers_so_far(self._connection, row["id"])
        return StoredSession(
            id=row["id"],
            started_at=row["started_at"],
            condition=row["condition"],
            embodiment=row["embodiment"],
            status=status,
            kind=SessionKind(row["kind"]),
            flips=row["flips"],
            pairs=row["pairs"],
            hints=row["hints"],
            duration_ms=row["duration_ms"] or 0,
            participant=None if row["number"] is None else participant_name(row["site"], row["number"]),
            stage=Stage(row["stage"]) if row["stage"] else None,
            allocation_source=AllocationSource(row["allocation_source"]) if row["allocation_source"] else None,
            visit=row["visit"] or 1,
            record_sha256=row["record_sha256"].lower() or None,
        )


_SESSIONS = """
    SELECT session.id, session.site, started_at, condition, embodiment, session.kind, allocation_source,
        participant.number, participant.visit, status, stage, flips, pairs, hints, duration_ms,
        hex(head.hash) AS record_sha256
    FROM session JOIN session_summary ON session_summary.session = session.id
    LEFT JOIN head ON head.session = session.id
    LEFT JOIN participant ON participant.session = session.id
"""


Opened = TypeVar("Opened", bound=SessionList)


@contextmanager
def opened(folder: Path, kind: type[Opened]) -> Iterator[Opened]:
    """Open a data folder to read it so.

    Raises UserInputError if there is nothing that can be read completely.
    """
    with closing(open_checked(folder)) as connection:
        try:
            yield kind(connection, in_use=in_use(folder))
        except sqlite3.DatabaseError as error:
            raise unreadable(error, folder) from error
