"""What a start saves: the import hook of PySide does not read the source of each module."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from tests.patience import PATIENCE_S

PROGRAM = """
from importlib import import_module
import PySide6.QtCore
from kiosk.ui.qt_platform import remove_import_hook

seen = vars(import_module("PySide6.support.feature"))["pyside_feature_dict"]
import imported_with_the_hook
remove_import_hook()
remove_import_hook()
import imported_without_it
print(*(name for name in seen if name.startswith("imported")))
"""


def test_pyside_looks_at_no_module_that_is_imported_once_its_hook_is_removed(tmp_path: Path) -> None:
    # In a process of its own: a kiosk that another test has started in this one may have removed the hook.
    for name in ("imported_with_the_hook", "imported_without_it"):
        (tmp_path / f"{name}.py").touch()
    (tmp_path / "program.py").write_text(PROGRAM, "utf-8")
    done = subprocess.run(
        [sys.executable, tmp_path / "program.py"], capture_output=True, text=True, check=False, timeout=PATIENCE_S
    )
    assert done.stderr == ""
    assert done.stdout.split() == ["imported_with_the_hook"], "if it is none, PySide has no hook any more"
