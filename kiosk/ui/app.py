"""The kiosk: the window, and behind it the runner, the embodiments, the voice and the clock, put together."""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from datetime import datetime
from functools import partial
from random import Random
from types import TracebackType
from typing import TYPE_CHECKING, Any, Self
from uuid import uuid4

from PySide6.QtCore import QObject
from PySide6.QtGui import QGuiApplication
from PySide6.QtQuick import QQuickWindow

from kiosk.config import MarkersConfig, Settings, VoiceConfig
from kiosk.experiment.events import SessionSetup
from kiosk.experiment.outcomes import EmbodimentName, SessionKind
from kiosk.robots.adapter import AsyncRobotAdapter
from kiosk.robots.driver import RobotDriver
from kiosk.robots.registry import create_robot
from kiosk.robots.selector import EmbodimentSelector
from kiosk.store.recorder import Recorder
from kiosk.ui.condition_assigner import ConditionAssigner
from kiosk.ui.event_loop import (
    Clock,
    EventLoop,
    InlineExecutor,
    MainThreadExecutor,
    ThreadExecutor,
    TimerWait,
    VirtualClock,
    WallClock,
    after_first_frame,
    heartbeat,
)
from kiosk.ui.experimenter.actions import Services
from kiosk.ui.experimenter.console import ExperimenterConsole, read_for, wall_ms
from kiosk.ui.experimenter.operator_strip import OperatorStrip
from kiosk.ui.input import Activity, ChoiceReset, PointerTrace
from kiosk.ui.kiosk_window import KioskWindow
from kiosk.ui.markers import MarkerStream
from kiosk.ui.preparation import Preparation, steps_of
from kiosk.ui.recording import DiskWriter
from kiosk.ui.renderer import SoundEffect
from kiosk.ui.screens.attract import IdleLife
from kiosk.ui.screens.avatar import AvatarBody
from kiosk.ui.screens.registry import ScreenSet
from kiosk.ui.session_runner import SessionRunner
from kiosk.ui.voice import EngineVoice, NoVoice, SilentVoice, Voice
from kiosk.ui.window import ClockMode, RunMode, Window, WindowMode

if TYPE_CHECKING:
    from kiosk.remote import StatusPublisher

_log = logging.getLogger(__name__)

_BEGAN_MS = wall_ms()

WATCH_AFTER_MS = 200
"""How long after the start the disk, the alarms and the status file have their turn: the first frame comes before."""


