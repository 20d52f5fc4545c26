"""Policy files: those that are shipped, and claims about a table.

What a table must do to be the paper's policy stands here as checks; how well it does so is for simulation.
"""

from __future__ import annotations

from dataclasses import dataclass

from kiosk.assistance.policy import ActionSpec, Gate, MoveOutcome, Phase, QTable, State


def visits(policy: QTable) -> dict[State, int]:
    """Count how often each state asked for a decision in training.

    States that never did are left out; it is empty where the file does not say.
    """
    counts = policy.training.get("visits", {})
    return {state: counts[state.label] for state in policy.states if state.label in counts}


def helped(policy: QTable) -> list[State]:
    """Return the states in which the table helps."""
    return [state for state in policy.states if policy.action(state) is not ActionSpec.NO_HELP]


@dataclass(frozen=True, slots=True)
class PolicyComparison:
    """Two tables side by side, over the states that both have visited (all, where a file does not say)."""

    compared: tuple[State, ...]
    different: tuple[State, ...]
    largest: float
    """The largest difference of two values, over the compared states."""

    @property
    def agreement(self) -> float:
        """The share of the compared states with the same greedy action; 1 where nothing can be compared."""
        return 1 - len(self.different) / len(self.compared) if self.compared else 1.0


def compare_policies(one: QTable, other: QTable) -> PolicyComparison:
    """Compare the greedy actions and the values of two tables."""
    both = [state for state in one.states if state in other.states and _known(one, state) and _known(other, state)]
    different = [state for state in both if one.action(state) is not other.action(state)]
    gaps = [abs(a - b) for state in both for a, b in _shared_values(one, other, state)]
    return PolicyComparison(tuple(both), tuple(different), max(gaps, default=0.0))


def _shared_values(one: QTable, other: QTable, state: State) -> list[tuple[float, float]]:
    """Return the values of a state in two tables, for the actions that both have."""
    values = [dict(zip(table.actions, table.row(state), strict=True)) for table in (one, other)]
    return [(value, values[1][action]) for action, value in values[0].items() if action in values[1]]


def _known(policy: QTable, state: State) -> bool:
    known = visits(policy)
    return not known or state in known


@dataclass(frozen=True, slots=True)
class PolicyClaim:
    """One sentence of the paper about its policy, and whether a table does so."""

    text: str
    holds: bool


def policy_claims(policy: QTable, hint_rate_first: float, hint_rate_second: float) -> tuple[PolicyClaim, ...]:
    """Return the paper's four sentences as checks of a table behind its gate.

    They are also checks of the hint rates it has in play.
    """
    levels = {
        phase: _level(policy, [s for s in policy.states if s.game is phase and _known(policy, s)]) for phase in Phase
    }
    well = _firsts(policy, MoveOutcome.F_CORRECT)
    wrong = _firsts(policy, MoveOutcome.F_WRONG)
    falls = levels[Phase.BEGINNING] >= levels[Phase.MIDDLE] >= levels[Phase.END]
    return (
        PolicyClaim(
            "on the first card it does not step in while the player does well",
            policy.gate.patience >= Gate().patience or not well,
        ),
        PolicyClaim("on the first card it helps once mistakes have been made", wrong > 0),
        PolicyClaim(
            "it helps more at the beginning and less as pairs are found",
            falls and levels[Phase.BEGINNING] > levels[Phase.END],
        ),
        PolicyClaim("it helps more often on the second card", hint_rate_second > hint_rate_first),
    )


def _firsts(policy: QTable, outcome: MoveOutcome) -> float:
    return _level(policy, [state for state in policy.states if state.outcome is outcome and _known(policy, state)])


def _level(policy: QTable, states: list[State]) -> float:
    return sum(policy.action(state).level for state in states)
