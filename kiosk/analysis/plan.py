"""The plan of a study, declared before the first participant, and the boundaries for looks before the end."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import ClassVar, Literal, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator
from scipy.optimize import brentq
from scipy.special import ndtr, ndtri

from kiosk import UserInputError
from kiosk.config import ConfigModel
from kiosk.experiment.condition import Condition

SCALES = {
    "SOC": "socially competent",
    "AC": "adapts to human cognitions",
    "PC": "predicts human cognitions",
    "RC": "recognizes human cognitions",
}
"""The scales of the questionnaire social-intelligence, by the names that it gives them."""

MEASURES = {
    "flips": "flips until the last pair is found",
    "completion_ms": "completion time without speech",
    "assistance_per_flip": "assistance per flip",
    "followed_rate": "share of hints that were followed",
    "first_led_to_match_rate": "share of first-card hints that led to a match",
    **{f"{scale}_sum": f"sum of {scale} ({name})" for scale, name in SCALES.items()},
}
"""What a hypothesis can be about: columns of the exported participants, and what they are called."""

Direction = Literal["less", "greater", "two-sided"]
TestName = Literal["welch", "student", "mann-whitney"]
Exclusion = Literal["technical", "2sd-pooled", "2sd-within"]
Correction = Literal["holm", "bh", "none"]


class Hypothesis(ConfigModel):
    """One hypothesis: the first condition against the second."""

    id: str = Field(min_length=1)
    measure: str
    direction: Direction = "two-sided"
    test: TestName = "welch"
    family: str = "main"

    @model_validator(mode="after")
    def _known(self) -> Self:
        if self.measure not in MEASURES:
            raise ValueError(f"there is no measure {self.measure!r}; there are {', '.join(MEASURES)}")
        return self


class SensitivityRow(ConfigModel):
    """Another way to analyse the same data, reported beside the main one under its name."""

    name: str = Field(min_length=1)
    test: TestName = "welch"
    one_sided: bool = False
    exclusions: Exclusion = "technical"
    correction: Correction = "none"


class Sequential(ConfigModel):
    """When the data are looked at, in participants an arm; the last look is the end."""

    looks: tuple[int, ...] = Field(strict=False)
    spending: Literal["obrien-fleming", "pocock", "bayes"] = "obrien-fleming"
    bayes_bound: float = Field(default=10.0, gt=1)

    @model_validator(mode="after")
    def _rising(self) -> Self:
        if not self.looks or self.looks[0] < 3 or any(a >= b for a, b in zip(self.looks, self.looks[1:], strict=False)):  # noqa: PLR2004
            raise ValueError("looks must be rising numbers of participants an arm, from 3")
        return self


class StudyPlan(ConfigModel):
    """A plan file."""

    file_kind: ClassVar[str] = "plan"

    title: str = Field(min_length=1)
    question: str = ""
    conditions: tuple[str, str] = Field(default=("tom", "notom"), strict=False)
    n_per_arm: int = Field(default=56, ge=3, le=100_000)
    alpha: float = Field(default=0.05, gt=0, lt=0.5)
    correction: Correction = "holm"
    population: Literal["game-completed", "allocated"] = "game-completed"
    exclusions: Exclusion = "technical"
    expected_exclusions: float = Field(default=0.05, ge=0, lt=0.9)
    smallest_effect: float = Field(default=0.5, gt=0)
    hypothesis: tuple[Hypothesis, ...] = Field(min_length=1, strict=False)
    sensitivity: tuple[SensitivityRow, ...] = Field(default=(), strict=False)
    sequential: Sequential | None = None

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        for name in self.conditions:
            try:
                Condition.from_name(name)
            except UserInputError as error:
                raise ValueError(str(error)) from error
        if self.conditions[0] == self.conditions[1]:
            raise ValueError("the two conditions must differ")
        names = [hypothesis.id for hypothesis in self.hypothesis]
        if len(set(names)) < len(names):
            raise ValueError("two hypotheses have the same id")
        if self.sequential is not None and self.sequential.looks[-1] != self.n_per_arm:
            raise ValueError(f"the last look must be n_per_arm ({self.n_per_arm}), not {self.sequential.looks[-1]}")
        return self

    def levels(self) -> tuple[tuple[int, float], ...]:
        """Participants an arm at each look, and the two-sided level of each test there; only the end without looks."""
        if self.sequential is None or self.sequential.spending == "bayes":
            return ((self.n_per_arm, self.alpha),)
        looks = self.sequential.looks
        return tuple(zip(looks, nominal_levels(looks, self.alpha, self.sequential.spending), strict=True))

    def refuse_before_look(self, per_arm: int) -> None:
        """Raise UserInputError unless a declared look has been reached with ``per_arm`` participants in each arm."""
        first = self.sequential.looks[0] if self.sequential is not None else self.n_per_arm
        if per_arm < first:
            raise UserInputError(
                f"the plan declares its first look at {first} participants an arm, and there are {per_arm}: results by "
                "condition are not shown before"
            )


def plan_sha256(path: Path) -> str:
    """Return the hash of a plan file, byte by byte."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


