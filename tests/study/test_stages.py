"""The course of a sitting is a table: what a stage does not list is refused, and then nothing has changed."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from kiosk.game import Position
from kiosk.study import events as happened
from kiosk.study.events import Stage, Timer, WorldEvent
from kiosk.study.stages import TABLE, UnexpectedEvent, next_stage
from tests.samples import CLOSING, plan
from tests.study.driver import Driver, Step, with_memory

EXAMPLES: dict[type[WorldEvent], WorldEvent] = {
    type(event): event
    for event in (
        happened.StartTapped(at_ms=9),
        happened.ContinueTapped(at_ms=9),
        happened.CardTapped(at_ms=9, position=Position(0, 0)),
        happened.AnswerGiven(at_ms=9, item=CLOSING.items[0].id, value=1),
        happened.StillHereTapped(at_ms=9),
        happened.TimerEnded(at_ms=9, timer=Timer.IDLE),
        happened.SpeechStarted(at_ms=9, utterance=1),
        happened.SpeechFinished(at_ms=9, utterance=1),
        happened.SpeechFailed(at_ms=9, utterance=1, why="no sound"),
        happened.RobotLost(at_ms=9, why="the plug"),
        happened.KioskClosed(at_ms=9),
    )
}
"""An event of every kind that comes from outside."""

ANYWHERE = {"TimerEnded", "SpeechStarted", "SpeechFinished", "SpeechFailed", "RobotLost", "KioskClosed"}
EXPECTED = {
    Stage.ATTRACT: {"StartTapped"},
    Stage.INTRODUCTION: {"ContinueTapped"} | ANYWHERE,
    Stage.GAME: {"CardTapped"} | ANYWHERE,
    Stage.RESULT: {"ContinueTapped"} | ANYWHERE,
    Stage.QUESTIONS: {"ContinueTapped", "AnswerGiven"} | ANYWHERE,
    Stage.OVER: set[str](),
}
"""What each stage takes, as long as nobody was asked whether they are still there."""


def driven_to(stage: Stage) -> Driver:
    """A sitting that has just reached this stage."""
    driver = Driver(plan(), 5)
    ways: list[Callable[[], object]] = [
        driver.start,
        driver.go_on,
        lambda: driver.play(with_memory(1)),
        driver.go_on,
        driver.questions,
    ]
    for reached, way in zip(list(Stage)[1:], ways, strict=True):
        if driver.stage is stage:
            break
        way()
        assert driver.stage is reached
    return driver


def finished(driver: Driver) -> list[Step]:
    """Every step of this sitting, from here on to its end."""
    remaining: dict[Stage, Callable[[], object]] = {
        Stage.ATTRACT: driver.start,
        Stage.INTRODUCTION: driver.go_on,
        Stage.GAME: lambda: driver.play(with_memory(1)),
        Stage.RESULT: driver.go_on,
        Stage.QUESTIONS: driver.questions,
    }
    while driver.stage in remaining:
        remaining[driver.stage]()
    return driver.steps


def test_there_is_an_example_of_every_event_from_outside() -> None:
    assert set(EXAMPLES) == set(WorldEvent.__subclasses__())


@pytest.mark.parametrize("stage", Stage)
@pytest.mark.parametrize("kind", EXAMPLES, ids=lambda kind: str(kind.__name__))
def test_a_stage_takes_what_it_has_a_place_for_and_refuses_the_rest(stage: Stage, kind: type[WorldEvent]) -> None:
    driver, twin = driven_to(stage), driven_to(stage)
    event = EXAMPLES[kind]
    if kind.__name__ in EXPECTED[stage]:
        driver.send(event)
        return
    with pytest.raises(UnexpectedEvent) as refused:
        driver.send(event)
    assert str(refused.value) == f"{kind.__name__} has no place in the stage {stage.value}"
    assert (refused.value.stage, refused.value.event) == (stage, event)
    assert driver.stage is stage
    assert finished(driver) == finished(twin)


@pytest.mark.parametrize("stage", list(Stage)[1:-1])
def test_being_still_there_has_a_place_only_when_it_was_asked(stage: Stage) -> None:
    driver = driven_to(stage)
    while not driver.view.still_there:
        driver.wait()
    assert driver.stage is stage
    driver.send(happened.StillHereTapped(at_ms=driver.now))
    with pytest.raises(UnexpectedEvent):
        driver.send(happened.StillHereTapped(at_ms=driver.now))


@pytest.mark.parametrize("stage", list(Stage)[1:-1])
@pytest.mark.parametrize("timer", Timer)
def test_a_wait_ends_only_if_it_was_asked_for(stage: Stage, timer: Timer) -> None:
    driver, twin = driven_to(stage), driven_to(stage)
    event = happened.TimerEnded(at_ms=driver.now, timer=timer)
    if timer in driver.running:
        driver.send(event)
        return
    with pytest.raises(UnexpectedEvent):
        driver.send(event)
    assert finished(driver) == finished(twin)


def test_a_wait_ends_only_once() -> None:
    driver = driven_to(Stage.GAME)
    driver.send(happened.TimerEnded(at_ms=driver.now, timer=Timer.IDLE))
    with pytest.raises(UnexpectedEvent):
        driver.send(happened.TimerEnded(at_ms=driver.now, timer=Timer.IDLE))


@pytest.mark.parametrize(("item", "value"), [("helped", 1), ("enjoyed", 0), ("enjoyed", 6), ("enjoyed", -1), ("", 1)])
def test_an_answer_fits_the_question_that_is_asked(item: str, value: int) -> None:
    driver, twin = driven_to(Stage.QUESTIONS), driven_to(Stage.QUESTIONS)
    with pytest.raises(UnexpectedEvent):
        driver.answer(value, item)
    assert finished(driver) == finished(twin)


def test_no_stage_is_left_but_by_the_table() -> None:
    ways = {
        (stage.value, event.__name__, after.value)
        for stage, row in TABLE.items()
        for event, after in row.items()
        if after is not stage
    }
    underway = ("introduction", "game", "result", "questions")
    assert ways == {
        ("attract", "StartTapped", "introduction"),
        ("introduction", "ContinueTapped", "game"),
        ("game", "GameFinished", "result"),
        ("result", "ContinueTapped", "questions"),
        ("questions", "QuestionsFinished", "over"),
        *((stage, "VisitorLeft", "over") for stage in underway),
        *((stage, "KioskClosed", "over") for stage in underway),
    }


def test_the_table_has_a_row_for_every_stage_and_cannot_be_changed() -> None:
    assert set(TABLE) == set(Stage)
    for row in (TABLE, *TABLE.values()):
        with pytest.raises(TypeError):
            row[Stage.OVER] = {}  # type: ignore[index]


def test_what_a_stage_does_not_list_leads_nowhere() -> None:
    assert next_stage(Stage.GAME, happened.BoardOpened(at_ms=1)) is Stage.GAME
    assert next_stage(Stage.GAME, happened.VisitorLeft(at_ms=1)) is Stage.OVER
