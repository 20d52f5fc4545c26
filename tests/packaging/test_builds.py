"""The builds are made and started: what is in them plays the same session as the checkout, and speaks, and is kept up.

The slowest of all tests, half a minute and more. A pytest file rather than a step of the set-up, so that it runs alone.
"""

from __future__ import annotations

import ctypes
import json
import os
import shutil
import signal
import sqlite3
import subprocess
import sys
from contextlib import closing
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest

from kiosk import program
from kiosk.cli.composition import code_commit
from kiosk.store.queries import open_repository
from kiosk.training.native import COMPILER, SHIPPED
from tests.patience import PATIENCE_S, started
from tests.samples import WITH_PIN

ROOT = Path(__file__).parents[2]
LONG = 600

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="builds are tried on Linux only")


@pytest.fixture(scope="module")
def folder() -> Path:
    """Return the built folder, made anew."""
    _build("folder")
    return ROOT / "dist" / "recollect"


@pytest.fixture(scope="module")
def unpacked(folder: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the Debian package of that folder, unpacked and not installed."""
    assert folder.is_dir()
    dpkg = shutil.which("dpkg-deb")
    if dpkg is None:
        pytest.skip("there is no dpkg-deb here")
    _build("quick-deb")
    (package,) = (ROOT / "dist").glob("recollect_*.deb")
    place = tmp_path_factory.mktemp("deb")
    subprocess.run([dpkg, "-x", str(package), str(place)], check=True, timeout=PATIENCE_S)
    return place


def _build(kind: str) -> None:
    command = [sys.executable, "packaging/build.py", kind]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False, timeout=LONG)
    assert done.returncode == 0, done.stdout + done.stderr


def rehearse(command: tuple[str, ...], data: Path, *options: str) -> dict[str, Any]:
    """Return what a rehearsal tells, run far away from the checkout."""
    rehearsal = (*command, "rehearse", "--headless", "--seed", "7", "--data", str(data), "--json", *options)
    away = None if command[-1] == "kiosk" else data.parent
    done = subprocess.run(rehearsal, cwd=away, capture_output=True, text=True, check=False, timeout=LONG)
    assert done.returncode == 0, done.stderr
    told: dict[str, Any] = json.loads(done.stdout)
    return told


def test_a_built_folder_plays_the_very_session_that_the_checkout_plays(folder: Path, tmp_path: Path) -> None:
    study = tmp_path / "study.toml"
    study.write_text("[game]\nrows = 3\ncolumns = 4\n")
    built = rehearse((str(folder / "recollect"),), tmp_path / "built", "--study", str(study))
    checkout = rehearse(program(), tmp_path / "checkout", "--study", str(study))
    # The time of day is in the chain of hashes.
    assert built | {"record_sha256": ""} == checkout | {"record_sha256": ""}
    with open_repository(tmp_path / "built") as one, open_repository(tmp_path / "checkout") as other:
        assert one.events(1) == other.events(1)
    with closing(sqlite3.connect(tmp_path / "built" / "recollect.db")) as database:
        assert database.execute("SELECT code_commit FROM session").fetchone() == (code_commit(),)


@pytest.mark.parametrize(
    ("language", "speaker", "engine"),
    [
        ("en", "pico", "pico"),
        ("it", "", "pico"),
        ("es", "", "pico"),
        pytest.param(
            "en",
            "hibari",
            "hibari",
            marks=pytest.mark.skipif(find_spec("hibari") is None, reason="the extra natural is not installed"),
        ),
    ],
)
def test_the_voice_of_a_build_says_a_sentence_to_its_end(
    folder: Path, language: str, speaker: str, engine: str, tmp_path: Path
) -> None:
    manner = {"language": language, "speaker": speaker, "rate": 150, "volume": 0.5, "device": "null"}
    done = subprocess.run(
        [folder / "recollect", "_voice", json.dumps(manner)],
        input='{"say": 1, "text": "Pasta."}\n{"finish": true}\n',
        env=os.environ | {"XDG_CACHE_HOME": str(tmp_path)},
        capture_output=True,
        text=True,
        check=False,
        timeout=LONG,
    )
    events = [json.loads(line) for line in done.stdout.splitlines()]
    assert [event["event"] for event in events] == ["ready", "started", "finished"], done.stderr
    assert events[1]["by"]["engine"] == engine
    assert events[1]["by"]["engine_version"] != "unknown"


def test_a_command_that_needs_the_full_install_says_so_in_a_sentence(folder: Path, tmp_path: Path) -> None:
    figure = ("policy", "show", "default", "--figure", str(tmp_path / "figure.png"))
    done = subprocess.run([folder / "recollect", *figure], capture_output=True, text=True, check=False, timeout=LONG)
    assert done.returncode == 2
    assert done.stderr.startswith("recollect: figures need matplotlib")
    assert len(done.stderr.splitlines()) == 1


def test_an_unpacked_package_plays_a_session_by_its_name_on_the_path(unpacked: Path, tmp_path: Path) -> None:
    study = tmp_path / "study.toml"
    study.write_text('languages = ["en"]\nstages = ["introduction", "game", "result"]\n[game]\nrows = 2\ncolumns = 3\n')
    played = rehearse((str(unpacked / "usr/bin/recollect"),), tmp_path / "data", "--study", str(study))
    assert (played["status"], played["pairs"]) == ("completed", 3)


def test_a_build_keeps_itself_up(unpacked: Path, tmp_path: Path) -> None:
    """Every process that a build starts of itself must find the build's own libraries again."""
    study = tmp_path / "study.toml"
    study.write_text(WITH_PIN)
    command = [
        str(unpacked / "usr/bin/recollect"),
        "run",
        "--supervise",
        "--json",
        "--data",
        str(tmp_path),
        "--study",
        str(study),
    ]
    environment = os.environ | {"QT_QPA_PLATFORM": "offscreen"}
    with started(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as supervisor:
        assert supervisor.stdout is not None
        happenings = iter(supervisor.stdout)
        what = next(told["what"] for line in happenings if (told := json.loads(line))["what"] not in {"started"})
        supervisor.send_signal(signal.SIGTERM)
        assert (what, supervisor.wait(LONG)) == ("ready", 0)
        assert json.loads(list(happenings)[-1])["what"] == "told to end"


def test_a_package_holds_what_a_system_needs_to_start_it(unpacked: Path) -> None:
    files = {str(path.relative_to(unpacked)) for path in unpacked.rglob("*") if not path.is_dir()}
    assert {
        "usr/lib/systemd/user/recollect.service",
        "usr/lib/systemd/system/recollect-cage@.service",
        "usr/share/applications/recollect.desktop",
        "usr/share/icons/hicolor/scalable/apps/recollect.svg",
        "usr/share/man/man1/recollect.1.gz",
        "usr/bin/recollect-cage",
    } <= files
    assert os.access(unpacked / "usr/bin/recollect-cage", os.X_OK)


def test_a_build_and_its_package_hold_the_notices_of_what_they_ship(folder: Path, unpacked: Path) -> None:
    index = (folder / "third-party" / "NOTICES.md").read_text(encoding="utf-8")
    for shipped in (folder / "_internal").glob("*.dist-info"):
        name, version = shipped.stem.split("-")
        # A folder has underscores where the package's own name has hyphens.
        assert f"| {name} | {version} | ".replace("_", "-") in index.replace("_", "-")
    assert {"Python", "PySide6_Essentials", "python-xlib", "pyinstaller"} <= set(index.split())
    documents = unpacked / "usr/share/doc/recollect"
    assert (documents / "third-party" / "NOTICES.md").read_text(encoding="utf-8") == index
    assert (documents / "third-party" / "numpy" / "LICENSE.txt").is_file()
    assert not (unpacked / "usr/lib/recollect/third-party").exists()


def test_what_the_screens_do_not_use_is_not_in_a_build(folder: Path) -> None:
    qt = folder / "_internal" / "PySide6" / "Qt"
    modules = {module.name for module in (qt / "qml" / "QtQuick").iterdir() if module.is_dir()}
    assert "Shapes" in modules
    assert not modules & {"VirtualKeyboard", "Dialogs", "NativeStyle", "Scene2D", "Timeline"}
    assert not {file.name for file in qt.rglob("*")} & {"libQt6Designer.so.6", "libqsqlite.so", "libqgtk3.so"}
    assert not list(qt.rglob("*.qm"))


@pytest.mark.skipif(COMPILER is None, reason="there is no C compiler")
def test_a_build_brings_the_loops_of_training_compiled(folder: Path) -> None:
    loops = ctypes.CDLL(str(folder / "_internal" / "kiosk" / "training" / SHIPPED.name))
    assert hasattr(loops, "play_all")


def test_what_only_developers_use_is_not_in_a_build(folder: Path) -> None:
    viewer = (sys.executable, "-m", "PyInstaller.utils.cliutils.archive_viewer", "--list", "--recursive", "--brief")
    command = (*viewer, str(folder / "recollect"))
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=LONG)
    packages = {name.strip().partition(".")[0] for name in done.stdout.splitlines()}
    assert {"kiosk", "rich", "numpy"} <= packages
    assert not packages & {"pygments", "unittest", "numba", "matplotlib", "scipy", "pytest"}
