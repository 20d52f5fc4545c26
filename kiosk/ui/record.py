"""The record of one sitting: held back until the visitor has decided, then written before anything is shown."""

from __future__ import annotations

from collections.abc import Callable
from typing import Self

from kiosk.store.recorder import Provenance, Recorder
from kiosk.study import commands as do
from kiosk.study.commands import Command
from kiosk.study.events import Event, WorldEvent
from kiosk.study.session import Keeping


class Record:
    """What becomes of a sitting's events."""

    def __init__(self, recorder: Recorder, sitting: Provenance, kept: Callable[[], None] = lambda: None) -> None:
        """Nothing is written until a command says so; ``kept`` is told when it is."""
        self.code = ""
        """What the participant can withdraw with; empty while nothing is stored."""
        self._recorder = recorder
        self._sitting = sitting
        self._kept = kept
        self._keeping = Keeping.UNDECIDED
        self._held: list[Event] = []

    @classmethod
    def resumed(cls, recorder: Recorder, sitting: Provenance, number: int) -> Self:
        """The record of a stored sitting that goes on."""
        record = cls(recorder, sitting)
        record.code = recorder.resume(number).code
        record._keeping = Keeping.KEPT
        return record

    def write(self, event: WorldEvent, commands: tuple[Command, ...]) -> None:
        """Write, hold back or forget an event and what came of it; raises StoreFailed if the disk does not take it.

        Where it raises nothing has changed, so the same event can be written again after StoreBusy.
        """
        events = (event, *(command.event for command in commands if isinstance(command, do.Record)))
        forgotten = next((command for command in commands if isinstance(command, do.ForgetSitting)), None)
        if self._keeping is Keeping.KEPT:
            self._recorder.append(events)
        elif forgotten is not None:
            self._recorder.count_visit(forgotten.why, simulated=self._sitting.simulated)
            self._keeping = Keeping.FORGOTTEN
            self._held.clear()
        elif self._keeping is Keeping.UNDECIDED:
            held = [*self._held, *events]
            if any(isinstance(command, do.KeepSitting) for command in commands):
                self._keep(held)
            else:
                self._held = held

    def _keep(self, events: list[Event]) -> None:
        self.code = self._recorder.begin(self._sitting, events).code
        self._keeping = Keeping.KEPT
        self._held.clear()
        self._kept()
