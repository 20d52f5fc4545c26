"""Hands are slow, fast, and heavy: a double click, a long press and a key held down are what their owner meant."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QGuiApplication, QKeyEvent
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from kiosk.config import Settings
from kiosk.ui.simulated_visitor import item_centre
from kiosk.ui.window import RunMode, WindowMode
from tests.ui.conftest import Booth
from tests.ui.headless import headless

NO_KEY = Qt.KeyboardModifier.NoModifier


def test_the_second_half_of_a_double_click_does_nothing_on_the_next_screen(booth: Booth) -> None:
    booth.click("start-en")
    booth.settle()
    place = item_centre(booth.item("continue"))
    for _ in range(2):
        QTest.mouseClick(booth.app.window, Qt.MouseButton.LeftButton, NO_KEY, place)
    assert booth.screen == "game"
    assert len(booth.app.screens.board.closed) == 24


def test_a_card_that_is_pressed_for_long_is_turned_when_it_is_let_go(booth: Booth, qtbot: QtBot) -> None:
    booth.start_game()
    booth.settle()
    place, window = item_centre(booth.item("card-9")), booth.app.window
    QTest.mousePress(window, Qt.MouseButton.LeftButton, NO_KEY, place)
    hints = QGuiApplication.styleHints()
    # Longer than the time after which Qt takes a press for a long one.
    with qtbot.waitSignal(window.frameSwapped, timeout=5 * hints.mousePressAndHoldInterval(), raising=False):
        pass
    QTest.mouseRelease(window, Qt.MouseButton.LeftButton, NO_KEY, place, 2 * hints.mousePressAndHoldInterval())
    assert len(booth.app.screens.board.closed) == 23


def test_a_key_that_is_held_down_is_pressed_once(booth: Booth) -> None:
    booth.start_game()
    booth.press(Qt.Key.Key_Right)
    for _ in range(3):
        held = QKeyEvent(QEvent.Type.KeyPress, Qt.Key.Key_Return, NO_KEY, "\r", True)  # noqa: FBT003 - Qt's signature
        QGuiApplication.sendEvent(booth.app.window, held)
    assert len(booth.app.screens.board.closed) == 24
    booth.press(Qt.Key.Key_Return)
    assert len(booth.app.screens.board.closed) == 23


def test_the_booth_lives_while_nobody_is_there(qtbot: QtBot, tmp_path: Path) -> None:
    with headless(Settings(), tmp_path, mode=RunMode(WindowMode.NOWHERE, speed=50)) as app:
        seen: set[tuple[int, ...]] = set()
        blinks: set[bool] = set()
        app.screens.attract.changed.connect(lambda: seen.add(app.screens.attract.closed))
        app.screens.avatar.looked.connect(lambda: blinks.add(bool(app.screens.avatar.property("blinking"))))
        qtbot.waitUntil(lambda: len(seen) > 3 and blinks == {True, False})
