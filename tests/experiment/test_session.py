"""A session from the first tap to the end, as a visitor lives through it."""

from __future__ import annotations

import pytest

from kiosk import UserInputError
from kiosk.assistance.policy import ActionSpec
from kiosk.config import STAGES, Game, Practice
from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.condition import CONDITIONS, Condition
from kiosk.experiment.effects import Mood
from kiosk.experiment.outcomes import Stage, Status
from kiosk.experiment.session import Session
from tests.experiment.driver import Driver, Voice, at_random, driven_to, with_memory
from tests.experiment.table import playing, seen
from tests.samples import ENGLISH, SHORT, always, plan, whole

UNDERWAY = list(Stage)[1:-1]


# The course


@pytest.mark.parametrize("stages", [SHORT, STAGES])
def test_a_session_goes_through_every_stage_once(stages: tuple[str, ...]) -> None:
    driver = Driver(plan(stages=stages), 2)
    assert driver.stage is Stage.ATTRACT
    driver.whole_session(with_memory(2))
    entered = [event.stage for event in driver.noted(happened.StageEntered)]
    assert [stage.value for stage in entered] == [*stages, "over"]
    assert [event.status for event in driver.noted(happened.SessionEnded)] == [Status.COMPLETED]
    assert driver.view.ended is Status.COMPLETED
    assert isinstance(driver.events[-1], happened.SessionEnded)
    assert not driver.running


@pytest.mark.parametrize("voice", Voice)
@pytest.mark.parametrize("condition", CONDITIONS)
def test_a_session_comes_to_its_end_whatever_the_body_does(voice: Voice, condition: Condition) -> None:
    driver = Driver(whole(condition), 3, voice)
    driver.whole_session(at_random(3))
    assert driver.view.ended is Status.COMPLETED
    assert driver.session.measures.pairs == 12
    assert driver.view.progress == (12, driver.session.measures.moves)


def test_what_is_concluded_has_the_time_of_what_it_follows_from() -> None:
    driver = Driver(whole(), 2)
    driver.whole_session(at_random(2))
    for step in driver.steps:
        assert all(event.at_ms == step.event.at_ms for event in step.outcome.events)


def test_leaving_a_stage_takes_its_sentence_with_it() -> None:
    driver = Driver(plan(policy=always(ActionSpec.NO_HELP)), 2)
    driver.start()
    assert driver.view.bubble in ENGLISH.wordings("introduction-speech", cards=24, pairs=12)
    outcome = driver.go_on()
    assert outcome.effects.index(do.StopSpeaking()) < outcome.effects.index(do.ClearBubble())
    assert seen(driver, "screen", "bubble", "speaking") == ("board", None, None)


@pytest.mark.parametrize("voice", Voice)
def test_nothing_of_a_session_is_left_when_it_is_over(voice: Voice) -> None:
    driver = Driver(whole(), 2, voice)
    driver.whole_session(at_random(2))
    assert seen(driver, "speaking", "bubble", "mark", "mood", "still_there") == (None, None, None, Mood.IDLE, False)
    assert not driver.running


def test_the_introduction_can_be_left_while_it_is_spoken() -> None:
    driver = Driver(plan(policy=always(ActionSpec.NO_HELP)), 2)
    driver.to_the_game()
    driver.wait()
    assert isinstance(driver.world[-1], happened.SpeechFinished)
    assert (driver.view.screen, driver.view.held) == ("board", None)


def test_the_board_is_shown_without_telling_what_lies_where() -> None:
    driver = playing()
    shown = next(command for command in driver.effects if isinstance(command, do.ShowBoard))
    assert shown == do.ShowBoard(rows=4, columns=6, pairs=12, deck="animals", practice=False)


@pytest.mark.parametrize("stage", UNDERWAY)
def test_a_program_that_is_closed_interrupts_the_session(stage: Stage) -> None:
    driver = driven_to(stage)
    outcome = driver.send(happened.ApplicationClosed(at_ms=driver.now))
    assert [type(event).__name__ for event in outcome.events] == ["StageEntered", "SessionEnded"]
    assert outcome.events[-1] == happened.SessionEnded(at_ms=driver.now, status=Status.INTERRUPTED)
    assert (driver.stage, driver.running) == (Stage.OVER, {})


# What cannot be played


def test_a_deck_with_too_few_cards_is_refused_in_words() -> None:
    with pytest.raises(UserInputError, match="a board of 6 x 6 needs 18 different cards, not 12"):
        Session(plan(game=Game(rows=6, columns=6)), 1)
    with pytest.raises(UserInputError, match="from the deck 'fruit': a board of 4 x 4 needs 8 different cards, not 6"):
        Session(whole(practice=Practice(rows=4, columns=4)), 1)


def test_a_study_without_a_practice_needs_no_deck_for_it() -> None:
    assert Session(plan(practice=Practice(rows=4, columns=4)), 1).stage is Stage.ATTRACT


def test_a_board_with_an_odd_number_of_cards_is_refused_in_words() -> None:
    with pytest.raises(UserInputError, match="a board of 3 x 3"):
        Session(plan(game=Game(rows=3, columns=3)), 1)


@pytest.mark.parametrize(("rows", "columns"), [(1, 2), (2, 2), (2, 6), (3, 4)])
def test_other_boards_can_be_played(rows: int, columns: int) -> None:
    driver = Driver(plan(game=Game(rows=rows, columns=columns)), 1)
    driver.whole_session(at_random(1))
    assert driver.session.measures.pairs == rows * columns // 2
