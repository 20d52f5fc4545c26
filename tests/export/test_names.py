"""Two things of a study never become one column or one file, whatever their names and wherever they are read."""

from __future__ import annotations

import csv
import json
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from random import Random

import pytest

from kiosk import UserInputError
from kiosk.experiment.items import Integer
from kiosk.experiment.labels import fold_name, is_reserved
from kiosk.experiment.outcomes import Stage
from kiosk.experiment.questionnaire import Questionnaire
from kiosk.export.bids import Bids, distinct_files
from kiosk.export.columns import ExportOption, distinct
from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import Layout, PsychDs
from kiosk.export.new_files import CsvFile, TsvFile, write_json, write_text
from kiosk.export.records import StudyMaterials
from kiosk.export.tables import all_tables, renamed_items
from kiosk.store.merge import merge
from tests.experiment.driver import Driver
from tests.export.conftest import rows_of
from tests.export.psych_ds import issues
from tests.export.visitors import answer_all, store, study_plan
from tests.samples import likert, questionnaire


def number(name: str) -> Integer:
    return Integer(id=name, kind="integer", text={"en": f"{name}?"}, lowest=0, highest=1000)


ABOUT = questionnaire("about-you", number("flips"), number("Flips"), number("Condition"), number("participant_id"))
AFTER = questionnaire(
    "About_You",
    *(likert("Q1", scale="S"), likert("q1", scale="S"), likert("T-1", scale="s"), likert("T_1", scale="s")),
    number("MeasurementToolMetadata"),
)
ANSWERS = {"flips": 11, "Flips": 22, "Condition": 33, "participant_id": 44, "MeasurementToolMetadata": 55}
ANSWERS |= {"Q1": 1, "q1": 2, "T-1": 3, "T_1": 4}


def answered(about_you: Questionnaire, *after: Questionnaire, seed: int = 1, given: dict[str, int] = ANSWERS) -> Driver:
    """Record a participant who answered all of it, as a kiosk would before these names were refused."""
    driver = Driver(replace(study_plan(), about_you=about_you, questionnaires=after), seed)
    for stage in (Stage.ABOUT_YOU, Stage.QUESTIONS):
        driver.to(stage)
        answer_all(driver, Random(seed), given)
    driver.to(Stage.OVER)
    return driver


