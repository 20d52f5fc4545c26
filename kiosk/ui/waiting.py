"""Waits, on the event loop, for another program to let go of the database: the interface goes on meanwhile.

SQLite itself could wait too, but it would do so on the interface's thread.
"""

from __future__ import annotations

from collections.abc import Callable

from kiosk.store.recorder import StoreBusy, StoreFailed
from kiosk.ui.clock import Clock, Wait
from kiosk.units import MS_PER_SECOND

RETRY_MS = 20
"""How long until the same is tried again."""
TOLD_AFTER_MS = 1_000
"""A longer wait is told to the person in front of the screen."""
LONGEST_MS = 120_000
"""After so long the database counts as failed."""


class BusyWait:
    """One wait for the database, from the first attempt that found it held to the one that did not."""

    def __init__(self, clock: Clock, show: Callable[[bool], None]) -> None:
        """``show`` is told when the wait has become long, and again when a long wait is over."""
        self._clock = clock
        self._show = show
        self._wait: Wait | None = None
        self._since: int | None = None
        self._long = False

    @property
    def under_way(self) -> bool:
        """Whether something is to be tried again."""
        return self._wait is not None

    def try_again(self, call: Callable[[], None], busy: StoreBusy) -> None:
        """Call back soon; raises StoreFailed, and ends the wait, once it has taken too long."""
        now = self._clock.now_ms()
        self._since = now if self._since is None else self._since
        waited = now - self._since
        if waited >= LONGEST_MS:
            self.end()
            raise StoreFailed(f"{busy}; it was tried for {waited // MS_PER_SECOND} s") from busy
        if waited >= TOLD_AFTER_MS and not self._long:
            self._long = True
            self._show(True)  # noqa: FBT003 - it is what is shown
        self._wait = self._clock.after(RETRY_MS, lambda: self._call(call))

    def end(self) -> None:
        """Wait no more: the database took it, or nothing is to be tried again."""
        if self._wait is not None:
            self._wait.cancel()
        self._wait = self._since = None
        if self._long:
            self._long = False
            self._show(False)  # noqa: FBT003 - as above

    def _call(self, call: Callable[[], None]) -> None:
        self._wait = None
        call()
