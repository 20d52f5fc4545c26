"""While the card is up, what is typed goes to it alone, wherever the keyboard is: no digit of a PIN gets into a form.

Chords pass. So does everything while the card is away.
"""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent, QWindow

from kiosk.ui.panel.asking import Asking

_KEYS = (QEvent.Type.KeyPress, QEvent.Type.KeyRelease, QEvent.Type.ShortcutOverride)
_SIGNS_OF_LIFE = (
    QEvent.Type.KeyPress,
    QEvent.Type.MouseButtonPress,
    QEvent.Type.MouseMove,
    QEvent.Type.Wheel,
    QEvent.Type.TouchBegin,
)
_CHORD = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.AltModifier | Qt.KeyboardModifier.MetaModifier


class Keyboard(QObject):
    """Stands before the window as long as the experimenter is at something, and not a moment longer."""

    def __init__(self, window: QWindow, asking: Asking, stirred: Callable[[], None], parent: QObject) -> None:
        """``stirred`` is told of every sign of the experimenter's hand."""
        super().__init__(parent)
        self._window = window
        self._asking = asking
        self._stirred = stirred
        self._stands = False

    def stand(self, stands: bool) -> None:  # noqa: FBT001 - it is what is set
        """Look at what comes to the window, or at nothing."""
        if stands is self._stands:
            return
        self._stands = stands
        if stands:
            self._window.installEventFilter(self)
        else:
            self._window.removeEventFilter(self)

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        """Take what is meant for the card; whether it was taken."""
        if event.type() in _SIGNS_OF_LIFE:
            self._stirred()
        if not self._asking.asks or event.type() not in _KEYS or not isinstance(event, QKeyEvent):
            return False
        if event.modifiers() & _CHORD:
            return False
        # A key that is held down counts once, but for the one that deletes.
        once = not event.isAutoRepeat() or event.key() == Qt.Key.Key_Backspace
        if event.type() == QEvent.Type.KeyPress and once:
            self._take(event)
        event.accept()
        return True

    def _take(self, key: QKeyEvent) -> None:
        match key.key():
            case Qt.Key.Key_Escape:
                self._asking.cancel()
            case Qt.Key.Key_Backspace:
                self._asking.erase()
            case Qt.Key.Key_Return | Qt.Key.Key_Enter:
                self._asking.enter()
            case _ if key.text():
                self._asking.type(key.text())
