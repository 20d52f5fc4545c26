"""The sessions that are exported, one after another, each with all that can still be read of it.

What an older program wrote and this one cannot read is left out piece by piece: a plan, an event. The rest is exported.
"""

from __future__ import annotations

import hashlib
import hmac
import json
import secrets
import sqlite3
from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from datetime import datetime
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

from kiosk import UserInputError
from kiosk.experiment.event_records import from_fields
from kiosk.experiment.events import Event, SessionEnded, StageEntered
from kiosk.experiment.experimenter import DEVIATIONS, AuditEvent
from kiosk.experiment.information import PUBLISHING
from kiosk.experiment.outcomes import EmbodimentName, SessionKind, Stage, Status
from kiosk.experiment.session_config import SessionConfig
from kiosk.experiment.session_state import SessionState
from kiosk.files import read_bytes, replace_file
from kiosk.store.chain import LinkedEvent, is_unbroken
from kiosk.store.database import in_use, unreadable
from kiosk.store.queries import BrokenEvent, SessionRepository, decoded
from kiosk.store.schema import open_checked

PADDED = 4
"""Digits of a participant's number, so that names sort as they should."""

_VISIT = "v"

_LETTERS = {SessionKind.STUDY: "P", SessionKind.SIMULATED: "r", SessionKind.TRIAL: "t"}


class EventRecord(NamedTuple):
    """One event as it was written, its stage, and how this program reads it, if it can.

    ``payload`` is the JSON of its ``fields``.
    """

    seq: int
    at_ms: int
    origin: str
    type: str
    payload: str
    fields: Mapping[str, Any]
    stage: Stage
    event: Event | None


class StoredRecord(NamedTuple):
    """A session as it is stored, before its events and its plan are read.

    ``last_seq`` is its last event, 0 if there is none. Where it is read later, events that came meanwhile are left out.
    """

    row: Mapping[str, Any]
    last_seq: int
    deviations: tuple[Deviation, ...]


@dataclass(frozen=True)
class Deviation:
    """Something out of the ordinary that was done or happened at the booth, and the session that it concerns.

    ``at_ms`` is when, from the session's first event; None if it was before the session and after the last one.
    """

    kind: AuditEvent
    payload: Mapping[str, Any]
    at_ms: int | None


@dataclass(frozen=True)
class SessionRecord:
    """One stored session; ``status`` is None while it is under way, ``plan`` if it cannot be read any more."""

    row: Mapping[str, Any]
    status: Status | None
    plan: SessionConfig | None
    records: tuple[EventRecord, ...]
    secret: bytes | None = None
    """What participants' names are shuffled with; None if they count in the order in which people came."""
    deviations: tuple[Deviation, ...] = ()
    unbroken: bool = False
    """Whether every event was found to match its hash."""

    @property
    def id(self) -> int:
        """Its number in the database."""
        return int(self.row["id"])

    @property
    def kind(self) -> SessionKind:
        """Who sat there."""
        return SessionKind(self.row["kind"])

    @cached_property
    def name(self) -> str:
        """What the person is called: site and number, with a letter that keeps it from being read as a number.

        P stands for participants, r for rehearsals and t for trials; as small letters are in no site, no two are alike.
        From the second visit on, v and the visit follow.
        """
        return _name(self.row, self.secret)

    @property
    def visit(self) -> int:
        """Which visit of the participant it was, from 1."""
        return int(self.row["visit"] or 1)

    @property
    def days_since_first_visit(self) -> int | None:
        """Days in UTC from that of the first visit; None if that was deleted."""
        first = self.row["first_began"] if self.row["number"] is not None else self.row["started_at"]
        if first is None:
            return None
        days = [datetime.fromisoformat(began).date() for began in (first, self.row["started_at"])]
        return (days[1] - days[0]).days

    @property
    def participant(self) -> str:
        """What the person is called at every visit: the name of the first one."""
        return self.name if self.visit == 1 else self.name.removesuffix(f"{_VISIT}{self.visit}")

    @cached_property
    def events(self) -> tuple[Event, ...]:
        """Every event that this program knows."""
        return tuple(record.event for record in self.records if record.event is not None)

    @cached_property
    def state(self) -> SessionState:
        """What the session came to."""
        return SessionState.from_events(self.events, self.embodiment)

    @cached_property
    def embodiment(self) -> EmbodimentName:
        """What helped at its beginning; raises UserInputError for a record that was changed."""
        text = self.row["embodiment"]
        try:
            return EmbodimentName.from_text(text)
        except ValueError:
            raise UserInputError(
                f"session {self.id} names the embodiment {text!r}, but there is none of that name: "
                "'recollect verify' says what else is wrong with the database"
            ) from None

    @property
    def publishable(self) -> bool:
        """Whether publishing was not refused: it was agreed to, or not asked, or the session is simulated."""
        consent = self.state.consent
        if self.kind is SessionKind.SIMULATED or consent is None or PUBLISHING in consent.purposes:
            return True
        # Where the sheet cannot be read, it is unknown what was offered.
        offered = self.plan.information.consent.purposes if self.plan else None
        return offered is not None and PUBLISHING not in {purpose.id for purpose in offered}


