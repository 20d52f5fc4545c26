"""What a command loads before it answers: nothing that only other commands need."""

from __future__ import annotations

import subprocess
import sys

import pytest

HEAVY = {
    *("pydantic", "cattrs", "fluent", "babel", "rich", "psutil", "filelock", "numpy"),
    *("PySide6.QtQml", "PySide6.QtQuick"),
}
QUICK = (
    *("kiosk.cli.main", "kiosk.cli.guide", "kiosk.cli.run", "kiosk.cli.sessions", "kiosk.cli.status"),
    *("kiosk.cli.check_command", "kiosk.ui.startup_splash"),
)


@pytest.mark.parametrize("module", QUICK)
def test_what_must_be_quick_loads_nothing_heavy(module: str) -> None:
    look = f"import sys, {module}; print(*(set(sys.modules) & {HEAVY!r}))"
    loaded = subprocess.run([sys.executable, "-c", look], capture_output=True, text=True, check=True)
    assert loaded.stdout.split() == []
