"""The conditions of a study, what they come to, and which participant gets which."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable, Mapping, Sequence
from math import gcd
from random import Random
from typing import ClassVar, Literal

from kiosk import UserInputError
from kiosk.assistance.hint_sentences import (
    NoSentences,
    PlainSentences,
    ReasonedSentences,
    ReminderSentences,
    Sentences,
    Wording,
)
from kiosk.assistance.mentaliser import Mentaliser, TargetRule
from kiosk.config import KNOWN_CONDITIONS, ConditionConfig
from kiosk.lazy_dataclass import dataclass


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
    if condition.gaze_only:
        return Help(mentaliser, NoSentences(wording))
    if not condition.location:
        return Help(mentaliser, ReminderSentences(wording))
    return Help(mentaliser, ReasonedSentences(wording) if condition.explanation else PlainSentences(wording))


def target_rule(condition: ConditionConfig, rule: TargetRule) -> TargetRule | None:
    """Return the rule that hints for first cards follow; ``rule`` is the mentalised one. None without help."""
    if not condition.helps:
        return None
    return rule if condition.target_rule == "mentalised" else TargetRule(condition.target_rule)


@dataclass(frozen=True)
class AllocationSlot:
    """One slot of the list; ``number`` and ``block`` count from 1."""

    number: int
    block: int
    condition: Condition


def allocation_slots(
    quotas: Mapping[Condition, int], block: int, seed: int, kept: tuple[AllocationSlot, ...] = ()
) -> tuple[AllocationSlot, ...]:
    """Return the list with every condition as often as its quota says, block by block.

    ``block`` is how many slots a block has; the last one may be shorter, still in ratio. ``kept`` is an earlier list
    that this one goes on from, for quotas that were raised in the same ratio. A list that ends with a whole block is
    kept by drawing anew with the same seed; one that ends with a shorter block only if it is handed in, as slots
    that were given out do not change. Raises UserInputError for quotas or a block that cannot be kept to.
    """
    ratio = _ratio(quotas)
    _check_block(block, ratio)
    rounds = _rounds_left(quotas, ratio, kept)
    drawn = list(kept)
    number = kept[-1].block if kept else 0
    while rounds:
        number += 1
        taken = min(rounds, block // ratio.total())
        drawn += _block(number, ratio, taken, seed, first=len(drawn) + 1)
        rounds -= taken
    return tuple(drawn)


def next_slot(listed: tuple[AllocationSlot, ...], consumed: Collection[int]) -> AllocationSlot | None:
    """Return the first slot that is not consumed; None when the list is used up."""
    return next((slot for slot in listed if slot.number not in consumed), None)


def condition_of_return(
    rule: Literal["same", "next", "new"], before: Sequence[Condition], listed: Collection[Condition]
) -> Condition | None:
    """Return the condition of a participant who comes back, by those of the visits before, the first one first.

    ``next`` goes on in the design's order among the conditions that are listed, and begins anew after the last. None
    means that the condition is found as for a new participant.
    """
    if rule == "new" or not before:
        return None
    if rule == "same":
        return before[0]
    order = in_design_order({*listed, before[-1]})
    return order[(order.index(before[-1]) + 1) % len(order)]


def ratio_in_words(quotas: Mapping[Condition, int]) -> str:
    """Quotas for a person: ``28 tom, 28 notom``."""
    return ", ".join(f"{quotas[condition]} {condition.name}" for condition in in_design_order(quotas))


def _ratio(quotas: Mapping[Condition, int]) -> Counter[Condition]:
    """How often each condition comes up in the shortest stretch in ratio, in the conditions' own order."""
    if not quotas:
        raise UserInputError("an allocation list needs a quota for at least one condition")
    for condition, quota in quotas.items():
        if quota < 1:
            raise UserInputError(f"the quota of {condition.name} must be at least 1, not {quota}")
    divisor = gcd(*quotas.values())
    return Counter({condition: quotas[condition] // divisor for condition in in_design_order(quotas)})


def _check_block(block: int, ratio: Counter[Condition]) -> None:
    shortest = ratio.total()
    if block < 1 or block % shortest:
        fits = f"{shortest}, {2 * shortest}, {3 * shortest} and so on"
        raise UserInputError(f"a block of {block} slots cannot hold {ratio_in_words(ratio)} in ratio; {fits} fit")


def _rounds_left(quotas: Mapping[Condition, int], ratio: Counter[Condition], kept: tuple[AllocationSlot, ...]) -> int:
    """How many times the ratio is still to be drawn after the slots that are kept."""
    condition = next(iter(ratio))
    taken = Counter(slot.condition for slot in kept)
    rounds = taken[condition] // ratio[condition]
    if taken != Counter({each: share * rounds for each, share in ratio.items()}):
        raise UserInputError(
            f"the slots that are already listed ({ratio_in_words(taken)}) are not in the quotas' ratio"
        )
    left = quotas[condition] // ratio[condition] - rounds
    if left < 0:
        raise UserInputError(f"more slots are already listed ({ratio_in_words(taken)}) than the quotas allow")
    return left


def _block(number: int, ratio: Counter[Condition], rounds: int, seed: int, first: int) -> list[AllocationSlot]:
    """Return one block in chance order.

    Each has a stream of its own, so that it does not depend on how many there are.
    """
    conditions = [condition for condition, share in ratio.items() for _ in range(share * rounds)]
    Random(f"{seed}/block {number}").shuffle(conditions)
    return [AllocationSlot(at, number, condition) for at, condition in enumerate(conditions, first)]
