"""Looking at the display from a process of its own: no screen, a screen that is too small, a process that dies."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import dataclass

import psutil
import pytest
from PySide6.QtCore import QSize
from pytestqt.qtbot import QtBot

from kiosk.findings import Finding, State
from kiosk.settings import Settings
from kiosk.study.declared.checked.whole import read_study
from kiosk.ui.booth.full_screen import numbered_screens
from kiosk.ui.probes import frame as drawing
from kiosk.ui.probes.asked import ask, from_json, to_json
from kiosk.ui.probes.frame import SLOW_MS, frame, told
from kiosk.ui.probes.screens import screen, screens


@dataclass
class FakeScreen:
    """A screen of a size."""

    wide: int
    high: int
    ratio: float = 1.0

    def size(self) -> QSize:
        """As Qt tells it."""
        return QSize(self.wide, self.high)

    def devicePixelRatio(self) -> float:  # noqa: N802 - Qt's name
        """As Qt tells it."""
        return self.ratio


def python(program: str) -> tuple[str, ...]:
    """A command that runs this program."""
    return (sys.executable, "-c", program)


def alone(findings: Iterator[Finding]) -> Finding:
    """The one thing that was found."""
    (found,) = findings
    return found


# Screens


@pytest.mark.parametrize(
    ("there", "state"),
    [
        ([FakeScreen(1920, 1080)], State.GOOD),
        ([FakeScreen(1080, 1920)], State.GOOD),
        ([FakeScreen(1280, 720, 2)], State.GOOD),
        ([FakeScreen(1024, 768)], State.WARNING),
        ([FakeScreen(1366, 700)], State.WARNING),
    ],
)
def test_a_screen_is_told_with_its_size_and_missed_where_it_is_too_small(there: list[FakeScreen], state: State) -> None:
    found = screen(there, 0)  # type: ignore[arg-type]  # all that is asked of them
    assert found.state is state
    assert f"{there[0].wide} x {there[0].high}, {there[0].ratio:g}" in found.words


def test_a_screen_that_the_study_names_and_nobody_has_plugged_in_is_told_of() -> None:
    found = screen([FakeScreen(1920, 1080)], 1)  # type: ignore[list-item]  # all that is asked of them
    assert (found.state, "screen 1" in found.words) == (State.WARNING, True)


def test_where_there_is_no_screen_no_sitting_can_be_held(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"):
        monkeypatch.delenv(name, raising=False)
    found = alone(screens(0))
    assert (found.what, found.state) == ("screen", State.BAD)


def test_a_screen_that_is_there_is_looked_at_without_a_window(
    qtbot: QtBot, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    # Buses that nobody answers on: whether the screen is kept lit has its own tests.
    for name in ("DBUS_SESSION_BUS_ADDRESS", "DBUS_SYSTEM_BUS_ADDRESS", "XDG_RUNTIME_DIR"):
        monkeypatch.delenv(name, raising=False)
    del qtbot
    found = list(screens(0))
    assert [each.what for each in found] == ["screen", "desktop", "kept lit"]
    assert numbered_screens()[0].virtualSiblings()
    caplog.clear()


# Drawing


def test_the_kiosk_is_drawn_and_the_time_told(qtbot: QtBot, monkeypatch: pytest.MonkeyPatch) -> None:
    del qtbot
    monkeypatch.setattr(drawing, "FRAMES", 2)
    found = alone(frame(read_study(Settings())))
    assert (found.what, "1920 x 1080" in found.words) == ("drawing", True)


def test_drawing_that_would_be_seen_as_steps_is_told_of() -> None:
    assert [told(ms).state for ms in (5.0, SLOW_MS, SLOW_MS + 1)] == [State.GOOD, State.GOOD, State.WARNING]


# Asking a process


def test_what_a_process_found_comes_back_as_it_was() -> None:
    found = [Finding.good("a", "wörds"), Finding.warning("b", "c", "d"), Finding.bad("e", "f", "g")]
    assert list(from_json(to_json(found))) == found
    assert list(ask("a", python(f"print({to_json(found)!r})"), 10, "r")) == found


@pytest.mark.parametrize(
    ("program", "words"),
    [
        (
            "import sys; sys.exit('qt.qpa: could not connect to display :7\\nand more')",
            "could not connect to display :7",
        ),
        ("import os; os.abort()", "it ended with -6"),
        ("raise OSError('no display')", "OSError: no display"),
    ],
)
def test_a_process_that_qt_ends_is_told_in_its_own_words(program: str, words: str) -> None:
    found = alone(ask("screen", python(program), 10, "plug one in"))
    assert (found.what, found.state, words in found.words) == ("screen", State.BAD, True)


def test_a_process_that_hangs_is_ended() -> None:
    hangs = "import time; time.sleep(60)"
    found = alone(ask("screen", python(hangs), 0.5, "plug one in"))
    assert (found.state, "no answer" in found.words) == (State.BAD, True)
    assert psutil.Process().children() == []
