"""Every statistic is what R says it is; the scripts in tests/analysis/r write the expected numbers."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy import stats

from kiosk.analysis import models, statistics
from kiosk.analysis.statistics import NotEstimableError

EXPECTED = Path(__file__).parent / "r" / "expected"
GROUPS: dict[str, Any] = json.loads((EXPECTED / "two_groups.json").read_text("utf-8"))
MODELS: dict[str, Any] = json.loads((EXPECTED / "models.json").read_text("utf-8"))
CASES: dict[str, Any] = GROUPS["cases"]


def near(expected: Any, tolerance: float = 1e-6) -> Any:
    return pytest.approx(expected, rel=tolerance, abs=tolerance)


def groups(name: str) -> tuple[statistics.Floats, statistics.Floats]:
    return np.array(CASES[name]["x"], dtype=float), np.array(CASES[name]["y"], dtype=float)


every_case = pytest.mark.parametrize("name", CASES)


@every_case
@pytest.mark.parametrize("test", ["welch", "student"])
def test_the_tests_of_means_are_those_of_r(name: str, test: str) -> None:
    found = getattr(statistics, test)(*groups(name))
    assert [found.statistic, found.df, found.p, found.low, found.high] == near(CASES[name][test])


@every_case
def test_the_rank_test_is_that_of_coin_also_with_ties(name: str) -> None:
    found, case = statistics.mann_whitney(*groups(name)), CASES[name]
    assert found.statistic == near(case["u"])
    assert found.p == near(case["rank_p"] if case["exact"] else case["rank_p_normal"])
    assert [found.estimate, found.low, found.high] == near(case["rank_biserial"])
    assert [found.estimate, found.low, found.high] == near(case["rank_biserial_effectsize"])


def test_the_exact_rank_test_does_not_overflow_in_groups_of_a_hundred() -> None:
    values = np.arange(200.0)
    found = statistics.mann_whitney(values[::2], values[1::2])
    assert found.note == "exact"
    assert found.p == near(math.erfc(50 / math.sqrt(2 * 100 * 100 * 201 / 12)), 5e-3)


@pytest.mark.parametrize("name", [name for name, case in CASES.items() if case["permutation_p"] is not None])
def test_few_splits_are_all_counted(name: str) -> None:
    found, case = statistics.permutation(*groups(name)), CASES[name]
    assert found.p == near(case["permutation_p"])
    if case["permutation_p_coin"] is not None:
        assert found.p == near(case["permutation_p_coin"])


def test_many_splits_are_drawn_the_same_way_every_time() -> None:
    x, y = groups("plain")
    first, again = statistics.permutation(x, y), statistics.permutation(x, y)
    assert first == again
    assert first.p == pytest.approx(statistics.student(x, y).p, abs=0.02)


@every_case
def test_assumptions_are_tested_as_in_r(name: str) -> None:
    x, y = groups(name)
    for values, expected in ((x, CASES[name]["shapiro_x"]), (y, CASES[name]["shapiro_y"])):
        if expected is None:
            with pytest.raises(NotEstimableError, match="every value is the same"):
                statistics.shapiro(values)
        else:
            found = statistics.shapiro(values)
            assert [found.statistic, found.p] == near(expected)
    spread = statistics.brown_forsythe(x, y)
    assert [spread.statistic, spread.p] == near(CASES[name]["brown_forsythe"])


@every_case
def test_effect_sizes_have_the_intervals_of_the_noncentral_t(name: str) -> None:
    x, y = groups(name)
    d, g, case = statistics.cohen_d(x, y), statistics.hedges_g(x, y), CASES[name]
    assert [d.value, d.low, d.high] == near(case["cohen_d"])
    assert [g.value, g.low, g.high] == near(case["hedges_g"])
    if abs(d.value) < 5:  # beyond, the noncentral t of R itself is rough
        assert [d.value, d.low, d.high] == near(case["cohen_d_effectsize"], 1e-4)
        assert g.value == near(case["hedges_g_effectsize"], 1e-4)


@every_case
def test_equivalence_is_two_one_sided_tests(name: str) -> None:
    bound, p, low, high = CASES[name]["tost"]
    found = statistics.equivalence(*groups(name), bound)
    assert [found.p, found.low, found.high] == near([p, low, high])


@every_case
def test_bayes_factors_are_those_of_the_package_of_that_name(name: str) -> None:
    x, y = groups(name)
    t = statistics.student(x, y).statistic
    found = [statistics.bayes_factor(t, len(x), len(y), scale) for scale in statistics.ROBUSTNESS]
    assert found == near(CASES[name]["bayes_factors"])


def test_a_bootstrap_interval_is_that_of_boot() -> None:
    case = GROUPS["bca"]
    found = statistics.bca(np.array(case["values"]), case["value"], np.array(case["influence"]))
    assert list(found) == near(case["interval"])


def test_a_bootstrap_is_near_the_interval_of_t_where_that_holds() -> None:
    x, y = groups("plain")
    found, test = statistics.bootstrap_difference(x, y), statistics.student(x, y)
    assert found == statistics.bootstrap_difference(x, y)
    assert [found.low, found.high] == pytest.approx([test.low, test.high], abs=0.6)


def test_the_jackknife_of_a_mean_is_the_interval_of_t() -> None:
    x, _ = groups("plain")
    left_out = (x.sum() - x) / (len(x) - 1)
    low, high = stats.t.interval(0.9, len(x) - 1, x.mean(), stats.sem(x))
    margin = statistics.jackknife_margin(left_out, 0.9)
    assert [x.mean() - margin, x.mean() + margin] == pytest.approx([low, high])


def test_corrections_leave_missing_tests_out() -> None:
    case = GROUPS["corrections"]
    ps = [math.nan if p is None else p for p in case["p"]]
    for adjust, expected in ((statistics.holm, case["holm"]), (statistics.benjamini_hochberg, case["bh"])):
        assert adjust(ps) == pytest.approx([math.nan if p is None else p for p in expected], nan_ok=True, abs=1e-12)


def test_counts_are_tested_as_in_r() -> None:
    assert [statistics.fisher(table) for table in GROUPS["fisher"]["tables"]] == near(GROUPS["fisher"]["p"])
    case = GROUPS["wilson"]
    found = [statistics.wilson(hits, n) for hits, n in zip(case["hits"], case["n"], strict=True)]
    assert [each.low for each in found] == near(case["low"])
    assert [each.high for each in found] == near(case["high"])


def test_the_noncentral_t_is_that_of_r_and_a_number_where_the_one_of_scipy_is_none() -> None:
    case = GROUPS["noncentral"]
    rows = list(zip(case["t"], case["df"], case["ncp"], strict=True))
    assert [statistics.noncentral_t(*row) for row in rows] == near(case["p"], 1e-9)
    low, high = statistics.noncentrality_interval(40.0, 4)
    assert statistics.noncentral_t(40.0, 4, low) == near(0.975)
    assert statistics.noncentral_t(40.0, 4, high) == near(0.025)


def test_power_counts_both_tails() -> None:
    case = GROUPS["power"]
    pairs = list(zip(case["d"], case["n"], strict=True))
    assert [statistics.t_power(d, n, n) for d, n in pairs] == near(case["power"])
    assert [statistics.sensitivity(n, n) for n in case["n"]] == near(case["sensitivity"])


@pytest.mark.parametrize(
    ("x", "y", "reason"),
    [
        ([1.0, 2.0], [1.0, 2.0, 3.0], "fewer than 3 in a group"),
        ([4.0] * 5, [4.0] * 6, "every value in each group is the same"),
        ([4.0] * 5, [5.0] * 6, "every value in each group is the same"),
    ],
)
def test_what_cannot_be_tested_gives_a_reason(x: list[float], y: list[float], reason: str) -> None:
    first, second = np.array(x), np.array(y)
    for test in (statistics.welch, statistics.student, statistics.cohen_d, statistics.permutation):
        with pytest.raises(NotEstimableError, match=reason):
            test(first, second)


# Models


@pytest.mark.parametrize("name", MODELS["reliability"])
def test_reliability_is_that_of_r(name: str) -> None:
    case = MODELS["reliability"][name]
    items = np.array([[math.nan if cell is None else cell for cell in row] for row in case["items"]], dtype=float)
    found = models.reliability(items)
    assert found.n == case["n"]
    assert [found.alpha.value, found.alpha.low, found.alpha.high] == near(case["alpha"])
    if isinstance(case["omega"], float):
        assert found.omega == near(case["omega"])
    else:
        assert math.isnan(found.omega)
        assert found.omega_note
    expected = [math.nan if r is None else r for r in case["item_rest"]]
    assert list(found.item_rest) == pytest.approx(expected, abs=1e-6, nan_ok=True)


@pytest.mark.parametrize("name", MODELS["factorial"])
def test_the_two_by_two_design_has_sums_of_squares_of_type_three(name: str) -> None:
    case = MODELS["factorial"][name]
    first, second = np.array(case["first"]), np.array(case["second"])
    found = models.two_by_two(np.array(case["value"], dtype=float), first, second, ("target", "explanation"))
    assert [effect.name for effect in found] == ["target", "explanation", "target x explanation"]
    assert [effect.f for effect in found] == near(case["f"])
    assert [effect.p for effect in found] == near(case["p"])
    assert [effect.size for effect in found] == near(case["eta"])
    assert {effect.df for effect in found} == {case["df"]}


def test_a_design_that_lacks_a_cell_has_no_interaction() -> None:
    first, second = np.array([0, 0, 0, 1, 1, 1]), np.array([0, 0, 0, 1, 1, 1])
    with pytest.raises(NotEstimableError, match="a cell of the design has fewer than 3 people"):
        models.two_by_two(np.arange(6.0), first, second, ("target", "explanation"))


@pytest.mark.parametrize("name", MODELS["mixed"])
def test_mixed_models_are_those_of_r(name: str) -> None:
    case = MODELS["mixed"][name]
    columns = [np.ones(len(case["hits"])), np.array(case["condition"], dtype=float)]
    columns += [np.array(case["extra"], dtype=float)] if case.get("extra") else []
    hits, trials = np.array(case["hits"], dtype=float), np.array(case["trials"], dtype=float)
    data = models.BinomialData(hits, trials, np.column_stack(columns), np.array(case["person"]))
    found = models.mixed_logistic(data, ["constant", "condition", "extra"][: len(columns)])
    assert bool(found.note) is case["boundary"]
    assert found.sd == near(case["sd"])
    assert [each.value for each in found.coefficients] == near(case["beta"])
    assert [each.error for each in found.coefficients] == near(case["errors"])
    assert found.log_likelihood == near(case["log_likelihood"])
    tests = case["chi"] if isinstance(case["chi"], list) else [case["chi"]]
    ps = case["p"] if isinstance(case["p"], list) else [case["p"]]
    assert [each.chi_squared for each in found.coefficients[1:]] == near(tests)
    assert [each.p for each in found.coefficients[1:]] == near(ps)


def test_single_trials_can_be_counted_together() -> None:
    rng = np.random.default_rng(5)
    person = np.repeat(np.arange(20), 6)
    design: statistics.Floats = np.column_stack([np.ones(120), person % 2]).astype(float)
    hit = (rng.random(120) < 0.6).astype(float)
    single = models.BinomialData(hit, np.ones(120), design, person)
    counted = models.collapse(hit, design, person)
    assert len(counted.hits) == 20
    apart = models.mixed_logistic(single, ["constant", "condition"])
    together = models.mixed_logistic(counted, ["constant", "condition"])
    assert [each.value for each in together.coefficients] == near([each.value for each in apart.coefficients])


def test_a_group_that_always_did_it_has_no_odds() -> None:
    person = np.arange(10)
    design: statistics.Floats = np.column_stack([np.ones(10), person % 2]).astype(float)
    hits = np.where(person % 2 == 1, 4.0, 2.0)
    with pytest.raises(NotEstimableError, match="always or never"):
        models.mixed_logistic(models.BinomialData(hits, np.full(10, 4.0), design, person), ["constant", "condition"])
