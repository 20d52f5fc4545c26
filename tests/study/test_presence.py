"""Who is there: asked after a time without a tap, and not while the experimenter has stopped the sitting."""

from __future__ import annotations

import pytest

from kiosk.assistant.mdp import Action
from kiosk.game import Position
from kiosk.settings import Idle, Timing
from kiosk.study import commands as do
from kiosk.study import events as happened
from kiosk.study.events import Stage, Status, Timer
from tests.samples import always, whole
from tests.study.driver import Voice, driven_to
from tests.study.table import a_pair, playing

LONG_ENOUGH = {
    Stage.ABOUT: 60_000,
    Stage.CONSENT: 90_000,
    Stage.AGE: 45_000,
    Stage.ABOUT_YOU: 60_000,
    Stage.INTRODUCTION: 45_000,
    Stage.PRACTICE: 60_000,
    Stage.GAME: 120_000,
    Stage.RESULT: 45_000,
    Stage.QUESTIONS: 60_000,
    Stage.DEBRIEF: 90_000,
    Stage.THANKS: 45_000,
}
"""How long every stage waits before it asks, in ms, if the study file does not say otherwise."""

LASTING = whole(policy=always(Action.NO_HELP), timing=Timing(thanks=10**6))
"""A sitting whose thanks do not end by themselves before anybody can be asked."""


def test_there_is_a_time_for_every_stage() -> None:
    assert list(LONG_ENOUGH) == list(Stage)[1:-1]


@pytest.mark.parametrize(("stage", "after"), list(LONG_ENOUGH.items()))
def test_whoever_does_nothing_is_asked_whether_they_are_still_there(stage: Stage, after: int) -> None:
    driver = driven_to(stage, LASTING)
    at = driver.now
    driver.spend(after - 1)
    assert not driver.view.still_there
    driver.spend(1)
    assert driver.view.still_there
    assert (driver.now, driver.stage) == (at + after, stage)


def test_in_the_game_they_may_think_for_longer() -> None:
    driver = playing()
    driver.spend(119_999)
    assert not driver.view.still_there
    driver.spend(1)
    assert driver.view.still_there


@pytest.mark.parametrize("stage", LONG_ENOUGH)
def test_whoever_does_not_answer_has_left_and_the_sitting_is_abandoned_there(stage: Stage) -> None:
    driver = driven_to(stage, LASTING)
    while not driver.view.still_there:
        driver.wait()
    asked_at = driver.now
    driver.spend(19_999)
    assert driver.stage is stage
    driver.spend(1)
    assert (driver.now, driver.view.ended) == (asked_at + 20_000, Status.ABANDONED)
    assert [type(event).__name__ for event in driver.events[-3:]] == ["VisitorLeft", "StageEntered", "SittingEnded"]
    assert not driver.running


@pytest.mark.parametrize("stage", LONG_ENOUGH)
def test_whoever_answers_goes_on_where_they_were(stage: Stage) -> None:
    driver = driven_to(stage, LASTING)
    while not driver.view.still_there:
        driver.wait()
    driver.send(happened.StillHereTapped(at_ms=driver.now))
    assert (driver.view.still_there, driver.stage) == (False, stage)
    assert driver.running.keys() - {Timer.PRACTICE, Timer.THANKS} == {Timer.IDLE}
    assert driver.running[Timer.IDLE] == driver.now + LONG_ENOUGH[stage]


def test_any_tap_is_an_answer_too() -> None:
    driver = playing()
    while not driver.view.still_there:
        driver.wait()
    commands = driver.tap(Position(0, 0))
    assert not driver.view.still_there
    assert do.StopTimer(Timer.STILL_THERE) in commands
    assert Timer.STILL_THERE not in driver.running


def test_every_tap_starts_the_idle_time_anew() -> None:
    driver = playing(Action.SUG_CARD, Voice.IS_SILENT)
    driver.spend(1000)
    driver.tap(Position(0, 0))
    assert driver.running[Timer.IDLE] == driver.now + 120_000


def test_a_sentence_that_ends_does_not_show_that_somebody_is_there() -> None:
    driver = playing(Action.SUG_CARD)
    until = driver.running[Timer.IDLE]
    driver.wait_until_open()
    assert driver.running[Timer.IDLE] == until


def test_a_stage_that_ends_by_itself_takes_the_question_with_it() -> None:
    driver = driven_to(
        Stage.GAME, whole(policy=always(Action.NO_HELP), idle=Idle(game=1000), timing=Timing(finish=1500))
    )
    while len(driver.view.found) < 24:
        for place in a_pair(driver):
            driver.flip(place)
    driver.spend(1000)
    assert driver.view.still_there
    driver.spend(500)
    assert driver.stage is Stage.RESULT
    assert not driver.view.still_there
