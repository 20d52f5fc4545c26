"""Compare two groups: tests, effect sizes with intervals, equivalence, Bayes factors and corrections.

Written here rather than taken from scipy.stats or pingouin where those ignore ties, approximate an interval or fail for
large effects. Every number is compared with R in tests/analysis. Samples are one-dimensional arrays without NaN.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
import numpy.typing as npt
from scipy import integrate, optimize, special, stats

Floats = npt.NDArray[np.float64]

LEAST = 3
"""With fewer people in a group nothing is tested."""
EXACT_PAIRS = 10_000
"""Up to this product of the group sizes the rank test is exact."""
EXACT_SPLITS = 50_000
"""Up to this number of ways to split the people the permutation test counts them all."""
DRAWS = 9_999
"""How many splits are drawn beyond that, and how many bootstrap samples."""
SEED = 20_241_101
"""Draws start from here, so that the same data give the same numbers."""


class NotEstimableError(ValueError):
    """A statistic that these data do not determine; the message is the reason, for a table's row."""


@dataclass(frozen=True)
class TestResult:
    """A test of two groups.

    ``estimate`` with its interval is what the test is about, where there is such a thing.
    """

    statistic: float
    p: float
    df: float | None = None
    estimate: float | None = None
    low: float | None = None
    high: float | None = None
    note: str = ""


@dataclass(frozen=True)
class Estimate:
    """A value with its interval."""

    value: float
    low: float
    high: float


def require_groups(*groups: Floats, least: int = LEAST) -> None:
    """Raise NotEstimableError if a group has fewer than ``least`` people."""
    if min((len(group) for group in groups), default=0) < least:
        raise NotEstimableError(f"fewer than {least} in a group ({' and '.join(str(len(group)) for group in groups)})")


def _require_spread(*groups: Floats) -> None:
    require_groups(*groups)
    if all(np.ptp(group) == 0 for group in groups):
        raise NotEstimableError("every value in each group is the same")


# Means


def welch(x: Floats, y: Floats, level: float = 0.95) -> TestResult:
    """Test the difference of two means, x less y, without assuming equal variances; two-sided."""
    _require_spread(x, y)
    return _t_test(x.mean() - y.mean(), *welch_error(x, y), level)


def student(x: Floats, y: Floats, level: float = 0.95) -> TestResult:
    """Test the difference of two means, x less y, with a pooled variance; two-sided."""
    _require_spread(x, y)
    return _t_test(x.mean() - y.mean(), *student_error(x, y), level)


def _t_test(difference: float, error: float, df: float, level: float) -> TestResult:
    t = difference / error
    margin = float(special.stdtrit(df, (1 + level) / 2)) * error
    return TestResult(t, two_sided(t, df), df, difference, difference - margin, difference + margin)


def two_sided(t: float, df: float) -> float:
    """Return the two-sided p of a t."""
    return float(2 * special.stdtr(df, -abs(t)))


def pooled_sd(x: Floats, y: Floats) -> float:
    """Return the standard deviation within groups."""
    squares = (len(x) - 1) * x.var(ddof=1) + (len(y) - 1) * y.var(ddof=1)
    return math.sqrt(squares / (len(x) + len(y) - 2))


def equivalence(x: Floats, y: Floats, bound: float, alpha: float = 0.05) -> TestResult:
    """Test by two one-sided Welch tests whether the means differ by less than ``bound``, in the measure's own unit.

    The p is the larger of the two; the interval is the one of level 1 - 2 alpha that belongs to it.
    """
    test = welch(x, y, 1 - 2 * alpha)
    df, difference = test.df or 0.0, test.estimate or 0.0
    error, _ = welch_error(x, y)
    sides = [(difference + bound) / error, (bound - difference) / error]
    statistic = min(sides)
    return TestResult(statistic, float(special.stdtr(df, -statistic)), df, difference, test.low, test.high)


def welch_error(x: Floats, y: Floats) -> tuple[float, float]:
    """Return the standard error of a difference of two means and its degrees of freedom (Welch)."""
    a, b = x.var(ddof=1) / len(x), y.var(ddof=1) / len(y)
    return math.sqrt(a + b), float((a + b) ** 2 / (a**2 / (len(x) - 1) + b**2 / (len(y) - 1)))


