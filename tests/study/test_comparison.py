"""What differs between two studies is said, with what it does to the data."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from kiosk.config import ASSETS, Settings
from kiosk.experiment.session_config import StudyConfig
from kiosk.study.comparison import Difference, Impact, compare
from kiosk.study.loader import read_study

FORM = """
id = "form"
version = "1"
note = "made for tests"
title.en = "How far do you agree?"

[[items]]
id = "liked"
kind = "likert"
scale = "joy"
points = 5
text.en = "I liked it."
lowest.en = "no"
highest.en = "yes"

[[items]]
id = "who"
kind = "single"
text.en = "Who are you?"
options = [{ id = "pupil", text.en = "A pupil" }, { id = "teacher", text.en = "A teacher" }]
"""
STUDY = """
title = "A study"
languages = ["./en"]
questionnaires = ["./form.toml"]
[consent]
text = "./sheets"
[game]
rows = 2
"""

Edit = tuple[str, str, str]


@pytest.fixture(scope="module")
def original(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("studies") / "original"
    folder.mkdir()
    (folder / "form.toml").write_text(FORM, "utf-8")
    (folder / "study.toml").write_text(STUDY, "utf-8")
    shutil.copytree(ASSETS / "sentences" / "en", folder / "en")
    (folder / "sheets").mkdir()
    shutil.copy(ASSETS / "consent" / "study" / "en.toml", folder / "sheets")
    return folder


def read(folder: Path) -> StudyConfig:
    return read_study(Settings.read(folder / "study.toml"))


@pytest.fixture(scope="module")
def unchanged(original: Path) -> StudyConfig:
    return read(original)


@pytest.fixture
def changed(original: Path, unchanged: StudyConfig, tmp_path: Path) -> Callable[..., list[Difference]]:
    """Return what differs once these texts of the study's files have become others."""

    def change(*edits: Edit) -> list[Difference]:
        shutil.copytree(original, tmp_path / "changed")
        for name, old, new in edits:
            file = tmp_path / "changed" / name
            text = file.read_text("utf-8")
            assert old in text
            file.write_text(text.replace(old, new), "utf-8")
        return compare(unchanged, read(tmp_path / "changed"))

    return change


CASES: dict[str, tuple[Edit, str, str, Impact]] = {
    "the title": (("study.toml", '"A study"', '"Another"'), "title", "becomes", Impact.NONE),
    "the experimenter's screen": (
        ("study.toml", "[consent]", "[screen]\noperator_display = 1\n[consent]"),
        *("screen.operator_display", "becomes", Impact.NONE),
    ),
    "a comment": (("form.toml", "[[items]]", "[[items]] # a comment"), "", "", Impact.NONE),
    "the PIN": (
        ("study.toml", "[consent]", f'[experimenter]\npin_hash = "scrypt:10:{"0" * 32}:{"0" * 64}"\n[consent]'),
        *("", "", Impact.NONE),
    ),
    "the points of a scale": (
        ("form.toml", "points = 5", "points = 7"),
        *("item liked", "1 to 5, becomes likert, 1 to 7", Impact.DATA),
    ),
    "a reversed item": (
        ("form.toml", 'scale = "joy"', 'scale = "joy"\nreverse = true'),
        *("item liked", "turned round", Impact.DATA),
    ),
    "the scale of an item": (
        ("form.toml", 'scale = "joy"', 'scale = "fun"'),
        *("item liked", 'scale: "joy" becomes "fun"', Impact.DATA),
    ),
    "an option": (("form.toml", '"teacher", text', '"tutor", text'), "item who", "teacher are gone", Impact.DATA),
    "an item": (("form.toml", '"who"', '"status"'), "item who", "is gone", Impact.DATA),
    "a wording": (
        ("form.toml", "I liked it.", "I loved it."),
        *("item liked", 'en: "I liked it." becomes "I loved it."', Impact.BEHAVIOUR),
    ),
    "a title": (
        ("form.toml", 'title.en = "How far', 'title.en = "Do you agree, and how far'),
        *("questionnaire form", "title, en: ", Impact.BEHAVIOUR),
    ),
    "an answer that is asked for": (
        ("form.toml", 'id = "liked"', 'id = "liked"\nrequired = true'),
        *("item liked", "required: false becomes true", Impact.BEHAVIOUR),
    ),
    "the board": (("study.toml", "rows = 2", "rows = 4"), "game.rows", "2 becomes 4", Impact.DATA),
    "a time": (
        ("study.toml", "[consent]", "[timing]\nmood_ms = 9\n[consent]"),
        *("timing.mood_ms", "9", Impact.BEHAVIOUR),
    ),
    "the deck": (
        ("study.toml", "rows = 2", 'rows = 2\ndeck = "fruit"\n[practice]\ndeck = "animals"'),
        *("deck", "with apple", Impact.DATA),
    ),
    "a policy": (
        ("study.toml", "[consent]", '[assistance]\npolicy = "no-help"\n[consent]'),
        *("policy", "another one", Impact.DATA),
    ),
    "a sentence": (
        ("en/screens.ftl", "consent-required = ", "consent-required = Well, "),
        "language en",
        "1",
        Impact.BEHAVIOUR,
    ),
    "a comment of a sentence": (
        ("en/screens.ftl", "consent-required = ", "# Said once.\nconsent-required = "),
        "",
        "",
        Impact.NONE,
    ),
    "the sheet": (
        ("sheets/en.toml", 'version = "2"', 'version = "3"'),
        *("information sheet en", "version 2 becomes 3", Impact.DATA),
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_a_difference_is_said_with_what_it_does_to_the_data(
    case: str, changed: Callable[..., list[Difference]]
) -> None:
    edit, where, what, impact = CASES[case]
    found = changed(edit)
    if not where:
        assert found == []
        return
    assert any(where in each.where and what in each.what and each.impact is impact for each in found), found


def test_the_same_study_does_not_differ(original: Path) -> None:
    assert compare(read(original), read(original)) == []


def test_what_changes_the_data_is_said_first_and_a_version_that_stays_is_noted(
    changed: Callable[..., list[Difference]],
) -> None:
    found = changed(("form.toml", "points = 5", "points = 7"), ("form.toml", "I liked it.", "I loved it."))
    assert [each.impact for each in found] == [Impact.DATA, Impact.BEHAVIOUR, Impact.NONE]
    assert found[-1].what == "the version stays '1'"
