"""The report of a data set: its numbers, its status, its files, and what it refuses."""

from __future__ import annotations

import csv
import json
import math
import re
import shutil
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from kiosk import UserInputError
from kiosk.analysis.data import load_study
from kiosk.analysis.hypotheses import check_hypotheses
from kiosk.analysis.hypotheses_page import hypotheses_table
from kiosk.analysis.page import (
    DataSource,
    Picture,
    ReportPage,
    ReportTable,
    Section,
    latex_table,
    markdown_table,
    to_html,
    to_markdown,
)
from kiosk.analysis.paper import recompute
from kiosk.analysis.plan import TEMPLATE, StudyPlan
from kiosk.analysis.report import make_report
from kiosk.analysis.sample import ExclusionStep, choose_sample, read_exclusions
from kiosk.cli.main import recollect
from kiosk.export.layouts import file_of
from tests.analysis.chromium import opened_browser


def run(*words: str) -> str:
    done = CliRunner().invoke(recollect, words)
    assert done.exit_code == 0, done.output
    return done.stdout


@pytest.fixture(scope="module")
def export(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a simulated study of 12 + 12."""
    folder = tmp_path_factory.mktemp("study")
    (folder / "plan.toml").write_text(TEMPLATE.replace("n_per_arm = 56", "n_per_arm = 12"))
    run("plan", "simulate", str(folder / "plan.toml"), "--out", str(folder / "export"))
    return folder / "export"


@pytest.fixture(scope="module")
def written(export: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Everything that a report writes into a folder, with the paper."""
    out = tmp_path_factory.mktemp("report") / "out"
    (out.parent / "printed.txt").write_text(run("report", str(export), "--out", str(out), "--paper"))
    return out


def plan_of(folder: Path) -> StudyPlan:
    (folder / "template.toml").write_text(TEMPLATE)
    return StudyPlan.read(folder / "template.toml")


def edited(export: Path, folder: Path, table: str, edit: Callable[[dict[str, str]], dict[str, str] | None]) -> Path:
    """Return a copy of a data set whose rows of one table went through ``edit``; None drops a row."""
    copy = folder / "edited"
    shutil.copytree(export, copy)
    path = copy / file_of(table)
    with path.open(encoding="utf-8", newline="") as file:
        rows = [row for row in map(edit, csv.DictReader(file)) if row is not None]
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)
    return copy


def test_a_report_has_every_form_of_its_content(written: Path) -> None:
    page = (written / "report.html").read_text("utf-8")
    for part in ("Hypotheses", "Participants", "Sensitivity", "Bayes factors", "Reliability", "recomputed"):
        assert f"{part}" in page
        assert part in (written / "report.md").read_text("utf-8")
    assert {"hypotheses-table.csv", "hypotheses-table.tex", "paper-table.csv"} <= {
        path.name for path in (written / "tables").iterdir()
    }
    assert {"flow.svg", "effects.svg", "values-flips.svg"} <= {path.name for path in (written / "figures").iterdir()}
    assert json.loads((written / "results.json").read_text("utf-8"))["status"] == "EXPLORATORY"


def test_the_worked_example_of_the_page_is_what_the_commands_print(written: Path) -> None:
    page = (Path(__file__).parents[2] / "docs" / "how-to" / "report.md").read_text("utf-8")
    example = page.split("$ recollect report example")[1].split("```")[0].split("\n", 1)[1]
    printed = (written.parent / "printed.txt").read_text().splitlines()[:-1]
    assert example.splitlines()[:-1] == printed
    results = json.loads((written / "results.json").read_text("utf-8"))
    flips = next(row for row in results["comparisons"] if row["measure"] == "flips")
    lines = {line["name"]: line for line in flips["lines"]}
    told = [*flips["mean"], lines["welch"]["statistic"], lines["welch"]["df"], lines["hedges_g"]["estimate"]]
    told += [lines["hedges_g"]["low"], lines["hedges_g"]["high"]]
    words = page.split("<!-- numbers -->")[1].split("<!-- /numbers -->")[0]
    assert re.findall(r"-?\d+\.\d+", words)[: len(told)] == [f"{value:.2f}" for value in told]


def test_a_page_asks_for_nothing_outside_and_no_id_occurs_twice(written: Path) -> None:
    page = (written / "report.html").read_text("utf-8")
    outside = [link for link in re.findall(r'(?:src|href)="([^"]*)"', page) if not link.startswith("#")]
    assert outside == []
    assert "url(http" not in page
    assert "@import" not in page
    ids = re.findall(r'\bid="([^"]*)"', page)
    assert len(ids) == len(set(ids))
    assert set(re.findall(r'href="#([^"]*)"', page)) <= set(ids)


