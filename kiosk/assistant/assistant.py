"""The two layers put together: before every flip, a decision that can be explained afterwards."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from kiosk.assistant.gate import Gate, Verdict
from kiosk.assistant.hint import Hint, Target
from kiosk.assistant.mdp import Action, Card, State
from kiosk.assistant.mentaliser import Mentaliser
from kiosk.game import Concentration


class Policy(Protocol):
    """What an assistant asks how much to help: a table, frozen or not, and the gate before it."""

    @property
    def gate(self) -> Gate:
        """When the table is asked at all."""
        ...

    def row(self, state: State) -> tuple[float, ...]:
        """The four action values of a state."""
        ...

    def action(self, state: State) -> Action:
        """The action to take in a state."""
        ...


@dataclass(frozen=True, slots=True)
class Decision:
    """What was decided before a flip, and from what: state, gate, row of the table, action, and the hint if any."""

    state: State
    verdict: Verdict
    q: tuple[float, ...]
    action: Action
    hint: Hint | None


def decide(
    game: Concentration,
    last: Action,
    policy: Policy,
    point: Callable[[Concentration], Target],
    override: Action | None = None,
) -> Decision:
    """The decision before the coming flip of ``game``, after ``last``; ``point`` is asked only if there is a hint.

    ``override`` is taken instead of the action that gate and table come to.
    """
    state, verdict = State.of(game, last), policy.gate.verdict(game)
    action = override
    if action is None:
        action = policy.action(state) if verdict.is_open else Action.NO_HELP
    hint = None
    if action is not Action.NO_HELP:
        target = point(game)
        hint = Hint(action, Card.coming(game), target, game.board.card(target.position))
    return Decision(state, verdict, policy.row(state), action, hint)


class Assistant:
    """Decides the help for one game; it remembers only its own last action."""

    def __init__(self, policy: Policy, mentaliser: Mentaliser) -> None:
        """Take a table, whose gate it obeys, and a mentaliser, whose condition it does not know."""
        self._policy = policy
        self._mentaliser = mentaliser
        self._last = Action.NO_HELP

    def decide(self, game: Concentration) -> Decision:
        """Decide how much to help with the coming flip of ``game``, and where to point; the game must not be over."""
        decision = decide(game, self._last, self._policy, self._mentaliser.target)
        self._last = decision.action
        return decision

    def finish(self, game: Concentration) -> str | None:  # noqa: ARG002 - for those that learn
        """Close a game that is over; the sha256 of the table as it came out, or None where nothing is ever learnt."""
        return None
