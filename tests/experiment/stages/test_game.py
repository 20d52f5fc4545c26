"""A game with its help, as a visitor lives through it on the board."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import pytest
from pydantic import ValidationError

from kiosk.assistance.policy import ActionSpec, FlipInMove, Gate
from kiosk.config import Timing
from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.condition import Condition
from kiosk.experiment.effects import BoardWait, Mood, Outcome
from kiosk.experiment.events import Timer
from kiosk.experiment.outcomes import Stage
from kiosk.experiment.projections import WaitingShares, waiting_shares
from kiosk.experiment.session_state import SessionState
from kiosk.game import FlipRejection, Position
from tests.experiment.driver import SPEECH_LAG, SPEECH_TIME, Driver, Voice, at_random, with_memory
from tests.experiment.table import a_pair, another, miss, playing, seen
from tests.experiment.view import View
from tests.samples import always, mixed, plan

ONLY_SECOND = always(ActionSpec.SUG_CARD, Gate(opening=0, patience=99, first_patience=99))
"""Names the mate before every second card, and says nothing before a first one."""


# Flips


def test_a_tap_turns_a_card_up() -> None:
    driver = playing()
    outcome = driver.flip(Position(1, 2))
    flipped = driver.noted(happened.CardFlipped)[0]
    assert (flipped.number, flipped.move, flipped.position, flipped.matched) == (1, 1, Position(1, 2), None)
    assert do.RevealCard(Position(1, 2), flipped.card) in outcome.effects
    assert driver.view.held is None


def test_a_pair_is_shown_and_the_board_stays_open() -> None:
    driver = playing()
    first, mate = a_pair(driver)
    driver.flip(first)
    outcome = driver.flip(mate)
    assert driver.noted(happened.CardFlipped)[1].matched is True
    assert do.MarkMatched((mate, first)) in outcome.effects
    assert do.ShowProgress(1, 1) in outcome.effects
    assert seen(driver, "found", "held") == ({first, mate}, None)
    assert driver.running.keys() == {Timer.IDLE}


def test_two_different_cards_are_shown_for_a_while_and_turn_back() -> None:
    driver = playing(mismatch_shown_ms=1500)
    first, second = miss(driver)
    assert driver.view.held is BoardWait.TURNING_BACK
    shown_at = driver.now
    outcome = driver.wait()
    assert (driver.now, driver.world[-1]) == (
        shown_at + 1500,
        happened.TimerExpired(at_ms=shown_at + 1500, timer=Timer.TURN_BACK),
    )
    assert outcome.effects.index(do.HideCards((first, second))) < outcome.effects.index(do.UnlockBoard())
    assert seen(driver, "held", "up") == (None, {})
    assert do.ShowProgress(0, 1) in driver.effects


@pytest.mark.parametrize("which", ["open", "closed"])
def test_taps_while_two_cards_turn_back_are_ignored(which: str) -> None:
    driver = playing()
    first, second = miss(driver)
    place = first if which == "open" else another(driver, first, second)
    before = driver.session.measures
    assert driver.tap(place) == Outcome(
        (happened.CardSelectionRejected(at_ms=driver.now, position=place, why=FlipRejection.TURNING_BACK),),
        (do.StartTimer(Timer.IDLE, 120_000),),
    )
    assert driver.session.measures == before
    driver.wait_until_open()
    assert driver.view.up == {}


def test_taps_that_the_rules_forbid_are_ignored_and_say_why() -> None:
    driver = playing()
    first, mate = a_pair(driver)
    driver.flip(first)
    driver.tap(first)
    driver.tap(Position(-1, 10**12))
    driver.flip(mate)
    driver.tap(mate)
    why = [event.why for event in driver.noted(happened.CardSelectionRejected)]
    assert why == [FlipRejection.OPEN, FlipRejection.OUTSIDE, FlipRejection.FOUND]
    assert driver.session.measures.flips == 2


def test_the_last_pair_is_looked_at_before_the_result() -> None:
    driver = playing(finish_ms=2500)
    while len(driver.view.found) < 24:
        for place in a_pair(driver):
            driver.flip(place)
    at = driver.now
    assert driver.stage is Stage.GAME
    assert not driver.view.closed
    driver.tap(Position(0, 0))
    assert driver.noted(happened.CardSelectionRejected)[-1].why is FlipRejection.FOUND
    driver.wait()
    assert (driver.now, driver.stage) == (at + 2500, Stage.RESULT)
    assert driver.noted(happened.GameFinished)[0].at_ms == driver.now


# Hints


def test_a_decision_is_taken_before_every_flip() -> None:
    driver = playing(ActionSpec.SUG_ROW)
    driver.play(with_memory(1))
    decided = [event.flip for event in driver.noted(happened.AssistanceDecided)]
    flipped = [event.number for event in driver.noted(happened.CardFlipped)]
    assert decided == flipped == list(range(1, len(flipped) + 1))
    order = [
        (type(event).__name__, number)
        for event in driver.events
        if (number := getattr(event, "flip", None) or getattr(event, "number", None))
        and isinstance(event, happened.AssistanceDecided | happened.CardFlipped)
    ]
    assert order == [(kind, number) for number in flipped for kind in ("AssistanceDecided", "CardFlipped")]


@pytest.mark.parametrize("seed", range(6))
def test_what_is_recorded_of_a_decision_is_what_it_was(seed: int) -> None:
    policy = mixed(seed, Gate(opening=2, patience=2, first_patience=4))
    driver = Driver(plan(policy=policy), seed)
    driver.to_the_game()
    driver.play(at_random(seed))
    decisions = driver.noted(happened.AssistanceDecided)
    hints = {hint.flip: hint for hint in driver.noted(happened.HintGiven)}
    for before, decision in pairwise(decisions):
        assert decision.last is before.action
        assert decision.card is (FlipInMove.SECOND if decision.flip % 2 == 0 else FlipInMove.FIRST)
        assert decision.action is ActionSpec.NO_HELP or decision.gate.is_open
        assert (decision.flip in hints) is (decision.action is not ActionSpec.NO_HELP)
    assert {decision.gate.name for decision in decisions} >= {"OPEN", "OPENING", "DOING_WELL"}
    assert {decision.game.name for decision in decisions} == {"BEGINNING", "MIDDLE", "END"}
    for hint in hints.values():
        decision = decisions[hint.flip - 1]
        assert (hint.action, hint.card) == (decision.action, decision.card)


@pytest.mark.parametrize("seed", range(6))
def test_what_is_recorded_of_a_hint_is_true_of_what_this_visitor_has_seen(seed: int) -> None:
    driver = Driver(plan(policy=mixed(seed)), seed)
    driver.to_the_game()
    driver.play(at_random(seed))
    dealt = driver.noted(happened.BoardDealt)[0]
    name_at = {Position(*divmod(number, dealt.columns)): name for number, name in enumerate(dealt.cards)}
    flipped: list[Position] = []
    utterances = [1]
    for event in driver.events:
        if isinstance(event, happened.CardFlipped):
            flipped.append(event.position)
            assert event.card == name_at[event.position]
        if isinstance(event, happened.HintGiven):
            mate = next(p for p in name_at if name_at[p] == event.name and p != event.target)
            assert name_at[event.target] == event.name
            assert (event.seen, event.mate_seen) == (flipped.count(event.target), flipped.count(mate))
            assert event.row == (None if event.action is ActionSpec.SUG_COL else event.target.row)
            assert event.column == (None if event.action is ActionSpec.SUG_ROW else event.target.column)
            assert event.flip == len(flipped) + 1
            utterances.append(event.utterance)
    assert utterances == list(range(1, len(utterances) + 1))


def test_without_assistance_nothing_is_decided_and_nothing_said() -> None:
    driver = Driver(plan(Condition.NO_ASSISTANCE, always(ActionSpec.SUG_CARD)), 1)
    driver.to_the_game()
    driver.play(with_memory(1))
    assert not driver.noted(happened.AssistanceDecided)
    assert not driver.noted(happened.HintGiven)
    spoken = [command for command in driver.effects if isinstance(command, do.Speak)]
    assert len(spoken) == 2


def test_a_hint_holds_the_board_and_is_shown_as_it_is_recorded() -> None:
    driver = playing(ActionSpec.SUG_CARD)
    hint = driver.noted(happened.HintGiven)[0]
    assert driver.view.held is BoardWait.SPEAKING
    assert (driver.view.bubble, driver.view.speaking) == (hint.sentence, hint.utterance)
    assert driver.view.mark is None


def test_taps_while_the_assistant_speaks_are_ignored() -> None:
    driver = playing(ActionSpec.SUG_CARD)
    before = driver.session.measures
    for place in (Position(0, 0), Position(-5, 0)):
        assert driver.tap(place) == Outcome(
            (happened.CardSelectionRejected(at_ms=driver.now, position=place, why=None),),
            (do.StartTimer(Timer.IDLE, 120_000),),
        )
    assert driver.session.measures == before
    assert driver.view.held is BoardWait.SPEAKING
    driver.wait_until_open()
    assert driver.view.up == {}


@pytest.mark.parametrize(
    ("action", "row", "column"),
    [(ActionSpec.SUG_ROW, True, False), (ActionSpec.SUG_COL, False, True), (ActionSpec.SUG_CARD, True, True)],
)
def test_the_mark_shows_no_more_than_the_hint_gives_away(action: ActionSpec, *, row: bool, column: bool) -> None:
    driver = playing(action)
    target = driver.noted(happened.HintGiven)[0].target
    driver.wait_until_open()
    assert driver.view.mark == (target.row if row else None, target.column if column else None)


@pytest.mark.parametrize("delay", [1, 1000, 1900])
def test_the_mark_follows_the_voice_after_its_delay(delay: int) -> None:
    driver = playing(ActionSpec.SUG_CARD, highlight_delay_ms=delay)
    given_at = driver.now
    while driver.view.mark is None:
        driver.wait()
    assert driver.now == given_at + SPEECH_LAG + delay
    assert driver.view.held is BoardWait.SPEAKING


def test_the_mark_comes_with_the_end_of_a_short_sentence() -> None:
    driver = playing(ActionSpec.SUG_CARD, highlight_delay_ms=9000)
    given_at = driver.now
    driver.wait_until_open()
    assert driver.now == given_at + SPEECH_TIME
    assert driver.view.mark is not None
    assert Timer.MARK not in driver.running


@pytest.mark.parametrize("voice", Voice)
@pytest.mark.parametrize("delay", [0, 700, 3500, 60_000])
def test_no_flip_can_be_made_in_ignorance_of_the_mark(voice: Voice, delay: int) -> None:
    driver = Driver(plan(timing=Timing(highlight_delay_ms=delay, highlight_delay_silent_ms=delay)), 4, voice)
    driver.to_the_game()
    driver.play(with_memory(4))
    marked = {event.flip for event in driver.noted(happened.HintHighlighted)}
    assert marked == {event.flip for event in driver.noted(happened.HintGiven)}
    assert len(driver.noted(happened.HintHighlighted)) == len(marked) == len(driver.noted(happened.BoardUnlocked))
    view = View()
    for command in driver.effects:
        view.show([command])
        if isinstance(command, do.UnlockBoard) and view.bubble:
            assert view.mark is not None
    names = [type(event).__name__ for event in driver.events]
    course = [name for name in names if name in ("HintGiven", "HintHighlighted", "BoardUnlocked")]
    assert course == ["HintGiven", "HintHighlighted", "BoardUnlocked"] * len(marked)


def test_the_next_flip_clears_the_mark_and_the_bubble() -> None:
    driver = Driver(plan(policy=ONLY_SECOND), 1)
    driver.to_the_game()
    first, mate = a_pair(driver)
    driver.flip(first)
    driver.wait_until_open()
    assert driver.view.mark == (mate.row, mate.column)
    outcome = driver.flip(mate)
    up = next(command for command in outcome.effects if isinstance(command, do.RevealCard))
    assert outcome.effects.index(do.ClearHighlight()) < outcome.effects.index(up)
    assert outcome.effects.index(do.ClearBubble()) < outcome.effects.index(up)
    assert seen(driver, "mark", "bubble") == (None, None)


def test_a_flip_without_a_hint_clears_nothing() -> None:
    outcome = playing().flip(Position(0, 0))
    assert do.ClearHighlight() not in outcome.effects
    assert do.ClearBubble() not in outcome.effects


# The body


def test_a_sentence_that_was_said_opens_the_board_at_once() -> None:
    driver = playing(ActionSpec.SUG_ROW)
    given_at = driver.now
    driver.wait_until_open()
    assert driver.now == given_at + SPEECH_TIME
    assert driver.running.keys() == {Timer.IDLE}


def test_a_sentence_that_fails_gives_the_time_to_read_it() -> None:
    driver = playing(ActionSpec.SUG_ROW, Voice.FAILS, reading_ms_per_char=50, highlight_delay_silent_ms=600)
    given_at, sentence = driver.now, str(driver.view.bubble)
    driver.wait()
    assert driver.running.keys() == {Timer.IDLE, Timer.READING, Timer.MARK}
    driver.wait()
    assert (driver.now, driver.view.mark is not None) == (given_at + 600, True)
    driver.wait_until_open()
    assert driver.now == given_at + max(1500, 50 * len(sentence))
    assert driver.view.bubble == sentence


def test_a_sentence_that_breaks_off_gives_what_is_left_of_the_time_to_read_it() -> None:
    driver = playing(ActionSpec.SUG_ROW, Voice.BREAKS_OFF, reading_ms_per_char=50)
    given_at, sentence = driver.now, str(driver.view.bubble)
    driver.wait_until_open()
    assert driver.now == given_at + max(SPEECH_TIME, 1500, 50 * len(sentence))


def test_a_body_that_never_answers_holds_the_game_no_longer_than_the_deadline() -> None:
    driver = playing(ActionSpec.SUG_ROW, Voice.IS_SILENT, speech_deadline_ms_per_char=100, speech_deadline_min_ms=1000)
    given_at, sentence = driver.now, str(driver.view.bubble)
    driver.wait_until_open()
    assert driver.now == given_at + max(1000, 100 * len(sentence))
    assert driver.steps[-1].outcome.events == (
        happened.HintHighlighted(at_ms=driver.now, flip=1),
        happened.BoardUnlocked(at_ms=driver.now),
    )
    assert do.StopSpeaking() in driver.steps[-1].outcome.effects
    assert driver.view.bubble == sentence


@pytest.mark.parametrize("voice", Voice)
def test_a_least_hold_keeps_the_board_held_equally_long_whatever_is_said(voice: Voice) -> None:
    driver = playing(ActionSpec.SUG_ROW, voice, hold_min_ms=30_000)
    given_at = driver.now
    driver.wait_until_open()
    assert driver.now == given_at + 30_000
    assert driver.view.mark is not None
    assert driver.running.keys() == {Timer.IDLE}


def test_a_least_hold_that_is_shorter_than_the_sentence_does_not_cut_it_short() -> None:
    driver = playing(ActionSpec.SUG_ROW, hold_min_ms=SPEECH_TIME - 500)
    given_at = driver.now
    driver.wait_until_open()
    assert driver.now == given_at + SPEECH_TIME


def test_a_sentence_that_ends_too_late_changes_nothing() -> None:
    driver = playing(ActionSpec.SUG_ROW, Voice.IS_SILENT)
    driver.wait_until_open()
    late = driver.view
    for event in (
        happened.SpeechStarted(at_ms=driver.now, utterance=2),
        happened.SpeechFinished(at_ms=driver.now, utterance=2),
        happened.SpeechFailed(at_ms=driver.now, utterance=2, why="late"),
    ):
        assert driver.send(event) == Outcome((), ())
    assert driver.view == late


@pytest.mark.parametrize("utterance", [-1, 0, 1, 3, 10**20])
def test_another_sentence_s_end_does_not_open_the_board(utterance: int) -> None:
    driver = playing(ActionSpec.SUG_ROW, Voice.IS_SILENT)
    assert driver.noted(happened.HintGiven)[0].utterance == 2
    for event in (
        happened.SpeechStarted(at_ms=driver.now, utterance=utterance),
        happened.SpeechFinished(at_ms=driver.now, utterance=utterance),
        happened.SpeechFailed(at_ms=driver.now, utterance=utterance, why="no sound"),
    ):
        assert driver.send(event) == Outcome((), ())
    assert driver.view.held is BoardWait.SPEAKING


# Faces


def test_a_helped_second_flip_that_matches_makes_the_assistant_happy_for_a_while() -> None:
    driver = Driver(plan(policy=ONLY_SECOND, timing=Timing(mood_ms=300)), 1)
    driver.to_the_game()
    first, mate = a_pair(driver)
    driver.flip(first)
    assert seen(driver, "mood") == (Mood.IDLE,)
    driver.flip(mate)
    assert seen(driver, "mood") == (Mood.HAPPY,)
    driver.spend(299)
    assert seen(driver, "mood") == (Mood.HAPPY,)
    driver.spend(1)
    assert seen(driver, "mood") == (Mood.IDLE,)


def test_a_hint_that_was_not_followed_makes_it_confused() -> None:
    driver = Driver(plan(policy=ONLY_SECOND), 1)
    driver.to_the_game()
    miss(driver)
    assert driver.view.mood is Mood.CONFUSED


def test_a_hint_that_was_followed_in_vain_makes_it_sad() -> None:
    policy = always(ActionSpec.SUG_ROW, Gate(opening=0, patience=99, first_patience=99))
    driver = Driver(plan(policy=policy), 1)
    driver.to_the_game()
    first, mate = a_pair(driver)
    driver.flip(first)
    driver.flip(next(p for p in driver.view.closed if p.row == mate.row and p not in (first, mate)))
    assert driver.view.mood is Mood.SAD


def test_the_next_card_ends_the_face_about_the_last_move() -> None:
    driver = Driver(plan(policy=ONLY_SECOND, timing=Timing(mood_ms=60_000)), 1)
    driver.to_the_game()
    miss(driver)
    driver.wait_until_open()
    assert seen(driver, "mood") == (Mood.CONFUSED,)
    driver.flip(driver.view.closed[0])
    assert seen(driver, "mood") == (Mood.IDLE,)


def test_a_second_flip_without_a_hint_leaves_the_face_as_it_is() -> None:
    driver = playing()
    begun = len(driver.steps)
    for place in a_pair(driver):
        driver.flip(place)
    played = [command for step in driver.steps[begun:] for command in step.outcome.effects]
    assert played
    assert not [command for command in played if isinstance(command, do.SetExpression)]


def test_a_hint_for_the_first_card_alone_leaves_the_face_as_it_is() -> None:
    driver = playing(ActionSpec.SUG_CARD)
    driver.flip(Position(0, 0))
    assert driver.view.mood is Mood.IDLE


# Taps that do not wait

AT_ONCE: dict[str, Any] = {"highlight_delay_ms": 0, "taps_wait": False}


def test_a_hint_marks_at_once_and_the_board_is_open_while_it_is_said() -> None:
    driver = playing(ActionSpec.SUG_ROW, **AT_ONCE)
    kinds = [type(event) for event in driver.events if event.at_ms == driver.now]
    assert kinds[-3:] == [happened.HintGiven, happened.BoardUnlocked, happened.HintHighlighted]
    assert driver.view.held is None
    assert driver.view.mark is not None
    driver.spend(SPEECH_TIME)
    assert (len(driver.noted(happened.BoardUnlocked)), len(driver.noted(happened.HintHighlighted))) == (1, 1)
    assert driver.running.keys() == {Timer.IDLE}


def test_a_tap_ends_the_sentence_and_the_record_says_so() -> None:
    driver = playing(ActionSpec.SUG_ROW, **AT_ONCE)
    driver.spend(SPEECH_LAG)
    outcome = driver.tap(driver.view.closed[0])
    cut, flipped = outcome.events[:2]
    assert cut == happened.SpeechCutShort(at_ms=driver.now, utterance=driver.noted(happened.HintGiven)[0].utterance)
    assert isinstance(flipped, happened.CardFlipped)
    assert {do.StopSpeaking(), do.ClearBubble(), do.StopTimer(Timer.SPEECH_DEADLINE)} <= set(outcome.effects)
    said = {each.utterance: each for each in SessionState.from_events(driver.events).sentences}[cut.utterance]
    assert (said.attempts[-1].cut_ms, said.attempts[-1].finished_ms) == (driver.now, None)


def test_a_sentence_may_be_said_to_its_end_while_cards_are_turned() -> None:
    driver = Driver(plan(policy=ONLY_SECOND, timing=Timing(tap_ends_sentence=False, **AT_ONCE)), 1, Voice.SPEAKS)
    driver.to_the_game()
    driver.tap(driver.view.closed[0])
    driver.spend(SPEECH_LAG)
    driver.tap(driver.view.closed[0])
    assert driver.noted(happened.SpeechCutShort) == []
    assert driver.view.mark is None
    assert driver.view.bubble
    driver.spend(SPEECH_TIME)
    assert isinstance(driver.world[-1], happened.SpeechFinished)
    assert not driver.view.bubble


def test_a_hint_that_is_only_read_is_put_away_by_a_tap_without_a_voice_to_cut() -> None:
    driver = playing(ActionSpec.SUG_ROW, Voice.FAILS, tap_ends_sentence=False, **AT_ONCE)
    driver.spend(10)
    outcome = driver.tap(driver.view.closed[0])
    assert do.ClearBubble() in outcome.effects
    assert driver.noted(happened.SpeechCutShort) == []


def test_the_share_of_time_in_which_taps_wait_is_that_of_hints_and_of_cards_that_turn_back() -> None:
    def shares(**timing: Any) -> WaitingShares:
        driver = playing(ActionSpec.SUG_ROW, **timing)
        driver.play(with_memory(1))
        found = waiting_shares(SessionState.from_events(driver.events))
        assert found is not None
        return found

    waits, open_at_once = shares(), shares(**AT_ONCE)
    assert waits.hint > 0.4
    assert open_at_once.hint == 0
    assert 0 < waits.turning_back < open_at_once.turning_back < 1


def test_a_least_time_of_a_hold_needs_taps_that_wait() -> None:
    with pytest.raises(ValidationError, match="hold_min_ms must be 0 if taps_wait is false"):
        Timing(hold_min_ms=10, taps_wait=False)
