"""Test the hypotheses of a plan: at the end, in the other ways that it declares, and at its looks."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from kiosk.analysis.compare import BAYES, TESTS, Line, adjust, attempt, directed_p, kept_values
from kiosk.analysis.data import Floats
from kiosk.analysis.plan import Correction, Direction, Exclusion, Hypothesis, StudyPlan, TestName, bayes_factors
from kiosk.analysis.sample import Sample
from kiosk.analysis.statistics import hedges_g, student


@dataclass(frozen=True)
class HypothesisResult:
    """A hypothesis of the plan: its test after the exclusions, the p in its direction, corrected, and the verdict."""

    id: str
    family: str
    measure: str
    direction: str
    test: str
    n: tuple[int, int]
    excluded: tuple[int, int]
    line: Line
    hedges_g: Line
    bayes: float
    p: float
    corrected: float
    level: float
    verdict: str


@dataclass(frozen=True)
class SensitivityResult:
    """The hypotheses under another row of the plan."""

    name: str
    results: tuple[HypothesisResult, ...]


@dataclass(frozen=True)
class LookResult:
    """A hypothesis at a look, from the first participants of each arm; ``bayes`` is a JZS Bayes factor."""

    per_arm: int
    hypothesis: str
    p: float
    level: float
    bayes: float
    crossed: bool


def check_hypotheses(sample: Sample, plan: StudyPlan) -> tuple[HypothesisResult, ...]:
    """Test the plan's hypotheses at the level of the last look that was reached."""
    reached = min(int(sample.rows(name).sum()) for name in plan.conditions)
    level = next((level for n, level in reversed(plan.levels()) if n <= reached), plan.levels()[0][1])
    looks = plan.sequential is not None
    rows: list[tuple[Hypothesis, TestName, Direction]] = [
        (each, each.test, "two-sided" if looks else each.direction) for each in plan.hypothesis
    ]
    return _tested(sample, plan, rows, _Way(plan.exclusions, plan.correction, level))


def check_sensitivity(sample: Sample, plan: StudyPlan) -> Iterator[SensitivityResult]:
    """Test the plan's hypotheses under each of its rows of sensitivity."""
    for row in plan.sensitivity:
        rows: list[tuple[Hypothesis, TestName, Direction]] = [
            (each, row.test, each.direction if row.one_sided else "two-sided") for each in plan.hypothesis
        ]
        yield SensitivityResult(row.name, _tested(sample, plan, rows, _Way(row.exclusions, row.correction, plan.alpha)))


@dataclass(frozen=True)
class _Way:
    """How hypotheses are tested, besides each one's test and direction."""

    exclusions: Exclusion
    correction: Correction
    level: float


def _tested(
    sample: Sample, plan: StudyPlan, rows: Sequence[tuple[Hypothesis, TestName, Direction]], way: _Way
) -> tuple[HypothesisResult, ...]:
    """Test hypotheses in one way; each row is one with its test and direction."""
    found = []
    for hypothesis, test, direction in rows:
        all_values = [sample.values(hypothesis.measure, name) for name in plan.conditions]
        x, y = kept_values(all_values, way.exclusions)
        symbol, work = TESTS[test]
        line = attempt(test, symbol, partial(work, x, y))
        g = attempt("hedges_g", "g", partial(hedges_g, x, y))
        bayes = attempt(BAYES, "BF10", partial(_bayes, x, y))
        p = directed_p(line.p, line.estimate, direction)
        found.append((hypothesis, direction, line, g, bayes.estimate, p, all_values, (x, y)))
    corrected = adjust([row[5] for row in found], [row[0].family for row in found], way.correction)
    return tuple(
        HypothesisResult(
            hypothesis.id,
            hypothesis.family,
            hypothesis.measure,
            direction,
            line.name,
            (len(kept[0]), len(kept[1])),
            (len(before[0]) - len(kept[0]), len(before[1]) - len(kept[1])),
            line,
            g,
            bayes,
            p,
            q,
            way.level,
            _verdict(plan, hypothesis, line, bayes, supports=q < way.level),
        )
        for (hypothesis, direction, line, g, bayes, p, before, kept), q in zip(found, corrected, strict=True)
    )


def _bayes(x: Floats, y: Floats) -> float:
    t = student(x, y).statistic
    return float(bayes_factors(np.array([t]), len(x), len(y))[0])


def _verdict(plan: StudyPlan, hypothesis: Hypothesis, line: Line, bayes: float, *, supports: bool) -> str:
    """Whether the data support a hypothesis, in a word or two."""
    if math.isnan(line.p):
        return f"not tested: {line.note or 'no values'}"
    if plan.sequential is not None and plan.sequential.spending == "bayes":
        supports = bayes >= plan.sequential.bayes_bound
    in_direction = hypothesis.direction == "two-sided" or (line.estimate < 0) == (hypothesis.direction == "less")
    return "supported" if supports and in_direction else "not supported"


# Looks


def reached_looks(sample: Sample, plan: StudyPlan) -> tuple[LookResult, ...]:
    """Return the hypotheses at every declared look that was reached, from the first people of each arm; two-sided."""
    reached = min(int(sample.rows(name).sum()) for name in plan.conditions)
    looks = plan.sequential.looks if plan.sequential is not None else ()
    return tuple(result for n in looks if n <= reached for result in _look(sample, plan, n))


def _look(sample: Sample, plan: StudyPlan, n: int) -> Iterator[LookResult]:
    sequential = plan.sequential
    ps, factors = [], []
    for hypothesis in plan.hypothesis:
        x, y = kept_values([_first(sample, hypothesis.measure, name, n) for name in plan.conditions], plan.exclusions)
        ps.append(attempt("", "", partial(TESTS[hypothesis.test][1], x, y)).p)
        factors.append(attempt("", "", partial(_bayes, x, y)).estimate)
    adjusted = adjust(ps, [each.family for each in plan.hypothesis], plan.correction)
    bound = sequential.bayes_bound if sequential is not None and sequential.spending == "bayes" else None
    level = math.nan if bound is not None else dict(plan.levels())[n]
    for hypothesis, p, factor in zip(plan.hypothesis, adjusted, factors, strict=True):
        crossed = p <= level if bound is None else factor >= bound or factor <= 1 / bound
        yield LookResult(n, hypothesis.id, p, level, factor, crossed)


def _first(sample: Sample, measure: str, condition: str, n: int) -> Floats:
    """Return the known values of the first ``n`` people of an arm."""
    if measure not in sample.measured:
        return np.empty(0)
    values = sample.measured[measure][sample.rows(condition)][:n]
    return values[~np.isnan(values)]
