"""The walls of the house: who may know whom, in one table; nothing else in the tests says so."""

from __future__ import annotations

import ast
import json
import shutil
import subprocess
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[1] / "kiosk"

BELOW_ALL = {"kiosk", "errors", "config", "extensions", "files", "language_codes", "preflight", "units"}
"""The package itself, user errors, the study file's types, extensions, whole files, language codes, check results and
units: every package may import them, and they import no package."""

ROOMS: dict[str, set[str]] = {
    "kiosk": set(),
    "errors": set(),
    "config": set(),
    "extensions": set(),
    "files": set(),
    "language_codes": set(),
    "preflight": set(),
    "units": set(),
    "sd_notify": set(),
    "supervisor": {"sd_notify"},
    "game": set(),
    "assistance": {"game"},
    "experiment": {"game", "assistance"},
    "study": {"game", "assistance", "experiment"},
    "robots": {"game", "assistance", "experiment"},
    "store": {"game", "assistance", "experiment"},
    "export": {"game", "assistance", "experiment", "store"},
    "ui": {"game", "assistance", "experiment", "robots", "store", "sd_notify", "supervisor"},
    "training": {"game", "assistance"},
    "analysis": {"game", "assistance", "experiment", "robots", "store", "export", "training"},
    "cli": {
        *("game", "assistance", "experiment", "study", "robots", "store", "export", "ui", "training", "analysis"),
        *("supervisor", "sd_notify"),
    },
    "__main__": {"cli"},
}
"""Which packages a package may import from, besides itself and what is below all."""

OUTSIDE: dict[str, set[str]] = {
    "PySide6": {"ui"},
    "shiboken6": {"ui"},
    "sqlite3": {"store"},
    "sqlite_utils": {"store"},
    "requests": {"robots"},
    "urllib": {"robots"},
    "urllib3": {"robots"},
    "http": {"robots"},
    "socket": {"robots", "sd_notify"},
    "websocket": {"robots"},
    "websockets": {"robots"},
    "pyttsx3": {"robots"},
    "scipy": {"analysis"},
    "matplotlib": {"analysis"},
    "pandas": {"analysis"},
    "numpy": {"robots", "training", "analysis"},
    "numba": {"training"},
    "gymnasium": {"training"},
    "click": {"cli"},
    "rich": {"cli"},
}
"""What of the world outside belongs to some packages only; anything else may be imported anywhere."""

NEEDED = {"analysis": ("matplotlib", "scipy")}
"""Libraries without which a package cannot be imported, and which come with an extra only."""

LOADED_ANYWAY = {"urllib", "http", "socket", "click", "rich"}
"""Libraries load these on their own account, so having them in memory breaks no rule."""

BROUGHT_ALONG = {"store": {"numpy"}, "export": {"numpy"}, "training": {"sqlite3", "scipy"}}
"""The same in one package only: sqlite_utils looks for numpy, numba for scipy and for coverage, which keeps a
database."""


def modules(package: Path) -> Iterator[tuple[str, str, Path]]:
    """Every module of the package: its full name, its room, and its file."""
    for file in sorted(package.rglob("*.py")):
        parts = [package.name, *file.relative_to(package).with_suffix("").parts]
        name = ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
        yield name, parts[1] if parts[1] != "__init__" else package.name, file


def imported(module: str, file: Path) -> tuple[tuple[int, str], ...]:
    """Everything that a module imports, anywhere in it and by whatever means that can be read, and in which line."""
    return _imports(module if file.name == "__init__.py" else module.rpartition(".")[0], file.read_text("utf-8"))


@cache
def _imports(package: str, text: str) -> tuple[tuple[int, str], ...]:
    return tuple(_walk(package, ast.parse(text)))


def _walk(package: str, tree: ast.Module) -> Iterator[tuple[int, str]]:
    for node in ast.walk(tree):
        match node:
            case ast.Import(names=names):
                yield from ((node.lineno, alias.name) for alias in names)
            case ast.ImportFrom(module=source, names=names, level=level):
                above = ".".join(package.split(".")[: len(package.split(".")) + 1 - level]) if level else ""
                base = ".".join(part for part in (above, source) if part)
                yield from ((node.lineno, f"{base}.{alias.name}") for alias in names)
            case ast.Call(
                func=ast.Name(id="import_module" | "__import__") | ast.Attribute(attr="import_module"),
                args=[ast.Constant(value=str(name)), *_],
            ):
                yield node.lineno, name


def room_of(name: str, rooms: set[str]) -> str | None:
    """Return the room of this house that a name belongs to; what belongs to no room is the package's own."""
    first, _, rest = name.partition(".")
    if first != "kiosk":
        return None
    return rest.split(".")[0] if rest.split(".")[0] in rooms else "kiosk"


def breaches(package: Path) -> list[str]:
    """Every import that goes through a wall, in words."""
    found = []
    there = set(ROOMS) | {room for _, room, _ in modules(package)}
    for module, room, file in modules(package):
        if room not in ROOMS:
            found.append(f"{module}: the house has no room {room}")
            continue
        for line, name in imported(module, file):
            other = room_of(name, there)
            if other is not None and other not in {room, *ROOMS[room], *BELOW_ALL}:
                found.append(f"{module}:{line}: {room} may not know {other} ({name})")
            elif room not in OUTSIDE.get(name.split(".")[0], {room}):
                found.append(f"{module}:{line}: {name.split('.')[0]} does not belong in {room}")
    return found


