"""Run one session after another: record each event, then show and speak its effects."""

from __future__ import annotations

import logging
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from datetime import datetime
from functools import partial
from itertools import chain
from typing import TYPE_CHECKING, Any

from kiosk import StorageError
from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.effects import Outcome
from kiosk.experiment.events import Event, InputDevice, SessionSetup, Timer, WorldEvent
from kiosk.experiment.outcomes import EmbodimentName, Stage
from kiosk.experiment.transitions import InvalidTransition
from kiosk.lazy_dataclass import dataclass
from kiosk.robots.selector import EmbodimentSelector
from kiosk.store.participants import ReturningVisitor
from kiosk.store.recorder import Provenance, Recorder, StoreBusy
from kiosk.ui.condition_assigner import ConditionAssigner
from kiosk.ui.event_loop import Clock, TimerWait
from kiosk.ui.recording import BusyWait, DiskWriter, SessionRecording
from kiosk.ui.renderer import Renderer, SoundEffect, sound_for
from kiosk.ui.returning import ReturnDesk
from kiosk.ui.screens.registry import ScreenSet

if TYPE_CHECKING:
    from kiosk.experiment.session import Session

ERROR_SCREEN_MS = 8_000
"""How long the error screen stays before the kiosk tries to go on."""

CLOSING_WAIT_MS = 2_000
"""How long closing waits for another program that holds the database; the supervisor waits five seconds."""

_log = logging.getLogger(__name__)

EventObserver = Callable[[WorldEvent, Outcome, Stage], None]
"""Called after the effects of an event were carried out, with the stage that the session is in then."""


@dataclass(frozen=True)
class _Handled:
    """An event and its outcome, which the database has not taken yet."""

    event: WorldEvent
    outcome: Outcome


@dataclass(frozen=True)
class _Showing:
    """The effects of a recorded event, which are carried out in steps of the event loop."""

    handled: _Handled
    steps: Iterator[None]


