"""The window with all its screens, and nothing behind it yet; the one place that makes Qt's application object."""

from __future__ import annotations

import os
from collections.abc import Sequence
from enum import Enum
from pathlib import Path
from typing import ClassVar

from PySide6.QtCore import QCoreApplication, QEvent, QObject, QUrl
from PySide6.QtGui import QGuiApplication, QIcon
from PySide6.QtNetwork import QNetworkProxy
from PySide6.QtQml import QQmlApplicationEngine, QQmlComponent, QQmlEngine
from PySide6.QtQuick import QQuickWindow

from kiosk import UserInputError
from kiosk.config import ASSETS, Settings
from kiosk.experiment.session_config import StudyConfig
from kiosk.lazy_dataclass import dataclass
from kiosk.ui.fonts import use_fonts
from kiosk.ui.input import HeldKeys
from kiosk.ui.qt_platform import draw_in_software, obstacle
from kiosk.ui.replay_controls import ReplayControls
from kiosk.ui.screens.registry import ScreenSet

# PySide6.QtQuick must be known before a window is asked for, or it comes back as a plain QWindow.


QML = Path(__file__).parent / "qml" / "Main.qml"
MOTION_MS = 220
"""How long a card takes to turn and a screen to fade; 0 without motion."""


class ClockMode(Enum):
    """How time passes."""

    WALL = "wall"
    """As it does for people, or a number of times as fast."""
    VIRTUAL = "virtual"
    """From one wait to the next, as fast as the machine allows, in silence and without motion."""


class WindowMode(Enum):
    """Where the window is."""

    FULL_SCREEN = "full screen"
    WINDOW = "window"
    NOWHERE = "nowhere"
    """Drawn, but on no screen: it can be rehearsed and photographed."""


@dataclass(frozen=True)
class RunMode:
    """How the kiosk runs."""

    display: WindowMode = WindowMode.FULL_SCREEN
    pace: ClockMode = ClockMode.WALL
    speed: float = 1.0
    size: tuple[int, int] = (1920, 1080)
    """Of a window that does not fill the screen."""


