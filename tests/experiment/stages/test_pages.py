"""The stages in which a visitor reads or listens, and goes on."""

from __future__ import annotations

import pytest

from kiosk.config import ConditionConfig, Timing
from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.condition import CONDITIONS, Condition
from kiosk.experiment.effects import Mood
from kiosk.experiment.outcomes import Stage, Status
from tests.experiment.driver import Driver, driven_to, with_memory
from tests.experiment.table import a_pair, miss, playing
from tests.samples import ENGLISH, INFORMATION, plan, whole


def test_the_result_tells_moves_pairs_time_and_hints() -> None:
    driver = Driver(plan(), 2)
    driver.to_the_game()
    driver.play(with_memory(2))
    flips = driver.noted(happened.CardFlipped)
    measured = driver.session.measures
    hints = len(driver.noted(happened.HintGiven))
    assert driver.view.result == do.ShowResult(
        pairs=12, moves=len(flips) // 2, time_ms=measured.completion_ms, hints=hints
    )
    assert measured.completion_with_speech_ms == flips[-1].at_ms - flips[0].at_ms
    assert (measured.completion_ms or 0) < measured.completion_with_speech_ms
    assert (driver.view.screen, driver.view.mood) == ("result", Mood.HAPPY)


@pytest.mark.parametrize(
    ("moves", "message"),
    [(12, "few"), (24, "few"), (25, "some"), (29, "some"), (30, "many"), (31, "many")],
)
def test_the_remark_goes_by_the_number_of_moves(moves: int, message: str) -> None:
    driver = playing()
    for _ in range(moves - 12):
        miss(driver)
    while driver.view.closed:
        for place in a_pair(driver):
            driver.flip(place)
    driver.wait_until_open()
    assert driver.session.measures.moves == moves
    assert driver.view.bubble in ENGLISH.wordings(f"result-speech-{message}", moves=moves)


# Introduction


@pytest.mark.parametrize("condition", CONDITIONS)
def test_nobody_is_promised_help_that_there_is_not(condition: Condition) -> None:
    driver = driven_to(Stage.INTRODUCTION, whole(condition))
    helped = condition != Condition.NO_ASSISTANCE
    assert do.ShowIntroduction(helped=helped, points=helped) in driver.steps[-1].outcome.effects
    speech = "introduction-speech" if helped else "introduction-speech-alone"
    assert driver.view.bubble in ENGLISH.wordings(speech, cards=24, pairs=12)


def test_no_mark_is_shown_where_hints_name_no_place() -> None:
    reminding = whole(Condition("reminded"), conditions={"reminded": ConditionConfig(location=False)})
    driver = driven_to(Stage.INTRODUCTION, reminding)
    assert do.ShowIntroduction(helped=True, points=False) in driver.steps[-1].outcome.effects


# Debrief and thanks


def test_the_study_is_explained_before_the_thanks() -> None:
    driver = driven_to(Stage.DEBRIEF)
    assert do.ShowDebrief(INFORMATION.debrief) in driver.steps[-1].outcome.effects
    assert driver.view.mood is Mood.IDLE
    driver.go_on()
    assert (driver.stage, driver.view.mood) == (Stage.THANKS, Mood.HAPPY)
    assert driver.view.bubble in ENGLISH.wordings("thanks-speech")


def test_thanks_end_by_themselves() -> None:
    driver = driven_to(Stage.THANKS, whole(timing=Timing(thanks_ms=5000)))
    came = driver.now
    driver.spend(4999)
    assert driver.stage is Stage.THANKS
    driver.spend(1)
    assert (driver.now, driver.view.ended) == (came + 5000, Status.COMPLETED)
    assert driver.noted(happened.ThanksTimedOut) == [happened.ThanksTimedOut(at_ms=driver.now)]


def test_thanks_end_when_the_experimenter_gets_ready_for_the_next_visitor() -> None:
    driver = driven_to(Stage.THANKS)
    driver.send(happened.NextParticipantRequested(at_ms=driver.now))
    assert (driver.view.ended, driver.running) == (Status.COMPLETED, {})


def test_thanks_end_with_a_tap() -> None:
    driver = driven_to(Stage.THANKS)
    driver.go_on()
    assert driver.view.ended is Status.COMPLETED
    assert driver.noted(happened.ThanksTimedOut) == []
    assert driver.running == {}


@pytest.mark.parametrize(
    ("stage", "mood"),
    [
        (Stage.ABOUT_YOU, Mood.LISTENING),
        (Stage.INTRODUCTION, Mood.IDLE),
        (Stage.PRACTICE, Mood.IDLE),
        (Stage.GAME, Mood.IDLE),
        (Stage.RESULT, Mood.HAPPY),
        (Stage.QUESTIONS, Mood.LISTENING),
        (Stage.DEBRIEF, Mood.IDLE),
        (Stage.THANKS, Mood.HAPPY),
        (Stage.OVER, Mood.IDLE),
    ],
)
def test_every_stage_begins_with_its_own_face(stage: Stage, mood: Mood) -> None:
    assert driven_to(stage).view.mood is mood
