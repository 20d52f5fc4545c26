"""The window at a booth: on the screen that was chosen, with a pointer that rests, on a machine that stays awake."""

from __future__ import annotations

import json
import logging
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from PySide6.QtCore import QObject, QPoint, Qt
from PySide6.QtGui import QGuiApplication, QWindow
from PySide6.QtQuick import QQuickWindow
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from kiosk.ui import kiosk_window
from kiosk.ui.kiosk_window import CursorAutohide, FocusGuard, FullScreen, KeepAwake, KioskWindow

ROOT = Path(__file__).parents[2]
SCREENS = [(0, 0, 1920, 1080), (1920, 0, 1280, 720), (3200, 0, 1080, 1920), (4280, 0, 3840, 2160)]


Told = dict[str, Any]


def on_screens(folder: Path, *numbers: int, ratio: float = 1.0) -> dict[str, Told]:
    """Return what happens to a booth's window on faked screens, opened on each of these in turn."""
    names = ("x", "y", "width", "height")
    screens = [
        {"name": f"screen {n}", "logicalDpi": 96, "dpr": 1} | dict(zip(names, screen, strict=True))
        for n, screen in enumerate(SCREENS)
    ]
    (folder / "screens.json").write_text(json.dumps({"screens": screens}))
    environment = os.environ | {
        "QT_QPA_PLATFORM": f"offscreen:configfile={folder / 'screens.json'}",
        "QT_SCALE_FACTOR": str(ratio),
    }
    command = [sys.executable, "-m", "tests.ui.many_screens", *map(str, numbers)]
    ran = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, timeout=60, check=True)
    told: dict[str, Told] = json.loads(ran.stdout)
    return told


@pytest.fixture(scope="module")
def told(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Told]:
    """Return what happens on each screen that is there, and on one that is not."""
    return on_screens(tmp_path_factory.mktemp("screens"), 0, 1, 2, 3, 7)


@pytest.mark.parametrize("number", range(4))
def test_the_window_covers_the_screen_of_its_number(told: dict[str, Told], number: int) -> None:
    assert told[str(number)]["places"]["at first"] == list(SCREENS[number])


def test_the_window_goes_to_the_primary_screen_when_its_own_is_pulled_out_and_back_again(told: dict[str, Told]) -> None:
    assert told["2"]["places"]["pulled out"] == list(SCREENS[0])
    assert told["2"]["places"]["plugged in"] == list(SCREENS[2])
    assert told["2"]["told"] == ["there is no screen 2, so the primary one is taken; there are 1"]


def test_a_screen_that_is_not_there_is_told_once_and_the_primary_one_taken(told: dict[str, Told]) -> None:
    assert told["7"]["places"]["at first"] == list(SCREENS[0])
    assert told["7"]["told"][0] == "there is no screen 7, so the primary one is taken; there are 4"
    assert len(told["7"]["told"]) == 1


def test_the_window_covers_its_screen_again_when_the_resolution_changes(told: dict[str, Told]) -> None:
    assert told["0"]["places"]["resized"] == list(SCREENS[0])


@pytest.mark.parametrize("ratio", [1.0, 1.5, 2.0])
def test_the_window_covers_its_screen_at_any_density(told: dict[str, Told], tmp_path: Path, ratio: float) -> None:
    seen = (told if ratio == 1 else on_screens(tmp_path, 0, ratio=ratio))["0"]
    _, _, width, height = seen["places"]["at first"]
    assert seen["ratio"] == ratio
    assert (width * ratio, height * ratio) == pytest.approx((1920, 1080), abs=ratio)


@pytest.fixture
def window(qtbot: QtBot) -> Iterator[QQuickWindow]:
    """Provide an empty window, shown."""
    window = QQuickWindow()
    window.resize(400, 300)
    window.show()
    qtbot.waitUntil(window.isExposed)
    yield window
    window.close()
    window.deleteLater()


@pytest.fixture
def resting(window: QQuickWindow, monkeypatch: pytest.MonkeyPatch) -> Iterator[CursorAutohide]:
    """Provide a pointer over the window that soon rests."""
    monkeypatch.setattr(kiosk_window, "REST_MS", 20)
    watched = CursorAutohide(window)
    yield watched
    watched.release()
    assert QGuiApplication.overrideCursor() is None


def test_the_pointer_is_hidden_at_rest_and_back_at_the_first_movement(
    resting: CursorAutohide, window: QQuickWindow, qtbot: QtBot
) -> None:
    assert not resting.hidden
    qtbot.waitUntil(lambda: resting.hidden)
    cursor = QGuiApplication.overrideCursor()
    assert cursor is not None
    assert cursor.shape() is Qt.CursorShape.BlankCursor
    QTest.mouseMove(window, QPoint(30, 30))
    qtbot.waitUntil(lambda: QGuiApplication.overrideCursor() is None)
    assert not resting.hidden


