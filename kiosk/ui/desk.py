"""The experimenter's desk: what the next sitting is to follow, by the list or by a decision that is recorded.

No visitor sees it, and nothing decided here changes a sitting that is under way.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from kiosk.store.recorder import Provenance, Recorder
from kiosk.study.allocation import Allotted, Place
from kiosk.study.booth.notes import Note
from kiosk.study.condition import Condition
from kiosk.study.events import BodyName
from kiosk.study.plan import Study
from kiosk.study.session_kind import SessionKind


@dataclass(frozen=True)
class _Choice:
    """A condition that the experimenter chose; a later choice is another one, even of the same condition."""

    condition: Condition


@dataclass(frozen=True)
class Origin:
    """What all sittings of a run of the program have in common."""

    code_commit: str
    simulated: bool | SessionKind
    seed: Callable[[], int]
    """Gives every sitting a seed of its own."""
    condition: Condition | None = None
    """Every sitting is in this one, whatever the list says, and takes no place in it."""


class Desk:
    """Chooses the next sitting's condition: the experimenter's, else the list's next, else the study file's."""

    def __init__(self, study: Study, recorder: Recorder, origin: Origin) -> None:
        """Fix the list of places, if the study has quotas; raises BadInput if another one is fixed, or StoreFailed."""
        self.study = study
        self._recorder = recorder
        self._origin = origin
        self._choice: _Choice | None = None
        self._followed: _Choice | None = None
        """The choice that the latest sitting follows."""
        allocation = study.settings.allocation
        quotas = {Condition.named(name): quota for name, quota in allocation.quotas.items()}
        self._listed = bool(quotas) and origin.condition is None
        if self._listed:
            recorder.fix_list(quotas, allocation.block, allocation.seed, simulated=origin.simulated)

    @property
    def kind(self) -> SessionKind:
        """Who sits there."""
        return SessionKind(self._origin.simulated)

    @property
    def chosen(self) -> Condition | None:
        """The condition that the experimenter chose for the next sitting; None for the list's."""
        return self._choice.condition if self._choice else None

    @property
    def is_followed(self) -> bool:
        """Whether the choice is that of the visitor who sits there, and not yet one for the visitor after."""
        return self._choice is not None and self._choice is self._followed

    def choose(self, condition: Condition | None, reason: str) -> None:
        """Have the next sitting in this condition, or, with None, in the list's; raises StoreFailed."""
        name = condition.value if condition else "automatic"
        self._recorder.note(Note.CONDITION_CHOSEN.value, {"condition": name, "reason": reason})
        self._choice = None if condition is None else _Choice(condition)

    def next_sitting(self, language: str) -> Provenance:
        """What the next sitting is to follow; raises StoreFailed."""
        self._followed = self._choice
        place = self._next_place() if self._listed and self._choice is None else None
        condition = self.chosen or (place.condition if place else self._origin.condition)
        return Provenance(
            self.study.plan(language, condition),
            self._origin.seed(),
            BodyName.AVATAR.value,
            self._origin.code_commit,
            simulated=self._origin.simulated,
            place=place,
            allotted=self._allotted(place),
        )

    def kept(self, sitting: Provenance) -> None:
        """Note that a sitting is on record: what was chosen for it does not hold for the one after."""
        if sitting.allotted is Allotted.OVERRIDE and self._choice is self._followed:
            self._choice = None

    def _next_place(self) -> Place | None:
        return self._recorder.next_place(simulated=self._origin.simulated)

    def _allotted(self, place: Place | None) -> Allotted | None:
        if self._choice is not None:
            return Allotted.OVERRIDE
        if not self._listed:
            return None
        return Allotted.BEYOND if place is None else Allotted.LIST
