"""Looking at the display from a process of its own: no screen, a screen that is too small, a process that dies."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import dataclass

import psutil
import pytest
from PySide6.QtCore import QSize
from pytestqt.qtbot import QtBot

from kiosk.config import Settings
from kiosk.preflight import CheckResult, Severity
from kiosk.study.loader import read_study
from kiosk.ui import checks as ui_checks
from kiosk.ui.checks import (
    SLOW_MS,
    covered_screen_check,
    frame_check,
    frame_result,
    from_json,
    run_check_process,
    screens_check,
    to_json,
)
from kiosk.ui.qt_platform import numbered_screens


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
    """Return a command that runs this program."""
    return (sys.executable, "-c", program)


def alone(results: Iterator[CheckResult]) -> CheckResult:
    """Return the one thing that was found."""
    (found,) = results
    return found


# Screens


@pytest.mark.parametrize(
    ("there", "state"),
    [
        ([FakeScreen(1920, 1080)], Severity.OK),
        ([FakeScreen(1080, 1920)], Severity.OK),
        ([FakeScreen(1280, 720, 2)], Severity.OK),
        ([FakeScreen(1024, 768)], Severity.WARNING),
        ([FakeScreen(1366, 700)], Severity.WARNING),
    ],
)
def test_a_screen_is_told_with_its_size_and_missed_where_it_is_too_small(
    there: list[FakeScreen], state: Severity
) -> None:
    found = covered_screen_check(there, 0)  # type: ignore[arg-type]  # all that is asked of them
    assert found.severity is state
    assert f"{there[0].wide} x {there[0].high}, {there[0].ratio:g}" in found.message


def test_a_screen_that_the_study_names_and_nobody_has_plugged_in_is_told_of() -> None:
    found = covered_screen_check([FakeScreen(1920, 1080)], 1)  # type: ignore[list-item]  # all that is asked of them
    assert (found.severity, "screen 1" in found.message) == (Severity.WARNING, True)


def test_where_there_is_no_screen_no_session_can_be_held(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"):
        monkeypatch.delenv(name, raising=False)
    found = alone(screens_check(0))
    assert (found.name, found.severity) == ("screen", Severity.ERROR)


def test_a_screen_that_is_there_is_looked_at_without_a_window(
    qtbot: QtBot, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    # Buses without an answer: whether the screen is kept lit has its own tests.
    for name in ("DBUS_SESSION_BUS_ADDRESS", "DBUS_SYSTEM_BUS_ADDRESS", "XDG_RUNTIME_DIR"):
        monkeypatch.delenv(name, raising=False)
    del qtbot
    found = list(screens_check(0))
    assert [each.name for each in found] == ["screen", "desktop", "kept lit"]
    assert numbered_screens()[0].virtualSiblings()
    caplog.clear()


# Drawing


def test_the_kiosk_is_drawn_and_the_time_told(qtbot: QtBot, monkeypatch: pytest.MonkeyPatch) -> None:
    del qtbot
    monkeypatch.setattr(ui_checks, "FRAMES", 2)
    found = alone(frame_check(read_study(Settings())))
    assert (found.name, "1920 x 1080" in found.message) == ("drawing", True)


def test_drawing_that_would_be_seen_as_steps_is_told_of() -> None:
    assert [frame_result(ms).severity for ms in (5.0, SLOW_MS, SLOW_MS + 1)] == [
        Severity.OK,
        Severity.OK,
        Severity.WARNING,
    ]


# Asking a process


def test_what_a_process_found_comes_back_as_it_was() -> None:
    found = [CheckResult.ok("a", "wörds"), CheckResult.warning("b", "c", "d"), CheckResult.error("e", "f", "g")]
    assert list(from_json(to_json(found))) == found
    assert list(run_check_process("a", python(f"print({to_json(found)!r})"), 10, "r")) == found


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
    found = alone(run_check_process("screen", python(program), 10, "plug one in"))
    assert (found.name, found.severity, words in found.message) == ("screen", Severity.ERROR, True)


def test_a_process_that_hangs_is_ended() -> None:
    before = set(psutil.Process().children())  # other tests of this worker may have left a process that is ending
    hangs = "import time; time.sleep(60)"
    found = alone(run_check_process("screen", python(hangs), 0.5, "plug one in"))
    assert (found.severity, "no answer" in found.message) == (Severity.ERROR, True)
    assert found.remedy == "end other programs, if the machine is busy; otherwise plug one in"
    assert set(psutil.Process().children()) <= before
