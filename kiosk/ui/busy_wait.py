"""Try again while another program holds the database, and say on the screen that this takes long."""

from __future__ import annotations

from collections.abc import Callable

from kiosk import StorageError
from kiosk.store.recorder import StoreBusy
from kiosk.ui.event_loop import Clock, TimerWait
from kiosk.units import MS_PER_SECOND

RETRY_MS = 20
"""How long until the same is tried again."""
TOLD_AFTER_MS = 1_000
"""A longer wait is shown to the person in front of the screen."""
LONGEST_MS = 120_000
"""After so long the database counts as failed."""


class BusyWait:
    """One wait for the database, from the first attempt that found it held to the one that did not."""

    def __init__(self, clock: Clock, recorder_waits_ms: int, show: Callable[[bool], None]) -> None:
        """Call ``show`` when the wait has become long, and again when a long wait is over.

        A recorder that waits by itself at each attempt is tried again at once, so that virtual time stands still.
        """
        self._clock = clock
        self._retry_ms = 0 if recorder_waits_ms else RETRY_MS
        self._step_ms = recorder_waits_ms or RETRY_MS
        self._show = show
        self._wait: TimerWait | None = None
        self._waited_ms = 0

    @property
    def under_way(self) -> bool:
        """Whether something is to be tried again."""
        return self._wait is not None

    def try_again(self, call: Callable[[], None], busy: StoreBusy) -> None:
        """Call back soon; raises StorageError, and ends the wait, once it has taken too long."""
        self._waited_ms += self._step_ms
        if self._waited_ms > LONGEST_MS:
            self.end()
            raise StorageError(f"{busy}; it was tried for {LONGEST_MS // MS_PER_SECOND} s") from busy
        if self._waited_ms >= TOLD_AFTER_MS:
            self._show(True)  # noqa: FBT003 - it is what is shown
        self._wait = self._clock.after(self._retry_ms, lambda: self._call(call))

    def end(self) -> None:
        """Wait no more: the database took it, or nothing is to be tried again."""
        if self._wait is not None:
            self._wait.cancel()
            self._wait = None
        if self._waited_ms >= TOLD_AFTER_MS:
            self._show(False)  # noqa: FBT003 - as above
        self._waited_ms = 0

    def _call(self, call: Callable[[], None]) -> None:
        self._wait = None
        call()
