"""A program for tests: the booth's window on several faked screens, and where it is after each thing that happens.

``python -m tests.ui.many_screens NUMBER...`` prints a JSON object for each number of a screen; the screens are those of
``QT_QPA_PLATFORM``.
"""

from __future__ import annotations

import json
import logging
import sys
from unittest.mock import patch

from PySide6.QtCore import QCoreApplication, QObject
from PySide6.QtGui import QGuiApplication
from PySide6.QtQuick import QQuickWindow

from kiosk.ui import kiosk_window
from kiosk.ui.kiosk_window import KioskWindow
from kiosk.ui.qt_platform import numbered_screens
from kiosk.ui.window import delete_now


def main(numbers: list[int]) -> None:
    """Open a window on each of these screens in turn."""
    application = QGuiApplication(["many screens"])
    sys.stdout.write(json.dumps({number: seen(application, number) for number in numbers}))


def seen(application: QGuiApplication, number: int) -> dict[str, object]:
    """Return where a window is on this screen, when that is pulled out and plugged in again, and what was logged."""
    told: list[str] = []
    handler = logging.Handler()
    handler.addFilter(lambda record: "there is no screen" in record.getMessage())
    handler.emit = lambda record: told.append(record.getMessage())  # type: ignore[method-assign]
    logging.getLogger("kiosk.ui.kiosk_window").addHandler(handler)
    owner, window = QObject(), QQuickWindow()
    booth = KioskWindow(window, number, owner)
    found = {"at first": place(window)}
    screens = numbered_screens()
    with patch.object(kiosk_window, "numbered_screens", lambda: screens[:1]):
        application.screenRemoved.emit(screens[-1])
        found["pulled out"] = place(window)
    application.screenAdded.emit(screens[-1])
    found["plugged in"] = place(window)
    window.setGeometry(10, 10, 100, 100)
    screens[0].geometryChanged.emit(screens[0].geometry())
    found["resized"] = place(window)
    booth.release()
    logging.getLogger("kiosk.ui.kiosk_window").removeHandler(handler)
    ratio = window.devicePixelRatio()
    delete_now(owner)
    delete_now(window)
    return {"places": found, "told": told, "ratio": ratio}


def place(window: QQuickWindow) -> list[int]:
    """Where the window is once everything has been told."""
    for _ in range(3):
        QCoreApplication.processEvents()
    shape = window.geometry()
    return [shape.x(), shape.y(), shape.width(), shape.height()]


if __name__ == "__main__":
    main([int(number) for number in sys.argv[1:]])
