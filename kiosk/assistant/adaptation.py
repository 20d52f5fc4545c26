"""A table that goes on learning within one sitting, from how this player does; off unless a study turns it on.

It starts from the frozen table, which is never changed and whose file is never written, and moves one value at a time
by no more than a step. Only decisions behind an open gate are learnt from. Nothing here is left to chance: the same
flips give the same table.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from random import Random

from kiosk.assistant.assistant import Assistant, Decision, Policy
from kiosk.assistant.gate import Gate
from kiosk.assistant.mdp import Action, Phase, State
from kiosk.assistant.mentaliser import Mentaliser, TargetRule
from kiosk.assistant.qtable import QTable
from kiosk.game import Concentration, Position

GAMMA = 0.8
"""How much less a payment is worth for every flip that it comes later; as in training."""
RATE = 0.1
"""How far a value moves towards one sample, as long as that is less than a step."""
COST = 5
"""One hint costs a share (COST - g) / (2 nf) of the match, with g = 3, 2, 1 by phase; as in training."""


@dataclass(frozen=True, slots=True)
class Coming:
    """A flip that is about to be made: ``nf`` counts the flips since the last match, this one included.

    ``before`` is the help with the flip before it, ``action`` the help with this one.
    """

    before: Action
    action: Action
    nf: int
    phase: Phase

    def worth(self, *, matched: bool) -> float:
        """The reward "retrieval": how much of a match was the player's own. A first card never matches."""
        if not matched:
            return 0.0
        hints = sum(action is not Action.NO_HELP for action in (self.before, self.action))
        if hints == 0:
            return 1.0
        if self.action is Action.SUG_CARD or hints > 1:
            return 0.0
        return 1 - (COST - (len(Phase) - self.phase)) / (2 * self.nf)


class AdaptiveTable:
    """A frozen table's values and gate, and a way to move the values by at most ``step``."""

    def __init__(self, frozen: QTable, step: float) -> None:
        """Start from ``frozen``; raises ValueError for a step below 0."""
        if step < 0:
            raise ValueError(f"the step of an adaptive table must be 0 or more, not {step}")
        self._frozen = frozen
        self._step = step
        self._values = [list(row) for row in frozen.values]

    @property
    def gate(self) -> Gate:
        """The gate of the frozen table."""
        return self._frozen.gate

    def row(self, state: State) -> tuple[float, ...]:
        """The four action values of a state, as they are now."""
        return tuple(self._values[state.index])

    def action(self, state: State) -> Action:
        """The greedy action; ties go to the lowest, which helps least."""
        row = self.row(state)
        return Action(row.index(max(row)))

    def learn(self, state: State, action: Action, sample: float) -> None:
        """Move one value towards a sample, by no more than a step."""
        wish = RATE * (sample - self._values[state.index][action])
        self._values[state.index][action] += max(-self._step, min(self._step, wish))

    def frozen(self) -> QTable:
        """The table as it is now; unless something was learnt, it is the one that it began as, to the sha256."""
        return QTable.freeze(self._frozen.name, self.gate, self._values, self._frozen.training)


@dataclass(slots=True)
class _Pending:
    """A decision that is still being paid for, flip by flip."""

    state: State
    action: Action
    paid: float = 0.0
    weight: float = 1.0

    def pay(self, worth: float) -> None:
        """Add what one more flip was worth."""
        self.paid += self.weight * worth
        self.weight *= GAMMA


class AdaptiveAssistant(Assistant):
    """An assistant whose table learns, at each decision, from what the one before it came to."""

    def __init__(self, policy: QTable, mentaliser: Mentaliser, step: float) -> None:
        """Start from the frozen table ``policy``; ``step`` bounds every change of a value."""
        self.table = AdaptiveTable(policy, step)
        super().__init__(self.table, mentaliser)
        self._coming: Coming | None = None
        self._pending: _Pending | None = None

    def decide(self, game: Concentration) -> Decision:
        """Learn from the flip that was made since the last decision, then decide about the coming one."""
        self._collect(game)
        if self.table.gate.verdict(game).is_open:
            self._learn(max(self.table.row(State.of(game, self._last))))
        decision = super().decide(game)
        if decision.verdict.is_open:
            self._pending = _Pending(decision.state, decision.action)
        nf = game.flips_since_match + 1
        self._coming = Coming(decision.state.last, decision.action, nf, decision.state.game)
        return decision

    def finish(self, game: Concentration) -> str:
        """Learn from the last flip of a game that is over; the sha256 of the table as it came out."""
        self._collect(game)
        self._learn(0.0)
        return self.table.frozen().sha256

    def _collect(self, game: Concentration) -> None:
        """Pay for the flip that was made since the last decision."""
        if self._coming is not None and self._pending is not None:
            self._pending.pay(self._coming.worth(matched=game.last_match == game.flips))
        self._coming = None

    def _learn(self, to_come: float) -> None:
        """Close the account of the pending decision; ``to_come`` is what the state reached is worth."""
        if self._pending is not None:
            pending, self._pending = self._pending, None
            self.table.learn(pending.state, pending.action, pending.paid + pending.weight * to_come)


def assistant_with(policy: QTable, mentaliser: Mentaliser, step: float) -> Assistant:
    """An assistant whose table stays as it is, or, with a step above 0, goes on learning."""
    return AdaptiveAssistant(policy, mentaliser, step) if step else Assistant(policy, mentaliser)


def table_before(policy: QTable, step: float, game: Concentration, flips: Iterable[Position]) -> Policy:
    """The table as it stood when the flip after ``flips`` was decided; ``game`` is a new one, and is played.

    Where the hints pointed does not matter here: only how much help there was, and what came of it, is learnt from.
    """
    if not step:
        return policy
    assistant = AdaptiveAssistant(policy, Mentaliser(TargetRule.RANDOM, Random(0)), step)
    for position in flips:
        assistant.decide(game)
        game.flip(position)
        game.turn_back()
    assistant.decide(game)
    return assistant.table
