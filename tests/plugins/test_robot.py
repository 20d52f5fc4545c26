"""A robot that another package brings: named in a study file, tried, used in a session and recorded by its name."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest

from tests.plugins.installing import PLUGINS, install, recollect, register

EXTEND = PLUGINS.parents[1] / "docs" / "extend.md"


@pytest.fixture(scope="module")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder in which the package is installed."""
    folder = tmp_path_factory.mktemp("robot") / "packages"
    install("printing_robot", folder)
    return folder


def study(folder: Path, more: str = "") -> Path:
    """A study file that names the robot."""
    file = folder / "study.toml"
    file.write_text(f'languages = ["en"]\n[robot]\nkind = "printing"\n{more}', "utf-8")
    return file


def test_a_session_is_held_with_it_and_the_data_name_it(lab: Path, tmp_path: Path) -> None:
    file = study(tmp_path, "[robot.options]\ndelay_ms = 1\n")
    rehearsed = recollect(lab, "rehearse", "--headless", "--json", "--study", file, "--data", tmp_path / "data")
    assert rehearsed.returncode == 0, rehearsed.stderr
    played = json.loads(rehearsed.stdout)
    assert (played["status"], played["body"], played["body_changes"]) == ("completed", "robot:printing", 0)
    said = [line for line in rehearsed.stderr.splitlines() if line.startswith("robot: ")]
    assert len(said) == played["utterances"]["finished"] == played["utterances"]["requested"] > 0
    exported = recollect(lab, "export", "--out", tmp_path / "set", "--data", tmp_path / "data", "--with-rehearsals")
    assert exported.returncode == 0, exported.stderr
    with next((tmp_path / "set").glob("data/*participants_data.csv")).open(encoding="utf-8-sig", newline="") as table:
        (row,) = csv.DictReader(table)
    assert (row["body"], row["robot"]) == ("robot", "printing")


def test_the_check_lists_it_with_its_package_and_version(lab: Path, tmp_path: Path) -> None:
    checked = recollect(lab, "check", "--json", "--study", study(tmp_path), "--data", tmp_path / "data")
    (found,) = (each for each in json.loads(checked.stdout)["findings"] if each["what"] == "robot printing")
    assert (found["state"], found["words"]) == ("good", "recollect-printing-robot 1.0")


def test_it_is_tried_without_what_it_cannot_do(lab: Path) -> None:
    tried = json.loads(recollect(lab, "robot", "--kind", "printing", "--json", "--say", "Hello").stdout)
    assert [step["step"] for step in tried["steps"]] == ["ready to speak", "says the sentence", "can be silenced"]
    assert tried["works"]


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ("delay_ms = -1", "robot.options: delay_ms must be from 0 to 60000, but it is -1"),
        ("delay = 3", "robot.options: there is no key 'delay'"),
    ],
)
def test_options_that_it_does_not_take_are_told(lab: Path, tmp_path: Path, options: str, sentence: str) -> None:
    refused = recollect(lab, "study", "check", study(tmp_path, f"[robot.options]\n{options}\n"))
    assert refused.returncode == 2
    assert sentence in refused.stderr
    assert len(refused.stderr.splitlines()) == 1


BROKEN = {
    "missing library": ("import no_such_library\n", "the package no_such_library is missing"),
    "fault while it is imported": ("1 / 0\n", "ZeroDivisionError: division by zero"),
    "no driver": ("PrintingRobot = 7\n", "is no class derived from kiosk.robots.embodiment.RobotDriver"),
    "nothing of the name": ("", "AttributeError"),
    "half a driver": (
        "from kiosk.robots.embodiment import RobotDriver\nclass PrintingRobot(RobotDriver):\n    name = 'printing'\n",
        "its class lacks connect, say",
    ),
    "another name": (
        "from kiosk.robots.embodiment import RobotDriver\nclass PrintingRobot(RobotDriver):\n    name = 'other'\n",
        "its class must have name = 'printing'",
    ),
}


@pytest.mark.parametrize(("code", "why"), BROKEN.values(), ids=BROKEN)
def test_a_broken_one_gets_a_sentence_and_no_traceback(tmp_path: Path, code: str, why: str) -> None:
    lab = tmp_path / "packages"
    register(lab, "a-lab", "recollect.robots", {"printing": "a_lab:PrintingRobot"}, a_lab=code)
    refused = recollect(lab, "study", "check", study(tmp_path))
    (sentence,) = refused.stderr.splitlines()
    assert refused.returncode == 2
    assert "the robot 'printing' of the package a-lab 0.1 cannot be used: " in sentence
    assert why in sentence


def test_the_check_fails_for_a_broken_one_even_where_no_study_uses_it(tmp_path: Path) -> None:
    lab = tmp_path / "packages"
    register(lab, "a-lab", "recollect.robots", {"printing": "a_lab:PrintingRobot"}, a_lab="1 / 0\n")
    checked = recollect(lab, "check", "--json", "--data", tmp_path / "data")
    (found,) = (each for each in json.loads(checked.stdout)["findings"] if each["what"] == "robot printing")
    assert (found["state"], checked.returncode) == ("bad", 2)
    assert "pip uninstall a-lab" in found["remedy"]
    assert "Traceback" not in checked.stderr


def test_two_packages_cannot_have_the_same_name(tmp_path: Path) -> None:
    lab = tmp_path / "packages"
    register(lab, "a-lab", "recollect.robots", {"printing": "a_lab:X"})
    register(lab, "b-lab", "recollect.robots", {"printing": "b_lab:X"})
    refused = recollect(lab, "study", "check", study(tmp_path))
    assert "registered twice, by the packages a-lab 0.1 and b-lab 0.1" in refused.stderr
    assert refused.returncode == 2


def test_the_page_shows_the_package_that_is_installed_here() -> None:
    page = EXTEND.read_text("utf-8")
    folder = PLUGINS / "printing_robot"
    for file in ("pyproject.toml", "printing_robot.py"):
        assert (folder / file).read_text("utf-8") in page, file
