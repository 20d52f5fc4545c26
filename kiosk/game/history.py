"""What a player has been shown: for every place, how often it was turned up and when last. It never forgets."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field

from kiosk.game.board import Position


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
        return self._counts[position]

    def last(self, position: Position) -> int:
        """The number of the last flip of the card at ``position``, or 0 if it was never turned up."""
        return self._last.get(position, 0)
