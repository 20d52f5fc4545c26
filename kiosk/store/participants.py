"""Participants and their numbers, allocation lists, and the counts of each cell."""

from __future__ import annotations

import json
import re
import sqlite3
from bisect import bisect_left
from collections import Counter
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from functools import lru_cache
from itertools import accumulate, groupby
from random import SystemRandom

from kiosk import UserInputError
from kiosk.experiment.condition import (
    AllocationSlot,
    Condition,
    allocation_slots,
    in_design_order,
    next_slot,
    ratio_in_words,
)
from kiosk.experiment.information import RETURNING
from kiosk.experiment.labels import read_as
from kiosk.experiment.outcomes import AllocationSource, Disposition, NotRecordedReason, SessionKind
from kiosk.lazy_dataclass import dataclass
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


SEED_BITS = 63
"""So many that a person who has seen many slots of a list cannot find the rest by trying seeds."""


@dataclass(frozen=True)
class AllocationList:
    """A stored list; ``id`` is its row."""

    id: int
    seed: int
    block: int
    quotas: Mapping[Condition, int]
    slots: tuple[AllocationSlot, ...]


class _Listed:
    """The slots of a stored list, found by their numbers."""

    def __init__(self, row: int, blocks: Sequence[Sequence[str]]) -> None:
        self.row = row
        self.blocks = blocks
        self._before = tuple(accumulate(map(len, blocks), initial=0))
        """How many slots there are before each block, and in all."""

    def slot(self, number: int) -> AllocationSlot | None:
        """Return the slot of this number, from 1; None if the list is shorter."""
        if number > self._before[-1]:
            return None
        block = bisect_left(self._before, number)
        return AllocationSlot(number, block, Condition(self.blocks[block - 1][number - 1 - self._before[block - 1]]))


class AllocationLists:
    """The lists of one site, of one kind of sessions.

    The last one goes on from those before and is followed.
    """

    def __init__(self, connection: sqlite3.Connection, site: str, *, kind: SessionKind) -> None:
        """Open the lists; callers of ``create`` have a transaction open."""
        self._connection = connection
        self._whose = {"site": site, "kind": int(kind)}
        self._listed: _Listed | None = None

    def latest(self) -> AllocationList | None:
        """Return the list that is followed now; None if none is fixed."""
        row = self._connection.execute(
            """
            SELECT id, seed, block_size, quotas, slots FROM allocation_list
            WHERE site = :site AND kind = :kind ORDER BY id DESC LIMIT 1
            """,
            self._whose,
        ).fetchone()
        if row is None:
            return None
        number, seed, block, quotas, listed = row
        return AllocationList(number, seed, block, quotas_from_json(quotas), slots_from_json(listed))

    def consumed(self) -> set[int]:
        """Return the numbers of the slots whose game was completed, those of people who withdrew among them."""
        return {slot for (slot,) in self._connection.execute(_CONSUMED, self._whose)}

    def is_consumed(self, slot: int) -> bool:
        """Whether the game of a slot was completed."""
        query = f"SELECT EXISTS (SELECT 1 FROM ({_CONSUMED}) WHERE allocation_slot = :slot)"  # noqa: S608 - it stands here
        return bool(self._connection.execute(query, self._whose | {"slot": slot}).fetchone()[0])

    def next_slot(self) -> AllocationSlot | None:
        """Return the first slot that is not consumed; None if all are, or if no list is fixed.

        Slots are taken in their order, so where as many are consumed as the highest one says, the next one follows it;
        no other slot is looked at then.
        """
        listed = self._latest_slots()
        if listed is None:
            return None
        count, highest = self._connection.execute(_HOW_FAR, self._whose).fetchone()
        if count == highest:
            return listed.slot(highest + 1)
        return next_slot(_slots(listed.blocks), self.consumed())

    def list_with(self, slot: AllocationSlot) -> int:
        """Return the row of the list in which this slot is free; raises ValueError if it is not."""
        listed = self._latest_slots()
        if listed is None or slot != listed.slot(slot.number) or self.is_consumed(slot.number):
            raise ValueError(f"there is no free {slot} in the list that is fixed")
        return listed.row

    def _latest_slots(self) -> _Listed | None:
        """Return the list that is followed now; a stored list never changes, so each is read once."""
        row = self._connection.execute(
            "SELECT id FROM allocation_list WHERE site = :site AND kind = :kind ORDER BY id DESC LIMIT 1",
            self._whose,
        ).fetchone()
        if row is None:
            return None
        if self._listed is None or self._listed.row != row[0]:
            (slots,) = self._connection.execute("SELECT slots FROM allocation_list WHERE id = ?", row).fetchone()
            self._listed = _Listed(row[0], json.loads(slots))
        return self._listed

    def create(self, quotas: Mapping[Condition, int], block: int, seed: int | None) -> tuple[AllocationSlot, ...]:
        """Store the first list, find this very one stored, or store a longer one for raised quotas.

        Raises UserInputError for another list than the stored one, and for quotas or a block that cannot be kept to.
        """
        stored = self.latest()
        if stored is None:
            drawn = SystemRandom().getrandbits(SEED_BITS) if seed is None else seed
            return self._store(quotas, block, drawn, allocation_slots(quotas, block, drawn))
        listed = _continued(stored, quotas, block, seed)
        return listed if listed == stored.slots else self._store(quotas, block, stored.seed, listed)

    def check(self, quotas: Mapping[Condition, int], block: int, seed: int | None) -> None:
        """Raise UserInputError where ``create`` would, for another list than the stored one; nothing is stored."""
        stored = self.latest()
        if stored is not None:
            _continued(stored, quotas, block, seed)

    def _store(
        self, quotas: Mapping[Condition, int], block: int, seed: int, listed: tuple[AllocationSlot, ...]
    ) -> tuple[AllocationSlot, ...]:
        self._connection.execute(
            """
            INSERT INTO allocation_list (site, kind, seed, block_size, quotas, slots, fixed_at)
            VALUES (:site, :kind, :seed, :block_size, :quotas, :slots, :fixed_at)
            """,
            self._whose
            | {"seed": seed, "block_size": block, "quotas": quotas_to_json(quotas), "slots": slots_to_json(listed)}
            | {"fixed_at": datetime.now(UTC).isoformat(timespec="milliseconds")},
        )
        return listed


