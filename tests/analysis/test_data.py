"""A report reads a folder that an export wrote, and says in one sentence why it cannot read another."""

from __future__ import annotations

import csv
import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from kiosk import UserInputError
from kiosk.analysis.data import COLUMNS, ExportedStudy, ExportTable, load_study, scale_items, scale_remarks
from kiosk.export.codebook import CODEBOOK_VERSION
from kiosk.export.layouts import file_of

PEOPLE = ("P0001", "P0002", "P0003")


def write_export(folder: Path) -> Path:
    """Return a small data set of three people with two scales."""
    (folder / "data").mkdir(parents=True)
    described = {
        "name": "A study",
        "description": "Exported by Recollect 0.2.0.",
        "schemaVersion": CODEBOOK_VERSION,
    }
    (folder / "dataset_description.json").write_text(json.dumps(described), "utf-8")
    rows: dict[str, list[dict[str, str]]] = {name: [] for name in COLUMNS}
    for number, person in enumerate(PEOPLE):
        rows["participants"].append(
            {"participant_id": person, "condition": ("notom", "tom")[number % 2], "flips": str(40 + number)}
        )
        for item, (scale, score) in {"A2": ("A", "4"), "A10": ("A", ""), "B1": ("B", "1"), "age": ("", "")}.items():
            rows["answers"].append(
                {"participant_id": person, "questionnaire": "q", "item": item, "scored": score, "scale": scale}
            )
    for name, columns in COLUMNS.items():
        with (folder / file_of(name)).open("w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, columns, restval="")
            writer.writeheader()
            writer.writerows(rows[name])
    return folder


def test_a_table_is_read_by_columns(tmp_path: Path) -> None:
    study = load_study(write_export(tmp_path / "set"))
    assert study.title == "A study"
    assert study.conditions == ("tom", "notom")
    assert study.participants.numbers("flips").tolist() == [40, 41, 42]
    assert np.isnan(study.participants.numbers("hints")).all()
    assert study.participants.where(study.participants.numbers("flips") > 40).text("participant_id") == [
        "P0002",
        "P0003",
    ]


def test_the_items_of_a_scale_stand_in_their_own_order(tmp_path: Path) -> None:
    study = load_study(write_export(tmp_path / "set"))
    first, second = scale_items(study, PEOPLE[:2])
    assert (first.name, first.items) == ("A", ("A2", "A10"))
    assert (second.name, second.items) == ("B", ("B1",))
    assert first.scored[:, 0].tolist() == [4, 4]
    assert np.isnan(first.scored[:, 1]).all()


def take_table(folder: Path) -> None:
    (folder / file_of("hints")).unlink()


def take_column(folder: Path) -> None:
    path = folder / file_of("flips")
    path.write_text(path.read_text("utf-8").replace("matched", "met"), "utf-8")


def write_word(folder: Path) -> None:
    path = folder / file_of("participants")
    path.write_text(path.read_text("utf-8").replace("41", "many"), "utf-8")


def break_row(folder: Path) -> None:
    path = folder / file_of("participants")
    path.write_text(path.read_text("utf-8") + "P0004,tom\r\n", "utf-8")


def name_other_version(folder: Path) -> None:
    path = folder / "dataset_description.json"
    path.write_text(path.read_text("utf-8").replace(f'"{CODEBOOK_VERSION}"', '"0"'), "utf-8")


def name_other_program(folder: Path) -> None:
    (folder / "dataset_description.json").write_text('{"name": "x", "description": "of another program"}', "utf-8")


def be_bids(folder: Path) -> None:
    (folder / "participants.tsv").write_text("", "utf-8")


@pytest.mark.parametrize(
    ("spoil", "sentence"),
    [
        (take_table, "lacks the table hints"),
        (take_column, "lacks the columns matched"),
        (write_word, "row 3: flips must be a number, but it is 'many'"),
        (break_row, "row 5: there are 2 cells, but"),
        (name_other_version, "has the codebook version 0, but this program reads"),
        (name_other_program, "is no data set of Recollect"),
        (be_bids, "has the names of BIDS"),
    ],
)
def test_a_data_set_that_is_not_whole_gets_a_sentence(
    tmp_path: Path, spoil: Callable[[Path], None], sentence: str
) -> None:
    folder = write_export(tmp_path / "set")
    spoil(folder)
    with pytest.raises(UserInputError, match=sentence):
        load_study(folder).participants.numbers("flips")


def test_a_folder_that_is_none_and_one_of_something_else_get_a_sentence(tmp_path: Path) -> None:
    with pytest.raises(UserInputError, match="is no folder"):
        load_study(tmp_path / "nowhere")
    with pytest.raises(UserInputError, match="is no exported data set"):
        load_study(tmp_path)


def test_scales_of_several_versions_and_items_that_do_not_apply_or_were_hidden_are_told() -> None:
    scores = {
        "participant_id": ["P1", "P2", "P3", "P4"],
        "questionnaire": ["own"] * 4,
        "scale": ["S", "S", "T", "T"],
        "version": ["1", "2", "1", "1"],
        "items_not_applicable": ["0", "1", "0", "2"],
        "items_not_shown": ["0", "2", "0", "1"],
    }
    study = ExportedStudy(Path(), "", {"scores": ExportTable(Path("scores.csv"), scores)}, "")
    mixed, exempt, hidden = scale_remarks(study, ["P1", "P2", "P3"])
    assert mixed.startswith("S was asked in 2 versions of its questionnaire (1, 2).")
    assert exempt.startswith("Of the responses to items of S, 1 said that the item does not apply.")
    assert hidden.startswith("Of the items of S, 2 were hidden by their condition, counted over all people.")
    assert scale_remarks(study, ["P1", "P3"]) == ()
