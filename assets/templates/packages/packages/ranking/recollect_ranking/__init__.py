"""A kind of item: options that are put in an order."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from random import Random
from typing import ClassVar, Literal, Self

from pydantic import model_validator

from kiosk.experiment.items import Act, Answer, AnswerFormat, Choice, Name, Tap


class Ranking(Choice):
    """What is tapped first comes first; the answer is the ids of all options, in that order."""

    qml: ClassVar[Path | None] = Path(__file__).with_name("Ranking.qml")
    picks: ClassVar[str] = "an order of"
    kind: Literal["ranking"]
    counted: Name | None = None
    """The option whose place, from 1, is the score; by default none is counted."""

    @property
    def answer_format(self) -> AnswerFormat:
        """Several options."""
        return AnswerFormat(self.options, several=True)

    def accepts(self, answer: Answer) -> bool:
        """Whether it holds every option once."""
        return isinstance(answer, tuple) and sorted(answer) == sorted(self.ids)

    def score(self, answer: Answer) -> int | None:
        """Return the place of the option that is counted."""
        if self.counted is None or not isinstance(answer, tuple):
            return None
        return answer.index(self.counted) + 1

    def simulate(self, chance: Random, *, last: bool) -> Iterator[Act]:
        """Tap the options in some order."""
        for option in chance.sample(self.ids, len(self.ids)):
            yield Tap(f"rank-{self.id}-{option}")

    @model_validator(mode="after")
    def _count_an_option(self) -> Self:
        if self.counted is not None and self.counted not in self.ids:
            raise ValueError(f"there is no option {self.counted!r} that could be counted")
        return self
