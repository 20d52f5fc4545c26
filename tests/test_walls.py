"""The direction of imports between packages, in one table, and how large a module may be."""

from __future__ import annotations

import ast
import json
import re
import shutil
import subprocess
import sys
from collections.abc import Iterable, Iterator
from functools import cache
from importlib.util import find_spec
from pathlib import Path

import pytest

from tests.patience import PATIENCE_S
from tests.shared import made_once
from tests.test_prose import statements

PACKAGE = Path(__file__).parents[1] / "kiosk"

BELOW_ALL = {
    "kiosk",
    "errors",
    "config",
    "extensions",
    "files",
    "garbage",
    "language_codes",
    "lazy_dataclass",
    "places",
    "preflight",
    "units",
}
"""The package itself, user errors, the study file's types, extensions, whole files, Python's collector, language codes,
quickly loaded dataclasses, places of files, check results and units: every package may import them, and they import no
package."""

PACKAGES: dict[str, set[str]] = {
    "kiosk": set(),
    "errors": set(),
    "config": set(),
    "extensions": set(),
    "files": set(),
    "garbage": set(),
    "language_codes": set(),
    "lazy_dataclass": set(),
    "places": set(),
    "preflight": set(),
    "units": set(),
    "sd_notify": set(),
    "guard": {"sd_notify"},
    "supervisor": {"guard", "sd_notify"},
    "remote": {"game", "assistance", "experiment"},
    "game": set(),
    "assistance": {"game"},
    "experiment": {"game", "assistance"},
    "study": {"game", "assistance", "experiment"},
    "robots": {"game", "assistance", "experiment"},
    "store": {"game", "assistance", "experiment"},
    "export": {"game", "assistance", "experiment", "store"},
    "ui": {"game", "assistance", "experiment", "robots", "store", "sd_notify", "remote"},
    "training": {"game", "assistance"},
    "analysis": {"game", "assistance", "experiment", "robots", "store", "export", "training"},
    "cli": {
        *("game", "assistance", "experiment", "study", "robots", "store", "export", "ui", "training", "analysis"),
        *("guard", "supervisor", "sd_notify", "remote"),
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
    "http": {"robots", "remote"},
    "paho": {"remote"},
    "socket": {"robots", "sd_notify", "remote"},
    "websocket": {"robots"},
    "websockets": {"robots"},
    "pyttsx3": {"robots"},
    "pylsl": {"robots"},
    "scipy": {"analysis"},
    "matplotlib": {"analysis"},
    "pandas": {"analysis"},
    "numpy": {"assistance", "robots", "training", "analysis"},
    "av": {"ui"},
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

BROUGHT_ALONG = {"store": {"numpy"}, "training": {"sqlite3", "scipy"}}
"""The same in one package only: sqlite_utils looks for numpy, numba for scipy and for coverage, which keeps a
database."""

MOST_LINES = 500
"""How many lines a file of Python or QML may have."""
LONGER = {"experiment/events.py": "one small class for each kind of event, and all are imported by one name"}
"""The files that have more, each with the reason."""
DEEPEST = 3
"""How many names the longest name of a package has, such as kiosk.ui.screens."""


def modules(package: Path) -> Iterator[tuple[str, str, Path]]:
    """Every module of the package: its full name, its part, and its file."""
    for file in sorted(package.rglob("*.py")):
        parts = [package.name, *file.relative_to(package).with_suffix("").parts]
        name = ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
        yield name, parts[1] if parts[1] != "__init__" else package.name, file


def imported(module: str, file: Path) -> tuple[tuple[int, str], ...]:
    """Everything that a module imports, anywhere in it and by whatever means that can be read, and in which line."""
    return _imports(module if file.name == "__init__.py" else module.rpartition(".")[0], file.read_text("utf-8"))


@cache
def _imports(package: str, text: str) -> tuple[tuple[int, str], ...]:
    # Only a call that imports can be in an expression.
    nodes = ast.walk if re.search("import_module|__import__", text) else statements
    return tuple(_walk(package, nodes(ast.parse(text))))


def _walk(package: str, nodes: Iterable[ast.AST]) -> Iterator[tuple[int, str]]:
    for node in nodes:
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


def package_of(name: str, parts: set[str]) -> str | None:
    """Return the package that a name belongs to; what belongs to none is the top level's own."""
    first, _, rest = name.partition(".")
    if first != "kiosk":
        return None
    return rest.split(".")[0] if rest.split(".")[0] in parts else "kiosk"


def breaches(package: Path) -> list[str]:
    """Return every import that is not allowed, in words."""
    found = []
    there = set(PACKAGES) | {part for _, part, _ in modules(package)}
    for module, part, file in modules(package):
        if part not in PACKAGES:
            found.append(f"{module}: there is no package {part}")
            continue
        for line, name in imported(module, file):
            other = package_of(name, there)
            if other is not None and other not in {part, *PACKAGES[part], *BELOW_ALL}:
                found.append(f"{module}:{line}: {part} may not import {other} ({name})")
            elif part not in OUTSIDE.get(name.split(".")[0], {part}):
                found.append(f"{module}:{line}: {name.split('.')[0]} does not belong in {part}")
    return found


def oversized(package: Path) -> list[str]:
    """Return every file that is too long, every reason without one, and every package that is too deep, in words."""
    files = {file.relative_to(package).as_posix(): file for end in ("py", "qml") for file in package.rglob(f"*.{end}")}
    lengths = {name: len(file.read_text("utf-8").splitlines()) for name, file in files.items()}
    long = {name: lines for name, lines in lengths.items() if lines > MOST_LINES}
    depths = {name: len(Path(name).parts) for name in files if Path(name).name == "__init__.py"}
    return [
        *(
            f"{name} has {lines} lines: move a subject of it to another file"
            for name, lines in sorted(long.items())
            if name not in LONGER
        ),
        *(f"{name} is not too long any more: take it out of LONGER" for name in LONGER if name not in long),
        *(f"{name} is {depth} packages deep" for name, depth in sorted(depths.items()) if depth > DEEPEST),
    ]


LOADER = """
import importlib, json, os, sys
names, allowed = json.load(sys.stdin)

def in_a_copy(part):
    end, other = os.pipe()
    copy = os.fork()
    if copy:
        os.close(other)
        with open(end) as file:
            found = file.read()
        os.waitpid(copy, 0)
        return json.loads(found or "{}")
    os.close(end)
    for name in names[part]:
        importlib.import_module(name)
    found = {part: sorted(sys.modules)}
    for each in above.get(part, ()):
        found |= in_a_copy(each)
    with open(other, "w") as file:
        file.write(json.dumps(found))
    os._exit(0)

above = {}
for part in names:
    below = [each for each in names if each in allowed[part]]
    above.setdefault(below[-1] if below else None, []).append(part)
found = {}
for part in above[None]:
    found |= in_a_copy(part)
print(json.dumps(found))
"""
"""Prints the modules in memory by part. A part is imported in a copy of a process with a part that it may import."""


@pytest.fixture(scope="module")
def loaded(tmp_path_factory: pytest.TempPathFactory) -> dict[str, list[str]]:
    """Return what is in memory once every module of a part has been imported, for every part."""

    def make(folder: Path) -> None:
        names: dict[str, list[str]] = {part: [] for part in PACKAGES}
        for name, part, _ in modules(PACKAGE):
            if not name.endswith("__main__") and all(map(find_spec, NEEDED.get(part, ()))):
                names[part].append(name)
        given = json.dumps([names, {part: sorted(known) for part, known in PACKAGES.items()}])
        command = [sys.executable, "-c", LOADER]
        done = subprocess.run(
            command, cwd=PACKAGE.parent, input=given, capture_output=True, text=True, check=False, timeout=PATIENCE_S
        )
        assert (done.returncode, done.stderr) == (0, "")
        (folder / "loaded.json").write_text(done.stdout, "utf-8")

    found: dict[str, list[str]] = json.loads(
        (made_once(tmp_path_factory, "loaded", make) / "loaded.json").read_text("utf-8")
    )
    return found


def test_every_import_is_allowed() -> None:
    assert breaches(PACKAGE) == []


@pytest.mark.skipif(sys.platform == "win32", reason="a process cannot be copied there")
@pytest.mark.parametrize("part", [part for part in PACKAGES if part != "__main__"])
def test_a_part_loads_no_library_that_it_may_not_import(part: str, loaded: dict[str, list[str]]) -> None:
    for library in NEEDED.get(part, ()):
        pytest.importorskip(library)
    known = {part, *PACKAGES[part]}
    parts = {name.split(".")[1] for name in loaded[part] if name.startswith("kiosk.")}
    assert parts <= known | BELOW_ALL
    outsiders = {name.split(".")[0] for name in loaded[part]} & set(OUTSIDE) - LOADED_ANYWAY
    strangers = {name for name in outsiders if not OUTSIDE[name] & known}
    assert strangers <= BROUGHT_ALONG.get(part, set())


def test_the_way_to_the_first_screen_loads_nothing_that_is_slow_and_not_needed_yet() -> None:
    program = "import sys, kiosk.ui.app, kiosk.store.recorder; print(sorted(sys.modules))"
    done = subprocess.run(
        [sys.executable, "-c", program],
        cwd=PACKAGE.parent,
        capture_output=True,
        text=True,
        check=False,
        timeout=PATIENCE_S,
    )
    assert done.returncode == 0, done.stderr
    loaded = set(ast.literal_eval(done.stdout))
    slow = {"sqlite_utils", "requests", "numpy", "scipy", "matplotlib", "numba", "gymnasium", "pyttsx3"}
    assert loaded & slow == set()


def test_the_parts_import_each_other_in_one_direction() -> None:
    """What a part may import may never import it back, directly or through others."""
    for part, known in PACKAGES.items():
        for other in known:
            assert part not in PACKAGES[other]
            assert PACKAGES[other] <= known or part in {"__main__"}
    for one, another in (("robots", "store"), ("ui", "training"), ("ui", "analysis")):
        assert another not in PACKAGES[one]
        assert one not in PACKAGES[another]
    assert "analysis" not in PACKAGES["training"]


def test_no_module_is_too_long_and_no_package_too_deep() -> None:
    assert oversized(PACKAGE) == []


def test_tests_of_packages_without_windows_import_no_qt() -> None:
    tests = Path(__file__).parent
    for part in ("game", "assistance", "experiment", "study", "store", "export", "training"):
        for file in (tests / part).glob("**/*.py"):
            names = {name.split(".")[0] for _, name in imported(f"tests.{part}.{file.stem}", file)}
            assert not names & {"PySide6", "pytestqt"}, file


# The check itself is tested


@pytest.fixture(scope="module")
def empty(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the package with all its folders and modules, and nothing in them."""
    package = tmp_path_factory.mktemp("walls") / "kiosk"
    for _, _, file in modules(PACKAGE):
        copy = package / file.relative_to(PACKAGE)
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.touch()
    return package


@pytest.mark.parametrize(
    ("part", "planted", "cry"),
    [
        ("game", "import kiosk.assistance.policy", "game may not import assistance"),
        ("game", "from kiosk import experiment", "game may not import experiment"),
        ("assistance", "from kiosk.experiment.condition import Condition", "assistance may not import experiment"),
        ("assistance", "from ..experiment import condition", "assistance may not import experiment"),
        ("experiment", "def f():\n    from kiosk.store import recorder", "experiment may not import store"),
        (
            "experiment",
            "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    import kiosk.ui",
            "experiment may not import ui",
        ),
        ("store", "from kiosk.robots.embodiment import Embodiment", "store may not import robots"),
        ("robots", "import kiosk.store", "robots may not import store"),
        ("ui", "import kiosk.training", "ui may not import training"),
        ("training", "from kiosk.experiment import session", "training may not import experiment"),
        ("analysis", "import kiosk.ui", "analysis may not import ui"),
        ("analysis", "import kiosk.cli.main", "analysis may not import cli"),
        ("experiment", "import kiosk.__main__", "experiment may not import __main__"),
        ("game", "import sqlite3", "sqlite3 does not belong in game"),
        ("experiment", "import PySide6.QtCore", "PySide6 does not belong in experiment"),
        ("store", "from PySide6.QtCore import QObject", "PySide6 does not belong in store"),
        ("ui", "import sqlite3 as database", "sqlite3 does not belong in ui"),
        ("store", "import urllib.request", "urllib does not belong in store"),
        ("ui", "import requests", "requests does not belong in ui"),
        ("training", "import scipy.stats", "scipy does not belong in training"),
        ("store", "import click", "click does not belong in store"),
        ("game", "from importlib import import_module\nimport_module('numpy')", "numpy does not belong in game"),
        ("experiment", "import importlib\nimportlib.import_module('kiosk.ui.app')", "experiment may not import ui"),
        ("game", "__import__('kiosk.store')", "game may not import store"),
        ("attic", "", "there is no package attic"),
    ],
)
def test_a_planted_import_is_found(empty: Path, part: str, planted: str, cry: str) -> None:
    file = empty / part / "planted.py"
    file.parent.mkdir(exist_ok=True)
    file.write_text(planted)
    (found,) = breaches(empty)
    file.unlink()
    assert f"kiosk.{part}.planted" in found
    assert cry in found


def test_an_import_planted_below_all_is_found(tmp_path: Path) -> None:
    package = tmp_path / "kiosk"
    shutil.copytree(PACKAGE, package, ignore=shutil.ignore_patterns("__pycache__", "qml"))
    for name in ("__init__.py", "places.py"):
        with (package / name).open("a") as file:
            file.write("\nimport kiosk.game\n")
    assert [line.split(": ")[1] for line in breaches(package)] == [
        "kiosk may not import game (kiosk.game)",
        "places may not import game (kiosk.game)",
    ]


@pytest.mark.parametrize(
    ("name", "lines", "cry"),
    [
        ("game.py", MOST_LINES + 1, "game.py has 501 lines"),
        ("ui/qml/Main.qml", MOST_LINES + 1, "ui/qml/Main.qml has 501 lines"),
        ("ui/screens/shapes/__init__.py", 0, "ui/screens/shapes/__init__.py is 4 packages deep"),
        ("experiment/events.py", MOST_LINES, "experiment/events.py is not too long any more"),
    ],
)
def test_a_long_file_a_deep_package_and_a_reason_that_is_gone_are_found(
    tmp_path: Path, name: str, lines: int, cry: str
) -> None:
    sizes = {"game.py": MOST_LINES, "ui/screens/__init__.py": 1, **dict.fromkeys(LONGER, MOST_LINES + 1)}
    for each, size in {**sizes, name: lines}.items():
        file = tmp_path / each
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text("\n" * size)
    (found,) = oversized(tmp_path)
    assert found.startswith(cry)
