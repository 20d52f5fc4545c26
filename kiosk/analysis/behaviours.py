"""What the helper did besides the paper's hints, and how well the model of memory predicted second cards."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from kiosk.analysis.data import ExportTable, Floats
from kiosk.analysis.statistics import jackknife_margin
from kiosk.assistance.policy import FlipInMove
from kiosk.experiment.events import HintCue
from kiosk.experiment.outcomes import Stage

BINS = 10
"""Equal parts of the range of a chance."""
LEAST_PEOPLE = 3
"""People without whom a share has no interval."""
LEVEL = 0.95
LOOK = "look"


@dataclass(frozen=True)
class BehaviourCount:
    """How often the helper behaved in a way in the games of a condition's people."""

    condition: str
    behaviour: str
    times: int
    per_person: float


def count_behaviours(
    remarks: ExportTable | None, hints: ExportTable, conditions: Mapping[str, str]
) -> Iterator[BehaviourCount]:
    """Yield looks and remarks by condition; ``conditions`` holds the condition of each person who is analysed."""
    told: Counter[tuple[str, str]] = Counter()
    if "cue" in hints.columns:
        cues = zip(hints.text("participant_id"), hints.text("cue"), strict=True)
        told.update((conditions[who], LOOK) for who, cue in cues if cue == HintCue.GAZE.value and who in conditions)
    if remarks is not None:
        said = zip(remarks.text("participant_id"), remarks.text("remark"), strict=True)
        told.update((conditions[who], remark) for who, remark in said if who in conditions)
    people = Counter(conditions.values())
    for behaviour in sorted({behaviour for _, behaviour in told}):
        for condition, number in people.items():
            times = told[condition, behaviour]
            yield BehaviourCount(condition, behaviour, times, times / number)


@dataclass(frozen=True)
class ReliabilityBin:
    """Second cards with predictions in one part of the range, and the share of them that matched.

    The interval comes from leaving out one person at a time; it is NaN with fewer than three people.
    """

    low: float
    cards: int
    people: int
    predicted: float
    matched: float
    matched_low: float = math.nan
    matched_high: float = math.nan


@dataclass(frozen=True)
class MemoryCalibration:
    """How well the model of memory predicted whether second cards without a hint matched.

    ``brier`` is the mean squared error of the predictions, ``brier_of_share`` that of always predicting the share of
    matches, and ``calibration_error`` the mean distance of prediction and share over the bins, weighed by their cards.
    """

    cards: int
    people: int
    brier: float
    brier_of_share: float
    calibration_error: float
    bins: tuple[ReliabilityBin, ...]


def memory_calibration(decisions: ExportTable, flips: ExportTable, people: frozenset[str]) -> MemoryCalibration | None:
    """Return the calibration over the second cards of these people; None if the model predicted none."""
    outcomes = dict(_unhelped(flips))
    cells = zip(
        decisions.text("participant_id"),
        decisions.text("move_card"),
        decisions.numbers("flip"),
        decisions.numbers("completes_predicted"),
        strict=True,
    )
    kept = [
        (who, chance, outcomes[who, int(flip)])
        for who, card, flip, chance in cells
        if who in people and card == FlipInMove.SECOND.value and (who, int(flip)) in outcomes and not math.isnan(chance)
    ]
    if not kept:
        return None
    whose, chances, hits = zip(*kept, strict=True)
    return calibrated(np.array(chances), np.array(hits), np.array(whose))


def _unhelped(flips: ExportTable) -> Iterator[tuple[tuple[str, int], float]]:
    """Yield the second cards of games that had no hint: whose, which number, and whether it matched."""
    cells = (flips.text(name) for name in ("participant_id", "stage", "move_card"))
    numbers = (flips.numbers("flip"), flips.numbers("matched"), flips.truths("hinted"))
    for who, stage, card, flip, matched, hinted in zip(*cells, *numbers, strict=True):
        if stage == Stage.GAME.value and card == FlipInMove.SECOND.value and not hinted:
            yield (who, int(flip)), float(matched)


def calibrated(chances: Floats, hits: Floats, whose: np.ndarray[tuple[int], np.dtype[np.str_]]) -> MemoryCalibration:
    """Compare predicted chances with what came (0 or 1), of one person or several."""
    share = float(hits.mean())
    place = np.minimum((chances * BINS).astype(int), BINS - 1)
    bins = tuple(
        _bin(number / BINS, chances[rows], hits[rows], whose[rows])
        for number in range(BINS)
        for rows in (place == number,)
        if rows.any()
    )
    return MemoryCalibration(
        len(hits),
        len(np.unique(whose)),
        float(((chances - hits) ** 2).mean()),
        share * (1 - share),
        sum(each.cards * abs(each.predicted - each.matched) for each in bins) / len(hits),
        bins,
    )


def _bin(low: float, chances: Floats, hits: Floats, whose: np.ndarray[tuple[int], np.dtype[np.str_]]) -> ReliabilityBin:
    people, owner = np.unique(whose, return_inverse=True)
    n = len(people)
    matched = float(hits.mean())
    found = (low, len(hits), n, float(chances.mean()), matched)
    if n < LEAST_PEOPLE:
        return ReliabilityBin(*found)
    cards, sums = np.bincount(owner), np.bincount(owner, hits)
    margin = jackknife_margin((hits.sum() - sums) / (len(hits) - cards), LEVEL)
    return ReliabilityBin(*found, max(0.0, matched - margin), min(1.0, matched + margin))
