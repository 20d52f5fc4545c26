"""Whether a database is what this program wrote, row by row; it is looked at and never changed."""

from __future__ import annotations

import hashlib
import json
import sqlite3
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import closing
from dataclasses import dataclass
from enum import Enum
from functools import cache, partial
from pathlib import Path
from typing import NamedTuple

from kiosk import UserInputError
from kiosk.experiment.event_records import from_fields
from kiosk.garbage import rare_collections
from kiosk.store.allocation import quotas_from_json, slots_from_json
from kiosk.store.chain import FILE as HEADS_FILE
from kiosk.store.chain import chained_events, lost_ends, missing_since_written, unreadable_lines
from kiosk.store.connecting import reason
from kiosk.store.copies import Elsewhere, KnownCopy, look_elsewhere
from kiosk.store.database import open_as_it_is
from kiosk.store.maintenance import Progress
from kiosk.store.migrations import MIGRATIONS
from kiosk.store.schema import NONE_OF_OURS, refuse_other_schema, schema_flaws
from kiosk.store.summaries import wrong_summaries, wrong_tally
from kiosk.store.tombstones import FILE as LIST
from kiosk.store.tombstones import copies_with, list_flaws, sessions_of, withdrawn_hashes


class Verification(Enum):
    """What is checked, as a sentence that is true if nothing is wrong."""

    FILE = "the file is whole"
    REFERENCES = "every reference leads to a row"
    SCHEMA = "tables and triggers are unchanged"
    RECEIPTS = "every step of the schema is noted"
    SOURCES = "settings, policies and texts of the sessions are unchanged"
    CHAIN = "every event is unchanged"
    HEADS = "no session, and no end of one, is missing"
    NUMBERING = "events are numbered from 1 without a gap"
    TIME = "time never runs backwards within a session"
    READABLE = "every event can be read"
    PARTICIPANTS = "every participant has a number and a code, and no two have the same"
    ALLOCATION = "allocation lists match the quotas, and sessions the lists"
    WITHDRAWN = "nothing is left of withdrawn sessions"
    FINISHED = "every withdrawal is finished"
    LIST = "the list of people who withdrew is there and complete"
    COPIES = "no copy in the folder holds people who withdrew"
    ELSEWHERE = "no copy within reach elsewhere holds people who withdrew"
    SUMMARIES = "summaries and counts match the events"
    VOICE = "each language of a study has one voice"


@dataclass(frozen=True)
class Flaw:
    """Something that is wrong, and where."""

    check: Verification
    where: str
    what: str


def verify(folder: Path, tell: Progress = lambda _done, _of: None) -> list[Flaw]:
    """Everything that is wrong with the database of a data folder; raises UserInputError if it cannot be opened at all.

    A kiosk may be writing meanwhile: all is seen as it stood at one moment.
    """
    return look_through(folder, tell).flaws


class Verified(NamedTuple):
    """What is wrong, and the copies elsewhere in which people who withdrew may be, with why that cannot be seen."""

    flaws: list[Flaw]
    copies_not_looked_into: list[tuple[KnownCopy, str]]


def look_through(folder: Path, tell: Progress = lambda _done, _of: None) -> Verified:
    """Do the same as ``verify``, and tell which copies could not be looked into."""
    with closing(open_as_it_is(folder)) as connection:
        return _looked_through(connection, folder, tell)


