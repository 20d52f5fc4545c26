"""One virtual environment with the packages of a lab, a study that uses all of them, and a session of it."""

from __future__ import annotations

import csv
import json
import os
import shutil
import subprocess
import sys
import sysconfig
import venv
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import pytest

from kiosk import UserInputError
from kiosk.assistance.policy import find_action
from kiosk.extensions import installed, registered_entries
from kiosk.study.new import TEMPLATES
from tests.forked import ROOT, LoadedProgram
from tests.shared import made_once

PLUGINS = Path(__file__).parent
PACKAGES = {
    "encourage": PLUGINS / "encourage",
    **{name: TEMPLATES / "packages" / "packages" / name for name in ("printing_robot", "ranking")},
}
"""Two of them come with the template of a study that needs them."""

QUESTIONS = """\
id = "helpers"
version = "1"
note = "our own"

[[items]]
id = "H1"
kind = "ranking"
text.en = "Who would you like to play with?"
counted = "robot"
options = [
    { id = "robot", text.en = "a robot" },
    { id = "person", text.en = "a person" },
    { id = "alone", text.en = "nobody" },
]
"""


@dataclass(frozen=True)
class Lab:
    """A virtual environment that sees the libraries and the source of this one, and has packages of its own."""

    python: Path
    site: Path
    """The folder in which its packages are installed."""
    loaded: LoadedProgram | None = None
    """The program as it has been loaded there."""

    def recollect(self, *arguments: object, more: Path | None = None) -> subprocess.CompletedProcess[str]:
        """Run the command in it; ``more`` is a folder with further packages."""
        environment = os.environ | {"QT_QPA_PLATFORM": "offscreen", "QT_QUICK_BACKEND": "software"}
        words = list(map(str, arguments))
        if more is None:
            assert self.loaded is not None
            return self.loaded.run(words, ROOT, environment)
        return subprocess.run(
            [self.python, "-m", "kiosk", *words],
            env=environment | {"PYTHONPATH": str(more)},
            capture_output=True,
            encoding="utf-8",
            timeout=240,
            check=False,
        )

    def json(self, *arguments: object) -> Any:
        """Run a command that works, and return what it prints as JSON."""
        called = self.recollect(*arguments, "--json")
        assert called.returncode == 0, called.stderr
        return json.loads(called.stdout)


@pytest.fixture(scope="session")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Lab]:
    """Provide the environment with the three packages, installed as pip does it without a network."""
    made = lab_in(made_once(tmp_path_factory, "lab", make_lab))
    with LoadedProgram(python=made.python) as program:
        yield replace(made, loaded=program)


def lab_in(folder: Path) -> Lab:
    """Return the environment of a folder."""
    scripts = folder / "venv" / ("Scripts" if os.name == "nt" else "bin")
    found = sysconfig.get_path("purelib", "venv", {"base": str(folder / "venv"), "platbase": str(folder / "venv")})
    return Lab(scripts / "python", Path(found))


