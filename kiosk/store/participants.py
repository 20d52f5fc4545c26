"""Participants and their numbers, those who come back, and the counts of each cell."""

from __future__ import annotations

import re
import sqlite3
from collections import Counter
from collections.abc import Mapping

from kiosk import UserInputError
from kiosk.experiment.condition import Condition, in_design_order
from kiosk.experiment.information import RETURNING
from kiosk.experiment.labels import read_as
from kiosk.experiment.outcomes import AllocationSource, Disposition, NotRecordedReason, SessionKind
from kiosk.lazy_dataclass import dataclass
from kiosk.store.allocation import quotas_from_json
from kiosk.store.codes import issue_code
from kiosk.store.listing import participant_name

_DIGITS_OF_A_YEAR = 4
_SITE = re.compile(r"[A-Z0-9]{0,8}", re.ASCII)


@dataclass(frozen=True)
class ReturningVisitor:
    """A participant who was here before.

    ``visit`` is the one that begins now, counted from 1, and ``conditions`` are those of the visits before, the first
    one first. The code is the one they gave.
    """

    number: int
    visit: int
    conditions: tuple[Condition, ...]
    code: str


@dataclass(frozen=True)
class Participant:
    """The person of one session; ``number`` counts from 1 within a site, for people and for rehearsals apart."""

    session: int
    site: str
    number: int
    code: str
    """What they can withdraw with. It is not stored, so it is known only while their session is under way."""
    visit: int = 1
    """Which of their visits it is."""

    @property
    def name(self) -> str:
        """The number with its site, as it stands in lists."""
        return participant_name(self.site, self.number)


def checked_site(site: str) -> str:
    """Return the name of a site as it may stand in numbers, codes and tables; raises UserInputError for any other."""
    if not _SITE.fullmatch(site):
        raise UserInputError(f"a site is named by up to 8 capital letters and digits, not {site!r}")
    for label in (site, *([participant_name(site, 1)] if site and not _is_long_number(site) else [])):
        misread = read_as(label)
        if misread:
            raise UserInputError(
                f"{label!r} is taken for {misread} by programs that read tables, so {site!r} cannot name a site; "
                "choose another name, such as ROME"
            )
    return site


def _is_long_number(site: str) -> bool:
    """Whether a site is a number that with another one behind it is neither a date nor anything else."""
    return site.isdigit() and len(site) > _DIGITS_OF_A_YEAR


def enrol(connection: sqlite3.Connection, session: int, returning: ReturningVisitor | None = None) -> Participant:
    """Give a session's person the next number of the site, and a code, within the transaction that is open.

    Someone who comes back keeps number and code. Their session gets a code of its own all the same, which is not
    shown: by its hash an older copy is found that still holds the session after they withdrew.
    """
    site, kind = connection.execute("SELECT site, kind FROM session WHERE id = ?", (session,)).fetchone()
    number = _next_number(connection, site, kind) if returning is None else returning.number
    visit = 1 if returning is None else returning.visit
    connection.execute(
        "INSERT INTO participant (session, site, kind, number, visit) VALUES (?, ?, ?, ?, ?)",
        (session, site, kind, number, visit),
    )
    own = issue_code(connection, session, site)
    return Participant(session, site, number, own if returning is None else returning.code, visit)


def returning_visitor(
    connection: sqlite3.Connection, session: int, code: str, *, site: str, kind: SessionKind
) -> ReturningVisitor | None:
    """Return the person of a session who comes back to this site.

    None if they did not agree that their visits are linked, or if they belong to another site or kind.
    """
    row = connection.execute(
        "SELECT number FROM participant WHERE session = ? AND site = ? AND kind = ?", (session, site, int(kind))
    ).fetchone()
    if row is None:
        return None
    (number,) = row
    visits = connection.execute(_VISITS, {"site": site, "kind": int(kind), "number": number}).fetchall()
    agreed = connection.execute(_AGREED, {"site": site, "kind": int(kind), "number": number, "purpose": RETURNING})
    if not agreed.fetchone()[0]:
        return None
    conditions = tuple(Condition(condition) for _, condition in visits)
    return ReturningVisitor(number, 1 + max(visit for visit, _ in visits), conditions, code)


_VISITS = """
    SELECT visit, condition FROM participant JOIN session ON session.id = participant.session
    WHERE participant.site = :site AND participant.kind = :kind AND number = :number
    UNION ALL
    SELECT visit, condition FROM tombstone WHERE site = :site AND kind = :kind AND number = :number
    ORDER BY visit
"""
"""A visit that the person deleted is counted as well."""

_AGREED = """
    SELECT EXISTS (
        SELECT 1 FROM participant JOIN event ON event.session = participant.session
        WHERE participant.site = :site AND participant.kind = :kind AND number = :number AND type = 'ConsentGiven'
        AND EXISTS (SELECT 1 FROM json_each(payload, '$.purposes') WHERE value = :purpose)
    )
"""


