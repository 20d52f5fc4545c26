"""The participant flow: what became of everybody who came, and the table of it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from enum import Enum

from kiosk.experiment.outcomes import Disposition, SessionKind, Stage, Status
from kiosk.experiment.session_state import SessionState
from kiosk.export.columns import (
    Cell,
    Column,
    ColumnKind,
    ExportOption,
    Table,
    Variable,
    enum_levels,
    make_columns,
    who_sat_there,
)
from kiosk.store.participants import EnrolmentCounts
from kiosk.store.session_records import SessionRecord


class FlowQuantity(Enum):
    """What is counted."""

    NOT_STORED = "not_stored"
    QUOTA = "quota"
    CONSUMED = Disposition.CONSUMED.value
    DROPPED_OUT = Disposition.DROPPED_OUT.value
    UNDER_WAY = Disposition.UNDER_WAY.value
    OVERRIDDEN = Disposition.OVERRIDDEN.value
    BEYOND = Disposition.BEYOND.value
    RETURNING = Disposition.RETURNING.value
    UNLISTED = Disposition.UNLISTED.value
    WITHDRAWN = "withdrawn"
    NOT_SHARED = "not_shared"
    NOT_ENDED = "not_ended"
    ENDED_AT = "ended_at"
    EXPORTED = "exported"


MEANINGS = {
    FlowQuantity.NOT_STORED: "people who played without being stored, by reason",
    FlowQuantity.QUOTA: "how many completed games were wanted, by condition",
    FlowQuantity.CONSUMED: "sessions that took a slot of the allocation list and completed the game, by condition",
    FlowQuantity.DROPPED_OUT: "sessions that had a slot and did not complete the game, so that it was given out "
    "again, by condition",
    FlowQuantity.UNDER_WAY: "sessions with a slot that were going on when this was exported, by condition",
    FlowQuantity.OVERRIDDEN: "sessions whose condition the experimenter chose, by condition",
    FlowQuantity.BEYOND: "sessions that began when the list was used up, by condition",
    FlowQuantity.RETURNING: "later visits of participants who came back and took no slot, by condition",
    FlowQuantity.UNLISTED: "sessions without an allocation list, by condition",
    FlowQuantity.WITHDRAWN: "sessions that were deleted because their visitor withdrew, by condition; each is counted "
    "in one of the rows before as well",
    FlowQuantity.NOT_SHARED: "sessions left out here because their visitor did not agree to publishing, by condition",
    FlowQuantity.NOT_ENDED: "sessions left out here because they were going on, by condition",
    FlowQuantity.ENDED_AT: "sessions in this data set that ended before their end, by the stage in which they did",
    FlowQuantity.EXPORTED: "sessions in this data set, by condition",
}


@dataclass
class ParticipantFlow:
    """What was counted on the way through the sessions of people, of rehearsals or of trials."""

    kind: SessionKind
    counts: EnrolmentCounts
    seen: Counter[tuple[FlowQuantity, str]] = field(default_factory=Counter)

    def exported(self, kept: SessionRecord) -> None:
        """Count a session that is in the data set."""
        self.seen[FlowQuantity.EXPORTED, str(kept.row["condition"])] += 1
        if kept.status is not Status.COMPLETED:
            self.seen[FlowQuantity.ENDED_AT, last_stage(kept.state).value] += 1

    def counted(self, kept: SessionRecord, *, unshared: bool) -> bool:
        """Count a session, and return whether it is in the data set; ``unshared`` takes those in as well."""
        if kept.status is None:
            self.left_out(kept, FlowQuantity.NOT_ENDED)
        elif not kept.publishable and not unshared:
            self.left_out(kept, FlowQuantity.NOT_SHARED)
        else:
            self.exported(kept)
            return True
        return False

    def left_out(self, kept: SessionRecord, why: FlowQuantity) -> None:
        """Count one that is not."""
        self.seen[why, str(kept.row["condition"])] += 1


def last_stage(session: SessionState) -> Stage:
    """Return the last stage that was more than the end."""
    return session.last_stage or Stage.ATTRACT


@dataclass(frozen=True)
class _Count:
    kind: SessionKind
    quantity: FlowQuantity
    group: str
    count: int


def _rows(flows: tuple[ParticipantFlow, ...]) -> Iterator[_Count]:
    for flow in flows:
        counted = _counted(flow.counts) + flow.seen
        for quantity in FlowQuantity:
            for (what, group), count in counted.items():
                if what is quantity:
                    yield _Count(flow.kind, quantity, group, count)


def _counted(counts: EnrolmentCounts) -> Counter[tuple[FlowQuantity, str]]:
    """Return what the database has counted; nothing that is none."""
    counted = Counter({(FlowQuantity.NOT_STORED, why.value): number for why, number in counts.visits.items()})
    for condition, cell in counts.cells.items():
        counted[FlowQuantity.QUOTA, condition.name] = cell.quota
        counted[FlowQuantity.WITHDRAWN, condition.name] = cell.withdrawn
        counted |= Counter({(FlowQuantity(fate.value), condition.name): n for fate, n in cell.fates.items()})
    return +counted


def _is_of(kind: SessionKind) -> Callable[[_Count], Cell]:
    return lambda row: row.kind is kind


def flow_table(extras: frozenset[ExportOption]) -> Table[tuple[ParticipantFlow, ...], _Count]:
    """Return the table of the flow."""
    counted: tuple[Column[_Count], ...] = make_columns(
        *((variable, _is_of(kind)) for variable, kind in who_sat_there(extras)),
        (
            Variable(
                "quantity",
                "What is counted; what is not listed is none.",
                levels=enum_levels(FlowQuantity, **{quantity.value: meaning for quantity, meaning in MEANINGS.items()}),
            ),
            lambda row: row.quantity.value,
        ),
        (Variable("group", "The reason, the condition or the stage that it is counted by."), lambda row: row.group),
        (Variable("count", "How many.", ColumnKind.WHOLE), lambda row: row.count),
    )
    return Table(
        "flow",
        "One row for every count of the participant flow.",
        ("quantity", "group"),
        counted,
        _rows,
    )
