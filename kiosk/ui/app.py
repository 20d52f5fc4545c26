"""The kiosk: the window, and behind it the conductor, the bodies, the voice and the clock, put together."""

from __future__ import annotations

import logging
from collections.abc import Callable
from contextlib import ExitStack
from functools import partial
from random import Random
from types import TracebackType
from typing import Self

from PySide6.QtCore import QObject
from PySide6.QtQuick import QQuickWindow

from kiosk.robot.bodies import Bodies
from kiosk.robot.device import Robot
from kiosk.robot.kinds import robot_of
from kiosk.robot.robot_body import RobotBody
from kiosk.settings import Settings
from kiosk.store.recorder import Recorder
from kiosk.study.session_kind import SessionKind
from kiosk.ui.activity import Activity
from kiosk.ui.booth.window import BoothWindow
from kiosk.ui.clock import Clock, VirtualClock, WallClock
from kiosk.ui.conductor import Conductor
from kiosk.ui.desk import Desk
from kiosk.ui.loop import Loop
from kiosk.ui.panel.booth import Experimenter, read_for, wall_ms
from kiosk.ui.panel.deeds import Booth
from kiosk.ui.screens.avatar import AvatarBody
from kiosk.ui.screens.every import Screens
from kiosk.ui.screens.life import IdleLife
from kiosk.ui.sounds import Effect
from kiosk.ui.voice import EngineVoice, NoVoice, SilentVoice, Voice
from kiosk.ui.watchdog import watched
from kiosk.ui.window import Display, Mode, Pace, Window
from kiosk.ui.work import AtOnce, Landing, Worker

_log = logging.getLogger(__name__)

_BEGAN_MS = wall_ms()


