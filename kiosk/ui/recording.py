"""Store what happens in a session, while the screen is drawn and other programs use the database.

``SessionRecording`` decides what is written, ``DiskWriter`` writes on another thread, and ``BusyWait`` tries again
while the database is locked.
"""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from typing import Self

from kiosk import StorageError
from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.effects import Outcome
from kiosk.experiment.events import Event, WorldEvent
from kiosk.experiment.outcomes import RecordingState, Status
from kiosk.store.participants import Participant
from kiosk.store.recorder import Provenance, Recorder, StoreBusy
from kiosk.ui.event_loop import Clock, Executor, TimerWait
from kiosk.units import MS_PER_SECOND

RETRY_MS = 20
"""How long until the same is tried again."""
TOLD_AFTER_MS = 1_000
"""A longer wait is shown to the person in front of the screen."""
LONGEST_MS = 120_000
"""After so long the database counts as failed."""


class SessionRecording:
    """Writes the events of one session, holds them back until consent, or forgets them."""

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


class DiskWriter:
    """Has one write done at a time, beside the drawing of the screen, and says when it is over."""

    def __init__(self, executor: Executor) -> None:
        """Have the executor do the writes; it calls back on the interface's thread."""
        self._executor = executor
        self._under_way: Future[None] | None = None

    @property
    def is_under_way(self) -> bool:
        """Whether a write was begun whose end was not asked for."""
        return self._under_way is not None

    def begin(self, write: Callable[[], None], then: Callable[[], None]) -> None:
        """Begin a write; ``then`` is called when it is over, unless it was forgotten meanwhile."""
        begun = self._under_way = Future[None]()

        def run() -> None:
            try:
                write()
            except Exception as fault:  # noqa: BLE001 - whatever it is, ``end`` raises it
                begun.set_exception(fault)
            else:
                begun.set_result(None)

        def end(_: None) -> None:
            if self._under_way is begun:
                then()

        self._executor(run, end)

    def end(self) -> None:
        """End the write that is over; raises StorageError if the disk did not take it."""
        ended, self._under_way = self._under_way, None
        if ended is not None:
            ended.result()

    def forget(self) -> None:
        """Do not call back at the end of the write under way."""
        self._under_way = None


class BusyWait:
    """One wait for the database, from the first attempt that found it held to the one that did not."""

    def __init__(self, clock: Clock, recorder_waits_ms: int, show: Callable[[bool], None]) -> None:
        """Call ``show`` when the wait has become long, and again when a long wait is over.

        A recorder that waits by itself at each attempt is tried again at once, so that virtual time stands still.
        """
        self._clock = clock
        self._retry_ms = 0 if recorder_waits_ms else RETRY_MS
        self._step_ms = recorder_waits_ms or RETRY_MS
        self._show = show
        self._wait: TimerWait | None = None
        self._waited_ms = 0

    @property
    def under_way(self) -> bool:
        """Whether something is to be tried again."""
        return self._wait is not None

    def try_again(self, call: Callable[[], None], busy: StoreBusy) -> None:
        """Call back soon; raises StorageError, and ends the wait, once it has taken too long."""
        self._waited_ms += self._step_ms
        if self._waited_ms > LONGEST_MS:
            self.end()
            raise StorageError(f"{busy}; it was tried for {LONGEST_MS // MS_PER_SECOND} s") from busy
        if self._waited_ms >= TOLD_AFTER_MS:
            self._show(True)  # noqa: FBT003 - it is what is shown
        self._wait = self._clock.after(self._retry_ms, lambda: self._call(call))

    def end(self) -> None:
        """Wait no more: the database took it, or nothing is to be tried again."""
        if self._wait is not None:
            self._wait.cancel()
            self._wait = None
        if self._waited_ms >= TOLD_AFTER_MS:
            self._show(False)  # noqa: FBT003 - as above
        self._waited_ms = 0

    def _call(self, call: Callable[[], None]) -> None:
        self._wait = None
        call()
