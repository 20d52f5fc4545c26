"""The start screen: what is read from three metres away, in every language of the study."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QRectF
from PySide6.QtQuick import QQuickItem
from pytestqt.qtbot import QtBot

from kiosk.ui.simulated_visitor import lay_out
from tests.ui.conftest import Booth, MakeBooth
from tests.ui.headless import short
from tests.ui.looking import items, lies_in

LANGUAGES = ("en", "it", "es")


@pytest.fixture
def booth(make_booth: MakeBooth) -> Booth:
    """Return a booth at the start screen, in three languages."""
    return make_booth(settings=short(languages=LANGUAGES))


def resized(booth: Booth, qtbot: QtBot, width: int, height: int) -> None:
    """Give the window this size."""
    booth.app.window.resize(width, height)
    qtbot.waitUntil(lambda: booth.app.window.contentItem().width() == width)
    lay_out(booth.app.window)


def written(booth: Booth, text: str) -> QQuickItem:
    """Return the one item that shows this text."""
    (found,) = [item for item in items(booth.app.window.contentItem()) if item.property("text") == text]
    return found


def place(item: QQuickItem) -> QRectF:
    """Return where an item is in the window."""
    return item.mapRectToScene(QRectF(0, 0, item.width(), item.height()))


@pytest.mark.parametrize(("width", "height", "name"), [(1920, 1080, 44), (1080, 1920, 52)])
def test_every_language_is_read_from_afar_and_moves_nothing_when_it_comes(
    booth: Booth, qtbot: QtBot, width: int, height: int, name: int
) -> None:
    resized(booth, qtbot, width, height)
    attract, places = booth.app.screens.attract, set()
    for way in attract.property("ways"):
        assert written(booth, way["name"]).property("font").pixelSize() == name
    for _ in LANGUAGES:
        lay_out(booth.app.window)
        promised = booth.item("promise")
        assert promised.property("lineCount") == 1
        assert promised.property("font").pixelSize() >= 46
        line = written(booth, str(attract.property("line")))
        assert line.property("font").pixelSize() >= 50
        assert line.property("lineCount") == (2 if width > height else 1)
        places.add(round(place(booth.item("start-en")).y() / 2))
        attract.next_language()
    assert len(places) == 1


def test_the_bubble_on_a_wide_screen_hugs_its_words_above_the_face_away_from_the_edge(
    booth: Booth, qtbot: QtBot
) -> None:
    resized(booth, qtbot, 1920, 1080)
    attract, widths = booth.app.screens.attract, set()
    for _ in LANGUAGES:
        lay_out(booth.app.window)
        words = written(booth, str(attract.property("line")))
        assert lies_in(words, "Bubble")
        box, face = place(words.parentItem()), place(booth.item("face"))
        assert box.right() <= 1920 - 64
        assert box.center().x() == pytest.approx(face.center().x(), abs=1)
        # A fifth of it or less is beside the words, the air at both sides included.
        assert words.property("contentWidth") > 0.8 * box.width()
        widths.add(round(box.width()))
        attract.next_language()
    assert max(widths) <= 562
    assert len(widths) > 1
