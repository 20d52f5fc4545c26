"""What was answered in a sitting, from its events and its questionnaires and nothing else.

A stage that was resumed begins anew: what was answered in it before does not count, for all its pages came again.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace

from kiosk.study.declared.questionnaire import Answer, Questionnaire
from kiosk.study.events import (
    AnswerGiven,
    Event,
    ItemsShown,
    PauseAsked,
    PauseEnded,
    SittingEnded,
    SittingResumed,
    Stage,
    StageEntered,
)


@dataclass(frozen=True)
class Answered:
    """One item of a sitting; times in ms since its page was shown, without pauses.

    ``value`` is None where nothing was answered, or nothing was left of it. ``first_ms`` and ``last_ms`` are the times
    of the first and the last answer, also of one that was taken back; None where there was none. ``changes`` counts
    the answers that differ from the one before; the first is no change.
    """

    questionnaire: str
    item: str
    value: Answer | None = None
    first_ms: int | None = None
    last_ms: int | None = None
    changes: int = 0

    def answered(self, value: Answer | None, after_ms: int) -> Answered:
        """The same with one more answer."""
        value = meant(value)
        first = after_ms if self.first_ms is None else self.first_ms
        changed = self.first_ms is not None and value != self.value
        return replace(self, value=value, first_ms=first, last_ms=after_ms, changes=self.changes + changed)


def meant(value: Answer | None) -> Answer | None:
    """An answer, or None for one that says nothing: an empty text, or none of the options."""
    return None if value in {"", ()} else value


def answers(events: Iterable[Event], questionnaires: Sequence[Questionnaire]) -> tuple[Answered, ...]:
    """What became of every item that can be answered, in the order in which they are declared."""
    given = {
        (answered.questionnaire, answered.item): answered
        for stage in _stages(events).values()
        for answered in stage.answered.values()
    }
    return tuple(
        given.get((asked.id, item.id), Answered(asked.id, item.id))
        for asked in questionnaires
        for item in asked.questions
    )


@dataclass
class _Clock:
    """The time since a page was shown; it stands still while the sitting is paused."""

    begun_at: int = 0
    paused_at: int | None = None

    def show(self, at_ms: int) -> None:
        self.begun_at = at_ms
        if self.paused_at is not None:
            self.paused_at = at_ms

    def pause(self, at_ms: int) -> None:
        if self.paused_at is None:
            self.paused_at = at_ms

    def go_on(self, at_ms: int) -> None:
        if self.paused_at is not None:
            self.begun_at += at_ms - self.paused_at
            self.paused_at = None

    def since(self, at_ms: int) -> int:
        return (at_ms if self.paused_at is None else self.paused_at) - self.begun_at


@dataclass
class _Asked:
    """One stage, from its last beginning on: which questionnaire is shown, and what was answered."""

    questionnaire: str = ""
    answered: dict[tuple[str, str], Answered] = field(default_factory=dict)

    def take(self, event: AnswerGiven, after_ms: int) -> None:
        """Add one answer to an item of the page that is shown."""
        key = (self.questionnaire, event.item)
        self.answered[key] = self.answered.get(key, Answered(*key)).answered(event.value, after_ms)


def _stages(events: Iterable[Event]) -> dict[Stage, _Asked]:
    """What was answered in each stage since it was entered last."""
    stages: dict[Stage, _Asked] = {}
    here, clock = _Asked(), _Clock()
    for event in events:
        match event:
            case StageEntered(stage=stage):
                here = stages[stage] = _Asked()
            case ItemsShown(questionnaire=questionnaire):
                here.questionnaire = questionnaire
                clock.show(event.at_ms)
            case AnswerGiven():
                here.take(event, clock.since(event.at_ms))
            case PauseAsked():
                clock.pause(event.at_ms)
            case PauseEnded() | SittingResumed() | SittingEnded():
                clock.go_on(event.at_ms)
    return stages
