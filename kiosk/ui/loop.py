"""The loop that everything on the screen lives in, until somebody leaves it; the system may ask it to end, too."""

from __future__ import annotations

import gc
import signal
import sys
from collections.abc import Callable
from types import TracebackType

from PySide6.QtCore import QEventLoop, QObject, QTimer

from kiosk.ui.clock import Clock, VirtualClock

HEARTBEAT_MS = 250

Fault = Callable[[type[BaseException], BaseException, TracebackType | None], None]
"""Takes a fault of ours that came up in the loop."""


class Loop:
    """Runs the interface; on virtual time it lets time jump whenever the interface has nothing else to do."""

    def __init__(self, clock: Clock, owner: QObject, fault: Fault, beat: Callable[[], None] = lambda: None) -> None:
        """``fault`` is told of what nobody caught.

        ``beat`` is called out of the loop several times a second, and when the system asks for the end.
        """
        self.told_to_end = False
        """Whether the system asked the program to end; from then on nothing runs."""
        # A loop of our own: the application's asks every window first, and the window refuses everybody.
        self._loop = QEventLoop()
        self._clock = clock
        self._fault = fault
        self._beat = beat
        # Python runs now and then, or it would never see that the system asks it to end.
        self._heart = QTimer(owner)
        self._heart.timeout.connect(self._live)
        self._heart.start(HEARTBEAT_MS)
        self._signals_before = {
            ending: signal.signal(ending, lambda *_: self._end()) for ending in (signal.SIGINT, signal.SIGTERM)
        }

    def run(self) -> None:
        """Run until ``quit``, or not at all once the system asked for the end, be it while all this was built."""
        if self.told_to_end:
            return
        before, sys.excepthook = sys.excepthook, self._fault
        ticking = QTimer()
        if isinstance(self._clock, VirtualClock):
            ticking.timeout.connect(self._clock.jump)
            ticking.start(0)
        # What is there now stays for the day; walking all of it for garbage would cost the screen a frame or two.
        gc.collect()
        gc.freeze()
        try:
            self._loop.exec()
        finally:
            gc.unfreeze()
            ticking.stop()
            sys.excepthook = before

    def quit(self) -> None:
        """End it, from within."""
        self._loop.quit()

    def close(self) -> None:
        """Leave the system's requests to whoever had them before."""
        for ending, handler in self._signals_before.items():
            signal.signal(ending, handler)

    def _live(self) -> None:
        self._beat()
        # A loop that was told to end just before it began has not heard of it.
        if self.told_to_end:
            self.quit()

    def _end(self) -> None:
        self.told_to_end = True
        self._beat()
        self.quit()
