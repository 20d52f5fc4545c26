"""The gate keeps the assistant from speaking too early; each of its three numbers can be switched off."""

from __future__ import annotations

from typing import Any

import pytest

from kiosk.assistance.policy import NO_GATE, Gate, GateDecision
from kiosk.game import Board, Concentration
from tests.samples import ANIMALS

OPEN, OPENING, DOING_WELL, STILL_EXPLORING = GateDecision


def game_after(failed: int, since_match: int | None = None) -> Concentration:
    """Return a game with so many flips of failed moves, and, if asked, a match after them and so many flips since."""
    game = Concentration(Board(4, 6, (*ANIMALS, *ANIMALS)))
    fail(game, failed)
    if since_match is not None:
        if game.first_card is None:
            game.flip(game.closed[0])
        assert game.first_card is not None
        game.flip(game.board.mate(game.first_card))
        fail(game, since_match)
    return game


def fail(game: Concentration, flips: int) -> None:
    """Flip the first two closed cards over and over; their mates lie two rows below."""
    for _ in range(flips):
        game.flip(game.closed[0])
        game.turn_back()


@pytest.mark.parametrize(
    ("flips", "verdict"),
    [
        (0, OPENING),
        (1, OPENING),
        (4, OPENING),
        (5, OPENING),
        (6, STILL_EXPLORING),
        (7, OPEN),
        (8, STILL_EXPLORING),
        (9, OPEN),
        (10, OPEN),
        (11, OPEN),
        (12, OPEN),
    ],
)
def test_while_no_pair_is_found_a_first_card_waits_for_ten_flips(flips: int, verdict: GateDecision) -> None:
    assert Gate().decide(game_after(flips)) is verdict


@pytest.mark.parametrize(
    ("since_match", "verdict"),
    [(0, DOING_WELL), (1, OPEN), (2, DOING_WELL), (3, OPEN), (4, OPEN), (5, OPEN), (6, OPEN)],
)
def test_after_a_match_a_first_card_waits_for_four_flips(since_match: int, verdict: GateDecision) -> None:
    assert Gate().decide(game_after(8, since_match)) is verdict


@pytest.mark.parametrize(("since_match", "verdict"), [(0, OPENING), (3, OPENING), (4, OPEN)])
def test_a_match_among_the_first_flips_does_not_open_the_gate(since_match: int, verdict: GateDecision) -> None:
    assert Gate().decide(game_after(0, since_match)) is verdict


@pytest.mark.parametrize("flips", range(13))
def test_without_a_gate_the_table_is_always_asked(flips: int) -> None:
    assert NO_GATE.decide(game_after(flips)) is OPEN
    assert NO_GATE.decide(game_after(4, flips)) is OPEN


@pytest.mark.parametrize(
    ("gate", "game", "verdict"),
    [
        (Gate(opening=0), (0,), STILL_EXPLORING),
        (Gate(opening=0), (1,), OPEN),
        (Gate(opening=0), (0, 0), DOING_WELL),
        (Gate(opening=0), (10,), OPEN),
        (Gate(patience=0), (8, 0), OPEN),
        (Gate(patience=0), (4,), OPENING),
        (Gate(patience=0), (8,), STILL_EXPLORING),
        (Gate(first_patience=0), (6,), OPEN),
        (Gate(first_patience=0), (5,), OPENING),
        (Gate(first_patience=0), (8, 2), DOING_WELL),
    ],
)
def test_each_number_can_be_switched_off_alone(gate: Gate, game: tuple[int, ...], verdict: GateDecision) -> None:
    assert gate.decide(game_after(*game)) is verdict


@pytest.mark.parametrize(
    ("gate", "game", "verdict"),
    [
        (Gate(opening=8), (7,), OPENING),
        (Gate(opening=8), (9,), OPEN),
        (Gate(patience=6), (8, 4), DOING_WELL),
        (Gate(patience=6), (8, 6), OPEN),
        (Gate(first_patience=6), (6,), OPEN),
        (Gate(first_patience=14), (12,), STILL_EXPLORING),
        (Gate(first_patience=14), (14,), OPEN),
    ],
)
def test_other_numbers_move_the_boundaries(gate: Gate, game: tuple[int, ...], verdict: GateDecision) -> None:
    assert gate.decide(game_after(*game)) is verdict


@pytest.mark.parametrize("name", ["opening", "patience", "first_patience"])
def test_a_number_of_flips_below_zero_is_refused(name: str) -> None:
    with pytest.raises(ValueError, match=f"gate: {name} must be 0 or more flips, not -1"):
        Gate(**{name: -1})


@pytest.mark.parametrize("flips", [2.5, float("nan"), "6", None, True])
def test_what_is_no_whole_number_of_flips_is_refused(flips: Any) -> None:
    with pytest.raises(ValueError, match="gate: patience must be a whole number of flips, not "):
        Gate(patience=flips)


def test_only_an_open_gate_is_open() -> None:
    assert [verdict.is_open for verdict in GateDecision] == [True, False, False, False]


def test_the_released_program_s_numbers_are_the_default() -> None:
    assert (Gate().opening, Gate().patience, Gate().first_patience) == (6, 4, 10)
