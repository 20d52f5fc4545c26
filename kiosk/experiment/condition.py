"""The conditions of a study, by their names, and what their declarations come to.

This is the one place that turns a condition into a mentaliser and a set of sentences; no other line of code asks for
the condition.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from random import Random
from typing import ClassVar, Protocol

from kiosk import UserInputError
from kiosk.assistance.mentaliser import Hint, Mentaliser, TargetRule
from kiosk.assistance.policy import ActionSpec
from kiosk.assistance.wording import PlainSentences, ReasonedSentences, ReminderSentences, Wording
from kiosk.config import KNOWN_CONDITIONS, ConditionConfig


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


@dataclass(frozen=True)
class Condition:
    """The name of a condition; the study file says what it comes to.

    ``tom`` and ``notom`` are the study's two; the next two separate the choice of the target from the explanation.
    """

    TOM: ClassVar[Condition]
    NOTOM: ClassVar[Condition]
    MENTALISED_UNEXPLAINED: ClassVar[Condition]
    RANDOM_EXPLAINED: ClassVar[Condition]
    NO_ASSISTANCE: ClassVar[Condition]

    name: str

    @property
    def is_known(self) -> bool:
        """Whether its name has a meaning in every study."""
        return self.name in KNOWN_CONDITIONS

    @property
    def known(self) -> ConditionConfig:
        """What it comes to in every study; raises UserInputError if only a study file says that."""
        return KNOWN_CONDITIONS[Condition.from_name(self.name).name]

    @classmethod
    def from_name(cls, name: str) -> Condition:
        """Return the condition of a name that every study knows; raises UserInputError for another."""
        if name not in KNOWN_CONDITIONS:
            raise UserInputError(f"there is no condition {name!r}; there are {', '.join(KNOWN_CONDITIONS)}")
        return cls(name)


CONDITIONS = tuple(map(Condition, KNOWN_CONDITIONS))
"""The conditions that need no declaration, in the design's order."""

(
    Condition.TOM,
    Condition.NOTOM,
    Condition.MENTALISED_UNEXPLAINED,
    Condition.RANDOM_EXPLAINED,
    Condition.NO_ASSISTANCE,
) = CONDITIONS


def in_design_order(conditions: Iterable[Condition]) -> tuple[Condition, ...]:
    """Sort conditions, each once: those that need no declaration in the design's order, then the others by name."""
    order = {condition: at for at, condition in enumerate(CONDITIONS)}
    return tuple(sorted(set(conditions), key=lambda each: (order.get(each, len(order)), each.name)))


@dataclass(frozen=True)
class Help:
    """What a condition comes to: who chooses the target, and what is said with it."""

    mentaliser: Mentaliser
    sentences: Sentences


def help_in(condition: ConditionConfig, rule: TargetRule, wording: Wording, rng: Random) -> Help | None:
    """Return the help that a visitor in this condition gets; ``rule`` is the one that mentalised conditions follow."""
    followed = target_rule(condition, rule)
    if followed is None:
        return None
    mentaliser = Mentaliser(followed, rng, locates=condition.location)
    if not condition.location:
        return Help(mentaliser, ReminderSentences(wording))
    return Help(mentaliser, ReasonedSentences(wording) if condition.explanation else PlainSentences(wording))


def target_rule(condition: ConditionConfig, rule: TargetRule) -> TargetRule | None:
    """Return the rule that hints for first cards follow; ``rule`` is the mentalised one. None without help."""
    if not condition.helps:
        return None
    return rule if condition.target_rule == "mentalised" else TargetRule(condition.target_rule)
