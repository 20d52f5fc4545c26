"""Power and type I error of a plan, by simulating whole studies: games, exclusions, tests and corrections.

A seed belongs to a block of studies, never to a worker, so any number of workers gives the same numbers. Every finished
block is added to a file; a run that was killed goes on from there.
"""

from __future__ import annotations

import hashlib
import io
import json
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import asdict, dataclass
from importlib import import_module
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from kiosk import UserInputError
from kiosk.analysis.compare import kept_values
from kiosk.analysis.plan import Correction, Exclusion, StudyPlan, bayes_factors
from kiosk.analysis.simulated_study import HIGHEST_SUM, LOWEST_SUM, PACE_SPREAD, SCALES, SECONDS_PER_FLIP
from kiosk.analysis.statistics import benjamini_hochberg, holm, student_error, two_sided, welch_error
from kiosk.assistance.mentaliser import TargetRule
from kiosk.assistance.policy import ACTIONS, QTable
from kiosk.experiment.condition import Condition, target_rule
from kiosk.files import parse_json
from kiosk.training.simulated_players import PopulationPlayer
from kiosk.training.simulation import (
    T_COL,
    T_FIRST,
    T_FLIPS,
    T_FOLLOWED_FIRST,
    T_FOLLOWED_SECOND,
    T_LED,
    T_SECOND,
    simulate_games,
)
from kiosk.training.vectorised_game import SUG_COL

Array = NDArray[np.float64]

BLOCK = 50
"""Studies in a block."""
REFERENCE_EFFECTS = (0.35, 0.8)
"""Cohen's d of two normal measures that stand beside the plan's own: the two effects that the paper names."""
WANTED_POWER = 0.8

Progress = Callable[[int, int], None]


