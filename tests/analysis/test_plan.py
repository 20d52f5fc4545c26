"""Plans: the template, what is refused, looks, the preregistration, freezing, and simulated power."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from scipy import stats

from kiosk import UserInputError
from kiosk.analysis import power
from kiosk.analysis.data import load_study, scale_items
from kiosk.analysis.plan import SCALES, TEMPLATE, StudyPlan, bayes_factors, boundaries, nominal_levels
from kiosk.analysis.statistics import student_error, welch_error
from kiosk.assistance.policy import QTable
from kiosk.cli.main import recollect
from kiosk.config import ASSETS
from kiosk.experiment.questionnaire import Questionnaire
from kiosk.export.layouts import file_of
from kiosk.store.plans import frozen_plans
from kiosk.store.verify import verify
from kiosk.training.simulated_players import PopulationPlayer
from tests.patience import started


@pytest.fixture
def plan(tmp_path: Path) -> Path:
    file = tmp_path / "plan.toml"
    file.write_text(TEMPLATE)
    return file


def job(plan: Path, studies: int = 100, sizes: tuple[int, ...] = (20,), *, null: bool = False) -> power.PowerJob:
    player = PopulationPlayer().parameters()
    del player["name"]
    read = StudyPlan.read(plan)
    table = QTable.named("default").to_json()
    return power.PowerJob(read.model_dump_json(), table, "most_flipped", player, sizes, studies, 1, null)


def run(*words: str) -> str:
    done = CliRunner().invoke(recollect, words)
    assert done.exit_code == 0, done.output
    return done.stdout


def test_the_bounds_are_those_of_the_published_tables() -> None:
    """Two-sided alpha .05 and four equal looks, as gsDesign and Lan and DeMets (1983) have them."""
    looks = [14, 28, 42, 56]
    assert boundaries(looks, 0.05, "obrien-fleming") == pytest.approx([4.3326, 2.9631, 2.3590, 2.0141], abs=1e-3)
    assert boundaries(looks, 0.05, "pocock") == pytest.approx([2.3683, 2.3675, 2.3582, 2.3500], abs=1e-3)


def test_the_page_of_plans_gives_the_levels_of_its_four_looks() -> None:
    page = (Path(__file__).parents[2] / "docs" / "how-to" / "plan.md").read_text("utf-8")
    for spending in ("obrien-fleming", "pocock"):
        row = re.search(rf"^\| `{spending}` \|(.*)\|$", page, re.MULTILINE)
        assert row is not None
        levels = nominal_levels([14, 28, 42, 56], 0.05, spending)
        assert [cell.strip() for cell in row[1].split("|")] == [f"{level:.5f}" for level in levels]


def test_the_bayes_factors_are_those_of_bayes_factor_in_r() -> None:
    """R: BayesFactor::ttest.tstat(t = c(0, 2, 3.5), 28, 28, simple = TRUE)."""
    assert bayes_factors(np.array([0.0, 2.0, 3.5]), 28, 28) == pytest.approx(
        [0.2699231082, 1.388105962, 32.66161821], rel=1e-6
    )


@pytest.mark.parametrize("spending", ["obrien-fleming", "pocock"])
def test_looks_together_spend_no_more_than_alpha(spending: str) -> None:
    looks = np.array([14, 28, 42, 56])
    rng = np.random.default_rng(1)
    steps = rng.standard_normal((60_000, 4)) * np.sqrt(np.diff(looks, prepend=0))
    z = np.cumsum(steps, axis=1) / np.sqrt(looks)
    crossed = (np.abs(z) > boundaries(looks.tolist(), 0.05, spending)).any(axis=1).mean()
    assert crossed == pytest.approx(0.05, abs=0.004)


def test_the_template_is_a_plan_with_the_papers_choices_as_a_named_row(tmp_path: Path) -> None:
    file = tmp_path / "new.toml"
    run("plan", "new", str(file))
    told = json.loads(run("plan", "check", str(file), "--json"))
    assert told["plan"]["sensitivity"][0]["name"] == "as the paper"
    assert told["plan"]["correction"] == "holm"
    again = CliRunner().invoke(recollect, ["plan", "new", str(file)])
    assert isinstance(again.exception, UserInputError)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('measure = "flips"', 'measure = "flops"', "there is no measure 'flops'"),
        ('"notom"]', '"tomm"]', "there is no condition 'tomm'"),
        ('"H1-time"', '"H1-flips"', "two hypotheses have the same id"),
        ("alpha = 0.05", "alpha = 5", "alpha"),
        ("# [sequential]\n# looks = [14, 28, 42, 56]", "[sequential]\nlooks = [14, 28]", "the last look must be"),
        ("# [sequential]\n# looks = [14, 28, 42, 56]", "[sequential]\nlooks = [28, 14]", "looks must be rising"),
    ],
)
def test_a_plan_that_cannot_be_meant_is_refused(plan: Path, old: str, new: str, said: str) -> None:
    plan.write_text(TEMPLATE.replace(old, new))
    with pytest.raises(UserInputError, match=said):
        StudyPlan.read(plan)


def test_scales_have_the_names_that_their_questionnaire_gives_them(plan: Path) -> None:
    questionnaire = Questionnaire.read(ASSETS / "questionnaires" / "social-intelligence.toml")
    named = " ".join(questionnaire.note.split())
    assert set(SCALES) == set(questionnaire.scales)
    for scale, name in SCALES.items():
        assert f"{scale} {name}" in named
    plan.write_text(TEMPLATE.replace("AC_sum", "PC_sum"))
    assert "in sum of PC (predicts human cognitions)" in run("plan", "show", str(plan))


def test_the_preregistration_names_every_hypothesis_and_look(plan: Path) -> None:
    plan.write_text(TEMPLATE.replace("# [sequential]\n# looks = [14, 28, 42, 56]", "[sequential]\nlooks = [28, 56]"))
    text = run("plan", "show", str(plan))
    for words in ("H1-flips", "H3-competence", "Sample", "sample size", "Outliers and exclusions", "28 an arm: p <"):
        assert words.lower() in text.lower()


@pytest.mark.parametrize(
    ("direction", "said"),
    [
        ("less", "`tom` is lower than `notom` in assistance per flip"),
        ("greater", "`tom` is higher than `notom` in assistance per flip"),
        ("two-sided", "`tom` differs from `notom` in assistance per flip"),
    ],
)
def test_the_preregistration_says_each_hypothesis_in_a_sentence(plan: Path, direction: str, said: str) -> None:
    old = 'measure = "assistance_per_flip"\ndirection = "less"'
    assert old in TEMPLATE
    plan.write_text(TEMPLATE.replace(old, old.replace("less", direction)))
    assert f"- **H2-assistance** (assistance): {said}\n" in run("plan", "show", str(plan))


def test_a_plan_is_frozen_once_and_no_look_comes_before_its_time(plan: Path, tmp_path: Path) -> None:
    data = tmp_path / "data"
    early = CliRunner().invoke(recollect, ["plan", "look", str(plan), "--data", str(data)])
    assert "is not frozen" in str(early.exception)
    frozen = json.loads(run("plan", "freeze", str(plan), "--data", str(data), "--json"))
    assert frozen_plans(data)[0].sha256 == frozen["sha256"]
    assert not verify(data)
    again = CliRunner().invoke(recollect, ["plan", "freeze", str(plan), "--data", str(data)])
    assert "frozen" in str(again.exception)
    look = CliRunner().invoke(recollect, ["plan", "look", str(plan), "--data", str(data)])
    assert "results by condition are not shown before" in str(look.exception)


def test_any_number_of_workers_gives_the_same_numbers_and_a_killed_run_goes_on(plan: Path, tmp_path: Path) -> None:
    wanted = job(plan)
    whole = power.run(wanted, tmp_path / "one")
    two = power.run(wanted, tmp_path / "two", workers=2)
    assert np.array_equal(whole, two, equal_nan=True)
    lines = (tmp_path / "one").read_text().splitlines(keepends=True)
    (tmp_path / "killed").write_text(lines[0] + lines[1] + lines[2][:40])
    done: list[int] = []
    again = power.run(wanted, tmp_path / "killed", progress=lambda block, _: done.append(block))
    assert done == [2]
    assert np.array_equal(whole, again, equal_nan=True)
    with pytest.raises(UserInputError, match="belongs to another plan"):
        power.run(job(plan, sizes=(21,)), tmp_path / "one")


@pytest.mark.parametrize("content", ["text\n", "[]\n", "{}\n", "[" * 100_000 + "\n", "\xff\n"])
def test_a_file_that_is_no_store_of_blocks_is_refused_and_stays(plan: Path, tmp_path: Path, content: str) -> None:
    store = tmp_path / "mine"
    store.write_text(content, "latin-1")
    with pytest.raises(UserInputError, match=r"mine (was not written by|cannot be read)"):
        power.run(job(plan), store)
    assert store.read_text("latin-1") == content


CLUSTER = """
import sys
from distributed import LocalCluster
with LocalCluster(
    n_workers=2, threads_per_worker=1, processes=False, host="127.0.0.1", protocol="tcp://", dashboard_address=None
) as cluster:
    print(cluster.scheduler_address, flush=True)
    sys.stdin.read()
