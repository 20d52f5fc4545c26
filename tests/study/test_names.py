"""Names that are one for readers are found in decks, too, where they are those of files."""

from __future__ import annotations

import pytest

from kiosk.config import ASSETS
from kiosk.experiment.questionnaire import Questionnaire
from kiosk.study.names import ONE_NAME, unclear_cards, unclear_names


@pytest.mark.parametrize(
    ("one", "other"), [("cat", "Cat"), ("caf\u00e9", "cafe\u0301"), ("cat", "cat."), ("a-b", "a_b")]
)
def test_cards_of_one_name_are_told_together(one: str, other: str) -> None:
    assert list(unclear_cards([one, "dog", other])) == [f"the cards {one!r} and {other!r} {ONE_NAME}"]


@pytest.mark.parametrize("folder", sorted(path.name for path in (ASSETS / "cards").iterdir() if path.is_dir()))
def test_the_shipped_decks_have_nothing_unclear(folder: str) -> None:
    assert list(unclear_cards(path.stem for path in (ASSETS / "cards" / folder).glob("*.svg"))) == []


def test_the_shipped_questionnaires_have_nothing_unclear() -> None:
    files = sorted((ASSETS / "questionnaires").glob("*.toml"))
    assert files
    assert list(unclear_names([(file, Questionnaire.read(file)) for file in files])) == []