def _concerned(spans: Sequence[tuple[int, int, int]], wall_ms: int) -> tuple[int | None, int | None]:
    """Return the session that was under way at a moment, and how long; else the next one, and None."""
    during = next((span for span in reversed(spans) if span[1] <= wall_ms <= span[2]), None)
    if during is not None:
        return during[0], wall_ms - during[1]
    return next((session for session, began, _ in spans if began > wall_ms), None), None


def _name(row: Mapping[str, Any], secret: bytes | None) -> str:
    if row["number"] is None and secret is None:
        return f"session-{row['id']:0{PADDED}}"
    kind = SessionKind(row["kind"])
    if secret is None:
        number = f"{row['number']:0{PADDED}}"
    else:
        told = f"{row['site']}/{int(kind)}/{row['number']}/{'' if row['number'] is not None else row['id']}"
        number = hmac.new(secret, told.encode(), hashlib.sha256).hexdigest()[:_SHUFFLED].upper()
    name = f"{row['site']}-{_LETTERS[kind]}{number}" if row["site"] else f"{_LETTERS[kind]}{number}"
    return name if (row["visit"] or 1) == 1 else f"{name}{_VISIT}{row['visit']}"


SHUFFLING_FILE = "shuffled-ids.secret"
_SECRET_BYTES = 32
_SHUFFLED = 12
"""Hexadecimal digits of a shuffled name: 48 bits, so that two alike are not to be expected."""


def shuffling_secret(folder: Path) -> bytes:
    """Return the secret of a data folder that participants' names are shuffled with; make it if there is none.

    It stays in the folder, readable by its owner, so that every export has the same names, which cannot be
    traced back without it. Raises UserInputError if it cannot be read or written.
    """
    file = folder / SHUFFLING_FILE
    try:
        if not file.exists():
            replace_file(file, secrets.token_hex(_SECRET_BYTES), 0o600)
        secret = bytes.fromhex(read_bytes(file).decode("ascii"))
    except OSError as error:
        raise UserInputError(f"{file}, which shuffles the names of participants, cannot be used: {error}") from error
    except ValueError as error:
        raise UserInputError(f"{file} is not the secret that this program wrote") from error
    if len(secret) != _SECRET_BYTES:
        raise UserInputError(f"{file} is not the secret that this program wrote")
    return secret


