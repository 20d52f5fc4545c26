"""A report is confirmatory only under the plan that was frozen first, and shows nothing before a declared look."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from scipy import stats

from kiosk import UserInputError
from kiosk.analysis.data import ExportedStudy, load_study
from kiosk.analysis.hypotheses import check_hypotheses, reached_looks
from kiosk.analysis.plan import TEMPLATE, StudyPlan, nominal_levels
from kiosk.analysis.report import CONFIRMATORY, EXPLORATORY, make_report
from kiosk.analysis.report_page import report_page
from kiosk.analysis.sample import Sample, choose_sample
from kiosk.cli.main import recollect
from kiosk.experiment.condition import Condition
from kiosk.export.columns import ExportOption
from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import PLANS, PsychDs, plan_file
from kiosk.store.plans import frozen_plans
from tests.analysis.test_report_against_r import unpack
from tests.export.visitors import store, visitor

LOOKS = "[sequential]\nlooks = [14, 28]\nspending = "


def run(*words: str) -> None:
    done = CliRunner().invoke(recollect, words)
    assert done.exit_code == 0, done.output


def plan_file_of(folder: Path, n: int, more: str = "") -> Path:
    """Return the template for so many an arm."""
    file = folder / f"plan-{n}.toml"
    file.write_text(TEMPLATE.replace("n_per_arm = 56", f"n_per_arm = {n}") + more)
    return file


def collected(folder: Path, plan: Path | None, late: Path | None = None) -> Path:
    """Return the data set of four people in each condition, with a plan frozen before them."""
    data, out = folder / "data", folder / "export"
    if plan is not None:
        run("plan", "freeze", str(plan), "--data", str(data))
    seeds = [(seed, condition) for seed in range(1, 5) for condition in (Condition.TOM, Condition.NOTOM)]
    store(data, [(visitor(seed, condition), seed) for seed, condition in seeds])
    if late is not None:
        refused = CliRunner().invoke(recollect, ["plan", "freeze", str(late), "--data", str(data)])
        assert "before the first" in str(refused.exception)
    export_dataset(data, out, PsychDs, frozenset({ExportOption.UNSHARED}))
    return out


@pytest.fixture(scope="module")
def frozen(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the data set of a study whose plan, for three an arm, was frozen first."""
    folder = tmp_path_factory.mktemp("frozen")
    return collected(folder, plan_file_of(folder, 3), late=plan_file_of(folder, 4))


def test_a_report_under_the_frozen_plan_is_confirmatory_on_every_sheet(frozen: Path) -> None:
    study = load_study(frozen)
    assert [plan.sha256 for plan in study.plans] == [frozen_plans(frozen.parent / "data")[0].sha256]
    report = make_report(study)
    assert report.standing.status == CONFIRMATORY
    assert report.plan.n_per_arm == 3
    page = report_page(report)
    assert page.badge == CONFIRMATORY
    titles = [section.title for section in page.sections]
    assert "Hypotheses" in titles
    assert "All tests of each measure (exploratory)" in titles


def test_a_report_under_another_plan_is_exploratory(frozen: Path, tmp_path: Path) -> None:
    report = make_report(load_study(frozen), plan_file_of(tmp_path, 2 + 1, "\n# a comment changes the hash\n"))
    assert (report.standing.status, report.standing.reason) == (
        EXPLORATORY,
        "this plan is not one that was frozen in the data folder",
    )


def test_a_plan_that_was_changed_in_the_data_set_is_refused(frozen: Path) -> None:
    file = frozen / PLANS.with_name(plan_file(load_study(frozen).plans[0].sha256))
    was = file.read_bytes()
    file.write_bytes(was.replace(b"alpha = 0.05", b"alpha = 0.10"))
    try:
        with pytest.raises(UserInputError, match="is not the plan that was frozen"):
            load_study(frozen)
    finally:
        file.write_bytes(was)


def test_conditions_are_not_compared_before_the_first_declared_look(tmp_path: Path) -> None:
    out = collected(tmp_path, plan_file_of(tmp_path, 28, LOOKS + '"obrien-fleming"\n'))
    for plan in (None, plan_file_of(tmp_path, 3)):
        with pytest.raises(UserInputError, match="first look at 14 participants an arm, and there are"):
            make_report(load_study(out), plan)


@pytest.fixture(scope="module")
def study(tmp_path_factory: pytest.TempPathFactory) -> ExportedStudy:
    """Return a rehearsed study, which may be looked at at any time."""
    return load_study(unpack(tmp_path_factory.mktemp("four") / "cells"))


def sequential(study: ExportedStudy, folder: Path, spending: str) -> tuple[StudyPlan, Sample]:
    plan = StudyPlan.read(plan_file_of(folder, 28, f'{LOOKS}"{spending}"\n'))
    return plan, choose_sample(study, plan)


@pytest.mark.parametrize("spending", ["obrien-fleming", "pocock"])
def test_each_look_tests_the_first_people_at_its_own_level(study: ExportedStudy, tmp_path: Path, spending: str) -> None:
    plan, sample = sequential(study, tmp_path, spending)
    looks = reached_looks(sample, plan)
    levels = dict(zip((14, 28), nominal_levels([14, 28], 0.05, spending), strict=True))
    assert [(look.per_arm, look.level) for look in looks if look.hypothesis == "H2-assistance"] == list(levels.items())
    for look in looks:
        assert look.crossed == (look.p <= levels[look.per_arm])
        if look.hypothesis == "H2-assistance":
            arms = [
                sample.measured["assistance_per_flip"][sample.rows(name)][: look.per_arm] for name in plan.conditions
            ]
            assert look.p == pytest.approx(stats.ttest_ind(*arms, equal_var=False).pvalue, rel=1e-9)
    results = check_hypotheses(sample, plan)
    assert {(row.level, row.direction) for row in results} == {(levels[28], "two-sided")}


def test_a_bayesian_plan_stops_at_its_bound_whatever_p_is(study: ExportedStudy, tmp_path: Path) -> None:
    plan, sample = sequential(study, tmp_path, "bayes")
    looks = reached_looks(sample, plan)
    assert all(math.isnan(look.level) for look in looks)
    bayes = np.array([look.bayes for look in looks])
    assert [look.crossed for look in looks] == ((bayes >= 10) | (bayes <= 0.1)).tolist()
    for row in check_hypotheses(sample, plan):
        assert (row.verdict == "supported") <= (row.bayes >= 10)
