"""What the sittings of a data set were asked, over all that they followed: the newest wording of each thing counts."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import TypeVar

from kiosk.study.declared.information import Purpose
from kiosk.study.declared.questionnaire import Item, Questionnaire, Rating
from kiosk.study.plan import Plan

_T = TypeVar("_T")


@dataclass(frozen=True)
class Followed:
    """Everything that gives rise to columns; ``plans`` are those that can be read, the newest first."""

    plans: tuple[Plan, ...]

    @property
    def title(self) -> str:
        """What the study is called now."""
        return self.plans[0].settings.title if self.plans else "A study with Recollect"

    @property
    def language(self) -> str:
        """The study's first language, in which things are described."""
        return self.plans[0].settings.languages[0] if self.plans else "en"

    @property
    def languages(self) -> tuple[str, ...]:
        """The languages that sittings were in, the study's first one first."""
        return tuple(sorted({plan.language for plan in self.plans}, key=lambda code: (code != self.language, code)))

    @property
    def purposes(self) -> dict[str, Purpose]:
        """What was asked for in consent, by name."""
        # A sheet is in one language; that of the study goes first.
        sheets = sorted(self.plans, key=lambda plan: plan.language != self.language)
        return _first((purpose.id, purpose) for plan in sheets for purpose in plan.information.consent.purposes)

    @property
    def about_you(self) -> dict[str, Item]:
        """The items about the visitor, by name."""
        return _first((item.id, item) for plan in self.plans for item in plan.about_you.items)

    @property
    def questionnaires(self) -> dict[str, Questionnaire]:
        """The questionnaires, by name."""
        return _first((each.id, each) for plan in self.plans for each in (plan.about_you, *plan.questionnaires))

    @property
    def scales(self) -> Iterator[tuple[Questionnaire, str, tuple[Rating, ...]]]:
        """Every scale with its items."""
        for questionnaire in self.questionnaires.values():
            for scale, items in questionnaire.scales.items():
                yield questionnaire, scale, items


def _first(named: Iterable[tuple[str, _T]]) -> dict[str, _T]:
    found: dict[str, _T] = {}
    for name, thing in named:
        found.setdefault(name, thing)
    return found
