"""The history knows how often and when last every card was turned up, and nothing else."""

from __future__ import annotations

from kiosk.game import Concentration, History, IllegalFlip, Position
from tests.samples import board_of

HERE, THERE, NOWHERE = Position(0, 0), Position(1, 1), Position(9, 9)


def test_a_card_that_was_never_turned_up_counts_nothing() -> None:
    history = History()
    assert (history.count(HERE), history.last(HERE), history.flips) == (0, 0, 0)


def test_every_flip_is_counted_where_it_was_made() -> None:
    history = History()
    for position in (HERE, THERE, HERE):
        history.record(position)
    assert history.flips == 3
    assert (history.count(HERE), history.last(HERE)) == (2, 3)
    assert (history.count(THERE), history.last(THERE)) == (1, 2)


def test_asking_changes_nothing() -> None:
    history = History()
    history.count(NOWHERE)
    history.last(NOWHERE)
    assert history == History()


def test_two_games_have_two_histories() -> None:
    one, other = Concentration(board_of("ab", "ba")), Concentration(board_of("ab", "ba"))
    one.flip(HERE)
    assert other.history.count(HERE) == 0


def test_a_game_remembers_flips_and_forgets_refusals() -> None:
    game = Concentration(board_of("ab", "ba"))
    game.flip(HERE)
    try:
        game.flip(HERE)
    except IllegalFlip:
        game.flip(THERE)
    assert (game.history.count(HERE), game.history.count(THERE), game.history.flips) == (1, 1, 2)


def test_found_cards_stay_in_the_history() -> None:
    game = Concentration(board_of("ab", "ba"))
    game.flip(HERE)
    game.flip(THERE)
    assert game.found == {HERE, THERE}
    assert (game.history.last(HERE), game.history.last(THERE)) == (1, 2)