@dataclass
class RecordSource:
    """The database at one moment; a kiosk may go on writing meanwhile. Only these kinds are read.

    With a ``secret``, people's names and their order say nothing of the order in which they came.
    """

    connection: sqlite3.Connection
    archive: SessionRepository
    kinds: frozenset[SessionKind]
    _unended: Status | None
    secret: bytes | None = None
    _plans: dict[tuple[object, ...], SessionConfig | None] = field(default_factory=dict)
    _lists: dict[int | None, str | None] = field(default_factory=dict)
    _unbroken: set[int] = field(default_factory=set)
    """The sessions of which every event is known to match its hash."""

    def __len__(self) -> int:
        """How many sessions there are to be read."""
        number: int = self.connection.execute(
            f"SELECT count(*) FROM session WHERE {self._wanted}"  # noqa: S608 - numbers
        ).fetchone()[0]
        return number

    def left_out(self, kind: SessionKind) -> int:
        """How many sessions of a kind there are that is not read."""
        number: int = self.connection.execute("SELECT count(*) FROM session WHERE kind = ?", (int(kind),)).fetchone()[0]
        return 0 if kind in self.kinds else number

    def __iter__(self) -> Iterator[SessionRecord]:
        """Every session in the order in which they began, or of shuffled names; one in memory at a time."""
        yield from map(self._record, self._in_order())

    def broken_events(self) -> Iterator[BrokenEvent]:
        """Yield every event of these sessions that is not what was recorded."""
        for number in self._in_order():
            if number not in self._unbroken:
                yield from self.archive.changed_events(number)

    def found_unbroken(self, number: int) -> None:
        """Note that every event of a session matches its hash, so that it is not read again for that."""
        self._unbroken.add(number)

    def cautions(self) -> Iterator[str]:
        """Yield in words what of these sessions cannot be read, or is not what was recorded."""
        for number in reversed(self.plan_numbers()):
            if not self.plans_of((number,)):
                yield f"what session {number} followed cannot be read, so all that depends on it is left out"
        yield from map(str, self.broken_events())

    def begun_between(self, since: datetime, until: datetime) -> Iterator[SessionRecord]:
        """Every session that began at or after one moment and before the other, in the order in which they began."""
        rows = self.connection.execute(f"SELECT id, started_at FROM session WHERE {self._wanted} ORDER BY id")  # noqa: S608 - numbers
        found = [number for number, began in rows if since <= datetime.fromisoformat(began) < until]
        yield from map(self._record, found)

    def stored(self) -> Iterator[StoredRecord]:
        """Every session in the same order, for ``read``; one in memory at a time."""
        yield from map(self._stored, self._in_order())

    def read(self, stored: StoredRecord) -> SessionRecord:
        """Return a stored session with its events and its plan."""
        events = self._events(stored.row["id"], stored.last_seq)
        if stored.last_seq and not events:
            raise UserInputError(f"session {stored.row['id']} was deleted while it was read: give the command again")
        records = tuple(_told(events))
        plan, unbroken = self._plan(stored.row), is_unbroken(stored.row, events)
        if unbroken:
            self.found_unbroken(stored.row["id"])
        row = {**stored.row, "slots": self._slots(stored.row["allocation_list"])}
        return SessionRecord(row, self._status(records), plan, records, self.secret, stored.deviations, unbroken)

    def _record(self, number: int) -> SessionRecord:
        return self.read(self._stored(number))

    def _stored(self, number: int) -> StoredRecord:
        (row,) = self._rows(f"AND session.id = {number}")
        (last_seq,) = self.connection.execute("SELECT max(seq) FROM event WHERE session = ?", (number,)).fetchone()
        return StoredRecord(row, last_seq or 0, self._deviations.get(number, ()))

    def _events(self, number: int, last_seq: int) -> list[LinkedEvent]:
        query = "SELECT seq, at_ms, origin, type, wall_ms, payload, hash FROM event"
        try:
            return self.connection.execute(
                f"{query} WHERE session = ? AND seq <= ? ORDER BY seq", (number, last_seq)
            ).fetchall()
        except sqlite3.OperationalError:
            # Where damaged bytes are no text, the archive reads what it can; no hash matches that.
            return [
                (seq, at_ms, origin, kind, None, payload, b"")
                for seq, at_ms, kind, origin, payload in self.archive.stored_events(number)
                if seq <= last_seq
            ]

    @cached_property
    def _deviations(self) -> dict[int, tuple[Deviation, ...]]:
        """What happened at the booth, by the session that it concerns.

        The wall's clock tells which that is. Where the data of several sites were merged it does not, so there is
        nothing then.
        """
        kinds = {each.value: each for each in DEVIATIONS}
        found = self.connection.execute(
            f"SELECT wall_ms, type, payload FROM audit_event WHERE type IN ({', '.join('?' * len(kinds))}) ORDER BY id",  # noqa: S608 - marks
            tuple(kinds),
        ).fetchall()
        (sites,) = self.connection.execute("SELECT count(DISTINCT site) FROM session").fetchone()
        if not found or sites > 1:
            return {}
        spans = self._spans()
        by_session: dict[int, list[Deviation]] = {}
        for wall_ms, kind, payload in found:
            session, at_ms = _concerned(spans, wall_ms)
            if session is not None:
                by_session.setdefault(session, []).append(Deviation(kinds[kind], json.loads(payload), at_ms))
        return {session: tuple(them) for session, them in by_session.items()}

    def _spans(self) -> list[tuple[int, int, int]]:
        """Return every session with when it began and ended, by the wall's clock.

        What came before the visitor agreed is written when they did, so the beginning is worked out from there.
        """
        rows = self.connection.execute(
            "SELECT session, min(wall_ms - at_ms), max(wall_ms) FROM event WHERE wall_ms IS NOT NULL"
            " AND origin <> 'recovery' GROUP BY session ORDER BY session"
        )
        return [(session, began, ended) for session, began, ended in rows]

    def _in_order(self) -> list[int]:
        cursor = self.connection.execute(
            "SELECT session.id, session.site, session.kind, participant.number, visit FROM session"  # noqa: S608 - numbers
            f" LEFT JOIN participant ON participant.session = session.id WHERE {self._wanted} ORDER BY session.id"
        )
        rows = [dict(zip(("id", "site", "kind", "number", "visit"), row, strict=True)) for row in cursor]
        if self.secret is not None:
            rows.sort(key=lambda row: _name(row, self.secret))
        return [row["id"] for row in rows]

    def plans(self) -> tuple[SessionConfig, ...]:
        """Return the plans that the sessions followed, the newest first, as far as they can be read."""
        return self.plans_of(self.plan_numbers())

    def plans_of(self, numbers: Sequence[int]) -> tuple[SessionConfig, ...]:
        """Return the plans that these sessions followed, as far as they can be read."""
        plans = [self._plan(row) for number in numbers for row in self._rows(f"AND session.id = {number}")]
        return tuple(plan for plan in plans if plan is not None)

    def plan_numbers(self) -> tuple[int, ...]:
        """Return a session for each plan that was followed, the newest first."""
        newest = f"GROUP BY {', '.join(_FOLLOWED)} ORDER BY max(session.id) DESC"
        return tuple(row["id"] for row in self._rows(newest))

    def _rows(self, which: str) -> Iterator[Mapping[str, Any]]:
        cursor = self.connection.execute(
            f"SELECT session.*, participant.number, participant.visit, ({_FIRST_BEGAN}) AS first_began,"  # noqa: S608 - the names are ours
            " list.block_size, hex(head.hash) AS record_sha256"
            " FROM session LEFT JOIN participant ON participant.session = session.id"
            " LEFT JOIN head ON head.session = session.id"
            " LEFT JOIN allocation_list AS list ON list.id = session.allocation_list"
            f" WHERE {self._wanted} {which}"
        )
        names = [column[0] for column in cursor.description]
        for row in cursor:
            yield dict(zip(names, row, strict=True))

    def _slots(self, allocation_list: int | None) -> str | None:
        """Return the slots of an allocation list as they are stored.

        All sessions that followed the list share one text, which can be very long.
        """
        if allocation_list not in self._lists:
            query = "SELECT slots FROM allocation_list WHERE id = ?"
            row = self.connection.execute(query, (allocation_list,)).fetchone()
            self._lists[allocation_list] = None if row is None else str(row[0])
        return self._lists[allocation_list]

    @property
    def _wanted(self) -> str:
        return f"session.kind IN ({', '.join(str(int(kind)) for kind in sorted(self.kinds))})"

    def _plan(self, row: Mapping[str, Any]) -> SessionConfig | None:
        """Return what a session followed; sessions that followed the same share it."""
        key = tuple(row[column] for column in (*_FOLLOWED, "visit"))
        if key not in self._plans:
            try:
                self._plans[key] = self.archive.plan(row["id"])
            except UserInputError:
                self._plans[key] = None
        return self._plans[key]

    def _status(self, records: tuple[EventRecord, ...]) -> Status | None:
        """How a session ended, which only its very last event says."""
        ended = records[-1].event if records else None
        return ended.status if isinstance(ended, SessionEnded) else self._unended


