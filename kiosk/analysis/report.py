"""Analyse a data set under a plan: flow, descriptives, hypotheses, sensitivity, reliability, models, looks.

Nothing here draws or writes; ``report_json`` gives every number of a report, and kiosk.analysis.report_page shows them.
"""

from __future__ import annotations

import math
import tomllib
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, is_dataclass
from functools import partial
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np

from kiosk.analysis.behaviours import BehaviourCount, MemoryCalibration, count_behaviours, memory_calibration
from kiosk.analysis.compare import Comparison, Line, adjust, attempt, compare
from kiosk.analysis.data import ExportedStudy, Floats
from kiosk.analysis.hypotheses import (
    HypothesisResult,
    LookResult,
    SensitivityResult,
    check_hypotheses,
    check_sensitivity,
    reached_looks,
)
from kiosk.analysis.models import Effect, Reliability, reliability, two_by_two
from kiosk.analysis.plan import TEMPLATE, StudyPlan, plan_sha256
from kiosk.analysis.proximal import ProximalEffect, proximal_effects
from kiosk.analysis.sample import Sample, choose_sample
from kiosk.analysis.statistics import Estimate, NotEstimableError, fisher, sensitivity, wilson
from kiosk.analysis.trial_models import CELLS, FACTORS, ModelResult, fit_models
from kiosk.experiment.outcomes import Stage

CONFIRMATORY, EXPLORATORY = "CONFIRMATORY", "EXPLORATORY"


@dataclass(frozen=True)
class Standing:
    """What a report may call itself, and why; ``sha256`` is that of the plan, "" for the default one."""

    status: str
    reason: str
    sha256: str


@dataclass(frozen=True)
class DesignResult:
    """The effects of the 2 x 2 design on a measure, or the reason why there are none."""

    measure: str
    effects: tuple[Effect, ...]
    note: str = ""


@dataclass(frozen=True)
class ScaleResult:
    """The reliability of a scale, or the reason why there is none."""

    name: str
    items: tuple[str, ...]
    found: Reliability | None
    note: str = ""


@dataclass(frozen=True)
class Completion:
    """How many of those who were allocated a condition completed the game, and where the others ended."""

    condition: str
    allocated: int
    completed: int
    share: Estimate
    ended: Mapping[str, int]


@dataclass(frozen=True)
class Report:
    """All numbers of a report."""

    sample: Sample
    plan: StudyPlan
    standing: Standing
    comparisons: tuple[Comparison, ...]
    others: tuple[tuple[Comparison, float], ...]
    hypotheses: tuple[HypothesisResult, ...]
    sensitivity: tuple[SensitivityResult, ...]
    completion: tuple[Completion, ...]
    completion_p: Line
    any_hint: tuple[Comparison, ...]
    scales: tuple[ScaleResult, ...]
    design: tuple[DesignResult, ...]
    models: tuple[ModelResult, ...]
    looks: tuple[LookResult, ...]
    detectable: float
    proximal: tuple[ProximalEffect, ...] = ()
    """The effect of each kind of hint on its own move; empty unless the study explores."""
    behaviours: tuple[BehaviourCount, ...] = ()
    """Looks and remarks by condition; empty unless the study has some."""
    memory: MemoryCalibration | None = None
    """How well the model of memory predicted; None without one."""

    @property
    def pair(self) -> tuple[str, str]:
        """The two conditions that the plan compares."""
        return self.plan.conditions

    def comparison(self, measure: str) -> Comparison:
        """Return the comparison of the plan's conditions in a measure."""
        return next(each for each in self.comparisons if each.measure == measure)


def make_report(
    study: ExportedStudy, plan_file: Path | None = None, declared: Mapping[str, str] | None = None
) -> Report:
    """Analyse a data set under a plan file, the plan that was frozen with it, or else the template.

    Raises UserInputError where the data cannot be compared, and before a look that the plan declares.
    """
    frozen = study.plans[-1].file if study.plans else None
    file = plan_file or frozen
    plan = StudyPlan.read(file) if file is not None else _default_plan(study)
    sample = choose_sample(study, plan, declared)
    _refuse_before_looks(study, sample, plan)
    standing = _standing(study, sample, plan_sha256(file) if file is not None else "")
    comparisons = tuple(_compared(sample, each.name, plan.conditions, plan.smallest_effect) for each in sample.measures)
    hypotheses = check_hypotheses(sample, plan)
    return Report(
        sample,
        plan,
        standing,
        comparisons,
        _other_pairs(sample, plan),
        hypotheses,
        tuple(check_sensitivity(sample, plan)),
        *_completion(sample, plan.conditions),
        tuple(_any_hint(sample, plan)),
        tuple(_scales(sample)),
        tuple(_design(sample)),
        tuple(fit_models(sample, plan.conditions)),
        reached_looks(sample, plan),
        sensitivity(*(int(sample.rows(name).sum()) for name in plan.conditions)),
        _proximal(sample),
        tuple(_behaviours(sample)),
        _memory(sample),
    )


