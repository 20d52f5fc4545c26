"""What became of the sentences of a sitting."""

from __future__ import annotations

from kiosk.study import events as happened
from kiosk.study.after.utterances import Utterances, body_changes, utterances
from kiosk.study.events import BodyName, Stage
from tests.samples import whole
from tests.study.driver import Driver, Voice, with_memory


def asked(number: int) -> happened.Event:
    """A sentence is to be said."""
    return happened.SentenceRequested(at_ms=0, utterance=number, sentence="x")


def finished(number: int) -> happened.Event:
    """A sentence was said to its end."""
    return happened.SpeechFinished(at_ms=0, utterance=number)


LOST = happened.RobotLost(at_ms=0, why="x")


def test_sentences_are_counted_by_what_became_of_them() -> None:
    events = [
        *(asked(1), happened.SpeechStarted(at_ms=0, utterance=1), happened.SpeechFinished(at_ms=0, utterance=1)),
        *(asked(2), happened.RobotLost(at_ms=0, why="x"), happened.SpeechFinished(at_ms=0, utterance=2)),
        *(asked(3), happened.SpeechFailed(at_ms=0, utterance=3, why="x")),
        asked(4),
    ]
    assert utterances(events) == Utterances(requested=4, finished=2, failed=2, shown_only=2)
    assert utterances([]) == Utterances(0, 0, 0, 0)


def test_a_sentence_that_is_said_again_counts_again() -> None:
    again = happened.SentenceRepeated(at_ms=0, of=1, utterance=2)
    assert utterances([asked(1), finished(1), again]) == Utterances(2, 1, 0, 1)
    assert utterances([asked(1), finished(1), again, finished(2)]) == Utterances(2, 2, 0, 0)


def test_what_was_cut_short_before_the_robot_was_lost_did_not_fail() -> None:
    entered = happened.StageEntered(at_ms=0, stage=Stage.QUESTIONS)
    assert utterances([asked(1), entered, LOST]) == Utterances(1, 0, 0, 1)
    assert utterances([entered, asked(1), LOST]) == Utterances(1, 0, 1, 1)
    assert utterances([asked(1), happened.BoardOpened(at_ms=0), LOST]) == Utterances(1, 0, 0, 1)


def test_changes_of_the_body_are_counted() -> None:
    changed = happened.BodyChanged(at_ms=0, body=BodyName.AVATAR, why="x")
    assert (body_changes([]), body_changes([LOST, changed, changed])) == (0, 2)


def test_in_a_whole_sitting_every_sentence_is_heard_or_read() -> None:
    for voice in Voice:
        driver = Driver(whole(), 4, voice)
        driver.whole_sitting(with_memory(1))
        counted = utterances(driver.events)
        assert counted.requested == counted.finished + counted.shown_only
        assert (counted.finished > 0) is (voice is Voice.SPEAKS)
