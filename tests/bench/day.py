"""What a day costs a kiosk: ``python -m tests.bench.day [--sessions 600] [--gaps 3] [--speed 1] [--seconds 60]``.

It prints how much memory and how many handles each session leaves behind, with a robot that fails at random; how long
the event loop keeps anything waiting in real time; and which share of a core the start screen and a game at rest take.
Shares, memory and work are those of this process alone, so other programs change them little. They do change a gap, as
does whatever the machine stands on. So gaps are printed as they are, and less what was taken from this thread: its wait
for a processor, or the time in which programs that only sleep, one on each processor, were not woken either. The longer
of the two counts. With ``--json``, what was measured is also written for ``packaging/benchmarks.py --day``.
"""

from __future__ import annotations

import argparse
import gc
import json
import os
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from ctypes import CDLL
from dataclasses import dataclass
from datetime import date
from itertools import count
from math import sqrt
from operator import itemgetter
from pathlib import Path
from statistics import fmean, linear_regression, quantiles
from time import monotonic, process_time, thread_time
from typing import Any

import click
from psutil import Process
from PySide6.QtCore import QObject, Qt, QTimer
from PySide6.QtQml import QQmlEngine

from kiosk.cli.composition import read_settings
from kiosk.experiment.outcomes import SessionKind, Stage
from kiosk.robots.simulated import FlakyRobot
from kiosk.store.recorder import Recorder
from kiosk.study.loader import read_study
from kiosk.ui.app import App
from kiosk.ui.condition_assigner import ConditionAssigner, RunContext
from kiosk.ui.rehearsal import Rehearsal
from kiosk.ui.rehearsed_day import KIB, draw_visitors, rehearse_day
from kiosk.ui.simulated_visitor import BehaviourKind, BehaviourProfile
from kiosk.ui.window import ClockMode, RunMode, WindowMode
from kiosk.units import MS_PER_SECOND
from tests.bench.stops import queued_ms, watched_stops

WARM_UP = 150
"""Sessions before memory is counted: by then, visitors of all languages and text sizes have had most sentences."""

STANDS_MS = 300
"""How long the start screen stands between visitors: the event loop frees what the pages of a visitor held."""

PREPARES_MS = 5000
"""A kiosk has prepared its pages by then, and few visitors have read the start screen."""

BEAT_MS = 5

TOLD = 5
"""Of so many gaps it is printed what was in them: those with the most left."""


@dataclass(frozen=True)
class Gap:
    """One beat of a timer, in ms: how late it came, and what this thread did since the one before."""

    begin: float
    end: float
    late: float
    worked: float
    beside: float
    """What the other threads of the program worked, in ms."""
    queued: float


class Gaps(QObject):
    """How late a timer of the event loop comes, each time."""

    def __init__(self) -> None:
        super().__init__()
        self.found: list[Gap] = []
        self._begin = self._worked = self._all = self._queued = 0.0
        self._timer = QTimer(self)
        self._timer.setTimerType(Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self._beat)
        self._timer.start(BEAT_MS)

    def _beat(self) -> None:
        now, worked, all_worked = (each() * MS_PER_SECOND for each in (monotonic, thread_time, process_time))
        queued = queued_ms()
        if self._begin:
            late, ours = max(0.0, now - self._begin - BEAT_MS), worked - self._worked
            beside = max(0.0, all_worked - self._all - ours)
            self.found.append(Gap(self._begin, now, late, ours, beside, queued - self._queued))
        self._begin, self._worked, self._all, self._queued = now, worked, all_worked, queued

    def rest(self) -> None:
        """Count what has passed since the last beat, and leave out what comes before the next one."""
        self._beat()
        self._begin = 0.0


