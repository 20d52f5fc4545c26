"""The card asks for the PIN and a reason, tells visitors nothing, goes away by itself, and makes guessing slow."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import pytest
from PySide6.QtCore import Qt

from kiosk.study import events as happened
from kiosk.study.booth.deeds import Deed
from kiosk.study.events import Stage
from kiosk.ui.clock import VirtualClock
from kiosk.ui.panel.asking import AWAY_MS
from kiosk.ui.panel.card import Step
from kiosk.ui.rehearsing.hand import Hand
from tests.ui.panel.conftest import PIN, Desk, MakeDesk, Witness


def guess(desk: Desk, pin: str = "1111") -> None:
    """Try a PIN, as soon as one may."""
    while desk.card.asks_for is not Step.PIN:
        if desk.card.asks_for is Step.NOTHING:
            desk.chord(Deed.PANEL)
        else:
            desk.jump()
    desk.type(pin)
    desk.enter()


def refusals(desk: Desk) -> list[dict[str, int]]:
    """Every wrong PIN that was written down."""
    return [body for kind, body in desk.notes if kind == "PinRefused"]


def test_what_was_typed_is_seen_as_dots_and_can_be_taken_back(desk: Desk) -> None:
    desk.chord(Deed.PANEL)
    desk.type("25x8")
    assert desk.card.property("text") == "●●●"
    desk.press(Qt.Key.Key_Backspace)
    assert desk.card.property("text") == "●●"


def test_a_wrong_pin_is_written_down_without_its_digits_and_each_makes_the_next_wait_twice_as_long(desk: Desk) -> None:
    for _ in range(8):
        guess(desk)
    assert [body["in_a_row"] for body in refusals(desk)] == list(range(1, 9))
    assert [body["wait_ms"] for body in refusals(desk)] == [1000, 2000, 4000, 8000, 16_000, 32_000, 60_000, 60_000]
    assert "1111" not in json.dumps(desk.notes)


def test_the_wait_is_told_in_words_and_counted_down(desk: Desk) -> None:
    for _ in range(3):
        guess(desk)
    told = []
    while desk.card.asks_for is Step.WAIT:
        told.append(desk.card.property("line"))
        desk.jump()
    assert told == [f"That was wrong. Wait {seconds} s." for seconds in (4, 3, 2, 1)]
    assert desk.card.asks_for is Step.PIN


def test_while_nobody_may_try_even_the_right_pin_does_nothing(desk: Desk) -> None:
    guess(desk)
    desk.type(PIN)
    desk.enter()
    assert not desk.panel.is_open
    assert desk.card.asks_for is Step.WAIT
    guess(desk, PIN)
    assert desk.panel.is_open


class Slow:
    """Checks that end when the test says so."""

    def __init__(self, desk: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
        self._jobs: list[Callable[[], None]] = []
        monkeypatch.setattr(desk.app.experimenter._lock, "_work", self._keep)

    def _keep(self, job: Callable[[], Any], then: Callable[[Any], None]) -> None:
        self._jobs.append(lambda: then(job()))

    def answer(self) -> None:
        """Let the check end that is under way; there is never more than one."""
        [job] = self._jobs
        self._jobs.clear()
        job()


@pytest.fixture
def slow(desk: Desk, monkeypatch: pytest.MonkeyPatch) -> Slow:
    """The checks of the desk's lock."""
    return Slow(desk, monkeypatch)


def test_a_burst_of_pins_is_one_attempt_and_the_right_one_in_it_does_not_open(desk: Desk, slow: Slow) -> None:
    desk.chord(Deed.PANEL)
    for pin in ("1111", *[PIN] * 39):
        desk.type(pin)
        desk.enter()
    slow.answer()
    assert desk.card.asks_for is Step.WAIT
    assert not desk.panel.is_open
    assert len(refusals(desk)) == 1
    desk.type(PIN)
    desk.enter()
    assert not desk.panel.is_open
    desk.wait_until(lambda: desk.card.asks_for is Step.PIN)
    desk.type(PIN)
    desk.enter()
    slow.answer()
    assert desk.panel.is_open


def test_what_is_typed_while_a_pin_is_checked_is_no_part_of_the_next_one(desk: Desk, slow: Slow) -> None:
    desk.chord(Deed.PANEL)
    desk.type("1111")
    desk.enter()
    desk.type(PIN)
    assert desk.card.property("text") == ""
    slow.answer()
    desk.wait_until(lambda: desk.card.asks_for is Step.PIN)
    assert desk.card.property("text") == ""


def test_to_ask_anew_while_a_pin_is_checked_is_no_further_attempt(desk: Desk, slow: Slow) -> None:
    desk.chord(Deed.PANEL)
    desk.type("1111")
    desk.enter()
    desk.press(Qt.Key.Key_Escape)
    desk.chord(Deed.LEAVE)
    desk.type(PIN)
    desk.enter()
    slow.answer()
    assert desk.card.asks_for is Step.WAIT
    assert len(refusals(desk)) == 1


def test_a_right_pin_for_a_question_that_was_put_away_opens_nothing(desk: Desk, slow: Slow) -> None:
    desk.chord(Deed.PANEL)
    desk.type(PIN)
    desk.enter()
    desk.press(Qt.Key.Key_Escape)
    desk.chord(Deed.PANEL)
    slow.answer()
    assert not desk.panel.is_open
    assert desk.card.asks_for is Step.PIN
    desk.type(PIN)
    desk.enter()
    slow.answer()
    assert desk.panel.is_open


