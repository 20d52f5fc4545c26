"""Whether a sitting is written down is decided once, and said once: kept past all that is decided, or forgotten."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from kiosk.assistant.mdp import Action
from kiosk.settings import STAGES, Game
from kiosk.study import commands as do
from kiosk.study import events as happened
from kiosk.study.condition import Condition
from kiosk.study.events import Stage, Status, Unstored
from kiosk.study.plan import Plan
from kiosk.study.session import Keeping
from kiosk.study.stages import BEFORE_DECIDING
from tests.samples import always, plan
from tests.study.driver import Driver, driven_to, notes, with_memory

DECIDING = [stage for stage in Stage if stage in BEFORE_DECIDING]
AFTER = [stage for stage in Stage if stage not in {*BEFORE_DECIDING, Stage.ATTRACT, Stage.OVER}]
LEAVING: dict[Status, Callable[[Driver], object]] = {
    Status.STOPPED: lambda driver: driver.end(),
    Status.INTERRUPTED: lambda driver: driver.send(happened.KioskClosed(at_ms=driver.now)),
    Status.ABANDONED: lambda driver: driver.be_away(),
}
"""Every way to leave a sitting before it is completed."""


def ended(stage: Stage, how: Status) -> Status:
    """How a sitting ends that is left in a stage; whoever walks away from the thanks has been through all of it."""
    return Status.COMPLETED if (stage, how) == (Stage.THANKS, Status.ABANDONED) else how


def of(*stages: str) -> Plan:
    """A sitting of these stages with a small game."""
    return plan(stages=stages, game=Game(rows=2, columns=2))


def without(*left_out: str) -> Plan:
    """A sitting of all stages but these."""
    return of(*(stage for stage in STAGES if stage not in left_out))


@pytest.mark.parametrize("stage", [Stage.ATTRACT, *DECIDING])
def test_nothing_is_said_of_keeping_until_all_is_decided(stage: Stage) -> None:
    driver = driven_to(stage)
    assert driver.view.kept == []
    assert driver.session.keeping is Keeping.UNDECIDED


@pytest.mark.parametrize("stage", [*AFTER, Stage.OVER])
def test_from_then_on_it_is_kept_and_that_is_said_once(stage: Stage) -> None:
    driver = driven_to(stage)
    assert driver.view.kept == [do.KeepSitting()]
    assert driver.session.keeping is Keeping.KEPT


@pytest.mark.parametrize(
    ("chosen", "first"),
    [
        (without(), Stage.ABOUT_YOU),
        (without("about_you"), Stage.INTRODUCTION),
        (without("consent"), Stage.ABOUT_YOU),
        (without("age"), Stage.ABOUT_YOU),
        (without("consent", "age"), Stage.ABOUT_YOU),
        (without("about", "consent", "age"), Stage.ABOUT_YOU),
        (of("age", "consent", "practice", "game"), Stage.PRACTICE),
        (of("consent", "game"), Stage.GAME),
        (of("introduction", "about", "game"), Stage.INTRODUCTION),
        (of("game"), Stage.GAME),
    ],
    ids=lambda given: " ".join(given.settings.stages) if isinstance(given, Plan) else given.value,
)
def test_it_is_kept_with_the_first_stage_past_deciding_whichever_that_is(chosen: Plan, first: Stage) -> None:
    driver = Driver(chosen)
    driver.to(Stage.OVER)
    (step,) = (step for step in driver.steps if do.KeepSitting() in step.commands)
    entered = [event.stage for event in notes(step.commands) if isinstance(event, happened.StageEntered)]
    assert entered == [first]
    assert driver.view.kept == [do.KeepSitting()]


# Forgetting


def declined() -> Driver:
    """A visitor who has just said that nothing shall be stored."""
    driver = driven_to(Stage.CONSENT)
    driver.decline()
    return driver


def under_age() -> Driver:
    """A visitor who agreed, and then said that they are too young."""
    driver = driven_to(Stage.AGE)
    driver.say_age(adult=False)
    return driver


@pytest.mark.parametrize(("visitor", "why"), [(declined, Unstored.DECLINED), (under_age, Unstored.UNDER_AGE)])
def test_whoever_decides_against_it_plays_all_the_same_and_is_forgotten(
    visitor: Callable[[], Driver], why: Unstored
) -> None:
    driver = visitor()
    assert driver.view.kept == [do.ForgetSitting(why)]
    assert driver.stage is Stage.INTRODUCTION
    asked = len(driver.steps)
    driver.to(Stage.OVER)
    assert driver.view.kept == [do.ForgetSitting(why)]
    assert driver.session.keeping is Keeping.FORGOTTEN
    assert driver.view.ended is Status.COMPLETED
    concluded = (event for step in driver.steps[asked - 1 :] for event in notes(step.commands))
    later = [event.stage for event in concluded if isinstance(event, happened.StageEntered)]
    assert later == [Stage.INTRODUCTION, Stage.PRACTICE, Stage.GAME, Stage.RESULT, Stage.THANKS, Stage.OVER]
    assert driver.session.measures.pairs == 3


def test_somebody_too_young_is_not_asked_for_consent_afterwards() -> None:
    driver = Driver(of("about", "age", "consent", "about_you", "game"))
    driver.to(Stage.AGE)
    driver.say_age(adult=False)
    assert driver.stage is Stage.GAME
    assert driver.view.kept == [do.ForgetSitting(Unstored.UNDER_AGE)]


@pytest.mark.parametrize("stage", DECIDING)
@pytest.mark.parametrize("how", LEAVING)
def test_whoever_leaves_before_all_is_decided_is_forgotten(stage: Stage, how: Status) -> None:
    driver = driven_to(stage)
    LEAVING[how](driver)
    assert driver.view.kept == [do.ForgetSitting(Unstored.LEFT)]
    assert driver.view.ended is how


@pytest.mark.parametrize("stage", AFTER)
@pytest.mark.parametrize("how", LEAVING)
def test_whoever_leaves_later_is_kept_with_how_it_ended(stage: Stage, how: Status) -> None:
    driver = driven_to(stage)
    LEAVING[how](driver)
    assert driver.view.kept == [do.KeepSitting()]
    assert driver.view.ended is ended(stage, how)


@pytest.mark.parametrize("stage", [Stage.INTRODUCTION, Stage.PRACTICE, Stage.GAME, Stage.RESULT, Stage.THANKS])
@pytest.mark.parametrize("how", LEAVING)
@pytest.mark.parametrize("visitor", [declined, under_age])
def test_nobody_is_forgotten_twice(visitor: Callable[[], Driver], how: Status, stage: Stage) -> None:
    driver = visitor()
    driver.to(stage)
    LEAVING[how](driver)
    assert len(driver.view.kept) == 1
    assert driver.view.forgotten in {Unstored.DECLINED, Unstored.UNDER_AGE}
    assert driver.view.ended is ended(stage, how)


@pytest.mark.parametrize("stage", list(Stage)[1:-1])
def test_the_experimenter_can_end_a_sitting_anywhere(stage: Stage) -> None:
    driver = driven_to(stage)
    commands = driver.end("a fire drill")
    assert driver.world[-1] == happened.EndAsked(at_ms=driver.now, reason="a fire drill")
    assert [type(event).__name__ for event in notes(commands)] == ["StageEntered", "SittingEnded"]
    assert commands[-1] == do.EndSitting(Status.STOPPED)
    assert (driver.stage, driver.running) == (Stage.OVER, {})


def unstored_game(condition: Condition, seed: int) -> list[tuple[do.Command, ...]]:
    """What somebody who declines sees of a game, flip by flip of the same cards."""
    quotas = {"quotas": {"tom": 1, "no_assistance": 1}, "block": 2}
    driver = Driver(plan(condition, always(Action.SUG_CARD), STAGES, allocation=quotas), seed)
    driver.to(Stage.CONSENT)
    driver.send(happened.DeclineTapped(at_ms=driver.now))
    driver.to(Stage.GAME)
    driver.play(with_memory(seed))
    return [step.commands for step in driver.steps]


def test_whoever_declines_plays_in_a_condition_by_chance_that_tells_nothing_of_the_next_visitor_s() -> None:
    games = []
    for seed in range(8):
        assert unstored_game(Condition.TOM, seed) == unstored_game(Condition.NO_ASSISTANCE, seed)
        games.append(
            any(isinstance(c, do.ShowMark) for commands in unstored_game(Condition.TOM, seed) for c in commands)
        )
    assert set(games) == {True, False}
