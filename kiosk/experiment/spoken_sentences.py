"""The sentences of a session, read from its events, with every attempt to say them."""

from __future__ import annotations

from enum import Enum

from kiosk.experiment.events import (
    BoardUnlocked,
    CardFlipped,
    EmbodimentChanged,
    Event,
    HintCue,
    HintGiven,
    RemarkGiven,
    RobotDisconnected,
    SentenceRepeated,
    SentenceRequested,
    SessionResumed,
    SpeechCutShort,
    SpeechFailed,
    SpeechFinished,
    SpeechStarted,
    StageEntered,
    Timer,
    TimerExpired,
)
from kiosk.experiment.outcomes import EmbodimentName, Stage
from kiosk.lazy_dataclass import dataclass, with_values

_SPEECH_REQUESTS: frozenset[type[Event]] = frozenset({HintGiven, RemarkGiven, SentenceRequested, SentenceRepeated})
_SPEECH_REPORTS: frozenset[type[Event]] = frozenset({SpeechStarted, SpeechFinished, SpeechFailed, SpeechCutShort})
OF_SPEECH: frozenset[type[Event]] = frozenset(
    {
        *_SPEECH_REQUESTS,
        *_SPEECH_REPORTS,
        *(StageEntered, TimerExpired, BoardUnlocked, CardFlipped),
        *(RobotDisconnected, EmbodimentChanged, SessionResumed),
    }
)
"""The events that change the sentences."""


class SentencePurpose(Enum):
    """What a sentence was for."""

    HINT = "hint"
    REMARK = "remark"
    SPEECH = "speech"
    REPEAT = "repeat"


@dataclass(frozen=True)
class SpeechAttempt:
    """One embodiment's attempt to say a sentence, in ms; what did not happen is None.

    ``embodiment`` is None where it helped from the start and nothing says which one it was. An attempt that neither
    finished nor failed was cut short: the visitor or a deadline went on, or the session ended.
    """

    embodiment: EmbodimentName | None
    at_ms: int
    started_ms: int | None = None
    finished_ms: int | None = None
    failed_ms: int | None = None
    cut_ms: int | None = None
    """When a tap ended it."""
    heard: SpeechStarted | None = None
    """What is known of the voice that said it."""


@dataclass(frozen=True)
class SpokenSentence:
    """A sentence, and every attempt to say it: a robot's that was lost, then the avatar's."""

    utterance: int
    purpose: SentencePurpose
    stage: Stage
    sentence: str
    attempts: tuple[SpeechAttempt, ...]


class SpeechReader:
    """Reads events into sentences; it knows which of them is being said by which body."""

    def __init__(self, embodiment: EmbodimentName | None) -> None:
        self.sentences: dict[int, SpokenSentence] = {}
        self._embodiment = embodiment
        self._hinted_flip: int | None = None
        self._under_way: int | None = None
        self._broken_off: int | None = None
        self._trails: int | None = None
        """A sentence during which cards can be tapped already."""

    def take(self, event: Event, stage: Stage) -> None:
        """Read an event that fell into ``stage``."""
        kind = type(event)
        if kind in _SPEECH_REPORTS:
            self._report(event)
        elif kind in _SPEECH_REQUESTS:
            self._request(event, stage)
        else:
            self._end_or_begin_anew(event)

    def _end_or_begin_anew(self, event: Event) -> None:
        """Take what ends a sentence, or has it said by another body, without a word of the voice."""
        match event:
            case StageEntered() | TimerExpired(timer=Timer.SPEECH_DEADLINE):
                self._under_way = None
            case BoardUnlocked():
                self._trails = self._under_way
            case CardFlipped(number=flip) if flip == self._hinted_flip and self._under_way != self._trails:
                self._under_way = None
            case RobotDisconnected(at_ms=at_ms) if self._under_way is not None:
                self._broken_off = self._under_way
                self._fail(self._under_way, at_ms)
            case EmbodimentChanged(embodiment=embodiment, at_ms=at_ms):
                self._embodiment = embodiment
                self._say_again(at_ms)
            case SessionResumed(embodiment=embodiment):
                self._embodiment = embodiment

    def _request(self, event: Event, stage: Stage) -> None:
        match event:
            case HintGiven(cue=HintCue.GAZE):
                # Nothing is said.
                pass
            case HintGiven(utterance=number, sentence=sentence, flip=flip):
                self._hinted_flip = flip
                self._begin(number, SentencePurpose.HINT, stage, sentence, event.at_ms)
            case RemarkGiven(utterance=number, sentence=sentence, flip=flip):
                self._hinted_flip = flip
                self._begin(number, SentencePurpose.REMARK, stage, sentence, event.at_ms)
            case SentenceRequested(utterance=number, sentence=sentence):
                self._begin(number, SentencePurpose.SPEECH, stage, sentence, event.at_ms)
            case SentenceRepeated(utterance=number, of=before):
                sentence = self.sentences[before].sentence if before in self.sentences else ""
                self._begin(number, SentencePurpose.REPEAT, stage, sentence, event.at_ms)

    def _begin(self, number: int, purpose: SentencePurpose, stage: Stage, sentence: str, at_ms: int) -> None:
        attempts = (SpeechAttempt(self._embodiment, at_ms),)
        self.sentences[number] = SpokenSentence(number, purpose, stage, sentence, attempts)
        self._under_way = number

    def _report(self, event: Event) -> None:
        match event:
            case SpeechStarted(utterance=number, at_ms=at_ms) if number in self.sentences:
                self._set_last(number, with_values(self._last(number), started_ms=at_ms, heard=event))
            case SpeechFinished(utterance=number, at_ms=at_ms) if number in self.sentences:
                self._set_last(number, with_values(self._last(number), finished_ms=at_ms))
                self._stop(number)
            case SpeechFailed(utterance=number, at_ms=at_ms) if number in self.sentences:
                self._fail(number, at_ms)
            case SpeechCutShort(utterance=number, at_ms=at_ms) if number in self.sentences:
                self._set_last(number, with_values(self._last(number), cut_ms=at_ms))
                self._stop(number)

    def _fail(self, number: int, at_ms: int) -> None:
        self._set_last(number, with_values(self._last(number), failed_ms=at_ms))
        self._stop(number)

    def _stop(self, number: int) -> None:
        if self._under_way == number:
            self._under_way = None

    def _last(self, number: int) -> SpeechAttempt:
        return self.sentences[number].attempts[-1]

    def _set_last(self, number: int, attempt: SpeechAttempt) -> None:
        said = self.sentences[number]
        self.sentences[number] = with_values(said, attempts=(*said.attempts[:-1], attempt))

    def _say_again(self, at_ms: int) -> None:
        """Begin anew with the sentence that was broken off, if one was."""
        number, self._broken_off = self._broken_off, None
        if number is not None:
            said = self.sentences[number]
            self.sentences[number] = with_values(
                said, attempts=(*said.attempts, SpeechAttempt(self._embodiment, at_ms))
            )
            self._under_way = number
