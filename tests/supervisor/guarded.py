"""A guarded process that acts as its arguments say: ``python -m tests.supervisor.guarded ACT MEMORY_MIB``."""

from __future__ import annotations

import itertools
import os
import signal
import sys
from collections.abc import Callable

from kiosk.guard import Limits, guarded


def burn() -> None:
    """Use the processor for ever, with Python's lock: no thread and no signal handler of Python runs any more."""
    sum(itertools.repeat(0))


def swell() -> None:
    """Take memory that is really used."""
    taken = b"x" * (300 << 20)
    live(lambda: bool(taken))


def live(alive: Callable[[], bool] = lambda: True) -> None:
    """Beat until the standard input ends."""
    os.set_blocking(0, False)
    while alive():
        beat()
        signal.sigtimedwait([signal.SIGUSR1], 0.05)
        try:
            if not os.read(0, 1):
                return
        except BlockingIOError:
            continue


def take_notice() -> None:
    """Close slowly when asked to end."""
    asked: list[int] = []

    def notice(number: int, _frame: object) -> None:
        asked.append(number)
        beat()

    signal.signal(signal.SIGTERM, notice)
    tell("ready")
    while not asked:
        beat()
        signal.sigtimedwait([signal.SIGUSR1], 0.05)
    signal.sigtimedwait([signal.SIGUSR1], 2 * LIMITS.stuck)


def tell(what: str) -> None:
    """One line for the test."""
    sys.stdout.write(f"{what}\n")
    sys.stdout.flush()


def stuck_but_asked() -> None:
    """Stand still where a handler of Python's is to answer signals."""
    signal.signal(signal.SIGTERM, lambda *_: beat())
    # Told from within the loop: before it the handler would still answer, and the process have longer.
    sum(itertools.chain(map(os.write, (1,), (b"ready\n",)), itertools.repeat(0)))


ACTS: dict[str, Callable[[], None]] = {
    "burn": burn,
    "be asked while burning": stuck_but_asked,
    "be asked": take_notice,
    "swell": swell,
    "live": live,
    "live large": live,
    "kill itself": lambda: os.kill(os.getpid(), signal.SIGKILL),
}

LARGE = ("swell", "live large")
"""Taking memory may take a busy machine longer than a process may be silent."""

if __name__ == "__main__":
    act = sys.argv[1]
    LIMITS = Limits(
        start=1,
        silence=60 if "asked" in act or act in LARGE else 1,
        end=30,
        stuck=0.5,
        memory_mib=int(sys.argv[2]),
        tick=0.05,
    )
    HELD = b"x" * (300 << 20) if act == "live large" else b""
    with guarded(LIMITS) as beat:
        if act != "begin never":
            beat()
        ACTS.get(act, burn)()
    tell("left")
