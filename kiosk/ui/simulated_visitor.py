"""A simulated visitor who drives the real window: clicks, forms and pace."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from enum import Enum
from functools import cache, partial
from random import Random

from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, Qt
from PySide6.QtGui import QGuiApplication, QKeyEvent, QPointingDevice
from PySide6.QtQuick import QQuickItem, QQuickWindow
from PySide6.QtTest import QTest

from kiosk.experiment.items import Act, Question, Tap, Typing
from kiosk.experiment.outcomes import Stage
from kiosk.experiment.questionnaire import Item
from kiosk.game import Position

LEFT = Qt.MouseButton.LeftButton
NO_KEY = Qt.KeyboardModifier.NoModifier
MOST_SCROLLS = 50
_FIELDS = ("text-", "number-")


Aside = Callable[[], AbstractContextManager[None]]


class UiTimeout(Exception):
    """The visitor cannot go on; the message says where, and what was looked for."""


class UiDriver:
    """Clicks and types in one window."""

    def __init__(self, window: QQuickWindow, aside: Aside = nullcontext) -> None:
        """Work in this window; what it takes to look for something is done ``aside``, and is not the interface's."""
        self._window = window
        self._aside = aside

    def click(self, name: str, across: float = 0.5) -> None:
        """Press and release the left button on the item of this name.

        ``across`` is from its left (0) to its right (1).

        A field to type into is touched, so that the keys on the screen come; a key on another layer is looked for.
        """
        if name.startswith("key-"):
            self._turn_to(name)
        if name.startswith(_FIELDS):
            touch(self._window, self._reach(name, across))
        else:
            self._tap(self._reach(name, across))

    def _turn_to(self, key: str) -> None:
        """Turn to the layer of the keys on the screen that has this one."""
        for layer in ("key-letters", "key-accents", "key-signs"):
            if self.is_visible(key):
                return
            if self.is_visible(layer):
                self._tap(self._reach(layer, 0.5))

    def double_click(self, name: str, across: float = 0.5) -> None:
        """Do it twice, as fast as a double click."""
        if name.startswith(_FIELDS):
            self.click(name, across)
            self.click(name, across)
            return
        if name.startswith("key-"):
            self._turn_to(name)
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

    def is_visible(self, name: str) -> bool:
        """Whether there is an item of this name to be seen."""
        return find_item(self._window.contentItem(), name) is not None

    def _tap(self, place: QPoint) -> None:
        QTest.mouseClick(self._window, LEFT, NO_KEY, place)

    def _reach(self, name: str, across: float) -> QPoint:
        """Where to click on an item; what is further down is scrolled to."""
        for _ in range(MOST_SCROLLS):
            with self._aside():
                item = self._look_for(name)
            place = item_point(item, across)
            if _in_view(item, place):
                return place
            if _scroll_back_to(item):
                continue
            further = find_item(self._window.contentItem(), "more")
            if further is None or not further.isEnabled():
                raise UiTimeout(f"{name!r} lies where it cannot be clicked")
            self._tap(item_centre(further))
        raise UiTimeout(f"{name!r} never comes, however far one scrolls")

    def _look_for(self, name: str) -> QQuickItem:
        lay_out(self._window)
        item = find_item(self._window.contentItem(), name)
        if item is None:
            raise UiTimeout(f"there is no {name!r} to be seen")
        outside = not QRectF(0, 0, self._window.width(), self._window.height()).contains(QPointF(item_centre(item)))
        if outside and _scroller(item) is None:
            raise UiTimeout(f"{name!r} lies outside the window")
        return item


class ReadingDriver(UiDriver):
    """Clicks as well, and first looks at every new page for texts that are cut off."""

    def __init__(
        self, window: QQuickWindow, aside: Aside, page: Callable[[], Hashable], tell: Callable[[str], None]
    ) -> None:
        """``page`` says which page is shown; ``tell`` is called with every text that is cut off, once."""
        super().__init__(window, aside)
        self._page = page
        self._tell = tell
        self._read: set[Hashable] = set()

    def click(self, name: str, across: float = 0.5) -> None:
        """Read the page, if it is new, and then click."""
        page = (self._page(), name.startswith("key-"))
        if page not in self._read:
            self._read.add(page)
            lay_out(self._window)
            for text in cut_texts(self._window):
                self._tell(text)
        super().click(name, across)


_ROUNDED = 2.0
"""Pixels that a text may be wider than its place; sizes are rounded."""