@pytest.fixture(scope="module")
def clashing(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the data folder of a participant who was asked under names that clash in every way."""
    folder = tmp_path_factory.mktemp("clashing") / "data"
    about = questionnaire("con", number("x1"))
    store(folder, [(answered(ABOUT, AFTER, questionnaire("about-you-2", number("x2")), about), 1)])
    return folder


def heads(out: Path) -> dict[str, list[str]]:
    """Return the columns of every table."""
    commas = {path.name: next(csv.reader(path.read_text("utf-8").splitlines())) for path in out.rglob("*.csv")}
    return commas | {path.name: path.read_text("utf-8").splitlines()[0].split("\t") for path in out.rglob("*.tsv")}


def folded(names: Iterable[str]) -> list[str]:
    return sorted(map(fold_name, names))


@pytest.mark.parametrize("layout", [PsychDs, Bids])
def test_no_table_has_two_columns_and_no_folder_two_files_of_one_name(
    clashing: Path, tmp_path: Path, layout: type[Layout]
) -> None:
    out = tmp_path / "out"
    export_dataset(clashing, out, layout, frozenset(ExportOption))
    for names in heads(out).values():
        assert len(set(folded(names))) == len(names)
    folders = [out, *(path for path in out.rglob("*") if path.is_dir())]
    for folder in folders:
        inside = [path.name for path in folder.iterdir()]
        assert len(set(folded(inside))) == len(inside)
        assert not [name for name in inside if is_reserved(name)]
    if layout is PsychDs:
        assert issues(out) == []


def test_every_answer_is_in_a_column_of_its_own(clashing: Path, tmp_path: Path) -> None:
    export_dataset(clashing, tmp_path / "out", PsychDs)
    (person,) = rows_of(tmp_path / "out", "participants")
    assert person["about_you_flips"] == "11"
    assert sorted(cell for name, cell in person.items() if name.startswith("about_you_")) == ["11", "22", "33", "44"]
    assert person["S_sum"] == "3"
    assert [cell for name, cell in person.items() if fold_name(name).endswith("about_you_s_sum")] == ["7"]
    values = {row["item"]: row["value"] for row in rows_of(tmp_path / "out", "answers")}
    assert {item: int(values[item]) for item in ANSWERS} == ANSWERS


def test_in_the_layout_of_bids_every_questionnaire_has_a_file_of_its_own(clashing: Path, tmp_path: Path) -> None:
    export_dataset(clashing, tmp_path / "out", Bids)
    told: dict[str, str] = {}
    for path in (tmp_path / "out" / "phenotype").glob("*.tsv"):
        head, row = (line.split("\t") for line in path.read_text("utf-8").splitlines())
        described = json.loads(path.with_suffix(".json").read_text("utf-8"))
        assert set(head) == described.keys() - {"MeasurementToolMetadata"}
        told |= {
            described[name]["Description"].split('"')[1]: cell for name, cell in zip(head[1:], row[1:], strict=True)
        }
        assert row[0] == "sub-P0001"
    assert {f"{item}?": str(value) for item, value in ANSWERS.items()}.items() <= told.items()
    assert len(list((tmp_path / "out" / "phenotype").glob("*.tsv"))) == 4


def test_two_sites_with_forms_of_nearly_one_name_are_exported_together(tmp_path: Path) -> None:
    for site, name, item in (("A", "form-a", "q1"), ("B", "form_a", "Q1")):
        about = questionnaire("about-you" if site == "A" else "About-You", number(f"{item}x"))
        given = {item: 1 if site == "A" else 5, f"{item}x": 7}
        store(
            tmp_path / site, [(answered(about, questionnaire(name, likert(item)), given=given), ord(site))], site=site
        )
    merge([tmp_path / "A", tmp_path / "B"], tmp_path / "all")
    for layout in (PsychDs, Bids):
        export_dataset(tmp_path / "all", tmp_path / layout.__name__, layout)
        for names in heads(tmp_path / layout.__name__).values():
            assert len(set(folded(names))) == len(names)
    forms = sorted((tmp_path / "Bids" / "phenotype").glob("form_a*.tsv"))
    assert [path.read_text("utf-8").splitlines()[1:] for path in forms] == [["sub-BnP0001\t5"], ["sub-AnP0001\t1"]]
    first, second = rows_of(tmp_path / "PsychDs", "participants")
    assert sorted(cell for name, cell in first.items() if name.lower().endswith("q1x")) == ["", "7"]
    assert sorted(cell for name, cell in second.items() if name.lower().endswith("q1x")) == ["", "7"]


def test_the_codebook_names_the_item_of_a_column_that_is_called_otherwise(clashing: Path, tmp_path: Path) -> None:
    export_dataset(clashing, tmp_path / "out", PsychDs)
    codebook = (tmp_path / "out" / "documentation" / "codebook.md").read_text("utf-8")
    assert "The item is called Condition." in codebook
    study = StudyMaterials((replace(study_plan(), about_you=ABOUT),))
    assert renamed_items(study).keys() == {"flips", "Flips", "Condition", "participant_id"}
    assert set(renamed_items(study).values()) <= set(all_tables(study, frozenset(ExportOption)).shapes[0].names)
    assert renamed_items(StudyMaterials((study_plan(),))) == {}


# Whatever a layout does, its files hold to it

TWO_THAT_ARE_ONE = [("flips", "Flips"), ("a-b", "a_b"), ("\u00e9", "e\u0301"), ("same", "same"), ("x", "x.")]


@pytest.mark.parametrize(("one", "other"), TWO_THAT_ARE_ONE)
@pytest.mark.parametrize("table", [CsvFile, TsvFile])
def test_a_table_with_two_columns_of_one_name_is_refused(
    table: type[CsvFile | TsvFile], one: str, other: str, tmp_path: Path
) -> None:
    with pytest.raises(UserInputError, match=r"the table 't\.csv' cannot have the columns .*, one for many programs"):
        table(tmp_path / "t.csv", [one, "else", other])
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(("one", "other"), TWO_THAT_ARE_ONE)
def test_a_second_file_of_one_name_is_refused_and_the_first_is_kept(one: str, other: str, tmp_path: Path) -> None:
    write_text(tmp_path / one, "first")
    ways = (
        lambda path: write_text(path, "second"),
        lambda path: write_json(path, {}),
        lambda path: CsvFile(path, ["a"]),
        lambda path: TsvFile(path, ["a"]),
    )
    for write in ways:
        with pytest.raises(UserInputError, match="is one file with it"):
            write(tmp_path / other)
    assert [path.read_text("utf-8") for path in tmp_path.iterdir()] == ["first"]


def test_a_file_with_the_name_of_a_device_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UserInputError, match=r"'nul\.tsv'.*: Windows keeps this name for a device"):
        TsvFile(tmp_path / "nul.tsv", ["a"])


def test_what_is_refused_while_a_data_set_is_written_leaves_nothing(clashing: Path, tmp_path: Path) -> None:
    class Careless(PsychDs):
        """Writes two files of one name."""

        def finish(self, flows: object) -> None:  # noqa: ARG002 - as every layout
            write_text(self.root / "readme.md", "one")
            write_text(self.root / "README.md", "two")

    with pytest.raises(UserInputError, match=r"cannot have a file 'README\.md'"):
        export_dataset(clashing, tmp_path / "out", Careless)
    assert list(tmp_path.iterdir()) == []


def test_names_are_told_apart_by_numbers() -> None:
    assert distinct(["a", "A", "a_2", "b"], ["B"]) == {"a": "a", "A": "A_2", "a_2": "a_2_2", "b": "b_2"}
    assert distinct_files(["form-a", "form_a", "con", "questionnaire-con", "a"]) == {
        "form-a": "form_a",
        "form_a": "form_a_2",
        "con": "questionnaire_con",
        "questionnaire-con": "questionnaire_con_2",
        "a": "a",
    }
