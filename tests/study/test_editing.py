"""A text of a study is found by what the screen shows, and changed in its file with all else kept."""

from __future__ import annotations

from pathlib import Path

import pytest

from kiosk import UserInputError
from kiosk.config import ASSETS, Settings
from kiosk.study.editing import TextPlace, change_text, find_text, text_places
from kiosk.study.loader import read_study

STUDY = """# Our study
title = "Ours"  # a title
languages = ["en"]
consent.text = "./sheets"
questionnaires = ["./after.toml"]

[texts.en]
# Shorter than the usual one.
about-continue = "Carry on"
"""
QUESTIONS = """# Asked after the game
id = "after"
version = "1"
note = "Ours."

[[items]]
kind = "text"
id = "best"
text.en = "What was best?"  # Keep it short
"""


@pytest.fixture
def study(tmp_path: Path) -> Path:
    """Return a study file with a sheet and a questionnaire of its own."""
    sheets = tmp_path / "sheets"
    sheets.mkdir()
    (sheets / "en.toml").write_bytes(b"# For the board\n" + (ASSETS / "consent/study/en.toml").read_bytes())
    (tmp_path / "after.toml").write_text(QUESTIONS)
    file = tmp_path / "study.toml"
    file.write_text(STUDY)
    return file


def placed(study: Path, shown: str) -> tuple[Settings, TextPlace]:
    settings = Settings.read(study)
    (plan,) = read_study(settings).plans
    place = find_text(text_places(plan), shown)
    assert place is not None
    return settings, place


def test_an_item_is_changed_and_its_comments_stay(study: Path) -> None:
    settings, place = placed(study, "What was best?")
    assert (place.file.name, place.key) == ("after.toml", "items.best.text")
    written, read = change_text(settings, study, place, "What did you like?")
    assert written.read_text() == QUESTIONS.replace("What was best?", "What did you like?")
    assert read.plans[0].questionnaires[0].items[0].text["en"] == "What did you like?"


def test_a_consent_is_changed_in_its_own_line_only(study: Path) -> None:
    sheet = study.parent / "sheets/en.toml"
    before = sheet.read_text()
    title = read_study(Settings.read(study)).plans[0].information.debrief.title
    settings, place = placed(study, title)
    change_text(settings, study, place, "What it was about")
    old, new = before.splitlines(), sheet.read_text().splitlines()
    assert [line for line, other in zip(new, old, strict=True) if line != other] == ['title = "What it was about"']


def test_a_text_of_the_study_file_is_changed_there(study: Path) -> None:
    settings, place = placed(study, "Carry on")
    assert (place.file, place.key) == (study, "about-continue")
    change_text(settings, study, place, "Next")
    assert study.read_text() == STUDY.replace('"Carry on"', '"Next"')


def test_a_shipped_text_goes_into_the_study_file_instead(study: Path) -> None:
    shipped = {file: file.read_bytes() for file in (ASSETS / "sentences/en").iterdir()}
    said = read_study(Settings.read(study)).plans[0].catalogue.text("stop-title")
    settings, place = placed(study, said)
    written, read = change_text(settings, study, place, "Leave now")
    assert written == study
    assert study.read_text().startswith(STUDY)
    assert read.plans[0].catalogue.text(place.key) == "Leave now"
    assert {file: file.read_bytes() for file in shipped} == shipped


def test_a_text_that_breaks_the_study_is_not_written(study: Path) -> None:
    settings, place = placed(study, "Carry on")
    with pytest.raises(UserInputError, match="about-continue"):
        change_text(settings, study, place, "Go { $nowhere }")
    assert study.read_text() == STUDY
    assert sorted(file.name for file in study.parent.iterdir()) == ["after.toml", "sheets", "study.toml"]


def test_a_shipped_questionnaire_is_never_written(study: Path) -> None:
    study.write_text(STUDY.replace("./after.toml", "trust"))
    item = read_study(Settings.read(study)).plans[0].questionnaires[0].items[-1].text["en"]
    settings, place = placed(study, item)
    with pytest.raises(UserInputError, match="comes with Recollect"):
        change_text(settings, study, place, "Another")


def test_a_file_outside_the_folder_is_never_written(study: Path) -> None:
    inside = study.parent / "inner"
    inside.mkdir()
    moved = inside / "study.toml"
    moved.write_text(STUDY.replace("./", "../"))
    settings, place = placed(moved, "What was best?")
    with pytest.raises(UserInputError, match="outside"):
        change_text(settings, moved, place, "Another")
    assert (study.parent / "after.toml").read_text() == QUESTIONS


def test_a_message_in_a_file_of_its_own_keeps_its_comments_and_neighbours(study: Path) -> None:
    own = study.parent / "words.ftl"
    text = "# First\nabout-continue = Carry on\n\n# Last, on two lines\nstop-title =\n    Leave\n    here\n"
    own.write_bytes(b"\xef\xbb\xbf" + text.replace("\n", "\r\n").encode())
    study.write_text(STUDY.partition("[texts.en]")[0] + '[texts]\nen = "./words.ftl"\n')
    settings, place = placed(study, "Leave here")
    change_text(settings, study, place, "Leave now")
    expected = text.replace("Leave\n    here", "Leave now").replace("\n", "\r\n")
    assert own.read_bytes() == b"\xef\xbb\xbf" + expected.encode()
    settings, place = placed(study, "Carry on")
    with pytest.raises(UserInputError, match="not well-formed"):
        change_text(settings, study, place, "Go { on\nstop-title = No")
    assert own.read_bytes() == b"\xef\xbb\xbf" + expected.encode()
