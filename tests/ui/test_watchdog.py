"""The kiosk sends signs of life from its own event loop, only to those who asked."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from itertools import groupby
from pathlib import Path

import pytest
from PySide6.QtQuick import QQuickWindow
from pytestqt.qtbot import QtBot

from kiosk.sd_notify import NotifySocketListener
from kiosk.ui.event_loop import heartbeat
from kiosk.ui.screens.shell import KioskScreen
from tests.samples import ENGLISH
from tests.ui.conftest import MakeBooth
from tests.ui.headless import TINY

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="there are no Unix sockets")

EVERY_40_MS = {"WATCHDOG_USEC": "40000"}


@pytest.fixture
def window(qtbot: QtBot) -> Iterator[QQuickWindow]:
    """Provide an empty window that is not shown yet."""
    made = QQuickWindow()
    yield made
    made.close()
    del qtbot


@pytest.fixture
def listener(tmp_path: Path) -> Iterator[NotifySocketListener]:
    """Open a listener for signs of life."""
    made = NotifySocketListener(tmp_path)
    yield made
    made.close()


def heard(listener: NotifySocketListener) -> list[tuple[str, str]]:
    """Everything that was told since the last time."""
    told: list[tuple[str, str]] = []
    while notice := listener.hear(0):
        told += notice.items()
    return told


def test_a_kiosk_is_ready_when_it_was_drawn_and_beats_from_then_on(
    qtbot: QtBot, window: QQuickWindow, listener: NotifySocketListener
) -> None:
    told: list[tuple[str, str]] = []

    def beats(least: int) -> bool:
        told.extend(heard(listener))
        return told.count(("WATCHDOG", "1")) >= least

    with heartbeat(window, KioskScreen(ENGLISH), listener.environment | EVERY_40_MS):
        assert heard(listener) == []
        window.show()
        qtbot.waitUntil(lambda: beats(3))
        assert told[:2] == [("READY", "1"), ("STATUS", "attract")]
    assert heard(listener)[-1] == ("STOPPING", "1")


def test_a_loop_that_does_not_turn_is_silent(
    qtbot: QtBot, window: QQuickWindow, listener: NotifySocketListener
) -> None:
    with heartbeat(window, KioskScreen(ENGLISH), listener.environment | EVERY_40_MS):
        window.show()
        qtbot.waitUntil(lambda: ("WATCHDOG", "1") in heard(listener))
        heard(listener)
        assert listener.hear(0.2) == {}


def test_every_screen_is_told_by_its_name(qtbot: QtBot, window: QQuickWindow, listener: NotifySocketListener) -> None:
    kiosk = KioskScreen(ENGLISH)
    with heartbeat(window, kiosk, listener.environment):
        kiosk.show("game")
        assert heard(listener) == [("STATUS", "game")]
    kiosk.show("result")
    assert heard(listener) == [("STOPPING", "1")]
    del qtbot


def test_without_a_wish_for_beats_there_are_none(
    qtbot: QtBot, window: QQuickWindow, listener: NotifySocketListener
) -> None:
    with heartbeat(window, KioskScreen(ENGLISH), listener.environment):
        window.show()
        qtbot.waitUntil(lambda: ("READY", "1") in heard(listener))
        qtbot.wait(50)
        assert heard(listener) == []


def test_a_kiosk_whose_supervisor_is_gone_is_told_once(
    qtbot: QtBot, window: QQuickWindow, listener: NotifySocketListener
) -> None:
    left: list[str] = []
    environment = listener.environment | EVERY_40_MS
    with heartbeat(window, KioskScreen(ENGLISH), environment, alone=lambda: left.append("alone")):
        window.show()
        # It may be lost before the first beat.
        qtbot.waitUntil(lambda: ("READY", "1") in heard(listener))
        assert left == []
        listener.close()
        qtbot.waitUntil(lambda: left != [])
        qtbot.wait(100)
    assert left == ["alone"]


class Told:
    """Keeps the notices: a socket that is never emptied takes only so much."""

    def __init__(self, _: object) -> None:
        self.screens: list[str] = []
        Told.last = self

    def tell(self, **notice: object) -> None:
        """Keep the screens."""
        self.screens += [str(notice["STATUS"])] if "STATUS" in notice else []

    def close(self) -> None:
        """Nothing to close."""

    last: Told


def test_a_whole_session_is_told_screen_by_screen(make_booth: MakeBooth, monkeypatch: pytest.MonkeyPatch) -> None:
    booth = make_booth(settings=TINY)
    monkeypatch.setenv("NOTIFY_SOCKET", "somewhere")
    monkeypatch.setattr("kiosk.ui.event_loop.Notifier", Told)
    booth.rehearse(1)
    screens = [screen for screen, _ in groupby(Told.last.screens)]
    assert screens[screens.index("introduction") :] == ["introduction", "game", "result", "form", "attract"]
