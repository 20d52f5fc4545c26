"""Choose the condition of each session, and say what else it follows."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from kiosk.experiment.condition import AllocationSlot, Condition, condition_of_return
from kiosk.experiment.experimenter import AuditEvent
from kiosk.experiment.outcomes import AllocationSource, EmbodimentName, SessionKind
from kiosk.experiment.session_config import StudyConfig
from kiosk.lazy_dataclass import dataclass
from kiosk.store.participants import ReturningVisitor
from kiosk.store.recorder import Provenance, Recorder


@dataclass(frozen=True)
class _Choice:
    """A condition that the experimenter chose; a later choice is another one, even of the same condition."""

    condition: Condition


@dataclass(frozen=True)
class RunContext:
    """What all sessions of a run of the program have in common."""

    code_commit: str
    kind: SessionKind
    seed: Callable[[], int]
    """Gives every session a seed of its own."""
    condition: Condition | None = None
    """Every session is in this one, whatever the list says, and takes no slot in it."""


class ConditionAssigner:
    """Chooses the next session's condition: the experimenter's, else the list's next, else the study file's."""

    def __init__(self, study: StudyConfig, recorder: Recorder, origin: RunContext) -> None:
        """Create the allocation list, if the study has targets.

        Raises UserInputError if another list is fixed, and StorageError from the store.
        """
        self.study = study
        self._recorder = recorder
        self._origin = origin
        self._choice: _Choice | None = None
        self._followed: _Choice | None = None
        """The choice that the latest session follows."""
        allocation = study.settings.randomisation
        quotas = {study.condition(name): quota for name, quota in allocation.target_n.items()}
        self._listed = bool(quotas) and origin.condition is None
        if self._listed:
            recorder.create_allocation_list(quotas, allocation.block_size, allocation.seed, kind=origin.kind)

    @property
    def kind(self) -> SessionKind:
        """Who sits there."""
        return self._origin.kind

    @property
    def chosen(self) -> Condition | None:
        """The condition that the experimenter chose for the next session; None for the list's."""
        return self._choice.condition if self._choice else None

    @property
    def is_followed(self) -> bool:
        """Whether the choice is that of the visitor who sits there, and not yet one for the visitor after."""
        return self._choice is not None and self._choice is self._followed

    def choose(self, condition: Condition | None, reason: str) -> None:
        """Have the next session in this condition, or, with None, in the list's; raises StorageError."""
        name = condition.name if condition else "automatic"
        self._recorder.add_audit_event(AuditEvent.CONDITION_CHOSEN.value, {"condition": name, "reason": reason})
        self._choice = None if condition is None else _Choice(condition)

    def next_session(self, language: str, returning: ReturningVisitor | None = None) -> Provenance:
        """Return what the session of a new participant, or of one who comes back, follows; raises StorageError."""
        self._followed = self._choice
        earlier = self._by_earlier_visits(returning) if returning else None
        slot = self._next_slot() if self._listed and self._choice is None and earlier is None else None
        condition = self.chosen or earlier or (slot.condition if slot else self._origin.condition)
        plan = self.study.plan(language, condition)
        return Provenance(
            plan if returning is None else replace(plan, visit=returning.visit),
            self._origin.seed(),
            str(EmbodimentName.AVATAR),
            self._origin.code_commit,
            kind=self._origin.kind,
            slot=slot,
            allocation_source=AllocationSource.RETURNING if earlier else self._allocation_source(slot),
            returning=returning,
        )

    def _by_earlier_visits(self, returning: ReturningVisitor) -> Condition | None:
        """Return the condition that follows from earlier visits; None if it is found as for a new participant."""
        if self._choice is not None or self._origin.condition is not None:
            return None
        settings = self.study.settings
        listed = [Condition(name) for name in settings.randomisation.target_n]
        condition = condition_of_return(settings.returning.condition, returning.conditions, listed)
        # The study may have dropped a condition since.
        return condition if condition is not None and condition.name in settings.all_conditions else None

    def confirm_recorded(self, provenance: Provenance) -> None:
        """Note that a session is on record: what was chosen for it does not hold for the one after."""
        if provenance.allocation_source is AllocationSource.OVERRIDE and self._choice is self._followed:
            self._choice = None

    def _next_slot(self) -> AllocationSlot | None:
        return self._recorder.next_slot(kind=self._origin.kind)

    def _allocation_source(self, slot: AllocationSlot | None) -> AllocationSource | None:
        if self._choice is not None:
            return AllocationSource.OVERRIDE
        if not self._listed:
            return None
        return AllocationSource.BEYOND if slot is None else AllocationSource.LIST
