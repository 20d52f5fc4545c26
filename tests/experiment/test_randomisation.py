"""Allocation is fixed before the first visitor, and stays in ratio when visitors leave."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from math import gcd
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, precondition, rule

from kiosk import UserInputError
from kiosk.experiment.condition import CONDITIONS, AllocationSlot, Condition, allocation_slots, next_slot

STUDY = {Condition.TOM: 28, Condition.NOTOM: 28}

SHARES = st.dictionaries(st.sampled_from(CONDITIONS), st.integers(1, 4), min_size=1)
SEEDS = st.integers(0, 2**32 - 1)


@st.composite
def designs(draw: Any, rounds: st.SearchStrategy[int] = st.integers(1, 12)) -> tuple[dict[Condition, int], int]:  # noqa: B008
    """Quotas, and a size of blocks that fits them."""
    shares: dict[Condition, int] = draw(SHARES)
    divisor = gcd(*shares.values())
    times = draw(rounds)
    quotas = {condition: share // divisor * times for condition, share in shares.items()}
    return quotas, sum(shares.values()) // divisor * draw(st.integers(1, 4))


def told(listed: Iterable[AllocationSlot]) -> Counter[Condition]:
    """How often each condition comes up."""
    return Counter(place.condition for place in listed)


def blocks(listed: tuple[AllocationSlot, ...]) -> list[tuple[AllocationSlot, ...]]:
    """Return the places of each block."""
    return [tuple(p for p in listed if p.block == block) for block in sorted({p.block for p in listed})]


def raised(quotas: Mapping[Condition, int], times: int) -> dict[Condition, int]:
    """Every quota so many times as high."""
    return {condition: quota * times for condition, quota in quotas.items()}


def test_the_study_s_list() -> None:
    listed = allocation_slots(STUDY, 4, seed=1)
    assert told(listed) == STUDY
    assert [place.number for place in listed] == list(range(1, 57))
    assert all(told(block) == {Condition.TOM: 2, Condition.NOTOM: 2} for block in blocks(listed))
    assert len({tuple(place.condition for place in block) for block in blocks(listed)}) > 3


def test_a_list_does_not_change_from_one_release_to_the_next() -> None:
    """A folder's list is stored; that the same seed draws it again is how others can check it."""
    drawn = "".join(place.condition.name[0] for place in allocation_slots(STUDY, 8, seed=7)[:24])
    assert drawn == "nnttnttnnntntttntnnttnnt"


@given(designs(), SEEDS)
def test_every_list_keeps_its_quotas_and_its_ratio(design: tuple[dict[Condition, int], int], seed: int) -> None:
    quotas, block = design
    listed = allocation_slots(quotas, block, seed)
    assert told(listed) == quotas
    assert [place.number for place in listed] == list(range(1, len(listed) + 1))
    *whole, last = blocks(listed)
    assert all(len(each) == block for each in whole)
    assert len(last) <= block
    for each in (*whole, last):
        assert all(n * sum(quotas.values()) == len(each) * quotas[condition] for condition, n in told(each).items())


@given(designs(), SEEDS)
def test_the_same_seed_draws_the_same_list_in_whatever_order_the_quotas_are_told(
    design: tuple[dict[Condition, int], int], seed: int
) -> None:
    quotas, block = design
    assert allocation_slots(dict(reversed(quotas.items())), block, seed) == allocation_slots(quotas, block, seed)


def test_another_seed_draws_another_list() -> None:
    assert len({allocation_slots(STUDY, 4, seed) for seed in range(20)}) == 20


@given(designs(), SEEDS, st.integers(1, 4))
def test_raised_quotas_keep_a_list_of_whole_blocks(
    design: tuple[dict[Condition, int], int], seed: int, times: int
) -> None:
    quotas, block = design
    whole = raised(quotas, block)
    listed = allocation_slots(whole, block, seed)
    assert allocation_slots(raised(whole, times), block, seed)[: len(listed)] == listed


@given(designs(), SEEDS, st.integers(1, 4))
def test_a_list_that_ends_within_a_block_is_kept_when_it_is_handed_in(
    design: tuple[dict[Condition, int], int], seed: int, times: int
) -> None:
    quotas, block = design
    listed = allocation_slots(quotas, block, seed)
    longer = allocation_slots(raised(quotas, times), block, seed, kept=listed)
    assert longer[: len(listed)] == listed
    assert told(longer) == raised(quotas, times)
    assert all(len(each) <= block for each in blocks(longer))


