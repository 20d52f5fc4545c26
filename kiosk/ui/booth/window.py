"""The window at a booth, put together from what each does for it; opened with the kiosk and released with it."""

from __future__ import annotations

import os

from PySide6.QtCore import QObject
from PySide6.QtGui import QGuiApplication
from PySide6.QtQuick import QQuickWindow

from kiosk.robot.body import Health
from kiosk.ui.booth.awake import Awake
from kiosk.ui.booth.full_screen import FullScreen
from kiosk.ui.booth.hold import Desktop, Hold, OpenDesktop
from kiosk.ui.booth.pointer import Pointer


class BoothWindow:
    """A window that covers one screen and that no visitor leaves, on a machine that stays awake."""

    def __init__(self, window: QQuickWindow, number: int, owner: QObject) -> None:
        """Cover the screen of this number; whatever takes time waits for the first frame."""
        self._window = window
        self._full_screen = FullScreen(window, number, owner)
        self._hold = Hold(window, self._full_screen, lambda: desktop_of(window), owner)
        self._pointer = Pointer(window, owner)
        self._awake: Awake | None = None
        window.frameSwapped.connect(self._keep_awake)

    @property
    def health(self) -> tuple[Health, ...]:
        """How well the window is held, and whether the screen stays lit."""
        covers, has_input = self._full_screen.covers, self._hold.has_input
        held = "the window covers its screen" if covers else "the window does not cover its screen"
        gets = "and gets every key and click" if has_input else "but the desktop gets some keys or clicks first"
        awake = Health(well=False, words="screen saver and sleep are not held off yet")
        return (
            Health(well=covers and has_input, words=f"{held}, {gets}"),
            awake if self._awake is None else self._awake.health,
        )

    def release(self) -> None:
        """Give back the keyboard, the pointer and the screen saver."""
        self._hold.release()
        self._pointer.release()
        if self._awake is not None:
            self._awake.release()
        else:
            self._window.frameSwapped.disconnect(self._keep_awake)

    def _keep_awake(self) -> None:
        self._window.frameSwapped.disconnect(self._keep_awake)
        from kiosk.ui.booth.ways import ways  # noqa: PLC0415 - D-Bus is loaded when the first frame is out

        self._awake = Awake(ways())


def desktop_of(window: QQuickWindow) -> Desktop:
    """What there is to tell of the desktop that shows a window."""
    if QGuiApplication.platformName() != "xcb":
        return OpenDesktop()
    from kiosk.ui.booth.x_server import XServer, XWayland  # noqa: PLC0415 - only where there is an X server

    server = XWayland if "WAYLAND_DISPLAY" in os.environ else XServer
    return server(int(window.winId()))
