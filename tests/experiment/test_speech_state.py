"""What is said can be said again, by the same body or by another; losing a robot loses no sentence."""

from __future__ import annotations

import pytest

from kiosk.assistance.policy import ActionSpec, Gate
from kiosk.config import Game
from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.effects import Outcome
from kiosk.experiment.events import Timer
from kiosk.experiment.outcomes import EmbodimentName, Stage, Status
from kiosk.experiment.session_state import SessionState
from kiosk.experiment.transitions import InvalidTransition
from tests.experiment.driver import SPEECH_TIME, Driver, Voice, driven_to, replay, with_memory
from tests.experiment.table import a_pair
from tests.samples import always, plan, whole


def lose(driver: Driver) -> Outcome:
    """Lose the robot now."""
    return driver.send(happened.RobotDisconnected(at_ms=driver.now, why="the plug"))


def hinted(voice: Voice = Voice.SPEAKS) -> Driver:
    """Return a game that begins with a hint."""
    driver = Driver(plan(policy=always(ActionSpec.SUG_CARD)), voice=voice)
    driver.to_the_game()
    return driver


def test_the_avatar_says_at_once_what_the_robot_had_not_said() -> None:
    driver = hinted()
    hint = driver.noted(happened.HintGiven)[-1]
    said = next(effect for effect in reversed(driver.effects) if isinstance(effect, do.Speak))
    assert (said.utterance, said.sentence) == (hint.utterance, hint.sentence)
    assert said.advice
    outcome = lose(driver)
    assert outcome == Outcome(
        (happened.EmbodimentChanged(at_ms=driver.now, embodiment=EmbodimentName.AVATAR, why="the plug"),),
        (do.SwitchEmbodiment(EmbodimentName.AVATAR), said),
    )


def test_what_was_said_already_is_not_said_again() -> None:
    driver = hinted()
    driver.wait_until_open()
    assert not [command for command in lose(driver).effects if isinstance(command, do.Speak)]


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
    with pytest.raises(InvalidTransition):
        lose(driver)


@pytest.mark.parametrize("lost_in", list(Stage)[1:-1])
def test_a_session_that_loses_its_robot_goes_on_to_its_end_and_can_be_replayed(lost_in: Stage) -> None:
    driver = driven_to(lost_in, seed=3)
    lose(driver)
    driver.to(Stage.OVER)
    assert driver.view.ended is Status.COMPLETED
    assert len(SessionState.from_events(driver.events).embodiment_changes) == 1
    assert replay(driver.plan, 3, driver.world) == [step.outcome for step in driver.steps]


def test_the_course_of_the_game_is_the_same_with_and_without_the_loss() -> None:
    lost, kept = hinted(), hinted()
    lose(lost)
    for driver in (lost, kept):
        driver.play(with_memory(2))
    assert lost.noted(happened.CardFlipped) == kept.noted(happened.CardFlipped)


def test_every_sentence_is_recorded_when_it_is_requested() -> None:
    driver = Driver(whole())
    driver.whole_session(with_memory(1))
    spoken = [command for command in driver.effects if isinstance(command, do.Speak)]
    recorded = {
        event.utterance: event.sentence
        for event in driver.events
        if isinstance(event, happened.HintGiven | happened.SentenceRequested)
    }
    assert recorded == {command.utterance: command.sentence for command in spoken}


def test_a_robot_that_is_lost_after_a_stage_was_left_says_nothing_of_that_stage_again() -> None:
    driver = driven_to(Stage.INTRODUCTION, voice=Voice.IS_SILENT)
    driver.do_what_is_asked()
    driver.skip()
    assert driver.stage is Stage.GAME
    said_before = {event.utterance for event in driver.noted(happened.SentenceRequested)}
    again = [command.utterance for command in lose(driver).effects if isinstance(command, do.Speak)]
    assert not said_before & set(again)


def test_silence_is_recorded_and_changes_nothing_of_what_is_said() -> None:
    quiet, heard = hinted(), hinted()
    assert quiet.send(happened.MuteChanged(at_ms=quiet.now, muted=True)) == Outcome((), ())
    for driver in (quiet, heard):
        driver.play(with_memory(2))
    assert quiet.noted(happened.HintGiven) == heard.noted(happened.HintGiven)


# Once more

SPEAKING = [Stage.INTRODUCTION, Stage.PRACTICE, Stage.GAME, Stage.RESULT, Stage.THANKS]
"""The stages in which something is said; a game begins with a hint here."""

