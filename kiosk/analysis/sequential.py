"""Boundaries for looking at data before the end: alpha spending (Lan and DeMets 1983), and Bayes factors."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq
from scipy.special import ndtr, ndtri

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
