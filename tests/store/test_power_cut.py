"""A little of ``tests.store.power_cut`` every time the tests run."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path
from random import Random

import pytest

from tests.store.recorded_disk import SECTOR, Entry, Kind, after_a_cut, read_log

CUTS = 8


@pytest.mark.skipif(sys.platform != "linux" or not shutil.which("mkfs.ext4"), reason="it is a disk of Linux")
def test_what_was_acknowledged_is_there_after_a_power_cut_and_the_next_start_goes_on(tmp_path: Path) -> None:
    from tests.store.power_cut import cut_power  # noqa: PLC0415 - what it measures is that of Linux

    try:
        tally = cut_power(CUTS, 3, 1, tmp_path)
    except (OSError, subprocess.CalledProcessError):
        pytest.skip("only root may mount a disk")
    assert tally.faults == []
    assert tally.cuts == CUTS
    assert tally.more["sessions that were gone on with"] > 0


OLD, NEW, NEWER = bytes(4 * SECTOR), b"n" * 2 * SECTOR, b"m" * SECTOR
UNFLUSHED = [Entry(Kind.WRITE, SECTOR, NEW), Entry(Kind.WRITE, 3 * SECTOR, NEWER)]


def test_a_cut_leaves_each_sector_old_or_new_and_every_kind_of_cut_comes() -> None:
    found = {bytes(after_a_cut(bytearray(OLD), UNFLUSHED, Random(seed))) for seed in range(200)}
    sectors = [{cut[start : start + SECTOR] for cut in found} for start in range(0, len(OLD), SECTOR)]
    old = bytes(SECTOR)
    assert sectors == [{old}, {old, NEW[:SECTOR]}, {old, NEW[:SECTOR]}, {old, NEWER}]
    assert len(found) == 2**3


def test_a_log_is_read_as_it_was_written(tmp_path: Path) -> None:
    log = tmp_path / "log"
    log.write_bytes(b"\x01" + (512).to_bytes(8, "little") + (3).to_bytes(4, "little") + b"abc" + b"\x02" + bytes(12))
    assert read_log(log) == [Entry(Kind.WRITE, 512, b"abc"), Entry(Kind.FLUSH, 0, b"")]
