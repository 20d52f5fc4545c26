"""One participant's sitting, with what is worked out from all of it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from kiosk.store.dataset.kept import Kept
from kiosk.store.dataset.tables.asked import Answered, Score, answered, scores
from kiosk.study.after.measures import Measures, measure
from kiosk.study.events import PracticeEnd, PracticeFinished


@dataclass(frozen=True)
class Person:
    """One sitting with what is worked out from all of it, once for all columns."""

    kept: Kept

    @cached_property
    def measures(self) -> Measures:
        """What was measured in the game."""
        return measure(self.kept.events)

    @cached_property
    def answers(self) -> dict[tuple[str, str], Answered]:
        """What was answered, by questionnaire and item."""
        return answered(self.kept)

    @cached_property
    def scores(self) -> dict[tuple[str, str], Score]:
        """The scales, by questionnaire and name."""
        return {(score.questionnaire.id, score.scale): score for score in scores(self.kept)}

    @property
    def practice(self) -> PracticeEnd | None:
        """How the practice ended; None if it did not."""
        return next((event.how for event in self.kept.events if isinstance(event, PracticeFinished)), None)

    def count(self, kind: type[object]) -> int:
        """How many events of a kind there are."""
        return sum(isinstance(event, kind) for event in self.kept.events)
