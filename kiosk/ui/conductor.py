"""Between the study and the world: events in, commands out; first recorded, then shown, then spoken.

It decides nothing. A failure of the disk, or a fault of ours, puts a calm screen in front of the visitor. While another
program holds the database, what happened waits and is tried again by the clock, and what happens next waits behind it.
"""

from __future__ import annotations

import logging
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

from kiosk import StoreFailed
from kiosk.robot.bodies import Bodies
from kiosk.store.recorder import Provenance, Recorder, StoreBusy
from kiosk.study import commands as do
from kiosk.study import events as happened
from kiosk.study.commands import Command
from kiosk.study.events import Stage, Timer, WorldEvent
from kiosk.study.session import Session
from kiosk.study.stages import UnexpectedEvent
from kiosk.ui.clock import Clock, Wait
from kiosk.ui.desk import Desk
from kiosk.ui.performer import Performer
from kiosk.ui.record import Record
from kiosk.ui.screens.every import Screens
from kiosk.ui.sounds import Effect, effect
from kiosk.ui.waiting import BusyWait

PAUSE_MS = 8_000
"""How long the calm screen stays before the kiosk tries to go on."""

CLOSING_WAIT_MS = 2_000
"""How long closing waits for another program that holds the database; the supervisor waits five seconds."""

_log = logging.getLogger(__name__)

Witness = Callable[[WorldEvent, tuple[Command, ...], Stage], None]
"""Is told of every event once its commands were carried out, and of the stage that the sitting is in."""


@dataclass(frozen=True)
class _Queued:
    """What happened, and waits for its turn."""

    event: WorldEvent
    by_visitor: bool
    """Whether it answers what was on the screen then."""


