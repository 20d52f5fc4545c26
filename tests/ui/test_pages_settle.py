"""Every page finds its size, whatever its texts, items, text size and window."""

from __future__ import annotations

import re
import subprocess
import sys

# Three ratings of 11 points once went on for ever: the bar made the page too low to need a bar.
ONCE_WENT_ON = ("3 likert, latin, 1920 x 1080", "4 likert, latin, 1080 x 1920")


def test_pages_settle() -> None:
    # In a process of its own, which ends itself: a page that does not settle cannot be interrupted from Python.
    which = ["--every", "61", *(f"--also={page}" for page in ONCE_WENT_ON)]
    done = subprocess.run(
        [sys.executable, "-m", "tests.ui.settling", *which], capture_output=True, text=True, check=False, timeout=300
    )
    assert done.returncode == 0, done.stderr
    laid_out = re.match("([0-9]+) layouts settled", done.stdout)
    assert laid_out is not None
    # Those two pages in all 61 text sizes alone are 122.
    assert int(laid_out[1]) > 122
