"""Comments after a move: praise for a pair, encouragement after a miss, each at the rate that a condition declares.

The learning layer does not know of them. A comment comes only where no help was decided for the next card, so the
decision is made, and recorded, before. Chance has a stream of its own. Neither the last action of a state, nor the
model of memory, nor what a table learns from has a comment in it.
"""

from __future__ import annotations

from random import Random

from kiosk.assistance.policy import ENCOURAGEMENT, PRAISE, ActionSpec
from kiosk.config import ConditionConfig
from kiosk.game import Concentration
from kiosk.lazy_dataclass import dataclass

COMMENTS = (PRAISE, ENCOURAGEMENT)


@dataclass(frozen=True, slots=True)
class CommentRule:
    """How often a pair is praised, and how often the helper encourages after a miss; both from 0 to 1."""

    praise: float = 0.0
    encourage: float = 0.0

    @classmethod
    def of(cls, condition: ConditionConfig) -> CommentRule | None:
        """Return the rule that a condition declares; None where there are no comments."""
        return cls(condition.praise, condition.encourage) if condition.comments else None

    def due(self, game: Concentration) -> tuple[ActionSpec, float] | None:
        """Return the comment that may come now, with its chance; None if no move has just ended."""
        if game.flips == 0 or game.over or game.first_card is not None:
            return None
        return (PRAISE, self.praise) if game.last_match == game.flips else (ENCOURAGEMENT, self.encourage)


@dataclass(frozen=True, slots=True)
class Comment:
    """A comment after a move, and the chance with which it came."""

    action: ActionSpec
    probability: float


class Commentator:
    """Draws, after every move whose next card gets no help, whether there is a comment."""

    def __init__(self, rule: CommentRule, rng: Random) -> None:
        """Follow a rule; ``rng`` is asked once for every such move."""
        self._rule = rule
        self._rng = rng

    def comment(self, game: Concentration) -> Comment | None:
        """Return the comment on the move that has just ended, if one comes."""
        due = self._rule.due(game)
        if due is None or self._rng.random() >= due[1]:
            return None
        return Comment(*due)