def test_the_same_data_give_the_same_bytes(export: Path, written: Path, tmp_path: Path) -> None:
    run("report", str(export), "--out", str(tmp_path / "again.html"), "--paper")
    assert (tmp_path / "again.html").read_bytes() == (written / "report.html").read_bytes()


def test_no_text_of_a_study_can_break_the_page() -> None:
    bad = "<script>alert('1')</script> & |co"
    table = ReportTable("t", bad, (bad, bad), ((bad, bad),), bad)
    blocks = (bad, table, DataSource(bad, bad), Picture("p", bad, "<svg ></svg>", bad, wide=True))
    shown = ReportPage(bad, "EXPLORATORY", bad, ((bad, bad),), (Section("s", bad, blocks),))
    assert "<script" not in to_html(shown)
    assert "<script" not in to_markdown(shown).replace("\\<", "").replace(f"```\n{bad}\n```", "")


def test_declared_exclusions_are_counted_by_condition_with_their_reason(export: Path, tmp_path: Path) -> None:
    (tmp_path / "out.csv").write_text("participant_id,reason\ns0001,the screen went dark\n")
    sample = choose_sample(load_study(export), plan_of(tmp_path), read_exclusions(tmp_path / "out.csv"))
    assert sample.steps == (ExclusionStep("the screen went dark", {"tom": 1}),)
    assert [int(sample.rows(name).sum()) for name in sample.conditions] == [11, 12]


def test_who_was_not_drawn_or_did_not_finish_is_left_out_and_counted(export: Path, tmp_path: Path) -> None:
    ends = {
        "s0001": {"allocation_source": "override"},
        "s0002": {"game_completed": "false", "last_stage": "game"},
        "s0013": {"game_completed": "false", "last_stage": "practice"},
    }
    copy = edited(export, tmp_path, "participants", lambda row: row | ends.get(row["participant_id"], {}))
    found = json.loads(run("report", str(copy), "--json"))
    assert [(step["rule"], step["counts"]) for step in found["exclusions"]] == [
        ("the experimenter chose the condition", {"tom": 1}),
        ("the game was not completed", {"tom": 1, "notom": 1}),
    ]
    completion = {row["condition"]: row for row in found["completion"]}
    assert (completion["tom"]["allocated"], completion["tom"]["ended"]) == (11, {"game": 1})
    assert completion["notom"]["ended"] == {"practice": 1}


def test_who_came_back_counts_once_by_the_first_visit(export: Path, tmp_path: Path) -> None:
    visits = {"s0001": {"visit": "2"}}
    copy = edited(
        export, tmp_path, "participants", lambda row: row | {"visit": "1"} | visits.get(row["participant_id"], {})
    )
    sample = choose_sample(load_study(copy), plan_of(tmp_path))
    assert (sample.later, len(sample.exported), sample.steps) == (1, 23, ())
    run("report", str(copy), "--out", str(tmp_path / "report.html"), "--paper")
    assert "not analysed here: 1." in (tmp_path / "report.html").read_text("utf-8")


def test_a_constant_measure_gets_a_reason_and_no_number(export: Path, tmp_path: Path) -> None:
    copy = edited(export, tmp_path, "participants", lambda row: row | {"flips": "40"})
    plan = plan_of(tmp_path)
    hypothesis = check_hypotheses(choose_sample(load_study(copy), plan), plan)[0]
    assert hypothesis.measure == "flips"
    assert hypothesis.verdict == "not tested: every value in each group is the same"
    assert math.isnan(hypothesis.p)


@pytest.mark.parametrize(
    ("edit", "sentence"),
    [
        (lambda row: row if row["condition"] == "tom" else None, "people in one condition only"),
        (
            lambda row: row if row["participant_id"] not in {f"s{n:04}" for n in range(3, 13)} else None,
            "needs at least 3",
        ),
        (lambda row: row | {"condition": "tomm"} if row["condition"] == "tom" else row, "0 people to analyse in tom"),
    ],
)
def test_too_few_people_get_a_sentence(
    export: Path, tmp_path: Path, edit: Callable[[dict[str, str]], dict[str, str] | None], sentence: str
) -> None:
    copy = edited(export, tmp_path, "participants", edit)
    with pytest.raises(UserInputError, match=sentence):
        choose_sample(load_study(copy), plan_of(tmp_path))


def test_a_report_that_cannot_be_written_says_so_before_it_reads(export: Path, tmp_path: Path) -> None:
    done = CliRunner().invoke(recollect, ["report", str(export), "--out", str(tmp_path / "nowhere" / "page.html")])
    assert isinstance(done.exception, UserInputError)
    nothing = CliRunner().invoke(recollect, ["report"])
    assert "a report needs the folder of an exported data set" in str(nothing.exception)


