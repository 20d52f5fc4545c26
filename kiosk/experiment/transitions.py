"""The course of a session as one table: stage x event -> what becomes of the stage.

The study says which stages there are, and in which order; ``StageOrder`` knows what comes after each. World events that
a stage does not list are refused. Session events that it does not list change no stage.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from enum import Enum
from types import MappingProxyType

from kiosk import UserInputError
from kiosk.config import STAGES
from kiosk.experiment.events import (
    AbortRequested,
    AgeConfirmed,
    ApplicationClosed,
    BackPressed,
    CardSelected,
    ConsentDeclined,
    ConsentGiven,
    ConsentPurposeToggled,
    ConsentSubmitted,
    ContinuePressed,
    Event,
    GameFinished,
    IdleTimedOut,
    LanguageSelected,
    MuteChanged,
    NextParticipantRequested,
    PauseEnded,
    PauseRequested,
    PracticeFinished,
    PracticeSkipped,
    PresenceConfirmed,
    QuestionnairesCompleted,
    RepeatPressed,
    RepeatRequested,
    ResponseGiven,
    RobotDisconnected,
    SessionResumed,
    SessionStarted,
    SoundSelected,
    SpeechFailed,
    SpeechFinished,
    SpeechStarted,
    StopPressed,
    TextSizeSelected,
    ThanksTimedOut,
    TimerExpired,
    TypingActivity,
    UserActivity,
    WorldEvent,
)
from kiosk.experiment.outcomes import Stage
from kiosk.lazy_dataclass import dataclass


class InvalidTransition(Exception):
    """A world event that the stage has no place for; the session is as it was."""

    def __init__(self, stage: Stage, event: WorldEvent) -> None:
        """Name both."""
        super().__init__(f"{type(event).__name__} has no place in the stage {stage.value}")
        self.stage = stage
        self.event = event


class Transition(Enum):
    """What an event makes of the stage."""

    STAY = "stay"
    ON = "on"
    """To the next stage of the study."""
    BACK = "back"
    """To the stage before, where that is only pages as well."""
    OVER = "over"
    """To the end of the session."""


_ANYWHERE = (
    TimerExpired,
    SpeechStarted,
    SpeechFinished,
    SpeechFailed,
    RobotDisconnected,
    PresenceConfirmed,
    UserActivity,
    RepeatRequested,
    RepeatPressed,
    LanguageSelected,
    TextSizeSelected,
    SoundSelected,
    PauseRequested,
    PauseEnded,
    MuteChanged,
    SessionResumed,
)
_LEAVING = (IdleTimedOut, AbortRequested, StopPressed, ApplicationClosed)


def _underway(own: Mapping[type[Event], Transition]) -> Mapping[type[Event], Transition]:
    """Return a stage's own events, and those that may come in any stage that a visitor is in."""
    return MappingProxyType(
        dict.fromkeys(_ANYWHERE, Transition.STAY) | dict.fromkeys(_LEAVING, Transition.OVER) | dict(own)
    )


_READ: Mapping[type[Event], Transition] = {ContinuePressed: Transition.ON}
_BACK: Mapping[type[Event], Transition] = {BackPressed: Transition.BACK}
_ASK: Mapping[type[Event], Transition] = {
    TypingActivity: Transition.STAY,
    ResponseGiven: Transition.STAY,
    ContinuePressed: Transition.STAY,
    BackPressed: Transition.STAY,
    QuestionnairesCompleted: Transition.ON,
}

TABLE: Mapping[Stage, Mapping[type[Event], Transition]] = MappingProxyType(
    {
        Stage.ATTRACT: MappingProxyType({SessionStarted: Transition.ON}),
        Stage.ABOUT: _underway(_READ),
        Stage.CONSENT: _underway(
            {
                ConsentPurposeToggled: Transition.STAY,
                ConsentSubmitted: Transition.STAY,
                ConsentGiven: Transition.ON,
                ConsentDeclined: Transition.ON,
                **_BACK,
            }
        ),
        Stage.AGE: _underway({AgeConfirmed: Transition.ON, **_BACK}),
        Stage.ABOUT_YOU: _underway(_ASK),
        Stage.INTRODUCTION: _underway({**_READ, **_BACK}),
        Stage.PRACTICE: _underway(
            {CardSelected: Transition.STAY, PracticeSkipped: Transition.STAY, PracticeFinished: Transition.ON}
        ),
        Stage.GAME: _underway({CardSelected: Transition.STAY, GameFinished: Transition.ON}),
        Stage.RESULT: _underway(_READ),
        Stage.QUESTIONS: _underway(_ASK),
        Stage.DEBRIEF: _underway(_READ),
        Stage.THANKS: _underway(
            {
                ContinuePressed: Transition.ON,
                NextParticipantRequested: Transition.ON,
                ThanksTimedOut: Transition.ON,
                **_BACK,
            }
        ),
        # Only a session that was cut off with the program may go on; Session sees to that.
        Stage.OVER: MappingProxyType({SessionResumed: Transition.STAY}),
    }
)

