"""One sitting: ``handle(event) -> commands``, and nothing else.

It validates, then changes; what it concluded stands first among its commands, to be written before anything is shown.
What a stage does is its scene's; here is what holds in every stage: which comes next, and whether anything is kept.
"""

from __future__ import annotations

from enum import Enum

from kiosk.study import commands as do
from kiosk.study import events as happened
from kiosk.study.after.measures import Measures, measure
from kiosk.study.commands import Command, Mood, Script
from kiosk.study.events import Event, Stage, Status, Timer, Unstored, WorldEvent
from kiosk.study.plan import Plan
from kiosk.study.presence import Presence
from kiosk.study.scenery import Scenery
from kiosk.study.stages import BEFORE_DECIDING, Turn, UnexpectedEvent, check_expected, turn
from kiosk.study.talk import Talk


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
        self._timing = plan.settings.timing
        self._closed_in: Stage | None = None
        self._log: list[Event] = []
        self._waiting: set[Timer] = set()
        self._scenery = Scenery(plan, seed, lambda script: [*self._log, *script.notes])
        self._presence = Presence(plan.settings.idle, self._reading_ms)
        self._talk = Talk(self._scenery.speaker)

    def handle(self, event: WorldEvent) -> tuple[Command, ...]:
        """What one event leads to: records first; raises UnexpectedEvent, and changes nothing, if it has no place."""
        self.check(event)
        script = Script(event.at_ms)
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

    def _reading_ms(self, stage: Stage) -> int:
        """How long it takes to read the longest page of a stage."""
        return self._timing.reading * self._scenery.of(stage).characters

    def check(self, event: WorldEvent) -> None:
        """Raise UnexpectedEvent if this event has no place now."""
        check_expected(self.stage, event)
        keepers = (self._presence, self._talk, self._scenery.of(self.stage))
        if not self._can_come(event) or not all(keeper.accepts(event) for keeper in keepers):
            raise UnexpectedEvent(self.stage, event)

    def _can_come(self, event: WorldEvent) -> bool:
        match event:
            case happened.TimerEnded(timer=timer):
                return timer in self._waiting
            case happened.SittingResumed():
                return self.keeping is Keeping.KEPT and self._cut_off_in not in (Stage.GAME, Stage.OVER)
        return True

    def _react(self, event: WorldEvent, script: Script) -> None:
        """What the event leads to within its stage."""
        self._presence.react(event, self.stage, script)
        self._talk.react(event, script)
        match event:
            case happened.TimerEnded(timer=timer):
                self._waiting.discard(timer)
            case happened.SittingResumed():
                self._resume(script)
            case happened.DeclineTapped():
                self._forget(Unstored.DECLINED, script)
            case happened.AgeTapped(adult=False):
                self._forget(Unstored.UNDER_AGE, script)
        self._scenery.of(self.stage).react(event, script)

    def _resume(self, script: Script) -> None:
        """Begin the stage anew in which the sitting was cut off."""
        self.stage = self._cut_off_in
        self._closed_in = None
        self._presence.go_on(script)
        self._leave_scene(script)
        self._enter(self.stage, script)

    @property
    def _cut_off_in(self) -> Stage:
        """Where the sitting would go on if it were resumed: a crash leaves it where it was, a closed kiosk ends it."""
        return self._closed_in or self.stage

    def _go_on_after(self, event: Event, script: Script) -> None:
        """Enter the next stage, if this event leads to one."""
        match turn(self.stage, event):
            case Turn.ON:
                after = self._course.after(self.stage, kept=self.keeping is not Keeping.FORGOTTEN)
                self._change_stage(after, Status.COMPLETED, script)
            case Turn.OVER:
                self._closed_in = self.stage if isinstance(event, happened.KioskClosed) else None
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
        self._presence.stop_asking(script)

    def _enter(self, stage: Stage, script: Script) -> None:
        script.note(happened.StageEntered(at_ms=script.at_ms, stage=stage))
        self._presence.wait(stage, script)
        script.do(do.Express(self._scenery.of(stage).mood))
        self._scenery.of(stage).enter(script)

    def _keep_from(self, stage: Stage, script: Script) -> None:
        """Whoever is past all that is decided beforehand has agreed to be recorded."""
        if self.keeping is Keeping.UNDECIDED and stage not in BEFORE_DECIDING:
            self.keeping = Keeping.KEPT
            script.do(do.KeepSitting())

    def _forget(self, why: Unstored, script: Script) -> None:
        if self.keeping is Keeping.UNDECIDED:
            self.keeping = Keeping.FORGOTTEN
            self._scenery.play_by_chance()
            script.do(do.ForgetSitting(why))

    def _end(self, status: Status, script: Script) -> None:
        self._forget(Unstored.LEFT, script)
        self._presence.go_on(script)
        script.note(happened.SittingEnded(at_ms=script.at_ms, status=status))
        script.do(do.Express(Mood.IDLE), do.EndSitting(status))

    def _keep_track(self, script: Script) -> None:
        """Remember which waits are running, so that the end of any other can be refused, and what is being said."""
        self._talk.keep_track(script.deeds)
        for command in script.deeds:
            match command:
                case do.StartTimer(timer=timer):
                    self._waiting.add(timer)
                case do.StopTimer(timer=timer):
                    self._waiting.discard(timer)


_ENDINGS = {
    happened.VisitorLeft: Status.ABANDONED,
    happened.EndAsked: Status.STOPPED,
    happened.KioskClosed: Status.INTERRUPTED,
}
