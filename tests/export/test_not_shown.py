"""The data set tells a hidden item apart from one that was left out and from one that does not apply."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest

from kiosk.export.bids import Bids
from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import PsychDs
from tests.export.conftest import rows_of
from tests.export.visitors import answered, store
from tests.samples import likert, questionnaire

ASKED = questionnaire(
    "about-you",
    likert("plays"),
    likert("often", scale="S").model_copy(update={"relevant": "plays > 3", "not_applicable": True}),
    likert("calm", scale="S").model_copy(update={"relevant": "plays > 1"}),
    likert("plain"),
    per_page=4,
)


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a data folder with one session, in which an answer was withdrawn as its item was hidden."""
    folder = tmp_path_factory.mktemp("hidden") / "data"
    store(folder, [(answered(ASKED, (("plays", 5), ("often", 2), ("plays", 3))), 1)])
    return folder


def test_answers_and_scores_say_what_was_hidden(data: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    export_dataset(data, out, PsychDs)
    rows = [row for row in rows_of(out, "answers") if row["questionnaire"] == "about-you"]
    assert {row["item"]: (row["value"], row["scored"], row["not_applicable"], row["not_shown"]) for row in rows} == {
        "plays": ("3", "3", "false", "false"),
        "often": ("", "", "false", "true"),
        "calm": ("", "", "false", "false"),
        "plain": ("", "", "false", "false"),
    }
    (score,) = (row for row in rows_of(out, "scores") if row["scale"] == "S")
    counts = [score[name] for name in ("items", "answered", "items_not_applicable", "items_not_shown", "mean")]
    assert counts == ["2", "0", "0", "1", ""]
    (person,) = rows_of(out, "participants")
    assert (person["often"], person["often_not_shown"], person["calm_not_shown"]) == ("", "true", "false")
    assert "plain_not_shown" not in person
    codebook = (out / "documentation" / "codebook.md").read_text("utf-8")
    assert "Whether the condition of often did not hold in the end; often is then empty." in codebook
    hidden = [row["fields"] for row in rows_of(out, "events") if row["type"] == "HiddenItemsChanged"]
    assert '"withdrawn": ["often"]' in hidden[-1].replace('":[', '": [')


def test_names_like_those_of_bids_have_the_column_too(data: Path, tmp_path: Path) -> None:
    export_dataset(data, tmp_path / "out", Bids)
    with (tmp_path / "out" / "phenotype" / "about_you.tsv").open(encoding="utf-8", newline="") as file:
        (row,) = csv.DictReader(file, delimiter="\t")
    assert (row["often"], row["often_not_shown"], row["calm_not_shown"]) == ("n/a", "true", "false")
