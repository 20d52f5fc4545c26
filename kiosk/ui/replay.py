"""A replay as a program: the kiosk's window with a player behind it, or a folder of pictures."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path
from types import TracebackType
from typing import Self

from PySide6.QtQuick import QQuickWindow

from kiosk.experiment import effects as do
from kiosk.experiment.replay import ReplayStep
from kiosk.experiment.session_config import SessionConfig, StudyConfig
from kiosk.robots.selector import EmbodimentSelector
from kiosk.ui.event_loop import Clock, EventLoop, WallClock
from kiosk.ui.renderer import Renderer
from kiosk.ui.replay_controls import ReplayControls, ReplayPlayer
from kiosk.ui.screens.avatar import AvatarBody
from kiosk.ui.screens.registry import ScreenSet
from kiosk.ui.screenshots import PICTURE_QUALITY, unwritten
from kiosk.ui.voice import Voice
from kiosk.ui.window import RunMode, Window

_log = logging.getLogger(__name__)

_UNSEEN = (do.StartTimer, do.StopTimer)
"""Effects that change nothing on the screen."""


def changes_screen(step: ReplayStep) -> bool:
    """Whether a step can change what is to be seen."""
    return any(not isinstance(effect, _UNSEEN) for effect in step.outcome.effects)


class MuteVoice(Voice):
    """Says nothing, and reports nothing: what became of every sentence stands in the record."""

    def say(self, number: int, sentence: str) -> None:  # noqa: ARG002 - it says nothing
        """Say nothing, without searching for words."""
        self.started.emit(number, [])

    def stop(self) -> None:
        """Nothing is to be heard anyway."""


class _Deaf:
    """Hears of no body: what they reported then is among the steps."""

    def speech_started(self, utterance: int) -> None: ...

    def speech_finished(self, utterance: int) -> None: ...

    def speech_failed(self, utterance: int, why: str) -> None: ...

    def robot_lost(self, why: str) -> None: ...


def avatar_alone(window: Window, clock: Clock, plan: SessionConfig) -> EmbodimentSelector:
    """Return the avatar of a window as the only body; it shows what it says, and makes no sound."""
    embodiments = EmbodimentSelector(_Deaf(), clock.after, plan.settings.robot)
    board = plan.settings.screen.board_side
    embodiments.set_avatar(AvatarBody(window.screens.avatar, MuteVoice(window.owner), _Deaf(), board, window.owner))
    return embodiments


class Replay:
    """One stored session in the window. Only one can be in a process."""

    def __init__(
        self,
        mode: RunMode,
        plan: SessionConfig,
        steps: tuple[ReplayStep, ...],
        title: str,
        beat: Callable[[], None] = lambda: None,
    ) -> None:
        """Show the window as it was before the first step; ``beat`` is called as long as it goes on."""
        self.beat = beat
        """To be called now and then while it is played."""
        self._window = Window(StudyConfig((plan,)), mode)
        with ExitStack() as undo:
            undo.callback(self._window.close)
            self._build(mode, plan, steps, title, undo)
            undo.pop_all()

    def _build(
        self, mode: RunMode, plan: SessionConfig, steps: tuple[ReplayStep, ...], title: str, undo: ExitStack
    ) -> None:
        """Build what stands behind the window; ``undo`` is given what has to be done if something of it cannot be."""
        owner = self._window.owner
        self._clock = WallClock(owner)
        self._window.show(mode.display)
        self._renderer = Renderer(self._window.screens, self._clock, lambda _: None)
        self._renderer.embodiments = avatar_alone(self._window, self._clock, plan)
        self.player = ReplayPlayer(self._renderer, self._clock, plan, steps)
        self.player.change_speed(mode.speed)
        self._loop = EventLoop(self._clock, owner, self._fault, self.beat)
        undo.callback(self._loop.close)
        self._bar = ReplayControls(title, self.player, owner)
        self._bar.left.connect(self._loop.quit)
        self._window.set_replay(self._bar)
        self._error: BaseException | None = None

    def __enter__(self) -> Self:
        """Return the replay itself."""
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        """Close the window."""
        self._loop.close()
        self._window.close()

    @property
    def screens(self) -> ScreenSet:
        """Everything that can be shown."""
        return self._window.screens

    @property
    def window(self) -> QQuickWindow:
        """Qt's own window."""
        return self._window.shown

    def run(self) -> None:
        """Play until the viewer closes it."""
        self.player.run()
        self._loop.run()
        if self._error is not None:
            raise self._error

    def frames(self, folder: Path) -> Iterator[Path]:
        """Save a picture after every step that changes the screen, and yield its file.

        Raises UserInputError if a picture cannot be saved, and StorageError on a full disk.
        """
        self.hide_controls()
        for index, step in enumerate(self.player.steps, 1):
            self.beat()
            self.player.step()
            if changes_screen(step):
                file = folder / f"{index:05}-{step.event.at_ms:07}ms-{step.stage.value}-{type(step.event).__name__}.png"
                if not self._window.shown.grabWindow().save(str(file), quality=PICTURE_QUALITY):
                    raise unwritten(file)
                yield file

    def show_memory(self) -> None:
        """Show below the screens how likely each card is remembered, by the memory model."""
        self._bar.follow_memory(self.player.plan.catalogue.text("film-memory"))
        self._window.set_replay_memory(self._bar)

    def hide_controls(self) -> None:
        """Show the screens without the bar below them."""
        self._window.set_replay(None)

    def _fault(self, kind: type[BaseException], fault: BaseException, at: TracebackType | None) -> None:
        """End the replay at a fault of ours; no visitor waits in front of it."""
        _log.critical("a fault in Recollect", exc_info=(kind, fault, at))
        self._error = fault
        self._loop.quit()
