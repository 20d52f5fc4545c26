"""The window: it is not left by accident, everything works without a mouse, and nothing is drawn that cannot be."""

from __future__ import annotations

import re
import sys
from pathlib import Path

import pytest
from PySide6.QtCore import QObject, Qt
from PySide6.QtGui import QImage
from PySide6.QtQml import QQmlComponent, QQmlEngine
from PySide6.QtQuick import QQuickItem
from pytestqt.qtbot import QtBot

from kiosk.config import ASSETS
from kiosk.experiment.questionnaire import Questionnaire
from kiosk.ui.screens.fixed_texts import FIXED
from kiosk.ui.window import QML, ClockMode, RunMode, Window, WindowMode
from tests.samples import CATALOGUES
from tests.ui.conftest import Booth, MakeBooth
from tests.ui.headless import headless, short

SCREENS = sorted(QML.parent.rglob("*.qml"))
FOR_THE_EXPERIMENTER = ("ReplayControls.qml",)
"""What no visitor sees, and speaks English."""

INVISIBLE = ("MultiEffect", "RectangularShadow", "ShaderEffect", "layer.effect", "layer.enabled", "ImageParticle")
"""What the software renderer draws as nothing, without a word."""

KEYS_THAT_LEAVE_ELSEWHERE = (Qt.Key.Key_Escape, Qt.Key.Key_Back, Qt.Key.Key_F11, Qt.Key.Key_Q, Qt.Key.Key_Menu)


def test_no_screen_uses_what_the_software_renderer_cannot_draw() -> None:
    for file in SCREENS:
        text = file.read_text("utf-8")
        assert [effect for effect in INVISIBLE if effect in text] == [], file


def test_no_screen_has_a_timer_or_a_sentence_of_its_own() -> None:
    for file in SCREENS:
        code = re.sub(r"//.*", "", file.read_text("utf-8"))
        assert "Timer {" not in code, file
        assert file.name in FOR_THE_EXPERIMENTER or not re.findall(r'\btext: "[^"]*[A-Za-z]{2}', code), file


def test_the_screens_show_exactly_the_fixed_texts_and_every_language_has_them() -> None:
    shown = {word for file in SCREENS for word in re.findall(r'"([a-z]+(?:-[a-z]+)+)"', file.read_text("utf-8"))}
    assert shown & set(FIXED) == set(FIXED)
    for catalogue in CATALOGUES.values():
        assert [word for word in FIXED if word not in catalogue] == []


def test_the_window_refuses_to_be_closed_until_the_kiosk_is_left(booth: Booth) -> None:
    assert not booth.app.window.close()
    assert booth.app.window.isVisible()
    booth.app.screens.kiosk.let_go()
    assert booth.app.window.close()


@pytest.mark.parametrize("key", KEYS_THAT_LEAVE_ELSEWHERE)
def test_a_key_that_leaves_other_programs_does_nothing(booth: Booth, key: Qt.Key) -> None:
    booth.start_game()
    booth.press(key)
    booth.press(Qt.Key.Key_F4, Qt.KeyboardModifier.AltModifier)
    booth.click("card-7", Qt.MouseButton.RightButton)
    assert booth.screen == "game"
    assert booth.app.window.isVisible()
    assert len(booth.app.screens.board.closed) == 24


def test_a_session_needs_no_mouse(booth: Booth) -> None:
    booth.press(Qt.Key.Key_Return)
    assert booth.screen == "introduction"
    booth.press(Qt.Key.Key_Space)
    assert booth.screen == "game"
    booth.press(Qt.Key.Key_Right)
    booth.press(Qt.Key.Key_Down)
    booth.press(Qt.Key.Key_Return)
    ((position, _),) = booth.app.screens.board.unmatched.items()
    assert (position.row, position.column) == (1, 1)


def test_every_card_has_a_name_for_those_who_cannot_see_it(booth: Booth) -> None:
    booth.start_game()
    label = booth.item("card-7").property("label")
    assert label == "Closed card, row 2, column 2"
    booth.click("card-7")
    assert re.fullmatch(r"[a-z]+, row 2, column 2", booth.item("card-7").property("label"))