@dataclass(frozen=True)
class PowerJob:
    """Everything that fixes the numbers, plain enough to be sent to another machine."""

    plan: str
    policy: str
    rule: str
    people: dict[str, float]
    sizes: tuple[int, ...]
    studies: int
    seed: int
    null: bool
    shifts: tuple[tuple[str, float], ...] = ()

    @property
    def key(self) -> str:
        """A hash over all of it: blocks of another job are not taken for this one's."""
        return hashlib.sha256(json.dumps(asdict(self), sort_keys=True).encode()).hexdigest()

    @property
    def blocks(self) -> int:
        """How many blocks there are."""
        return -(-self.studies // BLOCK)


def run_block(job: PowerJob, block: int) -> list[list[list[float]]]:
    """Simulate one block; the two-sided p of each study, test and size, signed by the direction of the difference.

    The tests are the plan's hypotheses, the reference effects, then the hypotheses under each sensitivity row.
    """
    plan = StudyPlan.model_validate_json(job.plan, strict=False)
    rng = np.random.default_rng([job.seed, block])
    most = max(job.sizes)
    studies = min(BLOCK, job.studies - block * BLOCK)
    arms = [_arm(job, name, studies * most, rng, first=at == 0) for at, name in enumerate(plan.conditions)]
    found = []
    for study in range(studies):
        rows = slice(study * most, (study + 1) * most)
        one, two = ({name: values[rows] for name, values in arm.items()} for arm in arms)
        found.append([[_signed(test, one, two, size) for size in job.sizes] for test in _tests(plan)])
    return found


def _arm(job: PowerJob, name: str, games: int, rng: np.random.Generator, *, first: bool) -> dict[str, Array]:
    """Return the measures of many participants of one arm."""
    plan = StudyPlan.model_validate_json(job.plan, strict=False)
    where = target_rule(Condition(plan.conditions[1] if job.null else name).known, TargetRule(job.rule))
    policy = QTable.from_json(job.policy) if where else QTable.blank()
    seed = int(rng.integers(2**62))
    played = simulate_games(policy, PopulationPlayer(**job.people), where or TargetRule.RANDOM, games, seed)
    tallies = np.array(played.tallies, dtype=float)
    flips = tallies[:, T_FLIPS]
    levels = sum(tallies[:, T_COL + int(action) - SUG_COL] * action.level for action in ACTIONS if int(action))
    with np.errstate(invalid="ignore"):
        hints = tallies[:, T_FIRST] + tallies[:, T_SECOND]
        followed = (tallies[:, T_FOLLOWED_FIRST] + tallies[:, T_FOLLOWED_SECOND]) / hints
        led = tallies[:, T_LED] / tallies[:, T_FIRST]
    pace = np.exp(np.log(SECONDS_PER_FLIP) + PACE_SPREAD * rng.standard_normal(games))
    measures = {
        "flips": flips,
        "completion_ms": 1000 * pace * flips,
        "assistance_per_flip": levels / flips,
        "followed_rate": followed,
        "first_led_to_match_rate": led,
    }
    shifts = dict(job.shifts) if first and not job.null else {}
    for scale, (mean, sd) in SCALES.items():
        drawn = mean + sd * (rng.standard_normal(games) + shifts.get(f"{scale}_sum", 0.0))
        measures[f"{scale}_sum"] = np.clip(np.rint(drawn), LOWEST_SUM, HIGHEST_SUM)
    for effect in REFERENCE_EFFECTS:
        measures[_reference(effect)] = rng.standard_normal(games) + (effect if first and not job.null else 0.0)
    lost = rng.random(games) < plan.expected_exclusions
    for values in measures.values():
        values[lost] = np.nan
    return measures


def _reference(effect: float) -> str:
    return f"d = {effect:g}"


@dataclass(frozen=True, slots=True)
class _Test:
    name: str
    measure: str
    test: str
    exclusions: Exclusion
    direction: str


def _tests(plan: StudyPlan) -> list[_Test]:
    own = [_Test(each.id, each.measure, each.test, plan.exclusions, each.direction) for each in plan.hypothesis]
    own += [_Test(_reference(d), _reference(d), "welch", "technical", "two-sided") for d in REFERENCE_EFFECTS]
    for row in plan.sensitivity:
        for each in plan.hypothesis:
            side = each.direction if row.one_sided else "two-sided"
            own.append(_Test(f"{each.id} ({row.name})", each.measure, row.test, row.exclusions, side))
    return own


def _signed(test: _Test, one: dict[str, Array], two: dict[str, Array], size: int) -> float:
    """Return the two-sided p, negative where the first group is lower; NaN where there is no test."""
    groups = [arm[test.measure][:size] for arm in (one, two)]
    x, y = kept_values([group[~np.isnan(group)] for group in groups], test.exclusions)
    if min(len(x), len(y)) < 3 or (np.ptp(x) == 0 and np.ptp(y) == 0):  # noqa: PLR2004 - no variance from fewer
        return float("nan")
    if test.test == "mann-whitney":
        p = float(stats.mannwhitneyu(x, y, method="asymptotic").pvalue)
        lower = bool(stats.rankdata(np.concatenate([x, y]))[: len(x)].mean() < (len(x) + len(y) + 1) / 2)
    else:
        # welch() and student() also make intervals, which would take most of the time of a simulation.
        error, df = (student_error if test.test == "student" else welch_error)(x, y)
        t = float(x.mean() - y.mean()) / error
        p, lower = two_sided(t, df), t < 0
    return -p if lower else p


# Running


def run(job: PowerJob, store: Path, workers: int = 1, scheduler: str = "", progress: Progress | None = None) -> Array:
    """Run every block that ``store`` does not hold yet; the signed p, shape studies x tests x sizes.

    ``workers`` processes of this machine, or a running Dask cluster at ``scheduler``. Each block is on the disk as soon
    as it is done.
    """
    done = _stored(job, store)
    with store.open("a", encoding="utf-8") as file:
        if not done and file.tell() == 0:
            file.write(json.dumps({"job": job.key}) + "\n")
            file.flush()
        wanted = [block for block in range(job.blocks) if block not in done]
        for block, values in _computed(job, wanted, workers, scheduler):
            done[block] = values
            file.write(json.dumps({"block": block, "p": values}) + "\n")
            file.flush()
            if progress is not None:
                progress(len(done), job.blocks)
    return np.array([study for block in range(job.blocks) for study in done[block]], dtype=float)


def _stored(job: PowerJob, store: Path) -> dict[int, Any]:
    """Return the blocks that are there; a line that was cut off is dropped from the file."""
    if not store.exists():
        return {}
    try:
        lines = store.read_text("utf-8").splitlines(keepends=True)
    except (OSError, UnicodeDecodeError) as error:
        raise UserInputError(f"{store} cannot be read: {error}") from error
    whole = [line for line in lines if line.endswith("\n")]
    try:
        told = [parse_json(line) for line in whole]
        key = told[0]["job"] if told else job.key
        blocks = {row["block"]: row["p"] for row in told[1:]}
    except (ValueError, KeyError, TypeError) as error:
        raise UserInputError(f"{store} was not written by `plan power`: name another with --store") from error
    if key != job.key:
        raise UserInputError(f"{store} belongs to another plan, population, seed or size: name another with --store")
    if len(whole) < len(lines):
        store.write_text("".join(whole), "utf-8")
    return blocks


def _computed(job: PowerJob, blocks: Sequence[int], workers: int, scheduler: str) -> Iterator[tuple[int, Any]]:
    if scheduler:
        yield from _on_cluster(job, blocks, scheduler)
    elif workers == 1:
        yield from ((block, run_block(job, block)) for block in blocks)
    else:
        with ProcessPoolExecutor(workers, mp_context=get_context("spawn")) as pool:
            futures = {pool.submit(run_block, job, block): block for block in blocks}
            yield from ((futures[future], future.result()) for future in as_completed(futures))


def _on_cluster(job: PowerJob, blocks: Sequence[int], scheduler: str) -> Iterator[tuple[int, Any]]:
    try:
        distributed = import_module("distributed")
    except ImportError as error:
        raise UserInputError('a Dask cluster needs: pip install "recollect[cluster]"') from error
    try:
        client = distributed.Client(scheduler, timeout="10s")
    except (OSError, ValueError) as error:
        raise UserInputError(f"there is no Dask scheduler at {scheduler}: {error}") from error
    with client:
        futures = {client.submit(run_block, job, block, pure=False): block for block in blocks}
        yield from ((futures[future], future.result()) for future in distributed.as_completed(futures))


# Results


@dataclass(frozen=True, slots=True)
class PowerRow:
    """How often a test rejects at one size, before and after the correction; ``se`` is of the first."""

    test: str
    n: int
    rejected: float
    corrected: float
    se: float


def summarise(job: PowerJob, signed: Array) -> list[PowerRow]:
    """Return the share of studies in which each test rejects in its direction, for each size."""
    plan = StudyPlan.model_validate_json(job.plan, strict=False)
    tests = _tests(plan)
    p = np.stack([_directed(signed[:, at], test.direction) for at, test in enumerate(tests)], axis=1)
    adjusted = _adjusted(plan, p)
    rows = []
    for at, test in enumerate(tests):
        for column, size in enumerate(job.sizes):
            share = float(np.mean(p[:, at, column] < plan.alpha))
            se = float(np.sqrt(share * (1 - share) / len(p)))
            rows.append(PowerRow(test.name, size, share, float(np.mean(adjusted[:, at, column] < plan.alpha)), se))
    return rows


def _directed(signed: Array, direction: str) -> Array:
    """Return the p of a test in its direction, from the signed two-sided p."""
    p = np.where(np.isnan(signed), 1.0, np.abs(signed))
    if direction == "two-sided":
        return p
    right = signed < 0 if direction == "less" else signed > 0
    return np.where(right, p / 2, 1 - p / 2)


def _adjusted(plan: StudyPlan, p: Array) -> Array:
    """Return the p after the correction within each family; reference effects stand alone."""
    adjusted = p.copy()
    count = len(plan.hypothesis)
    families = [each.family for each in plan.hypothesis]
    starts = {0: plan.correction} | {
        count + len(REFERENCE_EFFECTS) + at * count: row.correction for at, row in enumerate(plan.sensitivity)
    }
    for start, correction in starts.items():
        for family in set(families):
            members = [start + at for at, name in enumerate(families) if name == family]
            adjusted[:, members] = _correct(p[:, members], correction)
    return adjusted


def _correct(p: Array, correction: Correction) -> Array:
    """Adjust p over axis 1 by Holm or by Benjamini and Hochberg."""
    if correction == "none":
        return p
    adjust = holm if correction == "holm" else benjamini_hochberg
    corrected: Array = np.apply_along_axis(lambda family: np.array(adjust(family.tolist())), 1, p)
    return corrected


def smallest_n(rows: Sequence[PowerRow], test: str) -> int | None:
    """Return the smallest size at which a corrected test has a power of .8; else None."""
    return next((row.n for row in rows if row.test == test and row.corrected >= WANTED_POWER), None)


def curve(rows: Sequence[PowerRow]) -> bytes:
    """Return the corrected power of each test over the participants an arm, as an SVG."""
    # Each worker would load it, and none draws.
    import matplotlib as mpl  # noqa: PLC0415
    from matplotlib.figure import Figure  # noqa: PLC0415

    from kiosk.analysis.policy_figures import STYLE  # noqa: PLC0415

    drawn = io.BytesIO()
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(7, 4.4), layout="constrained")
        axes = figure.subplots()
        for name in dict.fromkeys(row.test for row in rows):
            own = [row for row in rows if row.test == name]
            axes.plot([row.n for row in own], [row.corrected for row in own], marker=".", label=name)
        axes.axhline(WANTED_POWER, color="#999999", linewidth=1)
        axes.set(xlabel="participants an arm", ylabel="share of studies that reject", ylim=(0, 1))
        axes.legend(frameon=False, fontsize=7)
        figure.savefig(drawn, format="svg", metadata={"Date": None})
    return drawn.getvalue()


