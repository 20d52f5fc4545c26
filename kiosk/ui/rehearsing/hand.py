"""A hand at the window: clicks on what can be seen, by its name, and types. It reaches what a visitor's hand does."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from random import Random

from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, Qt
from PySide6.QtGui import QGuiApplication, QKeyEvent
from PySide6.QtQuick import QQuickItem, QQuickWindow
from PySide6.QtTest import QTest

LEFT = Qt.MouseButton.LeftButton
NO_KEY = Qt.KeyboardModifier.NoModifier
MOST_SCROLLS = 50


Aside = Callable[[], AbstractContextManager[None]]


class Stuck(Exception):
    """The visitor cannot go on; the message says where, and what was looked for."""


class Hand:
    """Clicks and types in one window."""

    def __init__(self, window: QQuickWindow, aside: Aside = nullcontext) -> None:
        """Work in this window; what it takes to look for something is done ``aside``, and is not the interface's."""
        self._window = window
        self._aside = aside

    def click(self, name: str, across: float = 0.5) -> None:
        """Press and release the left button on the item of this name, ``across`` from its left (0) to its right (1)."""
        self._tap(self._reach(name, across))

    def double_click(self, name: str, across: float = 0.5) -> None:
        """Do it twice, as fast as a double click."""
        QTest.mouseDClick(self._window, LEFT, NO_KEY, self._reach(name, across))

    def tap_anywhere(self, chance: Random) -> None:
        """Click wherever it happens to be."""
        place = QPoint(chance.randrange(self._window.width()), chance.randrange(self._window.height()))
        self._tap(place)

    def type(self, text: str) -> None:
        """Press the keys of a real keyboard."""
        for letter in text:
            for act in (QEvent.Type.KeyPress, QEvent.Type.KeyRelease):
                QGuiApplication.sendEvent(self._window, QKeyEvent(act, Qt.Key.Key_unknown, NO_KEY, letter))

    def sees(self, name: str) -> bool:
        """Whether there is an item of this name to be seen."""
        return find(self._window.contentItem(), name) is not None

    def _tap(self, place: QPoint) -> None:
        QTest.mouseClick(self._window, LEFT, NO_KEY, place)

    def _reach(self, name: str, across: float) -> QPoint:
        """Where to click on an item; what is further down is scrolled to."""
        for _ in range(MOST_SCROLLS):
            with self._aside():
                item = self._look_for(name)
            place = at(item, across)
            if _in_view(item, place):
                return place
            further = find(self._window.contentItem(), "more")
            if further is None or not further.isEnabled():
                raise Stuck(f"{name!r} lies where it cannot be clicked")
            self._tap(middle(further))
        raise Stuck(f"{name!r} never comes, however far one scrolls")

    def _look_for(self, name: str) -> QQuickItem:
        lay_out(self._window)
        item = find(self._window.contentItem(), name)
        if item is None:
            raise Stuck(f"there is no {name!r} to be seen")
        outside = not QRectF(0, 0, self._window.width(), self._window.height()).contains(QPointF(middle(item)))
        if outside and _scroller(item) is None:
            raise Stuck(f"{name!r} lies outside the window")
        return item


def lay_out(window: QQuickWindow) -> None:
    """See that everything is where it belongs: Qt Quick places items only when it draws."""
    window.grabWindow()


def middle(item: QQuickItem) -> QPoint:
    """Where the middle of an item is in its window."""
    return at(item, 0.5)


def at(item: QQuickItem, across: float) -> QPoint:
    """Where a place half way down an item is in its window, ``across`` from its left (0) to its right (1)."""
    return item.mapToScene(QPointF(item.width() * across, item.height() / 2)).toPoint()


def find(item: QQuickItem, name: str) -> QQuickItem | None:
    """The visible item of this object name; delegates are no children of their view for Qt's own search."""
    if not item.isVisible():
        return None
    if item.objectName() == name:
        return item
    return next((found for child in item.childItems() if (found := find(child, name)) is not None), None)


def _scroller(item: QQuickItem) -> QQuickItem | None:
    """What an item scrolls in, if it does."""
    above: QQuickItem | None = item.parentItem()
    while above and not (above.inherits("QQuickFlickable") and above.property("interactive")):
        above = above.parentItem()
    return above


def _in_view(item: QQuickItem, place: QPoint) -> bool:
    scroller = _scroller(item)
    if scroller is None:
        return True
    seen = scroller.mapRectToScene(QRectF(0, 0, scroller.width(), scroller.height()))
    return seen.contains(QPointF(place))
