"""The card asks for the PIN and a reason, tells visitors nothing, goes away by itself, and makes guessing slow."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import pytest
from PySide6.QtCore import QObject, QPoint, Qt
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from kiosk.experiment import events as happened
from kiosk.experiment.experimenter import Action
from kiosk.experiment.outcomes import Stage
from kiosk.ui.event_loop import VirtualClock
from kiosk.ui.experimenter.authorisation import AWAY_MS
from kiosk.ui.experimenter.view_model import AuthorisationStep
from kiosk.ui.simulated_visitor import UiDriver, touch_screen
from tests.ui.experimenter.conftest import PIN, Desk, MakeDesk, Witness


def guess(assigner: Desk, pin: str = "1111") -> None:
    """Try a PIN, as soon as one may."""
    while assigner.card.asks_for is not AuthorisationStep.PIN:
        if assigner.card.asks_for is AuthorisationStep.NOTHING:
            assigner.shortcut(Action.PANEL)
        else:
            assigner.jump()
    assigner.type(pin)
    assigner.enter()


def refusals(assigner: Desk) -> list[dict[str, int]]:
    """Every wrong PIN that was written down."""
    return [body for kind, body in assigner.notes if kind == "PinRefused"]


def test_what_was_typed_is_seen_as_dots_and_can_be_taken_back(assigner: Desk) -> None:
    assigner.shortcut(Action.PANEL)
    assigner.type("25x8")
    assert assigner.card.property("text") == "●●●"
    assigner.press(Qt.Key.Key_Backspace)
    assert assigner.card.property("text") == "●●"


def test_a_wrong_pin_is_written_down_without_its_digits_and_each_makes_the_next_wait_twice_as_long(
    assigner: Desk,
) -> None:
    for _ in range(8):
        guess(assigner)
    assert [body["in_a_row"] for body in refusals(assigner)] == list(range(1, 9))
    assert [body["wait_ms"] for body in refusals(assigner)] == [1000, 2000, 4000, 8000, 16_000, 32_000, 60_000, 60_000]
    assert "1111" not in json.dumps(assigner.notes)


def test_the_wait_is_told_in_words_and_counted_down(assigner: Desk) -> None:
    for _ in range(3):
        guess(assigner)
    told = []
    while assigner.card.asks_for is AuthorisationStep.WAIT:
        told.append(assigner.card.property("line"))
        assigner.jump()
    assert told == [f"That was wrong. Wait {seconds} s." for seconds in (4, 3, 2, 1)]
    assert assigner.card.asks_for is AuthorisationStep.PIN


def test_while_nobody_may_try_even_the_right_pin_does_nothing(assigner: Desk) -> None:
    guess(assigner)
    assigner.type(PIN)
    assigner.enter()
    assert not assigner.panel.is_open
    assert assigner.card.asks_for is AuthorisationStep.WAIT
    guess(assigner, PIN)
    assert assigner.panel.is_open


class Slow:
    """Checks that end when the test says so."""

    def __init__(self, assigner: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
        self._jobs: list[Callable[[], None]] = []
        monkeypatch.setattr(assigner.app.experimenter._lock, "_work", self._keep)

    def _keep(self, job: Callable[[], Any], then: Callable[[Any], None]) -> None:
        self._jobs.append(lambda: then(job()))

    def answer(self) -> None:
        """Let the check end that is under way; there is never more than one."""
        [job] = self._jobs
        self._jobs.clear()
        job()


@pytest.fixture
def slow(assigner: Desk, monkeypatch: pytest.MonkeyPatch) -> Slow:
    """Return the checks of the assigner's lock."""
    return Slow(assigner, monkeypatch)


def test_a_burst_of_pins_is_one_attempt_and_the_right_one_in_it_does_not_open(assigner: Desk, slow: Slow) -> None:
    assigner.shortcut(Action.PANEL)
    for pin in ("1111", *[PIN] * 39):
        assigner.type(pin)
        assigner.enter()
    slow.answer()
    assert assigner.card.asks_for is AuthorisationStep.WAIT
    assert not assigner.panel.is_open
    assert len(refusals(assigner)) == 1
    assigner.type(PIN)
    assigner.enter()
    assert not assigner.panel.is_open
    assigner.wait_until(lambda: assigner.card.asks_for is AuthorisationStep.PIN)
    assigner.type(PIN)
    assigner.enter()
    slow.answer()
    assert assigner.panel.is_open


