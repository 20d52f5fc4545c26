"""The time that a sitting runs on: the wall's, the wall's made faster, or none but the next wait's end.

Every wait of the study goes through a clock, so that a rehearsal can play five minutes in a few seconds and still get
the same times for the same seed.
"""

from __future__ import annotations

import heapq
from collections.abc import Callable
from itertools import count
from time import monotonic, sleep
from typing import Protocol

from PySide6.QtCore import QObject, Qt, QTimer

from kiosk.units import MS_PER_SECOND

_TICK_S = 0.0005
"""How long a virtual clock that keeps pace with the wall's gives way to whoever it waits for."""


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
        self._timer: QTimer | None = timer
        timer.timeout.connect(self.cancel)

    def cancel(self) -> None:
        timer, self._timer = self._timer, None
        if timer is not None:
            timer.stop()
            timer.deleteLater()


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
        wait = _TimerWait(timer)
        timer.timeout.connect(call)
        timer.start(round(ms / self._speed))
        return wait


class _QueuedWait:
    def __init__(self, call: Callable[[], None]) -> None:
        self.call: Callable[[], None] | None = call

    def cancel(self) -> None:
        self.call = None


class VirtualClock:
    """Time that passes only by jumping to the end of the next wait, when it is told to."""

    def __init__(self) -> None:
        """Begin at 0."""
        self.waits_for: Callable[[], bool] = lambda: False
        """Whether something takes its own time just now, such as a robot; meanwhile this clock goes like the wall's."""
        self._now = 0
        self._waited_since: float | None = None
        self._order = count()
        self._waits: list[tuple[int, int, _QueuedWait]] = []

    def now_ms(self) -> int:
        """Milliseconds since the clock was made."""
        return self._now

    def after(self, ms: int, call: Callable[[], None]) -> Wait:
        """Call back once, when the clock has jumped that far; waits that end together end in the order they began."""
        wait = _QueuedWait(call)
        heapq.heappush(self._waits, (self._now + ms, next(self._order), wait))
        return wait

    def jump(self) -> None:
        """Go on to the end of the next wait, if there is one."""
        if self.waits_for():
            self._keep_pace()
            return
        self._waited_since = None
        self._forget_cancelled()
        if self._waits:
            self._end(heapq.heappop(self._waits))

    def _keep_pace(self) -> None:
        """Go on as the wall's clock does; end one wait if its time has come."""
        now = monotonic()
        if self._waited_since is None:
            self._waited_since = now - self._now / MS_PER_SECOND
        reached = int((now - self._waited_since) * MS_PER_SECOND)
        self._forget_cancelled()
        if self._waits and self._waits[0][0] <= reached:
            self._end(heapq.heappop(self._waits))
        else:
            self._now = max(self._now, reached)
            sleep(_TICK_S)

    def _forget_cancelled(self) -> None:
        while self._waits and self._waits[0][2].call is None:
            heapq.heappop(self._waits)

    def _end(self, due: tuple[int, int, _QueuedWait]) -> None:
        at, _, wait = due
        self._now = max(self._now, at)
        if wait.call is not None:
            wait.call()