def cut_texts(window: QQuickWindow) -> Iterator[str]:
    """Yield the texts that do not fit: wider than their place, or beyond the window without scrolling."""
    whole = QRectF(-1, -1, window.width() + 2, window.height() + 2)
    for text in _texts(window.contentItem()):
        letters = text.mapRectToScene(text.boundingRect())
        scrolls = _scroller(text) is not None
        fits = float(text.property("contentWidth")) <= text.width() + _ROUNDED
        inside = whole.left() <= letters.left() and letters.right() <= whole.right()
        if text.property("truncated") or not fits or not inside or not (scrolls or whole.contains(letters)):
            yield str(text.property("text"))


def _texts(item: QQuickItem) -> Iterator[QQuickItem]:
    if item.isVisible() and item.opacity() > 0:
        if item.inherits("QQuickText") and str(item.property("text")).strip():
            yield item
        for child in item.childItems():
            yield from _texts(child)


def touch(window: QQuickWindow, place: QPoint) -> None:
    """Touch a place of a window with one finger."""
    glass = touch_screen()
    QTest.touchEvent(window, glass).press(0, place, window).commit()
    QTest.touchEvent(window, glass).release(0, place, window).commit()


@cache
def touch_screen() -> QPointingDevice:
    """Return the glass; Qt keeps every device that it was ever told of."""
    return QTest.createTouchDevice()


def lay_out(window: QQuickWindow) -> None:
    """See that everything is where it belongs: Qt Quick places items only when it draws."""
    window.grabWindow()


def item_centre(item: QQuickItem) -> QPoint:
    """Where the middle of an item is in its window."""
    return item_point(item, 0.5)


def item_point(item: QQuickItem, across: float) -> QPoint:
    """Return where a place half way down an item is in its window.

    ``across`` is from its left (0) to its right (1).
    """
    return item.mapToScene(QPointF(item.width() * across, item.height() / 2)).toPoint()


def find_item(item: QQuickItem, name: str) -> QQuickItem | None:
    """Return the visible item of this object name; delegates are no children of their view for Qt's own search."""
    if not item.isVisible():
        return None
    if item.objectName() == name:
        return item
    return next((found for child in item.childItems() if (found := find_item(child, name)) is not None), None)


def _scroller(item: QQuickItem) -> QQuickItem | None:
    """Return what an item scrolls in, if it does."""
    above: QQuickItem | None = item.parentItem()
    while above and not (above.inherits("QQuickFlickable") and above.property("interactive")):
        above = above.parentItem()
    return above


def _scroll_back_to(item: QQuickItem) -> bool:
    """Scroll up to an item above what is seen, as a finger drags a page; tell whether it did."""
    scroller = _scroller(item)
    if scroller is None:
        return False
    above = -item.mapToItem(scroller, QPointF(0, 0)).y()
    here = float(scroller.property("contentY"))
    if above <= 0 or here <= 0:
        return False
    scroller.setProperty("contentY", max(0.0, here - above))
    return True


def _in_view(item: QQuickItem, place: QPoint) -> bool:
    scroller = _scroller(item)
    if scroller is None:
        return True
    seen = scroller.mapRectToScene(QRectF(0, 0, scroller.width(), scroller.height()))
    return seen.contains(QPointF(place))


NOT_APPLICABLE_SHARE = 1 / 8
"""How often a simulated visitor says that an item does not apply, where that can be said."""

Errand = Callable[[], None]
"""One thing that is done at one moment."""


class FormFiller:
    """Fills in the items of one page; what is chosen is chance's."""

    def __init__(self, hand: UiDriver, chance: Random, *, hasty: bool) -> None:
        """Do it with this hand; the hasty click everything twice."""
        self._type = hand.type
        self._click = hand.double_click if hasty else hand.click
        self._chance = chance

    def errands(self, items: tuple[Item, ...], *, more: bool = False) -> Iterator[tuple[str, Errand]]:
        """Yield what is to be done for these items, in their order, each with the item's name.

        ``more``: other items may come to be seen on the page.
        """
        for number, item in enumerate(items):
            if isinstance(item, Question) and item.not_applicable and self._chance.random() < NOT_APPLICABLE_SHARE:
                yield item.id, self._do(Tap(f"not-applicable-{item.id}"))
            else:
                last = number == len(items) - 1 and not more
                yield from ((item.id, self._do(act)) for act in item.simulate(self._chance, last=last))

    def _do(self, act: Act) -> Errand:
        match act:
            case Tap(name, across):
                return partial(self._click, name, across)
            case Typing(text):
                return partial(self._type, text)


