"""A robot that is lost costs nobody anything: the avatar says the same sentence, and the data say so."""

from __future__ import annotations

import pytest

from kiosk.assistant.mdp import Action
from kiosk.study import commands as do
from kiosk.study import events as happened
from kiosk.study.after.utterances import Utterances, body_changes, utterances
from kiosk.study.events import BodyName, Stage, Status, Timer
from kiosk.study.stages import UnexpectedEvent
from tests.samples import always, plan
from tests.study.driver import Driver, Voice, replay, with_memory


def lose(driver: Driver) -> tuple[do.Command, ...]:
    """The robot is lost now."""
    return driver.send(happened.RobotLost(at_ms=driver.now, why="the plug"))


def hinted(voice: Voice = Voice.SPEAKS) -> Driver:
    """A game that begins with a hint."""
    driver = Driver(plan(policy=always(Action.SUG_CARD)), voice=voice)
    driver.to_the_game()
    return driver


def test_the_avatar_says_at_once_what_the_robot_had_not_said() -> None:
    driver = hinted()
    hint = driver.noted(happened.HintGiven)[-1]
    commands = lose(driver)
    assert commands == (
        do.Record(happened.BodyChanged(at_ms=driver.now, body=BodyName.AVATAR, why="the plug")),
        do.ChangeBody(BodyName.AVATAR),
        do.Speak(hint.utterance, hint.sentence),
    )


def test_what_was_said_already_is_not_said_again() -> None:
    driver = hinted()
    driver.wait_until_open()
    assert not [command for command in lose(driver) if isinstance(command, do.Speak)]


def test_the_board_opens_when_the_sentence_was_due_whoever_said_it() -> None:
    driver = hinted(Voice.IS_SILENT)
    until = driver.running[Timer.SPEECH_DEADLINE]
    driver.spend(1000)
    lose(driver)
    assert driver.running[Timer.SPEECH_DEADLINE] == until
    driver.wait_until_open()
    assert driver.now == until


def test_a_robot_can_be_lost_once() -> None:
    driver = hinted()
    lose(driver)
    with pytest.raises(UnexpectedEvent):
        lose(driver)


@pytest.mark.parametrize("stage", [Stage.INTRODUCTION, Stage.GAME, Stage.RESULT, Stage.QUESTIONS])
def test_a_sitting_that_loses_its_robot_goes_on_to_its_end_and_can_be_replayed(stage: Stage) -> None:
    driver = Driver(plan(), 3)
    ways = {
        Stage.INTRODUCTION: driver.start,
        Stage.GAME: driver.go_on,
        Stage.RESULT: lambda: driver.play(with_memory(1)),
        Stage.QUESTIONS: driver.go_on,
        Stage.OVER: driver.questions,
    }
    for reached, way in ways.items():
        way()
        if reached is stage:
            lose(driver)
    assert driver.view.ended is Status.COMPLETED
    assert body_changes(driver.events) == 1
    assert replay(driver.plan, 3, driver.world) == [step.commands for step in driver.steps]


def test_the_course_of_the_game_is_the_same_with_and_without_the_loss() -> None:
    lost, kept = hinted(), hinted()
    lose(lost)
    for driver in (lost, kept):
        driver.play(with_memory(2))
    assert lost.noted(happened.CardFlipped) == kept.noted(happened.CardFlipped)


def test_every_sentence_is_recorded_when_it_is_requested() -> None:
    driver = Driver(plan())
    driver.whole_sitting(with_memory(1))
    spoken = [command for command in driver.commands if isinstance(command, do.Speak)]
    recorded = {
        event.utterance: event.sentence
        for event in driver.events
        if isinstance(event, happened.HintGiven | happened.SentenceRequested)
    }
    assert recorded == {command.utterance: command.sentence for command in spoken}


def test_sentences_are_counted_by_what_became_of_them() -> None:
    def asked(number: int) -> happened.Event:
        return happened.SentenceRequested(at_ms=0, utterance=number, sentence="x")

    events = [
        *(asked(1), happened.SpeechStarted(at_ms=0, utterance=1), happened.SpeechFinished(at_ms=0, utterance=1)),
        *(asked(2), happened.RobotLost(at_ms=0, why="x"), happened.SpeechFinished(at_ms=0, utterance=2)),
        *(asked(3), happened.SpeechFailed(at_ms=0, utterance=3, why="x")),
        asked(4),
    ]
    assert utterances(events) == Utterances(requested=4, finished=2, failed=2, shown_only=2)
    assert utterances([]) == Utterances(0, 0, 0, 0)