def test_what_is_typed_while_a_pin_is_checked_is_no_part_of_the_next_one(assigner: Desk, slow: Slow) -> None:
    assigner.shortcut(Action.PANEL)
    assigner.type("1111")
    assigner.enter()
    assigner.type(PIN)
    assert assigner.card.property("text") == ""
    slow.answer()
    assigner.wait_until(lambda: assigner.card.asks_for is AuthorisationStep.PIN)
    assert assigner.card.property("text") == ""


def test_to_ask_anew_while_a_pin_is_checked_is_no_further_attempt(assigner: Desk, slow: Slow) -> None:
    assigner.shortcut(Action.PANEL)
    assigner.type("1111")
    assigner.enter()
    assigner.press(Qt.Key.Key_Escape)
    assigner.shortcut(Action.QUIT)
    assigner.type(PIN)
    assigner.enter()
    slow.answer()
    assert assigner.card.asks_for is AuthorisationStep.WAIT
    assert len(refusals(assigner)) == 1


def test_a_right_pin_for_a_question_that_was_put_away_opens_nothing(assigner: Desk, slow: Slow) -> None:
    assigner.shortcut(Action.PANEL)
    assigner.type(PIN)
    assigner.enter()
    assigner.press(Qt.Key.Key_Escape)
    assigner.shortcut(Action.PANEL)
    slow.answer()
    assert not assigner.panel.is_open
    assert assigner.card.asks_for is AuthorisationStep.PIN
    assigner.type(PIN)
    assigner.enter()
    slow.answer()
    assert assigner.panel.is_open


def test_the_wait_outlasts_a_new_start_and_the_right_pin_ends_the_row(make_assigner: MakeDesk) -> None:
    assigner = make_assigner()
    for _ in range(4):
        guess(assigner)
    assigner.close()
    again = make_assigner(data=assigner.data)
    again.shortcut(Action.PANEL)
    assert again.card.asks_for is AuthorisationStep.WAIT
    guess(again, PIN)
    assert again.panel.is_open
    again.app.experimenter.panel.close()
    guess(again)
    assert [body["in_a_row"] for body in refusals(again)] == [1, 2, 3, 4, 1]


def test_an_attempt_that_is_cut_off_with_the_kiosk_counts(
    make_assigner: MakeDesk, monkeypatch: pytest.MonkeyPatch
) -> None:
    assigner = make_assigner()
    Slow(assigner, monkeypatch)
    assigner.shortcut(Action.PANEL)
    assigner.type(PIN)
    assigner.enter()
    assert not refusals(assigner)
    assigner.close()
    again = make_assigner(data=assigner.data)
    again.shortcut(Action.PANEL)
    assert again.card.asks_for is AuthorisationStep.WAIT
    guess(again)
    assert [body["in_a_row"] for body in refusals(again)] == [2]


