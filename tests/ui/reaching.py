"""Hands that have no mouse: one reaches everything with the keys of a keyboard, one with a finger on the glass."""

from __future__ import annotations

from contextlib import nullcontext

from PySide6.QtCore import QPoint, Qt
from PySide6.QtQuick import QQuickItem, QQuickWindow
from PySide6.QtTest import QTest

from kiosk.ui.simulated_visitor import NO_KEY, Aside, UiDriver, UiTimeout, touch, touch_screen

__all__ = ["Finger", "Keyboard", "touch_screen"]

MOST_STOPS = 80
"""No screen has more places for the keyboard."""
PAGE_STEPS = 10
"""How many leaps of Page Up a slider has."""
TYPED_INTO = "QQuickTextInput"


class Keyboard(UiDriver):
    """Tab, arrows, Page Up and Down, Enter, Space, and letters; nothing is ever pointed at."""

    def __init__(self, window: QQuickWindow, aside: Aside = nullcontext) -> None:
        """Work in this window."""
        super().__init__(window, aside)
        self.pressed = 0
        """How often something was chosen with a key."""

    def click(self, name: str, across: float = 0.5) -> None:
        """Go to the item of this name, and press Enter or Space in turn; a slider is brought to ``across``."""
        if name.startswith("key-"):
            self._press_instead(name.removeprefix("key-"))
        elif name.startswith("card-"):
            self._go_to_card(int(name.removeprefix("card-")))
            self._choose()
        elif name.startswith("slider-"):
            self._slide(self.go_to(name), across)
        elif not self.go_to(name).inherits(TYPED_INTO):
            self._choose()

    def double_click(self, name: str, across: float = 0.5) -> None:
        """Press the key once: a keyboard has no double click."""
        self.click(name, across)

    def _tap(self, place: QPoint) -> None:
        raise UiTimeout(f"a keyboard points at nothing, and so not at {place.toTuple()}")

    def press(self, key: Qt.Key, modifiers: Qt.KeyboardModifier = NO_KEY) -> None:
        """Press and release a key."""
        QTest.keyClick(self._window, key, modifiers)

    def go_to(self, name: str) -> QQuickItem:
        """Bring the keyboard to the item of this name: by Tab, and within its group by arrows."""
        group = name.rpartition("-")[0] + "-"
        for _ in range(MOST_STOPS):
            held = self._within(name)
            if held is not None:
                return held
            if len(group) > 1 and self.held.objectName().startswith(group) and self._is_in_group(name):
                return self.held
            self.press(Qt.Key.Key_Tab)
        raise UiTimeout(f"the keyboard does not reach {name!r}")

    @property
    def held(self) -> QQuickItem:
        """What has the keyboard."""
        item: QQuickItem | None = self._window.activeFocusItem()
        if item is None:
            raise UiTimeout("nothing has the keyboard")
        return item

    def _within(self, name: str) -> QQuickItem | None:
        """Return the item of this name, if it or something in it has the keyboard."""
        item: QQuickItem | None = self.held
        while item is not None and item.objectName() != name:
            item = item.parentItem()
        return item

    def _is_in_group(self, name: str) -> bool:
        """Whether arrows come to it from here, on one side or the other."""
        for key in (Qt.Key.Key_Right, Qt.Key.Key_Left):
            for _ in range(MOST_STOPS):
                before = self.held
                if before.objectName() == name:
                    return True
                self.press(key)
                if self.held is before:
                    break
        return False

    def _choose(self) -> None:
        self.pressed += 1
        self.press(Qt.Key.Key_Return if self.pressed % 2 else Qt.Key.Key_Space)

    def _press_instead(self, key: str) -> None:
        """Press the real key that does what a key on the screen does."""
        match key:
            case "delete":
                self.press(Qt.Key.Key_Backspace)
            case "space":
                self.type(" ")
            case letter if len(letter) == 1:
                self.type(letter)

    def _slide(self, slider: QQuickItem, across: float) -> None:
        lowest, highest = float(slider.property("from")), float(slider.property("to"))
        wanted = round(lowest + across * (highest - lowest))
        self._choose()
        for forward, back, step in (
            (Qt.Key.Key_PageUp, Qt.Key.Key_PageDown, round((highest - lowest) / PAGE_STEPS)),
            (Qt.Key.Key_Right, Qt.Key.Key_Left, 1),
        ):
            while abs(far := wanted - round(slider.property("value"))) >= step:
                self.press(forward if far > 0 else back)

    def _go_to_card(self, location: int) -> None:
        board = self.go_to("board")
        columns = round(board.width() / float(board.property("cellWidth")))
        for _ in range(MOST_STOPS):
            here = int(board.property("currentIndex"))
            down, across = location // columns - here // columns, location % columns - here % columns
            if not (down or across):
                return
            forward, back = (Qt.Key.Key_Down, Qt.Key.Key_Up) if down else (Qt.Key.Key_Right, Qt.Key.Key_Left)
            self.press(forward if (down or across) > 0 else back)
        raise UiTimeout(f"the arrows do not reach the card {location}")


class Finger(UiDriver):
    """Touches the glass, and has neither mouse nor keyboard: it types with the keys on the screen."""

    def double_click(self, name: str, across: float = 0.5) -> None:
        """Touch it twice."""
        place = self._reach(name, across)
        self._tap(place)
        self._tap(place)

    def type(self, text: str) -> None:
        """Touch one key on the screen after another."""
        for letter in text:
            if letter.isupper():
                self.click("key-shift")
            self.click("key-space" if letter == " " else f"key-{letter.lower()}")

    def _tap(self, place: QPoint) -> None:
        touch(self._window, place)
