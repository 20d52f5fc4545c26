"""Hides the pointer while nobody moves the mouse; a finger never shows it."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt, QTimer
from PySide6.QtGui import QCursor, QGuiApplication, QInputDevice, QPointerEvent, QWindow

REST_MS = 3000
"""How long the pointer stays after the mouse has come to rest."""

_MOVES = {QEvent.Type.MouseMove, QEvent.Type.MouseButtonPress, QEvent.Type.Wheel}


class Pointer(QObject):
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