def student_error(x: Floats, y: Floats) -> tuple[float, float]:
    """Return the same with a variance that both groups share (Student)."""
    return pooled_sd(x, y) * math.sqrt(1 / len(x) + 1 / len(y)), len(x) + len(y) - 2


# Ranks and permutations


def mann_whitney(x: Floats, y: Floats) -> TestResult:
    """Test by ranks whether x tends to be larger than y; exact also with ties, normal for large groups; two-sided.

    The statistic is U: how many pairs x wins, ties counted half. The estimate is the rank-biserial correlation,
    2 U / (n1 n2) - 1, with the interval by Fisher's z.
    """
    require_groups(x, y)
    ranks = stats.rankdata(np.concatenate([x, y]))
    if np.ptp(ranks) == 0:
        raise NotEstimableError("every value in each group is the same")
    n, m = len(x), len(y)
    u = float(ranks[:n].sum() - n * (n + 1) / 2)
    exact = n * m <= EXACT_PAIRS
    p = _exact_rank_p(ranks, n) if exact else _normal_rank_p(ranks, n, u)
    r = rank_biserial(u, n, m)
    return TestResult(u, p, None, r.value, r.low, r.high, "exact" if exact else "normal, corrected for ties")


def _exact_rank_p(ranks: Floats, n: int) -> float:
    """Return the chance of a rank sum at least as far from its mean.

    It is over all ways to choose the first group.

    Counts sums by dynamic programming over people; doubled ranks are whole numbers also with ties.
    """
    doubled = np.rint(2 * ranks).astype(np.int64)
    observed = int(doubled[:n].sum())
    least = int(doubled.min())
    shifted = doubled - least
    step = int(np.gcd.reduce(shifted)) or 1
    shifted //= step
    # Groups of up to n, sums of up to those of the n largest; scaled on the way, as whole counts overflow.
    size = int(np.sort(shifted)[-n:].sum()) + 1
    ways = np.zeros((n + 1, size))
    ways[0, 0] = 1.0
    for done, value in enumerate(shifted.tolist()):
        top = min(done + 1, n)
        ways[1 : top + 1, value:] += ways[:top, : size - value].copy()
        if done % 64 == 63:  # noqa: PLR2004 - often enough to stay far below the largest float
            ways /= ways.max()
    chances = ways[n] / ways[n].sum()
    sums = step * np.arange(size) + n * least
    centre = doubled.mean() * n
    return float(min(1.0, chances[np.abs(sums - centre) >= abs(observed - centre) - 1e-9].sum()))


def _normal_rank_p(ranks: Floats, n: int, u: float) -> float:
    m = len(ranks) - n
    _, ties = np.unique(ranks, return_counts=True)
    total = n + m
    variance = n * m / 12 * (total + 1 - float((ties**3 - ties).sum()) / (total * (total - 1)))
    z = max(abs(u - n * m / 2) - 0.5, 0.0) / math.sqrt(variance)
    return float(2 * special.ndtr(-z))


def rank_biserial(u: float, n: int, m: int, level: float = 0.95) -> Estimate:
    """Return the rank-biserial correlation of a U, with its interval by Fisher's z."""
    r = 2 * u / (n * m) - 1
    if abs(r) == 1:
        return Estimate(r, r, r)
    error = math.sqrt((n + m + 1) / (3 * n * m)) * float(special.ndtri((1 + level) / 2))
    return Estimate(r, math.tanh(math.atanh(r) - error), math.tanh(math.atanh(r) + error))


