"""The window and everything behind it, put together; the one place that talks to Qt's application object."""

from __future__ import annotations

import gc
import logging
import os
import signal
import sys
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from random import Random
from types import TracebackType
from typing import Self

# PySide6.QtQuick must be known before a window is asked for, or it comes back as a plain QWindow.
from PySide6.QtCore import QCoreApplication, QEvent, QEventLoop, QObject, Qt, QTimer, QUrl
from PySide6.QtGui import QFont, QFontDatabase, QGuiApplication, QIcon
from PySide6.QtQml import QQmlApplicationEngine
from PySide6.QtQuick import QQuickWindow

from kiosk import BadInput
from kiosk.robot.bodies import Bodies
from kiosk.robot.kinds import robot_of
from kiosk.robot.robot_body import RobotBody
from kiosk.settings import ASSETS, Settings
from kiosk.store.recorder import Recorder
from kiosk.study.plan import Study
from kiosk.ui.clock import Clock, VirtualClock, WallClock
from kiosk.ui.conductor import Conductor
from kiosk.ui.desk import Desk
from kiosk.ui.performer import Screens
from kiosk.ui.screens.avatar import AvatarBody, AvatarScreen
from kiosk.ui.screens.board import BoardScreen
from kiosk.ui.screens.life import IdleLife
from kiosk.ui.screens.plain import AttractScreen, IntroductionScreen, KioskScreen, QuestionScreen, ResultScreen
from kiosk.ui.screens.words import words
from kiosk.ui.voice import EngineVoice, NoVoice, SilentVoice, Voice
from kiosk.ui.work import Landing

QML = Path(__file__).parent / "qml" / "Main.qml"
FONTS = ("NotoSans-Regular.ttf", "NotoSans-Bold.ttf")
HEARTBEAT_MS = 250
MOTION_MS = 220
"""How long a card takes to turn and a screen to fade; 0 without motion."""

_log = logging.getLogger(__name__)


class Pace(Enum):
    """How time passes."""

    WALL = "wall"
    """As it does for people, or a number of times as fast."""
    VIRTUAL = "virtual"
    """From one wait to the next, as fast as the machine allows, in silence and without motion."""


class Display(Enum):
    """Where the window is."""

    FULL_SCREEN = "full screen"
    WINDOW = "window"
    NOWHERE = "nowhere"
    """Drawn, but on no screen: it can be rehearsed and photographed."""


@dataclass(frozen=True)
class Mode:
    """How the kiosk runs."""

    display: Display = Display.FULL_SCREEN
    pace: Pace = Pace.WALL
    speed: float = 1.0


class App:
    """The kiosk, ready to run. Only one can be in a process."""

    def __init__(self, mode: Mode, recorder: Recorder, desk: Desk) -> None:
        """Build everything for the desk's study and show the window; the desk is asked once for each sitting."""
        study = desk.study
        settings = study.settings
        self.application = _application(mode.display)
        # A loop of our own: the application's asks every window first, and the window refuses everybody.
        self._loop = QEventLoop()
        self._owner = QObject()
        self.clock = _clock(mode, self._owner)
        self.started_ms = self.clock.now_ms()
        self.screens = _screens(study, self._owner)
        self.conductor = Conductor(self.screens, recorder, self.clock, desk)
        self._voice = _voice(settings, mode, self.clock, self._owner)
        self.bodies = Bodies(self.conductor, self.clock.after, settings.robot)
        self.bodies.take(AvatarBody(self.screens.avatar, self._voice, self.conductor, self._owner))
        self.conductor.take(self.bodies)
        self._landing = Landing()
        self._take_robot(settings)
        if settings.voice.sounds:
            self.conductor.play = lambda effect: self._voice.play(effect.file)
        if mode.pace is Pace.WALL and settings.screen.motion:
            # Kept, for Qt alone does not keep alive whom it calls back.
            self._life = IdleLife(self.screens.avatar, self.screens.attract, self.clock, Random())
        self._engine = QQmlApplicationEngine()
        self.window = self._load(settings, mode)
        self.screens.kiosk.left.connect(self.quit)
        self._keep_heart_beating()

    def __enter__(self) -> Self:
        """The kiosk itself."""
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        """End what is under way, and let go of everything."""
        self.close()

    def run(self) -> None:
        """Run until somebody leaves the kiosk."""
        before, sys.excepthook = sys.excepthook, self.fault
        ticking = QTimer()
        if isinstance(self.clock, VirtualClock):
            # Whenever the interface has nothing else to do.
            ticking.timeout.connect(self.clock.jump)
            ticking.start(0)
        # What is there now stays for the day; walking all of it for garbage would cost the screen a frame or two.
        gc.collect()
        gc.freeze()
        try:
            self._loop.exec()
        finally:
            gc.unfreeze()
            ticking.stop()
            sys.excepthook = before

    def quit(self) -> None:
        """Leave the kiosk."""
        self._loop.quit()

    def close(self) -> None:
        """End the sitting that is under way, and everything but the application object: Qt allows no second one."""
        self.conductor.close()
        for ending, handler in self._signals_before.items():
            signal.signal(ending, handler)
        self.bodies.close()
        self._landing.close()
        self._voice.close()
        self.screens.kiosk.let_go()
        self.window.close()
        # The engine goes before the objects that its windows look at.
        for part in (self._engine, self._owner):
            part.deleteLater()
            QCoreApplication.sendPostedEvents(part, QEvent.Type.DeferredDelete)

    def _take_robot(self, settings: Settings) -> None:
        device = robot_of(settings.robot, settings.languages[0])
        if device is None:
            return
        self.bodies.take_robot(RobotBody(device, self.bodies, self._landing, settings.robot.look_every))
        if isinstance(self.clock, VirtualClock):
            self.clock.waits_for = lambda: self.bodies.busy

    def _load(self, settings: Settings, mode: Mode) -> QQuickWindow:
        moving = settings.screen.motion and mode.pace is Pace.WALL
        screens = self.screens
        self._engine.setInitialProperties(
            {
                "kiosk": screens.kiosk,
                "attract": screens.attract,
                "introduction": screens.introduction,
                "board": screens.board,
                "result": screens.result,
                "question": screens.question,
                "avatar": screens.avatar,
                "words": words(plan.catalogue),
                "cardBack": QUrl.fromLocalFile(str(ASSETS / "cards" / "back.svg")),
                "cardShadow": QUrl.fromLocalFile(str(ASSETS / "cards" / "shadow.svg")),
                "textSize": settings.screen.text_size,
                "motion": MOTION_MS if moving else 0,
            }
        )
        self._engine.load(QUrl.fromLocalFile(str(QML)))
        window = self._engine.rootObjects()[0]
        if not isinstance(window, QQuickWindow):
            raise TypeError(f"{QML} holds a {type(window).__name__}, not a window")
        _show(window, mode.display)
        return window

    def _keep_heart_beating(self) -> None:
        """Let Python run now and then, or it would never see that the system asks it to end."""
        heart = QTimer(self._owner)
        heart.timeout.connect(lambda: None)
        heart.start(HEARTBEAT_MS)
        self._signals_before = {
            ending: signal.signal(ending, lambda *_: self.quit()) for ending in (signal.SIGINT, signal.SIGTERM)
        }

    def fault(self, kind: type[BaseException], fault: BaseException, at: TracebackType | None) -> None:
        """A fault of ours: into the log with it, and a calm screen for the visitor."""
        _log.critical("a fault in Recollect", exc_info=(kind, fault, at))
        self.conductor.pause()


