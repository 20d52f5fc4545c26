"""One participant's sitting, with what is worked out from all of it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from kiosk.store.dataset.stored.kept import Kept
from kiosk.store.dataset.tables.asked import asked, scores
from kiosk.study.after.answers import Answered, answers
from kiosk.study.after.measures import Measures, measure
from kiosk.study.after.overview import Overview, overview
from kiosk.study.after.scales import Score
from kiosk.study.events import PracticeEnd, PracticeFinished


@dataclass(frozen=True)
class Person:
    """One sitting with what is worked out from all of it, once for all columns."""

    kept: Kept

    @cached_property
    def overview(self) -> Overview:
        """What became of the sitting."""
        return overview(self.kept.events)

    @cached_property
    def measures(self) -> Measures:
        """What was measured in the game."""
        return measure(self.kept.events)

    @cached_property
    def about_you(self) -> dict[str, Answered]:
        """What was answered about the visitor, by item."""
        asked_first = asked(self.kept)[:1]
        return {answer.item: answer for answer in answers(self.kept.events, asked_first)}

    @cached_property
    def scores(self) -> dict[tuple[str, str], Score]:
        """The scales, by questionnaire and name."""
        return {(score.questionnaire, score.scale): score for score in scores(self.kept)}

    @property
    def practice(self) -> PracticeEnd | None:
        """How the practice ended; None if it did not."""
        return next((event.how for event in self.kept.events if isinstance(event, PracticeFinished)), None)
