"""The mentaliser points where the rules of the paper say, whatever has been played."""

from __future__ import annotations

from collections.abc import Iterable
from random import Random

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from kiosk.assistance.mentaliser import HintReason, Mentaliser, TargetRule
from kiosk.assistance.policy import FlipInMove
from kiosk.game import Board, Concentration, IllegalFlip, Position
from tests.samples import ANIMALS, board_of

TAPS = st.lists(st.integers(0, 23), max_size=60)
SEEDS = st.integers(0, 2**32)
MENTALISED = [TargetRule.MOST_FLIPPED, TargetRule.MOST_RECENT]


def played(board: Board, taps: Iterable[int]) -> tuple[Concentration, list[Position]]:
    """Return a game in which these places were tapped, and its flips.

    Taps that are not allowed are left out, and some card stays closed.
    """
    game, flips = Concentration(board), []
    for tap in taps:
        if len(game.found) >= len(board.cards) - 2:
            break
        try:
            flips.append(game.flip(board.position(tap % len(board.cards))).position)
        except IllegalFlip:
            continue
        game.turn_back()
    return game, flips


def specified(rule: TargetRule, game: Concentration, flips: list[Position]) -> set[Position]:
    """Where a hint may point: section 4 of the design, from the bare list of flips."""
    mate = game.board.mate
    if game.first_card is not None:
        return {mate(game.first_card)}
    unfound = [position for position in game.board if position not in game.found]
    seen = [position for position in flips if position in unfound]
    if rule is TargetRule.RANDOM or not seen:
        return set(unfound)
    if rule is TargetRule.MOST_RECENT:
        return {mate(seen[-1])}
    most = max(seen.count(position) for position in unfound)
    return {mate(position) for position in unfound if seen.count(position) == most}


@pytest.mark.parametrize("rule", TargetRule)
@given(SEEDS, TAPS)
@example(1, [])
@example(1, [0, 1, 0, 2, 0])
def test_the_candidates_are_those_that_the_rule_names(rule: TargetRule, seed: int, taps: list[int]) -> None:
    game, flips = played(Board.deal(4, 6, ANIMALS, Random(seed)), taps)
    target = Mentaliser(rule, Random(seed)).target(game)
    assert set(target.candidates) == specified(rule, game, flips)
    assert len(set(target.candidates)) == len(target.candidates)
    assert target.position in target.candidates


@pytest.mark.parametrize("rule", TargetRule)
@given(SEEDS, st.lists(st.integers(0, 5), max_size=20))
def test_small_boards_follow_the_same_rules(rule: TargetRule, seed: int, taps: list[int]) -> None:
    game, flips = played(Board.deal(2, 3, ANIMALS, Random(seed)), taps)
    target = Mentaliser(rule, Random(seed)).target(game)
    assert set(target.candidates) == specified(rule, game, flips)


@pytest.mark.parametrize("rule", TargetRule)
@given(SEEDS, TAPS)
def test_the_target_can_be_flipped_and_comes_with_its_true_counts(rule: TargetRule, seed: int, taps: list[int]) -> None:
    game, flips = played(Board.deal(4, 6, ANIMALS, Random(seed)), taps)
    target = Mentaliser(rule, Random(seed)).target(game)
    assert target.position in game.closed
    assert target.mate == game.board.mate(target.position)
    assert target.seen == flips.count(target.position)
    assert target.mate_seen == flips.count(target.mate)
    assert target.reason is HintReason.of(FlipInMove.coming(game), target.mate_seen, target.seen)


@given(SEEDS, TAPS)
def test_the_paper_s_rule_points_to_the_less_visited_of_the_two(seed: int, taps: list[int]) -> None:
    game, _ = played(Board.deal(4, 6, ANIMALS, Random(seed)), taps)
    if game.first_card is None:
        target = Mentaliser(TargetRule.MOST_FLIPPED, Random(seed)).target(game)
        assert target.seen <= target.mate_seen


