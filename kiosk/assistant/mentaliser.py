"""The mentalising layer: a Theory of Mind made of rules over what this player has seen.

It knows nothing that the player has not seen, except that it may look at the board to find a mate. On a second card
every rule points to the mate of the open card; the rules differ in where they point on a first card.
"""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum
from random import Random

from kiosk.assistant.hint import Reason, Target
from kiosk.assistant.mdp import Card
from kiosk.game import Concentration, Position


class TargetRule(Enum):
    """Which closed card a first-card hint points at."""

    MOST_FLIPPED = "most_flipped"
    """The mate of the card flipped most often (the paper's rule)."""
    MOST_RECENT = "most_recent"
    """The mate of the card flipped last; in simulation it saves more flips than the paper's rule."""
    RANDOM = "random"
    """Any closed card: no Theory of Mind."""


class Mentaliser:
    """Chooses the target of a hint and names the reason that the player's history gives; ties fall to ``rng``."""

    def __init__(self, rule: TargetRule, rng: Random) -> None:
        """Follow ``rule`` on first cards."""
        self._candidates = _RULES[rule]
        self._rng = rng

    def target(self, game: Concentration) -> Target:
        """The card that a hint for the coming flip of ``game`` points at; some card must still be closed."""
        return self.pointing_at(self._rng.choice(self.candidates(game)), game)

    def candidates(self, game: Concentration) -> tuple[Position, ...]:
        """Every card that the rule could choose for the coming flip of ``game``, row by row."""
        return self._candidates(game) if game.first_card is None else (game.board.mate(game.first_card),)

    def pointing_at(self, position: Position, game: Concentration) -> Target:
        """What there is to say of a hint that points at this card."""
        mate = game.board.mate(position)
        seen, mate_seen = game.history.count(position), game.history.count(mate)
        reason = Reason.of(Card.coming(game), mate_seen, seen)
        return Target(position, mate, seen, mate_seen, reason, self.candidates(game))


def _mates_of_the_most_flipped(game: Concentration) -> tuple[Position, ...]:
    """For every closed card flipped most often, its mate: none is visited less, and equals stand for each other."""
    count, mate = game.history.count, game.board.mate
    most = max(count(position) for position in game.closed)
    if most == 0:
        return game.closed
    often = {position for position in game.closed if count(position) == most}
    return tuple(position for position in game.closed if mate(position) in often)


def _mate_of_the_most_recent(game: Concentration) -> tuple[Position, ...]:
    """The mate of the closed card flipped last; any closed card while none was flipped."""
    latest = max(game.closed, key=game.history.last)
    return (game.board.mate(latest),) if game.history.last(latest) else game.closed


_RULES: dict[TargetRule, Callable[[Concentration], tuple[Position, ...]]] = {
    TargetRule.MOST_FLIPPED: _mates_of_the_most_flipped,
    TargetRule.MOST_RECENT: _mate_of_the_most_recent,
    TargetRule.RANDOM: lambda game: game.closed,
}
