"""Everybody can play: by name, by keyboard, with large and strong texts, and with the board on either side."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QAccessible, QAccessibleInterface, QColor, QImage
from PySide6.QtQuick import QQuickItem
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from kiosk.settings import Settings
from kiosk.store.reading import archive
from kiosk.study.events import Status
from kiosk.ui.app import App
from kiosk.ui.rehearsing.hand import Stuck, find, lay_out
from kiosk.ui.rehearsing.rehearsal import Rehearsal
from tests.ui.conftest import Booth, MakeBooth
from tests.ui.looking import (
    background,
    colours,
    contrast,
    is_a,
    is_control,
    is_ignored,
    items,
    opacity,
    painted,
    place,
    texts,
    tour,
)

LEAST_CONTRAST = {"normal": 4.5, "high": 7.0}
LEAST_PIXELS = 24
RING_CONTRAST = 3.0
MOST_STOPS = 60
NO_KEY = Qt.KeyboardModifier.NoModifier


@pytest.fixture(autouse=True)
def spoken() -> Iterator[None]:
    """A program that reads the screen aloud is there."""
    before = QAccessible.isActive()
    QAccessible.setActive(True)
    yield
    QAccessible.setActive(before)


def described(item: QQuickItem) -> tuple[QAccessible.Role, str] | None:
    """What a program that reads the screen is told of an item: its role and its name."""
    told = QAccessible.queryAccessibleInterface(item)
    if not isinstance(told, QAccessibleInterface):
        return None
    return told.role(), told.text(QAccessible.Text.Name)


def is_inside_a_named_control(item: QQuickItem) -> bool:
    """Whether what it says is part of a control's own name."""
    parent = item.parentItem()
    while parent is not None:
        if is_control(parent) and (told := described(parent)) is not None and told[1]:
            return True
        parent = parent.parentItem()
    return False


def untold(item: QQuickItem) -> bool:
    """Whether those who cannot see an item would not know that it is there, and should."""
    if is_ignored(item) or not (is_control(item) or (is_a(item, "QQuickText") and item.property("text"))):
        return False
    role, name = described(item) or (QAccessible.Role.NoRole, "")
    if is_control(item):
        return role is QAccessible.Role.NoRole or not name
    return not name and not is_inside_a_named_control(item)


@pytest.mark.parametrize("language", ["en", "it", "es"])
def test_every_control_has_a_role_and_a_name_and_every_text_is_told(make_booth: MakeBooth, language: str) -> None:
    app = make_booth(settings=Settings(language=language)).app
    missed: set[str] = set()
    looked_at: set[str] = set()

    def look(screen: str) -> None:
        looked_at.add(screen)
        shown = list(items(app.window.contentItem()))
        missed.update(f"{screen}: {item.objectName()} {item.property('text')}" for item in shown if untold(item))
        if screen != "pause" and untold(app.window.activeFocusItem()):
            missed.add(f"{screen}: what has the keyboard")

    tour(app, look)
    assert missed == set()
    assert looked_at >= {"attract", "game", "result", "still there", "pause"}


@pytest.mark.parametrize("palette", ["normal", "high"])
def test_every_text_stands_out_from_what_it_is_written_on(make_booth: MakeBooth, palette: str) -> None:
    app = make_booth(settings=Settings.model_validate({"screen": {"contrast": palette}})).app
    app.window.resize(1920, 1080)
    faint: set[tuple[str, str, float]] = set()

    def look(screen: str) -> None:
        picture = app.window.grabWindow()
        # A calm word lies over the rest, which steps back by intent.
        over = screen in {"still there", "pause"}
        for text in texts(app.window.contentItem()):
            if opacity(text) < 1 or (over and not _is_over(text)):
                continue
            color, paper = text.property("color"), background(picture, painted(text))
            assert isinstance(color, QColor)
            if contrast(color, paper) < LEAST_CONTRAST[palette]:
                faint.add((screen, str(text.property("text")), round(contrast(color, paper), 2)))

    tour(app, look)
    assert faint == set()


