"""What happened in a sitting, in the past tense; every event is written before its effect is shown.

World events come from outside and are what ``Session.handle`` takes. Session events are what the session concluded;
they follow from the world events, and are recorded beside them so that nobody needs the program to read the data.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from functools import partial
from typing import Any, ClassVar

from cattrs import BaseValidationError, Converter, transform_error
from cattrs.strategies import configure_tagged_union, include_subclasses

from kiosk.assistant.gate import Verdict
from kiosk.assistant.hint import Reason
from kiosk.assistant.mdp import Action, Card, Outcome, Phase
from kiosk.game import Position, Refusal


class Stage(Enum):
    """A part of the sitting."""

    ATTRACT = "attract"
    INTRODUCTION = "introduction"
    GAME = "game"
    RESULT = "result"
    QUESTIONS = "questions"
    OVER = "over"


class Timer(Enum):
    """Something that a sitting waits for; one that is started while it runs starts anew."""

    TURN_BACK = "turn_back"
    MARK = "mark"
    READING = "reading"
    SPEECH_DEADLINE = "speech_deadline"
    MOOD = "mood"
    FINISH = "finish"
    IDLE = "idle"
    STILL_THERE = "still_there"


class Status(Enum):
    """How a sitting ended."""

    COMPLETED = "completed"
    ABANDONED = "abandoned"
    INTERRUPTED = "interrupted"


class BodyName(Enum):
    """Who helps with voice and face."""

    AVATAR = "avatar"
    FURHAT = "furhat"
    FURHAT_REALTIME = "furhat-realtime"


@dataclass(frozen=True, kw_only=True)
class Event:
    """Anything that happened, ``at_ms`` milliseconds after the sitting's first event."""

    at_ms: int


@dataclass(frozen=True, kw_only=True)
class WorldEvent(Event):
    """Something that came from outside."""

    by_visitor: ClassVar[bool] = False
    """Whether it shows that somebody is there."""


@dataclass(frozen=True, kw_only=True)
class StartTapped(WorldEvent):
    """The visitor began; the sitting exists from here."""

    by_visitor = True


@dataclass(frozen=True, kw_only=True)
class ContinueTapped(WorldEvent):
    """The visitor goes on to what comes next."""

    by_visitor = True


@dataclass(frozen=True, kw_only=True)
class CardTapped(WorldEvent):
    """The visitor tapped a card, whether or not it could be turned."""

    by_visitor = True
    position: Position


@dataclass(frozen=True, kw_only=True)
class AnswerGiven(WorldEvent):
    """The visitor chose an answer, from 1; the last one given to an item counts."""

    by_visitor = True
    item: str
    value: int


@dataclass(frozen=True, kw_only=True)
class StillHereTapped(WorldEvent):
    """The visitor is still there."""

    by_visitor = True


@dataclass(frozen=True, kw_only=True)
class TimerEnded(WorldEvent):
    """A wait that the session asked for is over."""

    timer: Timer


@dataclass(frozen=True, kw_only=True)
class SpeechStarted(WorldEvent):
    """The body began to say a sentence."""

    utterance: int


@dataclass(frozen=True, kw_only=True)
class SpeechFinished(WorldEvent):
    """The body has said the sentence to its end."""

    utterance: int


@dataclass(frozen=True, kw_only=True)
class SpeechFailed(WorldEvent):
    """The sentence will not be heard, or not to its end; it stays on the screen to be read."""

    utterance: int
    why: str


@dataclass(frozen=True, kw_only=True)
class RobotLost(WorldEvent):
    """The robot that was helping cannot be counted on any more in this sitting."""

    why: str


@dataclass(frozen=True, kw_only=True)
class KioskClosed(WorldEvent):
    """The program is being closed in the middle of a sitting."""


@dataclass(frozen=True, kw_only=True)
class SessionEvent(Event):
    """Something that the session concluded."""


@dataclass(frozen=True, kw_only=True)
class StageEntered(SessionEvent):
    """The sitting went on to another stage."""

    stage: Stage


