"""A questionnaire is data, and a file that is not one is refused in words."""

from __future__ import annotations

from pathlib import Path

import pytest
from pydantic import ValidationError

from kiosk import BadInput
from kiosk.settings import ASSETS
from kiosk.study.declared.questionnaire import Item, Questionnaire

FINE = 'id = "q"\nversion = "2"\n[[items]]\nid = "one"\npoints = 5\n[[items]]\nid = "two"\npoints = 7\n'


def written(folder: Path, content: str | bytes) -> Path:
    """A questionnaire file of this content."""
    file = folder / "q.toml"
    file.write_bytes(content if isinstance(content, bytes) else content.encode())
    return file


def refusal(file: Path) -> str:
    """The sentence with which a file is refused."""
    with pytest.raises(BadInput) as refused:
        Questionnaire.read(file)
    assert str(file) in str(refused.value)
    return str(refused.value)


def test_a_questionnaire_holds_its_items_in_order(tmp_path: Path) -> None:
    questionnaire = Questionnaire.read(written(tmp_path, FINE))
    assert questionnaire == Questionnaire(
        id="q", version="2", items=(Item(id="one", points=5), Item(id="two", points=7))
    )


@pytest.mark.parametrize("file", sorted((ASSETS / "questionnaires").glob("*.toml")), ids=lambda file: str(file.stem))
def test_every_questionnaire_that_is_shipped_can_be_used(file: Path) -> None:
    questionnaire = Questionnaire.read(file)
    assert questionnaire.id == file.stem
    assert len({item.id for item in questionnaire.items}) == len(questionnaire.items)


def test_a_questionnaire_cannot_be_changed(tmp_path: Path) -> None:
    questionnaire = Questionnaire.read(written(tmp_path, FINE))
    with pytest.raises(ValidationError, match="frozen"):
        questionnaire.items[0].points = 3


def test_a_file_that_is_not_there_is_refused(tmp_path: Path) -> None:
    assert "cannot be read: " in refusal(tmp_path / "none.toml")


@pytest.mark.parametrize("content", ["id =", "[[items]", b"id = '\xff'"])
def test_a_file_that_is_not_toml_is_refused(tmp_path: Path, content: str | bytes) -> None:
    assert "is not TOML" in refusal(written(tmp_path, content))


@pytest.mark.parametrize(
    ("content", "where"),
    [
        ('id = "q"\nversion = "1"\n', "items: Field required"),
        ('id = "q"\nversion = "1"\nitems = []\n', "items: Tuple should have at least 1 item"),
        (FINE.replace('version = "2"', "version = 2"), "version: Input should be a valid string"),
        (FINE.replace("points = 7", "points = 1"), "items.1.points: Input should be greater than or equal to 2"),
        (FINE.replace("points = 7", "points = 12"), "items.1.points: Input should be less than or equal to 11"),
        (FINE + "scale = 3\n", "items.1.scale: Extra inputs are not permitted"),
        ('title = "Q"\n' + FINE, "title: Extra inputs are not permitted"),
        (FINE.replace('id = "two"', 'id = "one"'), "the item 'one' stands twice"),
    ],
)
def test_what_is_wrong_is_named(tmp_path: Path, content: str, where: str) -> None:
    assert where in refusal(written(tmp_path, content))