def _is_over(text: QQuickItem) -> bool:
    parent = text.parentItem()
    while parent is not None:
        if parent.metaObject().className().startswith("CalmCard"):
            return True
        parent = parent.parentItem()
    return False


@pytest.mark.usefixtures("qapp")
@pytest.mark.parametrize(
    ("palette", "text", "paper"),
    [(p, *pair) for p in LEAST_CONTRAST for pair in [("white", "lightSea"), ("ink", "sand"), ("white", "sea")]],
)
def test_what_is_under_the_mouse_stands_out_as_well(palette: str, text: str, paper: str) -> None:
    theme = colours(palette)
    assert contrast(theme[text], theme[paper]) >= LEAST_CONTRAST[palette]


@pytest.mark.usefixtures("qapp")
def test_high_contrast_knows_no_pale_tint_and_nothing_that_steps_back() -> None:
    theme = colours("high")
    # What is neither written on nor the paper itself stands out from the paper.
    for name in ("ink", "faintInk", "sea", "lightSea", "deepAmber", "edge"):
        assert contrast(theme[name], theme["paper"]) >= LEAST_CONTRAST["high"], name
    assert theme["done"] == theme["held"] == 1


@pytest.mark.parametrize("factor", [0.5, 1.0])
def test_no_text_is_smaller_than_24_pixels_of_1080_lines(make_booth: MakeBooth, factor: float) -> None:
    app = make_booth(settings=Settings.model_validate({"screen": {"text_size": factor}})).app
    app.window.resize(1920, 1080)
    small: set[tuple[str, str, int]] = set()

    def look(screen: str) -> None:
        for text in texts(app.window.contentItem()):
            pixels = text.property("font").pixelSize()
            if pixels < LEAST_PIXELS:
                small.add((screen, str(text.property("text")), pixels))

    tour(app, look)
    assert small == set()


