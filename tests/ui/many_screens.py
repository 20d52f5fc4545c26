"""A program for tests: the booth's window on several faked screens, and where it is after each thing that happens.

``python -m tests.ui.many_screens NUMBER`` prints one JSON object; the screens are those of ``QT_QPA_PLATFORM``.
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
from kiosk.ui.displays import numbered_screens
from kiosk.ui.kiosk_window import KioskWindow


def main(number: int) -> None:
    """Open the window on a screen, pull that screen out, and plug it in again."""
    told: list[str] = []
    handler = logging.Handler()
    handler.addFilter(lambda record: "there is no screen" in record.getMessage())
    handler.emit = lambda record: told.append(record.getMessage())  # type: ignore[method-assign]
    logging.getLogger("kiosk.ui.kiosk_window").addHandler(handler)
    application = QGuiApplication(["many screens"])
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
    sys.stdout.write(json.dumps({"places": found, "told": told, "ratio": window.devicePixelRatio()}))
    booth.release()


def place(window: QQuickWindow) -> list[int]:
    """Where the window is once everything has been told."""
    for _ in range(3):
        QCoreApplication.processEvents()
    shape = window.geometry()
    return [shape.x(), shape.y(), shape.width(), shape.height()]


if __name__ == "__main__":
    main(int(sys.argv[1]))
