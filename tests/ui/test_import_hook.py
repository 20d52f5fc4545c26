"""What a start saves: the import hook of PySide does not read the source of each module."""

from __future__ import annotations

import builtins
from importlib import import_module
from pathlib import Path

import pytest

from kiosk.ui.import_hook import remove_import_hook


def test_pyside_looks_at_no_module_that_is_imported_once_its_hook_is_removed(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    seen = vars(import_module("PySide6.support.feature"))["pyside_feature_dict"]
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(builtins, "__import__", builtins.__import__)
    for name in ("imported_with_the_hook", "imported_without_it"):
        (tmp_path / f"{name}.py").touch()
    exec("import imported_with_the_hook")  # noqa: S102 - the statement uses the hook, the function does not
    remove_import_hook()
    remove_import_hook()
    exec("import imported_without_it")  # noqa: S102
    assert "imported_with_the_hook" in seen, "PySide does so no more: the module can go"
    assert "imported_without_it" not in seen
