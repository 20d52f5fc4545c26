"""The gate: when a hint is not even considered. It stands outside the table and can be taken away.

Most of "does not intervene while the player does well" is this gate. The paper does not mention it; it was observed
in the behaviour of the authors' released program.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from kiosk.assistant.mdp import Card
from kiosk.game import Concentration


class Verdict(Enum):
    """What the gate says before a flip: open, or the reason why no hint is considered."""

    OPEN = "open"
    OPENING = "the first flips of a game are the player's own"
    DOING_WELL = "a first card gets no hint so soon after a match"
    STILL_EXPLORING = "a first card gets no hint so early while no pair has been found"

    @property
    def is_open(self) -> bool:
        """Whether the table may be asked."""
        return self is Verdict.OPEN


@dataclass(frozen=True, slots=True)
class Gate:
    """Three numbers of flips; all 0 is no gate at all.

    ``opening``: flips at the start of a game that are never helped. ``patience``: flips since the last match before
    a first card may be helped. ``first_patience``: the same while no pair has been found.
    """

    opening: int = 6
    patience: int = 4
    first_patience: int = 10

    def __post_init__(self) -> None:
        """Refuse with a ValueError what is no number of flips: a number below 0, a fraction, a text."""
        for name in self.__slots__:
            flips = getattr(self, name)
            if not isinstance(flips, int) or isinstance(flips, bool):
                raise ValueError(f"gate: {name} must be a whole number of flips, not {flips!r}")
            if flips < 0:
                raise ValueError(f"gate: {name} must be 0 or more flips, not {flips}")

    def verdict(self, game: Concentration) -> Verdict:
        """Whether a hint may be considered before the next flip of ``game``."""
        if game.flips < self.opening:
            return Verdict.OPENING
        if Card.coming(game) is Card.SECOND:
            return Verdict.OPEN
        if game.pairs_found == 0:
            return Verdict.OPEN if game.flips_since_match >= self.first_patience else Verdict.STILL_EXPLORING
        return Verdict.OPEN if game.flips_since_match >= self.patience else Verdict.DOING_WELL


NO_GATE = Gate(opening=0, patience=0, first_patience=0)