THINKING_MS = (500, 1_600)
HESITATING = 10
"""How many times as long a visitor who hesitates thinks."""


class BehaviourKind(Enum):
    """What kind of visitor it is."""

    COMPLETES = "completes"
    """Agrees, answers everything, and stays to the end."""
    DECLINES = "declines"
    """Plays without taking part."""
    UNDER_AGE = "under age"
    """Agrees, but is too young."""
    LEAVES = "leaves"
    """Walks away in some stage, without a word."""
    HASTY = "hasty"
    """Clicks twice, taps everywhere, and skips all that can be skipped."""


@dataclass(frozen=True)
class MemoryTraits:
    """How a visitor plays: the chances to forget, to follow a hint, to guess and to hesitate.

    The study's people followed in .86 (noToM) and .92 (ToM) of the cases.
    """

    forgetting: float = 0.15
    following: float = 0.9
    lapse: float = 0.0
    hesitation: float = 0.0


@dataclass(frozen=True)
class BehaviourProfile:
    """A visitor's manner, where one who leaves does so, and the language they choose: by default the study's first."""

    manner: BehaviourKind = BehaviourKind.COMPLETES
    leaves_in: Stage = Stage.GAME
    language: str = ""
    memory: MemoryTraits = MemoryTraits()
    links: bool = False
    """Whether they agree that their visits are linked, where the study asks for it."""
    code: str = ""
    """The code of an earlier visit, which they type where they can."""


@dataclass(frozen=True)
class BoardView:
    """What can be seen of an open board: closed cards, the first card's picture, and the mark."""

    closed: tuple[Position, ...]
    first: str | None
    mark_row: int | None
    mark_column: int | None

    @property
    def marked(self) -> tuple[Position, ...]:
        """The closed cards that the mark leaves to choose from; none without a mark."""
        if self.mark_row is None and self.mark_column is None:
            return ()
        return tuple(p for p in self.closed if self.mark_row in (None, p.row) and self.mark_column in (None, p.column))


class SimulatedParticipant:
    """One visitor, for one session; everything it does follows from ``rng`` and what it sees."""

    def __init__(self, rng: Random, memory: MemoryTraits) -> None:
        """Remember nothing yet."""
        self._rng = rng
        self._memory = memory
        self._seen: dict[Position, tuple[str, int]] = {}
        self._recalled: dict[Position, str] = {}
        self._flips = 0

    def think(self) -> int:
        """How long it thinks before it clicks, in ms."""
        think_ms = self._rng.randint(*THINKING_MS)
        hesitates = self._memory.hesitation > 0 and self._rng.random() < self._memory.hesitation
        return think_ms * HESITATING if hesitates else think_ms

    def tosses(self) -> bool:
        """Whether a coin it tosses falls on its right side."""
        return self._rng.random() < 1 / 2

    def sit_down(self) -> None:
        """Begin with a board that nothing is known of."""
        self._seen.clear()
        self._recalled = {}
        self._flips = 0

    def choose(self, view: BoardView) -> Position:
        """Return the closed card that it turns next."""
        if view.first is None:
            self._recalled = self._recall()
        self._flips += 1
        if self._memory.lapse and self._rng.random() < self._memory.lapse:
            return self._rng.choice(view.closed)
        recalled = {position: picture for position, picture in self._recalled.items() if position in view.closed}
        choice = view.marked if view.marked and self._rng.random() < self._memory.following else view.closed
        wanted = _mates(view.first, recalled) if view.first else _pairs(recalled)
        return self._rng.choice(
            [p for p in choice if p in wanted] or [p for p in choice if p not in recalled] or list(choice)
        )

    def see(self, shown: dict[Position, str]) -> None:
        """Look at the open cards."""
        for position, picture in shown.items():
            self._seen[position] = (picture, self._flips)

    def _recall(self) -> dict[Position, str]:
        """Return the cards that it recalls in this move."""
        return {
            position: picture
            for position, (picture, flip) in self._seen.items()
            if self._rng.random() < (1 - self._memory.forgetting) ** (self._flips - flip)
        }


def _mates(first: str, recalled: dict[Position, str]) -> set[Position]:
    """Where the open card's mate is believed to lie."""
    return {position for position, picture in recalled.items() if picture == first}


def _pairs(recalled: dict[Position, str]) -> set[Position]:
    """Return the cards of pairs that are believed to be known."""
    pictures = list(recalled.values())
    return {position for position, picture in recalled.items() if pictures.count(picture) > 1}
