"""Keeps the window in front, with the keyboard, whatever a visitor presses or another program does.

Law: it never asks why the window was left; it takes it back, at once where Qt tells of it, else at the next look.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from PySide6.QtCore import QObject, QTimer
from PySide6.QtGui import QGuiApplication, QWindow

from kiosk.ui.booth.full_screen import FullScreen

LOOK_MS = 250
"""How often to see that nothing lies over the window; what leaves it is back within a second."""
HIDDEN_LOOKS = 2
"""After so many looks at which the window was on no screen it is shown anew."""
IDLE_LOOKS = 2
"""The same for a window that does not get or keep the keyboard, however often it asks; each time twice as many."""
OBEYING = {"xcb", "windows"}
"""Where a window can raise itself and take every key and click; elsewhere Qt would only complain."""


class Desktop(Protocol):
    """What of the desktop can be told to let the window be, beyond what Qt can."""

    def stick(self) -> None:
        """Show the window on every desktop, so that changing desktops does not leave it."""
        ...

    def clear(self) -> bool:
        """Put whatever lies over the window below it; whether something did, or had the keyboard."""
        ...

    def activate(self) -> None:
        """Have the keyboard given to the window, even where a program may not ask for it on its own account."""
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

    def activate(self) -> None:
        """Qt has asked already."""

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
        self._has_input = False
        self._lost = False
        self._hidden = self._idle = 0
        self._patience = IDLE_LOOKS
        self._looking = QTimer(self)
        self._looking.setInterval(LOOK_MS)
        self._looking.timeout.connect(self._look)
        self._looking.start()
        self._changes = (window.activeChanged, window.visibilityChanged, window.xChanged, window.yChanged)
        self._soon = QTimer(self)
        self._soon.setSingleShot(True)
        self._soon.timeout.connect(self._take_back)
        for changed in self._changes:
            changed.connect(self._look_soon)

    @property
    def has_input(self) -> bool:
        """Whether every key and every click goes to the window first, before any desktop's own use of it."""
        return self._has_input

    def release(self) -> None:
        """Let the window be left."""
        self._looking.stop()
        self._soon.stop()
        for changed in self._changes:
            changed.disconnect(self._look_soon)
        self._grab(grab=False)
        if self._desktop is not None:
            self._desktop.close()

    def _look_soon(self, *_: object) -> None:
        self._lost = self._lost or not self._window.isActive()
        self._soon.start(0)

    def _look(self) -> None:
        if self._desktop is None:
            self._desktop = self._find_desktop()
            self._desktop.stick()
        self._count()
        if self._hidden >= HIDDEN_LOOKS or self._idle >= self._patience:
            self._show_anew(self._desktop)
        self._take_back()

    def _take_back(self) -> None:
        if not self._full_screen.covers:
            self._full_screen.cover()
        covered = self._desktop is not None and self._desktop.clear()
        self._lost = self._lost or covered
        if covered or not self._window.isActive():
            if self._is_obeyed:
                self._window.raise_()
            self._window.requestActivate()
            if self._desktop is not None:
                self._desktop.activate()
        # While a window is hidden, and while another program has them, they cannot be taken; so ask again.
        self._has_input = self._grab(grab=True)

    @property
    def _is_obeyed(self) -> bool:
        return QGuiApplication.platformName() in OBEYING

    def _grab(self, *, grab: bool) -> bool:
        """Take every key and click before the desktop does, or stop; whether that was done."""
        if not self._is_obeyed:
            return False
        keyboard, mouse = self._window.setKeyboardGrabEnabled(grab), self._window.setMouseGrabEnabled(grab)
        return keyboard and mouse

    def _count(self) -> None:
        """For how many looks the window has been hidden, and without the keyboard or covered."""
        self._hidden = 0 if self._window.isExposed() else self._hidden + 1
        kept = self._window.isActive() and not self._lost
        self._idle = 0 if kept else self._idle + 1
        self._lost = False
        if not self._idle:
            self._patience = IDLE_LOOKS

    def _show_anew(self, desktop: Desktop) -> None:
        """Come as a new window, which every desktop shows in front."""
        if not self._hidden:
            self._patience *= 2
        self._hidden = self._idle = 0
        self._window.hide()
        desktop.stick()
        self._full_screen.cover()
