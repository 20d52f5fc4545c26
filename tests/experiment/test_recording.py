"""Whether a session is written down is decided once, and said once: kept past all that is decided, or forgotten."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from kiosk.assistance.policy import ActionSpec
from kiosk.config import STAGES, Game
from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.condition import Condition
from kiosk.experiment.effects import Outcome
from kiosk.experiment.outcomes import NotRecordedReason, RecordingState, Stage, Status
from kiosk.experiment.session_config import SessionConfig
from kiosk.experiment.transitions import BEFORE_DECIDING
from tests.experiment.driver import Driver, driven_to, with_memory
from tests.samples import always, plan

DECIDING = [stage for stage in Stage if stage in BEFORE_DECIDING]
AFTER = [stage for stage in Stage if stage not in {*BEFORE_DECIDING, Stage.ATTRACT, Stage.OVER}]
LEAVING: dict[Status, Callable[[Driver], object]] = {
    Status.STOPPED: lambda driver: driver.end(),
    Status.INTERRUPTED: lambda driver: driver.send(happened.ApplicationClosed(at_ms=driver.now)),
    Status.ABANDONED: lambda driver: driver.be_away(),
}
"""Every way to leave a session before it is completed."""


def ended(stage: Stage, how: Status) -> Status:
    """How a session ends that is left in a stage; one that is left at the thanks is complete."""
    return Status.COMPLETED if (stage, how) == (Stage.THANKS, Status.ABANDONED) else how


def of(*stages: str) -> SessionConfig:
    """Return a session of these stages with a small game."""
    return plan(stages=stages, game=Game(rows=2, columns=2))


def without(*left_out: str) -> SessionConfig:
    """Return a session of all stages but these."""
    return of(*(stage for stage in STAGES if stage not in left_out))


@pytest.mark.parametrize("stage", [Stage.ATTRACT, *DECIDING])
def test_nothing_is_said_of_keeping_until_all_is_decided(stage: Stage) -> None:
    driver = driven_to(stage)
    assert driver.view.kept == []
    assert driver.session.keeping is RecordingState.UNDECIDED


@pytest.mark.parametrize("stage", [*AFTER, Stage.OVER])
def test_from_then_on_it_is_kept_and_that_is_said_once(stage: Stage) -> None:
    driver = driven_to(stage)
    assert driver.view.kept == [do.StartRecording()]
    assert driver.session.keeping is RecordingState.KEPT


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
    ids=lambda given: " ".join(given.settings.stages) if isinstance(given, SessionConfig) else given.value,
)
def test_it_is_kept_with_the_first_stage_past_deciding_whichever_that_is(chosen: SessionConfig, first: Stage) -> None:
    driver = Driver(chosen)
    driver.to(Stage.OVER)
    (step,) = (step for step in driver.steps if step.outcome.recording == do.StartRecording())
    entered = [event.stage for event in step.outcome.events if isinstance(event, happened.StageEntered)]
    assert entered == [first]
    assert driver.view.kept == [do.StartRecording()]


# Forgetting


def declined() -> Driver:
    """Return a visitor who has just declined to be stored."""
    driver = driven_to(Stage.CONSENT)
    driver.decline()
    return driver


def under_age() -> Driver:
    """Return a visitor who agreed, and then said that they are too young."""
    driver = driven_to(Stage.AGE)
    driver.say_age(adult=False)
    return driver


@pytest.mark.parametrize(
    ("visitor", "why"), [(declined, NotRecordedReason.DECLINED), (under_age, NotRecordedReason.UNDER_AGE)]
)
def test_whoever_decides_against_it_plays_all_the_same_and_is_forgotten(
    visitor: Callable[[], Driver], why: NotRecordedReason
) -> None:
    driver = visitor()
    assert driver.view.kept == [do.DiscardRecording(why)]
    assert driver.stage is Stage.INTRODUCTION
    asked = len(driver.steps)
    driver.to(Stage.OVER)
    assert driver.view.kept == [do.DiscardRecording(why)]
    assert driver.session.keeping is RecordingState.FORGOTTEN
    assert driver.view.ended is Status.COMPLETED
    concluded = (event for step in driver.steps[asked - 1 :] for event in step.outcome.events)
    later = [event.stage for event in concluded if isinstance(event, happened.StageEntered)]
    assert later == [Stage.INTRODUCTION, Stage.PRACTICE, Stage.GAME, Stage.RESULT, Stage.THANKS, Stage.OVER]
    assert driver.session.measures.pairs == 3


def test_somebody_too_young_is_not_asked_for_consent_afterwards() -> None:
    driver = Driver(of("about", "age", "consent", "about_you", "game"))
    driver.to(Stage.AGE)
    driver.say_age(adult=False)
    assert driver.stage is Stage.GAME
    assert driver.view.kept == [do.DiscardRecording(NotRecordedReason.UNDER_AGE)]


@pytest.mark.parametrize("stage", DECIDING)
@pytest.mark.parametrize("how", LEAVING)
def test_whoever_leaves_before_all_is_decided_is_forgotten(stage: Stage, how: Status) -> None:
    driver = driven_to(stage)
    LEAVING[how](driver)
    assert driver.view.kept == [do.DiscardRecording(NotRecordedReason.LEFT)]
    assert driver.view.ended is how


@pytest.mark.parametrize("stage", AFTER)
@pytest.mark.parametrize("how", LEAVING)
def test_whoever_leaves_later_is_kept_with_how_it_ended(stage: Stage, how: Status) -> None:
    driver = driven_to(stage)
    LEAVING[how](driver)
    assert driver.view.kept == [do.StartRecording()]
    assert driver.view.ended is ended(stage, how)


@pytest.mark.parametrize("stage", [Stage.INTRODUCTION, Stage.PRACTICE, Stage.GAME, Stage.RESULT, Stage.THANKS])
@pytest.mark.parametrize("how", LEAVING)
@pytest.mark.parametrize("visitor", [declined, under_age])
def test_nobody_is_forgotten_twice(visitor: Callable[[], Driver], how: Status, stage: Stage) -> None:
    driver = visitor()
    driver.to(stage)
    LEAVING[how](driver)
    assert len(driver.view.kept) == 1
    assert driver.view.forgotten in {NotRecordedReason.DECLINED, NotRecordedReason.UNDER_AGE}
    assert driver.view.ended is ended(stage, how)


@pytest.mark.parametrize("stage", list(Stage)[1:-1])
def test_the_experimenter_can_end_a_session_anywhere(stage: Stage) -> None:
    driver = driven_to(stage)
    outcome = driver.end("a fire drill")
    assert driver.world[-1] == happened.AbortRequested(at_ms=driver.now, reason="a fire drill")
    assert [type(event).__name__ for event in outcome.events] == ["StageEntered", "SessionEnded"]
    assert outcome.events[-1] == happened.SessionEnded(at_ms=driver.now, status=Status.STOPPED)
    assert (driver.stage, driver.running) == (Stage.OVER, {})


def unstored_game(condition: Condition, seed: int) -> list[Outcome]:
    """Return what a visitor who declines sees of a game, flip by flip of the same cards."""
    quotas = {"target_n": {"tom": 1, "no_assistance": 1}, "block_size": 2}
    driver = Driver(plan(condition, always(ActionSpec.SUG_CARD), STAGES, randomisation=quotas), seed)
    driver.to(Stage.CONSENT)
    driver.send(happened.ConsentDeclined(at_ms=driver.now))
    driver.to(Stage.GAME)
    driver.play(with_memory(seed))
    return [step.outcome for step in driver.steps]


def test_whoever_declines_plays_in_a_condition_by_chance_that_tells_nothing_of_the_next_visitor_s() -> None:
    games = []
    for seed in range(8):
        assert unstored_game(Condition.TOM, seed) == unstored_game(Condition.NO_ASSISTANCE, seed)
        games.append(
            any(
                isinstance(c, do.HighlightHint)
                for outcome in unstored_game(Condition.TOM, seed)
                for c in outcome.effects
            )
        )
    assert set(games) == {True, False}
