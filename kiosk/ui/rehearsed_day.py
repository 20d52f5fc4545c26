"""A day of simulated visitors, and what the process holds after each of them."""

from __future__ import annotations

import gc
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from random import Random
from statistics import linear_regression, median
from typing import Any

import psutil

from kiosk.config import STAGES
from kiosk.experiment.outcomes import Stage
from kiosk.ui.app import App
from kiosk.ui.rehearsal import Rehearsal
from kiosk.ui.simulated_visitor import BehaviourKind, BehaviourProfile

KIB = 1024

_CROWD = {
    BehaviourKind.COMPLETES: 62,
    BehaviourKind.LEAVES: 14,
    BehaviourKind.HASTY: 10,
    BehaviourKind.DECLINES: 7,
    BehaviourKind.UNDER_AGE: 7,
}
"""Of a hundred visitors, how many have which manner; our own guess, with every manner well represented."""

WARM_UP = 0.1
"""The share of the day before anything is compared: pictures and sentences are loaded when they are first needed."""


@dataclass(frozen=True)
class ProcessUsage:
    """What the process holds after a session; the gap is the event loop's longest during it."""

    memory_kib: int
    handles: int
    threads: int
    children: int
    database_kib: int
    longest_gap_ms: float

    @classmethod
    def now(cls, data: Path, longest_gap_ms: float) -> ProcessUsage:
        """Look at this process, and at the files of its data folder."""
        gc.collect()
        process = psutil.Process()
        stored = sum(file.stat().st_size for file in data.glob("recollect.db*"))
        return cls(
            process.memory_info().rss // KIB,
            _handles(process),
            process.num_threads(),
            len(process.children()),
            stored // KIB,
            round(longest_gap_ms, 1),
        )


def _handles(process: psutil.Process) -> int:
    """How many files, sockets and the like it holds."""
    if sys.platform == "win32":
        return process.num_handles()
    return process.num_fds()


def draw_visitors(sessions: int, seed: int, languages: Sequence[str]) -> Iterator[BehaviourProfile]:
    """Return a number of visitors of every manner, drawn by a seed."""
    chance = Random(f"{seed}/crowd")
    leaving = [Stage(name) for name in STAGES]
    for _ in range(sessions):
        manner = chance.choices(list(_CROWD), list(_CROWD.values()))[0]
        yield BehaviourProfile(manner, chance.choice(leaving), chance.choice(languages))


def rehearse_day(app: App, seed: int, visitors: Sequence[BehaviourProfile], data: Path) -> Iterator[ProcessUsage]:
    """Let them come one after another; after each, what the process holds. Raises UiTimeout if one cannot go on.

    No visitor comes any more once the system asked the kiosk to end.
    """
    for number, visitor in enumerate(visitors):
        rehearsal = Rehearsal(app, seed + number, visitor=visitor)
        rehearsal.run()
        if app.stop_requested:
            return
        yield ProcessUsage.now(data, rehearsal.pulse.longest_ms)


def day_summary(visitors: Sequence[BehaviourProfile], holdings: Sequence[ProcessUsage]) -> dict[str, Any]:
    """Return the day in figures: slopes per session after the warm-up, and what was held then and at the end."""
    after = holdings[min(int(WARM_UP * len(holdings)), len(holdings) - 1) :]
    gaps = [holding.longest_gap_ms for holding in after]
    return {
        "sessions": len(visitors),
        "visitors": dict(Counter(visitor.manner.value for visitor in visitors)),
        "slopes_per_session": {name: _slope([getattr(h, name) for h in after]) for name in asdict(after[0])},
        "after_warm_up": asdict(after[0]),
        "at_the_end": asdict(after[-1]),
        "longest_gap_ms": max(gaps),
        "median_gap_ms": median(gaps),
        "nothing_is_left": _nothing_is_left(after[0], after[-1]),
    }


def _slope(values: Sequence[float]) -> float:
    """How much a figure grew from one session to the next, by least squares."""
    return round(linear_regression(range(len(values)), values).slope, 4) if len(values) > 1 else 0.0


def _nothing_is_left(begun: ProcessUsage, ended: ProcessUsage) -> bool:
    """Whether handles, threads and child processes are as few at the end as after the warm-up."""
    return ended.handles <= begun.handles and ended.threads <= begun.threads and ended.children <= begun.children
