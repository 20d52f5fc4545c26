"""The keys on the screen: the check names letters of a study's languages that have no key."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from kiosk.assistance.wording import Catalogue
from kiosk.config import ASSETS, Settings
from kiosk.experiment.items import ShortText
from kiosk.experiment.questionnaire import Questionnaire
from kiosk.experiment.session_config import StudyConfig
from kiosk.study.checks import study_warnings
from kiosk.study.loader import read_study


def asking(tmp_path: Path, language: str, words: str, rows: str = "", **screen: Any) -> StudyConfig:
    """Return a study with one typed question, which is worded in a language that has these rows of keys."""
    study = read_study(Settings.model_validate({"languages": ["en"], "screen": screen}))
    (plan,) = study.plans
    folder = tmp_path / language
    folder.mkdir()
    (folder / "own.ftl").write_text(f"keyboard-rows = {rows}\n" if rows else "language-name = own\n", "utf-8")
    item = ShortText(id="said", kind="text", text={language: words})
    asked = Questionnaire(id="asked", version="1", note="made for tests", items=(item,))
    return replace(study, plans=(replace(plan, catalogue=Catalogue(folder), questionnaires=(asked,)),))


def lacking(study: StudyConfig) -> list[str]:
    """Return the cautions about keys."""
    return [each for each in study_warnings(study) if each.startswith("the keys on the screen")]


@pytest.mark.parametrize(
    ("language", "words"),
    [
        ("de", "Straße, Größe"),
        ("da", "Ærø, Ålborg"),
        ("el", "Αθήνα"),
        ("uk", "Київ, їжак"),
        ("ar", "لماذا"),
        ("en", "Why?"),
    ],
)
def test_languages_with_rows_of_their_own_lack_nothing(tmp_path: Path, language: str, words: str) -> None:
    assert lacking(asking(tmp_path, language, words)) == []


def test_the_letters_of_a_language_without_rows_are_named(tmp_path: Path) -> None:
    (caution,) = lacking(asking(tmp_path, "ka", "რატომ"))
    assert "'ka'" in caution
    assert all(letter in caution for letter in "რატომ")
    assert "keyboard-rows" in caution


def test_a_long_alphabet_is_told_in_part(tmp_path: Path) -> None:
    (caution,) = lacking(asking(tmp_path, "zh", "".join(chr(0x4E00 + number) for number in range(60))))
    assert "and 40 more" in caution


def test_rows_of_its_own_mend_it(tmp_path: Path) -> None:
    assert lacking(asking(tmp_path, "ka", "რატომ", rows="რატომ")) == []


def test_nothing_is_said_where_nothing_is_typed(tmp_path: Path) -> None:
    study = asking(tmp_path, "ka", "რატომ")
    (plan,) = study.plans
    closed = Questionnaire.read(ASSETS / "questionnaires" / "trust.toml")
    assert lacking(replace(study, plans=(replace(plan, questionnaires=(closed,)),))) == []


def test_nothing_is_said_where_the_keys_never_come(tmp_path: Path) -> None:
    assert lacking(asking(tmp_path, "ka", "რატომ", keyboard="never")) == []
