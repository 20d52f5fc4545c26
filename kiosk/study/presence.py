"""Who is there: the idle time of each stage, the question "still there?", and the experimenter's pause."""

from __future__ import annotations

from collections.abc import Callable

from kiosk.settings import Idle
from kiosk.study import commands as do
from kiosk.study import events as happened
from kiosk.study.commands import Script
from kiosk.study.events import Stage, Timer, WorldEvent


class Presence:
    """Knows whether somebody was asked if they are still there, and whether the sitting is paused."""

    def __init__(self, idle: Idle, reading_ms: Callable[[Stage], int] = lambda _: 0) -> None:
        """Ask after these times, or once a stage's text can have been read, if that takes longer."""
        self._idle = idle
        self._reading_ms = reading_ms
        self._asked = self._paused = False

    def accepts(self, event: WorldEvent) -> bool:
        """Whether this event can happen now: while the sitting is paused, a visitor can do nothing."""
        match event:
            case happened.StillHereTapped():
                return self._asked
            case happened.UserActivity(ago_ms=ago_ms) if ago_ms < 0:
                return False
            case happened.PauseAsked():
                return not self._paused
            case happened.PauseEnded():
                return self._paused
        return not (self._paused and event.by_visitor)

    def react(self, event: WorldEvent, stage: Stage, script: Script) -> None:
        """Ask, give up, pause, or start the idle time anew whenever somebody shows that they are there."""
        match event:
            case happened.TimerEnded(timer=Timer.IDLE):
                self._asked = True
                script.do(do.AskStillThere(), do.StartTimer(Timer.STILL_THERE, self._idle.still_there))
            case happened.TimerEnded(timer=Timer.STILL_THERE | Timer.PAUSE):
                script.note(happened.VisitorLeft(at_ms=script.at_ms))
            case happened.PauseAsked():
                self._paused = True
                self.stop_asking(script)
                script.do(do.StopTimer(Timer.IDLE), do.ShowPause())
                self.wait(stage, script)
            case happened.PauseEnded():
                self._paused = False
                script.do(do.HidePause(), do.StopTimer(Timer.PAUSE))
                self.wait(stage, script)
            case happened.UserActivity(ago_ms=ago_ms):
                self.stop_asking(script)
                self.wait(stage, script, ago_ms)
            case _ if event.by_visitor and stage is not Stage.ATTRACT:
                self.stop_asking(script)
                self.wait(stage, script)

    def wait(self, stage: Stage, script: Script, ago_ms: int = 0) -> None:
        """Start the idle time of a stage, so long ago; in a pause its own, or anybody could park a booth."""
        if self._paused:
            script.do(do.StartTimer(Timer.PAUSE, self._idle.pause))
        else:
            idle_ms = max(self._idle.of(stage.value), self._reading_ms(stage))
            script.do(do.StartTimer(Timer.IDLE, max(1, idle_ms - ago_ms)))

    def go_on(self, script: Script) -> None:
        """End a pause together with the sitting, or after the program that it was cut off with."""
        if self._paused:
            self._paused = False
            script.do(do.HidePause())

    def stop_asking(self, script: Script) -> None:
        """Ask no longer whether somebody is there."""
        if self._asked:
            self._asked = False
            script.do(do.HideStillThere(), do.StopTimer(Timer.STILL_THERE))
