"""Analyse a data set under a plan: flow, descriptives, hypotheses, sensitivity, reliability, models, looks.

Nothing here draws or writes; ``report_json`` gives every number of a report, and kiosk.analysis.report_page shows them.
"""

from __future__ import annotations

import math
import tomllib
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, is_dataclass
from functools import partial
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np

from kiosk.analysis.behaviours import BehaviourCount, MemoryCalibration, count_behaviours, memory_calibration
from kiosk.analysis.compare import BAYES, TESTS, Comparison, Line, adjust, attempt, compare, directed_p, kept_values
from kiosk.analysis.data import ExportedStudy, Floats
from kiosk.analysis.models import Effect, MixedModel, Reliability, collapse, mixed_logistic, reliability, two_by_two
from kiosk.analysis.plan import (
    TEMPLATE,
    Correction,
    Direction,
    Exclusion,
    Hypothesis,
    StudyPlan,
    TestName,
    bayes_factors,
    plan_sha256,
)
from kiosk.analysis.proximal import ProximalEffect, proximal_effects
from kiosk.analysis.sample import Sample, choose_sample
from kiosk.analysis.statistics import Estimate, NotEstimableError, fisher, hedges_g, sensitivity, student, wilson
from kiosk.experiment.condition import Condition
from kiosk.experiment.outcomes import Stage

CONFIRMATORY, EXPLORATORY = "CONFIRMATORY", "EXPLORATORY"

CELLS = {
    Condition.TOM.name: (1, 1),
    Condition.NOTOM.name: (0, 0),
    Condition.MENTALISED_UNEXPLAINED.name: (1, 0),
    Condition.RANDOM_EXPLAINED.name: (0, 1),
}
"""The 2 x 2 design: whether the target is mentalised, and whether a reason is given."""
FACTORS = ("mentalised target", "reason given")


@dataclass(frozen=True)
class Standing:
    """What a report may call itself, and why; ``sha256`` is that of the plan, "" for the default one."""

    status: str
    reason: str
    sha256: str


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
class DesignResult:
    """The effects of the 2 x 2 design on a measure, or the reason why there are none."""

    measure: str
    effects: tuple[Effect, ...]
    note: str = ""


@dataclass(frozen=True)
class ModelResult:
    """A logistic model with a random intercept per person, or the reason why there is none."""

    name: str
    about: str
    model: MixedModel | None
    note: str = ""


@dataclass(frozen=True)
class ScaleResult:
    """The reliability of a scale, or the reason why there is none."""

    name: str
    items: tuple[str, ...]
    found: Reliability | None
    note: str = ""


@dataclass(frozen=True)
class LookResult:
    """A hypothesis at a look, from the first participants of each arm; ``bayes`` is a JZS Bayes factor."""

    per_arm: int
    hypothesis: str
    p: float
    level: float
    bayes: float
    crossed: bool


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
        tuple(_sensitivity(sample, plan)),
        *_completion(sample, plan.conditions),
        tuple(_any_hint(sample, plan)),
        tuple(_scales(sample)),
        tuple(_design(sample)),
        tuple(_models(sample, plan.conditions)),
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


def _mean(x: Floats) -> float:
    return float(x.mean()) if len(x) else math.nan


def check_hypotheses(sample: Sample, plan: StudyPlan) -> tuple[HypothesisResult, ...]:
    """Test the plan's hypotheses at the level of the last look that was reached."""
    reached = min(int(sample.rows(name).sum()) for name in plan.conditions)
    level = next((level for n, level in reversed(plan.levels()) if n <= reached), plan.levels()[0][1])
    looks = plan.sequential is not None
    rows: list[tuple[Hypothesis, TestName, Direction]] = [
        (each, each.test, "two-sided" if looks else each.direction) for each in plan.hypothesis
    ]
    return _tested(sample, plan, rows, _Way(plan.exclusions, plan.correction, level))


def _sensitivity(sample: Sample, plan: StudyPlan) -> Iterator[SensitivityResult]:
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


# Scales, the design and models


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


@dataclass(frozen=True)
class _Trials:
    """Single hints or moves of the people: whether each was a hit, whose, and covariates."""

    hit: Floats
    person: Floats
    more: tuple[Floats, ...] = ()


