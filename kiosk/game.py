"""Concentration, the memory game: board, flips, pairs and the history of what was seen."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from enum import Enum
from functools import cache, cached_property
from random import Random

CARDS_IN_A_PAIR = 2


@dataclass(frozen=True, order=True, slots=True)
class Position:
    """A place on the board, counted from 0; people are told rows and columns from 1."""

    row: int
    column: int


@cache
def _places(rows: int, columns: int) -> tuple[Position, ...]:
    """Return every place of a board of this size, row by row."""
    return tuple(Position(row, column) for row in range(rows) for column in range(columns))


@dataclass(frozen=True)
class Board:
    """Cards on ``rows`` x ``columns`` places, row by row; every card name lies there exactly twice."""

    rows: int
    columns: int
    cards: tuple[str, ...]

    def __post_init__(self) -> None:
        """Refuse, with a ValueError that says what is wrong, whatever is not a full board of pairs."""
        if len(self.cards) != self.rows * self.columns:
            raise ValueError(
                f"a board of {self.rows} x {self.columns} needs {self.rows * self.columns} cards, not {len(self.cards)}"
            )
        odd = {name: count for name, count in Counter(self.cards).items() if count != CARDS_IN_A_PAIR}
        if odd:
            name, count = next(iter(odd.items()))
            raise ValueError(f"every card must lie on the board twice, but {name!r} lies there {count} time(s)")

    @classmethod
    def deal(cls, rows: int, columns: int, names: Sequence[str], rng: Random) -> Board:
        """Deal the first ``rows * columns / 2`` names, twice each, shuffled by ``rng`` (Fisher-Yates).

        Raises ValueError when there are too few names, or a name stands twice.
        """
        pairs = rows * columns // CARDS_IN_A_PAIR
        if len(names) < pairs:
            raise ValueError(f"a board of {rows} x {columns} needs {pairs} different cards, not {len(names)}")
        cards = [name for name in names[:pairs] for _ in range(CARDS_IN_A_PAIR)]
        for last in range(len(cards) - 1, 0, -1):
            other = rng.randrange(last + 1)
            cards[last], cards[other] = cards[other], cards[last]
        return cls(rows, columns, tuple(cards))

    @property
    def pairs(self) -> int:
        """How many pairs lie on the board."""
        return len(self.cards) // CARDS_IN_A_PAIR

    def __contains__(self, position: Position) -> bool:
        """Whether this place lies on the board."""
        return 0 <= position.row < self.rows and 0 <= position.column < self.columns

    def __iter__(self) -> Iterator[Position]:
        """Every place, row by row."""
        return iter(_places(self.rows, self.columns))

    def position(self, location: int) -> Position:
        """Place number ``location``, counted row by row from 0."""
        return Position(*divmod(location, self.columns))

    def location(self, position: Position) -> int:
        """Return the number of a place, counted row by row from 0."""
        return position.row * self.columns + position.column

    def card(self, position: Position) -> str:
        """Return the name of the card that lies at ``position``."""
        return self.cards[self.location(position)]

    def mate(self, position: Position) -> Position:
        """Where the other card of the same pair lies."""
        return self._mates[position]

    @cached_property
    def _mates(self) -> dict[Position, Position]:
        first: dict[str, Position] = {}
        mates: dict[Position, Position] = {}
        for position in self:
            other = first.setdefault(self.card(position), position)
            if other != position:
                mates[position], mates[other] = other, position
        return mates


@dataclass
class History:
    """The player's flips so far; flip numbers count from 1."""

    _counts: Counter[Position] = field(default_factory=Counter)
    _last: dict[Position, int] = field(default_factory=dict)
    flips: int = 0

    def record(self, position: Position) -> None:
        """Take down one more flip, of the card at ``position``."""
        self.flips += 1
        self._counts[position] += 1
        self._last[position] = self.flips

    def count(self, position: Position) -> int:
        """How many times the card at ``position`` was turned up."""
        return self._counts.get(position, 0)

    def last(self, position: Position) -> int:
        """Return the number of the last flip of the card at ``position``, or 0 if it was never turned up."""
        return self._last.get(position, 0)


class FlipRejection(Enum):
    """Why a flip is not allowed."""

    OUTSIDE = "outside the board"
    FOUND = "already found"
    OPEN = "already open"
    TURNING_BACK = "two cards are still turning back"


class IllegalFlip(Exception):
    """A flip that the rules do not allow; the game is as it was."""

    def __init__(self, position: Position, refusal: FlipRejection) -> None:
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
        self._closed: tuple[Position, ...] | None = None

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
        if self._closed is None:
            self._closed = tuple(p for p in self.board if p not in self.found and p not in self._open)
        return self._closed

    def flip(self, position: Position) -> Flip:
        """Turn one card up and say what came of it; raises IllegalFlip and changes nothing if it may not be."""
        refusal = self._refusal(position)
        if refusal is not None:
            raise IllegalFlip(position, refusal)
        self.history.record(position)
        self._closed = None
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
            self._closed = None

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

    def _refusal(self, position: Position) -> FlipRejection | None:
        if position not in self.board:
            return FlipRejection.OUTSIDE
        if self.turning_back:
            return FlipRejection.TURNING_BACK
        if position in self.found:
            return FlipRejection.FOUND
        if position in self._open:
            return FlipRejection.OPEN
        return None
