"""A form that changed while a study ran is described in all its versions, and the export says so."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from random import Random

import pytest
from click.testing import CliRunner

from kiosk.cli.main import recollect
from kiosk.experiment.items import Answer, Multiple, ShortText, Single
from kiosk.experiment.outcomes import Stage
from kiosk.experiment.questionnaire import Questionnaire
from kiosk.export.bids import Bids
from kiosk.export.columns import ExportOption
from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import PsychDs
from tests.experiment.driver import Driver
from tests.export.conftest import rows_of
from tests.export.visitors import answer_all, store, study_plan
from tests.samples import likert, options, questionnaire


def coffee(*names: str) -> Multiple:
    return Multiple(id="coffee", kind="multiple", text={"en": "Which coffee?"}, options=options(*names))


def version(number: str, *items: object) -> Questionnaire:
    return questionnaire("about-you", *items).model_copy(update={"version": number})


OLD = version("1", coffee("turkish", "espresso"), likert("first", points=5, scale="L"), likert("gone"))
NEW = version(
    "2", coffee("turkish", "keurig"), likert("first", points=7, scale="L"), likert("second", points=7, scale="L")
)
GIVEN: dict[str, Answer] = {"first": 3, "second": 7, "gone": 2}


def asked(about_you: Questionnaire, seed: int, **given: Answer) -> tuple[Driver, int]:
    driver = Driver(replace(study_plan(), about_you=about_you), seed)
    driver.to(Stage.ABOUT_YOU)
    answer_all(driver, Random(seed), GIVEN | given)
    driver.end()
    return driver, seed


@pytest.fixture(scope="module")
def changed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a data folder in which the questionnaire about the visitor has two versions."""
    folder = tmp_path_factory.mktemp("changed") / "data"
    store(folder, [asked(OLD, 1, coffee=("espresso",)), asked(NEW, 2, coffee=("keurig",))])
    return folder


def described(out: Path) -> dict[str, dict[str, object]]:
    told = json.loads((out / "dataset_description.json").read_text("utf-8"))
    return {variable["name"]: variable for variable in told["variableMeasured"]}


def test_every_value_of_every_version_is_described(changed: Path, tmp_path: Path) -> None:
    export_dataset(changed, tmp_path / "out", PsychDs)
    first, second = rows_of(tmp_path / "out", "participants")
    assert (first["coffee"], first["first"], first["second"], first["gone"], first["L_sum"]) == (
        "espresso",
        "3",
        "",
        "2",
        "3",
    )
    assert (second["coffee"], second["first"], second["second"], second["gone"], second["L_sum"]) == (
        "keurig",
        "3",
        "7",
        "",
        "10",
    )
    assert (first["questionnaire_versions"].split(";")[0], second["questionnaire_versions"].split(";")[0]) == (
        "about-you=1",
        "about-you=2",
    )
    variables = described(tmp_path / "out")
    levels = variables["coffee"]["valueReference"]
    assert isinstance(levels, list)
    assert [level["name"] for level in levels] == ["turkish", "keurig", "espresso"]
    assert (variables["first"]["minValue"], variables["first"]["maxValue"]) == (1, 7)
    assert (variables["L_sum"]["minValue"], variables["L_sum"]["maxValue"]) == (1, 14)


def test_the_description_says_what_each_version_asked(changed: Path, tmp_path: Path) -> None:
    export_dataset(changed, tmp_path / "out", PsychDs)
    told = {name: str(variable["description"]) for name, variable in described(tmp_path / "out").items()}
    assert 'version 2 of about-you: "first?" 1 to 7' in told["first"]
    assert 'version 1 of about-you: "first?" 1 to 5' in told["first"]
    assert "version 1 of about-you: not asked" in told["second"]
    assert "version 2 of about-you: not asked" in told["gone"]
    assert "not to be compared between them. version 2 of about-you: first (1 to 7), second (1 to 7)" in told["L_sum"]
    assert "Not the same" not in told["SOC_sum"] + told["agreed_store"]


def test_the_layout_of_bids_has_the_items_of_all_versions(changed: Path, tmp_path: Path) -> None:
    export_dataset(changed, tmp_path / "out", Bids)
    head, *rows = (
        line.split("\t") for line in (tmp_path / "out/phenotype/about_you.tsv").read_text("utf-8").splitlines()
    )
    cells = [dict(zip(head, row, strict=True)) for row in rows]
    assert [(row["first"], row["second"], row["gone"]) for row in cells] == [("3", "n/a", "2"), ("3", "7", "n/a")]
    about = json.loads((tmp_path / "out/phenotype/about_you.json").read_text("utf-8"))
    assert about["MeasurementToolMetadata"]["Description"].startswith("about-you, version 2, 1.")
    assert about.keys() - {"MeasurementToolMetadata"} == set(head)


