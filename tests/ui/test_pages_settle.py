"""Every page finds its size, whatever its texts, items, text size and window."""

from __future__ import annotations

import re
import subprocess
import sys

import pytest


@pytest.mark.parametrize(
    "which",
    [
        # Three ratings of 11 points once went on for ever: the bar made the page too low to need a bar.
        ("--only", "3 likert, latin, 1920 x 1080"),
        ("--only", "4 likert, latin, 1080 x 1920"),
        ("--every", "24"),
    ],
)
def test_pages_settle(which: tuple[str, str]) -> None:
    # In a process of its own, which ends itself: a page that does not settle cannot be interrupted from Python.
    done = subprocess.run(
        [sys.executable, "-m", "tests.ui.settling", *which], capture_output=True, text=True, check=False, timeout=300
    )
    assert done.returncode == 0, done.stderr
    assert re.match("[1-9][0-9]* layouts settled", done.stdout)
