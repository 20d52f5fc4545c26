"""Simulate studies that explore, and compare the estimated effects of hints with the true ones.

    python -m tests.bench.proximal_effects --studies 500

prints, for each kind of hint, the true effect, the mean error of the estimates, their SD, and how often their intervals
hold the truth. The truth comes from other games: at every decision the move is played out under each action in turn.
"""

from __future__ import annotations

import argparse
from collections import defaultdict
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from kiosk.analysis.proximal import Draws, estimate
from kiosk.analysis.statistics import NotEstimableError
from kiosk.assistance.mentaliser import TargetRule
from kiosk.assistance.policy import ACTIONS, FlipInMove, QTable
from kiosk.training.simulated_players import MemoryPlayer
from kiosk.training.simulation import GameTable, greedy, lay, playing, start, take
from kiosk.training.vectorised_game import (
    ACTION_COUNT,
    FIRST,
    NO_HELP,
    NOWHERE,
    Floats,
    Ints,
    below,
    compiled_rule,
    floats,
    gate_plan,
    ints,
    is_open,
    state,
    unit,
)

PLAYERS = MemoryPlayer((0.10, 0.45), follow=0.9)
EXPLORE = 0.3
ROOM = 5_000
PER_ROW = 4


@compiled_rule
def explored(table: GameTable, q: Floats, explore: float) -> int:
    """Return the action of the policy, or with this probability any; none at a shut gate."""
    game = table.game
    if not is_open(game, table.plan):
        return NO_HELP
    best = greedy(q, state(game), game[ACTION_COUNT])
    return below(game, game[ACTION_COUNT]) if unit(game) < explore else best


@compiled_rule
def play_study(table: GameTable, q: Floats, explore: float, log: Ints) -> int:
    """Play one game; write for each decision the card, the action, the greedy one, and whether its move matched."""
    start(table)
    game, rows, begun = table.game, 0, 0
    while playing(game):
        second = game[FIRST] != NOWHERE
        if not second:
            begun = rows
        opened = is_open(game, table.plan)
        best = greedy(q, state(game), game[ACTION_COUNT])
        action = explored(table, q, explore)
        matched = take(table, action)
        if opened:
            at = rows * PER_ROW
            log[at], log[at + 1], log[at + 2], log[at + 3] = second, action, best, 0
            rows += 1
        if second:
            for row in range(begun, rows):
                log[row * PER_ROW + 3] = matched
    return rows


class Decided(NamedTuple):
    """One decision of a simulated participant."""

    second: bool
    action: int
    greedy: int
    matched: int


def games(table: GameTable, q: Floats, explore: float, count: int) -> Iterator[tuple[Decided, ...]]:
    """Yield the decisions of games, one a participant."""
    log = ints([0] * (ROOM * PER_ROW))
    for _ in range(count):
        rows = play_study(table, q, explore, log)
        cells = [int(each) for each in log[: rows * PER_ROW]]
        parts = (cells[at : at + PER_ROW] for at in range(0, len(cells), PER_ROW))
        yield tuple(Decided(bool(second), *rest) for second, *rest in parts)


def draws(study: Sequence[tuple[Decided, ...]], explore: float, *, second: bool) -> Draws:
    """Return the decisions about first or second cards as the report reads them."""
    rows = [(who, each) for who, game in enumerate(study) for each in game if each.second == second]
    chance = explore / len(ACTIONS)
    return Draws(
        [ACTIONS[each.action].label for _, each in rows],
        np.array([chance + (1 - explore) * (each.action == each.greedy) for _, each in rows]),
        [str(who) for who, _ in rows],
        np.array([float(each.matched) for _, each in rows]),
    )


def true_effects(q: Floats, plan: Ints, explore: float, count: int, seed: int) -> dict[tuple[bool, int], float]:
    """Return the effect of each action, as every decision of these games is played out under all of them."""
    table = lay(PLAYERS, plan, seed)
    hits: defaultdict[tuple[bool, int], list[int]] = defaultdict(list)
    for _ in range(count):
        start(table)
        while playing(table.game):
            if is_open(table.game, table.plan):
                second = bool(table.game[FIRST] != NOWHERE)
                for action in range(len(ACTIONS)):
                    hits[second, action].append(_played_out(table, q, explore, action))
            take(table, explored(table, q, explore))
    shares = {key: float(np.mean(each)) for key, each in hits.items()}
    return {(second, a): share - shares[second, NO_HELP] for (second, a), share in shares.items() if a != NO_HELP}


def _played_out(table: GameTable, q: Floats, explore: float, action: int) -> int:
    """Return whether the move matches if this action is taken now, on a copy of the game."""
    copy = GameTable(ints(list(table.game)), table.plan, table.player, floats(list(table.odds)), ints([*table.tally]))
    matched = take(copy, action)
    return int(matched if copy.game[FIRST] == NOWHERE else take(copy, explored(copy, q, explore)))


def simulate(studies: int, people: int, truth: int) -> Iterator[tuple[str, str, float, float, float, float]]:
    """Yield for each hint its card, action, true effect, mean error, SD of the estimates, and coverage."""
    policy = QTable.named("default")
    q, plan = floats([v for row in policy.values for v in row]), gate_plan(policy.gate, TargetRule.MOST_FLIPPED)
    true = true_effects(q, plan, EXPLORE, truth, 2)
    table = lay(PLAYERS, plan, 1)
    found: defaultdict[tuple[bool, int], list[tuple[float, bool]]] = defaultdict(list)
    for _ in range(studies):
        study = tuple(games(table, q, EXPLORE, people))
        for second in (False, True):
            drawn = draws(study, EXPLORE, second=second)
            for action in range(1, len(ACTIONS)):
                try:
                    _, _, effect, low, high = estimate(drawn, ACTIONS[action].label)
                except NotEstimableError:
                    continue
                found[second, action].append((effect, low <= true[second, action] <= high))
    for (second, action), each in sorted(found.items()):
        effects = np.array([effect for effect, _ in each])
        card = (FlipInMove.SECOND if second else FlipInMove.FIRST).value
        error, spread = float(effects.mean()) - true[second, action], float(effects.std(ddof=1))
        yield card, ACTIONS[action].label, true[second, action], error, spread, float(np.mean([h for _, h in each]))


def main() -> None:
    """Print the table."""
    words = argparse.ArgumentParser(description=__doc__)
    words.add_argument("--studies", type=int, default=500)
    words.add_argument("--people", type=int, default=56)
    words.add_argument("--truth", type=int, default=10_000)
    given = words.parse_args()
    for card, action, true, error, spread, held in simulate(given.studies, given.people, given.truth):
        print(f"| {card} | {action} | {true:.3f} | {error:+.4f} | {spread:.3f} | {held:.3f} |")  # noqa: T201 - a script


if __name__ == "__main__":
    main()
