"""What many stored sessions cost: what a booth waits for does not grow with them, the rest grows in step.

RECOLLECT_BENCH_SESSIONS names other numbers of sessions, such as 1000,5000.
"""

from __future__ import annotations

import os
import shutil
import sqlite3
from contextlib import closing
from datetime import datetime
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from kiosk.cli.main import recollect
from kiosk.experiment.outcomes import SessionKind
from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import PsychDs
from kiosk.store.database import FILE
from kiosk.store.merge import merge
from kiosk.store.recorder import Recorder
from kiosk.store.snapshot import read_snapshot
from kiosk.store.verify import verify
from kiosk.store.withdrawal import withdraw
from tests.bench.large_store import fill

SIZES = [int(number) for number in os.environ.get("RECOLLECT_BENCH_SESSIONS", "100,1000").split(",")]
KIND = SessionKind.STUDY


@pytest.fixture(scope="module", params=SIZES, ids=lambda number: f"{number} sessions")
def stored(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a data folder with this many sessions."""
    folder = tmp_path_factory.mktemp("large") / "data"
    fill(folder, request.param)
    return folder


def middle(folder: Path) -> int:
    """Return the session in the middle."""
    with closing(sqlite3.connect(folder / FILE)) as connection:
        return int(connection.execute("SELECT max(session) / 2 FROM participant").fetchone()[0])


def copied(stored: Path, to: Path) -> Path:
    """Return a copy of a data folder, in the place of one that is there."""
    shutil.rmtree(to, ignore_errors=True)
    to.mkdir()
    shutil.copy(stored / FILE, to / FILE)
    return to


def test_opening_the_store(benchmark: Any, stored: Path) -> None:
    benchmark.pedantic(lambda: Recorder(stored).__exit__(None, None, None), rounds=20, warmup_rounds=2)


def test_the_next_slot(benchmark: Any, stored: Path) -> None:
    with Recorder(stored) as recorder:
        slot = benchmark.pedantic(recorder.next_slot, kwargs={"kind": KIND}, rounds=50, warmup_rounds=2)
    assert slot is not None


def test_the_panel(benchmark: Any, stored: Path) -> None:
    now = datetime.now().astimezone()
    seen = benchmark.pedantic(read_snapshot, (stored, now), {"kind": KIND}, rounds=20, warmup_rounds=2)
    assert len(seen.sessions) == 8


@pytest.mark.parametrize("options", [(), ("--all",)], ids=["first page", "all"])
def test_the_list_of_sessions(benchmark: Any, stored: Path, options: tuple[str, ...]) -> None:
    words = ["sessions", "--data", str(stored), *options]
    assert benchmark.pedantic(CliRunner().invoke, (recollect, words), rounds=2, warmup_rounds=1).exit_code == 0


def test_verifying(benchmark: Any, stored: Path) -> None:
    assert benchmark.pedantic(verify, (stored,), rounds=2) == []


def test_withdrawing(benchmark: Any, stored: Path, tmp_path: Path) -> None:
    def again() -> tuple[tuple[Path, int], dict[str, str]]:
        folder = copied(stored, tmp_path / "copy")
        return (folder, middle(folder)), {}

    benchmark.pedantic(withdraw, setup=again, rounds=2)


def test_merging(benchmark: Any, stored: Path, tmp_path: Path) -> None:
    def again() -> tuple[tuple[list[Path], Path], dict[str, str]]:
        shutil.rmtree(tmp_path / "all", ignore_errors=True)
        return ([stored], tmp_path / "all"), {}

    benchmark.pedantic(merge, setup=again, rounds=2)


@pytest.mark.parametrize("processes", [1, 2], ids=["one process", "two processes"])
def test_exporting(benchmark: Any, stored: Path, tmp_path: Path, processes: int) -> None:
    def again() -> tuple[tuple[Path, Path, Any, frozenset[Any]], dict[str, str]]:
        shutil.rmtree(tmp_path / "set", ignore_errors=True)
        return (stored, tmp_path / "set", PsychDs, frozenset()), {}

    benchmark.pedantic(partial(export_dataset, processes=processes), setup=again, rounds=1)
