"""The course of a sitting as one table, stage x event -> stage; there is no other way from one stage to the next.

World events that a stage does not list are refused. Session events that it does not list change no stage.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from kiosk.study.events import (
    AnswerGiven,
    CardTapped,
    ContinueTapped,
    Event,
    GameFinished,
    KioskClosed,
    QuestionsFinished,
    RobotLost,
    SpeechFailed,
    SpeechFinished,
    SpeechStarted,
    Stage,
    StartTapped,
    StillHereTapped,
    TimerEnded,
    VisitorLeft,
    WorldEvent,
)


class UnexpectedEvent(Exception):
    """A world event that the stage has no place for; the session is as it was."""

    def __init__(self, stage: Stage, event: WorldEvent) -> None:
        """Name both."""
        super().__init__(f"{type(event).__name__} has no place in the stage {stage.value}")
        self.stage = stage
        self.event = event


def _underway(stage: Stage, own: Mapping[type[Event], Stage]) -> Mapping[type[Event], Stage]:
    """A stage's own events, and those that may come in any stage that a visitor is in."""
    anywhere = (TimerEnded, SpeechStarted, SpeechFinished, SpeechFailed, RobotLost, StillHereTapped)
    leaving = (VisitorLeft, KioskClosed)
    return MappingProxyType(dict.fromkeys(anywhere, stage) | dict.fromkeys(leaving, Stage.OVER) | dict(own))


TABLE: Mapping[Stage, Mapping[type[Event], Stage]] = MappingProxyType(
    {
        Stage.ATTRACT: MappingProxyType({StartTapped: Stage.INTRODUCTION}),
        Stage.INTRODUCTION: _underway(Stage.INTRODUCTION, {ContinueTapped: Stage.GAME}),
        Stage.GAME: _underway(Stage.GAME, {CardTapped: Stage.GAME, GameFinished: Stage.RESULT}),
        Stage.RESULT: _underway(Stage.RESULT, {ContinueTapped: Stage.QUESTIONS}),
        Stage.QUESTIONS: _underway(
            Stage.QUESTIONS,
            {AnswerGiven: Stage.QUESTIONS, ContinueTapped: Stage.QUESTIONS, QuestionsFinished: Stage.OVER},
        ),
        Stage.OVER: MappingProxyType({}),
    }
)


def check_expected(stage: Stage, event: WorldEvent) -> None:
    """Raise UnexpectedEvent if the stage has no place for this event."""
    if type(event) not in TABLE[stage]:
        raise UnexpectedEvent(stage, event)


def next_stage(stage: Stage, event: Event) -> Stage:
    """The stage after this event."""
    return TABLE[stage].get(type(event), stage)


def diagram() -> str:
    """The table as a Mermaid state diagram; what may come in every stage stands in a note."""
    anywhere = frozenset.intersection(*(frozenset(row) for stage, row in TABLE.items() if stage not in _ENDS))
    arrows = [
        f"    {stage.value} --> {after.value}: {kind.__name__}"
        for stage, row in TABLE.items()
        for kind, after in row.items()
        if kind not in anywhere
    ]
    leaving = sorted(kind.__name__ for kind in anywhere if TABLE[Stage.GAME][kind] is Stage.OVER)
    staying = sorted(kind.__name__ for kind in anywhere if TABLE[Stage.GAME][kind] is not Stage.OVER)
    notes = (
        f"    note right of {Stage.GAME.value}",
        f"        in every stage with a visitor: {', '.join(staying)};",
        f"        and to {Stage.OVER.value}: {', '.join(leaving)}",
        "    end note",
    )
    ends = (f"    [*] --> {Stage.ATTRACT.value}", *arrows, f"    {Stage.OVER.value} --> [*]")
    return "\n".join(("stateDiagram-v2", *ends, *notes)) + "\n"


_ENDS = (Stage.ATTRACT, Stage.OVER)
