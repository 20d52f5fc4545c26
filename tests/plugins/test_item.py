"""A kind of item that another package brings: asked, answered on the screen, scored and exported."""

from __future__ import annotations

import csv
import json
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.plugins.installing import PLUGINS, install, recollect, register

EXTEND = PLUGINS.parents[1] / "docs" / "extend.md"
FILES = ("pyproject.toml", "recollect_ranking/__init__.py", "recollect_ranking/Ranking.qml")

QUESTIONS = """\
id = "helpers"
version = "1"
note = "our own"

[[items]]
id = "H1"
kind = "ranking"
text.en = "Who would you like to play with?"
counted = "robot"
options = [
    { id = "robot", text.en = "a robot" },
    { id = "person", text.en = "a person" },
    { id = "alone", text.en = "nobody" },
]
"""


@pytest.fixture(scope="module")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder in which the package is installed."""
    folder = tmp_path_factory.mktemp("ranking") / "packages"
    install("ranking", folder)
    return folder


def study(folder: Path, questions: str = QUESTIONS) -> Path:
    """A study file whose questionnaire after the game has an item of the kind."""
    (folder / "helpers.toml").write_text(questions, "utf-8")
    file = folder / "study.toml"
    file.write_text('languages = ["en"]\nquestionnaires = ["helpers.toml"]\n', "utf-8")
    return file


def rows(folder: Path, table: str) -> Iterator[dict[str, str]]:
    """The rows of a table of a data set."""
    (file,) = folder.glob(f"data/*{table}_data.csv")
    with file.open(encoding="utf-8-sig", newline="") as open_file:
        yield from csv.DictReader(open_file)


def test_a_session_asks_it_and_the_data_have_the_answer_and_its_score(lab: Path, tmp_path: Path) -> None:
    data, out = tmp_path / "data", tmp_path / "set"
    rehearsed = recollect(lab, "rehearse", "--headless", "--json", "--study", study(tmp_path), "--data", data)
    assert rehearsed.returncode == 0, rehearsed.stderr
    assert json.loads(rehearsed.stdout)["status"] == "completed"
    exported = recollect(lab, "export", "--out", out, "--data", data, "--with-rehearsals")
    assert exported.returncode == 0, exported.stderr
    (row,) = (row for row in rows(out, "answers") if row["kind"] == "ranking")
    order = row["value"].split(";")
    assert sorted(order) == ["alone", "person", "robot"]
    assert row["scored"] == str(order.index("robot") + 1)
    codebook = json.loads(next(out.glob("data/*answers_data.json")).read_text("utf-8"))
    assert '"ranking"' in json.dumps(codebook)


def test_the_check_lists_it_with_its_package_and_version(lab: Path, tmp_path: Path) -> None:
    checked = recollect(lab, "check", "--json", "--data", tmp_path / "data")
    (found,) = (each for each in json.loads(checked.stdout)["findings"] if each["what"] == "kind of item ranking")
    assert (found["state"], found["words"]) == ("good", "recollect-ranking 1.0")


def test_a_table_of_items_can_have_it_with_its_own_column(lab: Path, tmp_path: Path) -> None:
    table = tmp_path / "items.csv"
    table.write_text(
        'id,kind,text_en,options_en,counted\nH1,ranking,Who first?,"robot=a robot;person=a person",robot\n', "utf-8"
    )
    arguments = ("--id", "helpers", "--version", "1", "--note", "ours", "--out", tmp_path / "helpers.toml")
    brought_in = recollect(lab, "study", "import", table, *arguments)
    assert brought_in.returncode == 0, brought_in.stderr
    assert 'counted = "robot"' in (tmp_path / "helpers.toml").read_text("utf-8")


def test_what_is_wrong_with_such_an_item_is_told_like_anything_else(lab: Path, tmp_path: Path) -> None:
    refused = recollect(lab, "study", "check", study(tmp_path, QUESTIONS.replace('"robot"\n', '"dog"\n')))
    (sentence,) = refused.stderr.splitlines()
    assert (refused.returncode, "there is no option 'dog' that could be counted" in sentence) == (2, True)


def test_without_the_package_the_kind_is_unknown(tmp_path: Path) -> None:
    refused = recollect(tmp_path / "nothing", "study", "check", study(tmp_path))
    assert refused.returncode == 2
    assert "kind must be one of" in refused.stderr
    assert "it is 'ranking'" in refused.stderr


CLASS = "from kiosk.experiment.items import Question\nfrom typing import Literal\nclass Ranking(Question):\n"
BROKEN = {
    "fault while it is imported": ("1 / 0\n", "ZeroDivisionError: division by zero"),
    "no item": ("Ranking = 7\n", "is no class derived from kiosk.experiment.items.Question"),
    "another kind": (f"{CLASS}    kind: Literal['other']\n", "must have the field kind: Literal['ranking']"),
    "nothing to draw": (f"{CLASS}    kind: Literal['ranking']\n", "must have qml, the path of a QML file"),
}


@pytest.mark.parametrize(("code", "why"), BROKEN.values(), ids=BROKEN)
def test_a_broken_kind_gets_a_sentence_where_it_is_used_and_nowhere_else(tmp_path: Path, code: str, why: str) -> None:
    lab = tmp_path / "packages"
    register(lab, "a-lab", "recollect.items", {"ranking": "a_lab:Ranking"}, a_lab=code)
    refused = recollect(lab, "study", "check", study(tmp_path))
    (sentence,) = refused.stderr.splitlines()
    assert refused.returncode == 2
    assert "the kind of item 'ranking' of the package a-lab 0.1 cannot be used: " in sentence
    assert why in sentence
    (tmp_path / "other.toml").write_text('languages = ["en"]\n', "utf-8")
    assert recollect(lab, "study", "check", tmp_path / "other.toml").returncode == 0


def test_the_page_shows_the_package_that_is_installed_here() -> None:
    page = EXTEND.read_text("utf-8")
    for file in FILES:
        assert (PLUGINS / "ranking" / file).read_text("utf-8") in page, file
