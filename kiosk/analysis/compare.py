"""Compare two groups in every way that a report shows.

A line has a value, an interval and a p, or the reason why not.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from kiosk.analysis.plan import Correction, Direction, Exclusion, TestName
from kiosk.analysis.statistics import (
    LEAST,
    ROBUSTNESS,
    Estimate,
    Floats,
    NotEstimableError,
    TestResult,
    bayes_factor,
    benjamini_hochberg,
    bootstrap_difference,
    brown_forsythe,
    cohen_d,
    equivalence,
    hedges_g,
    holm,
    mann_whitney,
    permutation,
    pooled_sd,
    require_groups,
    shapiro,
    student,
    welch,
)

TWO_SD = 2.0


@dataclass(frozen=True)
class Line:
    """One number of a comparison; what does not apply is NaN, and ``note`` says why or how."""

    name: str
    symbol: str = ""
    statistic: float = math.nan
    df: float = math.nan
    p: float = math.nan
    estimate: float = math.nan
    low: float = math.nan
    high: float = math.nan
    note: str = ""

    @property
    def known(self) -> bool:
        """Whether the data determine it."""
        return not (math.isnan(self.statistic) and math.isnan(self.estimate))


def attempt(name: str, symbol: str, work: Callable[[], TestResult | Estimate | float]) -> Line:
    """Work out one line; data that do not determine it give a line with the reason."""
    try:
        found = work()
    except NotEstimableError as reason:
        return Line(name, symbol, note=str(reason))
    if isinstance(found, TestResult):
        df, value, low, high = (
            math.nan if each is None else each for each in (found.df, found.estimate, found.low, found.high)
        )
        return Line(name, symbol, found.statistic, df, found.p, value, low, high, found.note)
    if isinstance(found, Estimate):
        return Line(name, symbol, estimate=found.value, low=found.low, high=found.high)
    return Line(name, symbol, estimate=found)


@dataclass(frozen=True)
class Comparison:
    """One measure in two groups; ``n``, ``mean``, ``sd`` and ``median`` are of the first and the second group."""

    measure: str
    groups: tuple[str, str]
    n: tuple[int, int]
    mean: tuple[float, float]
    sd: tuple[float, float]
    median: tuple[float, float]
    lines: tuple[Line, ...]

    def line(self, name: str) -> Line:
        """Return the line of this name."""
        return next(line for line in self.lines if line.name == name)


TESTS: dict[TestName, tuple[str, Callable[[Floats, Floats], TestResult]]] = {
    "welch": ("t", welch),
    "student": ("t", student),
    "mann-whitney": ("U", mann_whitney),
}


def compare(measure: str, groups: tuple[str, str], x: Floats, y: Floats, smallest: float | None = None) -> Comparison:
    """Compare two groups in every way.

    ``smallest`` is the effect of interest in pooled SDs, for equivalence.
    Without it there are Welch's test and Hedges' g only.
    """
    # Results of tests are differences, x less y, in the measure's own unit unless the line says otherwise.
    return Comparison(
        measure,
        groups,
        (len(x), len(y)),
        (_mean(x), _mean(y)),
        (_sd(x), _sd(y)),
        (_median(x), _median(y)),
        tuple(_brief_lines(x, y) if smallest is None else _lines(x, y, groups, smallest)),
    )


def _brief_lines(x: Floats, y: Floats) -> Iterator[Line]:
    yield attempt("welch", "t", partial(welch, x, y))
    yield attempt("hedges_g", "g", partial(hedges_g, x, y))


def _lines(x: Floats, y: Floats, groups: tuple[str, str], smallest: float) -> Iterator[Line]:
    for test, (symbol, work) in TESTS.items():
        yield attempt(test, symbol, partial(work, x, y))
    yield attempt("permutation", "", partial(permutation, x, y))
    yield attempt("equivalence", "t", partial(_equivalence, x, y, smallest))
    yield attempt("bootstrap", "", partial(bootstrap_difference, x, y))
    yield attempt("hedges_g", "g", partial(hedges_g, x, y))
    yield attempt("cohen_d", "d", partial(cohen_d, x, y))
    for scale in ROBUSTNESS:
        yield attempt(f"bayes_{scale:.3g}", "BF10", partial(_bayes, x, y, scale))
    for name, values in zip(groups, (x, y), strict=True):
        yield attempt(f"shapiro_{name}", "W", partial(shapiro, values))
    yield attempt("brown_forsythe", "F", partial(brown_forsythe, x, y))


BAYES = f"bayes_{ROBUSTNESS[1]:.3g}"
"""The line of the Bayes factor with the default prior scale."""


def _equivalence(x: Floats, y: Floats, smallest: float) -> TestResult:
    require_groups(x, y)
    return equivalence(x, y, smallest * pooled_sd(x, y))


def _bayes(x: Floats, y: Floats, scale: float) -> float:
    return bayes_factor(student(x, y).statistic, len(x), len(y), scale)


def _mean(x: Floats) -> float:
    return float(x.mean()) if len(x) else math.nan


def _median(x: Floats) -> float:
    return float(np.median(x)) if len(x) else math.nan


def _sd(x: Floats) -> float:
    return float(x.std(ddof=1)) if len(x) > 1 else math.nan


def kept_values(groups: Sequence[Floats], exclusions: Exclusion) -> list[Floats]:
    """Return the values that a plan's rule leaves in each group; a rule on values needs three in each."""
    if exclusions == "technical" or min(map(len, groups)) < LEAST:
        return list(groups)
    both = np.concatenate(groups)
    bases = [both for _ in groups] if exclusions == "2sd-pooled" else groups
    return [
        group[np.abs(group - base.mean()) <= TWO_SD * base.std(ddof=1)]
        for group, base in zip(groups, bases, strict=True)
    ]


def directed_p(p: float, difference: float, direction: Direction) -> float:
    """Return the p of a test in its direction, from the two-sided one and the sign of the difference."""
    if direction == "two-sided" or math.isnan(p):
        return p
    right = difference < 0 if direction == "less" else difference > 0
    return p / 2 if right else 1 - p / 2


def adjust(ps: Sequence[float], families: Sequence[str], correction: Correction) -> list[float]:
    """Correct p values within each family; a NaN stays one and does not count."""
    adjusted = list(ps)
    if correction == "none":
        return adjusted
    rule = holm if correction == "holm" else benjamini_hochberg
    for family in dict.fromkeys(families):
        members = [at for at, name in enumerate(families) if name == family]
        for at, p in zip(members, rule([ps[at] for at in members]), strict=True):
            adjusted[at] = p
    return adjusted