def sequential_rejections(job: PowerJob, signed: Array) -> dict[str, tuple[float, float]]:
    """Of each hypothesis, how often some look rejects, and the mean number of participants an arm at the stop.

    The sizes of the job must be the plan's looks. Directions are not used: looks are two-sided.
    """
    plan = StudyPlan.model_validate_json(job.plan, strict=False)
    if plan.sequential is None or job.sizes != plan.sequential.looks:
        raise UserInputError("the plan declares no looks, or they are not the sizes that were simulated")
    p = np.where(np.isnan(signed), 1.0, np.abs(signed))
    if plan.sequential.spending == "bayes":
        rejects, stops = _bayes_stops(p, plan.sequential.looks, plan.sequential.bayes_bound)
    else:
        levels = np.array([level for _, level in plan.levels()])
        rejects = stops = p <= levels
    sizes = np.array(job.sizes)
    found = {}
    for at, test in enumerate(_tests(plan)[: len(plan.hypothesis) + len(REFERENCE_EFFECTS)]):
        stopped = stops[:, at].any(axis=1)
        first = np.where(stopped, stops[:, at].argmax(axis=1), len(sizes) - 1)
        rejected = rejects[np.arange(len(p)), at, first]
        found[test.name] = (float(rejected.mean()), float(sizes[first].mean()))
    return found


def _bayes_stops(p: Array, looks: Sequence[int], bound: float) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    factors = np.stack(
        [bayes_factors(stats.t.isf(p[:, :, at] / 2, 2 * n - 2), n, n) for at, n in enumerate(looks)], axis=2
    )
    return factors >= bound, (factors >= bound) | (factors <= 1 / bound)
