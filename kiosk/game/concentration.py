"""The rules of Concentration: one flip at a time, two flips a move, a move that matches keeps its cards open.

An illegal flip raises and changes nothing. Turning back two unmatched cards is a step of its own, because between
the second flip and that step the player looks at them and may not flip.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from kiosk.game.board import CARDS_IN_A_PAIR, Board, Position
from kiosk.game.history import History


class Refusal(Enum):
    """Why a flip is not allowed."""

    OUTSIDE = "outside the board"
    FOUND = "already found"
    OPEN = "already open"
    TURNING_BACK = "two cards are still turning back"


class IllegalFlip(Exception):
    """A flip that the rules do not allow; the game is as it was."""

    def __init__(self, position: Position, refusal: Refusal) -> None:
        """Say which card may not be flipped, and why."""
        place = f"row {position.row + 1}, column {position.column + 1}"
        super().__init__(f"the card at {place} may not be flipped: {refusal.value}")
        self.position = position
        self.refusal = refusal


@dataclass(frozen=True, slots=True)
class Flip:
    """One card turned up. ``number`` and ``move`` count from 1; ``matched`` is None for the first card of a move."""

    number: int
    move: int
    position: Position
    card: str
    matched: bool | None


class Concentration:
    """One game on one board."""

    def __init__(self, board: Board) -> None:
        """Start with every card closed."""
        self.board = board
        self.history = History()
        self.found: frozenset[Position] = frozenset()
        self.last_match = 0
        self.last_move_matched: bool | None = None
        self._open: tuple[Position, ...] = ()

    @property
    def flips(self) -> int:
        """Flips so far."""
        return self.history.flips

    @property
    def moves(self) -> int:
        """Completed moves so far, of two flips each."""
        return self.flips // CARDS_IN_A_PAIR

    @property
    def pairs_found(self) -> int:
        """Pairs found so far."""
        return len(self.found) // CARDS_IN_A_PAIR

    @property
    def flips_since_match(self) -> int:
        """Flips since the last match, or since the start while there is none."""
        return self.flips - self.last_match

    @property
    def over(self) -> bool:
        """Whether every pair has been found."""
        return len(self.found) == len(self.board.cards)

    @property
    def first_card(self) -> Position | None:
        """The open first card of a move that waits for its second flip, if there is one."""
        return self._open[0] if len(self._open) == 1 else None

    @property
    def turning_back(self) -> tuple[Position, ...]:
        """The two unmatched cards that are still shown, if there are any."""
        return self._open if len(self._open) == CARDS_IN_A_PAIR else ()

    @property
    def closed(self) -> tuple[Position, ...]:
        """Every place whose card may be flipped once no cards are turning back, row by row."""
        return tuple(p for p in self.board if p not in self.found and p not in self._open)

    def flip(self, position: Position) -> Flip:
        """Turn one card up and say what came of it; raises IllegalFlip and changes nothing if it may not be."""
        refusal = self._refusal(position)
        if refusal is not None:
            raise IllegalFlip(position, refusal)
        self.history.record(position)
        card = self.board.card(position)
        move = (self.flips + 1) // 2
        if self.first_card is None:
            self._open = (position,)
            return Flip(self.flips, move, position, card, None)
        return Flip(self.flips, move, position, card, self._complete_move(position))

    def turn_back(self) -> None:
        """Close the two unmatched cards, if two are shown; the next flip may come."""
        if self.turning_back:
            self._open = ()

    def _complete_move(self, second: Position) -> bool:
        first = self._open[0]
        matched = self.board.mate(first) == second
        if matched:
            self.found |= {first, second}
            self.last_match = self.flips
            self._open = ()
        else:
            self._open = (first, second)
        self.last_move_matched = matched
        return matched

    def _refusal(self, position: Position) -> Refusal | None:
        if position not in self.board:
            return Refusal.OUTSIDE
        if self.turning_back:
            return Refusal.TURNING_BACK
        if position in self.found:
            return Refusal.FOUND
        if position in self._open:
            return Refusal.OPEN
        return None
