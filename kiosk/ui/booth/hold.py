"""Keeps the window in front, with the keyboard, whatever a visitor presses or another program does.

Law: it never asks why the window was left; it takes it back, at once where Qt tells of it, else at the next look.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from PySide6.QtCore import QObject, QTimer
from PySide6.QtGui import QWindow

from kiosk.ui.booth.full_screen import FullScreen

LOOK_MS = 250
"""How often to see that nothing lies over the window; what leaves it is back within a second."""


class Desktop(Protocol):
    """What of the desktop can be told to let the window be, beyond what Qt can."""

    def stick(self) -> None:
        """Show the window on every desktop, so that changing desktops does not leave it."""
        ...

    def clear(self) -> bool:
        """Put whatever lies over the window below it; whether something did."""
        ...

    def close(self) -> None:
        """Let go of the desktop."""
        ...


class OpenDesktop:
    """A desktop of which nothing is known beyond what Qt knows."""

    def stick(self) -> None:
        """Nothing can be done."""

    def clear(self) -> bool:
        """Nothing is seen."""
        return False

    def close(self) -> None:
        """Nothing is held."""


class Hold(QObject):
    """Holds one full-screen window until it is released."""

    def __init__(
        self, window: QWindow, full_screen: FullScreen, desktop: Callable[[], Desktop], parent: QObject | None = None
    ) -> None:
        """Begin to hold; ``desktop`` is asked for when the first frame is out."""
        super().__init__(parent)
        self._window = window
        self._full_screen = full_screen
        self._find_desktop = desktop
        self._desktop: Desktop | None = None
        self._keyboard = False
        self._looking = QTimer(self)
        self._looking.setInterval(LOOK_MS)
        self._looking.timeout.connect(self._take_back)
        self._looking.start()
        self._changes = (window.activeChanged, window.visibilityChanged, window.xChanged, window.yChanged)
        self._soon = QTimer(self)
        self._soon.setSingleShot(True)
        self._soon.timeout.connect(self._take_back)
        for changed in self._changes:
            changed.connect(self._look_soon)

    @property
    def has_keyboard(self) -> bool:
        """Whether every key goes to the window first, before any desktop's own use of it."""
        return self._keyboard

    def release(self) -> None:
        """Let the window be left."""
        self._looking.stop()
        self._soon.stop()
        for changed in self._changes:
            changed.disconnect(self._look_soon)
        self._window.setKeyboardGrabEnabled(False)
        if self._desktop is not None:
            self._desktop.close()

    def _look_soon(self, *_: object) -> None:
        self._soon.start(0)

    def _take_back(self) -> None:
        if self._desktop is None:
            self._desktop = self._find_desktop()
            self._desktop.stick()
        if not self._full_screen.covers:
            self._full_screen.cover()
        covered = self._desktop.clear()
        if covered or not self._window.isActive():
            self._window.raise_()
            self._window.requestActivate()
        # While a window is hidden, and while another program has the keyboard, it cannot be taken; so ask again.
        self._keyboard = self._window.setKeyboardGrabEnabled(True)
