"""A session that was cut off goes on from the start of the stage it was in, never in the middle of a game."""

from __future__ import annotations

from dataclasses import replace
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kiosk.config import STAGES, Game, Practice
from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.events import Timer, WorldEvent
from kiosk.experiment.outcomes import EmbodimentName, RecordingState, Stage, Status
from kiosk.experiment.questionnaire import ItemOrder
from kiosk.experiment.session import Session
from kiosk.experiment.session_config import SessionConfig
from kiosk.experiment.transitions import InvalidTransition
from tests.experiment.driver import Driver, Step, Voice, driven_to, replay
from tests.experiment.table import miss
from tests.samples import CLOSING, likert, plan, questionnaire, whole

SEED = 5
CAN_BE_RESUMED = [
    stage
    for stage in Stage
    if stage not in {Stage.ATTRACT, Stage.ABOUT, Stage.CONSENT, Stage.AGE, Stage.GAME, Stage.OVER}
]
SMALL = whole(game=Game(rows=2, columns=3), practice=Practice(rows=2, columns=3))


def an_eventful_session(plan: SessionConfig, seed: int) -> list[WorldEvent]:
    """Return what came from outside in a whole session with practice, pauses, repeats and a lost robot."""
    chance = Random(seed)
    driver = Driver(plan, SEED, chance.choice(list(Voice)))
    driver.start()
    lost_in = chance.choice(CAN_BE_RESUMED)
    while driver.stage is not Stage.OVER:
        here = driver.stage
        if here is lost_in:
            driver.send(happened.RobotDisconnected(at_ms=driver.now, why="the plug"))
        for happens in chance.sample([pause_for_a_moment, say_it_again, practise], k=chance.randrange(4)):
            if driver.stage is here:
                happens(driver)
        if driver.stage is here:
            driver.do_what_is_asked()
    return driver.world


def pause_for_a_moment(driver: Driver) -> None:
    """Stop the session as the experimenter, and let it go on unless it ended meanwhile."""
    driver.pause()
    driver.spend(1500)
    if driver.view.paused:
        driver.end_pause()


def say_it_again(driver: Driver) -> None:
    """Have the last sentence repeated, if there is one that was said."""
    if driver.view.bubble and driver.view.speaking is None:
        driver.repeat()


def practise(driver: Driver) -> None:
    """Try the practice for a while."""
    if driver.stage is Stage.PRACTICE:
        driver.flip(driver.view.closed[0])
        driver.flip(driver.view.closed[-1])


def stage_after(plan: SessionConfig, past: list[WorldEvent]) -> tuple[Stage, RecordingState]:
    """Where a session is after these events, and whether it is kept by then."""
    session = Session(plan, SEED)
    for event in past:
        session.handle(event)
    return session.stage, session.keeping


@given(seed=st.integers(0, 10**6), data=st.data())
def test_a_session_that_is_cut_off_anywhere_else_can_be_finished_and_replayed(seed: int, data: st.DataObject) -> None:
    world = an_eventful_session(SMALL, seed)
    past = world[: data.draw(st.integers(1, len(world)))]
    stage, keeping = stage_after(SMALL, past)
    if keeping is not RecordingState.KEPT or stage not in CAN_BE_RESUMED:
        with pytest.raises(InvalidTransition):
            Driver.resumed(SMALL, SEED, past)
        return
    driver = Driver.resumed(SMALL, SEED, past)
    assert driver.stage is stage
    driver.to(Stage.OVER)
    assert driver.view.ended is Status.COMPLETED
    assert replay(SMALL, SEED, driver.world) == [step.outcome for step in driver.steps]
    entered = [event.stage for event in driver.noted(happened.StageEntered)]
    once = [stage for index, stage in enumerate(entered) if stage not in entered[:index]]
    assert [stage.value for stage in once] == [*STAGES, "over"]
    assert len(entered) == len(once) + 1
    decisions = [step.outcome.recording for step in driver.steps if step.outcome.recording is not None]
    assert decisions == [do.StartRecording()]


def beginning(step: Step) -> list[object]:
    """All that is done as a stage begins, whatever is said in it."""
    first = max(index for index, command in enumerate(step.outcome.effects) if _idle(command))
    begun = (effect for effect in step.outcome.effects[first:] if not isinstance(effect, do.OfferBack))
    return [type(effect) if isinstance(effect, do.Speak) else effect for effect in begun]


