"""What became of the sentences of a session, attempt by attempt."""

from __future__ import annotations

from contextlib import suppress
from random import Random

import pytest

from kiosk.assistance.policy import ActionSpec
from kiosk.config import Game
from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.events import Event, Timer
from kiosk.experiment.outcomes import EmbodimentName, Stage
from kiosk.experiment.projections import SpeechCounts, count_speech
from kiosk.experiment.session_state import SessionState
from kiosk.experiment.spoken_sentences import SentencePurpose, SpeechAttempt
from kiosk.experiment.transitions import InvalidTransition
from tests.experiment.driver import Driver, Voice, at_random, driven_to, with_memory
from tests.samples import always, plan, whole

HELPFUL = whole(policy=always(ActionSpec.SUG_ROW), game=Game(rows=2, columns=3))
ROBOT, AVATAR = EmbodimentName.robot("furhat"), EmbodimentName.AVATAR


def asked(number: int, at_ms: int = 0) -> happened.Event:
    """Ask for a sentence."""
    return happened.SentenceRequested(at_ms=at_ms, utterance=number, sentence="x")


def started(number: int, at_ms: int = 0) -> happened.SpeechStarted:
    """Begin to say a sentence."""
    return happened.SpeechStarted(at_ms=at_ms, utterance=number)


def finished(number: int, at_ms: int = 0) -> happened.Event:
    """Finish a sentence."""
    return happened.SpeechFinished(at_ms=at_ms, utterance=number)


def failed(number: int, at_ms: int = 0) -> happened.Event:
    """Fail to say a sentence."""
    return happened.SpeechFailed(at_ms=at_ms, utterance=number, why="x")


def lost(at_ms: int = 0) -> list[happened.Event]:
    """Lose the robot, and let the avatar help from then on."""
    return [
        happened.RobotDisconnected(at_ms=at_ms, why="x"),
        happened.EmbodimentChanged(at_ms=at_ms, embodiment=AVATAR, why="x"),
    ]


def attempts(events: list[Event]) -> list[tuple[SpeechAttempt, ...]]:
    """Return the attempts at every sentence of a session that began with the robot."""
    return [said.attempts for said in SessionState.from_events(events, ROBOT).sentences]


def counted(events: list[Event]) -> SpeechCounts:
    """Return what became of the sentences."""
    return count_speech(SessionState.from_events(events))


def test_a_robot_that_is_lost_in_mid_sentence_failed_to_say_it() -> None:
    ((robot, _),) = attempts([asked(1, 10), started(1, 20), *lost(50)])
    assert robot == SpeechAttempt(ROBOT, 10, started_ms=20, failed_ms=50, heard=started(1, 20))


def test_the_avatar_s_new_beginning_is_an_attempt_of_its_own() -> None:
    events = [asked(1, 10), started(1, 20), *lost(50), started(1, 60), finished(1, 90)]
    assert attempts(events) == [
        (
            SpeechAttempt(ROBOT, 10, started_ms=20, failed_ms=50, heard=started(1, 20)),
            SpeechAttempt(AVATAR, 50, started_ms=60, finished_ms=90, heard=started(1, 60)),
        )
    ]


def test_what_the_robot_had_said_before_it_was_lost_needs_no_second_attempt() -> None:
    for end in (finished(1, 30), failed(1, 30)):
        (said,) = attempts([asked(1, 10), started(1, 20), end, *lost(50)])
        assert len(said) == 1


def test_sentences_after_the_loss_are_the_avatar_s_until_a_robot_goes_on_with_the_session() -> None:
    again = happened.SessionResumed(at_ms=70, embodiment=ROBOT)
    events = [asked(1), finished(1), *lost(50), asked(2, 60), finished(2, 65), again, asked(3, 80)]
    assert [[attempt.embodiment for attempt in said] for said in attempts(events)] == [[ROBOT], [AVATAR], [ROBOT]]


def test_without_the_first_body_s_name_nothing_is_said_of_it() -> None:
    (said,) = SessionState.from_events([asked(1), *lost()]).sentences
    assert [attempt.embodiment for attempt in said.attempts] == [None, AVATAR]


def test_every_sentence_is_told_with_its_stage_and_what_it_was_for() -> None:
    driver = driven_to(Stage.INTRODUCTION)
    driver.spend(60_000)
    driver.repeat()
    first, again = SessionState.from_events(driver.events).sentences
    assert (first.purpose, again.purpose) == (SentencePurpose.SPEECH, SentencePurpose.REPEAT)
    assert first.sentence == again.sentence != ""
    assert {first.stage, again.stage} == {Stage.INTRODUCTION}
    hinted = Driver(plan(policy=always(ActionSpec.SUG_CARD)))
    hinted.to_the_game()
    *_, hint = SessionState.from_events(hinted.events).sentences
    assert (hint.purpose, hint.stage) == (SentencePurpose.HINT, Stage.GAME)
    assert hint.sentence == hinted.noted(happened.HintGiven)[0].sentence


