"""What became of a sitting at a glance, from its events and nothing else."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

from kiosk.study.events import (
    BodyChanged,
    ConsentGiven,
    Event,
    GameFinished,
    PauseAsked,
    PauseEnded,
    SittingEnded,
    SittingResumed,
    Stage,
    StageEntered,
    Status,
)

_Kind = TypeVar("_Kind", bound=Event)


@dataclass(frozen=True)
class Entered:
    """A stage, and when it began; a stage that was resumed stands there again. Time in ms."""

    stage: Stage
    at_ms: int


@dataclass(frozen=True)
class Pause:
    """From when to when the experimenter stopped the sitting, in ms; ``until_ms`` is None while it lasts."""

    since_ms: int
    until_ms: int | None = None


@dataclass(frozen=True)
class Overview:
    """What became of a sitting.

    ``last`` is the stage that it was in, or last in before its end; None if it never came to one. ``status`` is how it
    ended; None while it has not, also where it went on after an interruption. ``body_changes`` are those within the
    sitting; which body helps after a resumption stands in ``resumptions``. A pause ends with whatever ends its sitting
    or goes on with it.
    """

    entered: tuple[Entered, ...]
    last: Stage | None
    status: Status | None
    game_completed: bool
    consent: ConsentGiven | None
    body_changes: tuple[BodyChanged, ...]
    pauses: tuple[Pause, ...]
    resumptions: tuple[SittingResumed, ...]


def overview(events: Iterable[Event]) -> Overview:
    """See what became of a sitting."""
    events = tuple(events)
    entered = tuple(Entered(event.stage, event.at_ms) for event in _all(StageEntered, events))
    return Overview(
        entered=entered,
        last=next((stage.stage for stage in reversed(entered) if stage.stage is not Stage.OVER), None),
        status=_status(events),
        game_completed=bool(_all(GameFinished, events)),
        consent=next(iter(_all(ConsentGiven, events)), None),
        body_changes=_all(BodyChanged, events),
        pauses=_pauses(events),
        resumptions=_all(SittingResumed, events),
    )


def _all(kind: type[_Kind], events: Sequence[Event]) -> tuple[_Kind, ...]:
    return tuple(event for event in events if isinstance(event, kind))


def _status(events: Sequence[Event]) -> Status | None:
    last = events[-1] if events else None
    return last.status if isinstance(last, SittingEnded) else None


def _pauses(events: Sequence[Event]) -> tuple[Pause, ...]:
    pauses: list[Pause] = []
    for event in events:
        lasting = bool(pauses) and pauses[-1].until_ms is None
        match event:
            case PauseAsked() if not lasting:
                pauses.append(Pause(event.at_ms))
            case PauseEnded() | SittingEnded() | SittingResumed() if lasting:
                pauses[-1] = replace(pauses[-1], until_ms=event.at_ms)
    return tuple(pauses)