class SessionRunner:
    """Runs one session after another; it is also the body's listener."""

    def __init__(self, screens: ScreenSet, recorder: Recorder, clock: Clock, assigner: ConditionAssigner) -> None:
        """Ask ``assigner`` once for each provenance, when it begins."""
        self.on_event: EventObserver | None = None
        self.on_recorded: Callable[[str, Iterable[Event]], None] = lambda _participant, _events: None
        """Called with a participant and the events that the database has just taken; never without consent."""
        self.play_sound: Callable[[SoundEffect], None] = lambda _: None
        self.spoken_by: Callable[[], Mapping[str, Any]] = dict
        self.on_session_started: Callable[[], None] = lambda: None
        """Called when a visitor has begun, or a session goes on."""
        self.on_idle: Callable[[], None] = lambda: None
        """Called when no session is under way any more."""
        self.last_activity_ms: Callable[[], int | None] = lambda: None
        """When the visitor last did anything to the screen, on the clock; None if they never did."""
        self.last_device: Callable[[], InputDevice | None] = lambda: None
        """What the visitor used last; None if that is not known."""
        self.take_trace: Callable[[], tuple[tuple[int, float, float], ...]] = tuple
        """Gives the way of the pointer since it was asked last."""
        self.describe_setup: Callable[[], SessionSetup | None] = lambda: None
        """Tells with what a session begins; ``local_time`` adds when."""
        self.local_time: Callable[[], datetime | None] = lambda: None
        """What the clock on the wall shows, with its zone; None if time is not that of a clock."""
        self._waiting_since: dict[Timer, int] = {Timer.IDLE: 0}
        """When each wait began that any activity of the visitor puts off."""
        self._shut = self._on_break = False
        self._closes = False
        """Whether no event loop runs any more that could go on with anything."""
        self._error_screen_wait: TimerWait | None = None
        self._recorder = recorder
        self._clock = clock
        self._assigner = assigner
        self._renderer = Renderer(screens, clock, self._timer_expired)
        self.returns = ReturnDesk(recorder, screens.returning, screens.kiosk)
        self.returns.on_found = self._come_back
        self.returns.on_failure = self._give_way
        self._queue: deque[WorldEvent] = deque()
        self._unwritten: _Handled | None = None
        self._showing: _Showing | None = None
        self.later: Callable[[Callable[[], None]], object] = lambda call: call()
        """Has something done in a further step of the event loop, where there is one."""
        self.writer: DiskWriter | None = None
        """Writes beside the interface; without one the interface waits for the disk."""
        self._busy = BusyWait(clock, recorder.wait_ms, lambda waits: screens.kiosk.wait(waits=waits))
        self._working = self._screen_changed = False
        self._begun_at = 0
        self._session: Session | None = None
        self._record: SessionRecording | None = None
        screens.connect_input(self)
        screens.kiosk.screen_changed.connect(self._note_change)
        self._renderer.reset("attract")

    @property
    def stage(self) -> Stage:
        """The stage of the session that is under way; attract if there is none."""
        return Stage.ATTRACT if self._session is None else self._session.stage

    @property
    def is_blocked(self) -> bool:
        """Whether the error screen is up, where no session can begin."""
        return self._session is None and self._renderer.screens.kiosk.shown == "pause"

    def accepts(self, event: WorldEvent) -> bool:
        """Whether this event has a place in the session now."""
        if self._session is None:
            return False
        try:
            self._session.check(event)
        except InvalidTransition:
            return False
        return True

    def set_embodiments(self, embodiments: EmbodimentSelector) -> None:
        """Let these embodiments speak; embodiments report to the runner, so it is there before them."""
        self._renderer.embodiments = embodiments

    def start(self, language: str) -> None:
        """Begin a session in this language; during another one, do nothing."""
        if self._session is None and not self._busy.under_way and self._renderer.screens.kiosk.shown == "attract":
            self._start(language, self._clock.now_ms())

    def _start(self, language: str, tapped_at: int, returning: ReturningVisitor | None = None) -> None:
        try:
            provenance = self._with_body(self._assigner.next_session(language, returning))
            setup = self._setup()
        except StorageError as failure:
            self._put_off(partial(self._start, language, tapped_at, returning), failure)
            return
        self._busy.end()
        record = SessionRecording(self._recorder, provenance, partial(self._assigner.confirm_recorded, provenance))
        self._begin(provenance, record, tapped_at)
        chosen = tuple(self._renderer.screens.kiosk.choices(at_ms=0))
        self.dispatch(happened.SessionStarted(at_ms=0, setup=setup))
        for choice in chosen:
            self.dispatch(choice)
        if returning is None:
            self._tell_begun()

    def _come_back(self, visitor: ReturningVisitor) -> None:
        """Begin anew, as a session of this participant; nothing is recorded yet, so nothing is lost."""
        if self._session is None or self._session.stage is not Stage.ABOUT:
            return
        self._queue.clear()
        self._start(self._renderer.screens.kiosk.spoken_language, self._clock.now_ms(), visitor)
        if self._session is not None:
            self._renderer.screens.kiosk.ask("welcome")

    def _setup(self) -> SessionSetup | None:
        """Return what a session begins with, and when in the day; raises StorageError."""
        setup, now = self.describe_setup(), self.local_time()
        if setup is None or now is None:
            return setup
        midnight = now.replace(hour=0, minute=0, second=0, microsecond=0)
        before = self._recorder.count_sessions_since(midnight, kind=self._assigner.kind)
        return replace(setup, hour_band=now.hour // happened.HOURS_IN_A_BAND, visitors_before=before)

    def resume(
        self,
        provenance: Provenance,
        number: int,
        past: tuple[WorldEvent, ...],
        noted: Callable[[], bool] = lambda: True,
    ) -> None:
        """Go on with a session that was cut off after these events, from the start of its stage.

        ``noted`` writes that down once it is known to be possible; if it says no, everything stays as it is. So it does
        where this raises: InvalidTransition if that stage cannot begin anew, UserInputError or StorageError from the
        store.
        """
        session = _new_session(provenance)
        for event in past:
            session.handle(event)
        body = self._renderer.body_name
        resumed = happened.SessionResumed(at_ms=past[-1].at_ms, embodiment=body or EmbodimentName.AVATAR)
        session.check(resumed)
        record = SessionRecording.resumed(self._recorder, provenance, number)
        if not noted():
            return
        self._begin(provenance, record, self._clock.now_ms() - past[-1].at_ms, session)
        self.dispatch(replace(resumed, at_ms=self.now_ms()))
        self._tell_begun()

    def input_device(self) -> InputDevice | None:
        """Return what the visitor used last; None if that is not known."""
        return self.last_device()

    def pointer_trace(self) -> tuple[tuple[int, float, float], ...]:
        """Return the way of the pointer since the last tap; nothing where it may not be recorded."""
        return self.take_trace() if self._session is not None and self._session.traces_pointer else ()

    def now_ms(self) -> int:
        """Return the time of an event that happens now, in ms since the session began."""
        return self._clock.now_ms() - self._begun_at

    def dispatch(self, event: WorldEvent) -> None:
        """Handle an event after those that wait; without a session it does not matter."""
        if self._session is None:
            return
        self._queue.append(event)
        # What happens while an event is at work, such as a voice that fails at once, waits for its turn.
        if not self._working and not self._is_held_up:
            self._work()

    @property
    def _is_held_up(self) -> bool:
        """Whether what happened last waits for the database, or for its next step of the event loop."""
        writes = self.writer is not None and self.writer.is_under_way
        return writes or self._busy.under_way or self._showing is not None

    def _timer_expired(self, timer: Timer) -> None:
        last, since = self.last_activity_ms(), self._waiting_since.get(timer)
        if since is not None and last is not None and last > since:
            # Scrolling and moving show that the visitor is there, and busy: both waits count from the last of it.
            self.dispatch(happened.UserActivity(at_ms=self.now_ms(), ago_ms=self._clock.now_ms() - last))
        else:
            self.dispatch(happened.TimerExpired(at_ms=self.now_ms(), timer=timer))

    def speech_started(self, utterance: int) -> None:
        """Have the session know that a sentence is heard."""
        self.dispatch(happened.SpeechStarted(at_ms=self.now_ms(), utterance=utterance, **self.spoken_by()))

    def speech_finished(self, utterance: int) -> None:
        """Have the session know that a sentence was said to its end."""
        self.dispatch(happened.SpeechFinished(at_ms=self.now_ms(), utterance=utterance))

    def speech_failed(self, utterance: int, why: str) -> None:
        """Have the session know that a sentence will not be said, or not to its end."""
        self.dispatch(happened.SpeechFailed(at_ms=self.now_ms(), utterance=utterance, why=why))

    def robot_lost(self, why: str) -> None:
        """Have the session know that the robot that was helping cannot be counted on any more."""
        self.dispatch(happened.RobotDisconnected(at_ms=self.now_ms(), why=why))

    def close(self) -> None:
        """End the session that is under way, if there is one, because the program is being closed.

        Another program that holds the database is waited for now, because no loop runs that could try again. If that
        is in vain, the session counts as interrupted from the last thing that was written.
        """
        self._busy.end()
        self._closes = True
        with self._recorder.retrying(CLOSING_WAIT_MS):
            if self._is_held_up:
                self._work()
                self._busy.end()
            self.writer = None
            self.dispatch(happened.ApplicationClosed(at_ms=self.now_ms()))
        if self._busy.under_way:
            _log.error("what happened last could not be written: another program holds the database")
            self._busy.end()

    def pause(self) -> None:
        """Drop the session behind the error screen after a failure, then go on."""
        self._rest("pause")
        self._keep_error_screen()

    def _keep_error_screen(self) -> None:
        if self._error_screen_wait is not None:
            self._error_screen_wait.cancel()
        self._error_screen_wait = self._clock.after(ERROR_SCREEN_MS, self.go_on)

    def go_on(self) -> None:
        """Leave the error screen; nothing happens while a session is under way."""
        if self.is_blocked:
            self._rest("attract")

    def set_closed(self, *, shut: bool) -> None:
        """Close the kiosk to new sessions, or open it again; a session under way goes on to its end."""
        self._shut = shut
        if self._session is None and shut is not self.is_blocked:
            self._rest("attract")

    @property
    def is_on_break(self) -> bool:
        """Whether the kiosk takes no visitor until the experimenter is back."""
        return self._on_break

    def set_break(self, *, taken: bool) -> None:
        """Take no visitor while the experimenter is away, or take them again; a session under way goes on."""
        self._on_break = taken
        if self._session is None:
            self._rest("attract")

    def _tell_begun(self) -> None:
        # There is no session any more if the disk did not take its first event.
        if self._session is not None:
            self.on_session_started()

    def _begin(
        self, provenance: Provenance, record: SessionRecording, begun_at: int, session: Session | None = None
    ) -> None:
        self._session = session or _new_session(provenance)
        self._record = record
        self._showing = None
        self._begun_at = begun_at
        self._renderer.begin(provenance.plan)
        offered = provenance.plan.settings.returning.enabled and provenance.plan.visit == 1
        self.returns.begin(provenance.kind, offered=offered)

    def _with_body(self, provenance: Provenance) -> Provenance:
        """Return the session with the body that it begins with, whichever was meant."""
        body = self._renderer.body_name
        return provenance if body is None else replace(provenance, embodiment=str(body))

    def _rest(self, screen: str) -> None:
        """Get ready for the next visitor, with nothing left of the last one, and show the screen of this name."""
        self._busy.end()
        if self.writer is not None:
            self.writer.forget()
        self._queue.clear()
        self._session = self._record = self._unwritten = self._showing = None
        self.returns.end()
        self._renderer.reset("pause" if self._shut or self._on_break else screen)
        self.on_idle()

    def _work(self) -> None:  # noqa: C901 - one branch for each way in which it goes on later
        """Handle, write and show what happened, in turn, until nothing is left or it is to wait."""
        self._working = True
        try:
            while self._session is not None and self._record is not None and self._has_more:
                session, record = self._session, self._record
                # Taken out: where an effect fails, the session goes on without those after it.
                showing, self._showing = self._showing, None
                if showing is None:
                    if self._unwritten is None:
                        event = self._queue.popleft()
                        try:
                            self._unwritten = _Handled(event, session.handle(event))
                        except InvalidTransition as refusal:
                            _log.info("%s", refusal)
                            continue
                    handled = self._unwritten
                    try:
                        if self.writer is not None and self.writer.is_under_way:
                            self.writer.end()
                        elif self._is_written_beside(handled, record):
                            return
                        else:
                            record.write(handled.event, handled.outcome)
                    except StorageError as failure:
                        self._put_off(self._work, failure)
                        return
                    showing = self._begin_to_show(handled, session, record)
                for _ in showing.steps:
                    if not self._closes:
                        self._showing = showing
                        self.later(self._work)
                        return
                self._after_effects(showing.handled, session.stage)
        finally:
            self._working = False

    @property
    def _has_more(self) -> bool:
        """Whether something is to be shown, written or handled."""
        return self._showing is not None or self._unwritten is not None or bool(self._queue)

    def _is_written_beside(self, handled: _Handled, record: SessionRecording) -> bool:
        """Begin to write an event beside the interface, if that is possible; returns whether it is."""
        if self.writer is None or self._closes or not record.reaches_disk(handled.outcome):
            return False
        self.writer.begin(partial(record.write, handled.event, handled.outcome), self._work)
        return True

    def _begin_to_show(self, handled: _Handled, session: Session, record: SessionRecording) -> _Showing:
        """Tell everything around the session that its event was taken; its effects come next."""
        self._busy.end()
        self._unwritten = None
        record.confirm()
        if record.is_kept:
            self.on_recorded(record.participant, (handled.event, *handled.outcome.events))
        is_new = record.code != self._renderer.screens.debrief.shown_code
        self._before_effects(handled.outcome, record.code, returns=session.may_return)
        self._renderer.screens.kiosk.reach(session.stage.value)
        steps = self._renderer.steps(handled.outcome.effects)
        # To draw a visitor's code is a step of its own, and so is to begin a session.
        apart = is_new or isinstance(handled.event, happened.SessionStarted)
        return _Showing(handled, chain((None,), steps) if apart else steps)

    def _before_effects(self, outcome: Outcome, code: str, *, returns: bool) -> None:
        self._screen_changed = False
        started = _timers(outcome)
        for timer in (Timer.IDLE, Timer.HESITATION):
            if started.get(timer):
                self._waiting_since[timer] = self._clock.now_ms()
        self._renderer.screens.debrief.give_code(code, returns=returns)
        self._renderer.screens.kiosk.give_code(code)

    def _after_effects(self, handled: _Handled, stage: Stage) -> None:
        event, outcome = handled.event, handled.outcome
        sound = sound_for(outcome.effects)
        if sound is not None:
            self.play_sound(sound)
        self._queue = deque(waiting for waiting in self._queue if not self._is_outrun(waiting, outcome))
        if self.on_event is not None:
            self.on_event(event, outcome, stage)
        if stage is Stage.OVER:
            self._end()

    def _end(self) -> None:
        """Get ready for the next visitor page by page, so that no step holds the interface long."""
        self._clear(self._session, self._renderer.screens.clear_unseen())

    def _clear(self, session: Session | None, pages: Iterator[None]) -> None:
        if self._session is not session:
            return
        for _ in pages:
            self.later(partial(self._clear, session, pages))
            return
        self._rest("attract")

    def _is_outrun(self, waiting: WorldEvent, outcome: Outcome) -> bool:
        """Whether what waits belongs to what this outcome has ended."""
        match waiting:
            case happened.TimerExpired(timer=timer):
                # It ended while the effect that stops it, or starts it anew, waited for the database.
                return timer in _timers(outcome)
            case happened.UserActivity():
                # It was to put off an idle time that has begun anew meanwhile.
                return Timer.IDLE in _timers(outcome)
        # As with a double click: what was tapped meanwhile was meant for what was there before.
        return waiting.by_visitor and self._screen_changed

    def _note_change(self) -> None:
        self._screen_changed = True

    def _put_off(self, call: Callable[[], None], failure: StorageError) -> None:
        """Call again soon where the database is only busy; give way to any other failure, and after a long wait."""
        if not isinstance(failure, StoreBusy):
            self._give_way(failure)
            return
        try:
            self._busy.try_again(call, failure)
        except StorageError as lasting:
            self._give_way(lasting)

    def _give_way(self, failure: StorageError) -> None:
        _log.error("%s", failure)
        self.pause()


def _new_session(provenance: Provenance) -> Session:
    from kiosk.experiment.session import Session  # noqa: PLC0415 - the start screen does without

    return Session(provenance.plan, provenance.seed)


def _timers(outcome: Outcome) -> dict[Timer, bool]:
    """Return the timers that an outcome starts (True) or stops (False)."""
    return {
        effect.timer: isinstance(effect, do.StartTimer)
        for effect in outcome.effects
        if isinstance(effect, do.StartTimer | do.StopTimer)
    }
