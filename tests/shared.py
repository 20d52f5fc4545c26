"""What takes long to make is made once for all processes that run the tests."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest
from filelock import FileLock

from tests.patience import PATIENCE_S


def made_once(factory: pytest.TempPathFactory, name: str, make: Callable[[Path], None]) -> Path:
    """Return a folder that the first process has made, and that all others only read."""
    base = factory.getbasetemp()
    # The temporary folders of all workers lie side by side.
    folder = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / f"shared-{name}"
    finished = folder / "finished"
    # Another process may be making it, within its own limits.
    with FileLock(folder.with_suffix(".lock"), timeout=2 * PATIENCE_S):
        if not finished.exists():
            folder.mkdir()
            make(folder)
            finished.touch()
    return folder