def test_a_finger_never_shows_the_pointer(resting: CursorAutohide, window: QQuickWindow, qtbot: QtBot) -> None:
    device = QTest.createTouchDevice()
    QTest.touchEvent(window, device).press(0, QPoint(20, 20), window).commit()
    assert resting.hidden
    QTest.touchEvent(window, device).move(0, QPoint(40, 40), window).commit()
    QTest.touchEvent(window, device).release(0, QPoint(40, 40), window).commit()
    qtbot.wait(1)
    assert resting.hidden


class FakeDesktop:
    """A desktop on which another window can lie over ours."""

    def __init__(self) -> None:
        self.covered = False
        self.asked: list[str] = []

    def show_on_every_desktop(self) -> None:
        self.asked.append("stick")

    def clear(self) -> bool:
        covered, self.covered = self.covered, False
        return covered

    def activate(self) -> None:
        self.asked.append("activate")

    def close(self) -> None:
        self.asked.append("close")


@pytest.fixture
def desktop() -> FakeDesktop:
    """Return a desktop that answers every request."""
    return FakeDesktop()


@pytest.fixture
def held(window: QQuickWindow, desktop: FakeDesktop, monkeypatch: pytest.MonkeyPatch) -> Iterator[FullScreen]:
    """Provide the window, held over its screen."""
    monkeypatch.setattr(kiosk_window, "LOOK_MS", 10)
    owner = QObject()
    full_screen = FullScreen(window, 0, owner)
    holding = FocusGuard(window, full_screen, lambda: desktop, owner)
    yield full_screen
    holding.release()
    owner.deleteLater()


WAYS_OUT: dict[str, Callable[[QWindow], object]] = {
    "minimised": lambda window: window.showMinimized(),
    "made small": lambda window: window.showNormal(),
    "moved": lambda window: window.setGeometry(100, 100, 200, 200),
    "hidden": lambda window: window.hide(),
}


@pytest.mark.parametrize("way", WAYS_OUT)
def test_a_window_that_was_left_comes_back_by_itself(
    held: FullScreen, window: QQuickWindow, qtbot: QtBot, way: str
) -> None:
    qtbot.waitUntil(lambda: held.covers)
    WAYS_OUT[way](window)
    qtbot.waitUntil(lambda: held.covers and window.isExposed())


def test_whatever_lies_over_the_window_is_put_below_it(
    held: FullScreen, window: QQuickWindow, desktop: FakeDesktop, qtbot: QtBot
) -> None:
    qtbot.waitUntil(lambda: held.covers and window.isActive() and "stick" in desktop.asked)
    desktop.asked.clear()
    desktop.covered = True
    qtbot.waitUntil(lambda: "activate" in desktop.asked)
    assert not desktop.covered


class FakeWay:
    """A way to stay awake that answers as the test says."""

    def __init__(self, name: str, refusal: str | None) -> None:
        self.name = name
        self._refusal = refusal
        self.released = False

    def inhibit(self, told: Callable[[str | None], None]) -> None:
        told(self._refusal)

    def release(self) -> None:
        self.released = True


def test_the_health_says_who_holds_the_screen_saver_off(caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.WARNING):
        awake = KeepAwake([FakeWay("the X server", None), FakeWay("the desktop", "there is no bus")])
    assert awake.health.is_ok
    assert awake.health.message == "screen saver and sleep are held off by the X server"
    assert [record.getMessage() for record in caplog.records] == [
        "screen saver and sleep are not held off by the desktop: there is no bus"
    ]


def test_the_health_says_why_nobody_holds_the_screen_saver_off() -> None:
    awake = KeepAwake([FakeWay("the desktop", "there is no bus"), FakeWay("the system", "it refused")])
    assert not awake.health.is_ok
    assert awake.health.message.endswith("not held off: the desktop: there is no bus; the system: it refused")


def test_the_screen_may_go_dark_again_when_the_kiosk_is_left() -> None:
    ways = [FakeWay("the desktop", None), FakeWay("the system", "it refused")]
    KeepAwake(ways).release()
    assert all(way.released for way in ways)


def test_what_keeps_awake_is_asked_for_after_the_first_frame(qtbot: QtBot, monkeypatch: pytest.MonkeyPatch) -> None:
    from kiosk.ui import keep_awake  # noqa: PLC0415 - what is asked for is put in its place

    asked = FakeWay("the desktop", None)
    monkeypatch.setattr(keep_awake, "all_inhibitors", lambda: iter([asked]))
    owner, window = QObject(), QQuickWindow()
    booth = KioskWindow(window, 0, owner)
    assert "not held off yet" in booth.health[1].message
    qtbot.waitUntil(lambda: booth.health[1].is_ok)
    assert booth.health[0].message.startswith("the window covers its screen")
    booth.release()
    assert asked.released
    window.close()
    owner.deleteLater()
