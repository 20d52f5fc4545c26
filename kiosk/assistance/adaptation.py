"""A table that learns during a game, at each decision, from what the one before came to."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from random import Random

from kiosk.assistance.assistant import BY_TABLE, Assistant, Decision, DecisionRules, Policy
from kiosk.assistance.mentaliser import Mentaliser, TargetRule
from kiosk.assistance.policy import ActionSpec, Gate, Phase, Precision, QTable, State
from kiosk.config import AssistanceConfig
from kiosk.game import Concentration, Position
from kiosk.lazy_dataclass import dataclass

GAMMA = 0.8
"""How much less a payment is worth for every flip that it comes later; as in training."""
RATE = 0.1
"""How far a value moves towards one sample, as long as that is less than a step."""
COST = 5
"""One hint costs a share (COST - g) / (2 nf) of the match, with g = 3, 2, 1 by phase; as in training."""


@dataclass(frozen=True, slots=True)
class UpcomingFlip:
    """A flip that is about to be made: ``nf`` counts the flips since the last match, this one included.

    ``before`` is the help with the flip before it, ``action`` the help with this one.
    """

    before: ActionSpec
    action: ActionSpec
    nf: int
    phase: Phase

    def value(self, *, matched: bool) -> float:
        """Return the reward "retrieval": how much of a match was the player's own. A first card never matches."""
        if not matched:
            return 0.0
        hints = sum(action.needs_target for action in (self.before, self.action))
        if hints == 0:
            return 1.0
        if self.action.precision is Precision.CARD or hints > 1:
            return 0.0
        return 1 - (COST - (len(Phase) - self.phase)) / (2 * self.nf)


class LearningTable:
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

    @property
    def actions(self) -> tuple[ActionSpec, ...]:
        """The actions of the frozen table."""
        return self._frozen.actions

    def row(self, state: State) -> tuple[float, ...]:
        """Return the values of a state as they are now, one for each action."""
        return tuple(self._values[state.index_in(self.actions)])

    def action(self, state: State) -> ActionSpec:
        """Return the greedy action; ties go to the lowest, which helps least."""
        row = self.row(state)
        return self.actions[row.index(max(row))]

    def learn(self, state: State, action: ActionSpec, sample: float) -> None:
        """Move one value towards a sample, by no more than a step."""
        row, column = self._values[state.index_in(self.actions)], self.actions.index(action)
        row[column] += max(-self._step, min(self._step, RATE * (sample - row[column])))

    def frozen(self) -> QTable:
        """Return the table as it is now.

        Unless something was learnt, it is the one that it began as, to the sha256.
        """
        return QTable.freeze(self._frozen.name, self.gate, self._values, self._frozen.training, self.actions)


@dataclass(slots=True)
class _Pending:
    """A decision that is still being paid for, flip by flip."""

    state: State
    action: ActionSpec
    paid: float = 0.0
    weight: float = 1.0

    def pay(self, worth: float) -> None:
        """Add what one more flip was worth."""
        self.paid += self.weight * worth
        self.weight *= GAMMA


class LearningAssistant(Assistant):
    """An assistant whose table learns, at each decision, from what the one before it came to."""

    def __init__(
        self,
        policy: QTable,
        mentaliser: Mentaliser,
        step: float,
        rules: DecisionRules = BY_TABLE,
        rng: Random | None = None,
    ) -> None:
        """Start from the frozen table ``policy``; ``step`` bounds every change of a value."""
        self.table = LearningTable(policy, step)
        super().__init__(self.table, mentaliser, rules, rng)
        self._coming: UpcomingFlip | None = None
        self._pending: _Pending | None = None

    def decide(self, game: Concentration, override: ActionSpec | None = None) -> Decision:
        """Learn from the flip that was made since the last decision, then decide about the coming one."""
        self._collect(game)
        if self.table.gate.decide(game).is_open:
            self._learn(max(self.table.row(State.of(game, self._last))))
        decision = super().decide(game, override)
        if decision.gate_decision.is_open:
            self._pending = _Pending(decision.state, decision.action)
        nf = game.flips_since_match + 1
        self._coming = UpcomingFlip(decision.state.last, decision.action, nf, decision.state.game)
        return decision

    def finish(self, game: Concentration) -> str:
        """Learn from the last flip of a game that is over; the sha256 of the table as it came out."""
        self._collect(game)
        self._learn(0.0)
        return self.table.frozen().sha256

    def _collect(self, game: Concentration) -> None:
        """Pay for the flip that was made since the last decision."""
        if self._coming is not None and self._pending is not None:
            worth = self._coming.value(matched=game.last_match == game.flips)
            self._pending.pay(worth - self._coming.action.cost)
        self._coming = None

    def _learn(self, to_come: float) -> None:
        """Close the account of the pending decision; ``to_come`` is what the state reached is worth."""
        if self._pending is not None:
            pending, self._pending = self._pending, None
            self.table.learn(pending.state, pending.action, pending.paid + pending.weight * to_come)


def assistant_with(policy: QTable, mentaliser: Mentaliser, config: AssistanceConfig, rng: Random) -> Assistant:
    """Return the assistant that a study file declares; ``rng`` is asked only if it explores."""
    rules = DecisionRules.of(config)
    if config.step:
        return LearningAssistant(policy, mentaliser, config.step, rules, rng)
    return Assistant(policy, mentaliser, rules, rng)


def table_before_flip(
    policy: QTable,
    step: float,
    game: Concentration,
    flips: Iterable[Position],
    actions: Mapping[int, ActionSpec] | None = None,
) -> Policy:
    """Return the table as it stood when the flip after ``flips`` was decided.

    ``game`` is a new one, and is played. ``actions`` are what was decided before each flip, from 1, where that is
    known and the table did not decide alone.

    Where the hints pointed does not matter here: only how much help there was, and what came of it, is learnt from.
    """
    if not step:
        return policy
    assistant = LearningAssistant(policy, Mentaliser(TargetRule.RANDOM, Random(0)), step)
    for number, position in enumerate(flips, 1):
        assistant.decide(game, (actions or {}).get(number))
        game.flip(position)
        game.turn_back()
    assistant.decide(game)
    return assistant.table