def _idle(command: do.Effect) -> bool:
    return isinstance(command, do.StartTimer) and command.timer is Timer.IDLE


@pytest.mark.parametrize("stage", CAN_BE_RESUMED)
def test_a_stage_that_is_resumed_begins_as_it_began(stage: Stage) -> None:
    begun = driven_to(stage, SMALL, SEED)
    resumed = Driver.resumed(SMALL, SEED, begun.world)
    assert beginning(resumed.steps[-1]) == beginning(begun.steps[-1])
    assert {timer: until - resumed.now for timer, until in resumed.running.items()} == {
        timer: until - begun.now for timer, until in begun.running.items()
    }


@pytest.mark.parametrize("stage", CAN_BE_RESUMED)
def test_going_on_is_recorded_with_the_body_that_helps_then(stage: Stage) -> None:
    past = driven_to(stage, SMALL, SEED).world
    driver = Driver.resumed(SMALL, SEED, past, EmbodimentName.robot("furhat"))
    step = driver.steps[-1]
    assert step.event == happened.SessionResumed(at_ms=past[-1].at_ms, embodiment=EmbodimentName.robot("furhat"))
    assert step.outcome.events[0] == happened.StageEntered(at_ms=driver.now, stage=stage)


def test_a_robot_that_was_lost_before_can_be_lost_again_after_going_on() -> None:
    driver = driven_to(Stage.INTRODUCTION, SMALL, SEED)
    driver.send(happened.RobotDisconnected(at_ms=driver.now, why="the plug"))
    driver = Driver.resumed(SMALL, SEED, driver.world, EmbodimentName.robot("furhat"))
    driver.send(happened.RobotDisconnected(at_ms=driver.now, why="the plug"))
    assert len(driver.noted(happened.EmbodimentChanged)) == 2


def test_a_practice_deals_the_same_board_again_with_every_card_closed() -> None:
    driver = driven_to(Stage.PRACTICE, SMALL, SEED)
    for _ in range(3):
        miss(driver)
    driver = Driver.resumed(SMALL, SEED, driver.world)
    first, second = driver.noted(happened.BoardDealt)
    assert replace(first, at_ms=second.at_ms) == second
    assert (driver.view.up, driver.view.held, driver.view.progress) == ({}, None, (0, 0))
    driver.tap(driver.view.closed[0])
    assert driver.noted(happened.CardFlipped)[-1].number == 1


@pytest.mark.parametrize("order", ItemOrder)
def test_questionnaires_begin_on_their_first_page_in_the_same_order_with_nothing_answered(order: ItemOrder) -> None:
    asked = (questionnaire("asked", *(likert(f"item{n}") for n in range(6)), per_page=2, order=order), CLOSING)
    longer = replace(plan(stages=("game", "questions"), game=Game(rows=1, columns=2)), questionnaires=asked)
    driver = driven_to(Stage.QUESTIONS, longer, SEED)
    for _ in range(3):
        assert driver.view.page is not None
        driver.answer(3, driver.view.page.items[0].id)
        driver.go_on()
    before = [shown.items for shown in driver.noted(happened.QuestionnairePageShown)]
    driver = Driver.resumed(longer, SEED, driver.world)
    assert driver.view.answers == {}
    assert driver.view.page is not None
    assert (driver.view.page.number, driver.view.page.of) == (1, 6)
    driver.to(Stage.OVER)
    after = [shown.items for shown in driver.noted(happened.QuestionnairePageShown)][len(before) :]
    assert after[: len(before)] == before
    assert sorted(name for page in after for name in page) == sorted(item.id for q in asked for item in q.items)


def test_the_result_is_that_of_the_game_that_was_played() -> None:
    driver = driven_to(Stage.RESULT, SMALL, SEED)
    shown = driver.view.result
    assert Driver.resumed(SMALL, SEED, driver.world).view.result == shown


@pytest.mark.parametrize("stage", CAN_BE_RESUMED)
def test_a_pause_is_over_when_the_session_goes_on(stage: Stage) -> None:
    driver = driven_to(stage, SMALL, SEED)
    driver.pause()
    driver = Driver.resumed(SMALL, SEED, driver.world)
    assert do.HidePause() in driver.steps[-1].outcome.effects
    assert not driver.view.paused
    driver.to(Stage.OVER)
    assert driver.view.ended is Status.COMPLETED


