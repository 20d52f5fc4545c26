"""The mentalising layer: which card to point to, and the reason for it."""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum
from random import Random

from kiosk.assistance.policy import ActionSpec, FlipInMove, Precision
from kiosk.game import Concentration, Position
from kiosk.lazy_dataclass import dataclass


class HintReason(Enum):
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
    def of(cls, card: FlipInMove, other: int, target: int) -> HintReason:
        """Return the class for these flip counts; on a second card ``other`` is the open card, this flip included.

        On a first card the two counts are read in either order: which of the two is pointed at is the target rule's
        business, and a sentence about "one and the other" is true both ways round.
        """
        if card is FlipInMove.FIRST:
            return _first_card_reason(max(other, target), min(other, target))
        return _second_card_reason(other, target)


OFTEN = 2
"""A card turned up this many times or more has been seen often."""


def _first_card_reason(most: int, least: int) -> HintReason:
    if most == 0:
        return HintReason.NOTHING_KNOWN
    if most < OFTEN:
        return HintReason.BOTH_SEEN_ONCE if least else HintReason.ONE_SEEN_ONCE
    return (HintReason.OFTEN_AND_NEVER, HintReason.OFTEN_AND_ONCE, HintReason.BOTH_OFTEN)[min(least, OFTEN)]


def _second_card_reason(opened: int, mate: int) -> HintReason:
    if opened < OFTEN:
        return (HintReason.FIRST_SIGHT, HintReason.BOTH_SEEN_ONCE, HintReason.OPEN_ONCE_MATE_OFTEN)[min(mate, OFTEN)]
    return (HintReason.OFTEN_AND_NEVER, HintReason.OFTEN_AND_ONCE, HintReason.BOTH_OFTEN)[min(mate, OFTEN)]


@dataclass(frozen=True, slots=True)
class Target:
    """Where the mentaliser points: a card, its mate, how often each was seen, and all that the rule could choose."""

    position: Position
    mate: Position
    seen: int
    mate_seen: int
    reason: HintReason
    candidates: tuple[Position, ...]
    is_located: bool = True
    """Whether its place may be given away; a hint that may not only reminds of the pair."""


@dataclass(frozen=True, slots=True)
class Hint:
    """One act of help with the coming flip.

    The action says how much of the target is given away, if any is.
    """

    action: ActionSpec
    card: FlipInMove
    target: Target
    name: str

    @classmethod
    def coming(cls, action: ActionSpec, target: Target, game: Concentration) -> Hint:
        """Return the hint at a target for the coming flip of ``game``."""
        return cls(action, FlipInMove.coming(game), target, game.board.card(target.position))

    @property
    def row(self) -> int | None:
        """The row that is pointed at, from 0, or None if the action does not name one."""
        given = self.target.is_located and self.action.precision in (Precision.ROW, Precision.CARD)
        return self.target.position.row if given else None

    @property
    def column(self) -> int | None:
        """The column that is pointed at, from 0, or None if the action does not name one."""
        given = self.target.is_located and self.action.precision in (Precision.COLUMN, Precision.CARD)
        return self.target.position.column if given else None

    def followed_by(self, flipped: Position) -> bool:
        """Whether flipping this card follows the hint: it is the hinted card, or lies in the hinted row or column.

        A reminder, which names no place, is followed by flipping either card of its pair.
        """
        if not self.target.is_located:
            return flipped in (self.target.position, self.target.mate)
        return points_to(self.row, self.column, flipped)


def points_to(row: int | None, column: int | None, place: Position) -> bool:
    """Tell whether a hint that names this row, column or both points to a place.

    One that names neither does not.
    """
    return (row, column) != (None, None) and row in (None, place.row) and column in (None, place.column)


class TargetRule(Enum):
    """Which closed card a first-card hint points at."""

    MOST_FLIPPED = "most_flipped"
    """The mate of the card flipped most often (the paper's rule)."""
    MOST_RECENT = "most_recent"
    """The mate of the card flipped last: the rule that simulation recommends. The paper's rule stays the default."""
    RANDOM = "random"
    """Any closed card: no Theory of Mind."""


class Mentaliser:
    """Chooses the target of a hint and names the reason that the player's history gives; ties fall to ``rng``."""

    def __init__(self, rule: TargetRule, rng: Random, *, locates: bool = True) -> None:
        """Follow ``rule`` on first cards; without ``locates``, no place is given away."""
        self._candidates = _RULES[rule]
        self._rng = rng
        self.locates = locates

    def target(self, game: Concentration) -> Target:
        """Return the card that a hint for the coming flip of ``game`` points at; some card must still be closed."""
        return self.pointing_at(self._rng.choice(self.candidates(game)), game)

    def candidates(self, game: Concentration) -> tuple[Position, ...]:
        """Every card that the rule could choose for the coming flip of ``game``, row by row."""
        return self._candidates(game) if game.first_card is None else (game.board.mate(game.first_card),)

    def pointing_at(self, position: Position, game: Concentration) -> Target:
        """Return what there is to say of a hint that points at this card."""
        mate = game.board.mate(position)
        seen, mate_seen = game.history.count(position), game.history.count(mate)
        reason = HintReason.of(FlipInMove.coming(game), mate_seen, seen)
        return Target(position, mate, seen, mate_seen, reason, self.candidates(game), self.locates)


def _mates_of_the_most_flipped(game: Concentration) -> tuple[Position, ...]:
    """For every closed card flipped most often, its mate: none is visited less, and equals stand for each other."""
    count, mate = game.history.count, game.board.mate
    most = max(count(position) for position in game.closed)
    if most == 0:
        return game.closed
    often = {position for position in game.closed if count(position) == most}
    return tuple(position for position in game.closed if mate(position) in often)


def _mate_of_the_most_recent(game: Concentration) -> tuple[Position, ...]:
    """Return the mate of the closed card flipped last; any closed card while none was flipped."""
    latest = max(game.closed, key=game.history.last)
    return (game.board.mate(latest),) if game.history.last(latest) else game.closed


_RULES: dict[TargetRule, Callable[[Concentration], tuple[Position, ...]]] = {
    TargetRule.MOST_FLIPPED: _mates_of_the_most_flipped,
    TargetRule.MOST_RECENT: _mate_of_the_most_recent,
    TargetRule.RANDOM: lambda game: game.closed,
}
