"""How long it takes until an event is on the disk, beside what the disk itself takes."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from kiosk.experiment.events import CardFlipped, CardSelected, SessionStarted
from kiosk.experiment.outcomes import SessionKind
from kiosk.game import Position
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


def test_bare_append_and_fsync(benchmark: Any, tmp_path: Path) -> None:
    """The same bytes, without a database: what no store on this disk can undercut."""
    with (tmp_path / "bare.jsonl").open("ab", buffering=0) as file:

        def append() -> None:
            file.write(A_LINE)
            os.fsync(file.fileno())

        benchmark.pedantic(append, rounds=ROUNDS, warmup_rounds=20)
    tell_percentiles(benchmark)