def test_the_table_for_a_paper_is_valid_in_markdown_and_latex(export: Path) -> None:
    table = hypotheses_table(make_report(load_study(export)))
    lines = markdown_table(table).splitlines()
    assert len({line.count(" | ") for line in lines}) == 1
    latex = latex_table(table)
    assert latex.count("\\begin{") == latex.count("\\end{")
    rows = [line for line in latex.splitlines() if line.endswith(r"\\") and " & " in line]
    assert {line.count(" & ") for line in rows} == {len(table.head) - 1}
    assert not re.search(r"(?<!\\)[%_#]", latex.replace("\\label{tab:hypotheses-table}", ""))


def test_the_papers_numbers_are_those_of_its_means() -> None:
    found: dict[str, Any] = {row.measure: row for row in recompute()}
    assert found["turns (flips)"].t == pytest.approx(-1.60, abs=0.005)
    assert found["turns (flips)"].d == pytest.approx(-0.43, abs=0.005)
    assert found["time"].p == pytest.approx(0.053, abs=5e-4)
    assistance = found["assistance per flip"]
    assert (assistance.t, assistance.low, assistance.high) == pytest.approx((-3.74, -4.61, -2.99), abs=0.006)
    assert found["competence (AC)"].t == pytest.approx(2.49, abs=0.006)
    social = found["social intelligence (SOC)"]
    assert (social.low, social.high) == pytest.approx((1.07, 1.10), abs=0.005)
    assert [row.measure for row in recompute() if row.holm < 0.05] == ["assistance per flip"]
    assert json.loads(run("report", "--paper", "--json"))["paper"][3]["printed"] == "t = 2.4"


def test_a_browser_shows_the_page_without_an_error_a_request_or_a_cut(written: Path, tmp_path: Path) -> None:
    with opened_browser(tmp_path / "profile") as browser:
        for width in (1280, 390):
            metrics = {"width": width, "height": 800, "deviceScaleFactor": 1, "mobile": width < 400}
            browser.ask("Emulation.setDeviceMetricsOverride", **metrics)
            browser.open(written / "report.html")
            assert browser.value("document.documentElement.scrollWidth <= innerWidth")
            small = browser.value(
                "[...document.querySelectorAll('main p, main td, main th, figcaption')]"
                ".filter(e => parseFloat(getComputedStyle(e).fontSize) < 12).length"
            )
            assert small == 0
        assert browser.named("Runtime.exceptionThrown") == []
        assert browser.named("Runtime.consoleAPICalled") == []
        assert browser.named("Log.entryAdded") == []
        asked = {each["request"]["url"] for each in browser.named("Network.requestWillBeSent")}
        assert asked <= {(written / "report.html").as_uri()}
        seen = browser.accessible()
        assert len(browser.ask("Page.printToPDF", printBackground=True)["data"]) > 100_000
    roles = Counter(role for role, _ in seen)
    page = (written / "report.html").read_text("utf-8")
    assert roles["table"] == page.count("<table>")
    assert roles["rowheader"] == page.count('<th scope="row">')
    assert roles["columnheader"] == page.count('<th scope="col"')
    # Each table, figure and part has a name, and the first table is named by its caption.
    assert all(name for role, name in seen if role in {"table", "image", "region", "navigation"})
    assert next(name for role, name in seen if role == "table").startswith("Table 1. The hypotheses")
    assert roles["image"] == page.count("<svg ")


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("participant_id\n1\n", "needs a first line with the columns participant_id and reason"),
        ("participant_id,reason\n1,\n", "row 2: participant_id and reason must both be given"),
        ("participant_id,reason\n1,ill\n1,ill\n", "row 3: 1 is excluded twice"),
        ("participant_id,reason\nnot-there,ill\n", "not-there"),
    ],
    ids=["a column is missing", "no reason", "twice", "not in the data"],
)
def test_exclusions_that_cannot_be_used_are_refused_in_one_sentence(
    export: Path, tmp_path: Path, text: str, says: str
) -> None:
    (tmp_path / "exclude.csv").write_text(text)
    words = ["report", str(export), "--out", str(tmp_path / "out.html"), "--exclude", str(tmp_path / "exclude.csv")]
    with pytest.raises(UserInputError) as refused:
        CliRunner().invoke(recollect, words, catch_exceptions=False)
    (sentence,) = refused.value.sentences
    assert says in sentence
    assert not (tmp_path / "out.html").exists()