def _looked_through(connection: sqlite3.Connection, folder: Path, tell: Progress = lambda _done, _of: None) -> Verified:
    flaws: list[Flaw] = []
    unseen: list[tuple[KnownCopy, str]] = []
    of_events = cache(_events)
    looks = _LOOKS | {
        **{check: partial(_found_by, of_events, check) for check in _OF_EVENTS},
        Verification.HEADS: partial(_heads, folder=folder),
        Verification.FINISHED: partial(_finished, folder=folder),
        Verification.LIST: partial(_list, folder=folder),
        Verification.COPIES: partial(_copies, folder=folder),
        Verification.ELSEWHERE: partial(_elsewhere, folder=folder, unseen=unseen),
    }
    connection.execute("BEGIN")
    # A view in the place of a table could be read without end.
    other = _has_other_tables(connection)
    if other:
        # Not where the schema is ours: SQLite before 3.41 takes its own json_valid for unsafe.
        connection.execute("PRAGMA trusted_schema = OFF")
    with rare_collections():
        for done, check in enumerate(Verification):
            tell(done, len(Verification))
            if other and check not in _WHATEVER_THE_SCHEMA:
                flaws.append(Flaw(check, "the database", "was not looked at, as the tables are not as they were made"))
                continue
            try:
                flaws += [Flaw(check, where, what) for where, what in looks[check](connection)]
            except (sqlite3.Error, ValueError) as error:
                words = reason(error, folder) if isinstance(error, sqlite3.Error) else str(error)
                flaws.append(Flaw(check, "the database", f"cannot be looked at: {words}"))
            except (AttributeError, TypeError) as error:
                # A changed file may hold a number, or nothing, where the schema allows texts alone.
                words = f"a value is of another type ({error})"
                flaws.append(Flaw(check, "the database", f"cannot be looked at: {words}"))
    return Verified(flaws, unseen)


def check_foreign(folder: Path) -> None:
    """Refuse a data folder in which anything is wrong, before it is merged; raises UserInputError."""
    with closing(open_as_it_is(folder)) as connection:
        refuse_other_schema(connection, folder)
        flaws = _looked_through(connection, folder).flaws
    found = [(each.where, each.what) for each in flaws if each.check not in _HARMLESS]
    if found:
        where, what = found[0]
        more = f", and {len(found) - 1} more" if len(found) > 1 else ""
        raise UserInputError(f"{folder} is not as it was written: {where}: {what}{more}; see 'recollect verify'")


_Found = Iterator[tuple[str, str]]
"""Where, and what."""


def _file(connection: sqlite3.Connection) -> _Found:
    for (answer,) in connection.execute("PRAGMA integrity_check"):
        if answer != "ok":
            yield "the file", answer


def _references(connection: sqlite3.Connection) -> _Found:
    for table, row, other, _ in connection.execute("PRAGMA foreign_key_check"):
        yield f"{table}, row {row}", f"points at nothing in {other}"


def _schema(connection: sqlite3.Connection) -> _Found:
    for kind, name, what in schema_flaws(connection):
        yield f"{kind} {name}", what


def _has_other_tables(connection: sqlite3.Connection) -> bool:
    try:
        return any(kind == "table" and what != NONE_OF_OURS for kind, _, what in schema_flaws(connection))
    except sqlite3.Error:
        return True


def _receipts(connection: sqlite3.Connection) -> _Found:
    steps = connection.execute("PRAGMA user_version").fetchone()[0]
    there = {number: row for number, *row in connection.execute("SELECT number, name, sha256 FROM migration")}
    for step in (step for step in MIGRATIONS if step.number <= steps):
        if there.pop(step.number, None) != [step.name, step.sha256]:
            yield f"step {step.number}", "has no receipt, or that of another step"
    for number in sorted(there):
        yield f"step {number}", "has a receipt and was never taken"


def _sources(connection: sqlite3.Connection) -> _Found:
    for sha256, content in connection.execute("SELECT sha256, content FROM source"):
        if hashlib.sha256(content.encode()).hexdigest() != sha256:
            yield f"source {sha256[:12]}", "is not what its hash says"


def _heads(connection: sqlite3.Connection, folder: Path | None = None) -> _Found:
    told = dict(missing_since_written(connection, folder)) if folder is not None else {}
    told |= lost_ends(connection)
    unreadable = unreadable_lines(folder) if folder is not None else 0
    if unreadable:
        yield HEADS_FILE, f"has lines that cannot be read: {unreadable}"
    for session, what in sorted(told.items()):
        yield f"session {session}", what


