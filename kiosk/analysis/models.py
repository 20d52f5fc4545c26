"""Reliability of scales, the 2 x 2 analysis of variance, and logistic models with a random intercept per person.

Where libraries differ from R by default (sums of squares, contrasts, variational mixed models), this follows R.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy import optimize, special

from kiosk.analysis.statistics import LEAST, Estimate, Floats, NotEstimableError

Integers = npt.NDArray[np.int64]

# Reliability


@dataclass(frozen=True)
class Reliability:
    """How well the items of a scale go together.

    ``omega`` is NaN with its reason where one factor does not fit.
    """

    n: int
    alpha: Estimate
    omega: float
    omega_note: str
    item_rest: tuple[float, ...]


def reliability(items: Floats) -> Reliability:
    """Alpha with Feldt's interval, omega, and item-rest correlations of a matrix of people by items.

    People with a missing item are left out. Raises NotEstimableError for fewer than two items or three people.
    """
    complete = items[~np.isnan(items).any(axis=1)]
    if items.shape[1] < 2:  # noqa: PLR2004 - one item has nothing to go with
        raise NotEstimableError("a scale of one item")
    if len(complete) < LEAST:
        raise NotEstimableError(f"fewer than {LEAST} people answered all items")
    if (np.ptp(complete, axis=0) == 0).all():
        raise NotEstimableError("everybody answered the same")
    rest = complete.sum(axis=1, keepdims=True) - complete
    correlations = tuple(_correlation(complete[:, k], rest[:, k]) for k in range(items.shape[1]))
    try:
        w, note = omega(complete), ""
    except NotEstimableError as reason:
        w, note = math.nan, str(reason)
    return Reliability(len(complete), alpha(complete), w, note, correlations)


def alpha(complete: Floats, level: float = 0.95) -> Estimate:
    """Cronbach's alpha of complete answers, with the interval of Feldt (1965)."""
    n, k = complete.shape
    total = float(complete.sum(axis=1).var(ddof=1))
    if total == 0:
        raise NotEstimableError("everybody has the same sum")
    value = k / (k - 1) * (1 - float(complete.var(axis=0, ddof=1).sum()) / total)
    df1, df2 = n - 1, (n - 1) * (k - 1)
    high_f, low_f = (float(special.fdtri(df1, df2, q)) for q in ((1 + level) / 2, (1 - level) / 2))
    return Estimate(value, 1 - (1 - value) * high_f, 1 - (1 - value) * low_f)


def _correlation(x: Floats, y: Floats) -> float:
    if np.ptp(x) == 0 or np.ptp(y) == 0:
        return math.nan
    return float(np.corrcoef(x, y)[0, 1])


_LEAST_UNIQUENESS = 0.005
"""As in R's factanal: an item has at least this share of its variance to itself."""


def omega(complete: Floats) -> float:
    """McDonald's omega of a sum of items, from one factor fitted by maximum likelihood (as R's factanal).

    Raises NotEstimableError for fewer than three items, a constant one, or items that determine each other.
    """
    n, k = complete.shape
    if k < 3:  # noqa: PLR2004 - one factor of two items is not determined
        raise NotEstimableError("one factor needs three items")
    if n <= k:
        raise NotEstimableError("more people than items are needed")
    if (np.ptp(complete, axis=0) == 0).any():
        raise NotEstimableError("an item was answered the same by everybody")
    r: Floats = np.asarray(np.corrcoef(complete, rowvar=False))
    if np.linalg.matrix_rank(r, tol=1e-8) < k:
        raise NotEstimableError("an item follows from the others")
    unique = _uniquenesses(r)
    if (unique <= _LEAST_UNIQUENESS * 1.0001).any():
        raise NotEstimableError("one factor fits only with an item that has no error (a Heywood case)")
    values, vectors = np.linalg.eigh(r / np.sqrt(np.outer(unique, unique)))
    loadings = np.sqrt(unique) * vectors[:, -1] * math.sqrt(max(values[-1] - 1, 0.0))
    spread = complete.std(axis=0, ddof=1)
    common = float((loadings * spread).sum()) ** 2
    return common / (common + float((unique * spread**2).sum()))