@pytest.mark.parametrize(
    ("quotas", "block", "words"),
    [
        ({}, 2, "an allocation list needs a quota for at least one condition"),
        ({Condition.TOM: 0, Condition.NOTOM: 4}, 2, "the quota of tom must be at least 1, not 0"),
        (STUDY, 3, "a block of 3 slots cannot hold 1 tom, 1 notom in ratio; 2, 4, 6 and so on fit"),
        (STUDY, 0, "a block of 0 slots"),
        (STUDY, -2, "a block of -2 slots"),
        ({Condition.TOM: 20, Condition.NO_ASSISTANCE: 10}, 4, "2 tom, 1 no_assistance in ratio; 3, 6, 9 and so on"),
    ],
)
def test_what_cannot_be_kept_to_is_refused_in_words(quotas: dict[Condition, int], block: int, words: str) -> None:
    with pytest.raises(UserInputError, match=words):
        allocation_slots(quotas, block, seed=1)


@pytest.mark.parametrize(
    ("quotas", "words"),
    [
        ({Condition.TOM: 8, Condition.NOTOM: 8}, "more slots are already listed"),
        ({Condition.TOM: 60, Condition.NOTOM: 30}, "not in the quotas' ratio"),
        ({Condition.TOM: 60}, "not in the quotas' ratio"),
    ],
)
def test_a_list_that_does_not_go_on_from_the_one_that_is_kept_is_refused(
    quotas: dict[Condition, int], words: str
) -> None:
    with pytest.raises(UserInputError, match=words):
        allocation_slots(quotas, 6, seed=1, kept=allocation_slots(STUDY, 4, seed=1))


def test_the_next_place_is_the_first_free_one() -> None:
    listed = allocation_slots(STUDY, 4, seed=1)
    assert next_slot(listed, ()) == listed[0]
    assert next_slot(listed, {1, 2, 4}) == listed[2]
    assert next_slot(listed, range(1, 57)) is None
    assert next_slot((), ()) is None


class ABooth(RuleBasedStateMachine):
    """Visitors complete their game or leave; some get what the experimenter chose; now and then the quotas rise."""

    @initialize(design=designs(st.integers(1, 4)), seed=SEEDS)
    def open(self, design: tuple[dict[Condition, int], int], seed: int) -> None:
        self.quotas, self.block = design
        self.seed = seed
        self.listed = allocation_slots(self.quotas, self.block, seed)
        self.sessions: list[tuple[AllocationSlot | None, Condition, bool]] = []

    @property
    def completed(self) -> list[AllocationSlot]:
        return [place for place, _, finished in self.sessions if place is not None and finished]

    @property
    def coming(self) -> AllocationSlot | None:
        return next_slot(self.listed, {place.number for place in self.completed})

    @rule(finished=st.booleans())
    def come(self, finished: bool) -> None:  # noqa: FBT001 - hypothesis hands it over by name
        place = self.coming
        self.sessions.append((place, place.condition if place else next(iter(self.quotas)), finished))

    @rule(condition=st.sampled_from(CONDITIONS), finished=st.booleans())
    def be_chosen(self, condition: Condition, finished: bool) -> None:  # noqa: FBT001 - as above
        self.sessions.append((None, condition, finished))

    @precondition(lambda self: len(self.listed) < 200)
    @rule(times=st.integers(1, 3))
    def raise_quotas(self, times: int) -> None:
        self.quotas = raised(self.quotas, times)
        self.listed = allocation_slots(self.quotas, self.block, self.seed, kept=self.listed)

    @invariant()
    def nothing_was_given_twice(self) -> None:
        assert [place.number for place in self.completed] == list(range(1, len(self.completed) + 1))

    @invariant()
    def the_conditions_are_as_even_as_one_block_allows(self) -> None:
        """After n games a cell of share p has np, give or take what one block can hold back: bp(1 - p)."""
        cells, n, total = told(self.completed), len(self.completed), sum(self.quotas.values())
        for condition, quota in self.quotas.items():
            share = quota / total
            assert abs(cells[condition] - n * share) <= self.block * share * (1 - share) + 1e-9

    @invariant()
    def a_list_that_is_used_up_has_met_every_quota(self) -> None:
        if self.coming is None:
            assert told(self.completed) == self.quotas


TestABooth = ABooth.TestCase
TestABooth.settings = settings(max_examples=100, stateful_step_count=40, deadline=None)
