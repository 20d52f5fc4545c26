"""What the page on making a study one's own shows can be used as it stands there."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest

from kiosk.config import Settings
from kiosk.experiment.information import Page
from kiosk.experiment.questionnaire import ITEM_KINDS, Questionnaire
from kiosk.study.csv_import import PLAIN, WORDED, Heading, read_items

ELSEWHERE = ("[[items]]", "[project]", "signs =", "[[consent.purposes]]")
"""What tells the blocks of other files: questionnaires, packages and information sheets."""

BEYOND = Path(__file__).parents[2] / "docs" / "how-to" / "beyond.md"
PAGE = (Path(__file__).parents[2] / "docs" / "how-to" / "extend.md").read_text("utf-8")


def shown(language: str) -> list[str]:
    """Return the blocks of code in a language."""
    return re.findall(rf"```{language}\n(.*?)```", PAGE, re.DOTALL)


def test_the_questionnaire_can_be_used() -> None:
    text, _example_of_a_package = (block for block in shown("toml") if "[[items]]" in block)
    read = Questionnaire.model_validate(tomllib.loads(text))
    assert [item.id for item in read.scales["LOAD"]] == ["W1", "W2"]
    assert (read.unworded("en"), read.unworded("it")) == ((), ())


@pytest.mark.parametrize("text", [block for block in shown("toml") if not any(part in block for part in ELSEWHERE)])
def test_the_parts_of_a_study_file_can_be_used(text: str) -> None:
    Settings.model_validate(tomllib.loads(text))


def test_the_study_that_goes_beyond_the_paper_can_be_used() -> None:
    (text,) = re.findall(r"```toml\n(.*?)```", BEYOND.read_text("utf-8"), re.DOTALL)
    settings = Settings.model_validate(tomllib.loads(text))
    assert settings.condition("look").gaze_only
    assert settings.condition("praised").comments
    assert settings.condition("remind").reminds
    assert settings.assistance.models_memory


def test_the_points_of_an_information_sheet_can_be_used() -> None:
    (text,) = (tomllib.loads(block) for block in shown("toml") if "signs =" in block)
    page = Page.model_validate({"title": "Taking part", "paragraphs": ["All of it."], **text["consent"]})
    assert len(page.points) == len(page.signs)


def test_the_table_can_be_brought_in(tmp_path: Path) -> None:
    (table,) = shown("csv")
    (tmp_path / "items.csv").write_text(table, "utf-8")
    read = read_items(tmp_path / "items.csv", Heading("workload", "1", "ours"))
    assert [item.kind for item in read.items] == ["likert", "likert", "single"]
    assert (read.unworded("en"), read.unworded("it")) == ((), ())


def test_every_kind_and_every_column_is_told() -> None:
    named = {name for row in re.findall(r"^\| (`.*?) \|", PAGE, re.MULTILINE) for name in re.findall(r"`(\w+)`", row)}
    assert set(ITEM_KINDS) - named == set()
    assert {*PLAIN, *(f"{stem}_en" for stem in WORDED)} - named == set()


@pytest.mark.parametrize("kind", ITEM_KINDS)
def test_every_key_of_a_kind_is_told(kind: str) -> None:
    (row,) = re.findall(rf"^\| `{kind}` \|.*$", PAGE, re.MULTILINE)
    of_all = {"id", "kind", "text", "relevant", "visits", "required", "not_applicable", "scale"}
    assert set(ITEM_KINDS[kind].model_fields) - of_all - set(re.findall(r"`(\w+)`", row)) == set()
