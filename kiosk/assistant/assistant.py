"""The two layers put together: before every flip, a decision that can be explained afterwards."""

from __future__ import annotations

from dataclasses import dataclass

from kiosk.assistant.gate import Verdict
from kiosk.assistant.hint import Hint
from kiosk.assistant.mdp import Action, Card, State
from kiosk.assistant.mentaliser import Mentaliser
from kiosk.assistant.qtable import QTable
from kiosk.game import Concentration


@dataclass(frozen=True, slots=True)
class Decision:
    """What was decided before a flip, and from what: state, gate, row of the table, action, and the hint if any."""

    state: State
    verdict: Verdict
    q: tuple[float, ...]
    action: Action
    hint: Hint | None


class Assistant:
    """Decides the help for one game; it remembers only its own last action."""

    def __init__(self, policy: QTable, mentaliser: Mentaliser) -> None:
        """Take a frozen table, whose gate it obeys, and a mentaliser, whose condition it does not know."""
        self._policy = policy
        self._mentaliser = mentaliser
        self._last = Action.NO_HELP

    def decide(self, game: Concentration) -> Decision:
        """Decide how much to help with the coming flip of ``game``, and where to point; the game must not be over."""
        state = State.of(game, self._last)
        verdict = self._policy.gate.verdict(game)
        self._last = self._policy.action(state) if verdict.is_open else Action.NO_HELP
        return Decision(state, verdict, self._policy.row(state), self._last, self._hint(game))

    def _hint(self, game: Concentration) -> Hint | None:
        if self._last is Action.NO_HELP:
            return None
        target = self._mentaliser.target(game)
        return Hint(self._last, Card.coming(game), target, game.board.card(target.position))
