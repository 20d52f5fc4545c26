"""The table of the participant flow: how many came, and what became of them, so that everybody adds up."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from enum import Enum

from kiosk.store.dataset.column import Cell, Column, Kind, Table, Variable, named
from kiosk.store.dataset.extras import Extra
from kiosk.store.dataset.stored.kept import Kept
from kiosk.store.dataset.tables.shared import columns, who_sat_there
from kiosk.store.people.counting import Counts, Fate
from kiosk.study.after.overview import Overview, overview
from kiosk.study.events import Stage, Status
from kiosk.study.session_kind import SessionKind


class Quantity(Enum):
    """What is counted."""

    NOT_STORED = "not_stored"
    QUOTA = "quota"
    CONSUMED = Fate.CONSUMED.value
    DROPPED_OUT = Fate.DROPPED_OUT.value
    UNDER_WAY = Fate.UNDER_WAY.value
    OVERRIDDEN = Fate.OVERRIDDEN.value
    BEYOND = Fate.BEYOND.value
    UNLISTED = Fate.UNLISTED.value
    WITHDRAWN = "withdrawn"
    NOT_SHARED = "not_shared"
    NOT_ENDED = "not_ended"
    ENDED_AT = "ended_at"
    EXPORTED = "exported"


MEANINGS = {
    Quantity.NOT_STORED: "people who played without being stored, by reason",
    Quantity.QUOTA: "how many completed games were wanted, by condition",
    Quantity.CONSUMED: "sittings that took a place of the list and completed the game, by condition",
    Quantity.DROPPED_OUT: "sittings that had a place and did not complete the game, so that it was given out again, by "
    "condition",
    Quantity.UNDER_WAY: "sittings with a place that were going on when this was exported, by condition",
    Quantity.OVERRIDDEN: "sittings whose condition the experimenter chose, by condition",
    Quantity.BEYOND: "sittings that began when the list was used up, by condition",
    Quantity.UNLISTED: "sittings without a list of places, by condition",
    Quantity.WITHDRAWN: "sittings that were deleted because their visitor withdrew, by condition; each is counted in "
    "one of the rows before as well",
    Quantity.NOT_SHARED: "sittings left out here because their visitor did not agree to publishing, by condition",
    Quantity.NOT_ENDED: "sittings left out here because they were going on, by condition",
    Quantity.ENDED_AT: "sittings in this data set that ended before their end, by the stage in which they did",
    Quantity.EXPORTED: "sittings in this data set, by condition",
}


@dataclass
class Flow:
    """What was counted on the way through the sittings of people, of rehearsals or of trials."""

    kind: SessionKind
    counts: Counts
    seen: Counter[tuple[Quantity, str]] = field(default_factory=Counter)

    def exported(self, kept: Kept) -> None:
        """Count a sitting that is in the data set."""
        self.seen[Quantity.EXPORTED, str(kept.row["condition"])] += 1
        if kept.status is not Status.COMPLETED:
            self.seen[Quantity.ENDED_AT, last_stage(overview(kept.events)).value] += 1

    def left_out(self, kept: Kept, why: Quantity) -> None:
        """Count one that is not."""
        self.seen[why, str(kept.row["condition"])] += 1


def last_stage(sitting: Overview) -> Stage:
    """The last stage that was more than the end."""
    return sitting.last or Stage.ATTRACT


@dataclass(frozen=True)
class _Count:
    kind: SessionKind
    quantity: Quantity
    group: str
    count: int


def _rows(flows: tuple[Flow, ...]) -> Iterator[_Count]:
    for flow in flows:
        counted = _counted(flow.counts) + flow.seen
        for quantity in Quantity:
            for (what, group), count in counted.items():
                if what is quantity:
                    yield _Count(flow.kind, quantity, group, count)


def _counted(counts: Counts) -> Counter[tuple[Quantity, str]]:
    """What the database has counted; nothing that is none."""
    counted = Counter({(Quantity.NOT_STORED, why.value): number for why, number in counts.visits.items()})
    for condition, cell in counts.cells.items():
        counted[Quantity.QUOTA, condition.value] = cell.quota
        counted[Quantity.WITHDRAWN, condition.value] = cell.withdrawn
        counted |= Counter({(Quantity(fate.value), condition.value): n for fate, n in cell.fates.items()})
    return +counted


def _is_of(kind: SessionKind) -> Callable[[_Count], Cell]:
    return lambda row: row.kind is kind


def flow(extras: frozenset[Extra]) -> Table[tuple[Flow, ...], _Count]:
    """The table of the flow."""
    counted: tuple[Column[_Count], ...] = columns(
        *((variable, _is_of(kind)) for variable, kind in who_sat_there(extras)),
        (
            Variable(
                "quantity",
                "What is counted; what is not listed is none.",
                levels=named(Quantity, **{quantity.value: meaning for quantity, meaning in MEANINGS.items()}),
            ),
            lambda row: row.quantity.value,
        ),
        (Variable("group", "The reason, the condition or the stage that it is counted by."), lambda row: row.group),
        (Variable("count", "How many.", Kind.WHOLE), lambda row: row.count),
    )
    return Table(
        "flow",
        "One row for every count of the participant flow.",
        ("quantity", "group"),
        counted,
        _rows,
    )