BEFORE_DECIDING = frozenset({Stage.ABOUT, Stage.CONSENT, Stage.AGE})
"""Until a visitor is past these, nothing of the session is written."""

_ONLY_WHEN_KEPT = frozenset({Stage.CONSENT, Stage.AGE, Stage.ABOUT_YOU, Stage.QUESTIONS, Stage.DEBRIEF})
"""Stages that would ask, or tell, a visitor about a record that does not exist."""

_WAY_BACK = (
    frozenset({Stage.ABOUT, Stage.AGE, Stage.CONSENT}),
    frozenset({Stage.ABOUT_YOU, Stage.INTRODUCTION}),
    frozenset({Stage.DEBRIEF, Stage.THANKS}),
)
"""A visitor can go back within each of these; never across the consent that was given, a game, or the debriefing."""

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
class StageOrder:
    """The stages of a study, in their order."""

    stages: tuple[Stage, ...]

    @classmethod
    def of(cls, names: Sequence[str]) -> StageOrder:
        """Return the course of these stages; raises UserInputError if one is unknown, or comes where it cannot."""
        unknown = [name for name in names if name not in STAGES]
        if unknown:
            raise UserInputError(f"stages: there is no stage {unknown[0]!r}; there are {', '.join(STAGES)}")
        stages = tuple(Stage(name) for name in names)
        if Stage.GAME not in stages:
            raise UserInputError("stages: without the stage 'game' there is nothing to study")
        for index, stage in enumerate(stages):
            late = next((before for before in stages[:index] if before in _BEFORE.get(stage, ())), None)
            if late is not None:
                raise UserInputError(f"stages: {stage.value!r} must come before {late.value!r}")
        return cls(stages)

    def after(self, stage: Stage, *, kept: bool) -> Stage:
        """Return the stage after this one.

        A session that is not ``kept`` leaves out what only makes sense with a record.
        """
        ahead = self.stages[0 if stage is Stage.ATTRACT else self.stages.index(stage) + 1 :]
        return next((coming for coming in ahead if kept or coming not in _ONLY_WHEN_KEPT), Stage.OVER)

    def before(self, stage: Stage, *, kept: bool) -> Stage | None:
        """Return the stage that a visitor can go back to from this one; None if there is none."""
        behind = self.stages[: self.stages.index(stage)] if stage in self.stages else ()
        last = next((gone for gone in reversed(behind) if kept or gone not in _ONLY_WHEN_KEPT), None)
        return last if last and any({last, stage} <= pages for pages in _WAY_BACK) else None


def check_expected(stage: Stage, event: WorldEvent) -> None:
    """Raise InvalidTransition if the stage has no place for this event."""
    if type(event) not in TABLE[stage]:
        raise InvalidTransition(stage, event)


def transition(stage: Stage, event: Event) -> Transition:
    """Return what this event makes of the stage."""
    return TABLE[stage].get(type(event), Transition.STAY)


def diagram() -> str:
    """Return the table as a Mermaid state diagram of the whole course.

    What may come in every stage stands in a note.
    """
    course = StageOrder.of(STAGES)
    arrows = [
        f"    {stage.value} --> {coming.value}: {kind.__name__}"
        for stage, row in TABLE.items()
        for kind, step in row.items()
        if kind not in (*_ANYWHERE, *_LEAVING)
        for coming in _leads_to(course, stage, kind, step)
    ]
    left_out = ", ".join(stage.value for stage in course.stages if stage in _ONLY_WHEN_KEPT)
    notes = (
        f"    note right of {Stage.GAME.value}",
        f"        in every stage with a visitor: {_names(_ANYWHERE)};",
        f"        and to {Stage.OVER.value}: {_names(_LEAVING)};",
        f"        from then on, a session that is not kept leaves out: {left_out}",
        "    end note",
    )
    ends = (f"    [*] --> {Stage.ATTRACT.value}", *arrows, f"    {Stage.OVER.value} --> [*]")
    return "\n".join(("stateDiagram-v2", *ends, *notes)) + "\n"


_KEPT_AFTER: Mapping[type[Event], tuple[bool, ...]] = {ConsentDeclined: (False,), AgeConfirmed: (True, False)}
"""Whether a session can still be kept after what may decide against it."""


def _leads_to(course: StageOrder, stage: Stage, kind: type[Event], step: Transition) -> tuple[Stage, ...]:
    """Return the stages that this kind of event may lead to from here; none where there is no way back."""
    if step is Transition.BACK:
        before = course.before(stage, kept=True)
        return () if before is None else (before,)
    return _coming(course, stage, kind) if step is Transition.ON else (stage,)


def _coming(course: StageOrder, stage: Stage, kind: type[Event]) -> tuple[Stage, ...]:
    """Return the stages that this kind of event may lead to."""
    return tuple(course.after(stage, kept=kept) for kept in _KEPT_AFTER.get(kind, (True,)))


def _names(kinds: Sequence[type[Event]]) -> str:
    return ", ".join(sorted(kind.__name__ for kind in kinds))
