"""One moment of a game, before a flip, with everything that decides the help: enough to explain it afterwards."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from random import Random

from kiosk import BadInput
from kiosk.assistant.assistant import Decision, Policy, decide
from kiosk.assistant.explain import Explanation, explain, replayed
from kiosk.assistant.hint import Target
from kiosk.assistant.mdp import Action, State
from kiosk.assistant.mentaliser import Mentaliser, TargetRule
from kiosk.assistant.wording import Catalogue, Wording
from kiosk.game import Board, Concentration, Position
from kiosk.study.condition import Condition, help_in


@dataclass(frozen=True)
class Moment:
    """The board, the flips so far, the last action, and what the help follows.

    ``override`` takes the place of the action that gate and table come to. ``target`` is the card that was pointed
    at, where that is known; otherwise ``seed`` chooses among those that the rule allows.
    """

    board: Board
    flips: tuple[Position, ...]
    last: Action
    condition: Condition
    rule: TargetRule
    policy: Policy
    catalogue: Catalogue
    override: Action | None = None
    target: Position | None = None
    seed: int = 0

    def explained(self) -> Explanation:
        """The decision of this moment, laid open; raises BadInput if there can be no such moment."""
        game, chance = replayed(self.board, self.flips), Random(self.seed)
        given = help_in(self.condition, self.rule, Wording(self.catalogue, chance), chance)
        if given is None:
            return explain(game, self._undecided(game), None, None)
        point = partial(self._point, given.mentaliser)
        decision = decide(game, self.last, self.policy, point, self.override)
        return explain(game, decision, given.mentaliser, given.sentences, overridden=self.override is not None)

    def _point(self, mentaliser: Mentaliser, game: Concentration) -> Target:
        return mentaliser.target(game) if self.target is None else mentaliser.pointing_at(self.target, game)

    def _undecided(self, game: Concentration) -> Decision:
        """What gate and table hold where nobody asks them."""
        if self.override not in (None, Action.NO_HELP):
            raise BadInput(f"in the condition {self.condition.value} nobody helps, so there is no action to explain")
        state = State.of(game, self.last)
        return Decision(state, self.policy.gate.verdict(game), self.policy.row(state), Action.NO_HELP, None)