class App:
    """The kiosk, ready to run. Only one can be in a process."""

    def __init__(
        self,
        mode: Mode,
        recorder: Recorder,
        desk: Desk,
        robot: Robot | None = None,
        beat: Callable[[], None] = lambda: None,
    ) -> None:
        """Build everything for the desk's study and show the window; the desk is asked once for each sitting.

        ``robot`` helps in place of the one that the study file asks for; ``beat`` is called out of the event loop.
        """
        self.on_fault: Callable[[BaseException], None] = lambda _: None
        """Is told of a fault of ours once the calm screen is up."""
        self.desk = desk
        self._beat = beat
        self._window = Window(desk.study, mode)
        with ExitStack() as undo:
            undo.callback(self._window.close)
            self._build(mode, recorder, desk, robot, undo)
            undo.pop_all()

    def _build(self, mode: Mode, recorder: Recorder, desk: Desk, robot: Robot | None, undo: ExitStack) -> None:
        """Build what stands behind the window; ``undo`` is given what has to be done if something of it cannot be."""
        settings = desk.study.settings
        owner = self._window.owner
        self.booth = self._show(settings, mode.display)
        if self.booth is not None:
            undo.callback(self.booth.release)
        self.clock = _clock(mode, owner)
        self.started_ms = self.clock.now_ms()
        self.conductor = Conductor(self.screens, recorder, self.clock, desk)
        self._activity = Activity(self.window, self.screens.kiosk, self.clock, owner)
        self.conductor.last_activity_ms = self._activity.last_ms
        self.voice = _voice(settings, mode, self.clock, owner)
        undo.callback(self.voice.close)
        self.bodies = Bodies(self.conductor, self.clock.after, settings.robot)
        board = settings.screen.board
        self.bodies.take(AvatarBody(self.screens.avatar, self.voice, self.bodies, board, owner))
        self.conductor.take(self.bodies)
        self._landing = Landing()
        self._take_robot(robot or robot_of(settings.robot, desk.study.languages[0]), settings)
        if settings.voice.sounds:
            self.conductor.play = self._play
        if mode.pace is Pace.WALL and settings.screen.motion:
            # Kept, for Qt alone does not keep alive whom it calls back.
            shown = self.screens
            self._life = IdleLife(shown.kiosk, shown.avatar, shown.attract, self.clock, Random())
        if desk.kind is SessionKind.TRIAL:
            self.screens.attract.show_trial(settings.keys.leave)
        self._loop = Loop(self.clock, owner, self.fault, self._beat)
        undo.callback(self._loop.close)
        virtual = mode.pace is Pace.VIRTUAL
        self._work, self._slow = (AtOnce() if virtual else Worker(self._landing) for _ in range(2))
        now_ms = partial(_virtual_wall_ms, self.clock) if virtual else wall_ms
        self.experimenter = Experimenter(self._reached(recorder), self.window, self._work, self._slow, now_ms)
        if not virtual:
            self.experimenter.upkeep.begin()

    def __enter__(self) -> Self:
        """The kiosk itself."""
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        """End what is under way, and let go of everything."""
        self.close()

    @property
    def screens(self) -> Screens:
        """Everything that can be shown."""
        return self._window.screens

    @property
    def window(self) -> QQuickWindow:
        """Qt's own window."""
        return self._window.shown

    @property
    def told_to_end(self) -> bool:
        """Whether the system asked the kiosk to end."""
        return self._loop.told_to_end

    def run(self) -> None:
        """Run until somebody leaves the kiosk."""
        with watched(self.window, self.screens.kiosk):
            self._loop.run()

    def quit(self) -> None:
        """Leave the kiosk."""
        self._loop.quit()

    def close(self) -> None:
        """End the sitting that is under way, and everything but the application object."""
        self.conductor.close()
        self._loop.close()
        self.experimenter.close()
        self.bodies.close()
        self._landing.close()
        self._work.close()
        self._slow.close()
        self.voice.close()
        if self.booth is not None:
            self.booth.release()
        self._window.close()

    def fault(self, kind: type[BaseException], fault: BaseException, at: TracebackType | None) -> None:
        """A fault of ours: into the log with it, and a calm screen for the visitor."""
        _log.critical("a fault in Recollect", exc_info=(kind, fault, at))
        self.conductor.pause()
        self.on_fault(fault)

    def _show(self, settings: Settings, display: Display) -> BoothWindow | None:
        """Show the window; over the full screen it is one that nobody leaves."""
        if display is Display.FULL_SCREEN:
            return BoothWindow(self.window, settings.screen.number, self._window.owner)
        self._window.show()
        return None

    def _reached(self, recorder: Recorder) -> Booth:
        """What the experimenter can do something to."""
        return Booth(
            conductor=self.conductor,
            desk=self.desk,
            bodies=self.bodies,
            voice=self.voice,
            recorder=recorder,
            screens=self.screens,
            clock=self.clock,
            read_cut_off=read_for(self._work, recorder.folder),
            window_health=lambda: self.booth.health if self.booth else (),
            leave=self.quit,
        )

    def _play(self, effect: Effect) -> None:
        if not self.bodies.is_quiet:
            self.voice.play(effect.file)

    def _take_robot(self, device: Robot | None, settings: Settings) -> None:
        if device is None:
            return
        self.bodies.take_robot(RobotBody(device, self.bodies, self._landing, settings.robot.look_every))
        if isinstance(self.clock, VirtualClock):
            self.clock.waits_for = lambda: self.bodies.busy


def _clock(mode: Mode, owner: QObject) -> Clock:
    return VirtualClock() if mode.pace is Pace.VIRTUAL else WallClock(owner, mode.speed)


def _virtual_wall_ms(clock: Clock) -> int:
    """A wall's clock for virtual time, which began with the program."""
    return _BEGAN_MS + clock.now_ms()


def _voice(settings: Settings, mode: Mode, clock: Clock, owner: QObject) -> Voice:
    if mode.pace is Pace.VIRTUAL or mode.speed != 1:
        return SilentVoice(clock, owner)
    if not settings.voice.enabled:
        return NoVoice(owner)
    return EngineVoice(settings.voice, settings.language_codes[0], parent=owner)