def _default_plan(study: ExportedStudy) -> StudyPlan:
    """Return the template for the conditions that occur; its first two, unless the study's own pair is there."""
    plan = StudyPlan.model_validate(tomllib.loads(TEMPLATE))
    found = study.conditions
    if len(found) > 1 and not set(plan.conditions) <= set(found):
        return plan.model_copy(update={"conditions": found[:2]})
    return plan


def _refuse_before_looks(study: ExportedStudy, sample: Sample, plan: StudyPlan) -> None:
    """Keep results by condition closed before a declared look; simulated data may be looked at at any time."""
    if sample.simulated or not study.plans:
        return
    completed = Counter(sample.exported.where(sample.exported.truths("game_completed")).text("condition"))
    for each in (StudyPlan.read(study.plans[-1].file), plan):
        each.refuse_before_look(min(completed[name] for name in each.conditions))


def _standing(study: ExportedStudy, sample: Sample, sha256: str) -> Standing:
    frozen = next((each for each in study.plans if each.sha256 == sha256), None)
    if sample.simulated:
        return Standing(EXPLORATORY, "the data are simulated, no person took part", sha256)
    if not sha256:
        return Standing(EXPLORATORY, "no plan was frozen before the data were collected", sha256)
    if frozen is None:
        return Standing(EXPLORATORY, "this plan is not one that was frozen in the data folder", sha256)
    if not frozen.before_first_session:
        return Standing(EXPLORATORY, "the plan was frozen after the first session", sha256)
    reason = "the plan was frozen in the data folder before the first session"
    if len(study.plans) > 1:
        reason += f"; {len(study.plans)} plans were frozen, and this is number {study.plans.index(frozen) + 1}"
    return Standing(CONFIRMATORY, reason, sha256)


# Comparisons


def _compared(sample: Sample, measure: str, pair: tuple[str, str], smallest: float | None = None) -> Comparison:
    return compare(measure, pair, sample.values(measure, pair[0]), sample.values(measure, pair[1]), smallest)


def _other_pairs(sample: Sample, plan: StudyPlan) -> tuple[tuple[Comparison, float], ...]:
    """Every other pair of conditions in the measures of the hypotheses, with p corrected by Holm within a measure."""
    found: list[tuple[Comparison, float]] = []
    pairs = [pair for pair in combinations(sample.conditions, 2) if set(pair) != set(plan.conditions)]
    for measure in dict.fromkeys(each.measure for each in plan.hypothesis):
        if measure not in sample.measured:
            continue
        compared = [_compared(sample, measure, pair) for pair in pairs]
        ps = adjust([each.line("welch").p for each in compared], [measure] * len(compared), "holm")
        found += zip(compared, ps, strict=True)
    return tuple(found)


# Participants


def _completion(sample: Sample, pair: tuple[str, str]) -> tuple[tuple[Completion, ...], Line]:
    """Who of the people that chance allocated completed the game, by condition, and whether the plan's two differ."""
    drawn = sample.drawn
    done, stages, conditions = drawn.truths("game_completed"), drawn.text("last_stage"), drawn.text("condition")
    order = [stage.value for stage in Stage]
    found = []
    for name in dict.fromkeys((*sample.conditions, *sorted(set(conditions)))):
        rows = [row for row, condition in enumerate(conditions) if condition == name]
        left = Counter(stages[row] for row in rows if not done[row])
        ended = {stage: left[stage] for stage in sorted(left, key=order.index)}
        completed = int(done[rows].sum())
        found.append(Completion(name, len(rows), completed, wilson(completed, len(rows)), ended))
    cells = [each for each in found if each.condition in pair]
    table = [(each.completed, each.allocated - each.completed) for each in cells]
    return tuple(found), attempt("fisher", "", partial(fisher, table))


def _any_hint(sample: Sample, plan: StudyPlan) -> Iterator[Comparison]:
    """Yield what can be compared among all who saw a first hint, whether or not they completed the game."""
    if plan.population == "allocated":
        return
    everyone = choose_sample(sample.study, plan.model_copy(update={"population": "allocated"}))
    for measure in ("assistance_per_flip", "followed_rate", "first_led_to_match_rate"):
        yield _compared(everyone, measure, plan.conditions)