def loaded_by(room: str) -> set[str]:
    """Return what is in memory once every module of a room has been imported by a fresh interpreter."""
    names = [name for name, of, _ in modules(PACKAGE) if of == room and not name.endswith("__main__")]
    program = (
        "import importlib, json, sys\n"
        f"for name in {names!r}: importlib.import_module(name)\n"
        "print(json.dumps(sorted(sys.modules)))"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=PACKAGE.parent, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return set(json.loads(done.stdout.splitlines()[-1]))


def test_no_import_goes_through_a_wall() -> None:
    assert breaches(PACKAGE) == []


@pytest.mark.parametrize("room", [room for room in ROOMS if room != "__main__"])
def test_a_room_in_memory_has_brought_nobody_along_whom_it_may_not_know(room: str) -> None:
    if room not in {of for _, of, _ in modules(PACKAGE)}:
        pytest.skip(f"the room {room} is not built yet")
    for library in NEEDED.get(room, ()):
        pytest.importorskip(library)
    known = {room, *ROOMS[room]}
    loaded = loaded_by(room)
    rooms = {name.split(".")[1] for name in loaded if name.startswith("kiosk.")}
    assert rooms <= known | BELOW_ALL
    outsiders = {name.split(".")[0] for name in loaded} & set(OUTSIDE) - LOADED_ANYWAY
    strangers = {name for name in outsiders if not OUTSIDE[name] & known}
    assert strangers <= BROUGHT_ALONG.get(room, set())


def test_the_way_to_the_first_screen_loads_nothing_that_is_slow_and_not_needed_yet() -> None:
    program = "import sys, kiosk.ui.app, kiosk.store.recorder; print(sorted(sys.modules))"
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=PACKAGE.parent, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    loaded = set(ast.literal_eval(done.stdout))
    slow = {"sqlite_utils", "requests", "numpy", "scipy", "matplotlib", "numba", "gymnasium", "pyttsx3"}
    assert loaded & slow == set()


def test_the_rooms_know_each_other_in_one_direction() -> None:
    """Whoever a room may know, may never know it back, at first hand or at second."""
    for room, known in ROOMS.items():
        for other in known:
            assert room not in ROOMS[other]
            assert ROOMS[other] <= known or room in {"__main__"}
    for one, another in (("robots", "store"), ("ui", "training"), ("ui", "analysis")):
        assert another not in ROOMS[one]
        assert one not in ROOMS[another]
    assert "analysis" not in ROOMS["training"]


def test_tests_of_quiet_rooms_open_no_window_either() -> None:
    tests = Path(__file__).parent
    for room in ("game", "assistance", "experiment", "study", "store", "export", "training"):
        for file in (tests / room).glob("**/*.py"):
            names = {name.split(".")[0] for _, name in imported(f"tests.{room}.{file.stem}", file)}
            assert not names & {"PySide6", "pytestqt"}, file


# The watchman is watched


@pytest.mark.parametrize(
    ("room", "planted", "cry"),
    [
        ("game", "import kiosk.assistance.policy", "game may not know assistance"),
        ("game", "from kiosk import experiment", "game may not know experiment"),
        ("assistance", "from kiosk.experiment.condition import Condition", "assistance may not know experiment"),
        ("assistance", "from ..experiment import condition", "assistance may not know experiment"),
        ("experiment", "def f():\n    from kiosk.store import recorder", "experiment may not know store"),
        (
            "experiment",
            "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    import kiosk.ui",
            "experiment may not know ui",
        ),
        ("store", "from kiosk.robots.embodiment import Embodiment", "store may not know robots"),
        ("robots", "import kiosk.store", "robots may not know store"),
        ("ui", "import kiosk.training", "ui may not know training"),
        ("training", "from kiosk.experiment import session", "training may not know experiment"),
        ("analysis", "import kiosk.ui", "analysis may not know ui"),
        ("analysis", "import kiosk.cli.main", "analysis may not know cli"),
        ("experiment", "import kiosk.__main__", "experiment may not know __main__"),
        ("game", "import sqlite3", "sqlite3 does not belong in game"),
        ("experiment", "import PySide6.QtCore", "PySide6 does not belong in experiment"),
        ("store", "from PySide6.QtCore import QObject", "PySide6 does not belong in store"),
        ("ui", "import sqlite3 as database", "sqlite3 does not belong in ui"),
        ("store", "import urllib.request", "urllib does not belong in store"),
        ("ui", "import requests", "requests does not belong in ui"),
        ("training", "import scipy.stats", "scipy does not belong in training"),
        ("store", "import click", "click does not belong in store"),
        ("game", "from importlib import import_module\nimport_module('numpy')", "numpy does not belong in game"),
        ("experiment", "import importlib\nimportlib.import_module('kiosk.ui.app')", "experiment may not know ui"),
        ("game", "__import__('kiosk.store')", "game may not know store"),
        ("attic", "", "the house has no room attic"),
    ],
)
def test_a_planted_import_is_found(tmp_path: Path, room: str, planted: str, cry: str) -> None:
    package = tmp_path / "kiosk"
    shutil.copytree(PACKAGE, package, ignore=shutil.ignore_patterns("__pycache__", "qml"))
    (package / room).mkdir(exist_ok=True)
    (package / room / "planted.py").write_text(planted)
    (found,) = set(breaches(package)) - set(breaches(PACKAGE))
    assert f"kiosk.{room}.planted" in found
    assert cry in found


def test_an_import_planted_below_all_is_found(tmp_path: Path) -> None:
    package = tmp_path / "kiosk"
    shutil.copytree(PACKAGE, package, ignore=shutil.ignore_patterns("__pycache__", "qml"))
    for name in ("__init__.py", "config.py"):
        with (package / name).open("a") as file:
            file.write("\nimport kiosk.game\n")
    assert [line.split(": ")[1] for line in breaches(package)] == [
        "kiosk may not know game (kiosk.game)",
        "config may not know game (kiosk.game)",
    ]
