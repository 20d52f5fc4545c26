"""The experimenter's strip shows the day and the board on a second screen, and nothing of the condition."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import pytest
from pydantic import ValidationError
from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtQuick import QQuickItem

from kiosk.config import Settings
from kiosk.experiment.booth_status import CLOSED, AlarmStatus, PartStatus, utc
from kiosk.game import Position
from kiosk.ui.experimenter import operator_strip
from kiosk.ui.experimenter.operator_strip import OperatorStrip, operator_screen, strip_place
from tests.samples import ENGLISH
from tests.samples import PLAYING as WELL
from tests.ui.experimenter.conftest import Desk


@pytest.fixture
def strip(assigner: Desk) -> Iterator[OperatorStrip]:
    """Return the strip beside a visitor's window."""
    made = OperatorStrip(assigner.app._window.engine, assigner.app.screens.board, ENGLISH)
    yield made
    made.close()


def cards(strip: OperatorStrip) -> list[QQuickItem]:
    """Return the small cards."""
    mirror = strip.window.findChild(QQuickItem, "mirror")
    assert mirror is not None
    return [item for item in mirror.childItems() if item.property("up") is not None]


def test_it_tells_the_day_the_stage_and_that_all_is_well(strip: OperatorStrip) -> None:
    strip.update(WELL)
    assert [(tile["title"], tile["value"]) for tile in strip.window.property("tiles")] == [
        ("Visitors today", "3"),
        ("Completed today", "2"),
        ("Now", "Game, for 3 min"),
    ]
    assert strip.window.property("words") == "All is well"
    assert strip.window.property("well") is True


def test_it_tells_what_is_wrong_now_and_not_what_has_passed(strip: OperatorStrip) -> None:
    alarms = (
        AlarmStatus("disk_low", utc(0), seen=False, passed=None),
        AlarmStatus("robot_lost", utc(0), seen=True, passed=utc(1)),
    )
    voice = (AlarmStatus("voice_lost", utc(0), seen=False, passed=None),)
    strip.update(replace(WELL, alarms=alarms + voice, parts=(PartStatus("voice", ok=False, message="no device"),)))
    assert strip.window.property("words") == "The disk has not enough room for another hour; voice: no device"
    assert strip.window.property("well") is False


def test_the_last_status_of_a_kiosk_changes_nothing(strip: OperatorStrip) -> None:
    strip.update(WELL)
    strip.update(replace(WELL, stage=CLOSED))
    assert strip.window.property("tiles")[2]["value"] == "Game, for 3 min"


def test_the_board_of_the_session_is_mirrored(assigner: Desk, strip: OperatorStrip) -> None:
    board = assigner.app.screens.board
    assert not cards(strip)
    board.deal(2, 3, 3, "animals")
    board.reveal(Position(1, 2), "frog")
    assert [card.property("up") for card in cards(strip)] == [False] * 5 + [True]


def test_it_takes_no_keys_and_lies_along_the_lower_edge(strip: OperatorStrip) -> None:
    assert strip.window.flags() & Qt.WindowType.WindowDoesNotAcceptFocus
    assert strip_place(QRect(1920, 0, 1920, 1080)) == QRect(1920, 983, 1920, 97)
    assert strip_place(QRect(0, 0, 800, 600)).height() == 72
    screen = QGuiApplication.primaryScreen()
    strip.show(screen)
    assert strip.window.geometry() == strip_place(screen.geometry())


def test_it_is_shown_while_its_screen_is_there_and_never_to_visitors(
    strip: OperatorStrip, qapp: QGuiApplication, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    screen, there = qapp.primaryScreen(), list(qapp.screens())
    monkeypatch.setattr(operator_strip, "numbered_screens", lambda: there)
    strip.follow(1)
    assert not strip.window.isVisible()
    assert "there is no screen 1" in caplog.text
    there.append(screen)
    qapp.screenAdded.emit(screen)
    qapp.processEvents()
    assert strip.window.isVisible()
    strip.window.setX(strip.window.x() - 190)
    there.pop()
    qapp.screenRemoved.emit(screen)
    qapp.processEvents()
    assert not strip.window.isVisible()
    there.append(screen)
    qapp.screenAdded.emit(screen)
    qapp.processEvents()
    assert strip.window.geometry() == strip_place(screen.geometry())


def test_the_screen_that_visitors_have_for_want_of_their_own_is_not_taken(qapp: QGuiApplication) -> None:
    screens = qapp.screens()[:1]
    assert operator_screen(screens, 0, visitors=1) is None
    assert operator_screen(screens, 0) is screens[0]


def test_the_visitors_screen_is_refused() -> None:
    with pytest.raises(ValidationError, match="must not be the screen of the visitors"):
        Settings.model_validate({"screen": {"display": 1, "operator_display": 1}})
    assert Settings.model_validate({"screen": {"operator_display": 1}}).screen.operator_display == 1