class App:
    """The kiosk, ready to run. Only one can be in a process."""

    def __init__(
        self,
        mode: RunMode,
        recorder: Recorder,
        assigner: ConditionAssigner,
        robot: RobotDriver | None = None,
        beat: Callable[[], None] = lambda: None,
    ) -> None:
        """Build everything for the assigner's study and show the window; the assigner is asked once for each session.

        ``robot`` helps in place of the one that the study file asks for; ``beat`` is called out of the event loop.
        """
        self.on_fault: Callable[[BaseException], None] = lambda _: None
        """Called with a fault of ours once the error screen is up."""
        self.assigner = assigner
        self._beat = beat
        self._watching: TimerWait | None = None
        self._window = Window(assigner.study, mode)
        with ExitStack() as undo:
            undo.callback(self._window.close)
            self._build(mode, recorder, assigner, robot, undo)
            undo.pop_all()

    def _build(
        self, mode: RunMode, recorder: Recorder, assigner: ConditionAssigner, robot: RobotDriver | None, undo: ExitStack
    ) -> None:
        """Build what stands behind the window; ``undo`` is given what has to be done if something of it cannot be."""
        settings = assigner.study.settings
        owner = self._window.owner
        self.booth = self._show(settings, mode)
        if self.booth is not None:
            undo.callback(self.booth.release)
        self.clock = _clock(mode, owner)
        self.started_ms = self.clock.now_ms()
        self.runner = SessionRunner(self.screens, recorder, self.clock, assigner)
        self._choices = ChoiceReset(self.screens.kiosk, self.clock, owner)
        self._activity = Activity(self.window, self.screens.kiosk, self.clock, owner)
        self.runner.last_activity_ms = self._activity.last_ms
        self.runner.last_device = lambda: self._activity.device
        self._trace_pointer(settings, owner)
        self.voice = _voice(settings, mode, self.clock, owner)
        undo.callback(self.voice.close)
        self.embodiments = EmbodimentSelector(self.runner, self.clock.after, settings.robot)
        board = settings.screen.board_side
        self.embodiments.set_avatar(AvatarBody(self.screens.avatar, self.voice, self.embodiments, board, owner))
        self.runner.set_embodiments(self.embodiments)
        self.runner.describe_setup = self._setup
        if mode.pace is ClockMode.WALL:
            self.runner.local_time = lambda: datetime.now().astimezone()
        self._landing = MainThreadExecutor()
        self._take_robot(robot or create_robot(settings.robot, assigner.study.languages[0]), settings)
        if not self.embodiments.has_robot:
            self._heard(not isinstance(self.voice, NoVoice))
            self.voice.health_changed.connect(self._heard)
        self.runner.spoken_by = self._spoken_by
        self.markers = self._send_markers(settings.markers, mode, owner, undo)
        self._play_sounds(settings.voice)
        if mode.pace is ClockMode.WALL and settings.screen.motion:
            # Kept, for Qt alone does not keep alive whom it calls back.
            shown = self.screens
            self._life = IdleLife(shown.kiosk, shown.avatar, shown.attract, self.clock, Random())
        if assigner.kind is SessionKind.TRIAL:
            self.screens.attract.show_trial(settings.shortcuts.quit)
        self._loop = EventLoop(self.clock, owner, self.fault, self._beat)
        undo.callback(self._loop.close)
        virtual = mode.pace is ClockMode.VIRTUAL
        self._start_threads(virtual=virtual)
        has_own_time = virtual or mode.speed != 1
        now_ms = partial(_own_wall_ms, self.clock, self.started_ms) if has_own_time else wall_ms
        self.experimenter = ExperimenterConsole(self._reached(recorder), self.window, self._work, self._slow, now_ms)
        self._publisher = self._publish(settings, recorder, undo) if not virtual else None
        self._strip = self._open_strip(settings, mode, undo)
        if not virtual:
            self._watching = self.clock.after(WATCH_AFTER_MS, self._watch)

    def _watch(self) -> None:
        """Begin to look after the disk, the status file and the alarms."""
        self.experimenter.upkeep.begin()
        self.experimenter.status_file.begin()
        self.experimenter.alarms.begin()

    def _start_threads(self, *, virtual: bool) -> None:
        """Start what works beside the interface; on virtual time nothing does."""
        self._work, self._slow, self._writes = (
            InlineExecutor() if virtual else ThreadExecutor(self._landing) for _ in range(3)
        )
        self.runner.returns.work = self._work
        if not virtual:
            # What a visitor does is written on a thread of its own, and does not wait for a copy or a list.
            self.runner.writer = DiskWriter(self._writes)
            # Not 0: Qt would call back in the same step of its loop.
            self.runner.later = partial(self.clock.after, 1)

    def _play_sounds(self, settings: VoiceConfig) -> None:
        """Play a sound with what happens, if the study wants any."""
        if settings.sounds:
            self.runner.play_sound = self._play
            self.screens.board.refused.connect(partial(self._play, SoundEffect.NUDGE))
            self.screens.kiosk.pressed.connect(partial(self._play, SoundEffect.BUTTON))

    def _send_markers(
        self, settings: MarkersConfig, mode: RunMode, owner: QObject, undo: ExitStack
    ) -> MarkerStream | None:
        """Send markers of what is recorded, if the study asks for it; virtual time means nothing to a recorder."""
        if not settings.lsl or mode.pace is not ClockMode.WALL:
            return None
        stream = MarkerStream(settings, f"recollect-{uuid4()}", owner)
        undo.callback(stream.close)
        self.runner.on_recorded = lambda participant, events: stream.send(participant, events, self.runner.now_ms())
        return stream

    def __enter__(self) -> Self:
        """Return the kiosk itself."""
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        """End what is under way, and let go of everything."""
        self.close()

    @property
    def screens(self) -> ScreenSet:
        """Everything that can be shown."""
        return self._window.screens

    @property
    def window(self) -> QQuickWindow:
        """Qt's own window."""
        return self._window.shown

    @property
    def stop_requested(self) -> bool:
        """Whether the system asked the kiosk to end."""
        return self._loop.stop_requested

    def run(self) -> None:
        """Run until the kiosk is left."""
        with heartbeat(self.window, self.screens.kiosk, alone=self._leave_alone):
            self._loop.run()

    def quit(self) -> None:
        """Leave the kiosk."""
        self._loop.quit()

    def close(self) -> None:
        """End the session that is under way, and everything but the application object."""
        self.runner.close()
        self._loop.close()
        if self._watching is not None:
            self._watching.cancel()
        self.experimenter.close()
        for part in (self._publisher, self.markers, self._strip):
            if part is not None:
                part.close()
        self.embodiments.close()
        self._landing.close()
        self._writes.close()
        self._work.close()
        self._slow.close()
        self.voice.close()
        if self.booth is not None:
            self.booth.release()
        self._window.close()

    def fault(self, kind: type[BaseException], fault: BaseException, at: TracebackType | None) -> None:
        """Log a fault of ours, and show the visitor an error screen."""
        _log.critical("a fault in Recollect", exc_info=(kind, fault, at))
        self.runner.pause()
        self.on_fault(fault)

    def _leave_alone(self) -> None:
        """End where the supervisor is gone: a new one could not open a kiosk on the same data."""
        _log.error("the supervisor is gone, so the kiosk ends")
        self.quit()

    def _show(self, settings: Settings, mode: RunMode) -> KioskWindow | None:
        """Show the window; over the full screen it is one that visitors cannot leave."""
        if mode.pace is ClockMode.WALL:
            # All pages are made once the first frame is drawn, so that no visitor waits for one.
            after_first_frame(self.window, self._prepare)
        if mode.display is WindowMode.FULL_SCREEN:
            return KioskWindow(self.window, settings.screen.display, self._window.owner)
        self._window.show()
        return None

    def _prepare(self) -> None:
        # No screen came before this one, so no tap can be meant for another.
        self.screens.kiosk.end_input_guard()
        catalogues = (plan.catalogue for plan in self.assigner.study.plans)
        self._preparation = Preparation(self._window.owner, steps_of(self.window, catalogues))

    def _reached(self, recorder: Recorder) -> Services:
        """Return what the experimenter can do something to."""
        return Services(
            runner=self.runner,
            assigner=self.assigner,
            embodiments=self.embodiments,
            voice=self.voice,
            recorder=recorder,
            screens=self.screens,
            clock=self.clock,
            read_cut_off=read_for(self._work, recorder.folder),
            window_health=lambda: self.booth.health if self.booth else (),
            leave=self.quit,
        )

    def _publish(self, settings: Settings, recorder: Recorder, undo: ExitStack) -> StatusPublisher | None:
        """Publish the status, if the study file asks for it; a rehearsal is no booth that anybody watches."""
        if not settings.remote.mqtt or self.assigner.kind is SessionKind.SIMULATED:
            return None
        from kiosk.remote import StatusPublisher, booth_name  # noqa: PLC0415 - few booths publish, and it loads a server

        booth = booth_name(settings.remote, recorder.site)
        publisher = StatusPublisher(settings.remote, booth, settings.beside)
        undo.callback(publisher.close)
        self.experimenter.status_file.observers.append(publisher.publish)
        self.experimenter.remote_trouble = lambda: publisher.trouble
        return publisher

    def _open_strip(self, settings: Settings, mode: RunMode, undo: ExitStack) -> OperatorStrip | None:
        """Show the experimenter's strip, if the study asks for one, whenever its screen is there."""
        if settings.screen.operator_display < 0 or mode.display is WindowMode.NOWHERE:
            return None
        strip = OperatorStrip(self._window.engine, self.screens.board, self.assigner.study.plans[0].catalogue)
        undo.callback(strip.close)
        strip.follow(settings.screen.operator_display, settings.screen.display)
        self.experimenter.status_file.observers.append(strip.update)
        return strip

    def _trace_pointer(self, settings: Settings, owner: QObject) -> None:
        """Keep the way of the pointer, if the study records it."""
        if settings.privacy.pointer_trace:
            self._trace = PointerTrace(self.window, self.clock, owner)
            self.runner.take_trace = self._trace.take
            # Whatever was moved before a session is none of it.
            self.screens.kiosk.screen_changed.connect(self._forget_trace)

    def _forget_trace(self) -> None:
        if self.screens.kiosk.shown == "attract":
            self._trace.begin()

    def _setup(self) -> SessionSetup:
        """Return what a session begins with now, but for the time."""
        window = self.window
        # Not the window's own screen: Qt for Python would delete it together with the window.
        middle, primary = window.geometry().center(), QGuiApplication.primaryScreen()
        screens = (each for each in QGuiApplication.screens() if each.geometry().contains(middle))
        screen = next(screens, primary)
        scale = screen.devicePixelRatio()
        fallback, detail = self.embodiments.fallback or (None, "")
        return SessionSetup(
            intended=self.embodiments.intended,
            fallback=fallback,
            detail=detail,
            screen_width=round(screen.size().width() * scale),
            screen_height=round(screen.size().height() * scale),
            screen_scale=scale,
            screen_width_mm=round(screen.physicalSize().width()),
            screen_height_mm=round(screen.physicalSize().height()),
            window_width=round(window.width() * scale),
            window_height=round(window.height() * scale),
        )

    def _heard(self, is_heard: bool, _: str = "") -> None:  # noqa: FBT001 - Qt's way to tell
        """Offer visitors the sound, or no longer."""
        self.screens.kiosk.set_audible(audible=is_heard)

    def _spoken_by(self) -> Mapping[str, Any]:
        """Return what speaks the sentence under way; of a robot's own voice nothing is known."""
        body = self.embodiments.current
        is_avatar = body is not None and body.name is EmbodimentName.AVATAR
        return self.voice.spoken_by if is_avatar else self.embodiments.robot_spoken_by

    def _play(self, effect: SoundEffect) -> None:
        if not self.embodiments.is_silent:
            self.voice.play(effect.file)

    def _take_robot(self, device: RobotDriver | None, settings: Settings) -> None:
        if device is None:
            return
        if settings.robot.pack:
            from kiosk.robots.voice_packs import PackClips  # noqa: PLC0415 - for few studies, and it loads the sound

            device.clips = PackClips(settings.voice_from_here)
        self.embodiments.attach_robot(
            AsyncRobotAdapter(device, self.embodiments, self._landing, settings.robot.heartbeat_ms)
        )
        if isinstance(self.clock, VirtualClock):
            self.clock.waits_for = lambda: self.embodiments.busy


def _clock(mode: RunMode, owner: QObject) -> Clock:
    return VirtualClock() if mode.pace is ClockMode.VIRTUAL else WallClock(owner, mode.speed)


def _own_wall_ms(clock: Clock, started_ms: int) -> int:
    """Return a wall's clock for time that passes at a speed of its own, and began with the program."""
    return _BEGAN_MS + clock.now_ms() - started_ms


def _voice(settings: Settings, mode: RunMode, clock: Clock, owner: QObject) -> Voice:
    if mode.pace is ClockMode.VIRTUAL or mode.speed != 1:
        return SilentVoice(clock, owner)
    if not settings.voice.enabled:
        return NoVoice(owner)
    return EngineVoice(settings.voice_from_here, settings.language_codes[0], parent=owner)
