"""Drops the repetitions of a key that is held down, so that no control is pressed more than once.

Keys that move or scroll repeat everywhere, and keys that type repeat in a text field.
"""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtQuick import QQuickItem, QQuickWindow

_KEYS = (QEvent.Type.KeyPress, QEvent.Type.KeyRelease, QEvent.Type.ShortcutOverride)
_MOVING = frozenset(
    {
        Qt.Key.Key_Left,
        Qt.Key.Key_Right,
        Qt.Key.Key_Up,
        Qt.Key.Key_Down,
        Qt.Key.Key_PageUp,
        Qt.Key.Key_PageDown,
        Qt.Key.Key_Home,
        Qt.Key.Key_End,
        Qt.Key.Key_Tab,
        Qt.Key.Key_Backtab,
    }
)
_NEVER_TYPED = frozenset({Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Select, Qt.Key.Key_Escape})


class HeldKeys(QObject):
    """Filters the keys that come to a window."""

    def __init__(self, window: QQuickWindow, parent: QObject) -> None:
        """Stand before this window until ``parent`` goes."""
        super().__init__(parent)
        self._window = window
        window.installEventFilter(self)

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        """Take a repetition that would press something; return whether it was taken."""
        if event.type() not in _KEYS or not isinstance(event, QKeyEvent) or not event.isAutoRepeat():
            return False
        key = event.key()
        if key in _MOVING or (key not in _NEVER_TYPED and self._types()):
            return False
        # An override that is accepted keeps the key from shortcuts too.
        event.accept()
        return True

    def _types(self) -> bool:
        """Whether the keyboard is at a text field."""
        item: QQuickItem | None = self._window.activeFocusItem()
        return item is not None and item.inherits("QQuickTextInput")
