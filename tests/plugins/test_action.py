"""An action of another package: learnt with, taken in a session, recorded, exported and explained."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import pytest

from kiosk.assistance.policy import load_action
from kiosk.extensions import ExtensionGroup, find
from tests.plugins.conftest import Beside, Day, Lab, Register, assert_refused

FILES = ("pyproject.toml", "recollect_encourage/__init__.py", "recollect_encourage/sentences/en.ftl")
SENTENCES = ("You are doing well, go on.", "Take your time, you can do it.", "Every card you see helps you later.")


@pytest.fixture
def study(day: Day, tmp_path: Path) -> Path:
    """Return a study file whose policy has the action, and that needs nothing else of another package."""
    shutil.copy(day.study.with_name("enc.json"), tmp_path)
    file = tmp_path / "study.toml"
    file.write_text('languages = ["en"]\n[assistance]\npolicy = "enc.json"\n', "utf-8")
    return file


def test_the_policy_file_names_its_actions_and_how_it_is_made_again(day: Day) -> None:
    document = json.loads(day.study.with_name("enc.json").read_text("utf-8"))
    assert document["actions"] == ["no_help", "sug_col", "sug_row", "sug_card", "encourage"]
    assert len(document["values"]) == 3 * 5 * 4
    assert "--action encourage" in document["training"]["command"]


def test_a_session_with_it_is_recorded_exported_and_explained(lab: Lab, day: Day) -> None:
    assert day.played["status"] == "completed"
    taken = [row for row in day.rows("decisions") if row["action"] == "encourage"]
    assert taken
    assert not [row for row in day.rows("hints") if row["action"] == "encourage"]
    said = [row["sentence"] for row in day.rows("sentences") if row["sentence"] in SENTENCES]
    assert len(said) == len(taken)
    assert all(one != other for one, other in pairwise(said))
    explanation = lab.json("explain", 1, "--flip", taken[0]["flip"], "--data", day.data)
    assert (explanation["action"], explanation["target"]) == ("encourage", None)
    assert explanation["said"] in SENTENCES
    assert set(explanation["sentences"]) == set(SENTENCES)
    assert list(explanation["q"])[-1] == "encourage"


def test_the_check_lists_it_with_its_package_and_version(added: dict[str, tuple[str, str]]) -> None:
    assert added["action encourage"] == ("ok", "recollect-encourage 1.0")


def test_a_language_that_it_has_no_sentences_in_is_refused(
    lab: Lab, study: Path, beside: Beside, refusal: Callable[[Path], str]
) -> None:
    beside(lab.site)
    study.write_text(study.read_text("utf-8").replace('["en"]', '["en", "es"]'), "utf-8")
    assert "the action 'encourage' lacks encourage in 'es'" in refusal(study)


def test_without_the_package_the_table_is_refused_in_one_sentence(study: Path, refusal: Callable[[Path], str]) -> None:
    assert "there is no action 'encourage'" in refusal(study)


IMPORTED = "from kiosk.assistance.policy import ActionSpec\n"
BROKEN = {
    "fault while it is imported": ("1 / 0\n", "ZeroDivisionError: division by zero"),
    "no action": ("ENCOURAGE = 7\n", "is no kiosk.assistance.policy.ActionSpec"),
    "another name": (f"{IMPORTED}ENCOURAGE = ActionSpec('cheer', message='cheer')\n", "its name must be 'encourage'"),
    "a cost below nothing": (
        f"{IMPORTED}ENCOURAGE = ActionSpec('encourage', message='m', cost=-1)\n",
        "encourage: its cost must be from 0 to 1, not -1",
    ),
}


@pytest.mark.parametrize(("code", "why"), BROKEN.values(), ids=BROKEN)
def test_it_is_said_what_is_wrong_with_a_broken_one(beside: Beside, register: Register, code: str, why: str) -> None:
    beside(register("a-lab", "recollect.actions", {"encourage": "a_lab:ENCOURAGE"}, a_lab=code))
    assert_refused(lambda: load_action(find(ExtensionGroup.ACTIONS, "encourage")), "the action 'encourage'", why)


def test_a_study_with_a_broken_one_is_refused_without_a_traceback(
    study: Path, beside: Beside, register: Register, refusal: Callable[[Path], str]
) -> None:
    beside(register("a-lab", "recollect.actions", {"encourage": "a_lab:ENCOURAGE"}, a_lab="1 / 0\n"))
    assert "the action 'encourage' of the package a-lab 0.1 cannot be used: ZeroDivisionError" in refusal(study)


@pytest.mark.parametrize("file", FILES)
def test_the_page_shows_the_package_that_is_installed_here(documented: Callable[[str, str], bool], file: str) -> None:
    assert documented("encourage", file)