def _models(sample: Sample, pair: tuple[str, str]) -> Iterator[ModelResult]:
    followed, led, matched = _hints(sample, first_only=False), _hints(sample, first_only=True), _second_cards(sample)
    about = {
        "followed": ("the flip after a hint is the hinted card, or in its row or column", followed),
        "led to match": ("a hint for a first card was followed and its move matched", led),
    }
    conditions = sample.people.text("condition")
    in_pair = np.array([{pair[0]: 1.0, pair[1]: 0.0}.get(name, np.nan) for name in conditions])
    for name, (what, trials) in about.items():
        yield _fitted(name, what, trials, [("constant", None), (f"{pair[0]} less {pair[1]}", in_pair)])
        if set(CELLS) <= set(sample.conditions):
            cells = np.array([CELLS.get(each, (np.nan, np.nan)) for each in conditions])
            one, two = cells[:, 0] - 0.5, cells[:, 1] - 0.5
            terms = [("constant", None), (FACTORS[0], one), (FACTORS[1], two), (" x ".join(FACTORS), one * two)]
            yield _fitted(f"{name}, 2 x 2", f"{what}; factors are coded -1/2 and 1/2", trials, terms)
    yield _fitted(
        "second card matches",
        "a second card completes the pair; middle and end of the game are compared with its beginning",
        matched,
        [("constant", None), (f"{pair[0]} less {pair[1]}", in_pair), ("hinted", 0), ("middle", 1), ("end", 2)],
    )


def _fitted(name: str, about: str, trials: _Trials, terms: Sequence[tuple[str, Floats | int | None]]) -> ModelResult:
    """Fit a model.

    A term is a value for each person, the number of a covariate of the trials, or the constant.
    """
    person = trials.person.astype(np.int64)
    columns = [
        np.ones(len(person)) if term is None else trials.more[term] if isinstance(term, int) else term[person]
        for _, term in terms
    ]
    design = np.column_stack(columns) if len(person) else np.empty((0, len(terms)))
    known = ~np.isnan(design).any(axis=1) & ~np.isnan(trials.hit)
    try:
        data = collapse(trials.hit[known], design[known], person[known])
        return ModelResult(name, about, mixed_logistic(data, [term for term, _ in terms]))
    except NotEstimableError as reason:
        return ModelResult(name, about, None, str(reason))


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


def _owners(sample: Sample, table: str) -> Floats:
    """Return the row of each trial's person among those who are analysed, NaN for others."""
    place = {name: float(row) for row, name in enumerate(sample.people.text("participant_id"))}
    return np.array([place.get(who, np.nan) for who in sample.study.tables[table].text("participant_id")])


def _hints(sample: Sample, *, first_only: bool) -> _Trials:
    hints = sample.study.tables["hints"]
    owner, followed = _owners(sample, "hints"), hints.numbers("followed")
    rows = ~np.isnan(owner) & ~np.isnan(followed)
    hit = followed
    if first_only:
        rows &= np.array([card == "first" for card in hints.text("move_card")], dtype=np.bool_)
        hit = followed * (hints.numbers("move_matched") == 1)
    return _Trials(hit[rows], owner[rows])


def _second_cards(sample: Sample) -> _Trials:
    """Return second cards of the game: matched or not, hinted or not, and their phase.

    The phase goes by the pairs that were found before.
    """
    flips = sample.study.tables["flips"]
    owner = _owners(sample, "flips")
    rows = ~np.isnan(owner)
    rows &= np.array([stage == Stage.GAME.value for stage in flips.text("stage")], dtype=np.bool_)
    rows &= np.array([card == "second" for card in flips.text("move_card")], dtype=np.bool_)
    hit = flips.numbers("matched")[rows]
    people = owner[rows]
    # Rows of a person stand together, in the order in which they happened.
    hits = np.nan_to_num(hit)
    before = np.cumsum(hits) - hits
    if len(people):
        starts = np.flatnonzero(np.r_[True, people[1:] != people[:-1]])
        before -= np.repeat(before[starts], np.diff(np.r_[starts, len(people)]))
    hinted = flips.truths("hinted")[rows].astype(np.float64)
    phase = before // 4
    return _Trials(hit, people, (hinted, (phase == 1).astype(np.float64), (phase >= 2).astype(np.float64)))  # noqa: PLR2004


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