def test_sentences_are_counted_by_what_became_of_them() -> None:
    events = [
        *(asked(1), started(1), finished(1)),
        *(asked(2), *lost(), finished(2)),
        *(asked(3), failed(3)),
        asked(4),
    ]
    assert counted(events) == SpeechCounts(requested=4, finished=2, failed=2, shown_only=2)
    assert counted([]) == SpeechCounts(0, 0, 0, 0)


def test_a_sentence_that_is_said_again_counts_again() -> None:
    again = happened.SentenceRepeated(at_ms=0, of=1, utterance=2)
    assert counted([asked(1), finished(1), again]) == SpeechCounts(2, 1, 0, 1)
    assert counted([asked(1), finished(1), again, finished(2)]) == SpeechCounts(2, 2, 0, 0)


def test_what_was_cut_short_before_the_robot_was_lost_did_not_fail() -> None:
    entered = happened.StageEntered(at_ms=0, stage=Stage.QUESTIONS)
    deadline = happened.TimerExpired(at_ms=0, timer=Timer.SPEECH_DEADLINE)
    assert counted([asked(1), entered, *lost()]) == SpeechCounts(1, 0, 0, 1)
    assert counted([entered, asked(1), *lost()]) == SpeechCounts(1, 0, 1, 1)
    assert counted([asked(1), deadline, *lost()]) == SpeechCounts(1, 0, 0, 1)


def test_a_hint_that_was_being_said_again_when_its_card_was_flipped_did_not_fail() -> None:
    driver = Driver(plan(policy=always(ActionSpec.SUG_CARD)))
    driver.to_the_game()
    driver.wait_until_open()
    driver.repeat()
    driver.tap(driver.view.closed[0])
    again = driver.noted(happened.SentenceRepeated)[0].utterance
    driver.send(happened.RobotDisconnected(at_ms=driver.now, why="x"))
    said = {said.utterance: said for said in SessionState.from_events(driver.events).sentences}
    assert [attempt.failed_ms for attempt in said[again].attempts] == [None]


def test_changes_of_the_body_are_counted() -> None:
    changed = happened.EmbodimentChanged(at_ms=0, embodiment=AVATAR, why="x")
    assert SessionState.from_events([*lost(), changed]).embodiment_changes == (changed, changed)


def test_in_a_whole_session_every_sentence_is_heard_or_read() -> None:
    for voice in Voice:
        driver = Driver(whole(), 4, voice)
        driver.whole_session(with_memory(1))
        counts = counted(driver.events)
        assert counts.requested == counts.finished + counts.shown_only
        assert (counts.finished > 0) is (voice is Voice.SPEAKS)


@pytest.mark.parametrize("voice", Voice)
@pytest.mark.parametrize("seed", range(12))
def test_there_is_an_attempt_for_every_time_that_a_body_was_made_to_speak(seed: int, voice: Voice) -> None:
    """Whatever the session has a body say, with repeats and a robot lost at any moment, the log tells the same."""
    chance = Random(seed)
    driver = Driver(HELPFUL, seed, voice)
    choose = at_random(seed)
    while driver.stage is not Stage.OVER:
        _interfere(driver, chance)
        if driver.stage is Stage.GAME and driver.view.held is None and driver.view.closed:
            driver.tap(choose(driver.view))
        elif driver.stage is Stage.GAME:
            driver.wait()
        else:
            driver.do_what_is_asked()
    made = [
        (command.utterance, step.event.at_ms)
        for step in driver.steps
        for command in step.outcome.effects
        if isinstance(command, do.Speak)
    ]
    told = [
        (said.utterance, attempt.at_ms)
        for said in SessionState.from_events(driver.events).sentences
        for attempt in said.attempts
    ]
    assert sorted(told) == sorted(made)


def _interfere(driver: Driver, chance: Random) -> None:
    """Have a sentence said again, or lose the robot, where that can happen now."""
    repeat = happened.RepeatRequested(at_ms=driver.now)
    loss = happened.RobotDisconnected(at_ms=driver.now, why="x")
    if chance.random() < 0.3:
        with suppress(InvalidTransition):
            driver.send(chance.choice([repeat, loss]))