def test_the_card_goes_away_when_nobody_answers_and_the_session_has_gone_on_meanwhile(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(stages=["practice", "game"])
    assert isinstance(assigner.app.clock, VirtualClock)
    assigner.go_to(Stage.PRACTICE)
    witness = Witness(assigner.app)
    before = assigner.app.clock.now_ms()
    assigner.shortcut(Action.ABORT)
    assigner.app.runner.dispatch(
        happened.CardSelected(at_ms=assigner.app.runner.now_ms(), position=assigner.app.screens.board.closed[0])
    )
    assigner.wait_until(lambda: assigner.card.asks_for is AuthorisationStep.NOTHING)
    assert assigner.app.clock.now_ms() - before == AWAY_MS
    assert witness.saw(happened.CardSelected)
    assert not witness.saw(happened.AbortRequested)


def test_nobody_is_taken_for_being_there_because_somebody_types_a_pin(assigner: Desk) -> None:
    """The idle time of the stage goes on as it was."""
    assert isinstance(assigner.app.clock, VirtualClock)
    assigner.go_to(Stage.ABOUT)
    begun, idle = assigner.app.clock.now_ms(), assigner.app.assigner.study.settings.idle_ms.about
    assigner.shortcut(Action.PANEL)
    assigner.type("2")
    assigner.wait_until(lambda: bool(assigner.app.screens.kiosk.property("asksStillThere")))
    assert assigner.app.clock.now_ms() - begun == idle
    content = assigner.app.window.contentItem().childItems()
    layers = {each.metaObject().className().partition("_")[0]: each.z() for each in content}
    assert layers["PanelLayer"] > layers["SidePanel"], "the assistant, who asks, covers the experimenter's card"


def test_the_card_tells_nothing_of_what_it_is_for(assigner: Desk) -> None:
    shown = set()
    for action in (Action.PANEL, Action.CONDITION, Action.ABORT, Action.QUIT):
        assigner.go_to(Stage.ABOUT)
        assigner.shortcut(action)
        shown.add((assigner.card.property("title"), assigner.card.property("line"), assigner.card.property("text")))
    assert len(shown) == 1


def test_a_reason_in_ones_own_words_is_kept_in_them(assigner: Desk) -> None:
    assigner.go_to(Stage.ABOUT)
    witness = Witness(assigner.app)
    assigner.do(Action.ABORT, reason="5")
    assert assigner.card.asks_for is AuthorisationStep.WORDS
    assigner.enter()
    assert assigner.card.asks_for is AuthorisationStep.WORDS
    assigner.type("Fire drill 2")
    assigner.enter()
    (ended,) = (event for event in witness.events if isinstance(event, happened.AbortRequested))
    assert ended.reason == "other: Fire drill 2"


def test_a_reason_is_kept_exactly_as_it_was_typed_and_loses_whole_characters_to_backspace(assigner: Desk) -> None:
    assigner.go_to(Stage.ABOUT)
    witness = Witness(assigner.app)
    assigner.do(Action.ABORT, reason="5")
    hand, typed = UiDriver(assigner.app.window), "se\N{NO-BREAK SPACE}\N{WOMAN}\N{ZERO WIDTH JOINER}\N{GIRL} "
    hand.type("x\a")
    assigner.press(Qt.Key.Key_Backspace)
    hand.type(typed[:-1] + "e\N{COMBINING ACUTE ACCENT}")
    assigner.press(Qt.Key.Key_Backspace)
    hand.type(typed[-1])
    assert assigner.card.property("text") == typed
    assigner.enter()
    (ended,) = (event for event in witness.events if isinstance(event, happened.AbortRequested))
    assert ended.reason == f"other: {typed}"


def test_what_was_typed_of_a_visitor_who_is_not_stored_is_nowhere(assigner: Desk) -> None:
    assigner.go_to(Stage.CONSENT)
    assigner.app.runner.dispatch(happened.ConsentDeclined(at_ms=assigner.app.runner.now_ms()))
    assigner.do(Action.ABORT, reason="5")
    assigner.type("Marvin is tired")
    assigner.enter()
    assert assigner.notes[-1] == ("SessionAborted", {"stage": "introduction", "reason": "other"})
    assert [file for file in assigner.data.iterdir() if b"Marvin" in file.read_bytes()] == []


def test_a_reason_can_be_chosen_with_the_pointer(assigner: Desk) -> None:
    assigner.go_to(Stage.ABOUT)
    assigner.shortcut(Action.ABORT)
    assigner.unlock()
    assigner.click("reason-3")
    assert assigner.stage is Stage.ATTRACT
    assert assigner.notes[-1] == ("SessionAborted", {"stage": "about", "reason": "disturbed"})


def test_the_right_pin_opens_for_one_action_alone(assigner: Desk) -> None:
    assigner.do(Action.CONDITION)
    assigner.wait_for_note_to_go()
    assigner.shortcut(Action.EMBODIMENT)
    assert assigner.card.asks_for is AuthorisationStep.PIN


def test_without_a_pin_nothing_is_asked_but_the_reason(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(experimenter={"pin_hash": ""})
    assigner.go_to(Stage.ABOUT)
    assigner.shortcut(Action.ABORT)
    assert assigner.card.asks_for is AuthorisationStep.REASON
    assigner.type("1")
    assigner.shortcut(Action.PANEL)
    assert assigner.panel.is_open
    lines = assigner.panel.property("health")["matters"]
    assert [line["message"] for line in lines if line["name"] == "PIN"] == ["not set"]


def test_a_action_that_the_session_has_outrun_is_refused(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(stages=["game", "thanks"])
    assigner.go_to(Stage.THANKS)
    assigner.shortcut(Action.ABORT)
    assigner.unlock()
    assigner.app.runner.dispatch(happened.ContinuePressed(at_ms=assigner.app.runner.now_ms()))
    assigner.type("1")
    assert assigner.noted == "Not now"
    assert "SessionAborted" not in [kind for kind, _ in assigner.notes]


CORNER = QPoint(30, 30)
HOLD_S = 0.05


@pytest.fixture
def touched(assigner: Desk) -> Desk:
    """Return a booth whose corner needs to be held for a moment only."""
    assigner.settle()
    handler = assigner.app.window.findChild(QObject, "hold")
    assert handler is not None
    assert handler.property("longPressThreshold") == 3
    handler.setProperty("longPressThreshold", HOLD_S)
    return assigner


def hold(booth: Desk, qtbot: QtBot, *, until: Callable[[], bool]) -> None:
    """Hold a finger in the corner until something is so."""
    window = booth.app.window
    QTest.touchEvent(window, touch_screen()).press(0, CORNER, window).commit()
    qtbot.waitUntil(until)
    QTest.touchEvent(window, touch_screen()).release(0, CORNER, window).commit()


def test_a_held_corner_and_a_pin_on_the_screen_open_the_panel(touched: Desk, qtbot: QtBot) -> None:
    hold(touched, qtbot, until=lambda: touched.card.asks_for is AuthorisationStep.PIN)
    for key in ("1", "delete", *PIN, "enter"):
        touched.click(f"pin-{key}")
    assert touched.panel.is_open
    assert not touched.sees("pin-card")


@pytest.mark.parametrize("on", [True, False])
def test_the_study_file_says_whether_the_corner_takes_a_finger(make_assigner: MakeDesk, *, on: bool) -> None:
    assert make_assigner(experimenter={"hold_corner": on}).item("hold-corner").isEnabled() is on


def test_a_wrong_pin_on_the_screen_waits_as_any_other(touched: Desk, qtbot: QtBot) -> None:
    hold(touched, qtbot, until=lambda: touched.card.asks_for is AuthorisationStep.PIN)
    for key in ("1", "1", "1", "1", "enter"):
        touched.click(f"pin-{key}")
    assert touched.card.asks_for is AuthorisationStep.WAIT
    assert not touched.item("pin-1").isEnabled()
    assert refusals(touched)[-1]["wait_ms"] == 1000


def test_a_touch_of_the_corner_or_one_that_moves_asks_for_nothing(touched: Desk, qtbot: QtBot) -> None:
    window = touched.app.window
    QTest.touchEvent(window, touch_screen()).press(0, CORNER, window).commit()
    QTest.touchEvent(window, touch_screen()).release(0, CORNER, window).commit()
    QTest.touchEvent(window, touch_screen()).press(0, CORNER, window).commit()
    QTest.touchEvent(window, touch_screen()).move(0, QPoint(400, 300), window).commit()
    qtbot.wait(round(3000 * HOLD_S))
    QTest.touchEvent(window, touch_screen()).release(0, QPoint(400, 300), window).commit()
    assert touched.card.asks_for is AuthorisationStep.NOTHING


def test_a_card_that_came_by_touch_is_put_away_by_touch(touched: Desk, qtbot: QtBot) -> None:
    hold(touched, qtbot, until=lambda: touched.card.asks_for is AuthorisationStep.PIN)
    keys = [touched.item(f"pin-{key}").property("words") for key in ("delete", "enter", "cancel")]
    assert keys == ["Delete", "Enter", "Cancel"], "the keys have their names before the panel was ever open"
    touched.click("pin-cancel")
    assert touched.card.asks_for is AuthorisationStep.NOTHING


def test_by_touch_another_reason_has_no_words(touched: Desk, qtbot: QtBot) -> None:
    touched.go_to(Stage.ABOUT)
    touched.settle()
    hold(touched, qtbot, until=lambda: touched.card.asks_for is AuthorisationStep.PIN)
    for key in (*PIN, "enter"):
        touched.click(f"pin-{key}")
    touched.click("action-end")
    touched.click("reason-5")
    assert ("SessionAborted", {"stage": "about", "reason": "other"}) in touched.notes


def test_by_keyboard_the_card_has_no_keys(touched: Desk) -> None:
    touched.shortcut(Action.PANEL)
    assert touched.sees("pin-card")
    assert not touched.sees("pin-1")
