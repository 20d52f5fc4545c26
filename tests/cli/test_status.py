"""``recollect status``: how the booth is, from the file that a running kiosk writes."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from kiosk import UserInputError
from kiosk.cli.main import recollect
from kiosk.experiment.booth_status import CLOSED, FILE, BoothStatus, EndedSession, PartStatus
from tests.samples import STATUS

Show = Callable[..., Result]


@pytest.fixture
def show(tmp_path: Path) -> Show:
    """Call the command for a status that was written so many seconds ago."""

    def call(status: BoothStatus, ago_s: float, *options: str) -> Result:
        at = (datetime.now(UTC) - timedelta(seconds=ago_s)).isoformat()
        (tmp_path / FILE).write_text(replace(status, at=at).to_json(), "utf-8")
        return CliRunner().invoke(recollect, ["status", "--data", str(tmp_path), *options])

    return call


def test_a_booth_that_is_well_ends_with_0(show: Show) -> None:
    done = show(replace(STATUS, ended=(EndedSession(STATUS.at, "aborted", "game"),)), 1)
    assert done.exit_code == 0
    assert "OK    kiosk       attract since" in done.output
    assert "OK    voice       wörds" in done.output
    assert "aborted in game" in done.output


def test_a_part_that_is_not_well_ends_with_1(show: Show) -> None:
    done = show(replace(STATUS, parts=(PartStatus("robot", ok=False, message="gone\x1b[2J"),)), 1)
    assert (done.exit_code, "WARN  robot       gone\\x1b[2J" in done.output) == (1, True)


def test_a_kiosk_that_is_silent_or_closed_ends_with_3(show: Show) -> None:
    silent, closed = show(STATUS, 60), show(replace(STATUS, stage=CLOSED), 1)
    assert (silent.exit_code, "FAIL  kiosk       silent since 1 min" in silent.output) == (3, True)
    assert (closed.exit_code, "FAIL  kiosk       closed" in closed.output) == (3, True)


def test_programs_get_all_of_it(show: Show) -> None:
    told = json.loads(show(STATUS, 2, "--json").output)
    assert (told["alive"], told["format"], told["parts"][0]["name"]) == (True, "recollect-status-1", "voice")


@pytest.mark.parametrize("text", [None, "{"])
def test_a_folder_without_a_status_is_refused_in_one_sentence(text: str | None, tmp_path: Path) -> None:
    if text is not None:
        (tmp_path / FILE).write_text(text)
    with pytest.raises(UserInputError, match=r"no kiosk has run|cannot be read: it is not of the format"):
        CliRunner().invoke(recollect, ["status", "--data", str(tmp_path)], catch_exceptions=False)