TEMPLATE = """\
# The plan of a study. Change it, then: recollect plan check, plan power, plan freeze.
title = "Does an assistant with a Theory of Mind help people to remember?"
question = "Do people need fewer flips when hints follow what they have seen, and a reason is given?"
conditions = ["tom", "notom"]        # hypotheses compare the first with the second
n_per_arm = 56                       # the paper analysed 28 + 28
alpha = 0.05
correction = "holm"                  # within each family; also "bh", "none"
population = "game-completed"        # or "allocated"
exclusions = "technical"             # declared faults only; also "2sd-pooled", "2sd-within"
expected_exclusions = 0.05           # share of participants lost to them
smallest_effect = 0.5                # Cohen's d, the smallest effect of interest

[[hypothesis]]
id = "H1-flips"
measure = "flips"
direction = "less"
family = "performance"

[[hypothesis]]
id = "H1-time"
measure = "completion_ms"
direction = "less"
family = "performance"

[[hypothesis]]
id = "H2-assistance"
measure = "assistance_per_flip"
direction = "less"
family = "assistance"

[[hypothesis]]
id = "H3-social"
measure = "SOC_sum"
direction = "greater"
family = "perception"

[[hypothesis]]
id = "H3-competence"
measure = "AC_sum"
direction = "greater"
family = "perception"

# What the paper did, beside the main analysis.
[[sensitivity]]
name = "as the paper"
test = "student"
one_sided = true
exclusions = "2sd-pooled"
correction = "none"

# Looks before the end; without this section there are none.
# [sequential]
# looks = [14, 28, 42, 56]
# spending = "obrien-fleming"        # or "pocock", or "bayes" with bayes_bound = 10
"""


def preregistration(plan: StudyPlan, sha256: str) -> str:
    """Return the text of a preregistration in Markdown, with the fields that OSF and AsPredicted ask for."""
    first, second = plan.conditions
    lines = [
        f"# {plan.title}",
        "",
        f"Plan SHA-256: `{sha256}`",
        "",
        "## Have any data been collected?",
        "",
        "No. The plan is frozen in the kiosk's database before the first consent; the report checks it.",
        "",
        "## Research question and hypotheses",
        "",
        plan.question or "See the hypotheses.",
        "",
        *(f"- **{each.id}** ({each.family}): {_sentence(each, first, second)}" for each in plan.hypothesis),
        "",
        "## Dependent variables",
        "",
        *(f"- `{name}`: {MEASURES[name]}" for name in dict.fromkeys(each.measure for each in plan.hypothesis)),
        "",
        "## Conditions and design",
        "",
        f"Two independent groups, `{first}` and `{second}`, allocated at random in permuted blocks by the kiosk.",
        "Participants do not know their condition; the screen of the experimenter does not show it during a session.",
        "",
        "## Sampling plan and sample size",
        "",
        f"{plan.n_per_arm} participants an arm. The smallest effect of interest is d = {plan.smallest_effect:g}.",
        *_looks(plan),
        "",
        "## Analyses",
        "",
        *(f"- {each.id}: {each.test}, {each.direction}" for each in plan.hypothesis),
        "",
        f"Alpha is {plan.alpha:g}; p values are corrected within each family ({plan.correction}).",
        "",
        "## Outliers and exclusions",
        "",
        f"Population: {plan.population}. Exclusions: {_EXCLUDES[plan.exclusions]}. "
        f"Expected: {plan.expected_exclusions:.0%}.",
        "",
        "## Sensitivity analyses",
        "",
        *(_row(row) for row in plan.sensitivity),
        *([] if plan.sensitivity else ["None."]),
        "",
        "## Exploratory analyses",
        "",
        "Everything else that a report shows is exploratory and named so.",
        "",
    ]
    return "\n".join(lines)


_EXCLUDES = {
    "technical": "sessions with a technical fault declared by the experimenter, before results are seen",
    "2sd-pooled": "values beyond 2 SD of the mean of all participants",
    "2sd-within": "values beyond 2 SD of the mean of their own group",
}


def _sentence(each: Hypothesis, first: str, second: str) -> str:
    than = {"less": "is lower than", "greater": "is higher than", "two-sided": "differs from"}[each.direction]
    return f"`{first}` {than} `{second}` in {MEASURES[each.measure]}"


def _row(row: SensitivityRow) -> str:
    side = "one-sided" if row.one_sided else "two-sided"
    return f"- {row.name}: {row.test}, {side}, exclusions {row.exclusions}, correction {row.correction}"


