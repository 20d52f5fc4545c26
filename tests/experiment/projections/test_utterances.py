"""What became of the sentences of a session."""

from __future__ import annotations

from kiosk.experiment import events as happened
from kiosk.experiment.events import EmbodimentName, Stage
from kiosk.experiment.projections import SpeechCounts, count_embodiment_changes, count_speech
from tests.experiment.driver import Driver, Voice, with_memory
from tests.samples import whole


def asked(number: int) -> happened.Event:
    """A sentence is to be said."""
    return happened.SentenceRequested(at_ms=0, utterance=number, sentence="x")


def finished(number: int) -> happened.Event:
    """A sentence was said to its end."""
    return happened.SpeechFinished(at_ms=0, utterance=number)


LOST = happened.RobotDisconnected(at_ms=0, why="x")


def test_sentences_are_counted_by_what_became_of_them() -> None:
    events = [
        *(asked(1), happened.SpeechStarted(at_ms=0, utterance=1), happened.SpeechFinished(at_ms=0, utterance=1)),
        *(asked(2), happened.RobotDisconnected(at_ms=0, why="x"), happened.SpeechFinished(at_ms=0, utterance=2)),
        *(asked(3), happened.SpeechFailed(at_ms=0, utterance=3, why="x")),
        asked(4),
    ]
    assert count_speech(events) == SpeechCounts(requested=4, finished=2, failed=2, shown_only=2)
    assert count_speech([]) == SpeechCounts(0, 0, 0, 0)


def test_a_sentence_that_is_said_again_counts_again() -> None:
    again = happened.SentenceRepeated(at_ms=0, of=1, utterance=2)
    assert count_speech([asked(1), finished(1), again]) == SpeechCounts(2, 1, 0, 1)
    assert count_speech([asked(1), finished(1), again, finished(2)]) == SpeechCounts(2, 2, 0, 0)


def test_what_was_cut_short_before_the_robot_was_lost_did_not_fail() -> None:
    entered = happened.StageEntered(at_ms=0, stage=Stage.QUESTIONS)
    assert count_speech([asked(1), entered, LOST]) == SpeechCounts(1, 0, 0, 1)
    assert count_speech([entered, asked(1), LOST]) == SpeechCounts(1, 0, 1, 1)
    assert count_speech([asked(1), happened.BoardUnlocked(at_ms=0), LOST]) == SpeechCounts(1, 0, 0, 1)


def test_changes_of_the_body_are_counted() -> None:
    changed = happened.EmbodimentChanged(at_ms=0, body=EmbodimentName.AVATAR, why="x")
    assert (count_embodiment_changes([]), count_embodiment_changes([LOST, changed, changed])) == (0, 2)


def test_in_a_whole_session_every_sentence_is_heard_or_read() -> None:
    for voice in Voice:
        driver = Driver(whole(), 4, voice)
        driver.whole_session(with_memory(1))
        counted = count_speech(driver.events)
        assert counted.requested == counted.finished + counted.shown_only
        assert (counted.finished > 0) is (voice is Voice.SPEAKS)
