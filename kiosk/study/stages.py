"""The course of a sitting as one table, stage x event -> what becomes of the stage; there is no other way on.

Which stages there are, and in which order, is the study's; ``Course`` knows what comes after each. World events that a
stage does not list are refused. Session events that it does not list change no stage.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from types import MappingProxyType

from kiosk import BadInput
from kiosk.settings import STAGES
from kiosk.study.events import (
    AgeTapped,
    AgreeTapped,
    AnswerGiven,
    CardTapped,
    ConsentGiven,
    ContinueTapped,
    DeclineTapped,
    EndAsked,
    Event,
    GameFinished,
    KioskClosed,
    NextAsked,
    PauseAsked,
    PauseEnded,
    PracticeFinished,
    PurposeTicked,
    QuestionsFinished,
    RepeatAsked,
    RobotLost,
    SittingResumed,
    SkipTapped,
    SoundChanged,
    SpeechFailed,
    SpeechFinished,
    SpeechStarted,
    Stage,
    StartTapped,
    StillHereTapped,
    Thanked,
    TimerEnded,
    Typed,
    UserActivity,
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


class Turn(Enum):
    """What an event makes of the stage."""

    STAY = "stay"
    ON = "on"
    """To the next stage of the study."""
    OVER = "over"
    """To the end of the sitting."""


_ANYWHERE = (
    TimerEnded,
    SpeechStarted,
    SpeechFinished,
    SpeechFailed,
    RobotLost,
    StillHereTapped,
    UserActivity,
    RepeatAsked,
    PauseAsked,
    PauseEnded,
    SoundChanged,
    SittingResumed,
)
_LEAVING = (VisitorLeft, EndAsked, KioskClosed)


def _underway(own: Mapping[type[Event], Turn]) -> Mapping[type[Event], Turn]:
    """A stage's own events, and those that may come in any stage that a visitor is in."""
    return MappingProxyType(dict.fromkeys(_ANYWHERE, Turn.STAY) | dict.fromkeys(_LEAVING, Turn.OVER) | dict(own))


_READ: Mapping[type[Event], Turn] = {ContinueTapped: Turn.ON}
_ASK: Mapping[type[Event], Turn] = {
    Typed: Turn.STAY,
    AnswerGiven: Turn.STAY,
    ContinueTapped: Turn.STAY,
    QuestionsFinished: Turn.ON,
}

TABLE: Mapping[Stage, Mapping[type[Event], Turn]] = MappingProxyType(
    {
        Stage.ATTRACT: MappingProxyType({StartTapped: Turn.ON}),
        Stage.ABOUT: _underway(_READ),
        Stage.CONSENT: _underway(
            {PurposeTicked: Turn.STAY, AgreeTapped: Turn.STAY, ConsentGiven: Turn.ON, DeclineTapped: Turn.ON}
        ),
        Stage.AGE: _underway({AgeTapped: Turn.ON}),
        Stage.ABOUT_YOU: _underway(_ASK),
        Stage.INTRODUCTION: _underway(_READ),
        Stage.PRACTICE: _underway({CardTapped: Turn.STAY, SkipTapped: Turn.STAY, PracticeFinished: Turn.ON}),
        Stage.GAME: _underway({CardTapped: Turn.STAY, GameFinished: Turn.ON}),
        Stage.RESULT: _underway(_READ),
        Stage.QUESTIONS: _underway(_ASK),
        Stage.DEBRIEF: _underway(_READ),
        Stage.THANKS: _underway({ContinueTapped: Turn.ON, NextAsked: Turn.ON, Thanked: Turn.ON}),
        # Only a sitting that was cut off with the program may go on; Session sees to that.
        Stage.OVER: MappingProxyType({SittingResumed: Turn.STAY}),
    }
)

BEFORE_DECIDING = frozenset({Stage.ABOUT, Stage.CONSENT, Stage.AGE})
"""Until a visitor is past these, nothing of the sitting is written."""

_ONLY_WHEN_KEPT = frozenset({Stage.CONSENT, Stage.AGE, Stage.ABOUT_YOU, Stage.QUESTIONS, Stage.DEBRIEF})
"""Stages that would ask, or tell, somebody about a record that there is not."""

