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