class Conductor:
    """Runs one sitting after another; it is also the body's listener."""

    def __init__(self, screens: Screens, recorder: Recorder, clock: Clock, desk: Desk) -> None:
        """``desk`` is asked once for each sitting, when it begins."""
        self.witness: Witness | None = None
        self.play: Callable[[Effect], None] = lambda _: None
        self.begun: Callable[[], None] = lambda: None
        """Is told when a visitor has begun, or a sitting goes on."""
        self.rested: Callable[[], None] = lambda: None
        """Is told when no sitting is under way any more."""
        self.last_activity_ms: Callable[[], int | None] = lambda: None
        """When the visitor last did anything to the screen, on the clock; None if they never did."""
        self._idle_since = 0
        self._shut = False
        self._calm: Wait | None = None
        self._recorder = recorder
        self._clock = clock
        self._desk = desk
        self._performer = Performer(screens, clock, self._timer_ended)
        self._queue: deque[_Queued] = deque()
        self._unwritten: tuple[WorldEvent, tuple[Command, ...]] | None = None
        """What the session has concluded, and the database has not taken yet."""
        self._busy = BusyWait(clock, recorder.wait_ms, lambda waits: screens.kiosk.wait(waits=waits))
        self._working = self._screen_changed = False
        self._begun_at = 0
        self._session: Session | None = None
        self._record: Record | None = None
        screens.listen(self.start, self._tell_of_visitor)
        screens.kiosk.unsettled.connect(self._note_change)
        self._performer.reset("attract")

    @property
    def stage(self) -> Stage:
        """The stage of the sitting that is under way; attract if there is none."""
        return Stage.ATTRACT if self._session is None else self._session.stage

    @property
    def gives_way(self) -> bool:
        """Whether the calm screen is up, where nobody can begin."""
        return self._session is None and self._performer.screens.kiosk.shown == "pause"

    def accepts(self, kind: type[WorldEvent], **what: object) -> bool:
        """Whether this event has a place in the sitting now."""
        if self._session is None:
            return False
        try:
            self._session.check(kind(at_ms=self._clock.now_ms() - self._begun_at, **what))
        except UnexpectedEvent:
            return False
        return True

    def take(self, bodies: Bodies) -> None:
        """Let these bodies speak; bodies report to the conductor, so it is there before them."""
        self._performer.bodies = bodies

    def start(self, language: str) -> None:
        """A visitor begins, in this language; nothing happens while somebody else is at it."""
        if self._session is None and not self._busy.under_way and self._performer.screens.kiosk.shown == "attract":
            self._start(language, self._clock.now_ms())

    def _start(self, language: str, tapped_at: int) -> None:
        try:
            sitting = self._with_body(self._desk.next_sitting(language))
        except StoreBusy as busy:
            self._try_again(partial(self._start, language, tapped_at), busy)
            return
        except StoreFailed as failure:
            self._give_way(failure)
            return
        self._busy.end()
        record = Record(self._recorder, sitting, partial(self._desk.kept, sitting))
        self._begin(sitting, record, tapped_at)
        self._enqueue(happened.StartTapped(at_ms=0))
        self._tell_begun()

    def resume(
        self,
        sitting: Provenance,
        number: int,
        past: tuple[WorldEvent, ...],
        noted: Callable[[], bool] = lambda: True,
    ) -> None:
        """Go on with a sitting that was cut off after these events, from the start of the stage it was in.

        ``noted`` writes that down once it is known to be possible; if it says no, everything stays as it is. So it does
        where this raises: UnexpectedEvent if that stage cannot begin anew, BadInput or StoreFailed from the store.
        """
        session = Session(sitting.plan, sitting.seed)
        for event in past:
            session.handle(event)
        body = self._performer.body_name
        resumed = happened.SittingResumed(at_ms=past[-1].at_ms, body=body or happened.BodyName.AVATAR)
        session.check(resumed)
        record = Record.resumed(self._recorder, sitting, number)
        if not noted():
            return
        self._begin(sitting, record, self._clock.now_ms() - past[-1].at_ms, session)
        self.tell(happened.SittingResumed, body=resumed.body)
        self._tell_begun()

    def tell(self, kind: type[WorldEvent], **what: object) -> None:
        """Something happened just now; without a sitting it does not matter."""
        if self._session is not None:
            self._enqueue(kind(at_ms=self._clock.now_ms() - self._begun_at, **what))

    def _tell_of_visitor(self, kind: type[WorldEvent], **what: object) -> None:
        """The visitor did something to what is on the screen."""
        if self._session is not None:
            self._enqueue(kind(at_ms=self._clock.now_ms() - self._begun_at, **what), by_visitor=True)

    def _enqueue(self, event: WorldEvent, *, by_visitor: bool = False) -> None:
        self._queue.append(_Queued(event, by_visitor))
        # What happens while an event is at work, such as a voice that fails at once, waits for its turn.
        if not self._working and not self._busy.under_way:
            self._work()

    def _timer_ended(self, timer: Timer) -> None:
        last = self.last_activity_ms()
        if timer is Timer.IDLE and last is not None and last > self._idle_since:
            # Whoever scrolls, or goes about by keyboard, is there: the idle time counts from the last of it.
            self.tell(happened.UserActivity, ago_ms=self._clock.now_ms() - last)
        else:
            self.tell(happened.TimerEnded, timer=timer)

    def speech_started(self, utterance: int) -> None:
        """The body began to say a sentence."""
        self.tell(happened.SpeechStarted, utterance=utterance)

    def speech_finished(self, utterance: int) -> None:
        """The body has said a sentence."""
        self.tell(happened.SpeechFinished, utterance=utterance)

    def speech_failed(self, utterance: int, why: str) -> None:
        """The body will not say a sentence, or not to its end."""
        self.tell(happened.SpeechFailed, utterance=utterance, why=why)

    def robot_lost(self, why: str) -> None:
        """The robot that was helping cannot be counted on any more."""
        self.tell(happened.RobotLost, why=why)

    def close(self) -> None:
        """End the sitting that is under way, if there is one, because the program is being closed.

        Another program that holds the database is waited for now, because no loop runs that could try again. If that
        is in vain, the sitting counts as interrupted from the last thing that was written.
        """
        self._busy.end()
        with self._recorder.waiting(CLOSING_WAIT_MS):
            self.tell(happened.KioskClosed)
        if self._busy.under_way:
            _log.error("what happened last could not be written: another program holds the database")
            self._busy.end()

    def pause(self) -> None:
        """Something failed that the visitor can do nothing about: drop the sitting behind a calm screen, then go on."""
        self._rest("pause")
        self._stay_calm()

    def _stay_calm(self) -> None:
        if self._calm is not None:
            self._calm.cancel()
        self._calm = self._clock.after(PAUSE_MS, self.go_on)

    def go_on(self) -> None:
        """Leave the calm screen; nothing happens while a sitting is under way."""
        if self.gives_way:
            self._rest("attract")

    def shut(self, *, shut: bool) -> None:
        """Let nobody begin, or everybody again; a sitting that is under way goes on to its end."""
        self._shut = shut
        if self._session is None and shut is not self.gives_way:
            self._rest("attract")

    def _tell_begun(self) -> None:
        # There is no sitting any more if the disk did not take its first event.
        if self._session is not None:
            self.begun()

    def _begin(self, sitting: Provenance, record: Record, begun_at: int, session: Session | None = None) -> None:
        self._session = session or Session(sitting.plan, sitting.seed)
        self._record = record
        self._begun_at = begun_at
        self._performer.begin(sitting.plan)

    def _with_body(self, sitting: Provenance) -> Provenance:
        """The sitting with the body that it begins with, whichever was meant."""
        body = self._performer.body_name
        return sitting if body is None else replace(sitting, body=body.value)

    def _rest(self, screen: str) -> None:
        """Get ready for the next visitor, with nothing left of the last one, and show the screen of this name."""
        self._busy.end()
        self._queue.clear()
        self._session = self._record = self._unwritten = None
        self._performer.reset("pause" if self._shut else screen)
        self.rested()

    def _work(self) -> None:
        """Take what happened in turn, until nothing is left or the database cannot take it now."""
        self._working = True
        try:
            while self._session is not None and self._record is not None and self._decided(self._session):
                if not self._written(self._record):
                    return
                self._carry_out(self._session, self._record)
        finally:
            self._working = False

    def _decided(self, session: Session) -> bool:
        """Whether there is something to be written; what has no place in the sitting is passed over."""
        while self._unwritten is None and self._queue:
            event = self._queue.popleft().event
            try:
                self._unwritten = (event, session.handle(event))
            except UnexpectedEvent as refusal:
                _log.info("%s", refusal)
        return self._unwritten is not None

    def _written(self, record: Record) -> bool:
        """Write what was concluded; whether the database took it. Nothing of it is shown before."""
        if self._unwritten is None:
            return True
        try:
            record.write(*self._unwritten)
        except StoreBusy as busy:
            self._try_again(self._work, busy)
            return False
        except StoreFailed as failure:
            self._give_way(failure)
            return False
        self._busy.end()
        return True

    def _carry_out(self, session: Session, record: Record) -> None:
        if self._unwritten is None:
            return
        (event, commands), self._unwritten = self._unwritten, None
        self._screen_changed = False
        self._perform(commands, record)
        self._queue = deque(one for one in self._queue if not self._is_outrun(one, commands))
        if self.witness is not None:
            self.witness(event, commands, session.stage)
        if session.stage is Stage.OVER:
            self._rest("attract")

    def _is_outrun(self, queued: _Queued, commands: tuple[Command, ...]) -> bool:
        """Whether what waits belongs to what these commands have ended."""
        timers = {command.timer for command in commands if isinstance(command, (do.StartTimer, do.StopTimer))}
        match queued.event:
            case happened.TimerEnded(timer=timer):
                # It ended while the command to stop it, or to begin it anew, waited for the database.
                return timer in timers
            case happened.UserActivity():
                # It was to put off an idle time that has begun anew meanwhile.
                return Timer.IDLE in timers
        # As with a double click: what was tapped meanwhile was meant for what was there before.
        return queued.by_visitor and self._screen_changed

    def _note_change(self) -> None:
        self._screen_changed = True

    def _try_again(self, call: Callable[[], None], busy: StoreBusy) -> None:
        try:
            self._busy.try_again(call, busy)
        except StoreFailed as failure:
            self._give_way(failure)

    def _perform(self, commands: tuple[Command, ...], record: Record) -> None:
        self._performer.screens.debrief.give_code(record.code)
        for command in commands:
            if isinstance(command, do.StartTimer) and command.timer is Timer.IDLE:
                self._idle_since = self._clock.now_ms()
            self._performer.perform(command)
        sound = effect(commands)
        if sound is not None:
            self.play(sound)

    def _give_way(self, failure: StoreFailed) -> None:
        _log.error("%s", failure)
        self.pause()