class Resting(Rehearsal):
    """A visitor who stops in the middle of a game; the share of a core is taken from there on."""

    def __init__(self, app: App, seconds: float) -> None:
        super().__init__(app, 1, visitor=BehaviourProfile(BehaviourKind.LEAVES, Stage.GAME))
        self.share = 0.0
        self._seconds = seconds
        self._watched = False

    def _is_gone(self) -> bool:
        if super()._is_gone() and not self._watched:
            self._watched = True
            # It would take a part of the core itself.
            self.pulse.stop()
            QTimer.singleShot(2 * MS_PER_SECOND, self._begin)
        return super()._is_gone()

    def _begin(self) -> None:
        before, since = process_time(), monotonic()

        def end() -> None:
            self.share = (process_time() - before) / (monotonic() - since)
            self._app.quit()

        QTimer.singleShot(round(self._seconds * MS_PER_SECOND), end)


@contextmanager
def kiosk(folder: Path, mode: RunMode, robot: FlakyRobot | None = None) -> Iterator[App]:
    """Open the kiosk on no screen, for the study that is shipped."""
    study, seeds = read_study(read_settings(None)), count(1)
    origin = RunContext("a bench", kind=SessionKind.SIMULATED, seed=lambda: next(seeds))
    with Recorder(folder) as recorder, App(mode, recorder, ConditionAssigner(study, recorder, origin), robot) as app:
        yield app


