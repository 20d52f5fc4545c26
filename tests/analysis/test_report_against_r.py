"""The report of a whole rehearsed study of four cells has the numbers that an R script works out from its tables."""

from __future__ import annotations

import json
import math
import zipfile
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from kiosk.analysis.compare import Comparison
from kiosk.analysis.data import DESCRIPTION, load_study
from kiosk.analysis.report import Report, describe, make_report
from kiosk.export.codebook import CODEBOOK_VERSION

HERE = Path(__file__).parent / "r"
R: Mapping[str, Any] = json.loads((HERE / "expected" / "report.json").read_text("utf-8"))


def near(expected: Any, tolerance: float = 1e-6) -> Any:
    return pytest.approx(expected, rel=tolerance, abs=tolerance)


def unpack(folder: Path) -> Path:
    """Return the stored data set, as an export of this version."""
    with zipfile.ZipFile(HERE / "four_cells.zip") as stored:
        stored.extractall(folder)
    described = json.loads((folder / DESCRIPTION).read_text("utf-8")) | {"schemaVersion": CODEBOOK_VERSION}
    (folder / DESCRIPTION).write_text(json.dumps(described), "utf-8")
    return folder


@pytest.fixture(scope="module")
def report(tmp_path_factory: pytest.TempPathFactory) -> Report:
    return make_report(load_study(unpack(tmp_path_factory.mktemp("four") / "cells")))


def test_the_same_people_are_analysed(report: Report) -> None:
    sample = report.sample
    assert {name: int(sample.rows(name).sum()) for name in sample.conditions} == R["analysed"]
    for found, expected in zip(report.completion, R["completion"], strict=True):
        assert (found.condition, found.allocated, found.completed) == (
            expected["condition"],
            expected["allocated"],
            expected["completed"],
        )
        assert dict(found.ended) == (expected["ended"] or {})
        assert [found.share.low, found.share.high] == near(expected["interval"])
    assert report.completion_p.estimate == near(R["fisher_p"])


def test_means_sds_and_quartiles_are_those_of_r(report: Report) -> None:
    expected = {(row["measure"], row["condition"]): row for row in R["descriptives"]}
    found = describe(report.sample)
    assert len(found) == len(expected)
    for row in found:
        other = expected[row["measure"], row["condition"]]
        assert row["n"] == other["n"]
        assert [row[name] for name in ("mean", "sd")] == near([other["mean"], other["sd"]])
        assert [row[name] for name in ("least", "q1", "median", "q3", "most")] == near(other["quartiles"])


def numbers(found: Comparison, *names: str) -> list[float]:
    """Statistic, df, p and interval of a test, without those that do not apply."""
    lines = [asdict(found.line(name)) for name in names]
    return [line[key] for line in lines for key in ("statistic", "df", "p", "low", "high") if not math.isnan(line[key])]


@pytest.mark.parametrize("expected", R["compared"], ids=lambda row: str(row["measure"]))
def test_every_test_of_a_measure_is_that_of_r(report: Report, expected: Mapping[str, Any]) -> None:
    found = report.comparison(expected["measure"])
    assert list(found.n) == expected["n"]
    assert numbers(found, "welch") == near(expected["welch"])
    assert [found.line("student").statistic, found.line("student").p] == near(expected["student"])
    assert [found.line("mann-whitney").statistic, found.line("mann-whitney").p] == near(
        [expected["u"], expected["rank_p"]]
    )
    g = found.line("hedges_g")
    assert [g.estimate, g.low, g.high] == near(expected["g"])
    bayes = [line.estimate for line in found.lines if line.name.startswith("bayes_")]
    assert bayes == near(expected["bayes"], 1e-5)
    assert [line.p for line in found.lines if line.name.startswith("shapiro_")] == near(expected["shapiro"])


def test_the_hypotheses_and_the_papers_way_are_those_of_r(report: Report) -> None:
    for found, expected in zip(report.hypotheses, R["hypotheses"], strict=True):
        assert found.id == expected["id"]
        assert [found.p, found.corrected] == near([expected["p"], expected["corrected"]])
    for row, other in zip(report.sensitivity[0].results, R["paper"], strict=True):
        assert list(row.n) == other["n"]
        assert row.p == near(other["p"])


def test_the_two_by_two_design_is_that_of_r(report: Report) -> None:
    assert len(report.design) == len(R["design"])
    for found, expected in zip(report.design, R["design"], strict=True):
        assert found.measure == expected["measure"]
        assert [effect.f for effect in found.effects] == near(expected["f"])
        assert [effect.p for effect in found.effects] == near(expected["p"])
        assert [effect.size for effect in found.effects] == near(expected["size"])
        assert {effect.df for effect in found.effects} == {expected["df"]}


def test_the_reliability_of_scales_is_that_of_r(report: Report) -> None:
    for found, expected in zip(report.scales, R["reliable"], strict=True):
        assert found.name == expected["scale"]
        assert found.found is not None
        alpha = found.found.alpha
        assert (found.found.n, [alpha.value, alpha.low, alpha.high]) == (expected["n"], near(expected["alpha"]))


@pytest.mark.parametrize("name", R["models"])
def test_the_models_of_single_hints_and_moves_are_those_of_lme4(report: Report, name: str) -> None:
    """As near as lme4 comes to the maximum; test_statistics compares with more digits."""
    expected = R["models"][name]
    found = next(each for each in report.models if each.name == name).model
    assert found is not None
    assert (found.trials, found.sd == 0) == (expected["n"], expected["boundary"])
    assert found.sd == near(expected["sd"], 2e-4)
    assert [each.value for each in found.coefficients] == near(expected["beta"], 2e-4)
    assert [each.chi_squared for each in found.coefficients[1:]] == near(np.atleast_1d(expected["chi"]).tolist(), 2e-4)
