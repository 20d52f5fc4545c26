"""The program that plays a sound on this system."""

from __future__ import annotations

import shutil
from pathlib import Path

_QUIET = {"aplay": ("-q",), "afplay": ()}
"""The programs that are looked for, in this order, and what keeps them from talking."""


def player() -> tuple[str, ...] | None:
    """The command that plays the file that is added to it; None if there is no such program."""
    path = next((path for name in _QUIET if (path := shutil.which(name))), None)
    return (path, *_QUIET[Path(path).name]) if path else None
