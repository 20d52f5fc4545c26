"""A hint: what is pointed at, how precisely, and what this player's history gives as the reason.

It carries more than may be shown (where the target lies), because the record needs it; what may be shown is only
``row`` and ``column``, and they are None where the action does not give them away.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from kiosk.assistant.mdp import Action, Card
from kiosk.game import Position


class Reason(Enum):
    """What the player's history says about a pair: how often its two cards were turned up (one, other)."""

    NOTHING_KNOWN = "nothing-known"
    ONE_SEEN_ONCE = "one-seen-once"
    BOTH_SEEN_ONCE = "both-seen-once"
    OFTEN_AND_NEVER = "often-and-never"
    OFTEN_AND_ONCE = "often-and-once"
    BOTH_OFTEN = "both-often"
    FIRST_SIGHT = "first-sight"
    OPEN_ONCE_MATE_OFTEN = "open-once-mate-often"

    @classmethod
    def of(cls, card: Card, other: int, target: int) -> Reason:
        """The class for these flip counts; on a second card ``other`` is the open card, this flip included.

        On a first card the two counts are read in either order: which of the two is pointed at is the target rule's
        business, and a sentence about "one and the other" is true both ways round.
        """
        if card is Card.FIRST:
            return _first_card_reason(max(other, target), min(other, target))
        return _second_card_reason(other, target)


OFTEN = 2
"""A card turned up this many times or more has been seen often."""


def _first_card_reason(most: int, least: int) -> Reason:
    if most == 0:
        return Reason.NOTHING_KNOWN
    if most < OFTEN:
        return Reason.BOTH_SEEN_ONCE if least else Reason.ONE_SEEN_ONCE
    return (Reason.OFTEN_AND_NEVER, Reason.OFTEN_AND_ONCE, Reason.BOTH_OFTEN)[min(least, OFTEN)]


def _second_card_reason(opened: int, mate: int) -> Reason:
    if opened < OFTEN:
        return (Reason.FIRST_SIGHT, Reason.BOTH_SEEN_ONCE, Reason.OPEN_ONCE_MATE_OFTEN)[min(mate, OFTEN)]
    return (Reason.OFTEN_AND_NEVER, Reason.OFTEN_AND_ONCE, Reason.BOTH_OFTEN)[min(mate, OFTEN)]


@dataclass(frozen=True, slots=True)
class Target:
    """Where the mentaliser points: a card, its mate, how often each was seen, and all that the rule could choose."""

    position: Position
    mate: Position
    seen: int
    mate_seen: int
    reason: Reason
    candidates: tuple[Position, ...]


@dataclass(frozen=True, slots=True)
class Hint:
    """One act of help with the coming flip: the action says how much of the target is given away."""

    action: Action
    card: Card
    target: Target
    name: str

    @property
    def row(self) -> int | None:
        """The row that is pointed at, from 0, or None if the action does not name one."""
        return self.target.position.row if self.action in (Action.SUG_ROW, Action.SUG_CARD) else None

    @property
    def column(self) -> int | None:
        """The column that is pointed at, from 0, or None if the action does not name one."""
        return self.target.position.column if self.action in (Action.SUG_COL, Action.SUG_CARD) else None

    def followed_by(self, flipped: Position) -> bool:
        """Whether flipping this card follows the hint: it is the hinted card, or lies in the hinted row or column."""
        return self.row in (None, flipped.row) and self.column in (None, flipped.column)