def check_screen(display: Display) -> None:
    """Raise BadInput where there is no screen to show anything on; Qt itself would end the process."""
    needs = sys.platform.startswith("linux") and display is not Display.NOWHERE
    if needs and not {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"} & os.environ.keys():
        raise BadInput("there is no screen here; 'recollect rehearse --headless' needs none")


def _application(display: Display) -> QGuiApplication:
    """The application object: drawn in software, in the basic loop, which no missing GPU can disturb."""
    os.environ.setdefault("QT_QUICK_BACKEND", "software")
    os.environ.setdefault("QSG_RENDER_LOOP", "basic")
    if display is Display.NOWHERE:
        os.environ["QT_QPA_PLATFORM"] = "offscreen"
    existing = QGuiApplication.instance()
    application = existing if isinstance(existing, QGuiApplication) else QGuiApplication(["recollect"])
    application.setQuitOnLastWindowClosed(False)
    for font in FONTS:
        QFontDatabase.addApplicationFont(str(ASSETS / "fonts" / font))
    application.setFont(QFont("Noto Sans"))
    application.setWindowIcon(QIcon(str(ASSETS / "icon.svg")))
    return application


def _clock(mode: Mode, owner: QObject) -> Clock:
    return VirtualClock() if mode.pace is Pace.VIRTUAL else WallClock(owner, mode.speed)


def _voice(settings: Settings, mode: Mode, clock: Clock, owner: QObject) -> Voice:
    if mode.pace is Pace.VIRTUAL or mode.speed != 1:
        return SilentVoice(clock, owner)
    if not settings.voice.enabled:
        return NoVoice(owner)
    return EngineVoice(settings.voice, settings.languages[0], parent=owner)


def _screens(plan: Plan, owner: QObject) -> Screens:
    catalogue = plan.catalogue
    pictures = ASSETS / "cards" / plan.settings.game.deck
    addresses = tuple(QUrl.fromLocalFile(str(pictures / f"{card}.svg")).toString() for card in plan.deck)
    return Screens(
        kiosk=KioskScreen(owner),
        attract=AttractScreen(addresses, owner),
        introduction=IntroductionScreen(owner),
        board=BoardScreen(catalogue, pictures, owner),
        result=ResultScreen(catalogue, owner),
        question=QuestionScreen(catalogue, owner),
        avatar=AvatarScreen(owner),
    )


def _show(window: QQuickWindow, display: Display) -> None:
    if display is Display.FULL_SCREEN:
        window.setFlags(window.flags() | Qt.WindowType.FramelessWindowHint | Qt.WindowType.WindowStaysOnTopHint)
        # Without a window manager nobody obeys a wish for the full screen: take its size as well.
        window.setGeometry(window.screen().geometry())
        window.showFullScreen()
    else:
        window.show()
    window.requestActivate()
