"""The model of the player's memory: its chances are exact, and it learns how forgetful a player is."""

from __future__ import annotations

from itertools import combinations
from random import Random

import pytest

from kiosk.assistance.memory_model import LAPSE, MemoryModel
from kiosk.game import Board, Concentration
from tests.samples import ANIMALS

MATES = (1, 0, 3, 2, 5, 4)
"""Three pairs side by side."""


def model_after(*flips: int, hinted: tuple[int, ...] = ()) -> MemoryModel:
    """Return the model of three pairs after some flips, of which those numbered (from 0) in ``hinted`` had help."""
    model = MemoryModel(MATES)
    for number, place in enumerate(flips):
        model.flip(place, hinted=number in hinted)
    return model


def subsets(places: list[int]) -> list[frozenset[int]]:
    """Return all sets of some places."""
    return [frozenset(some) for size in range(len(places) + 1) for some in combinations(places, size)]


def first_choices(recalled: frozenset[int], closed: list[int], *, in_order: bool) -> dict[int, float]:
    """Return what a player who recalls these cards takes first, by the words of the rule."""
    pairs = [place for place in closed if place in recalled and MATES[place] in recalled]
    taken = pairs[:1] if in_order and pairs else pairs or [place for place in closed if place not in recalled]
    return {place: 1 / len(taken) for place in taken}


def counted_out(
    forgetting: float, last: dict[int, int], flips: int, first: int | None, *, in_order: bool
) -> list[float]:
    """Return the chance of every next card by going through all sets of recalled cards, without lapses before."""
    closed = [place for place in range(6) if place != first]
    chances = [0.0] * 6
    total = 0.0
    for recalled in subsets(list(last)):
        weight = 1.0
        for place, at in last.items():
            kept = (1 - forgetting) ** (flips - at)
            weight *= kept if place in recalled else 1 - kept
        if first is None:
            choices = first_choices(recalled, closed, in_order=in_order)
        else:
            weight *= first_choices(recalled, list(range(6)), in_order=in_order).get(first, 0.0)
            new = [place for place in closed if place not in recalled]
            taken = [MATES[first]] if MATES[first] in recalled else new
            choices = {place: 1 / len(taken) for place in taken}
        total += weight
        for place, chance in choices.items():
            chances[place] += weight * chance
    return [chance / total for chance in chances]


@pytest.mark.parametrize("in_order", [True, False])
@pytest.mark.parametrize("first", [None, 0, 1, 4])
def test_the_chances_of_the_next_card_are_those_of_counting_out_all_that_may_be_recalled(
    monkeypatch: pytest.MonkeyPatch, first: int | None, *, in_order: bool
) -> None:
    """With one d, one habit and next to no lapses; places 0, 3, 1 and 5 have been seen."""
    monkeypatch.setattr("kiosk.assistance.memory_model.LAPSE", 1e-12)
    monkeypatch.setattr("kiosk.assistance.memory_model.FORGETTING", (0.3,))
    monkeypatch.setattr("kiosk.assistance.memory_model.READING", (in_order,))
    model = model_after(0, 3, 1, 5)
    if first is not None:
        model.flip(first)

    expected = counted_out(0.3, {0: 1, 3: 2, 1: 3, 5: 4}, 4, first, in_order=in_order)
    assert model.next_card() == pytest.approx(expected, abs=1e-6)


def test_before_the_first_flip_every_card_is_as_likely_and_nothing_is_recalled() -> None:
    """Nothing has been seen."""
    model = MemoryModel(MATES)

    assert model.next_card() == pytest.approx([1 / 6] * 6)
    assert (model.recall(), model.chance_to_match()) == ((0.0,) * 6, 0.0)


def test_a_card_is_recalled_for_certain_right_after_its_move_and_less_with_every_flip() -> None:
    """The card of the last flip has age 0."""
    fresh, older = model_after(0, 2).recall(), model_after(0, 2, 1, 4).recall()

    assert fresh[2] == 1.0
    assert 0 < older[0] < fresh[0] < 1


def test_found_cards_are_neither_recalled_nor_expected_again() -> None:
    """A pair that was found leaves the board."""
    model = model_after(0, 1)

    assert model.recall()[:2] == (0.0, 0.0)
    assert model.next_card()[:2] == (0.0, 0.0)


def test_a_player_who_misses_what_was_just_seen_is_taken_for_more_forgetful() -> None:
    """After 0 and 2, then 1: the mate of the open card is 0, seen three flips before."""
    known, missed = model_after(0, 2, 1, 0), model_after(0, 2, 1, 4)

    assert known.forgetting < model_after(0, 2, 1).forgetting < missed.forgetting


def test_flips_that_were_hinted_say_nothing_about_forgetting_but_are_seen() -> None:
    """A player who follows a hint need not remember."""
    helped = model_after(0, 2, 1, 0, hinted=(3,))

    assert helped.forgetting == model_after(0, 2, 1).forgetting
    assert model_after(0, 2, hinted=(0, 1)).recall() == pytest.approx(model_after(0, 2).recall(), abs=0.05)


def test_after_a_hinted_first_card_the_mate_is_as_likely_recalled_as_before() -> None:
    """The hint chose the card, so the choice says nothing about what is recalled."""
    model = model_after(0, 2, 1, 4)
    before = model.recall()[0]
    model.flip(1, hinted=True)

    assert model.chance_to_match() == pytest.approx(before)


@pytest.mark.parametrize("seed", range(3))
def test_the_chances_add_up_to_1_at_every_flip_of_any_game(seed: int) -> None:
    """On the whole board, hinted or not, whatever is turned up."""
    game = Concentration(Board.deal(4, 6, ANIMALS, Random(seed)))
    model, chance = MemoryModel.of(game), Random(seed)
    while not game.over:
        assert sum(model.next_card()) == pytest.approx(1)
        assert 0 <= model.chance_to_match() <= 1
        place = chance.choice([each for each in game.closed if each != game.first_card])
        assert model.next_card()[game.board.location(place)] >= LAPSE / 24
        model.flip(game.board.location(place), hinted=chance.random() < 0.2)
        game.flip(place)
        game.turn_back()
