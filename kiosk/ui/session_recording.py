"""Write the events of one session, hold them back until consent, or forget them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Self

from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.effects import Outcome
from kiosk.experiment.events import Event, WorldEvent
from kiosk.experiment.outcomes import RecordingState, Status
from kiosk.store.participants import Participant
from kiosk.store.recorder import Provenance, Recorder


class SessionRecording:
    """What becomes of a session's events."""

    def __init__(self, recorder: Recorder, provenance: Provenance, kept: Callable[[], None] = lambda: None) -> None:
        """Nothing is written until an outcome says so; ``confirm`` calls ``kept`` once it is."""
        self.code = ""
        """What the participant can withdraw with; empty while nothing is stored."""
        self.participant = ""
        """The participant's number with its site, as lists show it; empty while nothing is stored."""
        self._recorder = recorder
        self._provenance = provenance
        self._kept = kept
        self._keeping = RecordingState.UNDECIDED
        self._confirmed = False
        self._held: list[Event] = []

    @classmethod
    def resumed(cls, recorder: Recorder, provenance: Provenance, number: int) -> Self:
        """Return the record of a stored session that goes on."""
        record = cls(recorder, provenance)
        record._name(recorder.resume(number))
        record._keeping = RecordingState.KEPT
        record._confirmed = True
        return record

    @property
    def is_kept(self) -> bool:
        """Whether events are stored."""
        return self._keeping is RecordingState.KEPT

    def reaches_disk(self, outcome: Outcome) -> bool:
        """Whether the disk is written to for an outcome."""
        return self.is_kept or outcome.recording is not None

    def confirm(self) -> None:
        """Tell once, on the caller's thread, that the session is on record."""
        if self.is_kept and not self._confirmed:
            self._confirmed = True
            self._kept()

    def write(self, event: WorldEvent, outcome: Outcome) -> None:
        """Write, hold back or forget an event and what came of it.

        Raises StorageError if the disk does not take it.

        Where it raises nothing has changed, so the same event can be written again after StoreBusy.
        """
        events = (event, *outcome.events)
        match outcome.recording:
            case do.StartRecording():
                self._keep([*self._held, *events])
            case do.DiscardRecording(why=why):
                self._recorder.count_visit(why, kind=self._provenance.kind)
                self._keeping = RecordingState.FORGOTTEN
                self._held.clear()
            case None if self._keeping is RecordingState.KEPT and self._is_deleted_by(outcome):
                self._recorder.append_and_withdraw(events)
                self._keeping = RecordingState.FORGOTTEN
            case None if self._keeping is RecordingState.KEPT:
                self._recorder.append(events)
            case None if self._keeping is RecordingState.UNDECIDED:
                self._held += events

    def _name(self, participant: Participant) -> None:
        self.code, self.participant = participant.code, participant.name

    def _is_deleted_by(self, outcome: Outcome) -> bool:
        """Whether the visitor has stopped, and the study deletes what it has of those who do."""
        if self._provenance.plan.settings.consent.on_withdrawal == "keep":
            return False
        ends = (event.status for event in outcome.events if isinstance(event, happened.SessionEnded))
        return any(status is Status.WITHDRAWN for status in ends)

    def _keep(self, events: list[Event]) -> None:
        self._name(self._recorder.begin(self._provenance, events))
        self._keeping = RecordingState.KEPT
        self._held.clear()
