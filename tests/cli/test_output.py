"""What a terminal cannot print, or a closed pipe, never ends a command with a traceback."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from io import BytesIO, TextIOWrapper
from pathlib import Path

import pytest

from kiosk import DISK_FULL, program
from kiosk.cli.main import main
from kiosk.experiment.events import SessionStarted
from kiosk.experiment.session_config import SessionKind
from kiosk.store.recorder import Provenance, Recorder
from tests.samples import plan

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="pipes and devices as Unix has them")

TITLE = "Ein Gedächtnisspiel — 記憶"
ENCODINGS = ("ascii", "cp1252")


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a session."""
    folder = tmp_path_factory.mktemp("data")
    with Recorder(folder) as recorder:
        recorder.begin(Provenance(plan(), 1, "avatar", "abc123", kind=SessionKind.SIMULATED), [SessionStarted(at_ms=0)])
    return folder


@pytest.fixture(scope="module")
def study(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a study with a title that few terminals can print."""
    file = tmp_path_factory.mktemp("study") / "gedächtnis.toml"
    file.write_text(f'title = "{TITLE}"\n', encoding="utf-8")
    return file


def command(name: str, data: Path, study: Path) -> tuple[str, ...]:
    """Return a command that prints something."""
    return {
        "sessions": program("sessions", "--data", str(data)),
        "events": program("events", "1", "--data", str(data), "--json"),
        "study check": program("study", "check", str(study)),
        "study check --json": program("study", "check", str(study), "--json"),
        "help": program("--help"),
        "a refusal": program("study", "check", str(study.with_name("fehlt-記憶.toml"))),
    }[name]


@pytest.mark.parametrize("encoding", ENCODINGS)
@pytest.mark.parametrize("name", ["study check", "study check --json", "a refusal"])
def test_what_the_terminal_has_no_character_for_is_printed_all_the_same(
    name: str, encoding: str, data: Path, study: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out, err = (TextIOWrapper(BytesIO(), encoding) for _ in "oe")
    monkeypatch.setattr(sys, "argv", ["recollect", *command(name, data, study)[len(program()) :]])
    monkeypatch.setattr(sys, "stdout", out)
    monkeypatch.setattr(sys, "stderr", err)
    with pytest.raises(SystemExit) as ended:
        main()
    out.flush()
    err.flush()
    assert (ended.value.code or 0) == (2 if name == "a refusal" else 0)
    said = (err if name == "a refusal" else out).buffer
    assert isinstance(said, BytesIO)
    assert said.getvalue()
    if name == "study check --json":
        assert json.loads(said.getvalue())["title"] == TITLE


def test_a_refusal_is_printed_where_the_system_has_no_characters_but_ascii(data: Path, study: Path) -> None:
    environment = os.environ | {"PYTHONIOENCODING": "ascii", "PYTHONUTF8": "0", "LC_ALL": "C"}
    done = subprocess.run(command("a refusal", data, study), env=environment, capture_output=True, check=False)
    assert (done.returncode, b"Traceback" in done.stderr) == (2, False)


@pytest.mark.parametrize("name", ["sessions", "events", "help"])
def test_a_reader_who_goes_away_leaves_no_traceback(name: str, data: Path, study: Path) -> None:
    reads, writes = os.pipe()
    os.close(reads)
    done = subprocess.run(command(name, data, study), stdout=writes, stderr=subprocess.PIPE, text=True, check=False)
    os.close(writes)
    assert done.stderr == ""


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no device that is always full")
@pytest.mark.parametrize("name", ["sessions", "events", "help"])
def test_output_that_finds_no_room_ends_in_a_sentence(name: str, data: Path, study: Path) -> None:
    with Path("/dev/full").open("w", encoding="utf-8") as full:
        done = subprocess.run(command(name, data, study), stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert done.returncode == 1
    assert done.stderr == f"recollect: {DISK_FULL}\n"


def test_a_path_that_is_no_text_is_told_all_the_same(tmp_path: Path) -> None:
    strange = os.fsencode(tmp_path) + b"/\xe9"
    done = subprocess.run(
        [*map(os.fsencode, program("sessions", "--data")), strange], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (2, f"recollect: there is no database in {tmp_path}/\\udce9\n")
