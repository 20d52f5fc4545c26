"""The proximal effect of each kind of hint: what it does to the very move that it was given for.

It needs a study that explores: decisions drawn at random, with the probability of the action that was taken. The
share of matches under an action is the mean over the decisions that took it, each weighed by one over that probability.
The effect is its difference to the share under no help, over the states that players came into. The interval comes from
leaving out one person at a time, as the decisions of a person are not independent.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from kiosk.analysis.data import ExportTable, Floats
from kiosk.analysis.statistics import NotEstimableError, jackknife_margin
from kiosk.assistance.policy import ActionSpec, FlipInMove
from kiosk.experiment.outcomes import Stage

LEAST_PEOPLE = 3
"""People who had a hint of the kind, and people who had no help, for there to be an interval."""
LEVEL = 0.95


@dataclass(frozen=True)
class Draws:
    """Decisions that chance had a part in: the action, its probability, whose, and whether the move matched."""

    action: Sequence[str]
    probability: Floats
    person: Sequence[str]
    matched: Floats


@dataclass(frozen=True)
class ProximalEffect:
    """What a kind of hint does to the chance that its move matches, compared with no help.

    ``decisions`` had the hint, out of ``people``; ``matched`` and ``unhelped`` are the weighted shares of matches.
    ``note`` says why there are no numbers.
    """

    card: str
    action: str
    decisions: int
    people: int
    matched: float = math.nan
    unhelped: float = math.nan
    effect: float = math.nan
    low: float = math.nan
    high: float = math.nan
    note: str = ""


def proximal_effects(decisions: ExportTable, flips: ExportTable, people: Sequence[str]) -> tuple[ProximalEffect, ...]:
    """Return the effect of every kind of hint on first and on second cards; empty if nothing was drawn."""
    return tuple(
        _effect(card.value, action, draws)
        for card in FlipInMove
        for draws in (_draws(decisions, flips, frozenset(people), card),)
        for action in dict.fromkeys(sorted(draws.action))
        if action != ActionSpec.NO_HELP.label
    )


def _effect(card: str, action: str, draws: Draws) -> ProximalEffect:
    given = [who for who, taken in zip(draws.person, draws.action, strict=True) if taken == action]
    counts = (card, action, len(given), len(set(given)))
    try:
        return ProximalEffect(*counts, *estimate(draws, action))
    except NotEstimableError as reason:
        return ProximalEffect(*counts, note=str(reason))


def estimate(draws: Draws, action: str, level: float = LEVEL) -> tuple[float, float, float, float, float]:
    """Return the weighted shares of matches under an action and without help, their difference, and its interval.

    Raises NotEstimableError where too few people had the one or the other.
    """
    people, owner = np.unique(np.array(draws.person), return_inverse=True)
    taken = np.array(draws.action)
    sums = [_sums(draws, owner, len(people), taken == each) for each in (action, ActionSpec.NO_HELP.label)]
    had = min(int((weights > 0).sum()) for weights, _ in sums)
    if had < LEAST_PEOPLE:
        raise NotEstimableError(f"only {had} people had such a decision, or one without help")
    one, other = (float(hits.sum() / weights.sum()) for weights, hits in sums)
    without = [(hits.sum() - hits) / (weights.sum() - weights) for weights, hits in sums]
    left_out = without[0] - without[1]
    margin = jackknife_margin(left_out, level)
    return one, other, one - other, one - other - margin, one - other + margin


def _sums(draws: Draws, owner: Any, people: int, rows: Any) -> tuple[Floats, Floats]:
    """Return, for each person, the sum of the weights and of the weighted matches of some decisions."""
    weights = np.where(rows, 1 / draws.probability, 0.0)
    summed, hits = (np.bincount(owner, each, people) for each in (weights, weights * draws.matched))
    return summed.astype(np.float64), hits.astype(np.float64)


def _draws(decisions: ExportTable, flips: ExportTable, people: frozenset[str], card: FlipInMove) -> Draws:
    matched = dict(_matches(flips))
    drawn, probabilities = decisions.truths("randomised"), decisions.numbers("action_probability")
    cells = (decisions.text(name) for name in ("participant_id", "move_card", "action"))
    rows = zip(*cells, drawn, probabilities, decisions.numbers("flip"), strict=True)
    later = 1 if card is FlipInMove.FIRST else 0
    kept = [
        (action, probability, who, matched[who, int(flip) + later])
        for who, move_card, action, randomised, probability, flip in rows
        if randomised and who in people and move_card == card.value and (who, int(flip) + later) in matched
    ]
    actions, chances, whose, hits = zip(*kept, strict=True) if kept else ((), (), (), ())
    return Draws(actions, np.array(chances, dtype=np.float64), whose, np.array(hits, dtype=np.float64))


def _matches(flips: ExportTable) -> Iterator[tuple[tuple[str, int], float]]:
    """Yield, for every second card of the games, whose it was, its number, and whether it matched."""
    cells = (flips.text(name) for name in ("participant_id", "stage", "move_card"))
    for who, stage, card, flip, matched in zip(*cells, flips.numbers("flip"), flips.numbers("matched"), strict=True):
        if stage == Stage.GAME.value and card == FlipInMove.SECOND.value:
            yield (who, int(flip)), float(matched)