def _looks(plan: StudyPlan) -> list[str]:
    if plan.sequential is None:
        return ["The data are not analysed before the end."]
    looks = ", ".join(str(look) for look in plan.sequential.looks)
    if plan.sequential.spending == "bayes":
        bound = plan.sequential.bayes_bound
        return [f"Looks at {looks} an arm; sampling stops at a Bayes factor above {bound:g} or below 1/{bound:g}."]
    levels = "; ".join(f"{look} an arm: p < {level:.5f}" for look, level in plan.levels())
    return [f"Looks by the spending function {plan.sequential.spending}: {levels} (two-sided)."]


Array = NDArray[np.float64]

POINTS = 1201
"""Points of the grid on which the density of a statistic that has not crossed a boundary is kept."""
LARGEST_Z = 8.0
PRIOR_SCALE = math.sqrt(0.5)


def obrien_fleming(alpha: float, share: float) -> float:
    """Return two-sided alpha spent at an information share t of 0..1.

    After O'Brien and Fleming: 4 - 4 Phi(z / sqrt t).
    """
    return float(4 - 4 * ndtr(ndtri(1 - alpha / 4) / math.sqrt(share)))


def pocock(alpha: float, share: float) -> float:
    """Return two-sided alpha spent at an information share of 0..1, after Pocock: alpha log(1 + (e - 1) t)."""
    return alpha * math.log(1 + (math.e - 1) * share)


SPENDING: dict[str, Callable[[float, float], float]] = {"obrien-fleming": obrien_fleming, "pocock": pocock}


def boundaries(looks: Sequence[int], alpha: float, spending: str) -> list[float]:
    """Return the bound of |z| at each look, so that all looks together spend ``alpha`` two-sided.

    ``looks`` are participants an arm, rising. The density of the statistic within the earlier bounds is carried from
    look to look by numerical integration (Armitage, McPherson and Rowe 1969).
    """
    spent_by = SPENDING[spending]
    shares = [look / looks[-1] for look in looks]
    spent = [spent_by(alpha, share) for share in shares]
    bounds = [float(ndtri(1 - spent[0] / 2))]
    # The score S = Z sqrt(t) has independent increments.
    grid, density = _start(bounds[0], shares[0])
    for before, share, more in zip(shares, shares[1:], np.diff(spent), strict=False):
        step = math.sqrt(share - before)

        bound = float(brentq(_excess, 0.5, LARGEST_Z, args=(grid, density, (share, step), more)))
        bounds.append(bound)
        edge = bound * math.sqrt(share)
        wider = np.linspace(-edge, edge, POINTS)
        moved: Array = np.exp(-(((wider[:, None] - grid[None, :]) / step) ** 2) / 2) / (step * math.sqrt(2 * math.pi))
        density = np.asarray(np.trapezoid(moved * density, grid, axis=1))
        grid = wider
    return bounds


def _excess(bound: float, grid: Array, density: Array, times: tuple[float, float], wanted: float) -> float:
    """Return the chance to cross a bound at the next look, less the wanted one."""
    share, step = times
    edge = bound * math.sqrt(share)
    out = ndtr((-edge - grid) / step) + ndtr((grid - edge) / step)
    return float(np.trapezoid(density * out, grid)) - wanted


def _start(bound: float, share: float) -> tuple[Array, Array]:
    edge = min(bound, LARGEST_Z) * math.sqrt(share)
    grid = np.linspace(-edge, edge, POINTS)
    return grid, np.exp(-(grid**2) / (2 * share)) / math.sqrt(2 * math.pi * share)


def nominal_levels(looks: Sequence[int], alpha: float, spending: str) -> list[float]:
    """Return the two-sided p below which a test is significant at each look."""
    return [float(2 * ndtr(-bound)) for bound in boundaries(looks, alpha, spending)]


_LOG_G = np.linspace(-12.0, 30.0, 600)


def bayes_factors(t: Array, n: int, m: int) -> Array:
    """JZS Bayes factors (scale .707) for many t of two groups, by one quadrature for all; alternative over null."""
    df, size = n + m - 2, n * m / (n + m)
    g = np.exp(_LOG_G)
    spread = 1 + size * g * PRIOR_SCALE**2
    weight = np.exp(-0.5 * np.log(2 * np.pi) - 0.5 * _LOG_G - 1 / (2 * g)) / np.sqrt(spread)
    squares = np.asarray(t, dtype=float)[..., None] ** 2
    ratio = np.exp(-(df + 1) / 2 * (np.log1p(squares / (spread * df)) - np.log1p(squares / df)))
    factors: Array = np.trapezoid(ratio * weight, _LOG_G, axis=-1)
    return factors
