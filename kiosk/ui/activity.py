"""Notices that a visitor does something to the screen, and takes anything they do for an answer to "still there?".

A mouse that is only moved does nothing: a table that is bumped moves it too.
"""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent, QMouseEvent
from PySide6.QtQuick import QQuickWindow

from kiosk.ui.clock import Clock
from kiosk.ui.screens.plain import KioskScreen

_HAND = frozenset({QEvent.Type.MouseButtonPress, QEvent.Type.TouchBegin, QEvent.Type.TouchUpdate, QEvent.Type.Wheel})
_MODIFIERS = frozenset(
    {
        Qt.Key.Key_Control,
        Qt.Key.Key_Shift,
        Qt.Key.Key_Alt,
        Qt.Key.Key_AltGr,
        Qt.Key.Key_Meta,
        Qt.Key.Key_Super_L,
        Qt.Key.Key_Super_R,
    }
)


class Activity(QObject):
    """Looks at what comes to the kiosk's window."""

    def __init__(self, window: QQuickWindow, kiosk: KioskScreen, clock: Clock, parent: QObject) -> None:
        """Look until ``parent`` goes."""
        super().__init__(parent)
        self._kiosk = kiosk
        self._clock = clock
        self._last_ms: int | None = None
        window.installEventFilter(self)

    def last_ms(self) -> int | None:
        """When the visitor last did anything, on the clock; None if they never did."""
        return self._last_ms

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        """Notice what a visitor does; return whether it was taken as an answer."""
        key = _is_key(event)
        if not key and event.type() not in _HAND and not _drags(event):
            return False
        if self._kiosk.waits_for_answer and self._kiosk.takes_input:
            self._kiosk.confirm()
            # The key has done its work; it is not meant for what comes to light below.
            return key
        if not self._kiosk.covered:
            self._last_ms = self._clock.now_ms()
        return False


def _is_key(event: QEvent) -> bool:
    """Whether a key was pressed that was not down before; one that only modifies others is half a key.

    The experimenter's shortcuts never get here.
    """
    if event.type() != QEvent.Type.KeyPress or not isinstance(event, QKeyEvent):
        return False
    return not event.isAutoRepeat() and event.key() not in _MODIFIERS


def _drags(event: QEvent) -> bool:
    """Whether the mouse is moved with a button down."""
    return (
        event.type() == QEvent.Type.MouseMove
        and isinstance(event, QMouseEvent)
        and event.buttons() != Qt.MouseButton.NoButton
    )