_FIRST_BEGAN = """
    SELECT first.started_at FROM participant AS visited JOIN session AS first ON first.id = visited.session
    WHERE visited.site = participant.site AND visited.kind = participant.kind
    AND visited.number = participant.number AND visited.visit = 1
"""
"""When the first visit of the participant began; null if it was withdrawn."""

_FOLLOWED = (
    "condition",
    "language",
    "deck",
    "practice_deck",
    "settings_sha256",
    "policy_source",
    "questionnaire_source",
    "sentences_source",
    "information_source",
    "about_you_source",
    "translations",
)
"""The columns that tell what a session followed."""


@contextmanager
def open_records(folder: Path, kinds: frozenset[SessionKind]) -> Iterator[RecordSource]:
    """Provide what is stored in a data folder now; raises UserInputError if there is nothing that can be read."""
    with closing(open_checked(folder)) as connection:
        writing = in_use(folder)
        connection.execute("BEGIN")
        archive = SessionRepository(connection, in_use=writing)
        try:
            yield RecordSource(connection, archive, kinds, None if writing else Status.INTERRUPTED)
        except sqlite3.DatabaseError as error:
            raise unreadable(error, folder) from error


def _told(rows: Sequence[LinkedEvent]) -> Iterator[EventRecord]:
    """Yield the records with the stage that each fell into."""
    written = decoded([payload for *_, payload, _ in rows])
    # As in with_stages: a call for each of millions of events takes as long as all else that is done here.
    stage = Stage.ATTRACT
    for (seq, at_ms, origin, kind, _, payload, _), fields in zip(rows, written, strict=True):
        if fields is None:
            yield EventRecord(seq, at_ms, origin, kind, "{}", {}, stage, None)
            continue
        try:
            event = from_fields(kind, at_ms, fields)
        except ValueError:
            event = None
        if type(event) is StageEntered:
            stage = event.stage
        yield EventRecord(seq, at_ms, origin, kind, payload, fields, stage, event)
