"""Whatever goes wrong in a rehearsal, it ends with the reason in a sentence and never hangs."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from kiosk.ui.screens.board import BoardScreen
from kiosk.ui.simulated_visitor import UiTimeout
from tests.forked import ROOT, LoadedProgram
from tests.ui.conftest import Booth

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="what guards it cannot fork")


ENVIRONMENT = {name: value for name, value in os.environ.items() if name != "NOTIFY_SOCKET"} | {
    "QT_QPA_PLATFORM": "offscreen"
}
STUCK = "from runpy import run_module\nrun_module('tests.ui.stuck_kiosk', run_name='__main__')\n"
ASKED_TO_END = """
import os, signal, time
said, process = os.readlink("/proc/self/fd/2"), os.getpid()
if os.fork() == 0:
    while os.getppid() == process:
        if "stuck" in open(said).read():
            os.kill(process, signal.SIGTERM)
            break
        time.sleep(0.02)
    os._exit(0)
"""
"""What asks the program to end once it is stuck."""

Rehearse = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture(scope="module")
def rehearse(loaded_program: LoadedProgram) -> Rehearse:
    """Return what runs a rehearsal in which this is wrong with the first card."""

    def rehearse(data: Path, *wrong: str, first: str = "") -> subprocess.CompletedProcess[str]:
        study = data / "study.toml"
        study.write_text('stages = ["game"]\n[game]\nrows = 1\ncolumns = 2\n')
        arguments = (*wrong, "rehearse", "--headless", "--study", str(study), "--data", str(data / "data"))
        return loaded_program.run(arguments, ROOT, ENVIRONMENT, program=first + STUCK)

    return rehearse


def test_a_fault_ends_the_rehearsal_with_its_name_and_place(rehearse: Rehearse, tmp_path: Path) -> None:
    ended = rehearse(tmp_path, "fault")
    assert (ended.returncode, ended.stdout) == (1, "")
    *_, last = ended.stderr.splitlines()
    assert (
        "the rehearsal cannot go on: there was a fault in Recollect, KeyError: 'unicorn' (stuck_kiosk.py, line" in last
    )


@pytest.mark.parametrize("wrong", ["with lock", "without lock"])
def test_an_interface_that_stands_still_ends_the_rehearsal_in_words(
    rehearse: Rehearse, tmp_path: Path, wrong: str
) -> None:
    ended = rehearse(tmp_path, wrong)
    assert ended.returncode != 0
    assert ended.stderr.splitlines()[-1] == "recollect: the interface stood still for 1 s, so it was ended"


@pytest.mark.parametrize("wrong", ["with lock", "without lock"])
def test_an_interface_that_stands_still_ends_when_it_is_asked_to(
    rehearse: Rehearse, tmp_path: Path, wrong: str
) -> None:
    ended = rehearse(tmp_path, wrong, "--slowly", first=ASKED_TO_END)
    assert ended.returncode != 0
    assert "it was asked to end and did not, so it was ended" in ended.stderr


def test_a_fault_in_the_window_ends_the_rehearsal_that_is_under_way(
    booth: Booth, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    def fail(*_: object) -> None:
        raise KeyError("unicorn")

    monkeypatch.setattr(BoardScreen, "reveal", fail)
    with pytest.raises(UiTimeout, match="a fault in Recollect, KeyError: 'unicorn'"):
        booth.rehearse(seed=1)
    caplog.clear()


def test_a_fault_of_the_visitor_itself_ends_the_rehearsal(
    booth: Booth, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    nothing: dict[str, object] = {}
    monkeypatch.setattr("kiosk.ui.simulated_visitor.SimulatedParticipant.choose", lambda *_: nothing["nowhere"])
    with pytest.raises(UiTimeout, match="a fault in Recollect, KeyError: 'nowhere'"):
        booth.rehearse(seed=1)
    caplog.clear()
