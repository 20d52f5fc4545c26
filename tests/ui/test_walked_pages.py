"""The check of a study goes through its pages, and tells texts that are cut off and sessions that do not end."""

from __future__ import annotations

from contextlib import nullcontext
from itertools import product
from pathlib import Path

import pytest

from kiosk.cli import page_walk
from kiosk.config import Settings
from kiosk.study.loader import read_study

STUDY = """\
languages = ["en"]
stages = ["introduction", "game", "result"]
[game]
rows = 2
columns = 2
[robot]
kind = "furhat"
"""


@pytest.fixture
def _one_size(monkeypatch: pytest.MonkeyPatch, qapp: object) -> None:
    """Try one window, without a guard that would end the tests' own process for the memory of all of them."""
    del qapp
    monkeypatch.setattr(page_walk, "guarded", lambda: nullcontext(lambda: None))
    monkeypatch.setattr(page_walk, "SIZES", ((1280, 720),))


def walked(folder: Path, more: str = "") -> list[tuple[bool, str]]:
    """Return what was found in a study."""
    (folder / "study.toml").write_text(STUDY + more, "utf-8")
    return list(page_walk.walk_pages(read_study(Settings.read(folder / "study.toml"))))


@pytest.mark.usefixtures("_one_size")
def test_pages_that_fit_are_passed_over_in_silence_and_no_robot_is_looked_for(tmp_path: Path) -> None:
    assert walked(tmp_path) == []


@pytest.mark.usefixtures("_one_size")
def test_a_page_that_does_not_fit_and_cannot_be_left_is_told_with_language_and_window(tmp_path: Path) -> None:
    found = walked(tmp_path, f'[texts.en]\nintroduction-continue = "{"Unbreakable" * 300}"\n')
    place = "in 'en', on a window of 1280 x 720"
    (fault,) = [each for is_fault, each in found if is_fault]
    assert fault == f"{place}, a session cannot go on: 'continue' lies outside the window, on the screen introduction"
    assert any(f"{place}, a text is cut off: 'Unbreakable" in each for is_fault, each in found if not is_fault)


def test_every_language_is_tried_in_every_window(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "study.toml").write_text(STUDY.replace('["en"]', '["en", "it"]'), "utf-8")
    tried: list[tuple[object, ...]] = []
    monkeypatch.setattr(page_walk, "_walk", lambda *given: tried.append(given[3:5]))
    assert list(page_walk.walk_pages(read_study(Settings.read(tmp_path / "study.toml")))) == []
    assert tried == list(product(("en", "it"), ((1280, 720), (1920, 1080), (1080, 1920))))