def permutation(x: Floats, y: Floats, draws: int = DRAWS, seed: int = SEED) -> TestResult:
    """Test the difference of means over the ways to split the people.

    It takes all of them if they are few, else drawn ones.

    The p is the share of splits whose absolute difference is at least the observed one; a drawn one counts the
    observed split as well.
    """
    _require_spread(x, y)
    both = np.concatenate([x, y])
    n, total = len(x), float(both.sum())
    observed = float(x.mean() - y.mean())
    splits = math.comb(len(both), n)
    exact = splits <= EXACT_SPLITS
    if exact:
        chosen = np.array(list(combinations(range(len(both)), n)))
        sums = both[chosen].sum(axis=1)
    else:
        rng = np.random.default_rng(seed)
        block = max(1, 4_000_000 // len(both))
        sums = np.concatenate([_drawn_sums(both, n, min(block, draws - done), rng) for done in range(0, draws, block)])
    differences = sums / n - (total - sums) / (len(both) - n)
    reached = int((np.abs(differences) >= abs(observed) - 1e-9 * max(1.0, abs(observed))).sum())
    p = reached / splits if exact else (reached + 1) / (draws + 1)
    return TestResult(observed, p, note="all splits" if exact else f"{draws} drawn splits")


def _drawn_sums(both: Floats, n: int, draws: int, rng: np.random.Generator) -> Floats:
    """Return the sums of the first group in random splits."""
    keys = rng.random((draws, len(both)), dtype=np.float32)
    chosen = np.argpartition(keys, n - 1, axis=1)[:, :n]
    sums: Floats = both[chosen].sum(axis=1)
    return sums


# Assumptions


def shapiro(x: Floats) -> TestResult:
    """Test whether a sample is normal (Shapiro and Wilk, Royston's approximation, as in R)."""
    require_groups(x)
    if np.ptp(x) == 0:
        raise NotEstimableError("every value is the same")
    if len(x) > 5000:  # noqa: PLR2004 - the approximation's own limit, as in R
        raise NotEstimableError("more than 5000 values")
    found = stats.shapiro(x)
    return TestResult(float(found.statistic), float(found.pvalue))


def brown_forsythe(*groups: Floats) -> TestResult:
    """Test whether groups vary equally: Levene's test on distances from the median."""
    _require_spread(*groups)
    distances = [np.abs(group - np.median(group)) for group in groups]
    grand = np.concatenate(distances)
    within = sum(float(((d - d.mean()) ** 2).sum()) for d in distances)
    if within == 0:
        raise NotEstimableError("every value is equally far from its median")
    between = sum(len(d) * float((d.mean() - grand.mean()) ** 2) for d in distances)
    df1, df2 = len(groups) - 1, len(grand) - len(groups)
    f = (between / df1) / (within / df2)
    return TestResult(f, float(special.fdtrc(df1, df2, f)), df2)


# Effect sizes


def cohen_d(x: Floats, y: Floats, level: float = 0.95) -> Estimate:
    """Return the difference of means in pooled standard deviations, with the interval by the noncentral t."""
    _require_spread(x, y)
    d = float(x.mean() - y.mean()) / pooled_sd(x, y)
    return standardised(d, len(x), len(y), level)


def hedges_g(x: Floats, y: Floats, level: float = 0.95) -> Estimate:
    """Cohen's d without its bias for small groups (exact correction); its interval is scaled alike."""
    d = cohen_d(x, y, level)
    j = hedges_correction(len(x) + len(y) - 2)
    return Estimate(j * d.value, j * d.low, j * d.high)


def hedges_correction(df: float) -> float:
    """Return the factor that makes d unbiased: Gamma(df/2) / (sqrt(df/2) Gamma((df-1)/2))."""
    return math.exp(math.lgamma(df / 2) - math.lgamma((df - 1) / 2)) / math.sqrt(df / 2)


def standardised(d: float, n: int, m: int, level: float = 0.95) -> Estimate:
    """Return a Cohen's d of two groups of n and m with its interval by the noncentral t."""
    scale = math.sqrt(1 / n + 1 / m)
    low, high = noncentrality_interval(d / scale, n + m - 2, level)
    return Estimate(d, low * scale, high * scale)


def noncentrality_interval(t: float, df: float, level: float = 0.95) -> tuple[float, float]:
    """Return the noncentralities between which a t with df degrees of freedom is not surprising at this level."""
    tail = (1 - level) / 2
    width = 10 * math.sqrt(1 + t * t / (2 * df))

    def limit(chance: float) -> float:
        return float(optimize.brentq(lambda ncp: noncentral_t(t, df, ncp) - chance, t - width, t + width, xtol=1e-12))

    return limit(1 - tail), limit(tail)


_NODES, _WEIGHTS = special.roots_legendre(400)


def noncentral_t(t: float, df: float, ncp: float) -> float:
    """Return the chance that a noncentral t is at most t, integrated over the chi distribution.

    scipy's own is NaN where t and the noncentrality are far apart.
    """
    low, high = np.sqrt(special.chdtri(df, np.array([1 - 1e-15, 1e-18])) / df)
    s = low + (high - low) * (_NODES + 1) / 2
    log_density = math.log(2) + df / 2 * math.log(df / 2) - math.lgamma(df / 2) + (df - 1) * np.log(s) - df * s * s / 2
    return float((high - low) / 2 * (_WEIGHTS * np.exp(log_density) * special.ndtr(t * s - ncp)).sum())


def bootstrap_difference(x: Floats, y: Floats, draws: int = DRAWS, seed: int = SEED, level: float = 0.95) -> Estimate:
    """Return the difference of means, x less y, with a bias-corrected and accelerated bootstrap interval."""
    _require_spread(x, y)
    rng = np.random.default_rng(seed)
    drawn = _drawn_means(x, draws, rng) - _drawn_means(y, draws, rng)
    # What each person moves the difference by if left out, in the scale of the empirical influence.
    influence = np.concatenate([(x - x.mean()) / len(x), -(y - y.mean()) / len(y)])
    value = float(x.mean() - y.mean())
    low, high = bca(drawn, value, influence, level)
    return Estimate(value, low, high)


def _drawn_means(x: Floats, draws: int, rng: np.random.Generator) -> Floats:
    block = max(1, 4_000_000 // len(x))
    means = [
        x[rng.integers(0, len(x), (min(block, draws - done), len(x)))].mean(axis=1) for done in range(0, draws, block)
    ]
    return np.concatenate(means)


def bca(drawn: Floats, value: float, influence: Floats, level: float = 0.95) -> tuple[float, float]:
    """Return the limits of a bias-corrected and accelerated interval from bootstrap values.

    After Efron (1987); as R's boot.ci.

    ``influence`` is the empirical influence of every observation, up to a factor.
    """
    below = float((drawn < value).mean())
    if not 0 < below < 1:
        raise NotEstimableError("the bootstrap values are all on one side of the estimate")
    bias = float(special.ndtri(below))
    acceleration = float((influence**3).sum() / (6 * (influence**2).sum() ** 1.5))
    ordered = np.sort(drawn)
    limits = []
    for chance in ((1 - level) / 2, (1 + level) / 2):
        z = bias + float(special.ndtri(chance))
        limits.append(_quantile(ordered, float(special.ndtr(bias + z / (1 - acceleration * z)))))
    return limits[0], limits[1]


def _quantile(ordered: Floats, share: float) -> float:
    """Return the quantile at ``share`` (n + 1), interpolated on the normal scale, as R's boot does."""
    n = len(ordered)
    place = (n + 1) * share
    k = math.floor(place)
    if k < 1 or k >= n:
        return float(ordered[0 if k < 1 else n - 1])
    if place == k:
        return float(ordered[k - 1])
    at, before, after = (float(special.ndtri(q)) for q in (share, k / (n + 1), (k + 1) / (n + 1)))
    return float(ordered[k - 1] + (at - before) / (after - before) * (ordered[k] - ordered[k - 1]))


# Bayes factors


def bayes_factor(t: float, n: int, m: int, scale: float = math.sqrt(0.5)) -> float:
    """Return the JZS Bayes factor for a difference of two means over none.

    After Rouder and others (2009), default r = .707.
    """
    df, size = n + m - 2, n * m / (n + m)

    def log_weight(g: float) -> float:
        spread = 1 + size * g * scale**2
        likelihood = -0.5 * math.log(spread) - (df + 1) / 2 * math.log1p(t * t / (spread * df))
        return likelihood - 0.5 * math.log(2 * math.pi) - 1.5 * math.log(g) - 1 / (2 * g)

    null = -(df + 1) / 2 * math.log1p(t * t / df)
    # On the scale of log g the integrand is one smooth hump.
    grid = np.linspace(-12, 60, 721)
    heights = np.array([log_weight(math.exp(z)) + z for z in grid])
    top, peak = float(heights.max()), float(grid[heights.argmax()])
    area = sum(
        integrate.quad(lambda z: math.exp(log_weight(math.exp(z)) + z - top), *ends, epsabs=0, epsrel=1e-11, limit=200)[
            0
        ]
        for ends in ((peak - 20, peak), (peak, peak + 20), (peak + 20, peak + 90))
    )
    return math.exp(min(math.log(area) + top - null, 700.0))


ROBUSTNESS = (0.5, math.sqrt(0.5), 1.0, 1.4)
"""The prior scales for which a Bayes factor is reported."""


# Corrections


def holm(ps: Sequence[float]) -> list[float]:
    """Adjust p values for a family of tests (Holm); NaN stays NaN and does not count."""
    return _adjusted(ps, lambda rank, number: number - rank, steps_down=True)


def benjamini_hochberg(ps: Sequence[float]) -> list[float]:
    """Adjust p values for the false discovery rate (Benjamini and Hochberg); NaN stays NaN and does not count."""
    return _adjusted(ps, lambda rank, number: number / (rank + 1), steps_down=False)


def _adjusted(ps: Sequence[float], factor: Callable[[int, int], float], *, steps_down: bool) -> list[float]:
    order = sorted((index for index, p in enumerate(ps) if not math.isnan(p)), key=lambda index: ps[index])
    adjusted = list(ps)
    scaled = [ps[index] * factor(rank, len(order)) for rank, index in enumerate(order)]
    falls = np.minimum.accumulate(np.array(scaled[::-1]))[::-1]
    running = np.maximum.accumulate(np.array(scaled)) if steps_down else falls
    for index, p in zip(order, running, strict=True):
        adjusted[index] = min(1.0, float(p))
    return adjusted


# Counts


def fisher(table: Sequence[Sequence[int]]) -> float:
    """Return the two-sided p of Fisher's exact test for two groups and two outcomes."""
    if min(map(sum, table)) == 0 or min(map(sum, zip(*table, strict=True))) == 0:
        raise NotEstimableError("a row or a column of the table is empty")
    return float(stats.fisher_exact(table).pvalue)


def wilson(hits: int, n: int, level: float = 0.95) -> Estimate:
    """Return a share with Wilson's interval."""
    if n == 0:
        raise NotEstimableError("there is nothing to count")
    z = float(special.ndtri((1 + level) / 2))
    share = hits / n
    centre = (share + z * z / (2 * n)) / (1 + z * z / n)
    margin = z / (1 + z * z / n) * math.sqrt(share * (1 - share) / n + z * z / (4 * n * n))
    return Estimate(share, max(0.0, centre - margin), min(1.0, centre + margin))


def jackknife_margin(left_out: Floats, level: float = 0.95) -> float:
    """Return half the width of an estimate's t interval, from its values with one person left out at a time."""
    n = len(left_out)
    error = math.sqrt((n - 1) / n * float(((left_out - left_out.mean()) ** 2).sum()))
    return float(special.stdtrit(n - 1, (1 + level) / 2)) * error


# Power


def t_power(d: float, n: int, m: int, alpha: float = 0.05) -> float:
    """Return the power of a two-sided t test of two groups.

    It counts both tails, which R leaves out unless it is strict.
    """
    df = n + m - 2
    critical = float(special.stdtrit(df, 1 - alpha / 2))
    ncp = d * math.sqrt(n * m / (n + m))
    return 1 - noncentral_t(critical, df, ncp) + noncentral_t(-critical, df, ncp)


def sensitivity(n: int, m: int, power: float = 0.8, alpha: float = 0.05) -> float:
    """Return the smallest d that a two-sided t test of groups of n and m finds with this power."""
    return float(optimize.brentq(lambda d: t_power(d, n, m, alpha) - power, 0, 20, xtol=1e-12))
