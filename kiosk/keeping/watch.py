"""Whether a program that was started is up, and whether it has been silent for too long."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from kiosk.keeping.notice import Notice


@dataclass(frozen=True)
class Patience:
    """How long the keeper waits for what; all in seconds."""

    silence: float = 5.0
    """For the next beat, until the kiosk hangs."""
    start: float = 30.0
    """For the first frame."""
    end: float = 5.0
    """For a kiosk that was asked to end."""
    meanwhile: float = 5.0
    """For the calm window."""
    young: float = 10.0
    """A kiosk that dies sooner after its first frame died at once."""
    longest_pause: float = 30.0
    memory_mib: int = 1024
    """What a kiosk may take; it usually takes 160."""
    tick: float = 0.1
    """How often it is seen whether the kiosk is still there."""

    def pause(self, died_young: int) -> float:
        """Before the next start, when so many in a row have died young."""
        return 0.0 if died_young <= 1 else min(2.0 ** (died_young - 2), self.longest_pause)


class Heard(Protocol):
    """A program that tells."""

    def hear(self, within_s: float) -> Notice:
        """What it tells next; empty if it tells nothing within this time."""

    def dead(self) -> bool:
        """Whether it has ended."""


class Watch:
    """Whether one program is up, and since when it has been silent."""

    def __init__(self, child: Heard, patience: Patience, clock: Callable[[], float] = time.monotonic) -> None:
        """Watch it from its start on."""
        self._child = child
        self._patience = patience
        self._clock = clock
        self._up_at: float | None = None
        self._left_s = patience.start
        self._looked_at = clock()

    @property
    def up(self) -> bool:
        """Whether its first frame was drawn."""
        return self._up_at is not None

    def up_s(self) -> float:
        """For how long its first frame has been there; 0 without one."""
        return 0.0 if self._up_at is None else self._clock() - self._up_at

    def hear(self, within_s: float | None = None) -> Notice:
        """What it tells next, within a tick unless told otherwise; empty if that is nothing."""
        notice = self._child.hear(self._patience.tick if within_s is None else within_s)
        now = self._clock()
        # Where everything stood still for a while, the keeper too, nobody is to blame for having been silent.
        self._left_s -= min(now - self._looked_at, 2 * self._patience.tick)
        self._looked_at = now
        if "READY" in notice and self._up_at is None:
            self._up_at = now
        if self.up and {"READY", "WATCHDOG"} & notice.keys():
            self._left_s = self._patience.silence
        return notice

    def over(self) -> bool:
        """Whether it is dead, or might as well be."""
        return self._child.dead() or self._left_s <= 0
