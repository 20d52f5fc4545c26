"""Any single message can be replaced in the study file, without copying a language."""

from __future__ import annotations

from pathlib import Path

import pytest

from kiosk import UserInputError
from kiosk.config import Settings
from kiosk.experiment.session_config import SessionConfig
from kiosk.study.loader import read_study
from tests.samples import ENGLISH, ITALIAN


def read(folder: Path, text: str) -> tuple[SessionConfig, ...]:
    """Return the plans of a study file."""
    (folder / "study.toml").write_text(text, "utf-8")
    return read_study(Settings.read(folder / "study.toml")).plans


def test_a_label_is_replaced_and_all_others_stay(tmp_path: Path) -> None:
    english, italian = read(
        tmp_path, 'languages = ["en", "it"]\n[texts.en]\nabout-continue = "Go on"\ngame-pairs = "{ $found }!"\n'
    )
    assert english.catalogue.text("about-continue") == "Go on"
    assert english.catalogue.text("game-pairs", found=3, all=12) == "3!"
    assert english.catalogue.text("form-next") == ENGLISH.text("form-next")
    assert italian.catalogue.text("about-continue") == ITALIAN.text("about-continue")
    assert english.catalogue.messages == ENGLISH.messages


def test_a_sentence_with_several_wordings_is_replaced_by_a_table(tmp_path: Path) -> None:
    (plan,) = read(
        tmp_path, 'languages = ["en"]\n[texts.en.point-first-row]\na = "Row { $row }."\nb = "Try { $row }."\n'
    )
    assert plan.catalogue.wordings("point-first-row", row=2) == ("Row 2.", "Try 2.")


def test_a_file_replaces_many(tmp_path: Path) -> None:
    (tmp_path / "texts").mkdir()
    (tmp_path / "texts" / "en.ftl").write_text("about-continue = Go on\n", "utf-8")
    (plan,) = read(tmp_path, 'languages = ["en"]\n[texts]\nen = "texts/en.ftl"\n')
    assert plan.catalogue.text("about-continue") == "Go on"


@pytest.mark.parametrize(
    ("table", "line", "why"),
    [
        (
            'form-next = "On"\nabout-contineu = "On"',
            5,
            "no message 'about-contineu' to replace; did you mean 'ab",
        ),
        ('game-pairs = "{ $gefunden }"', 4, "asks for the variable $gefunden; it is given $all, $found"),
        ('form-next = "On"\n\npoint-first-row = "Row"', 6, "the message point-first-row must have wordings"),
        ('about-continue = "{ "', 4, "is not well-formed near: about-continue = {"),
        ('about-continue = ""', 4, "is not well-formed near: about-continue ="),
        ('"no name" = "words"', 4, "is not well-formed near: no name = words"),
    ],
)
def test_a_replacement_that_cannot_be_said_is_refused_with_file_and_line(
    table: str, line: int, why: str, tmp_path: Path
) -> None:
    with pytest.raises(UserInputError) as refused:
        read(tmp_path, f'languages = ["en"]\n# own words\n[texts.en]\n{table}\n')
    assert f"{tmp_path / 'study.toml'}, line {line}" in str(refused.value)
    assert why in str(refused.value)


@pytest.mark.parametrize(
    ("texts", "why"),
    [
        ("[texts.de]\nabout-continue = 'Weiter'", "texts: 'de' is none of the languages"),
        ("[texts]\nen = 'none.ftl'", "none.ftl cannot be read: No such file"),
        ("[texts.en]\nabout-continue = 7", "texts.en"),
    ],
)
def test_replacements_of_nothing_are_refused(texts: str, why: str, tmp_path: Path) -> None:
    with pytest.raises(UserInputError) as refused:
        read(tmp_path, f'languages = ["en"]\n{texts}\n')
    assert why in str(refused.value)