def _uniquenesses(r: Floats) -> Floats:
    """Return the share of variance that each item has to itself, where the likelihood of one factor is largest."""

    def loss(unique: Floats) -> tuple[float, Floats]:
        scale = 1 / np.sqrt(unique)
        values, vectors = np.linalg.eigh(r * np.outer(scale, scale))
        # The likelihood leaves out the factor's own eigenvalue.
        rest = values[:-1]
        loadings = np.sqrt(unique) * vectors[:, -1] * math.sqrt(max(values[-1] - 1, 0.0))
        gradient = (loadings**2 + unique - 1) / unique**2
        return float((rest - np.log(rest)).sum() - len(rest)), gradient

    start = (1 - 0.5 / len(r)) / np.diag(np.linalg.inv(r))
    bounds = [(_LEAST_UNIQUENESS, 1.0)] * len(r)
    options = {"ftol": 1e-15, "gtol": 1e-11, "maxiter": 1000}
    found = optimize.minimize(loss, start, jac=True, method="L-BFGS-B", bounds=bounds, options=options)
    unique: Floats = found.x
    return unique


# The 2 x 2 design


@dataclass(frozen=True)
class Effect:
    """One effect of the 2 x 2 design, with one degree of freedom; ``size`` is partial eta squared."""

    name: str
    f: float
    df: int
    p: float
    size: float


def two_by_two(values: Floats, first: Integers, second: Integers, names: tuple[str, str]) -> tuple[Effect, ...]:
    """Both main effects and the interaction, with sums of squares of type III (each adjusted for all others).

    ``first`` and ``second`` are 0 or 1 for every person. Raises NotEstimableError for a cell of fewer than three.
    """
    cells = [values[(first == a) & (second == b)] for a in (0, 1) for b in (0, 1)]
    if min(len(cell) for cell in cells) < LEAST:
        raise NotEstimableError(f"a cell of the design has fewer than {LEAST} people")
    within = sum(float(((cell - cell.mean()) ** 2).sum()) for cell in cells)
    df = len(values) - 4
    if within == 0:
        raise NotEstimableError("every value in each cell is the same")
    effects = []
    # With sum contrasts a type III sum of squares is that of a contrast of the four cell means.
    contrasts = {names[0]: (-1, -1, 1, 1), names[1]: (-1, 1, -1, 1), " x ".join(names): (1, -1, -1, 1)}
    for name, contrast in contrasts.items():
        difference = sum(c * float(cell.mean()) for c, cell in zip(contrast, cells, strict=True))
        squares = difference**2 / sum(1 / len(cell) for cell in cells)
        f = squares / (within / df)
        effects.append(Effect(name, f, df, float(special.fdtrc(1, df, f)), squares / (squares + within)))
    return tuple(effects)


# Logistic models with a random intercept per person

NODES = 25


@dataclass(frozen=True)
class Coefficient:
    """A log odds with its standard error, Wald interval, and the p of its likelihood-ratio test."""

    name: str
    value: float
    error: float
    low: float
    high: float
    chi_squared: float
    p: float


@dataclass(frozen=True)
class MixedModel:
    """A fitted model; ``sd`` is that of the random intercepts, 0 where the model was refitted without them."""

    coefficients: tuple[Coefficient, ...]
    sd: float
    log_likelihood: float
    people: int
    trials: int
    note: str


@dataclass(frozen=True)
class BinomialData:
    """Hits of trials for each row.

    A row has its person and its covariates, of which the first is the constant.
    """

    hits: Floats
    trials: Floats
    design: Floats
    person: Integers

    def without(self, column: int) -> BinomialData:
        """Return the same without one covariate."""
        return BinomialData(self.hits, self.trials, np.delete(self.design, column, axis=1), self.person)


def collapse(hit: Floats, design: Floats, person: Integers) -> BinomialData:
    """Count single trials with the same person and covariates together, which leaves the likelihood as it is."""
    keys = np.column_stack([person.astype(np.float64), design])
    rows, inverse = np.unique(keys, axis=0, return_inverse=True)
    index = inverse.reshape(-1)
    hits: Floats = np.bincount(index, weights=hit, minlength=len(rows)).astype(np.float64)
    trials: Floats = np.bincount(index, minlength=len(rows)).astype(np.float64)
    _, people = np.unique(rows[:, 0], return_inverse=True)
    return BinomialData(hits, trials, np.ascontiguousarray(rows[:, 1:]), people.astype(np.int64))


