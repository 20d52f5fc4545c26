"""Removes the import hook of PySide.

PySide replaces Python's ``import`` to offer ``from __feature__ import snake_case``. To find out which modules may ask
for that, its hook reads the source of each module that is imported, 280 files at the start of a kiosk. No module here
uses such a feature.
"""

from __future__ import annotations

import builtins

import PySide6.QtCore  # noqa: F401 - it installs the hook

_PYTHONS_OWN = "__orig_import__"
"""Where PySide keeps the import that it replaced."""


def remove_import_hook() -> None:
    """Let ``import`` do again what it does without PySide; it may be called more than once."""
    builtins.__import__ = getattr(builtins, _PYTHONS_OWN, builtins.__import__)
