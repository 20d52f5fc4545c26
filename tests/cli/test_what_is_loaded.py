"""What a command loads before it answers: nothing that only other commands need."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.patience import PATIENCE_S

HEAVY = {
    *("pydantic", "cattrs", "fluent", "babel", "rich", "psutil", "filelock", "numpy"),
    *("PySide6.QtQml", "PySide6.QtQuick"),
}
QUICK = (
    *("kiosk.cli.main", "kiosk.cli.guide", "kiosk.cli.run", "kiosk.cli.sessions", "kiosk.cli.status"),
    "kiosk.ui.startup_splash",
)

LATER = {"attr", "cattrs", "kiosk.experiment.session", "PySide6.QtDBus", "babel", "fluent", "http.client", "segno"}
"""What a start leaves for the time after its first frame."""

START = f"""
import os, sys
from pathlib import Path
from kiosk.cli import opening

def drawn(*_):
    tasks = Path("/proc/self/task")
    threads = [task.joinpath("comm").read_text() for task in tasks.iterdir()] if tasks.exists() else []
    # Qt's own name for a thread of a pool.
    pooled = [name for name in threads if "(pooled)" in name]
    print(*(set(sys.modules) & {LATER!r}), *pooled, flush=True)
    os._exit(0)

opening.after_first_frame = lambda window, call: after_first_frame(window, drawn)
from kiosk.ui.event_loop import after_first_frame
from kiosk.cli.main import main
main()
"""


@pytest.mark.parametrize("module", QUICK)
def test_what_must_be_quick_loads_nothing_heavy(module: str) -> None:
    look = f"import sys, {module}; print(*(set(sys.modules) & {HEAVY!r}))"
    loaded = subprocess.run(
        [sys.executable, "-c", look], capture_output=True, text=True, check=True, timeout=PATIENCE_S
    )
    assert loaded.stdout.split() == []


def test_the_start_screen_waits_for_nothing_that_only_a_session_needs_and_for_no_other_thread(tmp_path: Path) -> None:
    command = [sys.executable, "-c", START, "run", "--window", "--data", str(tmp_path)]
    offscreen = os.environ | {"QT_QPA_PLATFORM": "offscreen", "QT_QUICK_BACKEND": "software"}
    loaded = subprocess.run(command, capture_output=True, text=True, check=True, env=offscreen, timeout=PATIENCE_S)
    assert loaded.stdout.split() == []
