"""Plays a stored sitting on the screens, at any speed, step by step, forwards and back. Nothing is written or said."""

from __future__ import annotations

from collections.abc import Callable

from kiosk.study import commands as do
from kiosk.study.after.replay import Step
from kiosk.study.plan import Plan
from kiosk.ui.clock import Clock, Wait
from kiosk.ui.performer import Performer

SLOWEST, FASTEST = 0.25, 32.0
HIDDEN_CODE = "· · ·"
"""Stands where the participant's code stood, which is nobody's business afterwards."""


class Player:
    """Knows how far the sitting has been played."""

    def __init__(self, performer: Performer, clock: Clock, plan: Plan, steps: tuple[Step, ...]) -> None:
        """Show what there was before the first step; ``changed`` is called whenever something is."""
        self.changed: Callable[[], None] = lambda: None
        self.steps = steps
        self.played = 0
        """How many steps have been played."""
        self.speed = 1.0
        self._performer = performer
        self._clock = clock
        self._plan = plan
        self._wait: Wait | None = None
        self._begin()

    @property
    def runs(self) -> bool:
        """Whether the next step comes by itself."""
        return self._wait is not None

    @property
    def last(self) -> Step | None:
        """The step that was played last."""
        return self.steps[self.played - 1] if self.played else None

    @property
    def over(self) -> bool:
        """Whether every step has been played."""
        return self.played == len(self.steps)

    def run(self) -> None:
        """Let the steps come as they came then, from here on."""
        if self.over:
            self.go_to(0)
        self._wait_for_next()
        self.changed()

    def pause(self) -> None:
        """Stay where it is."""
        self._stop_waiting()
        self.changed()

    def step(self) -> None:
        """Play the next step now, and stay there."""
        self._stop_waiting()
        if not self.over:
            self._play()
        self.changed()

    def go_to(self, played: int) -> None:
        """Have exactly so many steps played."""
        runs = self.runs
        self._stop_waiting()
        if played < self.played:
            self._begin()
        while self.played < min(played, len(self.steps)):
            self._play()
        if runs:
            self._wait_for_next()
        self.changed()

    def change_speed(self, factor: float) -> None:
        """Go so many times as fast as now."""
        self.speed = min(FASTEST, max(SLOWEST, self.speed * factor))
        if self.runs:
            self._stop_waiting()
            self._wait_for_next()
        self.changed()

    def _begin(self) -> None:
        self.played = 0
        self._performer.reset("attract")
        self._performer.begin(self._plan)
        self._performer.screens.debrief.give_code(HIDDEN_CODE)

    def _play(self) -> None:
        step = self.steps[self.played]
        self.played += 1
        for command in step.commands:
            # No wait ends here but those that ended then; they are among the steps.
            if not isinstance(command, do.StartTimer | do.StopTimer | do.EndSitting):
                self._performer.perform(command)

    def _wait_for_next(self) -> None:
        if self.over:
            return
        before = self.last.event.at_ms if self.last else 0
        ms = max(0, round((self.steps[self.played].event.at_ms - before) / self.speed))
        self._wait = self._clock.after(ms, self._next)

    def _next(self) -> None:
        self._wait = None
        self._play()
        self._wait_for_next()
        self.changed()

    def _stop_waiting(self) -> None:
        wait, self._wait = self._wait, None
        if wait is not None:
            wait.cancel()