class Window:
    """All that can be seen. Only one can be in a process."""

    reuses_engine: ClassVar[bool] = False
    """Whether a window that is closed leaves its engine, and the compiled screens in it, to the next one."""
    _left: ClassVar[QQmlApplicationEngine | None] = None

    def __init__(self, study: StudyConfig, mode: RunMode) -> None:
        """Make the window of this study; every screen of it is empty, and nothing is shown yet."""
        self.application = application(mode.display, study.settings.own_fonts)
        left, Window._left = Window._left, None
        self._engine = left or QQmlApplicationEngine()
        # A child of the engine goes after the windows, which look at the screens up to their own end.
        self.owner = QObject(self._engine)
        """What belongs to the window lives as long as this."""
        self.screens = ScreenSet.of(study, self.owner)
        self.shown = self._load(study.settings, mode)
        """Qt's own window."""
        self._held_keys = HeldKeys(self.shown, self.owner)

    @property
    def engine(self) -> QQmlEngine:
        """What loads the window's screens, for other windows beside it."""
        return self._engine

    def show(self, display: WindowMode = WindowMode.WINDOW) -> None:
        """Show it as a window that can be left, over the full screen or not."""
        if display is WindowMode.FULL_SCREEN:
            self.shown.showFullScreen()
        else:
            self.shown.show()
        self.shown.requestActivate()

    def set_replay(self, bar: ReplayControls | None) -> None:
        """Show this bar below the screens, or none."""
        self.shown.setProperty("replay", bar)

    def set_replay_memory(self, bar: ReplayControls) -> None:
        """Show below the screens what is remembered in the replay of this bar."""
        self.shown.setProperty("replayMemory", bar)

    def close(self) -> None:
        """Close it, with everything but the application object: Qt allows no second one."""
        self.screens.kiosk.let_go()
        self.shown.close()
        if Window.reuses_engine:
            # The window looks at the screens up to its own end.
            delete_now(self.shown)
            delete_now(self.owner)
            Window._left = self._engine
        else:
            delete_now(self._engine)

    @classmethod
    def begin_to_load(cls) -> None:
        """Load the screens on a thread of Qt's, while this one prepares what the next window shows.

        Without an application object nothing is loaded yet: whether there can be one is not known.
        """
        if cls._left is None and QGuiApplication.instance() is not None:
            refuse_network()
            cls._left = QQmlApplicationEngine()
            # The engine keeps it, and with it what it loads, until the window asks for the same file.
            beside = QQmlComponent.CompilationMode.Asynchronous
            QQmlComponent(cls._left, QUrl.fromLocalFile(str(QML)), beside, cls._left)

    @classmethod
    def drop_engine(cls) -> None:
        """Delete the engine that waits for the next window, if one does."""
        if cls._left is not None:
            delete_now(cls._left)
            cls._left = None

    def _load(self, settings: Settings, mode: RunMode) -> QQuickWindow:
        moving = settings.screen.motion and mode.pace is ClockMode.WALL
        self._engine.setInitialProperties(
            {
                **self.screens.by_name,
                "width": mode.size[0],
                "height": mode.size[1],
                "cardBack": QUrl.fromLocalFile(str(ASSETS / "cards" / "back.svg")),
                "cardShadow": QUrl.fromLocalFile(str(ASSETS / "cards" / "shadow.svg")),
                "textSize": settings.screen.text_size,
                "motion": MOTION_MS if moving else 0,
                "highContrast": settings.screen.contrast == "high",
                "screenKeys": settings.screen.keyboard,
                "boardOnRight": settings.screen.board_side == "right",
                "accent": settings.look.accent,
                "background": settings.look.background,
                "labName": settings.look.name,
                "labLogo": QUrl.fromLocalFile(str(settings.beside(settings.look.logo).absolute()))
                if settings.look.logo
                else QUrl(),
            }
        )
        self._engine.load(QUrl.fromLocalFile(str(QML)))
        window = self._engine.rootObjects()[-1]
        if not isinstance(window, QQuickWindow):
            raise TypeError(f"{QML} holds a {type(window).__name__}, not a window")
        return window


def delete_now(what: QObject) -> None:
    """Delete an object of Qt's now, and not when the event loop comes to it."""
    what.deleteLater()
    QCoreApplication.sendPostedEvents(what, QEvent.Type.DeferredDelete)


def check_screen(display: WindowMode) -> None:
    """Raise UserInputError where no window can be opened; Qt itself would end the process."""
    found = None if display is WindowMode.NOWHERE else obstacle()
    if found is not None:
        raise UserInputError(str(found))


def application(display: WindowMode, fonts: Sequence[Path] = ()) -> QGuiApplication:
    """Return the application object: drawn in software, in the basic loop, which no missing GPU can disturb.

    ``fonts`` are files of fonts for letters that the shipped one lacks.
    """
    draw_in_software()
    if display is WindowMode.NOWHERE:
        os.environ["QT_QPA_PLATFORM"] = "offscreen"
    existing = QGuiApplication.instance()
    application = existing if isinstance(existing, QGuiApplication) else QGuiApplication(["recollect"])
    application.setQuitOnLastWindowClosed(False)
    refuse_network()
    use_fonts(fonts)
    application.setWindowIcon(QIcon(str(ASSETS / "icon.svg")))
    return application


def refuse_network() -> None:
    """Keep Qt from connecting to any other machine, whatever a screen were to load.

    A proxy without a name refuses every request before it is sent. Qt asks no proxy about this machine's own addresses.
    A network access manager written in Python would cover those too, but Qt calls it in threads that the main thread
    waits for while it holds the interpreter, and the kiosk would hang.
    """
    QNetworkProxy.setApplicationProxy(QNetworkProxy(QNetworkProxy.ProxyType.HttpProxy, "", 0))
