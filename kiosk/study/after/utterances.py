"""What became of the sentences of a sitting, from its events and nothing else."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from kiosk.study.events import (
    BoardOpened,
    BodyChanged,
    Event,
    HintGiven,
    RobotLost,
    SentenceRepeated,
    SentenceRequested,
    SpeechFailed,
    SpeechFinished,
    StageEntered,
)


@dataclass(frozen=True)
class Utterances:
    """How many sentences were asked for, and what the bodies made of them.

    Every sentence is either ``finished``, heard to its end, or ``shown_only``, left to be read in the bubble because
    its voice failed, or was cut short when the visitor or a deadline went on. ``failed`` counts those that some body
    failed to say; the avatar may still have finished them.
    """

    requested: int
    finished: int
    failed: int
    shown_only: int


def utterances(events: Iterable[Event]) -> Utterances:
    """Count the sentences of one sitting."""
    requested: set[int] = set()
    finished: set[int] = set()
    failed: set[int] = set()
    under_way: int | None = None
    for event in events:
        match event:
            case HintGiven(utterance=number) | SentenceRequested(utterance=number) | SentenceRepeated(utterance=number):
                requested.add(number)
                under_way = number
            case StageEntered() | BoardOpened():
                under_way = None
            case SpeechFinished(utterance=number):
                finished.add(number)
                under_way = None
            case SpeechFailed(utterance=number):
                failed.add(number)
            case RobotLost() if under_way is not None:
                failed.add(under_way)
    return Utterances(len(requested), len(finished), len(failed), len(requested - finished))


def body_changes(events: Iterable[Event]) -> int:
    """How often another body had to help."""
    return sum(isinstance(event, BodyChanged) for event in events)
