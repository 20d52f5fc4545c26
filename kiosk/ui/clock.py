"""The time that a sitting runs on: the wall's, the wall's made faster, or none but the next wait's end.

Every wait of the study goes through a clock, so that a rehearsal can play five minutes in a few seconds and still get
the same times for the same seed.
"""

from __future__ import annotations

import heapq
from collections.abc import Callable
from itertools import count
from time import monotonic
from typing import Protocol

from PySide6.QtCore import QObject, Qt, QTimer

MS_PER_SECOND = 1000


class Wait(Protocol):
    """A wait that is under way."""

    def cancel(self) -> None:
        """Forget it; cancelling one that is over changes nothing."""
        ...


class Clock(Protocol):
    """Tells the time and waits."""

    def now_ms(self) -> int:
        """Milliseconds since some fixed moment; never goes back."""
        ...

    def after(self, ms: int, call: Callable[[], None]) -> Wait:
        """Call back once, on the interface's thread, when so many milliseconds have passed."""
        ...


class _TimerWait:
    def __init__(self, timer: QTimer) -> None:
        self._timer = timer

    def cancel(self) -> None:
        self._timer.stop()
        self._timer.deleteLater()


class WallClock:
    """Real time, ``speed`` times as fast."""

    def __init__(self, owner: QObject, speed: float = 1.0) -> None:
        """Its waits end with ``owner``."""
        self._owner = owner
        self._speed = speed

    def now_ms(self) -> int:
        """Milliseconds since some fixed moment, on a clock that nobody can set back."""
        return int(monotonic() * MS_PER_SECOND * self._speed)

    def after(self, ms: int, call: Callable[[], None]) -> Wait:
        """Call back once, when so many milliseconds of this clock have passed."""
        timer = QTimer(self._owner)
        timer.setSingleShot(True)
        timer.setTimerType(Qt.TimerType.PreciseTimer)
        timer.timeout.connect(call)
        timer.timeout.connect(timer.deleteLater)
        timer.start(round(ms / self._speed))
        return _TimerWait(timer)


class _QueuedWait:
    def __init__(self, call: Callable[[], None]) -> None:
        self.call: Callable[[], None] | None = call

    def cancel(self) -> None:
        self.call = None


class VirtualClock:
    """Time that passes only by jumping to the end of the next wait, whenever the interface has nothing else to do."""

    def __init__(self, owner: QObject) -> None:
        """Runs from now on, until ``owner`` goes."""
        self._now = 0
        self._order = count()
        self._waits: list[tuple[int, int, _QueuedWait]] = []
        self._idle = QTimer(owner)
        self._idle.timeout.connect(self._jump)
        self._idle.start(0)

    def now_ms(self) -> int:
        """Milliseconds since the clock was made."""
        return self._now

    def after(self, ms: int, call: Callable[[], None]) -> Wait:
        """Call back once, when the clock has jumped that far; waits that end together end in the order they began."""
        wait = _QueuedWait(call)
        heapq.heappush(self._waits, (self._now + ms, next(self._order), wait))
        return wait

    def _jump(self) -> None:
        while self._waits:
            at, _, wait = heapq.heappop(self._waits)
            if wait.call is not None:
                self._now = at
                wait.call()
                return
