"""Reading, scrolling and keys are signs of life; any touch or key answers the question."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from datetime import UTC, datetime
from pathlib import Path
from shutil import copytree

import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QGuiApplication, QKeyEvent, QWheelEvent
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from kiosk.config import ASSETS, Settings
from kiosk.experiment import events as happened
from kiosk.experiment.effects import Outcome
from kiosk.experiment.events import InputDevice, WorldEvent
from kiosk.experiment.outcomes import EmbodimentName, Stage
from kiosk.store.queries import open_repository
from kiosk.ui.event_loop import VirtualClock
from tests.ui.conftest import Booth, MakeBooth, shared_booth
from tests.ui.headless import SMALL, short
from tests.ui.reaching import touch_screen
from tests.ui.touring import PIN, SHORTCUT, whole_study

LEFT, NO_KEY = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
EVERY_MS = 10_000
PLACE = QPoint(250, 250)
IDLE_MS = SMALL.idle_ms.about


def pass_time(booth: Booth, ms: int) -> None:
    """Let so much time pass, with everything that is due in it."""
    clock, over = booth.app.clock, list[bool]()
    assert isinstance(clock, VirtualClock)
    clock.after(ms, lambda: over.append(True))
    while not over:
        clock.jump()


def key(code: Qt.Key, *, again: bool = False) -> Callable[[Booth], None]:
    """Press a key and let it go, or let one repeat that was down before."""

    def act(booth: Booth) -> None:
        for kind in (QEvent.Type.KeyPress, QEvent.Type.KeyRelease):
            QGuiApplication.sendEvent(booth.app.window, QKeyEvent(kind, code, NO_KEY, "", again))

    return act


def turn_wheel(booth: Booth) -> None:
    """Turn the wheel of the mouse."""
    at = QPointF(PLACE)
    phase = Qt.ScrollPhase.NoScrollPhase
    turned = QWheelEvent(at, at, QPoint(), QPoint(0, -120), Qt.MouseButton.NoButton, NO_KEY, phase, False)  # noqa: FBT003 - Qt's signature
    QGuiApplication.sendEvent(booth.app.window, turned)


def drag_mouse(booth: Booth) -> None:
    """Drag with the mouse."""
    window = booth.app.window
    QTest.mousePress(window, LEFT, NO_KEY, PLACE)
    QTest.mouseMove(window, PLACE + QPoint(0, 40))
    QTest.mouseRelease(window, LEFT, NO_KEY, PLACE + QPoint(0, 40))


def touch(booth: Booth) -> None:
    """Touch the screen where there is nothing."""
    window = booth.app.window
    QTest.touchEvent(window, touch_screen()).press(0, PLACE, window).commit()
    QTest.touchEvent(window, touch_screen()).release(0, PLACE, window).commit()


def point(booth: Booth) -> None:
    """Move the mouse across the screen."""
    for x in range(0, 200, 40):
        QTest.mouseMove(booth.app.window, PLACE + QPoint(x, 0))


SIGNS = {
    "page down": key(Qt.Key.Key_PageDown),
    "arrow": key(Qt.Key.Key_Down),
    "tab": key(Qt.Key.Key_Tab),
    "letter": key(Qt.Key.Key_A),
    "wheel": turn_wheel,
    "drag": drag_mouse,
    "touch": touch,
    "pointer": point,
}
ANSWERS = {name: sign for name, sign in SIGNS.items() if name != "pointer"}


def move_mouse(booth: Booth) -> None:
    """Move the mouse, as a table does that is bumped."""
    QTest.mouseMove(booth.app.window, PLACE)
    QTest.mouseMove(booth.app.window, PLACE + QPoint(3, 1))
    QTest.mouseMove(booth.app.window, PLACE)


NO_SIGNS = {
    "moved mouse": move_mouse,
    "key that lies there": key(Qt.Key.Key_PageDown, again=True),
    "half a shortcut": key(Qt.Key.Key_Control),
}


@pytest.fixture(scope="module")
def at_work(qapp: QGuiApplication, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Booth]:  # noqa: ARG001 - Qt is to be there
    """Provide one booth for all visitors who read."""
    with shared_booth(SMALL, tmp_path_factory.mktemp("data")) as booth:
        yield booth


@pytest.fixture
def reading(at_work: Booth, qtbot: QtBot) -> Booth:
    """Return that booth, whose visitor has just begun to read what it is about."""
    app = at_work.app
    app.window.requestActivate()
    qtbot.waitUntil(app.window.isActive)
    if at_work.screen != "attract":
        app.runner.dispatch(happened.AbortRequested(at_ms=app.runner.now_ms(), reason="a test"))
        at_work.wait_until(lambda: at_work.screen == "attract")
    at_work.click("start-en")
    at_work.settle()
    assert at_work.screen == "about"
    return at_work


@pytest.fixture
def told(reading: Booth, monkeypatch: pytest.MonkeyPatch) -> list[WorldEvent]:
    """Return what is recorded from now on, but for waits and voices."""
    events: list[WorldEvent] = []
    kinds = (happened.UserActivity, happened.PresenceConfirmed, happened.IdleTimedOut)

    def tell(event: WorldEvent, _outcome: Outcome, _stage: Stage) -> None:
        if isinstance(event, kinds):
            events.append(event)

    monkeypatch.setattr(reading.app.runner, "on_event", tell)
    return events


def asked(booth: Booth) -> bool:
    """Whether the visitor is asked if they are still there."""
    return bool(booth.app.screens.kiosk.property("asksStillThere"))


def test_the_digits_of_a_pin_do_not_answer_for_the_visitor(make_booth: MakeBooth) -> None:
    # It comes before the tests that share a kiosk, which would take the panel's shortcut as well.
    booth = make_booth(settings=whole_study())
    booth.click("start-en")
    booth.wait_until(lambda: asked(booth))
    booth.settle()
    booth.press(Qt.Key.Key_P, SHORTCUT)
    for digit in PIN[:2]:
        QTest.keyClick(booth.app.window, digit)  # type: ignore[call-overload]  # it takes characters
    assert asked(booth)


@pytest.mark.parametrize("sign", SIGNS.values(), ids=SIGNS.keys())
def test_a_sign_of_life_every_ten_seconds_keeps_the_question_away(
    reading: Booth, told: list[WorldEvent], sign: Callable[[Booth], None]
) -> None:
    for _ in range(3 * IDLE_MS // EVERY_MS):
        pass_time(reading, EVERY_MS)
        sign(reading)
        assert not asked(reading)
        assert reading.screen == "about"
    # The record grows by one event for each idle time, not by one for each key.
    assert {type(event) for event in told} == {happened.UserActivity}
    assert len(told) <= 4


@pytest.mark.parametrize("sign", NO_SIGNS.values(), ids=NO_SIGNS.keys())
def test_what_nobody_does_does_not_keep_it_away(
    reading: Booth, told: list[WorldEvent], sign: Callable[[Booth], None]
) -> None:
    sign(reading)
    for _ in range(IDLE_MS // EVERY_MS + 1):
        pass_time(reading, EVERY_MS)
        sign(reading)
    assert asked(reading)
    reading.settle()
    sign(reading)
    assert asked(reading)
    # The pointer came to its place when the visitor began, and that was a sign of life.
    assert all(isinstance(event, happened.UserActivity) and event.ago_ms > IDLE_MS - EVERY_MS for event in told)


def test_the_question_comes_one_idle_time_after_the_last_sign(reading: Booth) -> None:
    pass_time(reading, 25_000)
    key(Qt.Key.Key_PageDown)(reading)
    pass_time(reading, IDLE_MS - 1)
    assert not asked(reading)
    pass_time(reading, 1)
    assert asked(reading)


def test_who_taps_all_the_time_leaves_no_other_sign_in_the_record(reading: Booth, told: list[WorldEvent]) -> None:
    reading.click("continue")
    reading.click("age-yes")
    for _ in range(20):
        pass_time(reading, EVERY_MS)
        reading.click(f"purpose-{reading.app.screens.consent.offered[0]}")
    assert told == []


@pytest.mark.parametrize("answer", ANSWERS.values(), ids=ANSWERS.keys())
def test_any_touch_or_key_answers_the_question_and_does_nothing_else(
    reading: Booth, told: list[WorldEvent], answer: Callable[[Booth], None]
) -> None:
    reading.wait_until(lambda: asked(reading))
    reading.settle()
    answer(reading)
    assert not asked(reading)
    assert reading.screen == "about"
    assert [type(event) for event in told] == [happened.PresenceConfirmed]


def test_an_answer_by_key_presses_nothing_on_the_page_below(reading: Booth, told: list[WorldEvent]) -> None:
    reading.wait_until(lambda: asked(reading))
    reading.settle()
    for code in (Qt.Key.Key_Return, Qt.Key.Key_Space):
        key(code)(reading)
    assert reading.screen == "about"
    assert [type(event) for event in told] == [happened.PresenceConfirmed]


def test_a_touch_in_the_moment_when_the_question_comes_is_no_answer_yet(reading: Booth) -> None:
    reading.wait_until(lambda: asked(reading))
    touch(reading)
    assert asked(reading)


def test_a_typed_answer_of_few_letters_is_a_sign_too(make_booth: MakeBooth) -> None:
    settings = Settings.model_validate({**SMALL.model_dump(), "stages": ("about_you", "game"), "idle_ms": {}})
    booth = make_booth(settings=settings)
    booth.click("start-en")
    booth.settle()
    for _ in range(3 * settings.idle_ms.about_you // EVERY_MS):
        pass_time(booth, EVERY_MS)
        key(Qt.Key.Key_Backspace)(booth)
    assert not asked(booth)
    assert booth.screen == "form"


def test_what_a_card_was_tapped_with_is_recorded(booth: Booth) -> None:
    booth.start_game()
    booth.click("card-0")
    booth.app.window.requestActivate()
    assert _devices(booth)[-1] is InputDevice.MOUSE
    booth.press(Qt.Key.Key_Return)
    assert _devices(booth)[-1] is InputDevice.KEYBOARD


def _devices(booth: Booth) -> list[InputDevice | None]:
    with open_repository(booth.data) as stored:
        return [event.device for event in stored.events(1) if isinstance(event, happened.CardSelected)]


def test_a_session_begins_with_the_screen_it_is_on_and_no_time_of_day_in_a_rehearsal(booth: Booth) -> None:
    booth.start_game()
    with open_repository(booth.data) as stored:
        first = stored.events(1)[0]
    assert isinstance(first, happened.SessionStarted)
    assert first.setup is not None
    assert (first.setup.intended, first.setup.fallback) == (EmbodimentName.AVATAR, None)
    assert (first.setup.window_width, first.setup.window_height) == (
        booth.app.window.width(),
        booth.app.window.height(),
    )
    assert min(first.setup.screen_width, first.setup.screen_height) > 0
    assert (first.setup.hour_band, first.setup.visitors_before) == (None, None)


def test_on_a_clock_on_the_wall_the_hour_and_the_visitors_before_are_noted(booth: Booth) -> None:
    booth.app.runner.local_time = lambda: datetime.now(UTC).replace(hour=13)
    for _ in range(2):
        booth.start_game()
        booth.app.runner.dispatch(happened.AbortRequested(at_ms=booth.app.runner.now_ms(), reason="test run"))
    with open_repository(booth.data) as stored:
        firsts = [stored.events(number)[0] for number in (1, 2)]
    setups = [first.setup for first in firsts if isinstance(first, happened.SessionStarted)]
    assert [(setup.hour_band, setup.visitors_before) for setup in setups if setup] == [(3, 0), (3, 1)]


def with_a_purpose_for_the_pointer(folder: Path) -> Settings:
    """Return a study of consent and game that records the way of the pointer, with sheets that ask for it."""
    sheets = folder / "sheets"
    copytree(ASSETS / "consent" / "study", sheets)
    for file in sheets.glob("*.toml"):
        offered = "[[consent.purposes]]\nid = 'pointer'\nrequired = false\ntext = 'The way of the pointer'\n\n[debrief]"
        file.write_text(file.read_text("utf-8").replace("[debrief]", offered), "utf-8")
    (folder / "study.toml").write_text(
        'languages = ["en"]\nstages = ["consent", "game"]\n'
        '[consent]\ntext = "./sheets"\n[privacy]\npointer_trace = true\n',
        "utf-8",
    )
    return Settings.read(folder / "study.toml")


@pytest.mark.parametrize("agrees", [True, False])
def test_the_way_of_the_pointer_is_recorded_in_cards_of_those_who_agree(
    make_booth: MakeBooth, tmp_path: Path, *, agrees: bool
) -> None:
    booth = make_booth(settings=with_a_purpose_for_the_pointer(tmp_path))
    booth.click("start-en")
    # This one lies further down the page.
    booth.app.screens.consent.ticked.emit("pointer", agrees)
    booth.click("agree")
    board = booth.item("board")
    cell = board.property("cellWidth")
    pass_time(booth, 1_000)
    for column in (0.5, 1.5, 2.5):
        place = board.mapToScene(QPointF(column * cell, 0.25 * cell)).toPoint()
        QTest.mouseMove(booth.app.window, place)
        booth.settle()
        pass_time(booth, 100)
    booth.click("card-2")
    with open_repository(booth.data) as stored:
        taps = [event for event in stored.events(1) if isinstance(event, happened.CardSelected)]
    way = [(x, y) for _, x, y in taps[0].trace]
    expected = [(0.5, 0.25), (1.5, 0.25), (2.5, 0.25)] if agrees else []
    assert [place for place in way if place[1] < 0.4] == [pytest.approx(place, abs=0.05) for place in expected]
    assert bool(way) is agrees


def test_a_hint_for_a_visitor_who_hesitates_waits_until_the_pointer_rests(make_booth: MakeBooth) -> None:
    rule = {"hesitation_max": 1, "hesitation_times": 2.0, "hesitation_flips": 1, "hesitation_least_ms": 4_000}
    booth = make_booth(settings=short(assistance=rule))
    noticed: list[happened.HesitationNoticed] = []
    booth.app.runner.on_event = lambda _event, outcome, _stage: noticed.extend(
        each for each in outcome.events if isinstance(each, happened.HesitationNoticed)
    )
    booth.start_game()
    for card in ("card-0", "card-1"):
        pass_time(booth, 1_000)
        booth.click(card)
    booth.wait_until(lambda: len(booth.app.screens.board.closed) == 24)
    for _ in range(10):
        pass_time(booth, 700)
        point(booth)
    assert not noticed
    pass_time(booth, 2_000)
    assert [each.flip for each in noticed] == [3]
