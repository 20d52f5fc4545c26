"""Copies that are carried away, and a copy that is looked into, from the command line."""

from __future__ import annotations

import json
import os
import signal
import socket
import sqlite3
import subprocess
import sys
from contextlib import closing
from pathlib import Path
from time import monotonic

import pytest
import requests
from click.testing import CliRunner

from kiosk import UserInputError, program
from kiosk.cli.main import recollect
from kiosk.store.database import FILE
from tests.export.visitors import store, visitor
from tests.patience import started

PATIENCE_S = 60


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a data folder with one participant."""
    place = tmp_path_factory.mktemp("booth") / "data"
    store(place, [(visitor(1), 1)])
    return place


def test_a_copy_elsewhere_is_said_to_be_read_back_with_its_hash(data: Path, tmp_path: Path) -> None:
    done = CliRunner().invoke(recollect, ["backup", "--data", str(data), "--to", str(tmp_path / "stick")])
    assert done.exit_code == 0, done.output
    assert "written and read back alike" in done.output
    told = CliRunner().invoke(recollect, ["backup", "--data", str(data), "--to", str(tmp_path / "stick"), "--json"])
    found = json.loads(told.stdout)
    assert (found["encrypted"], found["kept"]) == (False, 2)
    assert Path(found["backup"]).is_file()


def test_an_encrypted_copy_needs_a_place(data: Path) -> None:
    done = CliRunner().invoke(recollect, ["backup", "--data", str(data), "--encrypt-for", "age1x"])
    assert isinstance(done.exception, UserInputError)
    assert "name the place with --to" in str(done.exception)


def test_an_encrypted_copy_is_what_age_reads(data: Path, tmp_path: Path) -> None:
    pyrage = pytest.importorskip("pyrage")
    lab = pyrage.x25519.Identity.generate()
    command = ["backup", "--data", str(data), "--to", str(tmp_path), "--encrypt-for", str(lab.to_public()), "--json"]
    found = json.loads(CliRunner().invoke(recollect, command).stdout)
    assert found["encrypted"]
    assert pyrage.decrypt(Path(found["backup"]).read_bytes(), [lab]).startswith(b"SQLite format 3")


@pytest.mark.skipif(sys.platform == "win32", reason="Ctrl+C is another thing there")
def test_a_verified_copy_is_browsed_on_this_machine_alone_and_removed_at_the_end(data: Path, tmp_path: Path) -> None:
    pytest.importorskip("datasette")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    command = program("browse", "--data", str(data), "--port", str(port))
    environment = os.environ | {"TMPDIR": str(tmp_path)}
    before = (data / FILE).read_bytes()
    with started(
        command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, start_new_session=True
    ) as browsing:
        deadline = monotonic() + PATIENCE_S
        page = f"http://127.0.0.1:{port}/recollect"
        while True:
            assert browsing.poll() is None
            assert monotonic() < deadline
            try:
                rows = requests.get(f"{page}/session.json?_shape=array", timeout=PATIENCE_S).json()
                break
            except requests.ConnectionError:
                continue
        assert len(rows) == 1
        assert requests.get(f"{page}.db", timeout=PATIENCE_S).status_code == 403
        refused = requests.get(f"{page}.json?sql=delete+from+session", timeout=PATIENCE_S).json()
        assert "SELECT" in refused["error"]
        os.killpg(browsing.pid, signal.SIGINT)
        assert browsing.wait(PATIENCE_S) == 0
    assert list(tmp_path.iterdir()) == []
    assert (data / FILE).read_bytes() == before


def test_a_database_that_is_not_as_it_was_written_is_not_browsed(tmp_path: Path) -> None:
    pytest.importorskip("datasette")
    store(tmp_path / "data", [(visitor(1), 1)])
    with closing(sqlite3.connect(tmp_path / "data" / FILE)) as connection, connection:
        triggers = connection.execute("SELECT name FROM sqlite_master WHERE type = 'trigger'").fetchall()
        for (name,) in triggers:
            connection.execute(f"DROP TRIGGER {name}")
        connection.execute("UPDATE event SET at_ms = at_ms + 5000 WHERE seq = 3")
    done = CliRunner().invoke(recollect, ["browse", "--data", str(tmp_path / "data")])
    assert isinstance(done.exception, UserInputError)
    assert "is not as it was written" in str(done.exception)