def mixed_logistic(data: BinomialData, names: Sequence[str], level: float = 0.95) -> MixedModel:
    """Fit hits on covariates with a normal random intercept per person, by 25-node adaptive quadrature.

    Every covariate but the constant gets a likelihood-ratio test. Where the intercepts do not vary, the model is
    fitted without them and says so. Raises NotEstimableError where the likelihood has no maximum.
    """
    _require_variation(data)
    plain = _fit_plain(data)
    mixed = _fit_mixed(data, plain)
    boundary = mixed.theta[-1] < _BOUNDARY or mixed.value <= plain.value + 1e-9
    best, fit = (plain, _fit_plain) if boundary else (mixed, None)
    z = float(special.ndtri((1 + level) / 2))
    coefficients = []
    for k, name in enumerate(names):
        value, error = float(best.theta[k]), float(best.errors[k])
        chi, p = math.nan, math.nan
        if k:
            less = data.without(k)
            smaller = _fit_plain(less) if fit else _fit_mixed(less, _fit_plain(less))
            chi = max(0.0, 2 * (best.value - smaller.value))
            p = float(special.chdtrc(1, chi))
        coefficients.append(Coefficient(name, value, error, value - z * error, value + z * error, chi, p))
    note = "people do not vary more than chance; fitted without the random intercept" if boundary else ""
    people = len(np.unique(data.person))
    sd = 0.0 if boundary else float(best.theta[-1])
    return MixedModel(tuple(coefficients), sd, best.value, people, int(data.trials.sum()), note)


_BOUNDARY = 1e-3
_SEPARATED = 12.0
"""A log odds beyond this is a group that always, or never, did it."""


@dataclass(frozen=True)
class _Fit:
    theta: Floats
    value: float
    errors: Floats


def _require_variation(data: BinomialData) -> None:
    people = len(np.unique(data.person))
    if people < 2 * LEAST:
        raise NotEstimableError(f"fewer than {2 * LEAST} people")
    if np.linalg.matrix_rank(data.design) < data.design.shape[1]:
        raise NotEstimableError("a covariate is the same for everybody, or follows from the others")
    for column in range(1, data.design.shape[1]):
        for level in np.unique(data.design[:, column])[:20]:
            rows = data.design[:, column] == level
            if data.hits[rows].sum() in {0, data.trials[rows].sum()}:
                raise NotEstimableError("a group always or never did it, so that the odds have no limit")
    if data.hits.sum() in {0, data.trials.sum()}:
        raise NotEstimableError("everybody always or never did it")


def _fit_plain(data: BinomialData) -> _Fit:
    """Return the logistic model without random intercepts, by Newton's method."""
    beta = np.zeros(data.design.shape[1])
    information = np.eye(len(beta))
    for _ in range(100):
        chance = special.expit(data.design @ beta)
        weight = data.trials * chance * (1 - chance)
        information = data.design.T @ (weight[:, None] * data.design)
        step = np.linalg.solve(information, data.design.T @ (data.hits - data.trials * chance))
        beta = beta + step
        if np.abs(beta).max() > _SEPARATED:
            raise NotEstimableError("a group always or never did it, so that the odds have no limit")
        if np.abs(step).max() < 1e-12:  # noqa: PLR2004 - converged
            break
    eta = data.design @ beta
    value = float((data.hits * eta - data.trials * np.logaddexp(0, eta)).sum())
    return _Fit(beta, value, np.sqrt(np.diag(np.linalg.inv(information))))


def _fit_mixed(data: BinomialData, plain: _Fit) -> _Fit:
    """Return the model with random intercepts: quasi-Newton on the marginal likelihood, errors from its curvature."""
    marginal = _Marginal(data)
    bounds = [(None, None)] * len(plain.theta) + [(0.0, 20.0)]
    best: Floats | None = None
    for sd in (0.5, 1.5):
        start = np.append(plain.theta, sd)
        found = optimize.minimize(
            marginal.loss, start, jac=True, method="L-BFGS-B", bounds=bounds, options={"ftol": 1e-15, "gtol": 1e-9}
        )
        if best is None or found.fun < marginal.loss(best)[0] - 1e-9:
            best = found.x
        if found.x[-1] > _BOUNDARY:
            break
    theta: Floats = best if best is not None else np.append(plain.theta, 0.0)
    if theta[-1] < _BOUNDARY:
        return _Fit(theta, -marginal.loss(theta)[0], np.full(len(theta), np.nan))
    theta, hessian = _polished(marginal, theta)
    if np.abs(theta[:-1]).max() > _SEPARATED:
        raise NotEstimableError("a group always or never did it, so that the odds have no limit")
    return _Fit(theta, -marginal.loss(theta)[0], np.sqrt(np.diag(np.linalg.inv(hessian))))


