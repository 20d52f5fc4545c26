"""How long it takes until an event is on the disk, beside what the disk itself takes."""

from __future__ import annotations

import os
import sqlite3
from contextlib import closing
from pathlib import Path
from statistics import quantiles
from time import perf_counter
from typing import Any

from kiosk.experiment.events import CardFlipped, CardSelected, SessionStarted
from kiosk.experiment.outcomes import SessionKind
from kiosk.game import Position
from kiosk.store.database import FILE as DATABASE
from kiosk.store.recorder import Provenance, Recorder
from tests.bench.percentiles import tell_percentiles
from tests.samples import plan

ROUNDS = 600
A_TAP = [
    CardSelected(at_ms=1, position=Position(1, 2)),
    CardFlipped(at_ms=1, number=1, move=1, position=Position(1, 2), card="owl", matched=None),
]
A_LINE = b'{"seq":1,"at_ms":1,"origin":"world","type":"CardSelected","position":{"row":1,"column":2}}\n' * 2


def test_durable_event(benchmark: Any, tmp_path: Path) -> None:
    """A tap and the flip that follows from it, in one transaction."""
    with Recorder(tmp_path) as recorder:
        recorder.begin(Provenance(plan(), 1, "avatar", "abc123", kind=SessionKind.SIMULATED), [SessionStarted(at_ms=0)])
        benchmark.pedantic(recorder.append, args=(A_TAP,), rounds=ROUNDS, warmup_rounds=20)
    tell_percentiles(benchmark)


def test_durable_event_beside_a_bare_commit(benchmark: Any, tmp_path: Path) -> None:
    """The same tap, in turns with a commit of the same bytes to a table without any index, key or check."""
    with Recorder(tmp_path) as recorder, closing(sqlite3.connect(tmp_path / "bare.db", isolation_level=None)) as bare:
        recorder.begin(Provenance(plan(), 1, "avatar", "abc123", kind=SessionKind.SIMULATED), [SessionStarted(at_ms=0)])
        recorder.append(A_TAP)
        with closing(sqlite3.connect(tmp_path / DATABASE)) as reading:
            rows = reading.execute("SELECT * FROM event ORDER BY seq DESC LIMIT 2").fetchall()
        bare.execute("PRAGMA journal_mode = WAL")
        bare.execute("PRAGMA synchronous = FULL")
        bare.execute(f"CREATE TABLE bare ({', '.join(f'value_{number}' for number, _ in enumerate(rows[0]))})")
        insert = f"INSERT INTO bare VALUES ({', '.join('?' * len(rows[0]))})"  # noqa: S608 - marks
        ours, theirs = [], []

        def both() -> None:
            begun = perf_counter()
            bare.execute("BEGIN IMMEDIATE")
            bare.executemany(insert, rows)
            bare.execute("COMMIT")
            between = perf_counter()
            recorder.append(A_TAP)
            theirs.append(between - begun)
            ours.append(perf_counter() - between)

        benchmark.pedantic(both, rounds=ROUNDS, warmup_rounds=20)
    # The quicker quarter, which other programs on the machine hold up least.
    bare_s, ours_s = quantiles(theirs, n=4)[0], quantiles(ours, n=4)[0]
    told = {"bare_p25_us": bare_s * 1e6, "ours_p25_us": ours_s * 1e6, "ratio": ours_s / bare_s}
    told = {name: round(value, 2) for name, value in told.items()}
    benchmark.extra_info.update(told)
    print(f"\n{benchmark.name}: {told}")  # noqa: T201 - a benchmark is read on the terminal


def test_bare_append_and_fsync(benchmark: Any, tmp_path: Path) -> None:
    """The same bytes, without a database: what no store on this disk can undercut."""
    with (tmp_path / "bare.jsonl").open("ab", buffering=0) as file:

        def append() -> None:
            file.write(A_LINE)
            os.fsync(file.fileno())

        benchmark.pedantic(append, rounds=ROUNDS, warmup_rounds=20)
    tell_percentiles(benchmark)
