"""The calm window that lies underneath the kiosk, and is seen while the kiosk is started again.

The supervisor starts it in its own process before the kiosk, so it is there when the kiosk's window goes.
It takes no input, speaks every language at once, and goes when the supervisor is gone. It loads no more than it shows.
"""

from __future__ import annotations

import os
import signal
from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import Qt, QTimer, QUrl
from PySide6.QtGui import QFont, QFontDatabase, QGuiApplication
from PySide6.QtQml import QQmlApplicationEngine
from PySide6.QtQuick import QQuickWindow

from kiosk.places import ASSETS
from kiosk.sd_notify import Notifier
from kiosk.ui.event_loop import after_first_frame
from kiosk.ui.qt_platform import draw_in_software

# PySide6.QtQuick must be known before a window is asked for, or it comes back as a plain QWindow.


QML = Path(__file__).parent / "qml" / "Splash.qml"
LOOK_MS = 1000
"""How often it is seen whether the supervisor is still there."""


def show_splash(lines: Sequence[str]) -> None:
    """Show these lines until the supervisor is gone, or ends this process."""
    draw_in_software()
    # Python hears nothing while nothing happens here; let the system end the process itself.
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    application = QGuiApplication(["recollect"])
    QFontDatabase.addApplicationFont(str(ASSETS / "fonts" / "NotoSans-Regular.ttf"))
    application.setFont(QFont("Noto Sans"))
    engine = QQmlApplicationEngine()
    window = _window(engine, lines)
    supervisor = Notifier(os.environ)
    after_first_frame(window, lambda: supervisor.tell(READY=1))
    looking = QTimer()
    # Not quit, which asks the window, and it refuses everybody.
    looking.timeout.connect(lambda: None if supervisor.tell(WATCHDOG=1) else application.exit())
    looking.start(LOOK_MS)
    application.exec()
    del engine


def _window(engine: QQmlApplicationEngine, lines: Sequence[str]) -> QQuickWindow:
    """Return the window, over the whole screen; it asks for no focus, which is the kiosk's."""
    engine.setInitialProperties({"lines": list(lines), "icon": QUrl.fromLocalFile(str(ASSETS / "icon.svg"))})
    engine.load(QUrl.fromLocalFile(str(QML)))
    window = engine.rootObjects()[0]
    if not isinstance(window, QQuickWindow):
        raise TypeError(f"{QML} holds a {type(window).__name__}, not a window")
    still = Qt.WindowType.FramelessWindowHint | Qt.WindowType.WindowDoesNotAcceptFocus
    window.setFlags(window.flags() | still)
    window.setGeometry(window.screen().geometry())
    # Not showFullScreen, which asks for the focus.
    window.setWindowStates(Qt.WindowState.WindowFullScreen)
    window.setVisible(True)
    return window
