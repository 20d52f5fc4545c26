"""The first picture: it looks as the study asks, and goes when the kiosk's own window is there."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from PySide6.QtGui import QColor
from pytestqt.qtbot import QtBot

from kiosk.config import Settings
from kiosk.ui.startup_splash import PAPER, WHITE, Look, look_of, startup_splash


def test_without_a_study_file_it_has_the_background_of_the_start_screen() -> None:
    assert Settings().look.background == PAPER
    assert look_of(None) == Look()


@pytest.mark.parametrize(
    ("text", "look"),
    [
        ("", Look()),
        ("[screen]\ndisplay = 1", Look(display=1)),
        ('[look]\nbackground = "#EAF2F8"', Look(background="#EAF2F8")),
        ('[look]\nbackground = "#EAF2F8"\n[screen]\ncontrast = "high"', Look(background=WHITE)),
        ('[look]\nname = "Lab of Play"', Look(icon=False)),
        ('[look]\nlogo = "logo.svg"', Look(icon=False)),
        ('look = 3\nscreen = ["a"]', Look()),
        ('[screen]\ndisplay = "b"\n[look]\nbackground = 7', Look()),
        ('[look]\nbackground = "paper"', Look()),
        ("[look", Look()),
        ("a = " + "[" * 100_000 + '\n[look]\nbackground = "#EAF2F8"', Look(background="#EAF2F8")),
        ("[look]\nname = " + "[" * 100_000, Look()),
        ("a" + ".a" * 20_000 + " = 1\n[screen]\ndisplay = 1", Look(display=1)),
    ],
)
def test_a_study_file_says_how_it_looks_whatever_else_is_wrong_in_it(tmp_path: Path, text: str, look: Look) -> None:
    (tmp_path / "study.toml").write_text(text)
    assert look_of(tmp_path / "study.toml") == look


def test_a_packed_study_says_only_on_which_screen(tmp_path: Path) -> None:
    (tmp_path / "study.local.toml").write_text("[screen]\ndisplay = 2")
    assert look_of(tmp_path / "study.recollect") == Look(display=2, icon=False)


def test_a_study_file_that_is_not_there_changes_nothing(tmp_path: Path) -> None:
    assert look_of(tmp_path / "study.toml") == Look()


@pytest.mark.skipif(os.name != "posix", reason="a folder of Windows holds no pipes")
def test_a_pipe_in_place_of_a_study_file_is_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "study.toml")
    assert look_of(tmp_path / "study.toml") == Look()


@pytest.mark.usefixtures("qapp")
def test_it_covers_the_screen_at_once_and_is_gone_afterwards(qtbot: QtBot) -> None:
    with startup_splash(Look(display=5, background="#EAF2F8")) as window:
        qtbot.waitExposed(window)
        assert window.geometry() == window.screen().geometry()
        assert QColor(window.screen().grabWindow(window.winId(), 5, 5, 1, 1).toImage().pixel(0, 0)).name() == "#eaf2f8"
        window.hide()
    assert not window.isVisible()
