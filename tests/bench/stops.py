"""What the machine keeps from a program: the wait for a processor, and moments in which nothing on it runs."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from select import select
from time import monotonic

from kiosk.units import MS_PER_SECOND

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
    """From when to when the machine stood still, in ms of the monotonic clock."""

    def within(self, begin: float, end: float) -> float:
        """Return how long it stood still between two moments, in ms."""
        return sum(max(0.0, min(end, until) - max(begin, since)) for since, until in self)


@contextmanager
def watched_stops() -> Iterator[Stops]:
    """Let a program sleep beside this one; how late it was woken is known at the end."""
    found = Stops()
    command = [sys.executable, "-m", __name__]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as sleeper:
        yield found
        told, _ = sleeper.communicate()
        found += ((float(since), float(until)) for since, until in map(str.split, told.splitlines()))


def sleep_and_tell() -> None:
    """Sleep again and again until the input ends; then print when the machine stood still."""
    found = Stops()
    while True:
        due, queued = monotonic() * MS_PER_SECOND + NAP_MS, queued_ms()
        ended, _, _ = select([sys.stdin], [], [], NAP_MS / MS_PER_SECOND)
        if ended:
            break
        # Other programs had its processor, which says nothing about another's.
        until = monotonic() * MS_PER_SECOND - (queued_ms() - queued)
        if until - due > SHORTEST_MS:
            found.append((due, until))
    for since, until in found:
        sys.stdout.write(f"{since} {until}\n")


if __name__ == "__main__":
    sleep_and_tell()