def visits_of(connection: sqlite3.Connection, session: int) -> tuple[int, ...]:
    """Return the stored sessions of the person of a session, stored or withdrawn, the first visit first."""
    rows = connection.execute(
        """
        SELECT other.session FROM participant AS other JOIN (
            SELECT site, kind, number FROM participant WHERE session = :session
            UNION SELECT site, kind, number FROM tombstone WHERE session = :session
        ) AS person ON other.site = person.site AND other.kind = person.kind AND other.number = person.number
        ORDER BY other.visit
        """,
        {"session": session},
    )
    return tuple(number for (number,) in rows)


def enrol_again(connection: sqlite3.Connection, session: int) -> Participant | None:
    """Return the person of a session with a new code.

    The earlier one was only on their screen and paper; both stay valid. Returns None if the session was recorded before
    people were numbered, or is not there.
    """
    row = connection.execute("SELECT site, number, visit FROM participant WHERE session = ?", (session,)).fetchone()
    if row is None:
        return None
    site, number, visit = row
    return Participant(session, site, number, issue_code(connection, session, site), visit)


def _next_number(connection: sqlite3.Connection, site: str, kind: int) -> int:
    """One more than the highest ever given, whether or not its session was withdrawn."""
    number: int = connection.execute(
        """
        SELECT 1 + coalesce(max(number), 0) FROM (
            SELECT site, kind, number FROM participant UNION ALL SELECT site, kind, number FROM tombstone
        ) WHERE site = ? AND kind = ?
        """,
        (site, kind),
    ).fetchone()[0]
    return number


@dataclass(frozen=True)
class CountCell:
    """One condition in numbers; of all its sessions, whatever became of them, ``withdrawn`` were withdrawn."""

    quota: int
    fates: Mapping[Disposition, int]
    withdrawn: int

    @property
    def begun(self) -> int:
        """How many sessions were begun in this condition."""
        return sum(self.fates.values())

    def to_json(self) -> dict[str, int]:
        """Return the cell as the command line prints it."""
        fates = {fate.value: self.fates[fate] for fate in Disposition}
        return {"quota": self.quota, "begun": self.begun} | fates | {"withdrawn": self.withdrawn}


@dataclass(frozen=True)
class EnrolmentCounts:
    """Every condition that has a quota or a session, and the people who played without being stored."""

    cells: Mapping[Condition, CountCell]
    visits: Mapping[NotRecordedReason, int]


def count_enrolment(connection: sqlite3.Connection, *, kind: SessionKind, in_use: bool) -> EnrolmentCounts:
    """Count people, rehearsals or trials.

    With ``in_use`` the folder is being written, so that a session without an end is under way.
    """
    fates: Counter[tuple[Condition, Disposition]] = Counter()
    withdrawn: Counter[Condition] = Counter()
    for name, source, finished, ended, gone, sessions in connection.execute(_SESSIONS, {"kind": int(kind)}):
        condition = Condition(name)
        fates[condition, _fate(source, finished=bool(finished), ended=bool(ended) or not in_use)] += sessions
        withdrawn[condition] += gone
    quotas = _quotas(connection, kind=kind)
    there = {condition for condition, _ in fates} | set(quotas)
    return EnrolmentCounts(
        {
            condition: CountCell(
                quotas[condition], {fate: fates[condition, fate] for fate in Disposition}, withdrawn[condition]
            )
            for condition in in_design_order(there)
        },
        _visits(connection, kind=kind),
    )


_SESSIONS = """
    SELECT condition, nullif(allocation_source, ''), game_completed, ended, 0, sessions
    FROM session_tally WHERE kind = :kind AND sessions > 0
    UNION ALL
    SELECT condition, allocation_source, game_completed, 1, count(*), count(*) FROM tombstone WHERE kind = :kind
    GROUP BY condition, allocation_source, game_completed
"""


def _fate(source: str | None, *, finished: bool, ended: bool) -> Disposition:
    match source and AllocationSource(source):
        case AllocationSource.LIST if finished:
            return Disposition.CONSUMED
        case AllocationSource.LIST:
            return Disposition.DROPPED_OUT if ended else Disposition.UNDER_WAY
        case AllocationSource.OVERRIDE:
            return Disposition.OVERRIDDEN
        case AllocationSource.BEYOND:
            return Disposition.BEYOND
        case AllocationSource.RETURNING:
            return Disposition.RETURNING
        case _:
            return Disposition.UNLISTED


def _quotas(connection: sqlite3.Connection, *, kind: SessionKind) -> Counter[Condition]:
    """Return what the lists that are followed ask for, of all sites together."""
    asked: Counter[Condition] = Counter()
    latest = "SELECT max(id) FROM allocation_list GROUP BY site, kind"
    for (quotas,) in connection.execute(
        f"SELECT quotas FROM allocation_list WHERE kind = ? AND id IN ({latest})",  # noqa: S608 - it stands here
        (int(kind),),
    ):
        asked.update(quotas_from_json(quotas))
    return asked


def _visits(connection: sqlite3.Connection, *, kind: SessionKind) -> dict[NotRecordedReason, int]:
    rows = connection.execute("SELECT why, count(*) FROM visit WHERE kind = ? GROUP BY why", (int(kind),))
    counted = dict(rows.fetchall())
    return {why: counted.get(why.value, 0) for why in NotRecordedReason}
