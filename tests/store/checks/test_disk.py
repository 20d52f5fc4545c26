"""Whether the disk has room, is this user's alone and is fast enough; nothing is left on it."""

from __future__ import annotations

import os
import shutil
import sqlite3
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

import pytest

from kiosk.preflight import CheckResult, Severity
from kiosk.store import checks as store_checks
from kiosk.store.checks import SLOW_MS, STALL_MS, TIMES, access_check, free_space_check, write_speed_check, written_ms
from kiosk.store.maintenance import REFUSE_MIB, WARN_MIB
from kiosk.units import MIB


class Usage(NamedTuple):
    """What a file system says of itself, in bytes."""

    free: int


def failing(failure: Exception) -> Callable[[Path], Sequence[float]]:
    """Return a disk that fails."""

    def measure(_: Path) -> Sequence[float]:
        raise failure

    return measure


@pytest.mark.parametrize(
    ("free_mib", "state"),
    [(WARN_MIB, Severity.OK), (WARN_MIB - 1, Severity.WARNING), (REFUSE_MIB - 1, Severity.ERROR), (0, Severity.ERROR)],
)
def test_a_disk_is_warned_of_in_time_and_refused_before_it_is_full(
    free_mib: int, state: Severity, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(shutil, "disk_usage", lambda _: Usage(free_mib * MIB))
    (found,) = free_space_check(tmp_path / "data")
    assert (found.severity, str(free_mib) in found.message) == (state, True)


def test_a_disk_that_is_gone_is_bad(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def gone(_: Path) -> Usage:
        raise OSError(5, "Input/output error")

    monkeypatch.setattr(shutil, "disk_usage", gone)
    (found,) = free_space_check(tmp_path)
    assert (found.severity, "Input/output error" in found.message) == (Severity.ERROR, True)


def test_a_folder_that_others_can_look_into_is_told_of_with_the_command_that_closes_it(tmp_path: Path) -> None:
    tmp_path.chmod(0o755)
    (found,) = access_check(tmp_path)
    assert (found.severity, found.remedy) == (Severity.WARNING, f"chmod 700 {tmp_path}")
    tmp_path.chmod(0o700)
    (found,) = access_check(tmp_path)
    assert found.severity is Severity.OK


def test_a_folder_that_is_not_there_yet_is_well_and_is_not_made(tmp_path: Path) -> None:
    (found,) = access_check(tmp_path / "new" / "data")
    assert found.severity is Severity.OK
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_cannot_be_written_is_bad(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "access", lambda *_: False)
    (found,) = access_check(tmp_path)
    assert found.severity is Severity.ERROR


@pytest.mark.parametrize(
    ("times", "state"),
    [
        ([0.4] * 20, Severity.OK),
        ([0.4] * 19 + [STALL_MS], Severity.OK),
        ([0.4] * 19 + [STALL_MS + 1], Severity.WARNING),
        ([SLOW_MS + 0.1] * 20, Severity.WARNING),
    ],
)
def test_a_disk_that_would_be_felt_at_the_screen_is_told_of(
    times: list[float], state: Severity, tmp_path: Path
) -> None:
    (found,) = write_speed_check(tmp_path, lambda _: times)
    assert found.severity is state
    assert f"at most {max(times):.0f} ms" in found.message


@pytest.mark.parametrize(
    ("failure", "words"),
    [
        (OSError(28, "No space left on device"), "disk full"),
        (sqlite3.OperationalError("disk I/O error"), "disk I/O error"),
    ],
)
def test_a_disk_that_takes_no_record_is_bad(failure: Exception, words: str, tmp_path: Path) -> None:
    (found,) = write_speed_check(tmp_path, failing(failure))
    assert found.severity is Severity.ERROR
    assert words in found.message


def test_records_are_tried_on_the_same_disk_and_nothing_is_left(tmp_path: Path) -> None:
    assert len(written_ms(tmp_path)) == TIMES
    assert list(tmp_path.iterdir()) == []


def test_a_slow_disk_is_not_tried_to_the_end(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(store_checks, "LONGEST_S", 0)
    assert len(written_ms(tmp_path)) == 1


def test_what_a_look_that_was_cut_off_has_left_goes_and_what_is_under_way_stays(tmp_path: Path) -> None:
    left, fresh = tmp_path / ".recollect-check-old", tmp_path / ".recollect-check-new"
    for folder in (left, fresh):
        folder.mkdir()
        (folder / "records.db").touch()
    os.utime(left, times=(0, time.time() - 3600))
    (found,) = write_speed_check(tmp_path)
    assert isinstance(found, CheckResult)
    assert [each.name for each in tmp_path.iterdir()] == [fresh.name]
