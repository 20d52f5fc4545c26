"""A strip of one line for the experimenter on a second screen, with the board of the session."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from datetime import datetime
from pathlib import Path

from PySide6.QtCore import QMetaObject, QObject, QRect, Qt, QTimer, QUrl
from PySide6.QtGui import QGuiApplication, QScreen
from PySide6.QtQml import QQmlComponent, QQmlEngine
from PySide6.QtQuick import QQuickWindow

from kiosk.assistance.wording import Catalogue
from kiosk.experiment.alarms import AlarmKind
from kiosk.experiment.booth_status import CLOSED, BoothStatus
from kiosk.ui.experimenter.alarms import alarm_words
from kiosk.ui.experimenter.panel_rows import stage_name
from kiosk.ui.qt_platform import numbered_screens
from kiosk.ui.window import delete_now
from kiosk.units import MS_PER_MINUTE, MS_PER_SECOND

QML = Path(__file__).parent.parent / "qml" / "panel" / "OperatorStrip.qml"
SHARE, LEAST_HIGH = 0.09, 72
"""How much of the screen's height the strip takes, and how many pixels at least."""

_log = logging.getLogger(__name__)


def operator_screen(screens: Sequence[QScreen], number: int, visitors: int = 0) -> QScreen | None:
    """Return the screen of a number, or None if there is none, or if the visitors' window has taken it.

    That happens where the visitors' own screen is missing: the strip is never shown to them instead.
    """
    return screens[number] if max(number, visitors) < len(screens) else None


def strip_place(screen: QRect) -> QRect:
    """Return where the strip lies on a screen: along its lower edge."""
    height = max(LEAST_HIGH, round(screen.height() * SHARE))
    return QRect(screen.x(), screen.y() + screen.height() - height, screen.width(), height)


class OperatorStrip:
    """Shows the booth's status as it is published, which never has a condition, a code or an answer."""

    def __init__(self, engine: QQmlEngine, board: QObject, catalogue: Catalogue) -> None:
        """Make the window, with the board of the visitor's one; it is not shown yet."""
        self._catalogue = catalogue
        self._number = self._visitors = 0
        self._screen: QScreen | None = None
        self._looked = False
        self._connections: list[QMetaObject.Connection] = []
        # Several things change at once when a screen is plugged in; look when all of them have.
        self._soon = QTimer()
        self._soon.setSingleShot(True)
        self._soon.setInterval(0)
        self._soon.timeout.connect(self.look)
        # Kept, for what it made goes with it.
        self._component = QQmlComponent(engine, QUrl.fromLocalFile(str(QML)))
        window = self._component.createWithInitialProperties({"board": board})
        if not isinstance(window, QQuickWindow):
            raise TypeError(f"{QML} is no window: {self._component.errorString()}")
        self.window = window
        """Qt's own window."""
        # The keyboard is the visitor's, or the kiosk's shortcuts would be lost.
        never_active = Qt.WindowType.FramelessWindowHint | Qt.WindowType.WindowDoesNotAcceptFocus
        window.setFlags(window.flags() | never_active | Qt.WindowType.WindowStaysOnTopHint)

    def follow(self, number: int, visitors: int = 0) -> None:
        """Show it on the screen of a number whenever that is there, and nowhere while it is not."""
        self._number, self._visitors = number, visitors
        application = QGuiApplication.instance()
        if isinstance(application, QGuiApplication):
            changes = (application.screenAdded, application.screenRemoved, application.primaryScreenChanged)
            self._connections = [change.connect(self._look_again) for change in changes]
        self.look()

    def look(self) -> None:
        """See whether its screen is there."""
        screens = numbered_screens()
        screen = operator_screen(screens, self._number, self._visitors)
        if screen is None:
            if self.window.isVisible() or not self._looked:
                _log.warning(
                    "the experimenter's strip is not shown: there is no screen %d; there are %d",
                    max(self._number, self._visitors),
                    len(screens),
                )
            self.window.hide()
        else:
            self._shown_on(screen)
            self.show(screen)
        self._looked = True

    def show(self, screen: QScreen) -> None:
        """Show it along the lower edge of a screen."""
        # A window manager may have moved it meanwhile, which Qt hears late: it is placed anew.
        self.window.hide()
        self.window.setScreen(screen)
        self.window.setGeometry(strip_place(screen.geometry()))
        self.window.show()

    def _shown_on(self, screen: QScreen) -> None:
        """Look again when the resolution of this screen has changed."""
        if self._screen is not None and self._screen in QGuiApplication.screens():
            self._screen.geometryChanged.disconnect(self._look_again)
        self._screen = screen
        screen.geometryChanged.connect(self._look_again)

    def _look_again(self, *_: object) -> None:
        self._soon.start()

    def update(self, status: BoothStatus) -> None:
        """Show how the booth is now; a kiosk that is being left takes the strip with it."""
        if status.stage == CLOSED:
            return
        now = datetime.fromisoformat(status.at)
        words = self._words(status)
        self.window.setProperty("clock", f"{now.astimezone():%H:%M}")
        self.window.setProperty("tiles", list(self._tiles(status, now)))
        self.window.setProperty("words", words or self._catalogue.text("console-all-well"))
        self.window.setProperty("well", not words)

    def close(self) -> None:
        """Close it, before the board that it looks at goes with the visitor's window."""
        for connection in self._connections:
            QObject.disconnect(connection)
        self._soon.stop()
        self.window.close()
        delete_now(self.window)

    def _tiles(self, status: BoothStatus, now: datetime) -> Sequence[dict[str, str]]:
        say, day = self._catalogue.text, status.today
        minutes = (
            int((now - datetime.fromisoformat(status.stage_since)).total_seconds() * MS_PER_SECOND) // MS_PER_MINUTE
        )
        stage = f"{stage_name(status.stage, self._catalogue)}, {say('console-today-minutes', minutes=minutes)}"
        return [
            {"title": say("console-today-visitors"), "value": f"{day.begun}"},
            {"title": say("console-today-completed"), "value": f"{day.completed}"},
            {"title": say("console-today-stage"), "value": stage},
        ]

    def _words(self, status: BoothStatus) -> str:
        """Return what is wrong: the alarms that hold, and the parts that fail."""
        alarms = [alarm_words(AlarmKind(each.kind), self._catalogue) for each in status.holding_alarms]
        return "; ".join((*alarms, *(f"{part.name}: {part.message}" for part in status.failing)))
