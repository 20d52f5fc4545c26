"""Where no window can be opened, that is said in a sentence, with what to do about it, before Qt ends the process."""

from __future__ import annotations

import ctypes
import os
import socket
import subprocess
import sys
from collections.abc import Callable, Mapping
from ctypes.util import find_library
from pathlib import Path

import pytest

from kiosk.config import Settings
from kiosk.preflight import Severity
from kiosk.study.loader import read_study
from kiosk.ui import qt_platform
from kiosk.ui.checks import frame_check, screens_check
from kiosk.ui.qt_platform import missing_library, obstacle
from tests.forked import ROOT, LoadedProgram
from tests.patience import PATIENCE_S
from tests.samples import WITH_PIN

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="elsewhere a screen is always there")

NOWHERE = ":5551"
"""A screen that no X server has."""

SCREENS = ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM")
"""The variables that say where the screen is."""

CDLL = ctypes.CDLL


def environment(**screen: str) -> dict[str, str]:
    """Return the environment of this process, with this screen."""
    return {name: value for name, value in os.environ.items() if name not in SCREENS} | screen


Run = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture(scope="module")
def run(loaded_program: LoadedProgram) -> Run:
    """Return what runs the program where this is the screen."""

    def run(*arguments: str, **screen: str) -> subprocess.CompletedProcess[str]:
        return loaded_program.run(arguments, ROOT, environment(**screen))

    return run


def lacks(*missing: str) -> type[ctypes.CDLL]:
    """Return a loader for a system without these libraries; Qt's platform for X needs all of them."""

    class Loader(CDLL):
        """Loads what is there."""

        def __init__(self, name: str) -> None:
            wanted = missing[0] if name.endswith("libqxcb.so") else name
            if wanted in missing:
                raise OSError(f"{wanted}: cannot open shared object file: No such file or directory")
            super().__init__(name)

    return Loader


@pytest.fixture
def study_with_pin(tmp_path: Path) -> Path:
    """Return a study that may be kept up."""
    study = tmp_path / "study.toml"
    study.write_text(WITH_PIN)
    return study


@pytest.mark.parametrize(
    "command",
    [("run",), ("rehearse",), ("run", "--supervise")],
    ids=["run", "rehearse", "run supervised"],
)
@pytest.mark.parametrize(
    ("screen", "said"),
    [
        ({"DISPLAY": NOWHERE}, "the screen :5551, which DISPLAY names, cannot be reached; run this in the session"),
        ({"QT_QPA_PLATFORM": "none-such"}, "Qt has no platform 'none-such', which QT_QPA_PLATFORM names; unset it"),
        ({}, "there is no screen here; 'recollect rehearse --headless'"),
    ],
    ids=["a screen that is not there", "a platform that Qt has not", "no screen"],
)
def test_a_screen_that_cannot_be_reached_is_refused_in_one_sentence(
    run: Run, command: tuple[str, ...], screen: Mapping[str, str], said: str, study_with_pin: Path
) -> None:
    name, *options = command
    done = run(name, "--data", str(study_with_pin.parent / "data"), *options, "--study", str(study_with_pin), **screen)
    first, *others = done.stderr.splitlines()
    assert (done.returncode, first.startswith(f"recollect: {said}")) == (2, True), done.stderr
    kept = ["recollect: the kiosk refused what it was given, so it is not started again"]
    assert others == (kept if "--supervise" in options else [])


def test_a_rehearsal_without_a_screen_does_not_mind_one_that_cannot_be_reached(run: Run, tmp_path: Path) -> None:
    study = tmp_path / "study.toml"
    study.write_text('stages = ["introduction", "game", "result"]\n[game]\nrows = 1\ncolumns = 2\n')
    done = run("rehearse", "--headless", "--data", str(tmp_path / "data"), "--study", str(study), DISPLAY=NOWHERE)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.skipif(find_library("wayland-client") is None, reason="the library of Wayland is not installed")
def test_a_compositor_that_answers_is_a_screen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(qt_platform, "_plugin_fails", lambda *_: None)
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    where = {"WAYLAND_DISPLAY": "one"}
    found = obstacle(where)
    assert found is not None
    assert "the screen one, which WAYLAND_DISPLAY names, cannot be reached" in found.words
    with socket.socket(socket.AF_UNIX) as compositor:
        compositor.bind(str(tmp_path / "one"))
        compositor.listen()
        assert obstacle(where) is None
        # Either is enough, as it is for Qt.
        assert obstacle(where | {"DISPLAY": NOWHERE}) is None


def test_a_missing_library_is_named_with_the_package_that_holds_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ctypes, "CDLL", lacks("libxcb-cursor.so.0"))
    found = obstacle({"DISPLAY": NOWHERE})
    assert str(found) == (
        "the library libxcb-cursor.so.0 is missing, without which no window can be opened; "
        "on Debian and Ubuntu, install what holds it with: sudo apt-get install libxcb-cursor0"
    )


def test_all_missing_libraries_are_named_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ctypes, "CDLL", lacks("libxcb-cursor.so.0", "libxcb-image.so.0", "libxkbcommon-x11.so.0"))
    found = obstacle({"DISPLAY": NOWHERE})
    assert found is not None
    assert found.remedy.endswith("install libxcb-cursor0 libxcb-image0 libxkbcommon-x11-0")


def test_a_check_says_what_to_install_and_does_not_praise_the_drawing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ctypes, "CDLL", lacks("libxcb-cursor.so.0"))
    for name in SCREENS:
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("DISPLAY", NOWHERE)
    for found in (*screens_check(0), *frame_check(read_study(Settings()))):
        assert (found.severity, "libxcb-cursor.so.0" in found.message) == (Severity.ERROR, True)
        assert found.remedy.endswith("sudo apt-get install libxcb-cursor0")


def test_a_check_of_a_screen_that_cannot_be_reached_says_which_one(run: Run) -> None:
    done = run("_display", "screens", "0", DISPLAY=NOWHERE)
    assert (done.returncode, done.stderr) == (0, "")
    assert "cannot be reached" in done.stdout


@pytest.mark.parametrize("command", ["run", "_display screens 0", "_display frame"])
def test_a_library_that_qt_itself_lacks_ends_in_a_sentence(command: str, tmp_path: Path) -> None:
    # As the linker refuses Qt where libegl1 is not installed.
    lacking = """
import sys
class Lacking:
    def find_spec(self, name, path=None, target=None):
        if name in ("PySide6.QtGui", "PySide6.QtQuick"):
            raise ImportError("libEGL.so.1: cannot open shared object file: No such file or directory")
sys.meta_path.insert(0, Lacking())
from kiosk.cli.main import main
main()
"""
    done = subprocess.run(
        [sys.executable, "-c", lacking, *command.split()],
        cwd=tmp_path,
        env=environment(),
        capture_output=True,
        text=True,
        check=False,
        timeout=PATIENCE_S,
    )
    said = done.stdout + done.stderr
    assert (done.returncode, "Traceback" in said) == (2 if command == "run" else 0, False)
    assert "the library libEGL.so.1 is missing" in said
    assert "sudo apt-get install libegl1" in said


def test_an_import_that_fails_for_another_reason_is_no_missing_library() -> None:
    assert missing_library(ImportError("cannot import name 'x' from 'y'")) is None