_BEFORE: Mapping[Stage, tuple[Stage, ...]] = {
    Stage.CONSENT: (Stage.ABOUT_YOU, Stage.INTRODUCTION, Stage.PRACTICE, Stage.GAME, Stage.QUESTIONS),
    Stage.AGE: (Stage.ABOUT_YOU, Stage.INTRODUCTION, Stage.PRACTICE, Stage.GAME, Stage.QUESTIONS),
    Stage.ABOUT: (Stage.CONSENT, Stage.AGE, Stage.GAME),
    Stage.ABOUT_YOU: (Stage.DEBRIEF, Stage.THANKS),
    Stage.PRACTICE: (Stage.GAME,),
    Stage.INTRODUCTION: (Stage.PRACTICE, Stage.GAME),
    Stage.GAME: (Stage.RESULT, Stage.DEBRIEF, Stage.THANKS),
    Stage.QUESTIONS: (Stage.DEBRIEF, Stage.THANKS),
    Stage.DEBRIEF: (Stage.THANKS,),
    Stage.RESULT: (Stage.DEBRIEF, Stage.THANKS),
}
"""What a stage has to come before, wherever both are there."""


@dataclass(frozen=True)
class Course:
    """The stages of a study, in their order."""

    stages: tuple[Stage, ...]

    @classmethod
    def of(cls, names: Sequence[str]) -> Course:
        """The course of these stages; raises BadInput if one is unknown, or comes where it cannot."""
        unknown = [name for name in names if name not in STAGES]
        if unknown:
            raise BadInput(f"stages: there is no stage {unknown[0]!r}; there are {', '.join(STAGES)}")
        stages = tuple(Stage(name) for name in names)
        if Stage.GAME not in stages:
            raise BadInput("stages: without the stage 'game' there is nothing to study")
        for index, stage in enumerate(stages):
            late = next((before for before in stages[:index] if before in _BEFORE.get(stage, ())), None)
            if late is not None:
                raise BadInput(f"stages: {stage.value!r} must come before {late.value!r}")
        return cls(stages)

    def after(self, stage: Stage, *, kept: bool) -> Stage:
        """The stage after this one; a sitting that is not ``kept`` leaves out what only makes sense with a record."""
        ahead = self.stages[0 if stage is Stage.ATTRACT else self.stages.index(stage) + 1 :]
        return next((coming for coming in ahead if kept or coming not in _ONLY_WHEN_KEPT), Stage.OVER)


def check_expected(stage: Stage, event: WorldEvent) -> None:
    """Raise UnexpectedEvent if the stage has no place for this event."""
    if type(event) not in TABLE[stage]:
        raise UnexpectedEvent(stage, event)


def turn(stage: Stage, event: Event) -> Turn:
    """What this event makes of the stage."""
    return TABLE[stage].get(type(event), Turn.STAY)


def diagram() -> str:
    """The table as a Mermaid state diagram of the whole course; what may come in every stage stands in a note."""
    course = Course.of(STAGES)
    arrows = [
        f"    {stage.value} --> {coming.value}: {kind.__name__}"
        for stage, row in TABLE.items()
        for kind, step in row.items()
        if kind not in (*_ANYWHERE, *_LEAVING)
        for coming in (_coming(course, stage, kind) if step is Turn.ON else (stage,))
    ]
    left_out = ", ".join(stage.value for stage in course.stages if stage in _ONLY_WHEN_KEPT)
    notes = (
        f"    note right of {Stage.GAME.value}",
        f"        in every stage with a visitor: {_names(_ANYWHERE)};",
        f"        and to {Stage.OVER.value}: {_names(_LEAVING)};",
        f"        from then on, a sitting that is not kept leaves out: {left_out}",
        "    end note",
    )
    ends = (f"    [*] --> {Stage.ATTRACT.value}", *arrows, f"    {Stage.OVER.value} --> [*]")
    return "\n".join(("stateDiagram-v2", *ends, *notes)) + "\n"


_KEPT_AFTER: Mapping[type[Event], tuple[bool, ...]] = {DeclineTapped: (False,), AgeTapped: (True, False)}
"""Whether a sitting can still be kept after what may decide against it."""


def _coming(course: Course, stage: Stage, kind: type[Event]) -> tuple[Stage, ...]:
    """The stages that this kind of event may lead to."""
    return tuple(course.after(stage, kept=kept) for kept in _KEPT_AFTER.get(kind, (True,)))


def _names(kinds: Sequence[type[Event]]) -> str:
    return ", ".join(sorted(kind.__name__ for kind in kinds))