@pytest.mark.parametrize("rule", TargetRule)
@given(SEEDS, TAPS)
def test_a_second_card_is_always_the_mate_of_the_open_one(rule: TargetRule, seed: int, taps: list[int]) -> None:
    game, _ = played(Board.deal(4, 6, ANIMALS, Random(seed)), taps)
    if game.first_card is None:
        game.flip(game.closed[seed % len(game.closed)])
    assert game.first_card is not None
    target = Mentaliser(rule, Random(seed)).target(game)
    assert target.candidates == (target.position,) == (game.board.mate(game.first_card),)
    assert target.mate == game.first_card
    assert target.mate_seen >= 1


@pytest.mark.parametrize("rule", TargetRule)
def test_every_candidate_can_be_chosen(rule: TargetRule) -> None:
    game, flips = played(Board(2, 4, tuple("abcdabcd")), [0, 1, 4, 5])
    del flips
    chosen = {Mentaliser(rule, Random(seed)).target(game).position for seed in range(60)}
    assert chosen == set(Mentaliser(rule, Random(0)).target(game).candidates)


@pytest.mark.parametrize("rule", TargetRule)
def test_the_same_chance_chooses_the_same_targets(rule: TargetRule) -> None:
    game = Concentration(Board.deal(4, 6, ANIMALS, Random(1)))
    one, other = Mentaliser(rule, Random(9)), Mentaliser(rule, Random(9))
    assert [one.target(game) for _ in range(20)] == [other.target(game) for _ in range(20)]


@pytest.mark.parametrize("rule", TargetRule)
def test_looking_for_a_target_changes_nothing_in_the_game(rule: TargetRule) -> None:
    game, _ = played(Board.deal(4, 6, ANIMALS, Random(1)), [0, 1, 2])
    before = (game.flips, game.closed, game.first_card, [game.history.count(position) for position in game.board])
    Mentaliser(rule, Random(9)).target(game)
    after = (game.flips, game.closed, game.first_card, [game.history.count(position) for position in game.board])
    assert after == before


# The rules by example, on the board
#   a b c
#   c a b


@pytest.mark.parametrize("rule", MENTALISED)
def test_while_nothing_was_flipped_any_closed_card_will_do(rule: TargetRule) -> None:
    game = Concentration(board_of("abc", "cab"))
    assert Mentaliser(rule, Random(1)).target(game).candidates == tuple(game.board)


@pytest.mark.parametrize("rule", MENTALISED)
def test_what_is_found_is_forgotten(rule: TargetRule) -> None:
    game, _ = played(board_of("abc", "cab"), [0, 4])
    assert game.pairs_found == 1
    assert set(Mentaliser(rule, Random(1)).target(game).candidates) == set(game.closed)


def test_the_paper_s_rule_points_to_the_mate_of_the_card_flipped_most() -> None:
    game, _ = played(board_of("abc", "cab"), [0, 1, 0, 5])
    target = Mentaliser(TargetRule.MOST_FLIPPED, Random(1)).target(game)
    assert (target.position, target.mate, target.seen, target.mate_seen) == (Position(1, 1), Position(0, 0), 0, 2)
    assert target.reason is HintReason.OFTEN_AND_NEVER


def test_the_other_rule_points_to_the_mate_of_the_card_flipped_last() -> None:
    game, _ = played(board_of("abc", "cab"), [0, 1, 0, 2])
    target = Mentaliser(TargetRule.MOST_RECENT, Random(1)).target(game)
    assert (target.position, target.candidates) == (Position(1, 0), (Position(1, 0),))
    assert target.reason is HintReason.ONE_SEEN_ONCE


def test_two_cards_of_a_pair_flipped_equally_often_are_either() -> None:
    game, _ = played(board_of("abc", "cab"), [0, 1, 4, 2, 0, 1, 4, 2])
    assert [game.history.count(position) for position in game.board] == [2, 2, 2, 0, 2, 0]
    candidates = Mentaliser(TargetRule.MOST_FLIPPED, Random(1)).target(game).candidates
    assert set(candidates) == {Position(1, 1), Position(1, 2), Position(1, 0), Position(0, 0)}
