"""How much faster the power of a plan is on a Dask cluster with two workers than with one.

Run it alone, on a quiet machine of two cores or more: ``pytest tests/bench/test_power.py --benchmark-only -s``. The
speed-up must be at least 1.6; it is printed, and stands in ``extra_info`` of ``--benchmark-json``.
"""

from __future__ import annotations

import json
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

import pytest

from kiosk.analysis import power
from kiosk.analysis.plan import TEMPLATE
from tests.analysis.test_plan import job
from tests.patience import serving

STUDIES = 1_000


@pytest.mark.benchmark(group="power")
def test_two_workers_of_a_dask_cluster_are_faster_than_one(benchmark: Any, tmp_path: Path) -> None:
    plan = tmp_path / "plan.toml"
    plan.write_text(TEMPLATE)
    seconds = {workers: on_cluster(plan, tmp_path / str(workers), workers) for workers in (1, 2)}
    benchmark.extra_info |= {f"seconds of {workers}": round(each, 2) for workers, each in seconds.items()}
    benchmark.pedantic(lambda: None)
    speed_up = seconds[1] / seconds[2]
    print(f"{STUDIES} studies: {seconds[1]:.2f} s with one worker, {seconds[2]:.2f} s with two, {speed_up:.2f}")  # noqa: T201
    assert speed_up >= 1.6


def on_cluster(plan: Path, folder: Path, workers: int) -> float:
    """Return the seconds that a cluster takes for the studies, once every worker has imported and compiled all."""
    folder.mkdir()
    wanted, warm = job(plan, STUDIES, (56,)), job(plan, 400, (28,))
    with running_cluster(folder, workers) as host:
        power.run(warm, folder / "warm", scheduler=host)
        began = time.perf_counter()
        power.run(wanted, folder / "blocks", scheduler=host)
        return time.perf_counter() - began


@contextmanager
def running_cluster(folder: Path, workers: int) -> Iterator[str]:
    """Provide a Dask scheduler of this machine with so many workers; its address."""
    here = [sys.executable, "-m"]
    address = folder / "scheduler.json"
    scheduler = [*here, "distributed.cli.dask_scheduler", "--no-dashboard", "--host", "127.0.0.1", "--port", "0"]
    # No nanny: it would be one more process, and no worker is started again here.
    worker = [*here, "distributed.cli.dask_worker", "--no-dashboard", "--nthreads", "1", "--no-nanny"]
    with ExitStack() as stack:
        for words in (scheduler, *[worker] * workers):
            stack.enter_context(
                serving([*words, "--scheduler-file", str(address)], cwd=folder, stderr=subprocess.DEVNULL)
            )
            deadline = time.monotonic() + 180
            while not address.exists() and time.monotonic() < deadline:
                time.sleep(0.05)
        yield json.loads(address.read_text())["address"]