_CONSUMED = """
    SELECT allocation_slot FROM session JOIN session_summary ON session_summary.session = session.id
    WHERE site = :site AND kind = :kind AND allocation_source = 'list' AND game_completed
    UNION
    SELECT allocation_slot FROM tombstone WHERE site = :site AND kind = :kind AND allocation_source = 'list'
    AND game_completed
"""
_HOW_FAR = """
    SELECT
        (SELECT coalesce(sum(sessions), 0) FROM session_tally
            WHERE kind = :kind AND site = :site AND allocation_source = 'list' AND game_completed)
        + (SELECT count(*) FROM tombstone
            WHERE site = :site AND kind = :kind AND allocation_source = 'list' AND game_completed),
        max(
            coalesce((SELECT allocation_slot FROM session JOIN session_summary ON session_summary.session = session.id
                WHERE site = :site AND kind = :kind AND allocation_source = 'list' AND game_completed
                ORDER BY allocation_slot DESC LIMIT 1), 0),
            coalesce((SELECT max(allocation_slot) FROM tombstone
                WHERE site = :site AND kind = :kind AND allocation_source = 'list' AND game_completed), 0)
        )
"""
"""How many slots are consumed, and the highest of them."""


def check_not_given_out_again(connection: sqlite3.Connection, session: int) -> None:
    """Raise UserInputError if another completed game took the slot of a session that was cut off."""
    site, kind, slot, finished = connection.execute(
        """
        SELECT site, kind, allocation_slot,
            EXISTS (SELECT 1 FROM event WHERE session = :session AND type = 'GameFinished')
        FROM session WHERE id = :session
        """,
        {"session": session},
    ).fetchone()
    lists = AllocationLists(connection, site, kind=SessionKind(kind))
    if slot is not None and not finished and lists.is_consumed(slot):
        raise UserInputError(f"the slot of session {session} was given out again, so it cannot be gone on with")


def quotas_to_json(quotas: Mapping[Condition, int]) -> str:
    """Quotas by the conditions' names, in the conditions' own order."""
    return json.dumps({condition.name: quotas[condition] for condition in in_design_order(quotas)})


def quotas_from_json(text: str) -> dict[Condition, int]:
    """Return what ``quotas_to_json`` wrote."""
    return {Condition(name): quota for name, quota in json.loads(text).items()}


def slots_to_json(listed: tuple[AllocationSlot, ...]) -> str:
    """Return a list of blocks, each a list of conditions, so that it can be read without the program."""
    return json.dumps([[p.condition.name for p in block] for _, block in groupby(listed, lambda p: p.block)])


@lru_cache(maxsize=8)
def slots_by_block(text: str) -> Mapping[int, tuple[Condition, ...]]:
    """Return the conditions of each block (from 1) of a list that ``slots_to_json`` wrote."""
    blocks = groupby(slots_from_json(text), lambda slot: slot.block)
    return {block: tuple(slot.condition for slot in slots) for block, slots in blocks}


# An export asks for the slots of each session, and thousands of sessions have the same list.
@lru_cache(maxsize=8)
def slots_from_json(text: str) -> tuple[AllocationSlot, ...]:
    """Return what ``slots_to_json`` wrote."""
    return _slots(json.loads(text))


def _slots(blocks: Sequence[Sequence[str]]) -> tuple[AllocationSlot, ...]:
    named = ((block, name) for block, names in enumerate(blocks, 1) for name in names)
    return tuple(AllocationSlot(number, block, Condition(name)) for number, (block, name) in enumerate(named, 1))


def _continued(
    stored: AllocationList, quotas: Mapping[Condition, int], block: int, seed: int | None
) -> tuple[AllocationSlot, ...]:
    """Return the stored list, or a longer one for raised quotas; raise UserInputError if another list is stored."""
    if block != stored.block or seed not in (None, stored.seed):
        raise _another(stored)
    try:
        return allocation_slots(quotas, block, stored.seed, kept=stored.slots)
    except UserInputError as error:
        raise _another(stored) from error


def _another(stored: AllocationList) -> UserInputError:
    return UserInputError(
        f"another allocation list is already fixed in this data folder ({ratio_in_words(stored.quotas)}, in blocks of "
        f"{stored.block}): use another data folder, or these quotas, or raise them in their ratio"
    )


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
