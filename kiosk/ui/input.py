"""Input of visitors: signs of life, keys that are held down, and where characters begin."""

from __future__ import annotations

from collections import deque

from PySide6.QtCore import QEvent, QObject, QPointF, Qt, QTextBoundaryFinder
from PySide6.QtGui import QInputDevice, QKeyEvent, QMouseEvent, QPointerEvent
from PySide6.QtQuick import QQuickItem, QQuickWindow

from kiosk.experiment.events import InputDevice
from kiosk.ui.event_loop import Clock, TimerWait
from kiosk.ui.screens.shell import KioskScreen


def before(text: str, place: int) -> int:
    """Return where the character begins that ends at ``place``; both count UTF-16 units, as Qt does."""
    finder = QTextBoundaryFinder(QTextBoundaryFinder.BoundaryType.Grapheme, text)
    finder.setPosition(place)
    return max(0, finder.toPreviousBoundary())


def fitting(text: str, place: int, longest: int) -> int:
    """Return where what stands before ``place`` has to end, so that the text has at most ``longest`` code points."""
    head = _units(text)[: 2 * place].decode("utf-16-le", "surrogatepass")
    kept = head[: max(0, len(head) - max(0, len(text) - longest))]
    return len(_units(kept)) // 2


def without_last(text: str) -> str:
    """Return the text without its last character."""
    units = _units(text)
    return units[: 2 * before(text, len(units) // 2)].decode("utf-16-le", "surrogatepass")


def _units(text: str) -> bytes:
    return text.encode("utf-16-le", "surrogatepass")


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


_HAND = frozenset({QEvent.Type.MouseButtonPress, QEvent.Type.TouchBegin, QEvent.Type.TouchUpdate, QEvent.Type.Wheel})
POINTED_PX = 80
"""How far a pointer has to be moved to show that a person is there; a mouse on a table that is bumped moves less."""
POINTED_MS = 1_000
"""A pointer that rests for so long begins to be moved anew."""
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


CHOICES_KEPT_MS = 60_000
"""How long a choice on the start screen stands if no session begins."""


class ChoiceReset(QObject):
    """Takes back choices of the start screen if no session begins, so that the next visitor does not get them."""

    def __init__(self, kiosk: KioskScreen, clock: Clock, parent: QObject) -> None:
        """Watch the choices until ``parent`` goes."""
        super().__init__(parent)
        self._kiosk, self._clock = kiosk, clock
        self._wait: TimerWait | None = None
        kiosk.chosen.connect(self._begin)

    def _begin(self) -> None:
        if self._wait is not None:
            self._wait.cancel()
        self._wait = self._clock.after(CHOICES_KEPT_MS, self._kiosk.forget_choices)


class Activity(QObject):
    """Looks at what comes to the kiosk's window."""

    def __init__(self, window: QQuickWindow, kiosk: KioskScreen, clock: Clock, parent: QObject) -> None:
        """Look until ``parent`` goes."""
        super().__init__(parent)
        self._kiosk = kiosk
        self._clock = clock
        self._last_ms: int | None = None
        self.device: InputDevice | None = None
        """What was used last to press something; None if nothing was."""
        self._pointed: tuple[QPointF, float, int] | None = None
        """Where the pointer was last, how far it has come in one go, and when."""
        window.installEventFilter(self)

    def last_ms(self) -> int | None:
        """When the visitor last did anything, on the clock; None if they never did."""
        return self._last_ms

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        """Notice what a visitor does; return whether it was taken as an answer."""
        self.device = _device(event) or self.device
        key = _is_key(event)
        if not key and event.type() not in _HAND and not _drags(event):
            if self._points(event) and not self._kiosk.covered:
                self._last_ms = self._clock.now_ms()
            return False
        if self._kiosk.waits_for_answer and self._kiosk.takes_input:
            self._kiosk.confirm()
            # The key has done its work; it is not meant for what comes to light below.
            return key
        if not self._kiosk.covered:
            self._last_ms = self._clock.now_ms()
        return False

    def _points(self, event: QEvent) -> bool:
        """Whether the pointer has been moved far enough; where it is put by a table that moves, it has not."""
        if event.type() != QEvent.Type.MouseMove or not isinstance(event, QMouseEvent):
            return False
        place, now_ms = event.globalPosition(), self._clock.now_ms()
        before, way, last_ms = self._pointed or (place, 0.0, now_ms)
        way = (place - before).manhattanLength() + (way if now_ms - last_ms < POINTED_MS else 0.0)
        self._pointed = (place, way, now_ms)
        return way >= POINTED_PX


def _is_key(event: QEvent) -> bool:
    """Whether a key was pressed that was not down before; one that only modifies others is half a key.

    The experimenter's shortcuts never get here.
    """
    if event.type() != QEvent.Type.KeyPress or not isinstance(event, QKeyEvent):
        return False
    return not event.isAutoRepeat() and event.key() not in _MODIFIERS


_DEVICES = {
    QInputDevice.DeviceType.Mouse: InputDevice.MOUSE,
    QInputDevice.DeviceType.TouchPad: InputDevice.MOUSE,
    QInputDevice.DeviceType.TouchScreen: InputDevice.TOUCH,
    QInputDevice.DeviceType.Stylus: InputDevice.PEN,
    QInputDevice.DeviceType.Airbrush: InputDevice.PEN,
}


def _device(event: QEvent) -> InputDevice | None:
    """Return what presses something by this event; None if nothing is pressed."""
    if _is_key(event):
        return InputDevice.KEYBOARD
    if event.type() == QEvent.Type.TabletPress:
        return InputDevice.PEN
    if event.type() in _PRESSES and isinstance(event, QPointerEvent):
        # A system may make a mouse's event of a touch; the device behind it is the glass all the same.
        return _DEVICES.get(event.device().type())
    return None


_PRESSES = (QEvent.Type.MouseButtonPress, QEvent.Type.MouseButtonDblClick, QEvent.Type.TouchBegin)


def _drags(event: QEvent) -> bool:
    """Whether the mouse is moved with a button down."""
    return (
        event.type() == QEvent.Type.MouseMove
        and isinstance(event, QMouseEvent)
        and event.buttons() != Qt.MouseButton.NoButton
    )


class PointerTrace(QObject):
    """Keeps the way of the pointer over the board until the tap that it leads to."""

    def __init__(self, window: QQuickWindow, clock: Clock, parent: QObject) -> None:
        """Look until ``parent`` goes."""
        super().__init__(parent)
        self._window = window
        self._clock = clock
        self._places: deque[tuple[int, float, float]] = deque(maxlen=MOST_PLACES)
        self._left = MOST_PLACES_IN_ALL
        window.installEventFilter(self)

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        """Notice where the pointer is; nothing is taken."""
        if event.type() == QEvent.Type.MouseMove and isinstance(event, QMouseEvent):
            now_ms = self._clock.now_ms()
            if not self._places or now_ms - self._places[-1][0] >= TRACED_MS:
                place = event.scenePosition()
                self._places.append((now_ms, place.x(), place.y()))
        return False

    def begin(self) -> None:
        """Forget everything: another session begins."""
        self._places.clear()
        self._left = MOST_PLACES_IN_ALL

    def take(self) -> tuple[tuple[int, float, float], ...]:
        """Return the way until now, and forget it: ms before now, and the place on the board in cards."""
        board = self._window.findChild(QQuickItem, "board")
        cell = float(board.property("cellWidth")) if board is not None else 0.0
        places, now_ms = list(self._places)[: self._left], self._clock.now_ms()
        self._places.clear()
        if board is None or cell <= 0:
            return ()
        self._left -= len(places)
        there = [(at_ms, board.mapFromScene(QPointF(x, y))) for at_ms, x, y in places]
        return tuple((now_ms - at_ms, round(at.x() / cell, 3), round(at.y() / cell, 3)) for at_ms, at in there)


TRACED_MS = 33
"""Between two places of the pointer: 30 a second."""
MOST_PLACES = 900
"""Places before one tap: the last 30 seconds of a pointer that never rests."""
MOST_PLACES_IN_ALL = 20_000
"""Places in a session, about half a megabyte; what comes later is not recorded."""
