"""One sitting: ``handle(event) -> commands``, and nothing else.

It validates, then changes; what it concluded stands first among its commands, to be written before anything is shown.
What a stage does is its scene's; here is what holds in every stage: which comes next, whether anything is kept, who
is there, and who speaks.
"""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum

from kiosk.study import commands as do
from kiosk.study import events as happened
from kiosk.study.after.measures import Measures, measure
from kiosk.study.commands import Command, Mood, Script
from kiosk.study.events import BodyName, Event, Stage, Status, Timer, Unstored, WorldEvent
from kiosk.study.plan import Plan
from kiosk.study.scenery import Scenery
from kiosk.study.stages import BEFORE_DECIDING, Turn, UnexpectedEvent, check_expected, turn


class Keeping(Enum):
    """Whether the sitting is written down."""

    UNDECIDED = "undecided"
    """What happens is held back until the visitor has decided."""
    KEPT = "kept"
    FORGOTTEN = "forgotten"


class Session:
    """One sitting, from the visitor's first tap to its end."""

    def __init__(self, plan: Plan, seed: int) -> None:
        """Follow ``plan``; the same seed and the same events give the same commands.

        Raises BadInput if a deck has too few cards for its board, or the stages cannot come in their order.
        """
        self.stage = Stage.ATTRACT
        self.keeping = Keeping.UNDECIDED
        self._course = plan.course
        self._settings = plan.settings
        self._log: list[Event] = []
        self._waiting: set[Timer] = set()
        self._asked_still_there = self._robot_lost = self._paused = False
        self._said: do.Speak | None = None
        self._unsaid: do.Speak | None = None
        self._scenery = Scenery(plan, seed, lambda script: [*self._log, *script.notes])

    def handle(self, event: WorldEvent) -> tuple[Command, ...]:
        """What one event leads to: records first; raises UnexpectedEvent, and changes nothing, if it has no place."""
        self._check(event)
        script = Script(event.at_ms)
        self._notice_presence(event, script)
        self._react(event, script)
        for step in (event, *script.notes):
            self._go_on_after(step, script)
        self._log += [event, *script.notes]
        self._keep_track(script)
        return script.commands

    @property
    def measures(self) -> Measures:
        """The measures of the game so far."""
        return measure(self._log)

    def _check(self, event: WorldEvent) -> None:
        check_expected(self.stage, event)
        if not self._makes_sense(event) or not self._scenery.of(self.stage).accepts(event):
            raise UnexpectedEvent(self.stage, event)

    def _makes_sense(self, event: WorldEvent) -> bool:
        """Whether this event can happen now, whatever the stage."""
        if self._paused and event.by_visitor:
            return False
        match event:
            case happened.TimerEnded(timer=timer):
                return timer in self._waiting
            case happened.StillHereTapped():
                return self._asked_still_there
            case happened.RobotLost():
                return not self._robot_lost
            case happened.PauseAsked():
                return not self._paused
            case happened.PauseEnded():
                return self._paused
            case happened.RepeatAsked():
                return self._said is not None and self._unsaid is None
            case happened.SittingResumed():
                return self.keeping is Keeping.KEPT and self.stage is not Stage.GAME
        return True

    def _react(self, event: WorldEvent, script: Script) -> None:
        """What the event leads to within its stage."""
        self._waiting -= {event.timer} if isinstance(event, happened.TimerEnded) else set()
        match event:
            case happened.TimerEnded(timer=Timer.IDLE):
                self._asked_still_there = True
                script.do(do.AskStillThere(), do.StartTimer(Timer.STILL_THERE, self._settings.idle.still_there))
            case happened.TimerEnded(timer=Timer.STILL_THERE):
                script.note(happened.VisitorLeft(at_ms=script.at_ms))
            case happened.RobotLost(why=why):
                self._go_on_without_robot(why, script)
            case happened.PauseAsked() | happened.PauseEnded():
                self._pause(event, script)
            case happened.RepeatAsked() if self._said is not None:
                self._scenery.speaker.repeat(self._said, script)
            case happened.SittingResumed():
                self._robot_lost = self._paused = False
                self._leave_scene(script)
                self._enter(self.stage, script)
            case happened.DeclineTapped():
                self._forget(Unstored.DECLINED, script)
            case happened.AgeTapped(adult=False):
                self._forget(Unstored.UNDER_AGE, script)
            case happened.SpeechFinished(utterance=utterance) | happened.SpeechFailed(utterance=utterance):
                self._hear_no_more_of(utterance)
        self._scenery.of(self.stage).react(event, script)

    def _hear_no_more_of(self, utterance: int) -> None:
        if self._unsaid is not None and self._unsaid.utterance == utterance:
            self._unsaid = None

    def _go_on_without_robot(self, why: str, script: Script) -> None:
        """Have the avatar help; it says at once what the robot had not said to its end."""
        self._robot_lost = True
        script.note(happened.BodyChanged(at_ms=script.at_ms, body=BodyName.AVATAR, why=why))
        script.do(do.ChangeBody(BodyName.AVATAR))
        if self._unsaid is not None:
            script.do(self._unsaid)

    def _pause(self, event: WorldEvent, script: Script) -> None:
        """Cover everything, and ask nobody whether they are there; or go on."""
        self._paused = isinstance(event, happened.PauseAsked)
        if self._paused:
            self._stop_asking(script)
            script.do(do.StopTimer(Timer.IDLE), do.ShowPause())
        else:
            script.do(do.HidePause())
            self._start_idle(self.stage, script)

    def _notice_presence(self, event: WorldEvent, script: Script) -> None:
        """Start the idle time anew whenever somebody shows that they are there."""
        if event.by_visitor:
            self._stop_asking(script)
            if self.stage is not Stage.ATTRACT:
                self._start_idle(self.stage, script)

    def _stop_asking(self, script: Script) -> None:
        """Ask no longer whether somebody is there."""
        if self._asked_still_there:
            self._asked_still_there = False
            script.do(do.HideStillThere(), do.StopTimer(Timer.STILL_THERE))

    def _start_idle(self, stage: Stage, script: Script) -> None:
        if not self._paused:
            script.do(do.StartTimer(Timer.IDLE, self._settings.idle.of(stage.value)))

    def _go_on_after(self, event: Event, script: Script) -> None:
        """Enter the next stage, if this event leads to one."""
        match turn(self.stage, event):
            case Turn.ON:
                after = self._course.after(self.stage, kept=self.keeping is not Keeping.FORGOTTEN)
                self._change_stage(after, Status.COMPLETED, script)
            case Turn.OVER:
                self._change_stage(Stage.OVER, _ENDINGS[type(event)], script)

    def _change_stage(self, stage: Stage, ending: Status, script: Script) -> None:
        self._leave_scene(script)
        self.stage = stage
        if stage is Stage.OVER:
            script.note(happened.StageEntered(at_ms=script.at_ms, stage=stage))
            self._end(ending, script)
        else:
            self._keep_from(stage, script)
            self._enter(stage, script)

    def _leave_scene(self, script: Script) -> None:
        """Stop all that belongs to the stage: its waits, its words, and the question over it."""
        running = {*self._waiting, *(c.timer for c in script.deeds if isinstance(c, do.StartTimer))}
        script.do(do.StopSpeaking(), do.ClearBubble())
        script.do(*(do.StopTimer(timer) for timer in Timer if timer in running))
        self._stop_asking(script)

    def _enter(self, stage: Stage, script: Script) -> None:
        script.note(happened.StageEntered(at_ms=script.at_ms, stage=stage))
        self._start_idle(stage, script)
        self._scenery.of(stage).enter(script)

    def _keep_from(self, stage: Stage, script: Script) -> None:
        """Whoever is past all that is decided beforehand has agreed to be recorded."""
        if self.keeping is Keeping.UNDECIDED and stage not in BEFORE_DECIDING:
            self.keeping = Keeping.KEPT
            script.do(do.KeepSitting())

    def _forget(self, why: Unstored, script: Script) -> None:
        if self.keeping is Keeping.UNDECIDED:
            self.keeping = Keeping.FORGOTTEN
            script.do(do.ForgetSitting(why))

    def _end(self, status: Status, script: Script) -> None:
        self._forget(Unstored.LEFT, script)
        script.note(happened.SittingEnded(at_ms=script.at_ms, status=status))
        script.do(do.Express(Mood.IDLE), do.EndSitting(status))

    def _keep_track(self, script: Script) -> None:
        """Remember which waits are running, so that the end of any other can be refused, and what is being said."""
        for command in script.deeds:
            match command:
                case do.StartTimer(timer=timer):
                    self._waiting.add(timer)
                case do.StopTimer(timer=timer):
                    self._waiting.discard(timer)
                case do.Speak():
                    self._said = self._unsaid = command
                case do.StopSpeaking():
                    self._unsaid = None
                case do.ClearBubble():
                    self._said = None


_ENDINGS = {
    happened.VisitorLeft: Status.ABANDONED,
    happened.EndAsked: Status.STOPPED,
    happened.KioskClosed: Status.INTERRUPTED,
}
