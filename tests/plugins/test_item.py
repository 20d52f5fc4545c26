"""A kind of item that another package brings: asked, answered on the screen, scored and exported."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from kiosk.experiment.questionnaire import load_item
from kiosk.extensions import ExtensionGroup, find
from tests.plugins.conftest import QUESTIONS, Beside, Day, Lab, Register, assert_refused

FILES = ("pyproject.toml", "recollect_ranking/__init__.py", "recollect_ranking/Ranking.qml")


def study(folder: Path, questions: str = QUESTIONS) -> Path:
    """Return a study file whose questionnaire after the game has an item of the kind."""
    (folder / "helpers.toml").write_text(questions, "utf-8")
    file = folder / "study.toml"
    file.write_text('languages = ["en"]\nquestionnaires = ["helpers.toml"]\n', "utf-8")
    return file


def test_a_session_asks_it_and_the_data_have_the_answer_and_its_score(day: Day) -> None:
    assert day.played["status"] == "completed"
    (row,) = (row for row in day.rows("answers") if row["kind"] == "ranking")
    order = row["value"].split(";")
    assert sorted(order) == ["alone", "person", "robot"]
    assert row["scored"] == str(order.index("robot") + 1)
    assert '"ranking"' in day.codebook("answers")


def test_the_check_lists_it_with_its_package_and_version(added: dict[str, tuple[str, str]]) -> None:
    assert added["kind of item ranking"] == ("ok", "recollect-ranking 1.0")


def test_a_table_of_items_can_have_it_with_its_own_column(lab: Lab, tmp_path: Path) -> None:
    table = tmp_path / "items.csv"
    table.write_text(
        'id,kind,text_en,options_en,counted\nH1,ranking,Who first?,"robot=a robot;person=a person",robot\n', "utf-8"
    )
    arguments = ("--id", "helpers", "--version", "1", "--note", "ours", "--out", tmp_path / "helpers.toml")
    brought_in = lab.recollect("study", "import", table, *arguments)
    assert brought_in.returncode == 0, brought_in.stderr
    assert 'counted = "robot"' in (tmp_path / "helpers.toml").read_text("utf-8")


def test_what_is_wrong_with_such_an_item_is_told_like_anything_else(lab: Lab, tmp_path: Path) -> None:
    refused = lab.recollect("study", "check", study(tmp_path, QUESTIONS.replace('"robot"\n', '"dog"\n')))
    (sentence,) = refused.stderr.splitlines()
    assert (refused.returncode, "there is no option 'dog' that could be counted" in sentence) == (2, True)


def test_without_the_package_the_kind_is_unknown(tmp_path: Path, refusal: Callable[[Path], str]) -> None:
    sentence = refusal(study(tmp_path))
    assert "kind must be one of" in sentence
    assert "it is 'ranking'" in sentence


CLASS = "from kiosk.experiment.items import Question\nfrom typing import Literal\nclass Ranking(Question):\n"
BROKEN = {
    "fault while it is imported": ("1 / 0\n", "ZeroDivisionError: division by zero"),
    "no item": ("Ranking = 7\n", "is no class derived from kiosk.experiment.items.Question"),
    "another kind": (f"{CLASS}    kind: Literal['other']\n", "must have the field kind: Literal['ranking']"),
    "nothing to draw": (f"{CLASS}    kind: Literal['ranking']\n", "must have qml, the path of a QML file"),
}


@pytest.mark.parametrize(("code", "why"), BROKEN.values(), ids=BROKEN)
def test_it_is_said_what_is_wrong_with_a_broken_one(beside: Beside, register: Register, code: str, why: str) -> None:
    beside(register("a-lab", "recollect.items", {"ranking": "a_lab:Ranking"}, a_lab=code))
    assert_refused(lambda: load_item(find(ExtensionGroup.ITEMS, "ranking")), "the kind of item 'ranking'", why)


def test_a_broken_kind_gets_a_sentence_where_it_is_used_and_nowhere_else(
    lab: Lab, register: Register, tmp_path: Path
) -> None:
    packages = register("a-lab", "recollect.items", {"sorting": "a_lab:Sorting"}, a_lab="1 / 0\n")
    refused = lab.recollect(
        "study", "check", study(tmp_path, QUESTIONS.replace('"ranking"', '"sorting"')), more=packages
    )
    (sentence,) = refused.stderr.splitlines()
    assert refused.returncode == 2
    assert "the kind of item 'sorting' of the package a-lab 0.1 cannot be used: ZeroDivisionError" in sentence
    (tmp_path / "other.toml").write_text('languages = ["en"]\n', "utf-8")
    assert lab.recollect("study", "check", tmp_path / "other.toml", more=packages).returncode == 0


@pytest.mark.parametrize("file", FILES)
def test_the_page_shows_the_package_that_is_installed_here(documented: Callable[[str, str], bool], file: str) -> None:
    assert documented("ranking", file)
