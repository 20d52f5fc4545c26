"""A session on a slow machine: ``python -m tests.bench.slow_machine [--share 0.333] [--sessions 1]``.

The process is held to one core and to a share of it by a control group of Linux, which takes root. A simulated visitor
touches the real window, also cards that do not count. It prints how long the frames take while cards turn, and what
became of each touch of a card, and ends with 1 where a touch was lost or a hundredth of the frames takes over 50 ms.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from statistics import median, quantiles
from time import monotonic, thread_time

import click
from PySide6.QtCore import QObject, QPoint
from PySide6.QtQuick import QQuickWindow

from kiosk.config import Settings
from kiosk.experiment.effects import Outcome
from kiosk.experiment.events import CardSelected, WorldEvent
from kiosk.experiment.outcomes import Stage
from kiosk.ui.app import App
from kiosk.ui.rehearsal import Rehearsal
from kiosk.ui.simulated_visitor import Aside, UiDriver, find_item, touch
from kiosk.ui.window import ClockMode, RunMode, WindowMode
from kiosk.units import MS_PER_SECOND
from tests.samples import SHORT
from tests.ui.headless import headless

GOAL_MS = 50.0
"""What 99 of 100 frames stay below while cards turn, at a third of the speed."""
PERIOD_US = 3_000
"""How long the shares of time are. The kernel's own 100 ms would hold the process still for 67 ms at a time."""
CONTROLLERS = (
    # Version 1 and version 2 of control groups: the folder, and what is written into which file of a group in it.
    (
        Path("/sys/fs/cgroup/cpu"),
        {"cpu.cfs_period_us": "{period}", "cpu.cfs_quota_us": "{quota}", "cpu.shares": "262144"},
    ),
    (Path("/sys/fs/cgroup"), {"cpu.max": "{quota} {period}", "cpu.weight": "10000"}),
)


@contextmanager
def held_to(share: float) -> Iterator[None]:
    """Hold this process, all its threads and what it starts to a share of one core.

    Within that share it goes before other programs, so the share is what it gets on a busy machine too.
    """
    root, files = next((root, files) for root, files in CONTROLLERS if (root / "cgroup.procs").exists())
    group = root / f"recollect-{os.getpid()}"
    cores = os.sched_getaffinity(0)
    group.mkdir()
    try:
        for name, value in files.items():
            (group / name).write_text(value.format(period=PERIOD_US, quota=round(share * PERIOD_US)))
        (group / "cgroup.procs").write_text(str(os.getpid()))
        os.sched_setaffinity(0, {max(cores)})
        yield
    finally:
        os.sched_setaffinity(0, cores)
        (root / "cgroup.procs").write_text(str(os.getpid()))
        group.rmdir()


class Frames(QObject):
    """How long it is from one frame to the next while cards turn, and what it takes of the processor, in ms."""

    def __init__(self, app: App) -> None:
        super().__init__()
        self.lengths: list[float] = []
        self.spent: list[float] = []
        self._window = app.window
        self._last: tuple[float, float] | None = None
        self._board: QObject | None = None
        app.window.frameSwapped.connect(self._frame)

    @contextmanager
    def left_out(self) -> Iterator[None]:
        """Leave out the frame in which something is looked for, which draws the window once more."""
        yield
        self._last = None

    def _frame(self) -> None:
        now = monotonic() * MS_PER_SECOND, thread_time() * MS_PER_SECOND
        if self._board is None:
            cards = find_item(self._window.contentItem(), "board")
            self._board = cards.parentItem() if cards is not None else None
        turns = self._board is not None and self._board.property("turning") > 0
        if turns and self._last is not None:
            self.lengths.append(now[0] - self._last[0])
            self.spent.append(now[1] - self._last[1])
        self._last = now if turns else None


class Finger(UiDriver):
    """Touches, and counts the touches of cards."""

    def __init__(self, window: QQuickWindow, aside: Aside) -> None:
        super().__init__(window, aside)
        self.cards = 0

    def click(self, name: str, across: float = 0.5) -> None:
        self.cards += name.startswith("card-")
        super().click(name, across)

    def _tap(self, place: QPoint) -> None:
        touch(self._window, place)


class Impatient(Rehearsal):
    """A visitor who also touches cards while the board waits."""

    def __init__(self, app: App, seed: int, frames: Frames) -> None:
        super().__init__(app, seed, hand=self._make_hand)
        self.selected = self.signs = 0
        self._frames = frames
        app.screens.board.refused.connect(self._see_sign)

    def _make_hand(self, window: QQuickWindow, aside: Aside) -> UiDriver:
        @contextmanager
        def both() -> Iterator[None]:
            with aside(), self._frames.left_out():
                yield

        self.finger = Finger(window, both)
        return self.finger

    def _see_sign(self) -> None:
        self.signs += 1

    def _play(self, shown: str) -> None:
        board = self._app.screens.board
        if not board.accepts_taps and shown == "game" and self._visitor.tosses():
            self._click(f"card-{self._chance.randrange(board.rowCount())}")
        else:
            super()._play(shown)

    def _watch(self, event: WorldEvent, outcome: Outcome, stage: Stage) -> None:
        self.selected += isinstance(event, CardSelected)
        super()._watch(event, outcome, stage)


def main() -> int:
    """Go through the sessions and print what was measured."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--share", type=float, default=1 / 3, help="of one core")
    parser.add_argument("--sessions", type=int, default=1)
    asked = parser.parse_args()
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    settings = Settings.model_validate({"stages": SHORT, "voice": {"enabled": False}, "questionnaires": ["trust"]})
    lost, frames, longest = 0, list[float](), 0.0
    with tempfile.TemporaryDirectory() as folder, held_to(asked.share):
        moving = RunMode(WindowMode.NOWHERE, ClockMode.WALL)
        with headless(settings, Path(folder), mode=moving) as app:
            seen = Frames(app)
            for seed in range(asked.sessions):
                visitor, began = Impatient(app, seed, seen), monotonic()
                visitor.run()
                lost += visitor.finger.cards - visitor.selected
                longest = max(longest, visitor.pulse.longest_ms)
                click.echo(
                    f"session {seed + 1} completed in {monotonic() - began:.0f} s: "
                    f"{visitor.finger.cards} cards touched, {visitor.selected} recorded, "
                    f"{visitor.signs} refused with a sign"
                )
            frames = seen.lengths
    *_, p99 = quantiles(frames, n=100)
    *_, spent = quantiles(seen.spent, n=100)
    click.echo(
        f"{len(frames)} frames while cards turned: half under {median(frames):.1f} ms, 99 % under {p99:.1f} ms, the "
        f"longest {max(frames):.1f} ms; of the processor {median(seen.spent):.1f} ms, and 99 % under {spent:.1f} ms"
    )
    click.echo(f"the loop was busy for {longest:.0f} ms at the most; {lost} touches were lost")
    return 1 if lost or p99 > GOAL_MS else 0


if __name__ == "__main__":
    sys.exit(main())
