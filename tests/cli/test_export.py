"""The command ``recollect export``, from the command line to the files."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from kiosk import UserInputError
from kiosk.cli.main import recollect
from kiosk.experiment.outcomes import SessionKind
from tests.export.conftest import rows_of
from tests.export.visitors import store, unsharing, visitor


@pytest.fixture
def data(tmp_path: Path) -> Path:
    """Return a data folder with one participant."""
    store(tmp_path / "data", [(visitor(1), 1)])
    return tmp_path / "data"


def run(*arguments: object) -> Result:
    return CliRunner().invoke(recollect, ["export", *map(str, arguments)])


def test_it_says_how_many_are_in_the_data_set(data: Path, tmp_path: Path) -> None:
    done = run("--data", data, "--out", tmp_path / "out")
    assert (done.exit_code, done.output) == (0, f"The data set in {tmp_path / 'out'} holds 1 session.\n")
    assert len(rows_of(tmp_path / "out", "participants")) == 1


def test_it_says_how_many_were_left_out(tmp_path: Path) -> None:
    store(tmp_path / "data", [(visitor(1), 1), (unsharing(2), 2)])
    done = run("--data", tmp_path / "data", "--out", tmp_path / "out")
    assert done.output.splitlines()[1:] == ["Left out, as their visitors did not agree to publishing: 1."]


def test_it_says_how_many_were_trials(tmp_path: Path) -> None:
    store(tmp_path / "data", [(visitor(1), 1)])
    store(tmp_path / "data", [(visitor(2), 2), (visitor(3), 3)], kind=SessionKind.TRIAL)
    done = run("--data", tmp_path / "data", "--out", tmp_path / "out")
    assert done.output.splitlines() == [
        f"The data set in {tmp_path / 'out'} holds 1 session.",
        "Left out, as no PIN was set, so that they were trials: 2.",
    ]
    done = run("--data", tmp_path / "data", "--out", tmp_path / "all", "--with-trials")
    assert done.output == f"The data set in {tmp_path / 'all'} holds 3 sessions.\n"


def test_it_tells_programs_the_same(data: Path, tmp_path: Path) -> None:
    done = run("--data", data, "--out", tmp_path / "out", "--json")
    assert json.loads(done.stdout) == {
        "out": str(tmp_path / "out"),
        "participants": 1,
        "not_shared": 0,
        "under_way": 0,
        "trials": 0,
    }


def test_every_extra_is_an_option(data: Path, tmp_path: Path) -> None:
    extras = ("--with-dates", "--with-rehearsals", "--with-trials", "--with-texts", "--with-unshared")
    assert run("--data", data, "--out", tmp_path / "out", *extras).exit_code == 0
    assert {"started_at", "simulated", "trial", "job"} <= set(rows_of(tmp_path / "out", "participants")[0])


def test_names_like_those_of_bids_are_an_option(data: Path, tmp_path: Path) -> None:
    assert run("--data", data, "--out", tmp_path / "out", "--bids").exit_code == 0
    assert (tmp_path / "out" / "sub-P0001" / "beh").is_dir()


def test_a_folder_that_is_not_empty_is_refused(data: Path, tmp_path: Path) -> None:
    done = run("--data", data, "--out", tmp_path)
    assert isinstance(done.exception, UserInputError)
    assert "is not empty" in str(done.exception)