def _polished(marginal: _Marginal, theta: Floats) -> tuple[Floats, Floats]:
    """Return a maximum brought to full precision by Newton steps, and the curvature there."""
    hessian = marginal.curvature(theta)
    for _ in range(3):
        gradient = marginal.loss(theta)[1]
        step = np.linalg.solve(hessian, gradient)
        theta = theta - step
        if np.abs(step).max() < 1e-10:  # noqa: PLR2004 - converged
            break
    return theta, marginal.curvature(theta)


class _Marginal:
    """The likelihood of a model with the random intercepts integrated out; ``theta`` is the log odds, then the SD."""

    def __init__(self, data: BinomialData) -> None:
        """Sort the rows by person, so that a person's rows are one stretch."""
        order = np.argsort(data.person, kind="stable")
        self._hits, self._trials = data.hits[order], data.trials[order]
        self._design = data.design[order]
        _, starts, self._row = np.unique(data.person[order], return_index=True, return_inverse=True)
        self._starts = starts
        nodes, weights = np.polynomial.hermite.hermgauss(NODES)
        self._nodes = nodes * math.sqrt(2)
        self._log_weights = np.log(weights) + nodes**2 + 0.5 * math.log(2)

    def loss(self, theta: Floats) -> tuple[float, Floats]:
        """Return the negative log likelihood and its gradient."""
        beta, sd = theta[:-1], float(theta[-1])
        eta = self._design @ beta
        mode, width = self._modes(eta, sd)
        z = mode[:, None] + width[:, None] * self._nodes
        inside = eta[:, None] + sd * z[self._row]
        row = self._hits[:, None] * inside - self._trials[:, None] * np.logaddexp(0, inside)
        joint = np.add.reduceat(row, self._starts, axis=0)
        joint += np.log(width)[:, None] + self._log_weights - 0.5 * z**2 - 0.5 * math.log(2 * math.pi)
        log_person = special.logsumexp(joint, axis=1)
        share = np.exp(joint - log_person[:, None])
        residual = self._hits[:, None] - self._trials[:, None] * special.expit(inside)
        mean_residual = (share[self._row] * residual).sum(axis=1)
        by_sd = float((share[self._row] * residual * z[self._row]).sum())
        return -float(log_person.sum()), -np.append(self._design.T @ mean_residual, by_sd)

    def _modes(self, eta: Floats, sd: float) -> tuple[Floats, Floats]:
        """Where each person's intercept is most likely, in standard deviations, and how wide the peak is."""
        z = np.zeros(len(self._starts))
        curvature = np.ones(len(z))
        for _ in range(50):
            chance = special.expit(eta + sd * z[self._row])
            slope = sd * np.add.reduceat(self._hits - self._trials * chance, self._starts) - z
            curvature = 1 + sd * sd * np.add.reduceat(self._trials * chance * (1 - chance), self._starts)
            step = np.clip(slope / curvature, -2, 2)
            z = z + step
            if np.abs(step).max() < 1e-10:  # noqa: PLR2004 - converged
                break
        return z, 1 / np.sqrt(curvature)

    def curvature(self, theta: Floats) -> Floats:
        """Return the second derivatives of the loss: differences of the gradient, extrapolated once."""
        columns = []
        for k in range(len(theta)):
            step = np.zeros(len(theta))
            step[k] = 1e-3 * max(1.0, abs(float(theta[k])))
            wide, narrow = (
                (self.loss(theta + h * step)[1] - self.loss(theta - h * step)[1]) / (2 * h * step[k]) for h in (1, 0.5)
            )
            columns.append((4 * narrow - wide) / 3)
        matrix: Floats = np.column_stack(columns)
        symmetric: Floats = (matrix + matrix.T) / 2
        return symmetric
