"""One whole session, from the command line to the database, is the same to the byte as it always was."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtGui import QImage

from kiosk.ui.screenshots import LAYOUTS
from tests.forked import LoadedProgram
from tests.golden import story

Recollect = Callable[..., str]

RESULT = {"session", "status", "condition", "embodiment", "flips", "moves", "pairs", "hints"}


@pytest.fixture(scope="module")
def recollect(loaded_program: LoadedProgram) -> Recollect:
    """Run a command, which must end well and without a word on standard error; returns what it prints."""

    def run(*arguments: str) -> str:
        done = loaded_program.run(arguments, story.FILE.parent, os.environ)
        assert (done.returncode, done.stderr) == (0, ""), arguments
        return done.stdout

    return run


def test_the_golden_story_is_told_again_to_the_byte(recollect: Recollect) -> None:
    assert story.told(recollect) == story.FILE.read_text("utf-8")


def test_a_rehearsal_prints_one_object_and_the_list_of_sessions_has_the_same(
    recollect: Recollect, tmp_path: Path
) -> None:
    arguments = ("--data", str(tmp_path), "--json")
    study = tmp_path / "study.toml"
    study.write_text('stages = ["introduction", "game", "result"]\n[game]\nrows = 2\ncolumns = 3\n')
    wanted = ("--seed", "4", "--condition", "notom", "--study", str(study))
    played = json.loads(recollect("rehearse", "--headless", *wanted, *arguments))
    (listed,) = json.loads(recollect("sessions", *arguments))
    assert set(played) >= RESULT
    assert played["status"] == "completed"
    assert played["condition"] == "notom"
    assert played["pairs"] == 3
    assert {key: listed[key] for key in RESULT} == {key: played[key] for key in RESULT}


def test_every_moment_of_a_rehearsal_is_photographed(recollect: Recollect, tmp_path: Path) -> None:
    study = tmp_path / "study.toml"
    study.write_text("[game]\nrows = 3\ncolumns = 4\n")
    shots = tmp_path / "shots"
    here = ("--data", str(tmp_path / "data"), "--shots", str(shots), "--study", str(study))
    recollect("rehearse", "--headless", "--seed", "1", "--language", "es", "--layout", "both", *here)
    assert {sheet.name for sheet in shots.glob("contact-*")} == {"contact-es-upright.png", "contact-es-wide.png"}
    sheet = QImage(str(shots / "contact-es-upright.png"))
    assert sheet.width() > 8 * 150
    assert sheet.height() > 3 * 270
    assert len(json.loads(recollect("sessions", "--data", str(tmp_path / "data"), "--json"))) == 1
    taken = {picture.stem[3:] for picture in shots.glob("upright/*.png")}
    assert taken == {picture.stem[3:] for picture in shots.glob("wide/*.png")}
    assert taken >= {"attract", "introduction", "board", "card", "turning-back", "speaking", "pair", "result"}
    assert taken >= {
        "about",
        "consent",
        "ticked",
        "age",
        "about-you-1",
        "items-1",
        "items-5",
        "answer",
        "debrief",
        "thanks",
    }
    assert taken >= {"last-pair", "pause", "stop", "still-there", "panel"}
    heights = {layout: {QImage(str(file)).height() for file in shots.glob(f"{layout}/*")} for layout in LAYOUTS}
    assert heights == {"wide": {1080}, "upright": {1920}}
    assert taken & {"mark-card", "mark-row", "mark-column"}