@pytest.mark.parametrize(("width", "height"), [(1280, 720), (1920, 1080), (3840, 2160), (1024, 768), (1080, 1920)])
def test_everything_that_can_be_clicked_lies_inside_a_window_of_any_size(
    booth: Booth, qtbot: QtBot, width: int, height: int
) -> None:
    window = booth.app.window
    window.resize(width, height)
    qtbot.waitUntil(lambda: window.contentItem().width() == width)
    names = {
        "attract": ["start-en", "start-it", "start-es"],
        "about": ["continue"],
        "age": ["age-yes", "age-no"],
        "introduction": ["continue"],
        "game": [f"card-{location}" for location in range(24)],
        "result": ["continue"],
        "practice": ["skip", *(f"card-{location}" for location in range(24))],
        "form": ["continue", *(f"answer-{item}-{value}" for item in ("TR1", "TR2", "TR3") for value in range(1, 6))],
        "debrief": ["continue", "qr", "code"],
        "thanks": ["continue"],
    }
    screens = booth.app.screens
    screens.board.deal(4, 6, 12, "animals", practice=True)
    screens.age.ask(18)
    screens.form.show(Questionnaire.read(ASSETS / "questionnaires" / "trust.toml").items, 1, 3)
    screens.debrief.give_code("ABCD234")
    for screen, items in names.items():
        booth.app.screens.kiosk.show(screen)
        for name in items:
            item = booth.item(name)
            corner = item.mapToScene(item.boundingRect().topLeft())
            assert corner.x() >= 0, (screen, name)
            assert corner.y() >= 0, (screen, name)
            assert corner.x() + item.width() <= width, (screen, name)
            assert corner.y() + item.height() <= height, (screen, name)


def pages(booth: Booth) -> dict[str, bool]:
    """Return which pages there are, by their screens' names, and whether they are made."""
    loaders = [item for item in booth.app.window.findChildren(QQuickItem) if item.inherits("QQuickLoader")]
    named = [loader for loader in loaders if loader.property("name")]
    return {str(loader.property("name")): loader.property("item") is not None for loader in named}


def test_a_page_is_made_when_it_is_first_shown(booth: Booth) -> None:
    assert not any(pages(booth).values())
    booth.app.screens.kiosk.show("consent")
    assert {name for name, is_made in pages(booth).items() if is_made} == {"consent"}


def test_every_page_is_made_before_a_visitor_comes_to_it(qtbot: QtBot, tmp_path: Path) -> None:
    with headless(short(), tmp_path, mode=RunMode(WindowMode.NOWHERE, ClockMode.WALL)) as app:
        booth = Booth(app, tmp_path)
        # All are made in the time between frames, of which a busy machine has little.
        qtbot.waitUntil(lambda: all(pages(booth).values()), timeout=30_000)
        assert len(pages(booth)) == 7
        assert booth.screen == "attract"


def test_the_first_start_screen_takes_a_tap_before_any_page_is_made(qtbot: QtBot, tmp_path: Path) -> None:
    with headless(short(), tmp_path, mode=RunMode(WindowMode.NOWHERE, ClockMode.WALL)) as app:
        assert not app.screens.kiosk.takes_input
        qtbot.waitUntil(lambda: bool(app.window.property("prepares")))
        assert app.screens.kiosk.takes_input
        Booth(app, tmp_path).click("start-en")
        qtbot.waitUntil(lambda: app.screens.kiosk.shown == "introduction")


def test_a_window_takes_the_screens_that_were_loaded_beforehand(qtbot: QtBot, tmp_path: Path) -> None:
    Window.drop_engine()
    Window.begin_to_load()
    with headless(short(), tmp_path) as app:
        engine = QQmlEngine.contextForObject(app.window).engine()
        loaded = engine.findChildren(QQmlComponent, options=Qt.FindChildOption.FindDirectChildrenOnly)[0]
        assert loaded.url().toLocalFile() == str(QML)
        qtbot.waitUntil(loaded.isReady)


def test_larger_text_is_larger_and_still_inside(make_booth: MakeBooth) -> None:
    booth = make_booth(settings=short(screen={"text_size": 1.3}))
    start = booth.item("start-en")
    plain = make_booth().item("start-en")
    assert start.height() > plain.height()


def test_every_card_of_every_deck_is_drawn(booth: Booth) -> None:
    pictures = sorted((ASSETS / "cards").rglob("*.svg"))
    assert len(pictures) >= 14
    blank = [picture.name for picture in pictures if QImage(str(picture)).isNull()]
    assert booth.app.window.isVisible()
    assert blank == []


def test_a_call_that_returns_nothing_costs_no_reference_to_none() -> None:
    # PySide6 6.12.0 loses one each time and aborts after some 5,400 calls.
    thing = QObject()
    before = sys.getrefcount(None)
    for _ in range(20_000):
        thing.setObjectName("x")
    assert abs(sys.getrefcount(None) - before) < 100
