"""The kiosk window: full screen, frameless, and left only by the experimenter."""

from __future__ import annotations

import logging
import os
from collections.abc import Callable, Iterable
from functools import partial
from typing import Protocol

from PySide6.QtCore import QEvent, QObject, Qt, QTimer
from PySide6.QtGui import QCursor, QGuiApplication, QInputDevice, QPointerEvent, QScreen, QWindow
from PySide6.QtQuick import QQuickWindow

from kiosk.robots.embodiment import Health
from kiosk.ui.qt_platform import numbered_screens

_log = logging.getLogger(__name__)


class FullScreen(QObject):
    """Puts the window over the screen of a number, or over the primary one without such a screen."""

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
        # Without a window manager a wish for the full screen is ignored: take its size as well.
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

    def show_on_every_desktop(self) -> None:
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

    def show_on_every_desktop(self) -> None:
        """Nothing can be done."""

    def clear(self) -> bool:
        """Nothing is seen."""
        return False

    def activate(self) -> None:
        """Qt has asked already."""

    def close(self) -> None:
        """Nothing is held."""


class FocusGuard(QObject):
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
            self._desktop.show_on_every_desktop()
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
        desktop.show_on_every_desktop()
        self._full_screen.cover()


REST_MS = 3000
"""How long the pointer stays after the mouse has come to rest."""

_MOVES = {QEvent.Type.MouseMove, QEvent.Type.MouseButtonPress, QEvent.Type.Wheel}


class CursorAutohide(QObject):
    """The pointer over one window."""

    def __init__(self, window: QWindow, parent: QObject | None = None) -> None:
        """Begin to watch the mouse; the pointer is there until it has been at rest."""
        super().__init__(parent)
        self._window = window
        self._hidden = False
        self._rest = QTimer(self)
        self._rest.setSingleShot(True)
        self._rest.setInterval(REST_MS)
        self._rest.timeout.connect(self.hide)
        self._rest.start()
        window.installEventFilter(self)

    @property
    def hidden(self) -> bool:
        """Whether the pointer cannot be seen."""
        return self._hidden

    def hide(self) -> None:
        """Take the pointer away."""
        if not self._hidden:
            self._hidden = True
            QGuiApplication.setOverrideCursor(QCursor(Qt.CursorShape.BlankCursor))

    def show(self) -> None:
        """Bring the pointer back, until the mouse has been at rest again."""
        self._rest.start()
        if self._hidden:
            self._hidden = False
            QGuiApplication.restoreOverrideCursor()

    def release(self) -> None:
        """Leave the pointer to itself."""
        self._window.removeEventFilter(self)
        self.show()
        self._rest.stop()

    def eventFilter(self, _: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        """Look at what the mouse does, and let everything pass."""
        if event.type() is QEvent.Type.TouchBegin:
            self.hide()
        elif event.type() in _MOVES and isinstance(event, QPointerEvent) and _by_mouse(event):
            self.show()
        return False


def _by_mouse(event: QPointerEvent) -> bool:
    """Whether a mouse did it; a finger is said to be a mouse where a program knows no fingers."""
    return event.device().type() is not QInputDevice.DeviceType.TouchScreen


class Inhibitor(Protocol):
    """One way to hold off the screen saver or sleep."""

    @property
    def name(self) -> str:
        """Who holds it off, in words for the experimenter."""
        ...

    def inhibit(self, told: Callable[[str | None], None]) -> None:
        """Ask for it; ``told`` is called with None when it is granted, or with why it is not. Never blocks."""
        ...

    def release(self) -> None:
        """Take back what was asked for."""
        ...


class KeepAwake:
    """Everything that holds off the screen saver and sleep."""

    def __init__(self, ways: Iterable[Inhibitor]) -> None:
        """Ask every way at once."""
        self._ways = tuple(ways)
        self._granted: list[str] = []
        self._refused: list[str] = []
        for way in self._ways:
            way.inhibit(partial(self._told, way.name))

    @property
    def health(self) -> Health:
        """Whether the screen stays lit, and thanks to whom."""
        if self._granted:
            return Health(is_ok=True, message=f"screen saver and sleep are held off by {', '.join(self._granted)}")
        why = "; ".join(self._refused) or "no service has answered yet"
        return Health(is_ok=False, message=f"screen saver and sleep are not held off: {why}")

    def release(self) -> None:
        """Let the screen go dark when it would."""
        for way in self._ways:
            way.release()

    def _told(self, name: str, why: str | None) -> None:
        if why is None:
            self._granted.append(name)
            return
        self._refused.append(f"{name}: {why}")
        _log.warning("screen saver and sleep are not held off by %s: %s", name, why)


class KioskWindow:
    """A window that covers one screen and that no visitor leaves, on a machine that stays awake."""

    def __init__(self, window: QQuickWindow, number: int, owner: QObject) -> None:
        """Cover the screen of this number; whatever takes time waits for the first frame."""
        self._window = window
        self._full_screen = FullScreen(window, number, owner)
        self._hold = FocusGuard(window, self._full_screen, lambda: desktop_of(window), owner)
        self._pointer = CursorAutohide(window, owner)
        self._awake: KeepAwake | None = None
        # Once the screen can be tapped.
        self._asking = QTimer(owner)
        self._asking.setSingleShot(True)
        self._asking.timeout.connect(self._keep_awake)
        self._waits_for_frame = True
        window.frameSwapped.connect(self._follow_frame)

    @property
    def health(self) -> tuple[Health, ...]:
        """How well the window is held, and whether the screen stays lit."""
        covers, has_input = self._full_screen.covers, self._hold.has_input
        held = "the window covers its screen" if covers else "the window does not cover its screen"
        gets = "and gets every key and click" if has_input else "but the desktop gets some keys or clicks first"
        awake = Health(is_ok=False, message="screen saver and sleep are not held off yet")
        return (
            Health(is_ok=covers and has_input, message=f"{held}, {gets}"),
            awake if self._awake is None else self._awake.health,
        )

    def release(self) -> None:
        """Give back the keyboard, the pointer and the screen saver."""
        self._hold.release()
        self._pointer.release()
        if self._awake is not None:
            self._awake.release()
        self._stop_waiting()
        self._asking.stop()

    def _follow_frame(self) -> None:
        self._stop_waiting()
        self._asking.start(0)

    def _stop_waiting(self) -> None:
        if self._waits_for_frame:
            self._waits_for_frame = False
            self._window.frameSwapped.disconnect(self._follow_frame)

    def _keep_awake(self) -> None:
        from kiosk.ui.keep_awake import all_inhibitors  # noqa: PLC0415 - D-Bus is loaded when the first frame is out

        self._awake = KeepAwake(all_inhibitors())


def desktop_of(window: QQuickWindow) -> Desktop:
    """Return what there is to tell of the desktop that shows a window."""
    if QGuiApplication.platformName() != "xcb":
        return OpenDesktop()
    from kiosk.ui.x11 import XServer, XWayland  # noqa: PLC0415 - only where there is an X server

    server = XWayland if "WAYLAND_DISPLAY" in os.environ else XServer
    return server(int(window.winId()))
