"""What a build ships of others has its notice: a line with name, version and licence, and the texts beside it."""

from __future__ import annotations

import importlib
import re
from collections.abc import Iterator
from importlib.metadata import Distribution, PackageNotFoundError, distribution, distributions
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from packaging.specifiers import SpecifierSet
from PySide6 import QtCore
from Xlib import X

from tests.packaging.scripts import load

ROOT = Path(__file__).parents[2]
REALTIME = "websockets"
"""What a build holds beyond the requirements of a plain installation."""


@pytest.fixture(scope="module")
def notices() -> ModuleType:
    """Return the file that collects them."""
    return load("notices")


def required(name: str, met: set[str]) -> Iterator[Distribution]:
    """Yield a distribution and all that it requires here, each once."""
    try:
        found = distribution(name)
    except PackageNotFoundError:
        # It is for another system.
        return
    if found.name in met:
        return
    met.add(found.name)
    yield found
    for requirement in found.requires or ():
        wanted = re.match(r"[\w.-]+", requirement)
        if wanted is not None and "extra ==" not in requirement:
            yield from required(wanted.group(), met)


def everything() -> list[Distribution]:
    """All distributions that a build can hold, but Recollect itself."""
    met: set[str] = set()
    return [each for root in ("recollect", REALTIME) for each in required(root, met) if each.name != "recollect"]


def test_every_distribution_that_a_build_can_hold_has_a_line_and_says_where_its_texts_are(
    notices: ModuleType, tmp_path: Path
) -> None:
    shipped = everything()
    assert len(shipped) > 20
    notices.write([notices.of_distribution(each) for each in shipped], tmp_path)
    lines = (tmp_path / "NOTICES.md").read_text(encoding="utf-8").splitlines()
    for each in shipped:
        (line,) = (line for line in lines if line.startswith(f"| {each.name} | {each.version} | "))
        texts = [text for text in (tmp_path / each.name).rglob("*") if text.is_file()]
        assert texts or "/usr/share/common-licenses/" in line
        assert all(text.stat().st_size for text in texts)


def test_qt_says_under_which_licence_it_is_and_where_to_read_it(notices: ModuleType) -> None:
    for name in ("PySide6_Essentials", "shiboken6", "python-xlib"):
        part = notices.of_distribution(distribution(name))
        assert "LGPL" in part.licence
        assert part.texts or "/usr/share/common-licenses/LGPL-3" in part.where


def test_whose_the_files_of_a_build_are_is_told_by_the_files(notices: ModuleType) -> None:
    files = {Path(str(module.__file__)).resolve() for module in (np, QtCore, X)}
    names = {part.name for part in notices.parts(files)}
    assert names == {"Python", "numpy", "PySide6_Essentials", "python-xlib"}


def test_what_was_trimmed_away_needs_no_notice(notices: ModuleType, tmp_path: Path) -> None:
    rows = [("kept.so", "/x/kept.so", "BINARY"), ("gone.so", "/x/gone.so", "BINARY"), ("a", "/x/a.py", "PYMODULE")]
    analysis = tmp_path / "Analysis-00.toc"
    analysis.write_text(repr(([], rows)), encoding="utf-8")
    (tmp_path / "kept.so").touch()
    assert {file.name for file in notices.sources(analysis, tmp_path)} == {"kept.so", "a.py"}


def test_a_package_without_any_licence_to_read_is_not_shipped(notices: ModuleType, tmp_path: Path) -> None:
    nameless = tmp_path / "nameless-1.dist-info"
    nameless.mkdir()
    (nameless / "METADATA").write_text("Metadata-Version: 2.1\nName: nameless\nVersion: 1\n", encoding="utf-8")
    with pytest.raises(notices.NoLicence, match="nameless comes without the text of its licence"):
        notices.of_distribution(Distribution.at(nameless))


@pytest.mark.parametrize(
    ("version", "expected"),
    [("0.2.0", "0.2.0"), ("0.2.0rc1", "0.2.0~rc1"), ("1.0a2", "1.0~a2"), ("0.3.0.dev4", "0.3.0~dev4")],
)
def test_a_package_of_a_version_before_the_release_is_older_than_the_release(
    version: str, expected: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.syspath_prepend(str(ROOT / "packaging"))
    assert importlib.import_module("debian").debian_version(version) == expected


def test_every_locked_package_runs_on_the_python_of_debian_12() -> None:
    """A newer Python resolves the lock; what is not installed here as it is locked is left out."""
    lines = (ROOT / "packaging" / "constraints.txt").read_text("utf-8").splitlines()
    locked = dict(line.split("==") for line in lines if not line.startswith("#"))
    installed = (package for package in distributions() if locked.get(package.name) == package.version)
    asked = {
        package.name: package.metadata["Requires-Python"]
        for package in installed
        if "Requires-Python" in package.metadata
    }
    assert {name: asks for name, asks in asked.items() if "3.11.2" not in SpecifierSet(asks)} == {}
