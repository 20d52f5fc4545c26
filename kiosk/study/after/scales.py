"""What the answers of a sitting come to, scale by scale: sums as the study reports them, and means beside them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from kiosk.study.after.answers import Answered
from kiosk.study.declared.questionnaire import Answer, Questionnaire, Rating


@dataclass(frozen=True)
class Score:
    """One scale; reversed items are turned round (x becomes lowest + highest - x) before anything is added up.

    ``total`` is the sum, None unless all ``items`` are answered; ``mean`` is that of the answered ones, None if there
    is none.
    """

    questionnaire: str
    scale: str
    items: int
    answered: int
    total: int | None
    mean: float | None


def scores(answers: Iterable[Answered], questionnaires: Iterable[Questionnaire]) -> tuple[Score, ...]:
    """Every scale of these questionnaires, in the order in which they are declared."""
    values = {(answered.questionnaire, answered.item): answered.value for answered in answers}
    return tuple(
        _score(asked.id, scale, items, [values.get((asked.id, item.id)) for item in items])
        for asked in questionnaires
        for scale, items in asked.scales.items()
    )


def _score(questionnaire: str, scale: str, items: Sequence[Rating], values: Sequence[Answer | None]) -> Score:
    counted = [item.scored(value) for item, value in zip(items, values, strict=True) if isinstance(value, int)]
    return Score(
        questionnaire=questionnaire,
        scale=scale,
        items=len(items),
        answered=len(counted),
        total=sum(counted) if len(counted) == len(items) else None,
        mean=sum(counted) / len(counted) if counted else None,
    )
