"""An item that does not apply differs from one that was not answered, and is in no sum and no mean."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest

from kiosk.experiment.event_records import from_record, to_record
from kiosk.experiment.events import ResponseGiven
from kiosk.experiment.items import NOT_APPLICABLE, Response
from kiosk.export.bids import Bids
from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import PsychDs
from tests.export.conftest import rows_of
from tests.export.visitors import answered, store
from tests.samples import likert, questionnaire

ASKED = questionnaire(
    "about-you",
    *(likert(name, scale="S", not_applicable=True) for name in ("calm", "clear", "warm")),
    likert("plain"),
    per_page=4,
)
GIVEN: dict[str, Response] = {"calm": 4, "clear": NOT_APPLICABLE}
"""What the visitor says; the other two items are left out."""


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a data folder with one session, in which an item was answered, one does not apply and two were left."""
    folder = tmp_path_factory.mktemp("exempt") / "data"
    store(folder, [(answered(ASKED, GIVEN.items()), 1)])
    return folder


def test_the_table_of_answers_has_a_column_of_its_own_for_it(data: Path, tmp_path: Path) -> None:
    export_dataset(data, tmp_path / "out", PsychDs)
    rows = [row for row in rows_of(tmp_path / "out", "answers") if row["questionnaire"] == "about-you"]
    told = {row["item"]: (row["value"], row["number"], row["scored"], row["not_applicable"]) for row in rows}
    assert told == {
        "calm": ("4", "4", "4", "false"),
        "clear": ("", "", "", "true"),
        "warm": ("", "", "", "false"),
        "plain": ("", "", "", "false"),
    }
    (person,) = rows_of(tmp_path / "out", "participants")
    assert (person["clear"], person["clear_not_applicable"], person["warm_not_applicable"]) == ("", "true", "false")
    assert "plain_not_applicable" not in person
    events = [
        json.loads(row["fields"]) for row in rows_of(tmp_path / "out", "events") if row["type"] == "ResponseGiven"
    ]
    assert [event["value"] for event in events] == [4, {"not_applicable": True}]


def test_the_scores_say_how_many_items_they_are_of(data: Path, tmp_path: Path) -> None:
    export_dataset(data, tmp_path / "out", PsychDs)
    (score,) = (row for row in rows_of(tmp_path / "out", "scores") if row["scale"] == "S")
    counts = [score[name] for name in ("items", "answered", "items_not_applicable", "least_answered")]
    assert (counts, score["sum"], score["mean"]) == (["3", "1", "1", "2"], "", "")
    described = (tmp_path / "out" / "documentation" / "codebook.md").read_text("utf-8")
    assert "Whether the visitor said that clear does not apply" in described


def test_names_like_those_of_bids_have_the_column_too(data: Path, tmp_path: Path) -> None:
    export_dataset(data, tmp_path / "out", Bids)
    with (tmp_path / "out" / "phenotype" / "about_you.tsv").open(encoding="utf-8", newline="") as file:
        (row,) = csv.DictReader(file, delimiter="\t")
    assert (row["clear"], row["clear_not_applicable"], row["calm_not_applicable"]) == ("n/a", "true", "false")
    described = json.loads((tmp_path / "out" / "phenotype" / "about_you.json").read_text("utf-8"))
    assert set(row) == {*described} - {"MeasurementToolMetadata"}


def test_a_record_of_it_is_read_back_and_nothing_else_is_taken_for_it() -> None:
    event = ResponseGiven(at_ms=1, item="calm", value=NOT_APPLICABLE)
    assert from_record(json.loads(json.dumps(to_record(event)))) == event
    for value in ({"not_applicable": False}, {}, {"not_applicable": True, "more": 1}):
        with pytest.raises(ValueError, match="value"):
            from_record(to_record(event) | {"value": value})
