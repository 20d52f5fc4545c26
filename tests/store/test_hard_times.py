"""A little of ``tests.store.hard_times`` every time the tests run."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="limits and mounts are those of Linux")

if sys.platform == "linux":
    from tests.store.hard_times import full_disks, kills, opens


def test_a_writer_that_is_killed_inside_a_checkpoint_loses_nothing_and_its_folder_is_never_refused(
    tmp_path: Path,
) -> None:
    tally = kills(8, 1, tmp_path)
    assert tally.faults == []
    assert tally.more["killed inside"] == 8
    assert tally.more["that only the log makes whole"] > 0
    assert tally.acknowledged > 0


def test_a_reader_beside_a_writer_that_makes_checkpoints_sees_all_that_was_acknowledged(tmp_path: Path) -> None:
    tally = opens(300, 1, tmp_path)
    assert tally.faults == []
    assert tally.acknowledged > 0


def test_a_full_disk_is_called_one_and_all_is_well_when_there_is_room_again(tmp_path: Path) -> None:
    try:
        tally = full_disks(2, 1, tmp_path, commands=False)
    except (OSError, subprocess.CalledProcessError):
        pytest.skip("only root may mount a small disk")
    assert tally.faults == []
    assert tally.more["times that a full disk was named"] > 0
