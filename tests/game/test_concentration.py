"""The rules: one flip at a time, two flips a move, and an illegal flip changes nothing."""

from __future__ import annotations

from copy import deepcopy
from typing import Any

import pytest

from kiosk.game import Concentration, Flip, FlipRejection, IllegalFlip, Position
from tests.samples import board_of

A, B, C = Position(0, 0), Position(0, 1), Position(0, 2)
C2, A2, B2 = Position(1, 0), Position(1, 1), Position(1, 2)


@pytest.fixture
def game() -> Concentration:
    """Return a small game: abc over cab."""
    return Concentration(board_of("abc", "cab"))


def everything(game: Concentration) -> dict[str, Any]:
    """All there is to know about a game."""
    return deepcopy(vars(game))


def refusal(game: Concentration, position: Position) -> IllegalFlip:
    """Try an illegal flip, see that the game is as it was, and return the refusal."""
    before = everything(game)
    with pytest.raises(IllegalFlip) as refused:
        game.flip(position)
    assert everything(game) == before
    return refused.value


def test_a_game_begins_with_every_card_closed(game: Concentration) -> None:
    assert game.closed == tuple(game.board)
    assert (game.flips, game.moves, game.pairs_found, game.flips_since_match) == (0, 0, 0, 0)
    assert (game.first_card, game.turning_back, game.found, game.last_move_matched) == (None, (), frozenset(), None)
    assert not game.over


def test_a_first_flip_opens_one_card_and_waits(game: Concentration) -> None:
    assert game.flip(B) == Flip(number=1, move=1, position=B, card="b", matched=None)
    assert game.first_card == B
    assert game.closed == (A, C, C2, A2, B2)
    assert (game.flips, game.moves, game.last_move_matched) == (1, 0, None)


def test_two_cards_alike_are_a_pair_and_stay_open(game: Concentration) -> None:
    game.flip(A)
    assert game.flip(A2) == Flip(number=2, move=1, position=A2, card="a", matched=True)
    assert game.found == {A, A2}
    assert (game.first_card, game.turning_back) == (None, ())
    assert (game.moves, game.pairs_found, game.flips_since_match, game.last_move_matched) == (1, 1, 0, True)
    assert game.closed == (B, C, C2, B2)


def test_two_different_cards_are_shown_until_they_turn_back(game: Concentration) -> None:
    game.flip(A)
    assert game.flip(B) == Flip(number=2, move=1, position=B, card="b", matched=False)
    assert (game.turning_back, game.first_card) == ((A, B), None)
    assert (game.moves, game.pairs_found, game.flips_since_match, game.last_move_matched) == (1, 0, 2, False)
    assert game.closed == (C, C2, A2, B2)
    game.turn_back()
    assert game.turning_back == ()
    assert game.closed == tuple(game.board)
    assert game.last_move_matched is False


def test_flips_and_moves_are_counted_from_one(game: Concentration) -> None:
    numbers = []
    for position in (A, B, A, A2, C):
        flip = game.flip(position)
        numbers.append((flip.number, flip.move, flip.matched))
        game.turn_back()
    assert numbers == [(1, 1, None), (2, 1, False), (3, 2, None), (4, 2, True), (5, 3, None)]


def test_turning_back_leaves_a_lone_first_card_open(game: Concentration) -> None:
    game.flip(A)
    before = everything(game)
    game.turn_back()
    assert everything(game) == before


def test_turning_back_leaves_a_pair_found(game: Concentration) -> None:
    game.flip(A)
    game.flip(A2)
    before = everything(game)
    game.turn_back()
    assert everything(game) == before


def test_flips_since_the_last_match_count_from_that_match(game: Concentration) -> None:
    for position in (A, B, A, A2, C):
        game.flip(position)
        game.turn_back()
    assert (game.flips, game.last_match, game.flips_since_match) == (5, 4, 1)


def test_a_game_is_over_when_every_pair_is_found(game: Concentration) -> None:
    for position in (A, A2, B, B2, C):
        game.flip(position)
        assert not game.over
    game.flip(C2)
    assert game.over
    assert (game.closed, game.pairs_found, game.moves) == ((), 3, 3)


def test_a_card_that_is_open_may_not_be_flipped(game: Concentration) -> None:
    game.flip(A)
    refused = refusal(game, A)
    assert refused.refusal is FlipRejection.OPEN
    assert str(refused) == "the card at row 1, column 1 may not be flipped: already open"


def test_a_card_that_is_found_may_not_be_flipped(game: Concentration) -> None:
    game.flip(A)
    game.flip(A2)
    refused = refusal(game, A2)
    assert (refused.refusal, refused.position) == (FlipRejection.FOUND, A2)
    assert str(refused) == "the card at row 2, column 2 may not be flipped: already found"


@pytest.mark.parametrize("place", [(2, 0), (0, 3), (-1, 0), (0, -1)])
def test_a_place_outside_the_board_may_not_be_flipped(game: Concentration, place: tuple[int, int]) -> None:
    assert refusal(game, Position(*place)).refusal is FlipRejection.OUTSIDE


@pytest.mark.parametrize("position", [A, B, C, B2])
def test_no_card_may_be_flipped_while_two_are_turning_back(game: Concentration, position: Position) -> None:
    game.flip(A)
    game.flip(B)
    assert refusal(game, position).refusal is FlipRejection.TURNING_BACK


def test_outside_is_outside_whatever_else_is_going_on(game: Concentration) -> None:
    game.flip(A)
    game.flip(B)
    assert refusal(game, Position(9, 9)).refusal is FlipRejection.OUTSIDE


def test_an_illegal_second_flip_leaves_the_move_open_to_a_legal_one(game: Concentration) -> None:
    game.flip(A)
    refusal(game, A)
    assert game.flip(A2).matched is True
