"""The replay's player, and its controls as QML sees them."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import Property, QObject, Signal, Slot
from PySide6.QtGui import QPainter
from PySide6.QtQml import QmlElement
from PySide6.QtQuick import QQuickItem, QQuickPaintedItem

from kiosk.experiment.memory_replay import BoardMemory, memory_after_steps
from kiosk.experiment.session_config import SessionConfig
from kiosk.ui.event_loop import Clock, TimerWait
from kiosk.ui.memory_view import MARGIN, draw_memory
from kiosk.ui.renderer import Renderer
from kiosk.units import MS_PER_SECOND, SECONDS_PER_MINUTE

if TYPE_CHECKING:
    from kiosk.experiment.replay import ReplayStep

SLOWEST, FASTEST = 0.25, 32.0
HIDDEN_CODE = "· · ·"
"""Stands where the participant's code stood, which stays private afterwards."""


class ReplayPlayer:
    """Knows how far the session has been played."""

    def __init__(self, renderer: Renderer, clock: Clock, plan: SessionConfig, steps: tuple[ReplayStep, ...]) -> None:
        """Show what there was before the first step; ``changed`` is called whenever something is."""
        self.changed: Callable[[], None] = lambda: None
        self.steps = steps
        self.played = 0
        """How many steps have been played."""
        self.speed = 1.0
        self._renderer = renderer
        self._clock = clock
        self.plan = plan
        """What the session was to be."""
        self._wait: TimerWait | None = None
        self._begin()

    @property
    def runs(self) -> bool:
        """Whether the next step comes by itself."""
        return self._wait is not None

    @property
    def last(self) -> ReplayStep | None:
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
        self._renderer.reset("attract")
        self._renderer.begin(self.plan)
        self._renderer.screens.debrief.give_code(HIDDEN_CODE)

    def _play(self) -> None:
        step = self.steps[self.played]
        self.played += 1
        self._renderer.perform(step.outcome.effects)

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


QML_IMPORT_NAME = "Recollect"
QML_IMPORT_MAJOR_VERSION = 1

FASTER = 2.0


@QmlElement
class ReplayControls(QObject):
    """The player, as QML sees it."""

    changed = Signal()
    left = Signal()
    """The viewer has seen enough."""

    def __init__(self, title: str, player: ReplayPlayer, parent: QObject | None = None) -> None:
        """``title`` says which session it is."""
        super().__init__(parent)
        self._title = title
        self._player = player
        self.memory_title = ""
        self._memories: tuple[BoardMemory | None, ...] = ()
        player.changed = self.changed.emit

    def follow_memory(self, title: str) -> None:
        """Work out what is remembered after every step; ``title`` stands above it."""
        self.memory_title = title
        self._memories = memory_after_steps(self._player.steps)

    @property
    def memory(self) -> BoardMemory | None:
        """What is remembered after the last step; None without a board, or where it is not followed."""
        played = self._player.played
        return self._memories[played - 1] if self._memories and played else None

    @Property(str, constant=True)
    def title(self) -> str:
        """Which session it is."""
        return self._title

    @Property(str, notify=changed)
    def position(self) -> str:
        """Return the time since the session began, the stage, and what happened last."""
        return _place(self._player.last)

    @Property(str, notify=changed)
    def speed(self) -> str:
        """How many times as fast as then."""
        return f"{self._player.speed:g} x"

    @Property(bool, notify=changed)
    def runs(self) -> bool:
        """Whether it goes on by itself."""
        return self._player.runs

    @Property(bool, notify=changed)
    def differs(self) -> bool:
        """Whether the step at hand comes out otherwise today than it was recorded."""
        return self._player.last is not None and not self._player.last.agrees

    @Property(int, notify=changed)
    def played(self) -> int:
        """How many steps have been played."""
        return self._player.played

    @Property(int, constant=True)
    def steps(self) -> int:
        """How many steps there are."""
        return len(self._player.steps)

    @Slot()
    def toggle(self) -> None:
        """Go on, or stay."""
        if self._player.runs:
            self._player.pause()
        else:
            self._player.run()

    @Slot()
    def step(self) -> None:
        """One step on."""
        self._player.step()

    @Slot()
    def back(self) -> None:
        """One step back."""
        self._player.pause()
        self._player.go_to(self._player.played - 1)

    @Slot(int)
    def seek(self, played: int) -> None:
        """To this step."""
        self._player.go_to(played)

    @Slot()
    def faster(self) -> None:
        """Twice as fast."""
        self._player.change_speed(FASTER)

    @Slot()
    def slower(self) -> None:
        """Half as fast."""
        self._player.change_speed(1 / FASTER)

    @Slot()
    def leave(self) -> None:
        """Enough."""
        self.left.emit()


@QmlElement
class MemoryDrawing(QQuickPaintedItem):
    """What is remembered after the last step of a replay, drawn as in a film."""

    given = Signal()

    def __init__(self, parent: QQuickItem | None = None) -> None:
        super().__init__(parent)
        self._replay: ReplayControls | None = None

    def _get(self) -> ReplayControls | None:
        return self._replay

    def _set(self, replay: ReplayControls | None) -> None:
        self._replay = replay
        if replay is not None:
            replay.changed.connect(self.update)
        self.given.emit()
        self.update()

    replay = Property(ReplayControls, _get, _set, notify=given)

    @property
    def memory(self) -> BoardMemory | None:
        """What it draws; None while there is no board."""
        return None if self._replay is None else self._replay.memory

    def paint(self, painter: QPainter) -> None:
        """Draw it."""
        memory = self.memory
        if self._replay is not None and memory is not None:
            room = self.boundingRect().toRect().adjusted(MARGIN, 8, -MARGIN, -8)
            draw_memory(painter, memory, self._replay.memory_title, room)


def _place(step: ReplayStep | None) -> str:
    if step is None:
        return "0:00.0"
    minutes, seconds = divmod(step.event.at_ms / MS_PER_SECOND, SECONDS_PER_MINUTE)
    return f"{minutes:.0f}:{seconds:04.1f}   {step.stage.value}   {step.seq} {type(step.event).__name__}"
