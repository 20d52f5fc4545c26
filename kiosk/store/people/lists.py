"""The list of places of a site, as it is stored: fixed once, at most made longer, and consumed by completed games."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from itertools import groupby
from random import SystemRandom

from kiosk import BadInput
from kiosk.study.allocation import Place, next_place, places, ratio_in_words
from kiosk.study.condition import Condition
from kiosk.study.session_kind import SessionKind

SEED_BITS = 63
"""Who has seen many places of a list shall not find the rest by trying seeds."""


@dataclass(frozen=True)
class PlaceList:
    """A stored list; ``id`` is its row."""

    id: int
    seed: int
    block: int
    quotas: Mapping[Condition, int]
    places: tuple[Place, ...]


class Lists:
    """The lists of one site, of one kind of sittings; the last one goes on from those before and is followed."""

    def __init__(self, connection: sqlite3.Connection, site: str, *, simulated: bool | SessionKind) -> None:
        """Whoever calls ``fix`` has a transaction open."""
        self._connection = connection
        self._whose = {"site": site, "simulated": int(simulated)}

    def latest(self) -> PlaceList | None:
        """The list that is followed now; None if none is fixed."""
        row = self._connection.execute(
            """
            SELECT id, seed, block, quotas, places FROM allocation
            WHERE site = :site AND simulated = :simulated ORDER BY id DESC LIMIT 1
            """,
            self._whose,
        ).fetchone()
        if row is None:
            return None
        number, seed, block, quotas, listed = row
        return PlaceList(number, seed, block, quotas_from_json(quotas), places_from_json(listed))

    def consumed(self) -> set[int]:
        """The numbers of the places whose game was completed, those of people who withdrew among them."""
        rows = self._connection.execute(
            """
            SELECT place FROM sitting WHERE site = :site AND simulated = :simulated AND allotted = 'list'
            AND id IN (SELECT sitting FROM event WHERE type = 'GameFinished')
            UNION
            SELECT place FROM tombstone WHERE site = :site AND simulated = :simulated AND allotted = 'list'
            AND game_completed
            """,
            self._whose,
        )
        return {place for (place,) in rows}

    def next_place(self) -> Place | None:
        """The first place that is not consumed; None if all are, or if no list is fixed."""
        stored = self.latest()
        return next_place(stored.places, self.consumed()) if stored else None

    def list_with(self, place: Place) -> int:
        """The row of the list in which this place is free; raises ValueError if it is not."""
        stored = self.latest()
        if stored is None or place not in stored.places or place.number in self.consumed():
            raise ValueError(f"there is no free {place} in the list that is fixed")
        return stored.id

    def fix(self, quotas: Mapping[Condition, int], block: int, seed: int | None) -> tuple[Place, ...]:
        """Store the first list, find this very one stored, or store a longer one for raised quotas.

        Raises BadInput for another list than the stored one, and for quotas or a block that cannot be kept to.
        """
        stored = self.latest()
        if stored is None:
            drawn = SystemRandom().getrandbits(SEED_BITS) if seed is None else seed
            return self._store(quotas, block, drawn, places(quotas, block, drawn))
        listed = _continued(stored, quotas, block, seed)
        return listed if listed == stored.places else self._store(quotas, block, stored.seed, listed)

    def check(self, quotas: Mapping[Condition, int], block: int, seed: int | None) -> None:
        """Raise BadInput where ``fix`` would for another list than the stored one; nothing is stored."""
        stored = self.latest()
        if stored is not None:
            _continued(stored, quotas, block, seed)

    def _store(
        self, quotas: Mapping[Condition, int], block: int, seed: int, listed: tuple[Place, ...]
    ) -> tuple[Place, ...]:
        self._connection.execute(
            """
            INSERT INTO allocation (site, simulated, seed, block, quotas, places, fixed_at)
            VALUES (:site, :simulated, :seed, :block, :quotas, :places, :fixed_at)
            """,
            self._whose
            | {"seed": seed, "block": block, "quotas": quotas_to_json(quotas), "places": places_to_json(listed)}
            | {"fixed_at": datetime.now(UTC).isoformat(timespec="milliseconds")},
        )
        return listed


def check_not_given_out_again(connection: sqlite3.Connection, sitting: int) -> None:
    """Raise BadInput if the place of a sitting was given out again while it was cut off, and that game completed."""
    site, simulated, place, finished = connection.execute(
        """
        SELECT site, simulated, place, EXISTS (SELECT 1 FROM event WHERE sitting = ?1 AND type = 'GameFinished')
        FROM sitting WHERE id = ?1
        """,
        (sitting,),
    ).fetchone()
    lists = Lists(connection, site, simulated=SessionKind(simulated))
    if place is not None and not finished and place in lists.consumed():
        raise BadInput(f"the place of sitting {sitting} was given out again, so it cannot be gone on with")


def quotas_to_json(quotas: Mapping[Condition, int]) -> str:
    """Quotas by the conditions' names, in the conditions' own order."""
    return json.dumps({condition.value: quotas[condition] for condition in Condition if condition in quotas})


def quotas_from_json(text: str) -> dict[Condition, int]:
    """What ``quotas_to_json`` wrote."""
    return {Condition(name): quota for name, quota in json.loads(text).items()}


def places_to_json(listed: tuple[Place, ...]) -> str:
    """A list of blocks, each a list of conditions, so that it can be read without the program."""
    return json.dumps([[p.condition.value for p in block] for _, block in groupby(listed, lambda p: p.block)])


def places_from_json(text: str) -> tuple[Place, ...]:
    """What ``places_to_json`` wrote."""
    named = ((block, name) for block, names in enumerate(json.loads(text), 1) for name in names)
    return tuple(Place(number, block, Condition(name)) for number, (block, name) in enumerate(named, 1))


def _continued(stored: PlaceList, quotas: Mapping[Condition, int], block: int, seed: int | None) -> tuple[Place, ...]:
    """The stored list, or a longer one for raised quotas; raises BadInput for another list than the stored one."""
    if block != stored.block or seed not in (None, stored.seed):
        raise _another(stored)
    try:
        return places(quotas, block, stored.seed, kept=stored.places)
    except BadInput as error:
        raise _another(stored) from error


def _another(stored: PlaceList) -> BadInput:
    return BadInput(
        f"another list of places is already fixed in this data folder ({ratio_in_words(stored.quotas)}, in blocks of "
        f"{stored.block}): use another data folder, or these quotas, or raise them in their ratio"
    )