HELPFUL = whole(policy=always(ActionSpec.SUG_CARD), game=Game(rows=2, columns=3))


def said(stage: Stage) -> Driver:
    """Return a session in which a stage's first sentence has just been said to its end."""
    driver = driven_to(stage, HELPFUL)
    number = driver.view.speaking
    while not (isinstance(driver.world[-1], happened.SpeechFinished) and driver.world[-1].utterance == number):
        driver.wait()
    return driver


@pytest.mark.parametrize("stage", SPEAKING)
def test_the_last_sentence_is_said_again_under_a_new_number(stage: Stage) -> None:
    driver = said(stage)
    last = next(command for command in reversed(driver.effects) if isinstance(command, do.Speak))
    outcome = driver.repeat()
    assert outcome == Outcome(
        (happened.SentenceRepeated(at_ms=driver.now, of=last.utterance, utterance=last.utterance + 1),),
        (do.Speak(last.utterance + 1, last.sentence, last.advice),),
    )


def test_it_can_be_said_again_as_often_as_it_was_said_to_its_end() -> None:
    driver = said(Stage.INTRODUCTION)
    for number in (2, 3, 4):
        driver.repeat()
        assert driver.noted(happened.SentenceRepeated)[-1].utterance == number
        driver.spend(SPEECH_TIME)
    assert [event.of for event in driver.noted(happened.SentenceRepeated)] == [1, 2, 3]


def test_the_numbers_go_on_after_what_was_said_again() -> None:
    driver = said(Stage.INTRODUCTION)
    driver.repeat()
    driver.go_on()
    assert driver.noted(happened.SentenceRequested)[-1].utterance == 3


@pytest.mark.parametrize("stage", SPEAKING)
def test_while_somebody_speaks_nothing_is_said_again(stage: Stage) -> None:
    driver = driven_to(stage, HELPFUL)
    with pytest.raises(InvalidTransition):
        driver.repeat()
    driver.spend(SPEECH_TIME)
    driver.repeat()
    with pytest.raises(InvalidTransition):
        driver.repeat()


@pytest.mark.parametrize("stage", [stage for stage in list(Stage)[1:-1] if stage not in SPEAKING])
def test_where_nothing_was_said_nothing_is_said_again(stage: Stage) -> None:
    driver = driven_to(stage)
    driver.spend(SPEECH_TIME)
    with pytest.raises(InvalidTransition):
        driver.repeat()


def test_what_failed_can_be_said_again() -> None:
    driver = driven_to(Stage.INTRODUCTION, voice=Voice.FAILS)
    driver.wait()
    driver.repeat()
    assert driver.view.speaking == 2


def test_a_hint_that_is_said_again_holds_nobody_up_and_is_not_marked_again() -> None:
    driver = said(Stage.GAME)
    marks = driver.noted(happened.HintHighlighted)
    driver.repeat()
    assert driver.view.held is None
    driver.spend(SPEECH_TIME)
    assert driver.noted(happened.HintHighlighted) == marks
    assert len(driver.noted(happened.BoardUnlocked)) == 1


def test_a_hint_that_is_said_again_falls_silent_with_its_flip() -> None:
    driver = said(Stage.GAME)
    driver.repeat()
    hint = driver.view.bubble
    outcome = driver.tap(driver.view.closed[0])
    assert outcome.effects.index(do.StopSpeaking()) < outcome.effects.index(do.ClearBubble())
    assert driver.view.bubble != hint


def test_after_its_flip_a_hint_is_not_said_again() -> None:
    gate = Gate(opening=0, patience=99, first_patience=99)
    driver = driven_to(Stage.GAME, plan(policy=always(ActionSpec.SUG_CARD, gate)))
    first, _ = a_pair(driver)
    driver.flip(first)
    driver.wait_until_open()
    driver.flip(driver.view.closed[0])
    driver.wait_until_open()
    assert driver.view.bubble is None
    with pytest.raises(InvalidTransition):
        driver.repeat()


def test_the_avatar_goes_on_with_what_the_robot_was_saying_again() -> None:
    driver = said(Stage.GAME)
    driver.repeat()
    again = driver.noted(happened.SentenceRepeated)[0].utterance
    repeated = next(effect for effect in reversed(driver.effects) if isinstance(effect, do.Speak))
    assert (repeated.utterance, repeated.sentence) == (again, driver.view.bubble)
    assert lose(driver).effects[-1] == repeated