@pytest.mark.parametrize("stage", CAN_BE_RESUMED)
def test_what_ran_and_what_was_asked_before_the_cut_is_stopped(stage: Stage) -> None:
    driver = driven_to(stage, SMALL, SEED)
    driver.send(happened.TimerExpired(at_ms=driver.now, timer=Timer.IDLE))
    assert driver.view.still_there
    ran = driver.running.keys() - {Timer.IDLE}
    driver = Driver.resumed(SMALL, SEED, driver.world)
    stopped = {command.timer for command in driver.steps[-1].outcome.effects if isinstance(command, do.StopTimer)}
    assert stopped >= ran >= {Timer.STILL_THERE}
    assert do.StopSpeaking() in driver.steps[-1].outcome.effects
    assert not driver.view.still_there
    with pytest.raises(InvalidTransition):
        driver.send(happened.PresenceConfirmed(at_ms=driver.now))


@pytest.mark.parametrize("stage", CAN_BE_RESUMED)
def test_a_session_that_was_closed_with_the_program_goes_on_where_it_was(stage: Stage) -> None:
    driver, crashed = driven_to(stage, SMALL, SEED), driven_to(stage, SMALL, SEED)
    driver.send(happened.ApplicationClosed(at_ms=driver.now))
    assert driver.view.ended is Status.INTERRUPTED
    closed, cut = Driver.resumed(SMALL, SEED, driver.world), Driver.resumed(SMALL, SEED, crashed.world)
    assert closed.stage is stage
    assert beginning(closed.steps[-1]) == beginning(cut.steps[-1])
    closed.to(Stage.OVER)
    assert closed.view.ended is Status.COMPLETED
    assert closed.view.kept == []
    assert replay(SMALL, SEED, closed.world) == [step.outcome for step in closed.steps]


@pytest.mark.parametrize("stage", [Stage.CONSENT, Stage.GAME])
def test_what_cannot_go_on_after_a_crash_cannot_after_closing_either(stage: Stage) -> None:
    driver = driven_to(stage, SMALL, SEED)
    driver.send(happened.ApplicationClosed(at_ms=driver.now))
    with pytest.raises(InvalidTransition):
        Driver.resumed(SMALL, SEED, driver.world)


@pytest.mark.parametrize("stage", CAN_BE_RESUMED)
def test_what_was_ended_or_left_does_not_go_on(stage: Stage) -> None:
    ended, left = driven_to(stage, SMALL, SEED), driven_to(stage, SMALL, SEED)
    ended.end()
    left.be_away()
    for driver in (ended, left):
        with pytest.raises(InvalidTransition):
            Driver.resumed(SMALL, SEED, driver.world)


@pytest.mark.parametrize("stage", [stage for stage in Stage if stage not in CAN_BE_RESUMED])
def test_elsewhere_it_cannot_go_on(stage: Stage) -> None:
    driver = driven_to(stage, SMALL, SEED)
    with pytest.raises(InvalidTransition):
        driver.send(happened.SessionResumed(at_ms=driver.now, embodiment=EmbodimentName.AVATAR))


@pytest.mark.parametrize("stage", [Stage.INTRODUCTION, Stage.PRACTICE, Stage.RESULT, Stage.THANKS])
def test_what_was_forgotten_cannot_be_gone_on_with(stage: Stage) -> None:
    driver = driven_to(Stage.CONSENT, SMALL, SEED)
    driver.decline()
    driver.to(stage)
    with pytest.raises(InvalidTransition):
        driver.send(happened.SessionResumed(at_ms=driver.now, embodiment=EmbodimentName.AVATAR))


def test_a_session_can_be_cut_off_more_than_once() -> None:
    past = driven_to(Stage.PRACTICE, SMALL, SEED).world
    for _ in range(3):
        past = Driver.resumed(SMALL, SEED, past).world
    driver = Driver.resumed(SMALL, SEED, past)
    driver.to(Stage.OVER)
    assert driver.view.ended is Status.COMPLETED
    assert len([event for event in driver.world if isinstance(event, happened.SessionResumed)]) == 4
    assert replay(SMALL, SEED, driver.world) == [step.outcome for step in driver.steps]
