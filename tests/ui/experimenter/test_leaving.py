"""The kiosk is left by the PIN alone, and nothing appears on the terminal when it is."""

from __future__ import annotations

import gc
import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from PySide6.QtCore import Qt, QTimer
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from kiosk.config import STAGES, Settings
from kiosk.experiment.experimenter import Action
from kiosk.experiment.outcomes import Stage
from kiosk.study.loader import read_study
from kiosk.ui.experimenter.view_model import AuthorisationStep
from kiosk.ui.replay import Replay
from kiosk.ui.window import ClockMode, RunMode, Window, WindowMode
from tests.samples import whole
from tests.ui.experimenter.conftest import Desk, MakeDesk
from tests.ui.headless import headless, short

CONTROL, SHIFT, ALT = (
    Qt.KeyboardModifier.ControlModifier,
    Qt.KeyboardModifier.ShiftModifier,
    Qt.KeyboardModifier.AltModifier,
)
WAYS_OUT = [
    (Qt.Key.Key_F4, ALT),
    (Qt.Key.Key_Q, CONTROL),
    (Qt.Key.Key_W, CONTROL),
    (Qt.Key.Key_C, CONTROL),
    (Qt.Key.Key_Escape, Qt.KeyboardModifier.NoModifier),
    (Qt.Key.Key_F11, Qt.KeyboardModifier.NoModifier),
    (Qt.Key.Key_Q, CONTROL | SHIFT),
    (Qt.Key.Key_P, CONTROL | SHIFT),
]
"""What leaves programs elsewhere, and the kiosk's own shortcuts."""


def desk_in(stage: Stage, make_assigner: MakeDesk) -> Desk:
    """Return a booth with a visitor in this stage; a session there has no other but the game."""
    assigner = make_assigner(stages=[name for name in STAGES if name in {"game", stage.value}])
    assigner.go_to(stage)
    return assigner


@pytest.mark.parametrize("stage", [Stage.ATTRACT, Stage.CONSENT, Stage.GAME, Stage.THANKS, Stage.OVER])
def test_with_a_pin_no_key_leaves_the_kiosk_or_opens_the_panel(
    stage: Stage, make_assigner: MakeDesk, monkeypatch: pytest.MonkeyPatch
) -> None:
    assigner = desk_in(stage, make_assigner)
    left: list[str] = []
    monkeypatch.setattr(assigner.app._loop, "quit", lambda: left.append("left"))
    for key, modifiers in WAYS_OUT:
        QTest.keyClick(assigner.app.window, key, modifiers)
        # Without the PIN, or with a wrong one, nothing comes of what was asked for.
        assigner.enter()
        if assigner.card.asks_for is AuthorisationStep.PIN:
            assigner.type("9999")
            assigner.enter()
        assigner.wait_until(lambda: assigner.card.asks_for is AuthorisationStep.NOTHING)
    assert not assigner.app.window.close()
    assert (left, assigner.panel.is_open, assigner.app.window.isVisible()) == ([], False, True)
    assert {"ApplicationQuit", "PanelOpened"}.isdisjoint(kind for kind, _ in assigner.notes)


@pytest.mark.parametrize("panel", ["", "the panel is open"])
@pytest.mark.parametrize(
    "stage", [Stage.ATTRACT, Stage.CONSENT, Stage.ABOUT_YOU, Stage.GAME, Stage.DEBRIEF, Stage.OVER]
)
def test_nothing_is_said_by_qml_when_the_kiosk_is_left(
    stage: Stage,
    panel: str,
    make_assigner: MakeDesk,
    qtlog: Any,
) -> None:
    assigner = desk_in(stage, make_assigner)
    if panel:
        assigner.open_panel()
    assigner.do(Action.QUIT)
    assigner.close()
    gc.collect()
    assert qtlog.records == []


def test_nothing_is_said_by_qml_when_a_replay_is_left(qtbot: QtBot, qtlog: Any) -> None:
    del qtbot
    with Replay(RunMode(WindowMode.NOWHERE, ClockMode.WALL, 32), whole(), (), "Session 1") as replay:
        replay.screens.kiosk.show("form")
    gc.collect()
    assert qtlog.records == []


@pytest.mark.parametrize("broken", ["_voice", "EmbodimentSelector", "EventLoop", "ExperimenterConsole"])
def test_a_kiosk_that_cannot_be_built_leaves_no_window_and_no_complaint(
    broken: str, tmp_path: Path, qtbot: QtBot, qtlog: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    del qtbot
    before = {ending: signal.getsignal(ending) for ending in (signal.SIGINT, signal.SIGTERM)}

    def refuse(*_: object, **__: object) -> None:
        raise LookupError("not today")

    monkeypatch.setattr(f"kiosk.ui.app.{broken}", refuse)
    with pytest.raises(LookupError, match="not today"), headless(short(), tmp_path):
        pass
    gc.collect()
    assert qtlog.records == []
    assert {ending: signal.getsignal(ending) for ending in before} == before


def test_a_window_that_nobody_closes_goes_before_what_it_looks_at(qtbot: QtBot, qtlog: Any) -> None:
    del qtbot
    window = Window(read_study(Settings()), RunMode(WindowMode.NOWHERE, ClockMode.VIRTUAL))
    window.show()
    del window
    gc.collect()
    assert qtlog.records == []


INTERRUPTED = """
import os, signal, sys
from kiosk.cli.main import main
from kiosk.ui.window import Window
# A shell that runs the tests in the background lets them ignore it.
signal.signal(signal.SIGINT, signal.default_int_handler)
def interrupt(*_):
    os.kill(os.getpid(), signal.SIGINT)
    signal.pause()  # another thread may take the signal, a moment later
Window._load = interrupt
main()
"""


@pytest.mark.skipif(sys.platform == "win32", reason="signals as Unix has them")
def test_a_kiosk_that_is_interrupted_while_it_opens_ends_at_once_and_says_nothing(tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-c", INTERRUPTED, "run", "--window", "--data", str(tmp_path)],
        env=os.environ | {"QT_QPA_PLATFORM": "offscreen"},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert (done.returncode, done.stdout, done.stderr) == (-signal.SIGINT, "", "")


def test_an_end_that_was_asked_for_just_before_the_loop_began_is_not_lost(
    make_assigner: MakeDesk, monkeypatch: pytest.MonkeyPatch
) -> None:
    assigner = make_assigner()

    class Asked(QTimer):
        def __init__(self) -> None:
            signal.raise_signal(signal.SIGTERM)
            super().__init__()

    # The last thing that is made before the loop begins.
    monkeypatch.setattr("kiosk.ui.event_loop.QTimer", Asked)
    assigner.app.run()
    assert assigner.app.stop_requested
