"""The ways to hold off the screen saver and sleep: services on D-Bus, the X server, Windows.

Law: no way blocks the window, and none is asked before the first frame is out.
"""

from __future__ import annotations

import ctypes
import os
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

from PySide6.QtDBus import QDBusConnection, QDBusMessage, QDBusPendingCallWatcher
from PySide6.QtGui import QGuiApplication

from kiosk.ui.kiosk_window import Inhibitor

ANSWER_MS = 2000
"""How long a service may take to answer that it will hold off."""

WHO = "Recollect"
WHY = "a kiosk is open"

_ES_CONTINUOUS = 0x80000000
_ES_SYSTEM_REQUIRED = 0x00000001
_ES_DISPLAY_REQUIRED = 0x00000002


class DBusInhibitor:
    """A service on D-Bus that holds off sleep as long as the caller is connected."""

    def __init__(self, name: str, bus: QDBusConnection.BusType, call: tuple[str, str, str, list[str]]) -> None:
        """``call`` is the service, the path, the interface, and the arguments of its method Inhibit."""
        self.name = name
        self._bus_type = bus
        self._call = call
        self._own = f"recollect awake {name}"
        self._asked: QDBusPendingCallWatcher | None = None
        self._kept: QDBusMessage | None = None

    def inhibit(self, told: Callable[[str | None], None]) -> None:
        """Ask on a connection of its own; closing it takes the wish back."""
        if not _has_bus(self._bus_type):
            told("there is no bus")
            return
        bus = QDBusConnection.connectToBus(self._bus_type, self._own)
        if not bus.isConnected():
            told(bus.lastError().message())
            return
        service, path, interface, arguments = self._call
        message = QDBusMessage.createMethodCall(service, path, interface, "Inhibit")
        message.setArguments(arguments)
        self._asked = QDBusPendingCallWatcher(bus.asyncCall(message, ANSWER_MS))
        self._asked.finished.connect(lambda: self._answered(told))

    def release(self) -> None:
        """Take the wish back."""
        self._kept = self._asked = None
        QDBusConnection.disconnectFromBus(self._own)

    def _answered(self, told: Callable[[str | None], None]) -> None:
        asked, self._asked = self._asked, None
        if asked is None:
            return
        # What holds sleep off is a file within the answer: as long as it is kept, so is the promise.
        self._kept = asked.reply()
        failed = self._kept.type() is QDBusMessage.MessageType.ErrorMessage
        told(self._kept.errorMessage() if failed else None)


class XInhibitor:
    """The X server's own screen saver and power saving, which obey no service."""

    name = "the X server"

    def __init__(self) -> None:
        """Nothing is changed yet."""
        self._restore: Callable[[], None] | None = None

    def inhibit(self, told: Callable[[str | None], None]) -> None:
        """Switch both off, and remember how they were."""
        from kiosk.ui.x11 import keep_lit  # noqa: PLC0415 - only where there is an X server

        try:
            self._restore = keep_lit()
        except OSError as error:
            told(str(error))
        else:
            told(None)

    def release(self) -> None:
        """Set both as they were."""
        if self._restore is not None:
            self._restore()
            self._restore = None


class WindowsInhibitor:
    """Windows, which holds off as long as the program runs or until it says otherwise."""

    name = "Windows"

    def inhibit(self, told: Callable[[str | None], None]) -> None:
        """Ask for the system and the display."""
        granted = _set_execution_state(_ES_CONTINUOUS | _ES_SYSTEM_REQUIRED | _ES_DISPLAY_REQUIRED)
        told(None if granted else "it refused")

    def release(self) -> None:
        """Ask for nothing any more."""
        _set_execution_state(_ES_CONTINUOUS)


def all_inhibitors() -> Iterator[Inhibitor]:
    """Every way that this system may know."""
    if sys.platform == "win32":
        yield WindowsInhibitor()
        return
    if QGuiApplication.platformName() == "xcb":
        yield XInhibitor()
    if sys.platform.startswith("linux"):
        yield DBusInhibitor(
            "the desktop",
            QDBusConnection.BusType.SessionBus,
            ("org.freedesktop.ScreenSaver", "/org/freedesktop/ScreenSaver", "org.freedesktop.ScreenSaver", [WHO, WHY]),
        )
        yield DBusInhibitor(
            "the system",
            QDBusConnection.BusType.SystemBus,
            (
                "org.freedesktop.login1",
                "/org/freedesktop/login1",
                "org.freedesktop.login1.Manager",
                ["idle:sleep", WHO, WHY, "block"],
            ),
        )


def _has_bus(kind: QDBusConnection.BusType) -> bool:
    """Whether there is such a bus; where there is none, Qt would first try to start one."""
    if kind is QDBusConnection.BusType.SystemBus:
        address, usual = "DBUS_SYSTEM_BUS_ADDRESS", Path("/run/dbus/system_bus_socket")
    else:
        address, usual = "DBUS_SESSION_BUS_ADDRESS", Path(os.environ.get("XDG_RUNTIME_DIR", "/nowhere")) / "bus"
    return address in os.environ or usual.exists()


def _set_execution_state(state: int) -> bool:
    return bool(getattr(ctypes, "windll").kernel32.SetThreadExecutionState(state))  # noqa: B009 - only on Windows
