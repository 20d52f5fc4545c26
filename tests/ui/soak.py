"""Sessions in a row against a robot that flaps: ``python -m tests.ui.soak [--sessions 100]``.

Prints threads, sockets, other handles, child processes and memory after a few sessions and at the end; ends with 1 if
anything grew that must not grow. The robot is a process of its own and fails at random, in any way, and comes back.
"""

from __future__ import annotations

import argparse
import gc
import os
import sys
import tempfile
from collections import Counter
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import click

from kiosk.experiment.outcomes import Status
from kiosk.experiment.session_state import SessionState
from kiosk.store.queries import open_repository
from kiosk.ui.rehearsal import Rehearsal
from tests.ui.fault_matrix import Robot, kiosk_with_robot

WARM_UP = 10
"""Sessions before anything is counted: pictures, fonts and sentences are loaded when they are first needed."""

GROWTH_MB = 15
"""How much the memory may move; what grew by as little as 0.2 MB a session would exceed it in 100."""


@dataclass(frozen=True)
class Counted:
    """What this process holds."""

    threads: int
    sockets: int
    handles: int
    children: int
    memory_mb: float

    @classmethod
    def now(cls) -> Counted:
        """Count."""
        gc.collect()
        process = Path("/proc/self")
        targets = []
        for handle in (process / "fd").iterdir():
            # The one that lists them is gone again.
            with suppress(FileNotFoundError):
                targets.append(str(handle.readlink()))
        status = dict(row.split(":", 1) for row in (process / "status").read_text().splitlines())
        children = (process / "task" / str(os.getpid()) / "children").read_text().split()
        sockets = sum(target.startswith("socket:") for target in targets)
        return cls(
            int(status["Threads"]),
            sockets,
            len(targets) - sockets,
            len(children),
            int(status["VmRSS"].split()[0]) / 1024,
        )


def main() -> int:
    """Play, and compare."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--sessions", type=int, default=100)
    sessions = parser.parse_args().sessions
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
    robot = Robot("--mode", "flap", "--seed", "1")
    with tempfile.TemporaryDirectory() as folder:
        data = Path(folder)
        begun = Counted.now()
        with kiosk_with_robot(robot.port, data) as app:
            longest = 0.0
            for seed in range(WARM_UP + sessions):
                if seed == WARM_UP:
                    begun, longest = Counted.now(), 0.0
                rehearsal = Rehearsal(app, seed)
                rehearsal.run()
                longest = max(longest, rehearsal.pulse.longest_ms)
            ended = Counted.now()
        with open_repository(data) as stored:
            played = stored.sessions()[WARM_UP:]
            changes = sum(
                len(SessionState.from_events(stored.events(session.id)).embodiment_changes) for session in played
            )
    robot.close()
    embodiments = Counter(session.embodiment for session in played)
    completed = sum(session.status is Status.COMPLETED for session in played)
    click.echo(
        f"{completed} of {len(played)} sessions completed; they began with {dict(embodiments)}; {changes} body changes"
    )
    click.echo(f"at the start {begun}")
    click.echo(f"at the end   {ended}")
    click.echo(f"longest gap of the event loop {longest:.1f} ms")
    grew = (
        ended.threads > begun.threads
        or ended.sockets > begun.sockets
        or ended.handles > begun.handles
        or ended.children > begun.children
        or ended.memory_mb > begun.memory_mb + GROWTH_MB
    )
    return int(grew or completed < len(played))


if __name__ == "__main__":
    sys.exit(main())