@dataclass(frozen=True, kw_only=True)
class SentenceRequested(SessionEvent):
    """The body was asked to say a sentence that is no hint; a hint's sentence stands in HintGiven."""

    utterance: int
    sentence: str


@dataclass(frozen=True, kw_only=True)
class BodyChanged(SessionEvent):
    """Another body helps from here on; the one at the start stands with the sitting."""

    body: BodyName
    why: str


@dataclass(frozen=True, kw_only=True)
class BoardDealt(SessionEvent):
    """A game began: the cards by name, row by row."""

    rows: int
    columns: int
    cards: tuple[str, ...]


@dataclass(frozen=True, kw_only=True)
class AssistanceDecided(SessionEvent):
    """Before flip number ``flip`` (from 1): what the two layers saw and how much help they chose."""

    flip: int
    card: Card
    game: Phase
    last: Action
    outcome: Outcome
    gate: Verdict
    action: Action


@dataclass(frozen=True, kw_only=True)
class HintGiven(SessionEvent):
    """A hint for flip number ``flip``; ``row`` and ``column`` are what it gave away, from 0, None where it did not."""

    flip: int
    card: Card
    action: Action
    target: Position
    name: str
    seen: int
    mate_seen: int
    reason: Reason
    row: int | None
    column: int | None
    sentence: str
    utterance: int


@dataclass(frozen=True, kw_only=True)
class HintMarked(SessionEvent):
    """The hint's card, row or column was marked on the board."""

    flip: int


@dataclass(frozen=True, kw_only=True)
class BoardOpened(SessionEvent):
    """Cards may be tapped again after a hint; from HintGiven until here the clock without speech stands still."""


@dataclass(frozen=True, kw_only=True)
class TapIgnored(SessionEvent):
    """A card was tapped that could not be turned."""

    position: Position
    why: Refusal | None
    """The rule that forbids it; None while the assistant speaks."""


@dataclass(frozen=True, kw_only=True)
class CardFlipped(SessionEvent):
    """A card was turned up; ``matched`` is None for the first card of a move; numbers count from 1."""

    number: int
    move: int
    position: Position
    card: str
    matched: bool | None


@dataclass(frozen=True, kw_only=True)
class TableAdapted(SessionEvent):
    """The table that went on learning during this game came out of it with this hash; the file is as it was."""

    sha256: str


@dataclass(frozen=True, kw_only=True)
class GameFinished(SessionEvent):
    """Every pair was found and has been looked at."""


@dataclass(frozen=True, kw_only=True)
class QuestionsFinished(SessionEvent):
    """The visitor went past the last question."""


@dataclass(frozen=True, kw_only=True)
class VisitorLeft(SessionEvent):
    """Nobody answered whether they are still there."""


@dataclass(frozen=True, kw_only=True)
class SittingEnded(SessionEvent):
    """The sitting is over; nothing of it follows."""

    status: Status


def _converter() -> Converter:
    """A converter to and from JSON values in which every closed set goes by name."""
    converter = Converter(forbid_extra_keys=True)
    for closed_set in (Action, Phase, Outcome, Verdict):
        # Their values count rows and columns of a table, or explain; in the records they go by name.
        converter.register_unstructure_hook(closed_set, lambda member: member.name.lower())
        converter.register_structure_hook(closed_set, lambda name, enum: enum[name.upper()])
    return converter


_CONVERTER = _converter()
include_subclasses(Event, _CONVERTER, union_strategy=partial(configure_tagged_union, tag_name="type"))


def to_record(event: Event) -> dict[str, Any]:
    """An event as JSON values: its class under ``type``, its fields under their names."""
    record: dict[str, Any] = _CONVERTER.unstructure(event, unstructure_as=Event)
    return record


def from_record(record: Mapping[str, Any]) -> Event:
    """The event that ``to_record`` wrote; raises ValueError, saying where, for anything else."""
    try:
        return _CONVERTER.structure(record, Event)
    except (BaseValidationError, KeyError) as error:
        raise ValueError("; ".join(transform_error(error, path="event"))) from error
