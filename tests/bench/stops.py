"""What the machine keeps from a program: the wait for a processor, and moments in which nothing runs on one."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager
from pathlib import Path
from select import select
from time import monotonic

from kiosk.units import MS_PER_SECOND
from tests.patience import PATIENCE_S, Program, serving

NAP_MS = 3
"""How long the program sleeps that does nothing else."""

SHORTEST_MS = 1
"""A machine that is later than this with waking it has stood still."""

_NS_PER_MS = 1e6
_SCHEDULER = Path("/proc/thread-self/schedstat")


def queued_ms() -> float:
    """Return how long this thread has waited for a processor since it began; 0 where the system does not tell."""
    return int(_SCHEDULER.read_text().split()[1]) / _NS_PER_MS if _SCHEDULER.exists() else 0.0


class Stops(list[tuple[float, float]]):
    """From when to when a processor stood still, in ms of the monotonic clock."""

    def within(self, begin: float, end: float) -> float:
        """Return how long one of the processors stood still between two moments, in ms."""
        reached, still = begin, 0.0
        for since, until in sorted(self):
            # Two processors often stand still together.
            still += max(0.0, min(until, end) - max(since, reached))
            reached = max(reached, until)
        return still


@contextmanager
def watched_stops() -> Iterator[Stops]:
    """Let a program sleep on each processor; how late they were woken is known at the end."""
    found = Stops()
    with ExitStack() as running:
        sleepers = [running.enter_context(_sleeper(processor)) for processor in _processors()]
        yield found
        for sleeper in sleepers:
            told, _ = sleeper.communicate(timeout=PATIENCE_S)
            found += ((float(since), float(until)) for since, until in map(str.split, told.splitlines()))


def _sleeper(processor: int) -> AbstractContextManager[Program]:
    command = [sys.executable, "-m", __name__, str(processor)]
    return serving(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)


def _processors() -> list[int]:
    return sorted(os.sched_getaffinity(0)) if sys.platform == "linux" else [0]


def sleep_and_tell(processor: int) -> None:
    """Sleep on this processor again and again until the input ends; then tell when it stood still."""
    if sys.platform == "linux":
        os.sched_setaffinity(0, {processor})
    found = Stops()
    while True:
        due, queued = monotonic() * MS_PER_SECOND + NAP_MS, queued_ms()
        ended, _, _ = select([sys.stdin], [], [], NAP_MS / MS_PER_SECOND)
        if ended:
            break
        # Other programs had the processor, which says nothing about the kiosk.
        until = monotonic() * MS_PER_SECOND - (queued_ms() - queued)
        if until - due > SHORTEST_MS:
            found.append((due, until))
    for since, until in found:
        sys.stdout.write(f"{since} {until}\n")


if __name__ == "__main__":
    sleep_and_tell(int(sys.argv[1]))