"""
"""A scheduler and two workers that talk to each other over the network, and are soon there in one process."""


@contextmanager
def running_cluster() -> Iterator[str]:
    """Provide a Dask scheduler of this machine with two workers; its address."""
    command = [sys.executable, "-c", CLUSTER]
    with started(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as cluster:
        yield cluster.stdout.readline().strip()
        cluster.communicate()


def test_a_dask_cluster_of_two_workers_gives_the_same_numbers(plan: Path, tmp_path: Path) -> None:
    asked = ("plan", "power", str(plan), "--n", "20", "--studies", "100", "--json")
    with running_cluster() as host:
        told = json.loads(run(*asked, "--scheduler", host, "--store", str(tmp_path / "cluster")))
    alone = json.loads(run(*asked, "--workers", "1", "--store", str(tmp_path / "alone")))
    assert told["rows"] == alone["rows"]


def test_without_an_effect_tests_keep_their_level_and_with_one_power_grows(plan: Path, tmp_path: Path) -> None:
    rows = power.summarise(job(plan, 400, null=True), power.run(job(plan, 400, null=True), tmp_path / "null"))
    for row in rows:
        assert row.rejected == pytest.approx(0.05, abs=0.04), row
        assert row.corrected <= row.rejected
    sized = job(plan, 100, (20, 60))
    rows = power.summarise(sized, power.run(sized, tmp_path / "power"))
    at = {(row.test, row.n): row.rejected for row in rows}
    assert at["d = 0.8", 60] > 0.9
    assert at["d = 0.35", 60] > at["d = 0.35", 20]


def test_the_t_tests_are_those_of_scipy() -> None:
    rng = np.random.default_rng(2)
    x, y = rng.standard_normal(20), 2 * rng.standard_normal(28) + 0.5
    for pooled in (True, False):
        found = stats.ttest_ind(x, y, equal_var=pooled)
        error, df = (student_error if pooled else welch_error)(x, y)
        assert (float(x.mean() - y.mean()) / error, df) == pytest.approx((found.statistic, found.df), rel=1e-12)


def test_the_two_sd_rule_within_groups_rejects_too_often() -> None:
    rng = np.random.default_rng(3)
    tests = [power._Test("x", "x", "welch", rule, "two-sided") for rule in ("technical", "2sd-within", "2sd-pooled")]
    hits = np.zeros(3)
    for _ in range(3000):
        one, two = {"x": rng.standard_normal(28)}, {"x": rng.standard_normal(28)}
        hits += [abs(power._signed(test, one, two, 28)) < 0.05 for test in tests]
    within, pooled = hits[1] / 3000, hits[2] / 3000
    assert within > 0.065
    assert pooled < within


def test_a_simulated_study_of_a_plan_is_a_data_set(plan: Path, tmp_path: Path) -> None:
    plan.write_text(TEMPLATE.replace("n_per_arm = 56", "n_per_arm = 6"))
    told = json.loads(run("plan", "simulate", str(plan), "--out", str(tmp_path / "study"), "--json"))
    assert told["participants"] == 12
    calibrated = json.loads(run("calibrate", str(tmp_path / "study"), "--json"))
    assert calibrated["sessions"] == 12


def test_a_simulated_study_has_the_answers_that_its_scores_are_of(plan: Path, tmp_path: Path) -> None:
    plan.write_text(TEMPLATE.replace("n_per_arm = 56", "n_per_arm = 15"))
    for name in ("one", "two"):
        run("plan", "simulate", str(plan), "--out", str(tmp_path / name), "--json")
    study = load_study(tmp_path / "one")
    who = study.participants.text("participant_id")
    scales = {scale.name: scale for scale in scale_items(study, who)}
    scores = study.tables["scores"]
    assert set(scales) == {"SOC", "AC", "PC", "RC"}
    for name, scale in scales.items():
        assert scale.items == tuple(f"{name}{number}" for number in (1, 2, 3, 4))
        assert ((scale.scored >= 1) & (scale.scored <= 5)).all()
        sums = [float(total) for total, of in zip(scores.text("sum"), scores.text("scale"), strict=True) if of == name]
        assert scale.scored.sum(axis=1).tolist() == sums
        assert len({tuple(row) for row in scale.scored.tolist()}) > len(set(sums))
    answers = file_of("answers")
    assert (tmp_path / "one" / answers).read_bytes() == (tmp_path / "two" / answers).read_bytes()
