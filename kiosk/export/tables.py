"""All the tables of a study's data set, in the order in which a reader meets them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from kiosk.assistance.policy import ActionSpec
from kiosk.experiment.session_config import SessionConfig
from kiosk.export.columns import ExportOption, Table, TableShape
from kiosk.export.decision_tables import DECISIONS, MEMORY, MODELLED_DECISIONS
from kiosk.export.flow import ParticipantFlow, flow_table
from kiosk.export.game_tables import CARDS, FLIPS, POINTER_TRACES
from kiosk.export.help_tables import REMARKS, hints_table
from kiosk.export.log_tables import SENTENCES, deviations_table, events_table
from kiosk.export.participants import participants_table, renamed
from kiosk.export.records import StudyMaterials
from kiosk.export.responses import SCORES, answers_table
from kiosk.store.session_records import SessionRecord


@dataclass(frozen=True)
class DatasetTables:
    """The tables that a session adds rows to, and the one of all sessions together."""

    sessions: tuple[Table[SessionRecord, Any], ...]
    flow: Table[tuple[ParticipantFlow, ...], Any]

    @property
    def shapes(self) -> tuple[TableShape, ...]:
        """What every table looks like."""
        return (*(table.shape for table in self.sessions), self.flow.shape)

    def named(self, name: str) -> Table[SessionRecord, Any]:
        """One of the tables that a session adds rows to."""
        return next(table for table in self.sessions if table.name == name)


def all_tables(study: StudyMaterials, extras: frozenset[ExportOption]) -> DatasetTables:
    """Return the tables of a study's data set."""
    others, whole = _others(study, extras), flow_table(extras)
    return DatasetTables((participants_table(study, extras, _elsewhere(study, extras)), *others), whole)


def renamed_items(study: StudyMaterials) -> dict[str, str]:
    """Return the items about the visitor whose columns have another name.

    Their own is that of a column of the program's.
    """
    return renamed(study, _elsewhere(study, frozenset(ExportOption)))


def _others(study: StudyMaterials, extras: frozenset[ExportOption]) -> tuple[Table[SessionRecord, Any], ...]:
    traced = any(plan.settings.privacy.pointer_trace for plan in study.plans)
    modelled = any(plan.settings.assistance.models_memory for plan in study.plans)
    triggered = any(plan.settings.assistance.hesitation_max for plan in study.plans)
    remarks = (REMARKS,) if any(_has_remarks(plan) for plan in study.plans) else ()
    looks = any(cell.gaze_only for plan in study.plans for cell in plan.settings.conditions.values())
    hints = hints_table(triggered=triggered, looks=looks)
    decisions = (MODELLED_DECISIONS, MEMORY) if modelled else (DECISIONS,)
    return (
        *(FLIPS, *((POINTER_TRACES,) if traced else ()), hints, *remarks, *decisions, CARDS),
        *(answers_table(study, extras), SCORES, SENTENCES, deviations_table(extras), events_table(study, extras)),
    )


def _has_remarks(plan: SessionConfig) -> bool:
    """Tell whether something may be said in the game that points nowhere."""
    actions = (action for action in plan.policy.actions if action is not ActionSpec.NO_HELP)
    declared = plan.settings.conditions.values()
    return any(cell.comments for cell in declared) or any(not action.needs_target for action in actions)


def _elsewhere(study: StudyMaterials, extras: frozenset[ExportOption]) -> frozenset[str]:
    """Return the columns of all tables but that of participants."""
    shapes = (*(table.shape for table in _others(study, extras)), flow_table(extras).shape)
    return frozenset(name for shape in shapes for name in shape.names)