# Scales and the design


def _scales(sample: Sample) -> Iterator[ScaleResult]:
    for scale in sample.scales:
        try:
            yield ScaleResult(scale.name, scale.items, reliability(scale.scored))
        except NotEstimableError as reason:
            yield ScaleResult(scale.name, scale.items, None, str(reason))


def _design(sample: Sample) -> Iterator[DesignResult]:
    if not set(CELLS) <= set(sample.conditions):
        return
    conditions = sample.people.text("condition")
    for measure in sample.measures:
        values = sample.measured[measure.name]
        rows = [row for row, name in enumerate(conditions) if name in CELLS and not np.isnan(values[row])]
        first, second = (
            np.array([CELLS[conditions[row]][factor] for row in rows], dtype=np.int64) for factor in (0, 1)
        )
        try:
            yield DesignResult(measure.name, two_by_two(values[rows], first, second, FACTORS))
        except NotEstimableError as reason:
            yield DesignResult(measure.name, (), str(reason))


def _proximal(sample: Sample) -> tuple[ProximalEffect, ...]:
    decisions = sample.study.decisions
    if decisions is None:
        return ()
    return proximal_effects(decisions, sample.study.tables["flips"], sample.people.text("participant_id"))


def _behaviours(sample: Sample) -> Iterator[BehaviourCount]:
    people = (sample.people.text(name) for name in ("participant_id", "condition"))
    study = sample.study
    return count_behaviours(study.remarks, study.tables["hints"], dict(zip(*people, strict=True)))


def _memory(sample: Sample) -> MemoryCalibration | None:
    modelled = sample.study.modelled
    if modelled is None:
        return None
    return memory_calibration(modelled, sample.study.tables["flips"], frozenset(sample.people.text("participant_id")))


# All numbers


def report_json(report: Report) -> dict[str, Any]:
    """Every number of a report, for programs; what does not apply is null."""
    sample = report.sample
    return {
        "status": report.standing.status,
        "reason": report.standing.reason,
        "title": sample.study.title,
        "data_sha256": sample.study.sha256,
        "plan_sha256": report.standing.sha256,
        "conditions": list(sample.conditions),
        "compared": list(report.pair),
        "analysed": {name: int(sample.rows(name).sum()) for name in sample.conditions},
        "later_visits": sample.later,
        "exclusions": [_plain(step) for step in sample.steps],
        "completion": _plain(report.completion),
        "completion_p": _number(report.completion_p.estimate),
        "descriptives": describe(sample),
        "hypotheses": _plain(report.hypotheses),
        "sensitivity": _plain(report.sensitivity),
        "comparisons": _plain(report.comparisons),
        "other_pairs": [_plain(each) | {"corrected": _number(p)} for each, p in report.others],
        "all_with_a_hint": _plain(report.any_hint),
        "reliability": _plain(report.scales),
        "two_by_two": _plain(report.design),
        "models": _plain(report.models),
        "proximal_effects": _plain(report.proximal),
        "behaviours": _plain(report.behaviours),
        "memory_model": _plain(report.memory),
        "looks": _plain(report.looks),
        "detectable_d": _number(report.detectable),
    }


def describe(sample: Sample) -> list[dict[str, Any]]:
    """n, mean, SD, quartiles and the ends of every measure in every condition."""
    rows = []
    for measure in sample.measures:
        for name in sample.conditions:
            values = sample.values(measure.name, name)
            five = np.percentile(values, [0, 25, 50, 75, 100]).tolist() if len(values) else [math.nan] * 5
            least, low, median, high, most = five
            row = {"measure": measure.name, "condition": name, "n": len(values), "mean": _mean(values)}
            row |= {"sd": float(values.std(ddof=1)) if len(values) > 1 else math.nan, "median": median}
            row |= {"q1": low, "q3": high, "least": least, "most": most}
            rows.append(_plain(row))
    return rows


def _mean(x: Floats) -> float:
    return float(x.mean()) if len(x) else math.nan


def _plain(value: Any) -> Any:
    """Dataclasses and mappings as JSON has them."""
    if is_dataclass(value) and not isinstance(value, type):
        return _plain(asdict(value))
    if isinstance(value, Mapping):
        return {key: _plain(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(each) for each in value]
    return _number(value) if isinstance(value, float) else value


def _number(value: float) -> float | None:
    return None if math.isnan(value) or math.isinf(value) else float(value)