def test_the_export_says_that_a_form_changed(changed: Path, tmp_path: Path) -> None:
    done = CliRunner().invoke(recollect, ["export", "--data", str(changed), "--out", str(tmp_path / "out")])
    (caution,) = [line for line in done.output.splitlines() if line.startswith("caution: ")]
    assert "'about-you' was asked in 2 versions (2, 1), which differ in coffee, first, second, gone, L;" in caution
    told = CliRunner().invoke(recollect, ["export", "--data", str(changed), "--out", str(tmp_path / "b"), "--json"])
    assert [f"caution: {each}" for each in json.loads(told.stdout)["cautions"]] == [caution]


def test_a_form_that_changed_under_its_version_is_told_apart_by_its_hash(tmp_path: Path) -> None:
    other = NEW.model_copy(update={"version": "1"})
    store(tmp_path / "data", [asked(OLD, 1), asked(other, 2)])
    done = export_dataset(tmp_path / "data", tmp_path / "out", PsychDs)
    versions = [row["questionnaire_versions"].split(";")[0] for row in rows_of(tmp_path / "out", "participants")]
    assert versions == [f"about-you=1 ({form.sha256[:8]})" for form in (OLD, other)]
    assert all(form.sha256[:8] in done.cautions[0] for form in (OLD, other))


def test_a_translation_that_came_later_changes_nothing(tmp_path: Path) -> None:
    item = OLD.items[1].model_copy(update={"text": {"en": "first?", "it": "prima?"}})
    translated = OLD.model_copy(update={"items": (OLD.items[0], item, OLD.items[2])})
    store(tmp_path / "data", [asked(OLD, 1), asked(translated, 2)])
    assert export_dataset(tmp_path / "data", tmp_path / "out", PsychDs).cautions == ()
    assert {row["questionnaire_versions"].split(";")[0] for row in rows_of(tmp_path / "out", "participants")} == {
        "about-you=1"
    }


@pytest.mark.parametrize(
    "extras", [frozenset[ExportOption](), frozenset({ExportOption.TEXTS})], ids=["without texts", "with texts"]
)
def test_what_was_typed_in_one_version_and_chosen_in_another_is_told_only_where_it_was_chosen(
    extras: frozenset[ExportOption], tmp_path: Path
) -> None:
    typed = version("1", ShortText(id="job", kind="text", text={"en": "job?"}, longest=40))
    chosen = version("2", Single(id="job", kind="single", text={"en": "job?"}, options=options("nurse", "other")))
    for name, forms in (("chosen later", (typed, chosen)), ("typed later", (chosen, typed))):
        data, out = tmp_path / name / "data", tmp_path / name / "out"
        people = [asked(form, 1, job="Zaphod of Main Street" if form is typed else "nurse") for form in forms]
        store(data, [(driver, number) for number, (driver, _) in enumerate(people, 1)])
        export_dataset(data, out, PsychDs, extras)
        told = [row["job"] for row in rows_of(out, "participants")]
        assert told == [("Zaphod of Main Street" if extras else "") if form is typed else "nurse" for form in forms]


def test_a_sheet_that_changed_under_its_version_is_told(tmp_path: Path) -> None:
    plan = study_plan()
    sheet = plan.information
    reworded = sheet.model_copy(update={"about": sheet.about.model_copy(update={"title": "Something else"})})
    drivers = [Driver(replace(plan, information=each), 1) for each in (sheet, reworded)]
    for driver in drivers:
        driver.to(Stage.ABOUT_YOU)
        driver.end()
    store(tmp_path / "data", [(driver, number) for number, driver in enumerate(drivers, 1)])
    (caution,) = export_dataset(tmp_path / "data", tmp_path / "out", PsychDs).cautions
    assert caution.startswith("the information sheet in 'en' has 2 contents under the version '7'")


def test_a_study_that_never_changed_has_nothing_to_be_told(stored: Path, tmp_path: Path) -> None:
    assert export_dataset(stored, tmp_path / "out", PsychDs).cautions == ()