def make_lab(folder: Path) -> None:
    """Make the environment in a folder, and install the packages."""
    venv.create(folder / "venv", with_pip=False, symlinks=os.name != "nt")
    made = lab_in(folder)
    beneath = (str(PLUGINS.parents[1]), sysconfig.get_path("purelib"))
    lines = "".join(f"import site; site.addsitedir({place!r})\n" for place in beneath)
    (made.site / "beneath.pth").write_text(lines, "utf-8")
    for name, source in PACKAGES.items():
        shutil.copytree(source, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
    pip = [sys.executable, "-m", "pip", "--python", str(made.python), "install", "--quiet"]
    offline = ["--no-index", "--no-deps", "--no-build-isolation"]
    subprocess.run([*pip, *offline, *(str(folder / name) for name in PACKAGES)], check=True, timeout=240)


@dataclass(frozen=True)
class Day:
    """A session of a study that uses all three packages, and its data set."""

    study: Path
    data: Path
    dataset: Path
    played: dict[str, Any]
    """What the rehearsal said of the session."""
    said: tuple[str, ...]
    """What the robot printed."""

    def rows(self, table: str) -> Iterator[dict[str, str]]:
        """Yield the rows of a table of the data set."""
        (file,) = self.dataset.glob(f"data/*{table}_data.csv")
        with file.open(encoding="utf-8-sig", newline="") as open_file:
            yield from csv.DictReader(open_file)

    def codebook(self, table: str) -> str:
        """Return the codebook of a table of the data set."""
        (file,) = self.dataset.glob(f"data/*{table}_data.json")
        return file.read_text("utf-8")


@pytest.fixture(scope="session")
def day(lab: Lab, tmp_path_factory: pytest.TempPathFactory) -> Day:
    """Provide a day of the template that needs packages, with a table that was trained with the action."""
    folder = made_once(tmp_path_factory, "day", lambda empty: make_day(lab, empty))
    played = json.loads((folder / "played.json").read_text("utf-8"))
    said = tuple(json.loads((folder / "said.json").read_text("utf-8")))
    return Day(folder / "own" / "study.toml", folder / "data", folder / "set", played, said)


def make_day(lab: Lab, folder: Path) -> None:
    """Train a table, play a session with it, and export the session.

    After so few games the table still takes the action often.
    """
    study, data, dataset = folder / "own" / "study.toml", folder / "data", folder / "set"
    made = lab.recollect("study", "new", study.parent, "--template", "packages")
    assert made.returncode == 0, made.stderr
    trained = lab.recollect("train", "--action", "encourage", "--episodes", 100, "--out", study.parent / "enc.json")
    assert trained.returncode == 0, trained.stderr
    text = study.read_text("utf-8").replace("delay_ms = 500", "delay_ms = 1")
    study.write_text(text.replace("[assistance]", '[assistance]\npolicy = "enc.json"'), "utf-8")
    rehearsed = lab.recollect("rehearse", "--headless", "--json", "--seed", 1, "--study", study, "--data", data)
    assert rehearsed.returncode == 0, rehearsed.stderr
    exported = lab.recollect("export", "--out", dataset, "--data", data, "--with-rehearsals")
    assert exported.returncode == 0, exported.stderr
    said = [line for line in rehearsed.stderr.splitlines() if line.startswith("robot: ")]
    (folder / "played.json").write_text(rehearsed.stdout, "utf-8")
    (folder / "said.json").write_text(json.dumps(said), "utf-8")


@pytest.fixture(scope="session")
def added(lab: Lab, day: Day, tmp_path_factory: pytest.TempPathFactory) -> dict[str, tuple[str, str]]:
    """Return what `recollect check` says of everything that it lists: how it is, and in which words."""

    def check(folder: Path) -> None:
        checked = lab.recollect("check", "--json", "--study", day.study, "--data", folder / "data")
        (folder / "checked.json").write_text(checked.stdout, "utf-8")

    told = made_once(tmp_path_factory, "checked", check) / "checked.json"
    results = json.loads(told.read_text("utf-8"))["results"]
    return {result["name"]: (result["severity"], result["message"]) for result in results}


def assert_refused(load: Callable[[], object], what: str, why: str) -> None:
    """Check that a broken extension of the package a-lab is refused, with its name and the reason."""
    with pytest.raises(UserInputError) as refused:
        load()
    assert str(refused.value).startswith(f"{what} of the package a-lab 0.1 cannot be used: ")
    assert why in str(refused.value)


Beside = Callable[[Path], None]


@pytest.fixture
def beside(monkeypatch: pytest.MonkeyPatch) -> Iterator[Beside]:
    """Make the robots and actions of a folder known in this process; kinds of items are read when it starts."""
    before = set(sys.modules)

    def put(folder: Path) -> None:
        monkeypatch.syspath_prepend(str(folder))
        registered_entries.cache_clear()
        installed.cache_clear()
        find_action.cache_clear()

    yield put
    monkeypatch.undo()
    for name in set(sys.modules) - before:
        if name.partition(".")[0] in {"a_lab", "printing_robot", "recollect_encourage"}:
            del sys.modules[name]
    registered_entries.cache_clear()
    installed.cache_clear()
    find_action.cache_clear()


Register = Callable[..., Path]


@pytest.fixture
def register(tmp_path: Path) -> Register:
    """Write the metadata and the modules of a made-up package, as an installer leaves them."""

    def write(package: str, group: str, entries: dict[str, str], **modules: str) -> Path:
        folder = tmp_path / "packages"
        info = folder / f"{package.replace('-', '_')}-0.1.dist-info"
        info.mkdir(parents=True)
        (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {package}\nVersion: 0.1\n", "utf-8")
        lines = "".join(f"{name} = {place}\n" for name, place in entries.items())
        (info / "entry_points.txt").write_text(f"[{group}]\n{lines}", "utf-8")
        for name, text in modules.items():
            (folder / f"{name}.py").write_text(text, "utf-8")
        return folder

    return write


@pytest.fixture
def refusal(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Callable[[Path], str]:
    """Why `recollect study check` refuses a file in this process: the one sentence that it says."""

    def refused(file: Path) -> str:
        from kiosk.cli.main import main  # noqa: PLC0415 - importing it takes a second that most tests do not need

        monkeypatch.setattr(sys, "argv", ["recollect", "study", "check", str(file)])
        with pytest.raises(SystemExit) as left:
            main()
        (sentence,) = capsys.readouterr().err.splitlines()
        assert left.value.code == 2
        return str(sentence)

    return refused


@pytest.fixture(scope="session")
def documented() -> Callable[[str, str], bool]:
    """Whether docs/how-to/extend.md shows a file of a package as it is installed here."""
    page = (PLUGINS.parents[1] / "docs" / "how-to" / "extend.md").read_text("utf-8")
    return lambda package, file: (PACKAGES[package] / file).read_text("utf-8") in page