class Keyboard(Rehearsal):
    """A sitting that is played by Tab, arrows, Enter and Space alone, on whatever screens come."""

    def __init__(self, app: App, seed: int) -> None:
        super().__init__(app, seed)
        self.pressed = 0

    def _click(self, name: str) -> None:
        if name.startswith("card-"):
            self._go_to_card(int(name.removeprefix("card-")))
        elif not (self._tab_to(name) or self._arrow_to(name)):
            raise Stuck(f"the keyboard does not reach {name!r} on the screen {self._app.screens.kiosk.shown}")
        self.pressed += 1
        self._press(Qt.Key.Key_Return if self.pressed % 2 else Qt.Key.Key_Space)

    def _tab_to(self, name: str) -> bool:
        lay_out(self._app.window)
        for _ in range(MOST_STOPS):
            if self._is_at(name):
                return True
            self._press(Qt.Key.Key_Tab)
        return False

    def _arrow_to(self, name: str) -> bool:
        """Within a group, arrows may go where Tab does not."""
        for _ in range(MOST_STOPS):
            for _ in range(MOST_STOPS // 4):
                if self._is_at(name):
                    return True
                self._press(Qt.Key.Key_Right)
            self._press(Qt.Key.Key_Tab)
        return False

    def _go_to_card(self, location: int) -> None:
        if not self._tab_to("board"):
            raise Stuck(f"the keyboard does not reach the board, but {self._focused().metaObject().className()}")
        board = find(self._app.window.contentItem(), "board")
        assert board is not None
        columns = self._app.screens.board.property("columns")
        for _ in range(MOST_STOPS):
            here = int(board.property("currentIndex"))
            down, across = location // columns - here // columns, location % columns - here % columns
            if not (down or across):
                return
            forward, back = (Qt.Key.Key_Down, Qt.Key.Key_Up) if down else (Qt.Key.Key_Right, Qt.Key.Key_Left)
            self._press(forward if (down or across) > 0 else back)
        raise Stuck(f"the arrows do not reach the card {location}")

    def _is_at(self, name: str) -> bool:
        """Whether an item of this name has the keyboard, itself or for something in it."""
        item: QQuickItem | None = self._focused()
        while item is not None and item.objectName() != name:
            item = item.parentItem()
        return item is not None

    def _focused(self) -> QQuickItem:
        focused = self._app.window.activeFocusItem()
        if focused is None:
            raise Stuck(f"nothing has the keyboard on the screen {self._app.screens.kiosk.shown}")
        return focused

    def _press(self, key: Qt.Key) -> None:
        QTest.keyClick(self._app.window, key, NO_KEY)


def test_a_whole_sitting_is_played_by_keyboard_alone(booth: Booth) -> None:
    keyboard = Keyboard(booth.app, 1)
    keyboard.run()
    assert keyboard.pressed > 30
    with archive(booth.data) as stored:
        (sitting,) = stored.sittings()
    assert sitting.status is Status.COMPLETED
    assert sitting.measures.pairs == 12


def test_whoever_has_the_keyboard_shows_it(booth: Booth) -> None:
    window = booth.app.window
    unseen: set[tuple[str, str]] = set()

    def look(screen: str) -> None:
        first = window.activeFocusItem()
        if first is None:
            return
        for _ in range(MOST_STOPS):
            before = window.activeFocusItem()
            picture = window.grabWindow()
            QTest.keyClick(window, Qt.Key.Key_Tab, NO_KEY)
            after = window.activeFocusItem()
            if after is before or is_a(after, "QQuickGridView"):
                break
            where = place(after).adjusted(-12, -12, 12, 12)
            if _strongest_change(picture, window.grabWindow(), where) < RING_CONTRAST:
                unseen.add((screen, after.objectName()))
            if after is first:
                break

    tour(booth.app, look)
    assert unseen == set()


def _strongest_change(before: QImage, after: QImage, where: QRect) -> float:
    """The greatest contrast between a pixel and the same one later, in a place."""
    inside = where.intersected(before.rect())
    return max(
        contrast(QColor(before.pixel(x, y)), QColor(after.pixel(x, y)))
        for x in range(inside.left(), inside.right(), 3)
        for y in range(inside.top(), inside.bottom() + 1)
    )


def test_the_card_that_the_keyboard_is_at_has_a_ring(booth: Booth) -> None:
    booth.start_game()
    booth.settle()
    where = place(booth.item("card-1"))
    before = booth.app.window.grabWindow()
    booth.press(Qt.Key.Key_Right)
    assert _strongest_change(before, booth.app.window.grabWindow(), where) >= RING_CONTRAST


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize(("width", "height"), [(1920, 1080), (1080, 1920)])
def test_the_board_is_on_the_side_that_was_chosen(
    make_booth: MakeBooth, qtbot: QtBot, side: str, width: int, height: int
) -> None:
    booth = make_booth(settings=Settings.model_validate({"screen": {"board": side}}))
    window = booth.app.window
    window.resize(width, height)
    qtbot.waitUntil(lambda: window.contentItem().width() == width)
    booth.app.screens.avatar.say("Hello!")
    lay_out(window)
    (bubble,) = [text for text in texts(window.contentItem()) if text.property("text") == "Hello!"]
    start = find(window.contentItem(), "start")
    assert start is not None
    said, button = place(bubble), place(start)
    if width > height:
        assert (said.center().x() > button.center().x()) is (side == "left")
    assert said.left() >= 0
    assert said.right() < width
    assert not said.intersects(button)


@pytest.mark.parametrize(("side", "left", "right"), [("left", -1.0, -0.5), ("right", 0.5, 1.0)])
def test_the_avatar_looks_where_the_board_is(make_booth: MakeBooth, side: str, left: float, right: float) -> None:
    app = make_booth(settings=Settings.model_validate({"screen": {"board": side}})).app
    body = app.bodies.current
    assert body is not None
    app.screens.board.deal(4, 6, 12)
    for column, where in ((0, left), (5, right)):
        body.attend(app.screens.board.place(None, column))
        assert app.screens.avatar.property("gazeX") == pytest.approx(where, abs=0.05)


def test_without_motion_nothing_moves(make_booth: MakeBooth) -> None:
    app = make_booth(settings=Settings.model_validate({"screen": {"motion": False}})).app
    assert app.window.property("motion") == 0
