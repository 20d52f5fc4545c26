"""Whatever is tapped in whatever order, the rules hold."""

from __future__ import annotations

from copy import deepcopy
from random import Random

import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, precondition, rule

from kiosk.game import Board, Concentration, FlipRejection, IllegalFlip, Position
from tests.samples import ANIMALS

NEAR = st.builds(Position, st.integers(-1, 4), st.integers(-1, 6))
FAR = st.builds(Position, st.integers(), st.integers())


class AnyGame(RuleBasedStateMachine):
    """A game beside a plain account of it: which cards lie open, which are found, and every flip made."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[Position] = []
        self.found: set[Position] = set()
        self.flipped: list[Position] = []
        self.since_match = 0
        self.matched: bool | None = None

    @initialize(seed=st.integers(), shape=st.sampled_from([(4, 6), (2, 3), (1, 4)]))
    def deal(self, seed: int, shape: tuple[int, int]) -> None:
        self.game = Concentration(Board.deal(*shape, ANIMALS, Random(seed)))

    def why_not(self, position: Position) -> FlipRejection | None:
        """Return the rules once more, in the order in which a person would explain them."""
        board = self.game.board
        if not (position.row in range(board.rows) and position.column in range(board.columns)):
            return FlipRejection.OUTSIDE
        if len(self.open) == 2:
            return FlipRejection.TURNING_BACK
        if position in self.found:
            return FlipRejection.FOUND
        return FlipRejection.OPEN if position in self.open else None

    @rule(position=NEAR | FAR)
    def flip(self, position: Position) -> None:
        why_not = self.why_not(position)
        if why_not is None:
            self.take_down(position)
            return
        before = deepcopy(vars(self.game))
        with pytest.raises(IllegalFlip) as refused:
            self.game.flip(position)
        assert refused.value.refusal is why_not
        assert vars(self.game) == before

    @precondition(lambda self: len(self.open) == 1)
    @rule()
    def flip_the_mate(self) -> None:
        self.take_down(self.game.board.mate(self.open[0]))

    def take_down(self, position: Position) -> None:
        flip = self.game.flip(position)
        self.flipped.append(position)
        self.open.append(position)
        self.since_match += 1
        assert (flip.number, flip.position) == (len(self.flipped), position)
        assert flip.move == (len(self.flipped) - 1) // 2 + 1
        if len(self.open) == 1:
            assert flip.matched is None
            return
        first, second = self.open
        self.matched = self.game.board.card(first) == self.game.board.card(second)
        assert flip.matched is self.matched
        if self.matched:
            self.found |= {first, second}
            self.open.clear()
            self.since_match = 0

    @rule()
    def turn_back(self) -> None:
        self.game.turn_back()
        if len(self.open) == 2:
            self.open.clear()

    @invariant()
    def the_game_agrees_with_the_account(self) -> None:
        game = self.game
        assert game.found == self.found
        assert (game.first_card, game.turning_back) == (
            self.open[0] if len(self.open) == 1 else None,
            tuple(self.open) if len(self.open) == 2 else (),
        )
        assert game.last_move_matched is self.matched
        assert game.flips_since_match == self.since_match
        assert set(game.closed) == set(game.board) - self.found - set(self.open)

    @invariant()
    def numbers_add_up(self) -> None:
        game = self.game
        assert len(game.found) % 2 == 0
        assert game.flips == len(self.flipped) == sum(game.history.count(position) for position in game.board)
        assert game.moves == len(self.flipped) // 2
        assert game.pairs_found == len(self.found) // 2
        assert game.over == (game.pairs_found == game.board.pairs)
        for position in game.board:
            assert game.history.count(position) == self.flipped.count(position)
            assert game.history.last(position) == max(
                (number for number, flipped in enumerate(self.flipped, 1) if flipped == position), default=0
            )


TestAnyGame = AnyGame.TestCase
TestAnyGame.settings = settings(max_examples=60, stateful_step_count=60, deadline=None)
