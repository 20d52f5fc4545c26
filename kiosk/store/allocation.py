"""Keep allocation lists: slots that are fixed before the first visitor, and each given out once."""

from __future__ import annotations

import json
import sqlite3
from bisect import bisect_left
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
from kiosk.experiment.outcomes import SessionKind
from kiosk.lazy_dataclass import dataclass

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