_OF_EVENTS = (Verification.CHAIN, Verification.NUMBERING, Verification.TIME, Verification.READABLE)
"""The checks that look at every event: all of them share one reading, which takes longer than any check."""

_REMEMBERED = 100_000
"""How many different events are remembered as readable; most events of a study say the same as an earlier one."""


def _events(connection: sqlite3.Connection) -> Mapping[Verification, Iterable[tuple[str, str]]]:
    """Read every event once, and return what each of these checks finds."""
    broken: list[tuple[str, str]] = []
    late: list[tuple[str, str]] = []
    unread: list[tuple[str, str]] = []
    gaps: set[int] = set()
    readable: set[tuple[str, str]] = set()
    before, before_seq, before_ms = None, 0, 0
    for session, seq, at_ms, kind, payload, fits in chained_events(connection):
        if session != before:
            before, before_seq, before_ms = session, 0, 0
        before_seq += 1
        if seq != before_seq:
            gaps.add(session)
        if not fits:
            broken.append((f"session {session}, event {seq}", _does_not_fit(seq)))
        if at_ms < before_ms:
            late.append((f"session {session}, event {seq}", f"is at {at_ms} ms, after one at {before_ms} ms"))
        before_ms = at_ms
        if (kind, payload) not in readable:
            why = _why_unreadable(kind, at_ms, payload, readable)
            if why:
                unread.append((f"session {session}, event {seq}", f"{kind} cannot be read: {why}"))
    numbering = list(_numbering(connection, gaps))
    return dict(zip(_OF_EVENTS, (broken, numbering, late, unread), strict=True))


def _does_not_fit(seq: int) -> str:
    first = ", or what the session followed," if seq == 1 else ""
    return f"it{first} is not what was recorded: it does not match its hash"


def _why_unreadable(kind: str, at_ms: int, payload: str, readable: set[tuple[str, str]]) -> str:
    """Say why an event cannot be read; "" if it can, which is then remembered among the readable ones."""
    try:
        from_fields(kind, at_ms, json.loads(payload))
    except (ValueError, TypeError) as error:
        return str(error) or "it is malformed"
    if len(readable) == _REMEMBERED:
        readable.clear()
    # The schema holds the time to a whole number, so it makes no difference.
    readable.add((kind, payload))
    return ""


def _numbering(connection: sqlite3.Connection, gaps: Iterable[int]) -> _Found:
    empty = "SELECT id FROM session WHERE NOT EXISTS (SELECT 1 FROM event WHERE session = id)"
    for session in sorted({*gaps, *(session for (session,) in connection.execute(empty))}):
        events, first, last = connection.execute(
            "SELECT count(*), min(seq), max(seq) FROM event WHERE session = ?", (session,)
        ).fetchone()
        what = f"has {events} events, numbered from {first} to {last}" if events else "has no events"
        yield f"session {session}", what


def _found_by(
    look: Callable[[sqlite3.Connection], Mapping[Verification, Iterable[tuple[str, str]]]],
    check: Verification,
    connection: sqlite3.Connection,
) -> _Found:
    yield from look(connection)[check]


def _participants(connection: sqlite3.Connection) -> _Found:
    rows = connection.execute(
        "SELECT session, participant.site, number, session.site, participant.kind, session.kind,"
        " EXISTS (SELECT 1 FROM withdrawal_code AS code WHERE code.session = participant.session)"
        " FROM participant JOIN session ON session.id = session"
    )
    for session, site, number, site_there, kind, simulated_there, has_code in rows:
        where = f"session {session}"
        if (site, kind) != (site_there, simulated_there):
            yield where, "is of another site, or another kind, than its participant"
        if number < 1:
            yield where, f"its participant has the number {number}"
        if not has_code:
            yield where, "its participant has no code"
    if not connection.execute("SELECT EXISTS (SELECT 1 FROM code_key)").fetchone()[0]:
        yield "the codes", "have no key, so that none of them can be checked"
    yield from _alike(connection)
    yield from _counters(connection)
    yield from _visits(connection)


