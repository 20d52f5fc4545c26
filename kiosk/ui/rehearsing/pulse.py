"""How long the interface ever was away: the longest time between two rounds of its event loop."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from time import monotonic

from PySide6.QtCore import QObject, Qt, QTimer

from kiosk.units import MS_PER_SECOND

EVERY_MS = 5


class Pulse(QObject):
    """A timer that wishes to be called every EVERY_MS, and keeps how late it was called at the worst."""

    def __init__(self) -> None:
        super().__init__()
        self.longest_ms = 0.0
        """The longest time between two beats, in ms; a free loop reaches EVERY_MS and a little more."""
        self._last: float | None = None
        self._timer = QTimer(self)
        self._timer.setTimerType(Qt.TimerType.PreciseTimer)
        self._timer.setInterval(EVERY_MS)
        self._timer.timeout.connect(self._beat)

    def start(self) -> None:
        """Count from the first beat on: what is done before the loop runs is not the loop's."""
        self._last = None
        self._timer.start()

    def stop(self) -> None:
        """Count no more."""
        self._timer.stop()

    @contextmanager
    def aside(self) -> Iterator[None]:
        """What happens meanwhile is not the interface's doing, and does not count."""
        begun = monotonic()
        yield
        if self._last is not None:
            self._last += monotonic() - begun

    def _beat(self) -> None:
        now = monotonic()
        if self._last is not None:
            self.longest_ms = max(self.longest_ms, (now - self._last) * MS_PER_SECOND)
        self._last = now
