"""The conditions of the study: two switches, and "no assistance".

This is the one place that turns a condition into a mentaliser and a set of sentences; no other line of code asks for
the condition.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from random import Random
from typing import Protocol

from kiosk import UserInputError
from kiosk.assistance.mentaliser import Hint, Mentaliser, TargetRule
from kiosk.assistance.policy import ActionSpec
from kiosk.assistance.wording import PlainSentences, ReasonedSentences, Wording


class Sentences(Protocol):
    """What is said with a hint."""

    def sentence(self, hint: Hint) -> str:
        """Return the sentence for one hint."""
        ...

    def all_wordings(self, hint: Hint) -> tuple[str, ...]:
        """All the sentences that there are for one hint."""
        ...

    def remark(self, action: ActionSpec) -> str:
        """Return the sentence for an action without a place."""
        ...

    def all_remarks(self, action: ActionSpec) -> tuple[str, ...]:
        """All the sentences that there are for an action without a place."""
        ...


class Condition(Enum):
    """A cell of the design: a mentalised or a random target, an explanation given or withheld.

    ``tom`` and ``notom`` are the study's two; the next two separate the choice from the explanation.
    """

    TOM = "tom"
    NOTOM = "notom"
    MENTALISED_UNEXPLAINED = "mentalised_unexplained"
    RANDOM_EXPLAINED = "random_explained"
    NO_ASSISTANCE = "no_assistance"

    @classmethod
    def from_name(cls, name: str) -> Condition:
        """Return the condition of this name; raises UserInputError with all the names there are."""
        try:
            return cls(name)
        except ValueError as error:
            names = ", ".join(condition.value for condition in cls)
            raise UserInputError(f"there is no condition {name!r}; there are {names}") from error


@dataclass(frozen=True)
class Help:
    """What a condition comes to: who chooses the target, and what is said with it."""

    mentaliser: Mentaliser
    sentences: Sentences


def help_in(condition: Condition, rule: TargetRule, wording: Wording, rng: Random) -> Help | None:
    """Return the help that a visitor in this condition gets; ``rule`` is the one that mentalised conditions follow."""
    followed = target_rule(condition, rule)
    if followed is None:
        return None
    _, explained = _CELLS[condition]
    return Help(Mentaliser(followed, rng), ReasonedSentences(wording) if explained else PlainSentences(wording))


def target_rule(condition: Condition, rule: TargetRule) -> TargetRule | None:
    """Return the rule that mentalised hints for first cards follow; None for any other ``rule`` and without help."""
    if condition is Condition.NO_ASSISTANCE:
        return None
    mentalised, _ = _CELLS[condition]
    return rule if mentalised else TargetRule.RANDOM


_CELLS = {
    Condition.TOM: (True, True),
    Condition.NOTOM: (False, False),
    Condition.MENTALISED_UNEXPLAINED: (True, False),
    Condition.RANDOM_EXPLAINED: (False, True),
}