def test_the_wait_outlasts_a_new_start_and_the_right_pin_ends_the_row(make_desk: MakeDesk) -> None:
    desk = make_desk()
    for _ in range(4):
        guess(desk)
    desk.close()
    again = make_desk(data=desk.data)
    again.chord(Deed.PANEL)
    assert again.card.asks_for is Step.WAIT
    guess(again, PIN)
    assert again.panel.is_open
    again.app.experimenter.panel.close()
    guess(again)
    assert [body["in_a_row"] for body in refusals(again)] == [1, 2, 3, 4, 1]


def test_the_card_goes_away_when_nobody_answers_and_the_sitting_has_gone_on_meanwhile(desk: Desk) -> None:
    assert isinstance(desk.app.clock, VirtualClock)
    desk.go_to(Stage.PRACTICE)
    witness = Witness(desk.app)
    before = desk.app.clock.now_ms()
    desk.chord(Deed.END)
    desk.app.conductor.tell(happened.CardTapped, position=desk.app.screens.board.closed[0])
    desk.wait_until(lambda: desk.card.asks_for is Step.NOTHING)
    assert desk.app.clock.now_ms() - before == AWAY_MS
    assert witness.saw(happened.CardTapped)
    assert not witness.saw(happened.EndAsked)


def test_nobody_is_taken_for_being_there_because_somebody_types_a_pin(desk: Desk) -> None:
    """The idle time of the stage goes on as it was."""
    assert isinstance(desk.app.clock, VirtualClock)
    desk.go_to(Stage.ABOUT)
    begun, idle = desk.app.clock.now_ms(), desk.app.desk.study.settings.idle.about
    desk.chord(Deed.PANEL)
    desk.type("2")
    desk.wait_until(lambda: bool(desk.app.screens.kiosk.property("asksStillThere")))
    assert desk.app.clock.now_ms() - begun == idle


def test_the_card_tells_nothing_of_what_it_is_for(desk: Desk) -> None:
    shown = set()
    for deed in (Deed.PANEL, Deed.CONDITION, Deed.END, Deed.LEAVE):
        desk.go_to(Stage.ABOUT)
        desk.chord(deed)
        shown.add((desk.card.property("title"), desk.card.property("line"), desk.card.property("text")))
    assert len(shown) == 1


def test_a_reason_in_ones_own_words_is_kept_in_them(desk: Desk) -> None:
    desk.go_to(Stage.ABOUT)
    witness = Witness(desk.app)
    desk.do(Deed.END, reason="5")
    assert desk.card.asks_for is Step.WORDS
    desk.enter()
    assert desk.card.asks_for is Step.WORDS
    desk.type("Fire drill 2")
    desk.enter()
    (ended,) = (event for event in witness.events if isinstance(event, happened.EndAsked))
    assert ended.reason == "other: Fire drill 2"


def test_a_reason_is_kept_exactly_as_it_was_typed_and_loses_whole_characters_to_backspace(desk: Desk) -> None:
    desk.go_to(Stage.ABOUT)
    witness = Witness(desk.app)
    desk.do(Deed.END, reason="5")
    hand, typed = Hand(desk.app.window), "se\N{NO-BREAK SPACE}\N{WOMAN}\N{ZERO WIDTH JOINER}\N{GIRL} "
    hand.type("x\a")
    desk.press(Qt.Key.Key_Backspace)
    hand.type(typed[:-1] + "e\N{COMBINING ACUTE ACCENT}")
    desk.press(Qt.Key.Key_Backspace)
    hand.type(typed[-1])
    assert desk.card.property("text") == typed
    desk.enter()
    (ended,) = (event for event in witness.events if isinstance(event, happened.EndAsked))
    assert ended.reason == f"other: {typed}"


def test_what_was_typed_of_a_visitor_who_is_not_stored_is_nowhere(desk: Desk) -> None:
    desk.go_to(Stage.CONSENT)
    desk.app.conductor.tell(happened.DeclineTapped)
    desk.do(Deed.END, reason="5")
    desk.type("Marvin is tired")
    desk.enter()
    assert desk.notes[-1] == ("SittingStopped", {"stage": "introduction", "reason": "other"})
    assert [file for file in desk.data.iterdir() if b"Marvin" in file.read_bytes()] == []


def test_a_reason_can_be_chosen_with_the_pointer(desk: Desk) -> None:
    desk.go_to(Stage.ABOUT)
    desk.chord(Deed.END)
    desk.unlock()
    desk.click("reason-3")
    assert desk.stage is Stage.ATTRACT
    assert desk.notes[-1] == ("SittingStopped", {"stage": "about", "reason": "disturbed"})


def test_the_right_pin_opens_for_one_deed_alone(desk: Desk) -> None:
    desk.do(Deed.CONDITION)
    desk.wait_for_note_to_go()
    desk.chord(Deed.BODY)
    assert desk.card.asks_for is Step.PIN


def test_without_a_pin_nothing_is_asked_but_the_reason(make_desk: MakeDesk) -> None:
    desk = make_desk(experimenter={"pin": ""})
    desk.go_to(Stage.ABOUT)
    desk.chord(Deed.END)
    assert desk.card.asks_for is Step.REASON
    desk.type("1")
    desk.chord(Deed.PANEL)
    assert desk.panel.is_open
    lines = desk.panel.property("health")["lines"]
    assert [line["words"] for line in lines if line["name"] == "PIN"] == [
        "none is set: every sitting is a trial, and anybody who knows the keys can do everything"
    ]


def test_a_deed_that_the_sitting_has_outrun_is_refused(desk: Desk) -> None:
    desk.go_to(Stage.THANKS)
    desk.chord(Deed.END)
    desk.unlock()
    desk.app.conductor.tell(happened.ContinueTapped)
    desk.type("1")
    assert desk.noted == "Not now"
    assert "SittingStopped" not in [kind for kind, _ in desk.notes]
