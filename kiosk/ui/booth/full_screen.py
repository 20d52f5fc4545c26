"""Keeps a window over the whole of one screen, whatever is plugged in, pulled out or resized meanwhile.

Law: it decides where the window is and nothing else.
"""

from __future__ import annotations

import logging

from PySide6.QtCore import QObject, Qt, QTimer
from PySide6.QtGui import QGuiApplication, QScreen, QWindow

_log = logging.getLogger(__name__)


def numbered_screens() -> list[QScreen]:
    """All screens, the primary one first, the others in the system's order."""
    primary = QGuiApplication.primaryScreen()
    return [primary, *(screen for screen in QGuiApplication.screens() if screen is not primary)]


class FullScreen(QObject):
    """Puts the window over the screen of a number, or over the primary one as long as there is none of that number."""

    def __init__(self, window: QWindow, number: int, parent: QObject | None = None) -> None:
        """Cover the screen now, and go on doing so."""
        super().__init__(parent)
        self._window = window
        self._number = number
        self._covered: QScreen | None = None
        self._missed = False
        # Several things change at once when a screen is plugged in; look when all of them have.
        self._soon = QTimer(self)
        self._soon.setSingleShot(True)
        self._soon.setInterval(0)
        self._soon.timeout.connect(self.cover)
        application = QGuiApplication.instance()
        if isinstance(application, QGuiApplication):
            for changed in (application.screenAdded, application.screenRemoved, application.primaryScreenChanged):
                changed.connect(self._look_again)
        window.setFlags(window.flags() | Qt.WindowType.FramelessWindowHint | Qt.WindowType.WindowStaysOnTopHint)
        self.cover()

    @property
    def covers(self) -> bool:
        """Whether the window is shown over the whole of its screen."""
        return (
            self._covered is not None
            and self._window.visibility() is QWindow.Visibility.FullScreen
            and self._window.geometry() == self._covered.geometry()
        )

    def cover(self) -> None:
        """Cover the screen, wherever the window was."""
        screen = self._choose()
        if screen is not self._covered:
            self._follow(screen)
        if self._window.screen() is not screen:
            self._window.setScreen(screen)
        # Without a window manager nobody obeys a wish for the full screen: take its size as well.
        if self._window.geometry() != screen.geometry():
            self._window.setGeometry(screen.geometry())
        self._window.showFullScreen()

    def _choose(self) -> QScreen:
        screens = numbered_screens()
        missed = self._number >= len(screens)
        if missed and not self._missed:
            _log.warning("there is no screen %d, so the primary one is taken; there are %d", self._number, len(screens))
        self._missed = missed
        return screens[0] if missed else screens[self._number]

    def _follow(self, screen: QScreen) -> None:
        """Cover this screen also after its resolution has changed."""
        if self._covered is not None and self._covered in QGuiApplication.screens():
            self._covered.geometryChanged.disconnect(self._look_again)
        self._covered = screen
        screen.geometryChanged.connect(self._look_again)

    def _look_again(self, *_: object) -> None:
        self._soon.start()
