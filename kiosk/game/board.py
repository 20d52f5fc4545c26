"""A dealt board: which card lies where. It never changes once dealt; what has been turned lives elsewhere."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from random import Random

CARDS_IN_A_PAIR = 2


@dataclass(frozen=True, order=True, slots=True)
class Position:
    """A place on the board, counted from 0; people are told rows and columns from 1."""

    row: int
    column: int


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
        return (self.position(location) for location in range(len(self.cards)))

    def position(self, location: int) -> Position:
        """Place number ``location``, counted row by row from 0."""
        return Position(*divmod(location, self.columns))

    def location(self, position: Position) -> int:
        """The number of a place, counted row by row from 0."""
        return position.row * self.columns + position.column

    def card(self, position: Position) -> str:
        """The name of the card that lies at ``position``."""
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
