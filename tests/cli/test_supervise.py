"""``recollect run --supervise`` with the real kiosk, on no screen: it comes back, says so, and ends as it should."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from kiosk import UserInputError, program
from kiosk.cli.main import recollect
from tests.patience import PATIENCE_S, Program, started
from tests.samples import WITH_PIN

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="it looks for processes as Linux shows them")


class Kept:
    """A supervisor at work."""

    def __init__(self, process: Program) -> None:
        self.process = process

    def wait_for(self, what: str) -> dict[str, Any]:
        """Return the next happening of this kind; fails if the supervisor ends before."""
        for line in self.process.stdout:
            happening: dict[str, Any] = json.loads(line)
            if happening["what"] == what:
                return happening
        pytest.fail(f"the supervisor ended without {what!r}")

    def kiosk(self) -> int:
        """Return the process of the kiosk."""
        own = Path(f"/proc/{self.process.pid}/task/{self.process.pid}/children").read_text().split()
        return next(int(child) for child in own if b"\0--unattended\0" in Path(f"/proc/{child}/cmdline").read_bytes())


@contextmanager
def kept(data: Path, *options: str, before: tuple[str, ...] = ()) -> Iterator[Kept]:
    """Provide a supervisor with this data folder and these options; ``before`` is a command that starts it."""
    command = (*before, *program("run", "--supervise", "--json", "--data", str(data), *options))
    environment = os.environ | {"QT_QPA_PLATFORM": "offscreen"}
    with started(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as one:
        try:
            yield Kept(one)
        finally:
            one.terminate()


def test_a_kiosk_that_was_killed_is_back_and_the_log_says_what_happened(tmp_path: Path) -> None:
    study = tmp_path / "study.toml"
    study.write_text(WITH_PIN)
    with kept(tmp_path, "--study", str(study)) as supervisor:
        supervisor.wait_for("ready")
        os.kill(supervisor.kiosk(), signal.SIGKILL)
        assert supervisor.wait_for("died")["detail"] == "signal 9"
        again = supervisor.wait_for("ready")
        assert (again["start"], again["away_s"] > 0) == (2, True)
        assert supervisor.wait_for("shows")["detail"] == "attract"
        supervisor.process.send_signal(signal.SIGTERM)
        supervisor.wait_for("told to end")
        assert supervisor.process.wait(20) == 0
    log = (tmp_path / "recollect.log").read_text().splitlines()
    # What the kiosk itself logs depends on the machine: whether it has a bus, say.
    died, ready = (line for line in log if "kiosk.cli.run" in line)
    assert died.endswith("WARNING kiosk.cli.run: start 1 of the kiosk: died: signal 9")
    assert "WARNING kiosk.cli.run: start 2 of the kiosk: ready (" in ready


def test_a_study_file_that_cannot_be_used_ends_the_supervisor_in_words(tmp_path: Path) -> None:
    with kept(tmp_path, "--study", str(tmp_path / "none.toml")) as supervisor:
        supervisor.wait_for("refused")
        _, said = supervisor.process.communicate()
        assert supervisor.process.returncode == 2
    assert "none.toml cannot be read: No such file or directory" in said
    assert said.splitlines()[-1] == "recollect: the kiosk refused what it was given, so it is not started again"


def test_a_data_folder_that_cannot_be_used_is_said_before_anything_is_started(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    study = tmp_path / "study.toml"
    study.write_text(WITH_PIN)
    command = program("run", "--supervise", "--data", str(tmp_path / "file"), "--study", str(study))
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=PATIENCE_S)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == f"recollect: the data folder {tmp_path / 'file'} cannot be used: File exists\n"


def test_a_disk_that_takes_nothing_does_not_end_the_supervisor(tmp_path: Path) -> None:
    # No file may grow beyond a few bytes, so the kiosk starts and cannot make its database.
    limit = "import os, resource as r, sys; r.setrlimit(r.RLIMIT_FSIZE, (64, 64)); os.execv(sys.argv[1], sys.argv[1:])"
    study = tmp_path / "study.toml"
    study.write_text(WITH_PIN)
    with kept(tmp_path, "--study", str(study), before=(sys.executable, "-c", limit)) as supervisor:
        assert supervisor.wait_for("died")["detail"] == "exit code 1"
        assert supervisor.wait_for("died")["start"] == 2


@pytest.mark.parametrize("study", ["", "[experimenter]\nbackups = 3\n", None], ids=["empty", "no PIN", "no file"])
def test_a_study_without_a_pin_is_not_kept_up(study: str | None, tmp_path: Path) -> None:
    file = tmp_path / "study.toml"
    file.write_text(study or "")
    options = () if study is None else (f"--study={file}", "--window")
    data = tmp_path / "data"
    refused = CliRunner().invoke(recollect, ["run", "--supervise", "--data", str(data), *options])
    assert isinstance(refused.exception, UserInputError)
    (said,) = refused.exception.sentences
    assert (said.startswith("no PIN is set, so the kiosk is not started unattended: "), refused.output) == (True, "")
    assert "recollect study set-pin" in said
    assert not data.exists()


def test_a_kiosk_that_is_started_again_unattended_needs_its_pin_still(tmp_path: Path) -> None:
    """The study file may have changed since the supervisor looked at it."""
    command = program("run", "--unattended", "--data", str(tmp_path / "data"))
    done = subprocess.run(
        command,
        env=os.environ | {"QT_QPA_PLATFORM": "offscreen"},
        capture_output=True,
        text=True,
        check=False,
        timeout=PATIENCE_S,
    )
    assert (done.returncode, "recollect study set-pin" in done.stderr) == (2, True)
    assert not (tmp_path / "data").exists()
