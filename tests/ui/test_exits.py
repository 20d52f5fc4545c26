"""A visitor cannot leave the kiosk: a part of ``python -m tests.ui.exits`` that is quick enough for every day."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest

from kiosk.experiment.events import AbortRequested
from tests.ui.conftest import Booth, shared_booth
from tests.ui.exits.attempts import ATTEMPTS, Attempt
from tests.ui.exits.desktops import Desktop, kiosk_on
from tests.ui.exits.hands import Hands
from tests.ui.exits.kiosk import CARDS, TOUCHES, Fingers
from tests.ui.headless import PLAIN, VIRTUAL

NO_KEY = Qt.KeyboardModifier.NoModifier
BACK_S = 10
"""Far longer than it takes; how long that is, ``tests.ui.exits`` measures."""

QUICK = (
    *("Alt+F4", "Escape", "Ctrl+Q", "Alt+Tab", "Alt+Space", "Super+D", "Super+F2", "Ctrl+Alt+Right", "Ctrl+Alt+T"),
    *(
        "right click",
        "drag with Alt (moves windows)",
        "wheel with Alt (changes desktops)",
        "close by the window manager",
    ),
    *("WM_DELETE_WINDOW", "minimise", "unmap at the server", "send to another desktop"),
    *(
        "show the empty desktop",
        "another window above all",
        "an unmanaged window",
        "move and resize at the server",
    ),
)


@pytest.fixture(scope="module", params=[Desktop.STOCK, Desktop.SHIPPED], ids=lambda desktop: desktop.name.lower())
def hands(request: pytest.FixtureRequest) -> Iterator[Hands]:
    """Hands in front of a kiosk on a virtual desktop."""
    desktop: Desktop = request.param
    if desktop.missing:
        pytest.skip(f"{', '.join(desktop.missing)} is not installed")
    with kiosk_on(desktop) as kiosk, closing(Hands(kiosk)) as hands:
        yield hands


@pytest.mark.parametrize("attempt", [a for a in ATTEMPTS if a.name in QUICK], ids=lambda attempt: attempt.name)
def test_the_kiosk_stands_after_an_attempt_to_leave_it(hands: Hands, attempt: Attempt) -> None:
    assert hands.wait(BACK_S).holds
    attempt.do(hands)
    assert hands.wait(BACK_S).lacks == ""
    hands.tidy()
    assert hands.wait(BACK_S).lacks == ""
    assert hands.answers(ATTEMPTS.index(attempt) % 24)


def test_every_quick_attempt_is_one_of_the_list() -> None:
    assert len(ATTEMPTS) >= 25
    assert {attempt.name for attempt in ATTEMPTS} >= set(QUICK)


@pytest.fixture(scope="module")
def at_work(qapp: QGuiApplication, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Booth]:  # noqa: ARG001 - Qt is to be there
    """Provide one booth for all attempts in front of it."""
    with shared_booth(PLAIN, tmp_path_factory.mktemp("data"), mode=VIRTUAL) as booth:
        yield booth


@pytest.fixture
def booth(at_work: Booth) -> Booth:
    """Return the booth in a game of which no card was touched."""
    app, runner = at_work.app, at_work.app.runner
    if at_work.screen == "game" and len(app.screens.board.closed) < CARDS:
        runner.dispatch(AbortRequested(at_ms=runner.now_ms(), reason="a test"))
        at_work.wait_until(lambda: at_work.screen == "attract")
    if at_work.screen == "attract":
        at_work.start_game()
    assert (at_work.screen, len(app.screens.board.closed)) == ("game", CARDS)
    return at_work


@pytest.mark.parametrize("gesture", TOUCHES)
def test_fingers_do_not_leave_the_kiosk(booth: Booth, gesture: str) -> None:
    booth.settle()
    TOUCHES[gesture](Fingers(booth.app))
    assert booth.screen == "game"
    assert booth.app.window.isVisible()
    taps: list[object] = []
    tapped = booth.app.screens.board.tapped
    tapped.connect(taps.append)
    booth.click("card-23")
    tapped.disconnect(taps.append)
    assert len(taps) == 1


@pytest.mark.parametrize("button", [Qt.MouseButton.RightButton, Qt.MouseButton.MiddleButton, Qt.MouseButton.BackButton])
def test_no_other_button_does_anything(booth: Booth, button: Qt.MouseButton) -> None:
    booth.click("card-3", button)
    assert booth.screen == "game"
    assert len(booth.app.screens.board.closed) == CARDS


@pytest.mark.parametrize("key", [Qt.Key.Key_Print, Qt.Key.Key_Menu, Qt.Key.Key_F1, Qt.Key.Key_F10, Qt.Key.Key_Super_L])
def test_keys_that_open_something_elsewhere_do_nothing(booth: Booth, key: Qt.Key) -> None:
    booth.settle()
    QTest.keyClick(booth.app.window, key, NO_KEY)
    assert booth.screen == "game"
    assert len(booth.app.screens.board.closed) == CARDS