def _counters(connection: sqlite3.Connection) -> _Found:
    """Find numbers that SQLite would give twice, or would skip, because its own count of them was changed."""
    given = dict(connection.execute("SELECT name, seq FROM sqlite_sequence"))
    for table, numbers in _NUMBERED.items():
        (last,) = connection.execute(f"SELECT max(number) FROM ({numbers})").fetchone()  # noqa: S608 - ours
        count = given.pop(table, None)
        if (count or 0) != (last or 0):
            yield f"the count of {table}", f"is {count}, and the last number is {last}"
    for name in given:
        yield f"the count of {name}", "is none of ours"


_NUMBERED = {
    "session": "SELECT id AS number FROM session UNION ALL SELECT session FROM tombstone",
    **{table: f"SELECT id AS number FROM {table}" for table in ("allocation_list", "visit", "audit_event")},  # noqa: S608
}
"""The tables that SQLite numbers, each with the query of its numbers."""


def _alike(connection: sqlite3.Connection) -> _Found:
    """Numbers that stand more than once, those of people who withdrew among them."""
    for site, number, times in connection.execute(
        """
        SELECT site, number, count(*) FROM (
            SELECT site, kind, number, visit FROM participant
            UNION ALL SELECT site, kind, number, visit FROM tombstone
        ) GROUP BY site, kind, number, visit HAVING count(*) > 1
        """
    ):
        yield f"participant {number} of site {site!r}", f"stands there {times} times"


def _visits(connection: sqlite3.Connection) -> _Found:
    """Find participants whose visits are not numbered from 1 without a gap, those that were withdrawn among them."""
    for site, number, visits, last in connection.execute(
        """
        SELECT site, number, count(*), max(visit) FROM (
            SELECT site, kind, number, visit FROM participant
            UNION ALL SELECT site, kind, number, visit FROM tombstone
        ) GROUP BY site, kind, number HAVING max(visit) <> count(*)
        """
    ):
        yield f"participant {number} of site {site!r}", f"has {visits} visits, and the last one is number {last}"


def _places(connection: sqlite3.Connection) -> _Found:
    listed: dict[tuple[int, int], str] = {}
    for number, quotas, slots in connection.execute("SELECT id, quotas, slots FROM allocation_list"):
        there = slots_from_json(slots)
        listed |= {(number, slot.number): slot.condition.name for slot in there}
        if Counter(slot.condition for slot in there) != quotas_from_json(quotas):
            yield f"list {number}", "does not meet its quotas"
    for session, condition, number, slot in connection.execute(
        "SELECT id, condition, allocation_list, allocation_slot FROM session WHERE allocation_slot IS NOT NULL"
    ):
        if listed.get((number, slot)) != condition:
            yield f"session {session}", f"is {condition}, and slot {slot} of list {number} is not"


_OF_A_SESSION = (
    ("session", "id"),
    *((table, "session") for table in ("participant", "withdrawal_code", "event", "head")),
)


def _withdrawn(connection: sqlite3.Connection) -> _Found:
    for table, key in _OF_A_SESSION:
        for session, rows in connection.execute(
            f"SELECT {key}, count(*) FROM {table} WHERE {key} IN (SELECT session FROM tombstone) GROUP BY {key}"  # noqa: S608
        ):
            yield f"session {session}", f"was withdrawn, and {rows} rows of it are left in {table}"


def _finished(connection: sqlite3.Connection, folder: Path | None = None) -> _Found:
    back = sessions_of(connection, withdrawn_hashes(connection, folder)) if folder is not None else []
    for session in back:
        yield f"session {session}", "was withdrawn, and is still there: the withdrawal was cut off, or a copy put back"
    for (session,) in connection.execute("SELECT session FROM unfinished_withdrawal ORDER BY session"):
        yield (
            f"session {session}",
            "was withdrawn, and bytes of it or copies with it may be left: run 'recollect withdraw' again with the "
            "same code, or open the kiosk",
        )


