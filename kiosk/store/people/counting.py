"""How many came, by condition and by what became of them; whoever withdrew is still counted."""

from __future__ import annotations

import sqlite3
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum

from kiosk.store.people.lists import quotas_from_json
from kiosk.study.allocation import Allotted
from kiosk.study.condition import Condition
from kiosk.study.events import Unstored
from kiosk.study.session_kind import SessionKind


class Fate(Enum):
    """What became of a sitting, as far as the list of places goes; every sitting has exactly one."""

    CONSUMED = "consumed"
    """Its game was completed, so its place is consumed."""
    DROPPED_OUT = "dropped_out"
    """It had a place, which was given out again."""
    UNDER_WAY = "under_way"
    """It has a place, and its game may still be completed."""
    OVERRIDDEN = "overridden"
    BEYOND = "beyond"
    UNLISTED = "unlisted"
    """No list was followed."""


@dataclass(frozen=True)
class Cell:
    """One condition in numbers; of all its sittings, whatever became of them, ``withdrawn`` were withdrawn."""

    quota: int
    fates: Mapping[Fate, int]
    withdrawn: int

    @property
    def begun(self) -> int:
        """How many sittings were begun in this condition."""
        return sum(self.fates.values())

    def to_json(self) -> dict[str, int]:
        """The cell as the command line prints it."""
        fates = {fate.value: self.fates[fate] for fate in Fate}
        return {"quota": self.quota, "begun": self.begun} | fates | {"withdrawn": self.withdrawn}


@dataclass(frozen=True)
class Counts:
    """Every condition that has a quota or a sitting, and the people who played without being stored."""

    cells: Mapping[Condition, Cell]
    visits: Mapping[Unstored, int]


def counts(connection: sqlite3.Connection, *, simulated: bool | SessionKind, in_use: bool) -> Counts:
    """Count people, rehearsals or trials.

    With ``in_use`` the folder is being written, so that a sitting without an end is under way.
    """
    fates: Counter[tuple[Condition, Fate]] = Counter()
    withdrawn: Counter[Condition] = Counter()
    for name, allotted, finished, ended, gone in connection.execute(_SITTINGS, {"simulated": int(simulated)}):
        condition = Condition(name)
        fates[condition, _fate(allotted, finished=bool(finished), ended=bool(ended) or not in_use)] += 1
        withdrawn[condition] += gone
    quotas = _quotas(connection, simulated=simulated)
    there = {condition for condition, _ in fates} | set(quotas)
    return Counts(
        {
            condition: Cell(quotas[condition], {fate: fates[condition, fate] for fate in Fate}, withdrawn[condition])
            for condition in Condition
            if condition in there
        },
        _visits(connection, simulated=simulated),
    )


_SITTINGS = """
    SELECT condition, allotted,
        EXISTS (SELECT 1 FROM event WHERE event.sitting = sitting.id AND type = 'GameFinished'),
        'SittingEnded' = (SELECT type FROM event WHERE event.sitting = sitting.id ORDER BY seq DESC LIMIT 1),
        0
    FROM sitting WHERE simulated = :simulated
    UNION ALL
    SELECT condition, allotted, game_completed, 1, 1 FROM tombstone WHERE simulated = :simulated
"""


def _fate(allotted: str | None, *, finished: bool, ended: bool) -> Fate:
    match allotted and Allotted(allotted):
        case Allotted.LIST if finished:
            return Fate.CONSUMED
        case Allotted.LIST:
            return Fate.DROPPED_OUT if ended else Fate.UNDER_WAY
        case Allotted.OVERRIDE:
            return Fate.OVERRIDDEN
        case Allotted.BEYOND:
            return Fate.BEYOND
        case _:
            return Fate.UNLISTED


def _quotas(connection: sqlite3.Connection, *, simulated: bool | SessionKind) -> Counter[Condition]:
    """What the lists that are followed ask for, of all sites together."""
    asked: Counter[Condition] = Counter()
    latest = "SELECT max(id) FROM allocation GROUP BY site, simulated"
    for (quotas,) in connection.execute(
        f"SELECT quotas FROM allocation WHERE simulated = ? AND id IN ({latest})",  # noqa: S608 - it stands here
        (int(simulated),),
    ):
        asked.update(quotas_from_json(quotas))
    return asked


def _visits(connection: sqlite3.Connection, *, simulated: bool | SessionKind) -> dict[Unstored, int]:
    rows = connection.execute("SELECT why, count(*) FROM visit WHERE simulated = ? GROUP BY why", (int(simulated),))
    counted = dict(rows.fetchall())
    return {why: counted.get(why.value, 0) for why in Unstored}
