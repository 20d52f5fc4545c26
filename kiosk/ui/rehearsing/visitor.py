"""A simulated visitor: looks at the screen, remembers some of it, and says which card it would turn next.

It sees what anybody in front of the window sees. Much like the memory player of the learning layer, it recalls every
card with (1 - forgetting) ^ age, drawn anew for every move, the age in flips since the card was last in sight.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from random import Random

from kiosk.game import Position
from kiosk.study.events import Stage

FORGETTING = 0.15
FOLLOWING = 0.9
"""How often it follows a hint; the study's people did in .86 (noToM) and .92 (ToM) of the cases."""
THINKING_MS = (500, 1_600)


class Manner(Enum):
    """What kind of visitor it is."""

    COMPLETES = "completes"
    """Agrees, answers everything, and stays to the end."""
    DECLINES = "declines"
    """Plays without taking part."""
    UNDER_AGE = "under age"
    """Agrees, but is too young."""
    LEAVES = "leaves"
    """Walks away in some stage, without a word."""
    HASTY = "hasty"
    """Clicks twice, taps everywhere, and skips all that can be skipped."""


@dataclass(frozen=True)
class Character:
    """A visitor's manner, where one who leaves does so, and the language they choose: by default the study's first."""

    manner: Manner = Manner.COMPLETES
    leaves_in: Stage = Stage.GAME
    language: str = ""


@dataclass(frozen=True)
class View:
    """What can be seen of an open board: the closed cards, the picture of the first card if one is up, and the mark."""

    closed: tuple[Position, ...]
    first: str | None
    mark_row: int | None
    mark_column: int | None

    @property
    def marked(self) -> tuple[Position, ...]:
        """The closed cards that the mark leaves to choose from; none without a mark."""
        if self.mark_row is None and self.mark_column is None:
            return ()
        return tuple(p for p in self.closed if self.mark_row in (None, p.row) and self.mark_column in (None, p.column))


class Visitor:
    """One visitor, for one sitting; everything it does follows from ``rng`` and what it sees."""

    def __init__(self, rng: Random) -> None:
        """Remember nothing yet."""
        self._rng = rng
        self._seen: dict[Position, tuple[str, int]] = {}
        self._recalled: dict[Position, str] = {}
        self._flips = 0

    def think(self) -> int:
        """How long it thinks before it clicks, in ms."""
        return self._rng.randint(*THINKING_MS)

    def tosses(self) -> bool:
        """Whether a coin it tosses falls on its right side."""
        return self._rng.random() < 1 / 2

    def sit_down(self) -> None:
        """Begin with a board that nothing is known of."""
        self._seen.clear()
        self._recalled = {}
        self._flips = 0

    def choose(self, view: View) -> Position:
        """The closed card that it turns next."""
        if view.first is None:
            self._recalled = self._recall()
        self._flips += 1
        recalled = {position: picture for position, picture in self._recalled.items() if position in view.closed}
        choice = view.marked if view.marked and self._rng.random() < FOLLOWING else view.closed
        wanted = _mates(view.first, recalled) if view.first else _pairs(recalled)
        return self._rng.choice(
            [p for p in choice if p in wanted] or [p for p in choice if p not in recalled] or list(choice)
        )

    def see(self, shown: dict[Position, str]) -> None:
        """Look at the open cards."""
        for position, picture in shown.items():
            self._seen[position] = (picture, self._flips)

    def _recall(self) -> dict[Position, str]:
        """The cards that it recalls in this move."""
        return {
            position: picture
            for position, (picture, flip) in self._seen.items()
            if self._rng.random() < (1 - FORGETTING) ** (self._flips - flip)
        }


def _mates(first: str, recalled: dict[Position, str]) -> set[Position]:
    """Where the open card's mate is believed to lie."""
    return {position for position, picture in recalled.items() if picture == first}


def _pairs(recalled: dict[Position, str]) -> set[Position]:
    """The cards of pairs that are believed to be known."""
    pictures = list(recalled.values())
    return {position for position, picture in recalled.items() if pictures.count(picture) > 1}
