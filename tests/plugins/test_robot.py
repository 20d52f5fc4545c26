"""A robot that another package brings: named in a study file, tried, used in a session and recorded by its name."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from kiosk.cli.check import extensions_check
from kiosk.extensions import ExtensionGroup, find
from kiosk.preflight import Severity
from kiosk.robots.registry import load_driver
from tests.plugins.conftest import Beside, Day, Lab, Register, assert_refused


def study(folder: Path, more: str = "") -> Path:
    """Return a study file that names the robot."""
    file = folder / "study.toml"
    file.write_text(f'languages = ["en"]\n[robot]\nkind = "printing"\n{more}', "utf-8")
    return file


def test_a_session_is_held_with_it_and_the_data_name_it(day: Day) -> None:
    played = day.played
    assert (played["status"], played["embodiment"], played["embodiment_changes"]) == ("completed", "robot:printing", 0)
    assert len(day.said) == played["utterances"]["finished"] == played["utterances"]["requested"] > 0
    (row,) = day.rows("participants")
    assert (row["embodiment"], row["robot"]) == ("robot", "printing")


def test_the_check_lists_it_with_its_package_and_version(added: dict[str, tuple[str, str]]) -> None:
    assert added["robot printing"] == ("ok", "recollect-printing-robot 1.0")


def test_it_is_tried_without_what_it_cannot_do(lab: Lab) -> None:
    tried = lab.json("robot", "--kind", "printing", "--say", "Hello")
    assert [step["step"] for step in tried["steps"]] == ["ready to speak", "says the sentence", "can be silenced"]
    assert tried["works"]


def test_options_that_it_does_not_take_are_told(
    lab: Lab, tmp_path: Path, beside: Beside, refusal: Callable[[Path], str]
) -> None:
    beside(lab.site)
    told = {
        "delay_ms = -1": "robot.options: delay_ms must be from 0 to 60000, but it is -1",
        "delay = 3": "robot.options: there is no key 'delay'",
    }
    for options, sentence in told.items():
        assert sentence in refusal(study(tmp_path, f"[robot.options]\n{options}\n"))


DERIVED = "from kiosk.robots.driver import RobotDriver\nclass PrintingRobot(RobotDriver):\n"
BROKEN = {
    "missing library": ("import no_such_library\n", "the package no_such_library is missing"),
    "fault while it is imported": ("1 / 0\n", "ZeroDivisionError: division by zero"),
    "no driver": ("PrintingRobot = 7\n", "is no class derived from kiosk.robots.driver.RobotDriver"),
    "nothing of the name": ("", "AttributeError"),
    "half a driver": (f"{DERIVED}    name = 'printing'\n", "its class lacks connect, say"),
    "another name": (f"{DERIVED}    name = 'other'\n", "its class must have name = 'printing'"),
}


@pytest.mark.parametrize(("code", "why"), BROKEN.values(), ids=BROKEN)
def test_it_is_said_what_is_wrong_with_a_broken_one(beside: Beside, register: Register, code: str, why: str) -> None:
    beside(register("a-lab", "recollect.robots", {"printing": "a_lab:PrintingRobot"}, a_lab=code))
    assert_refused(lambda: load_driver(find(ExtensionGroup.ROBOTS, "printing")), "the robot 'printing'", why)


def test_a_study_with_a_broken_one_is_refused_without_a_traceback(
    tmp_path: Path, beside: Beside, register: Register, refusal: Callable[[Path], str]
) -> None:
    beside(register("a-lab", "recollect.robots", {"printing": "a_lab:PrintingRobot"}, a_lab="1 / 0\n"))
    assert "the robot 'printing' of the package a-lab 0.1 cannot be used: " in refusal(study(tmp_path))


def test_the_check_fails_for_a_broken_one_even_where_no_study_uses_it(beside: Beside, register: Register) -> None:
    beside(register("a-lab", "recollect.robots", {"printing": "a_lab:PrintingRobot"}, a_lab="1 / 0\n"))
    (found,) = (each for each in extensions_check() if each.name == "robot printing")
    assert found.severity is Severity.ERROR
    assert "pip uninstall a-lab" in found.remedy


def test_two_packages_cannot_have_the_same_name(
    tmp_path: Path, beside: Beside, register: Register, refusal: Callable[[Path], str]
) -> None:
    register("a-lab", "recollect.robots", {"printing": "a_lab:X"})
    beside(register("b-lab", "recollect.robots", {"printing": "b_lab:X"}))
    assert "registered twice, by the packages a-lab 0.1 and b-lab 0.1" in refusal(study(tmp_path))


@pytest.mark.parametrize("file", ["pyproject.toml", "printing_robot.py"])
def test_the_page_shows_the_package_that_is_installed_here(documented: Callable[[str, str], bool], file: str) -> None:
    assert documented("printing_robot", file)