def _list(connection: sqlite3.Connection, folder: Path | None = None) -> _Found:
    for what in list_flaws(connection, folder) if folder is not None else ():
        yield LIST, what


def _copies(connection: sqlite3.Connection, folder: Path | None = None) -> _Found:
    for copy, sessions in copies_with(folder, withdrawn_hashes(connection, folder)) if folder is not None else ():
        yield copy.name, f"it holds session {', '.join(map(str, sessions))} of people who withdrew"


def _elsewhere(
    connection: sqlite3.Connection, folder: Path | None = None, unseen: list[tuple[KnownCopy, str]] | None = None
) -> _Found:
    found = Elsewhere() if folder is None else _looked_elsewhere(connection, folder)
    if unseen is not None:
        unseen += found.unseen
    for copy, sessions in found.holding:
        yield (
            f"the {copy.kind.value} {copy.place}",
            f"it holds session {', '.join(map(str, sessions))} of people who withdrew: delete them there, or the copy",
        )


def _looked_elsewhere(connection: sqlite3.Connection, folder: Path) -> Elsewhere:
    (last_day,) = connection.execute("SELECT coalesce(max(withdrawn_at), '') FROM tombstone").fetchone()
    return look_elsewhere(folder, withdrawn_hashes(connection, folder), str(last_day))


def _summaries(connection: sqlite3.Connection) -> _Found:
    for session, what in wrong_summaries(connection):
        yield f"the summary of session {session}", what
    if wrong_tally(connection):
        yield "the counts of sessions", "are not what the summaries say"


def _voice(connection: sqlite3.Connection) -> _Found:
    """Find sessions of participants in which the pack of clips, or what renders sentences, is not the one before.

    A site's sessions of one language are compared; rehearsals and trials are left out.
    """
    rows = connection.execute(
        """
        SELECT site, language, session.id, json_extract(event.payload, '$.engine'),
            json_extract(event.payload, '$.engine_version'), json_extract(event.payload, '$.voice'),
            coalesce(json_extract(event.payload, '$.pack'), '')
        FROM event JOIN session ON session.id = session
        WHERE type = 'SpeechStarted' AND kind = 0 ORDER BY session.id, seq
        """
    )
    last: dict[tuple[str, str, bool], tuple[str, int]] = {}
    for site, language, session, engine, version, voice, pack in rows:
        if not engine:
            continue
        speaker = " ".join(part for part in (voice, "of", engine, version) if part)
        speaker = f"the pack {pack[:_SHORT]} ({speaker})" if pack else speaker
        place = (site, language, bool(pack))
        before, where = last.get(place, (speaker, session))
        if before != speaker:
            yield f"session {session}", f"{language!r} is spoken by {speaker}; in session {where} it was {before}"
        last[place] = (speaker, session)


_SHORT = 12
"""How many digits of a hash are shown to tell two packs apart."""

_WHATEVER_THE_SCHEMA = {Verification.FILE, Verification.SCHEMA}

_HARMLESS = {Verification.VOICE, Verification.FINISHED, Verification.COPIES, Verification.ELSEWHERE}
"""What is no sign that anything was changed; a merge refuses people who withdrew by itself, and names them."""

_LOOKS: dict[Verification, Callable[[sqlite3.Connection], _Found]] = {
    Verification.FILE: _file,
    Verification.REFERENCES: _references,
    Verification.SCHEMA: _schema,
    Verification.RECEIPTS: _receipts,
    Verification.SOURCES: _sources,
    Verification.HEADS: _heads,
    Verification.PARTICIPANTS: _participants,
    Verification.ALLOCATION: _places,
    Verification.WITHDRAWN: _withdrawn,
    Verification.FINISHED: _finished,
    Verification.LIST: _list,
    Verification.COPIES: _copies,
    Verification.ELSEWHERE: _elsewhere,
    Verification.SUMMARIES: _summaries,
    Verification.VOICE: _voice,
}
"""What looks for the flaws of each check."""