def memory(folder: Path, sessions: int) -> dict[str, Any]:
    """Print and return what each session leaves behind, as a slope with its standard error over those that count."""
    held: dict[int, int] = {}
    handles: list[int] = []
    counted = min(WARM_UP, sessions // 2)
    with kiosk(folder, RunMode(WindowMode.NOWHERE, ClockMode.VIRTUAL), FlakyRobot(1)) as app:
        visitors = list(draw_visitors(sessions, 1, app.assigner.study.languages))
        for number, usage in enumerate(rehearse_day(app, 1, visitors, folder)):
            _stand(app, STANDS_MS)
            # Also before the first that counts: memory that is given back is taken anew from other places.
            kib = _held_kib(app)
            if number < counted:
                continue
            handles.append(usage.handles)
            # The others leave their pages half filled, and in as many ways as there are places to leave.
            if visitors[number].manner is BehaviourKind.COMPLETES:
                held[number] = kib
    slope, error = _fitted(list(held), list(held.values()))
    click.echo(
        f"memory: {slope:+.1f} +/- {error:.1f} KiB a session over {len(handles)}, {fmean(held.values()):.0f} KiB on "
        f"average; handles: {handles[0]}, at most {max(handles)}, {handles[-1]} at the end"
    )
    which = {"first": counted + 1, "last": sessions}
    return {"memory": {**which, "slope_kib": slope, "error_kib": error, "handles": max(handles)}}


def _fitted(at: Sequence[int], values: Sequence[int]) -> tuple[float, float]:
    """Return the slope of a line through values by least squares, and its standard error."""
    line, middle = linear_regression(at, values), fmean(at)
    rest = sum((value - line.slope * x - line.intercept) ** 2 for x, value in zip(at, values, strict=True))
    return line.slope, sqrt(rest / (len(at) - 2) / sum((x - middle) ** 2 for x in at))


def _held_kib(app: App) -> int:
    """Return what the process holds when garbage is collected and free memory given back, files left out.

    Qt keeps up to 2 MB of pictures that are not shown any more; which ones differs from visitor to visitor.
    """
    app.window.releaseResources()
    context = QQmlEngine.contextForObject(app.window)
    if context is not None:
        context.engine().collectGarbage()
    gc.collect()
    # The C library keeps what is free for what comes next.
    with suppress(AttributeError, OSError):
        CDLL("libc.so.6").malloc_trim(0)
    process = Process()
    usage = process.memory_info()
    return int(usage.rss - getattr(usage, "shared", 0)) // KIB


def gaps(folder: Path, sessions: int, speed: float) -> dict[str, Any]:
    """Print and return how late the event loop is, in real time or faster, while the robot fails at random."""
    with (
        kiosk(folder, RunMode(WindowMode.NOWHERE, ClockMode.WALL, speed), FlakyRobot(1)) as app,
        watched_stops() as stops,
    ):
        _stand(app, PREPARES_MS)
        # A kiosk runs its loop once. Here it begins anew with each visitor, and would look through everything again.
        gc.collect()
        gc.freeze()
        seen = Gaps()
        for seed in range(sessions):
            Rehearsal(app, seed).run()
            # The next visitor is made, and garbage is looked for, while no loop runs: a kiosk has no such time.
            seen.rest()
        gc.unfreeze()
    stood = [stops.within(gap.begin, gap.end) for gap in seen.found]
    ours = [max(0.0, gap.late - max(gap.queued, still)) for gap, still in zip(seen.found, stood, strict=True)]
    late = [gap.late for gap in seen.found]
    for what, found in (
        ("gaps of the loop", late),
        ("less what the machine took", ours),
        ("the thread's work in them", [gap.worked for gap in seen.found]),
    ):
        hundredths = quantiles(found, n=100)
        click.echo(
            f"{what} in {sessions} sessions: half under {hundredths[49]:.1f} ms, "
            f"99 % under {hundredths[98]:.1f} ms, the longest {max(found):.1f} ms, of {len(found)}"
        )
    for left, gap, still in sorted(zip(ours, seen.found, stood, strict=True), key=itemgetter(0), reverse=True)[:TOLD]:
        click.echo(
            f"{left:.1f} ms are left of a gap of {gap.late:.1f} ms: the thread worked {gap.worked:.1f} ms, others "
            f"{gap.beside:.1f}; it waited {gap.queued:.1f} ms for a processor, and one stood still for {still:.1f} ms"
        )
    p99_ms = quantiles(late, n=100)[98]
    which = {"visitors": sessions, "speed": speed, "beats": len(late)}
    return {"gaps": {**which, "p99_ms": p99_ms, "longest_ms": max(late)}}


def _stand(app: App, duration_ms: int) -> None:
    """Let the start screen stand for so long."""
    QTimer.singleShot(duration_ms, app.quit)
    app.run()


def shares(folder: Path, seconds: float) -> dict[str, Any]:
    """Print and return the shares of a core that the start screen and a game at rest take."""
    with kiosk(folder, RunMode(WindowMode.NOWHERE, ClockMode.WALL)) as app:
        _stand(app, PREPARES_MS)
        before, since = process_time(), monotonic()
        QTimer.singleShot(round(seconds * MS_PER_SECOND), app.quit)
        app.run()
        start = (process_time() - before) / (monotonic() - since)
        click.echo(f"start screen: {start:.1%} of a core")
        resting = Resting(app, seconds)
        resting.run()
        click.echo(f"game at rest: {resting.share:.1%} of a core")
    return {"shares": {"start_screen": start, "game_at_rest": resting.share}}


def main() -> int:
    """Measure what is asked for."""
    parser = argparse.ArgumentParser()
    parser.add_argument(
        "--sessions", type=int, default=WARM_UP + 450, help="sessions for memory, 20 or more; 0 leaves it out"
    )
    parser.add_argument("--gaps", type=int, default=3, help="sessions in real time; 0 leaves them out")
    parser.add_argument("--speed", type=float, default=1, help="how many times as fast as people their visitors are")
    parser.add_argument("--seconds", type=float, default=60, help="time for each share; 0 leaves them out")
    parser.add_argument("--json", type=Path, help="a file for what was measured")
    asked = parser.parse_args()
    if 0 < asked.sessions < 20:
        parser.error("--sessions: a slope needs 20 sessions or more")
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    measures = (
        (memory, asked.sessions),
        (lambda folder, sessions: gaps(folder, sessions, asked.speed), asked.gaps),
        (shares, asked.seconds),
    )
    told: dict[str, Any] = {"date": date.today().isoformat()}
    for measure, amount in measures:
        if amount:
            with tempfile.TemporaryDirectory() as folder:
                told |= measure(Path(folder), amount)
    if asked.json is not None:
        asked.json.write_text(json.dumps(told), "utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
