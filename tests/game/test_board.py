"""A board holds every card twice, and chance alone says where."""

from __future__ import annotations

from collections import Counter
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kiosk.game import Board, Position
from tests.samples import ANIMALS, board_of

SHAPES = st.sampled_from([(4, 6), (6, 4), (2, 3), (1, 2), (4, 5)])


def arrangements(rows: int, columns: int, deals: int) -> Counter[tuple[str, ...]]:
    """How often each arrangement is dealt from the first so many seeds."""
    names = "abcdef"[: rows * columns // 2]
    return Counter(Board.deal(rows, columns, names, Random(seed)).cards for seed in range(deals))


def test_a_deal_lays_the_first_names_twice_each() -> None:
    board = Board.deal(2, 3, ["ant", "bee", "cow", "dog"], Random(1))
    assert Counter(board.cards) == {"ant": 2, "bee": 2, "cow": 2}
    assert (board.rows, board.columns, board.pairs) == (2, 3, 3)


def test_the_study_s_board_is_twelve_pairs_on_four_rows_of_six() -> None:
    board = Board.deal(4, 6, ANIMALS, Random(1))
    assert (len(board.cards), board.pairs, set(board.cards)) == (24, 12, set(ANIMALS))


def test_the_same_seed_deals_the_same_board() -> None:
    assert Board.deal(4, 6, ANIMALS, Random("7/deal")) == Board.deal(4, 6, ANIMALS, Random("7/deal"))


def test_two_seeds_deal_two_boards() -> None:
    assert Board.deal(4, 6, ANIMALS, Random(1)) != Board.deal(4, 6, ANIMALS, Random(2))


def test_a_seed_deals_the_same_board_for_ever() -> None:
    """Stored sessions are replayed from their seed: this board may not change with a later version."""
    assert "".join(Board.deal(4, 6, "abcdefghijkl", Random(7)).cards) == "cjlhdhlkdjgieaefbibakgcf"


def test_a_deal_draws_only_from_the_chance_it_is_given() -> None:
    rng = Random(3)
    boards = [Board.deal(4, 6, ANIMALS, rng) for _ in range(2)]
    again = Random(3)
    assert boards == [Board.deal(4, 6, ANIMALS, again) for _ in range(2)]
    assert boards[0] != boards[1]


def test_a_deal_is_fisher_and_yates_from_the_last_card_down() -> None:
    drawn = Random(5)
    cards = [name for name in "abc" for _ in range(2)]
    for last in (5, 4, 3, 2, 1):
        other = drawn.randrange(0, last + 1)
        cards[other], cards[last] = cards[last], cards[other]
    assert Board.deal(2, 3, "abc", Random(5)).cards == tuple(cards)


def test_every_arrangement_is_dealt_about_as_often_as_any_other() -> None:
    counts = arrangements(2, 2, 6 * 200)
    assert len(counts) == 6
    assert all(150 < count < 250 for count in counts.values()), counts


def test_every_arrangement_of_three_pairs_can_be_dealt() -> None:
    counts = arrangements(2, 3, 90 * 40)
    assert len(counts) == 90
    assert all(15 < count < 70 for count in counts.values()), counts


@pytest.mark.parametrize(
    ("rows", "columns", "names", "sentence"),
    [
        (4, 6, "abc", "a board of 4 x 6 needs 12 different cards, not 3"),
        (2, 2, "a", "a board of 2 x 2 needs 2 different cards, not 1"),
        (2, 2, "aa", "every card must lie on the board twice, but 'a' lies there 4 time"),
        (3, 3, "abcd", "a board of 3 x 3 needs 9 cards, not 8"),
    ],
)
def test_an_impossible_deal_is_refused_in_words(rows: int, columns: int, names: str, sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        Board.deal(rows, columns, names, Random(0))


@pytest.mark.parametrize(
    ("rows", "columns", "cards", "sentence"),
    [
        (2, 2, "aab", "a board of 2 x 2 needs 4 cards, not 3"),
        (2, 2, "aabbb", "a board of 2 x 2 needs 4 cards, not 5"),
        (2, 2, "abcc", "'a' lies there 1 time"),
        (2, 2, "aaaa", "'a' lies there 4 time"),
        (2, 3, "aaabbb", "'a' lies there 3 time"),
    ],
)
def test_cards_that_are_not_a_full_board_of_pairs_are_refused(
    rows: int, columns: int, cards: str, sentence: str
) -> None:
    with pytest.raises(ValueError, match=sentence):
        Board(rows, columns, tuple(cards))


def test_places_are_counted_row_by_row() -> None:
    board = board_of("abc", "cab")
    assert list(board) == [Position(row, column) for row in (0, 1) for column in (0, 1, 2)]
    assert [board.card(position) for position in board] == list("abccab")


@given(SHAPES, st.integers())
def test_a_place_and_its_number_say_the_same(shape: tuple[int, int], seed: int) -> None:
    board = Board.deal(*shape, ANIMALS, Random(seed))
    assert [board.location(position) for position in board] == list(range(len(board.cards)))
    assert [board.position(board.location(position)) for position in board] == list(board)


@given(SHAPES, st.integers())
def test_a_mate_is_the_other_place_of_the_same_card(shape: tuple[int, int], seed: int) -> None:
    board = Board.deal(*shape, ANIMALS, Random(seed))
    for position in board:
        mate = board.mate(position)
        assert mate != position
        assert board.card(mate) == board.card(position)
        assert board.mate(mate) == position


@pytest.mark.parametrize("place", [(0, 0), (1, 2), (0, 2), (1, 0)])
def test_a_corner_lies_on_the_board(place: tuple[int, int]) -> None:
    assert Position(*place) in board_of("abc", "cab")


@pytest.mark.parametrize("place", [(-1, 0), (0, -1), (2, 0), (0, 3), (2, 3), (-1, -1), (10**9, 0)])
def test_a_place_beyond_an_edge_does_not(place: tuple[int, int]) -> None:
    assert Position(*place) not in board_of("abc", "cab")
