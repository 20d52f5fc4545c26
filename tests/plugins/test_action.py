"""An action of another package: learnt with, taken in a session, recorded, exported and explained."""

from __future__ import annotations

import csv
import json
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import pytest

from tests.plugins.installing import PLUGINS, install, recollect, register

EXTEND = PLUGINS.parents[1] / "docs" / "extend.md"
FILES = ("pyproject.toml", "recollect_encourage/__init__.py", "recollect_encourage/sentences/en.ftl")
SENTENCES = ("You are doing well, go on.", "Take your time, you can do it.", "Every card you see helps you later.")


@pytest.fixture(scope="module")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder in which the package is installed."""
    folder = tmp_path_factory.mktemp("encourage") / "packages"
    install("encourage", folder)
    return folder


@pytest.fixture(scope="module")
def study(lab: Path) -> Path:
    """A study whose table was trained with the action; after so few games it still takes it often."""
    folder = lab.parent
    trained = recollect(lab, "train", "--action", "encourage", "--episodes", 200, "--out", folder / "enc.json")
    assert trained.returncode == 0, trained.stderr
    file = folder / "study.toml"
    file.write_text('languages = ["en"]\n[assistance]\npolicy = "enc.json"\n', "utf-8")
    return file


def rows(folder: Path, table: str) -> Iterator[dict[str, str]]:
    """The rows of a table of a data set."""
    (file,) = folder.glob(f"data/*{table}_data.csv")
    with file.open(encoding="utf-8-sig", newline="") as open_file:
        yield from csv.DictReader(open_file)


def test_the_policy_file_names_its_actions_and_how_it_is_made_again(study: Path) -> None:
    document = json.loads((study.parent / "enc.json").read_text("utf-8"))
    assert document["actions"] == ["no_help", "sug_col", "sug_row", "sug_card", "encourage"]
    assert len(document["values"]) == 3 * 5 * 4
    assert "--action encourage" in document["training"]["command"]


def test_a_session_with_it_is_recorded_exported_and_explained(lab: Path, study: Path, tmp_path: Path) -> None:
    data, out = tmp_path / "data", tmp_path / "set"
    rehearsed = recollect(lab, "rehearse", "--headless", "--json", "--seed", 1, "--study", study, "--data", data)
    assert rehearsed.returncode == 0, rehearsed.stderr
    assert json.loads(rehearsed.stdout)["status"] == "completed"
    exported = recollect(lab, "export", "--out", out, "--data", data, "--with-rehearsals")
    assert exported.returncode == 0, exported.stderr
    taken = [row for row in rows(out, "decisions") if row["action"] == "encourage"]
    assert taken
    assert not [row for row in rows(out, "hints") if row["action"] == "encourage"]
    said = [row["sentence"] for row in rows(out, "sentences") if row["sentence"] in SENTENCES]
    assert len(said) == len(taken)
    assert all(one != other for one, other in pairwise(said))
    explained = recollect(lab, "explain", 1, "--flip", taken[0]["flip"], "--data", data, "--json")
    assert explained.returncode == 0, explained.stderr
    explanation = json.loads(explained.stdout)
    assert (explanation["action"], explanation["target"]) == ("encourage", None)
    assert explanation["said"] in SENTENCES
    assert set(explanation["sentences"]) == set(SENTENCES)
    assert list(explanation["q"])[-1] == "encourage"


def test_the_check_lists_it_with_its_package_and_version(lab: Path, study: Path, tmp_path: Path) -> None:
    checked = recollect(lab, "check", "--json", "--study", study, "--data", tmp_path / "data")
    (found,) = (each for each in json.loads(checked.stdout)["findings"] if each["what"] == "action encourage")
    assert (found["state"], found["words"]) == ("good", "recollect-encourage 1.0")


def test_a_language_that_it_has_no_sentences_in_is_refused(lab: Path, study: Path) -> None:
    other = study.with_name("spanish.toml")
    other.write_text(study.read_text("utf-8").replace('["en"]', '["en", "es"]'), "utf-8")
    refused = recollect(lab, "study", "check", other)
    (sentence,) = refused.stderr.splitlines()
    assert (refused.returncode, "the action 'encourage' lacks encourage in 'es'" in sentence) == (2, True)


def test_without_the_package_the_table_is_refused_in_one_sentence(study: Path, tmp_path: Path) -> None:
    refused = recollect(tmp_path, "study", "check", study)
    (sentence,) = refused.stderr.splitlines()
    assert (refused.returncode, "there is no action 'encourage'" in sentence) == (2, True)


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
def test_a_broken_one_gets_a_sentence_and_no_traceback(study: Path, tmp_path: Path, code: str, why: str) -> None:
    lab = tmp_path / "packages"
    register(lab, "a-lab", "recollect.actions", {"encourage": "a_lab:ENCOURAGE"}, a_lab=code)
    refused = recollect(lab, "study", "check", study)
    (sentence,) = refused.stderr.splitlines()
    assert refused.returncode == 2
    assert "the action 'encourage' of the package a-lab 0.1 cannot be used: " in sentence
    assert why in sentence


def test_the_page_shows_the_package_that_is_installed_here() -> None:
    page = EXTEND.read_text("utf-8")
    for file in FILES:
        assert (PLUGINS / "encourage" / file).read_text("utf-8") in page, file
