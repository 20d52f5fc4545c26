"""Writes on a thread of their own, so that the screen is drawn while the disk works."""

from __future__ import annotations

from collections.abc import Callable
from threading import Event

from kiosk import StorageError
from kiosk.ui.event_loop import Executor


class Write:
    """One write that another thread does."""

    def __init__(self, write: Callable[[], None]) -> None:
        """Nothing is done before ``run``."""
        self._write = write
        self._over = Event()
        self._failed: StorageError | None = None

    def run(self) -> None:
        """Do it, on whichever thread this is."""
        try:
            self._write()
        except StorageError as failed:
            self._failed = failed
        finally:
            self._over.set()

    def wait(self) -> None:
        """Wait until it is over."""
        self._over.wait()

    def check(self) -> None:
        """Raise StorageError if the disk did not take it."""
        if self._failed is not None:
            raise self._failed


class DiskWriter:
    """Has one write done at a time, and says when it is over."""

    def __init__(self, executor: Executor) -> None:
        """Have the executor do the writes; it calls back on the interface's thread."""
        self._executor = executor
        self._under_way: Write | None = None

    @property
    def is_under_way(self) -> bool:
        """Whether a write was begun whose end was not asked for."""
        return self._under_way is not None

    def begin(self, write: Callable[[], None], then: Callable[[], None]) -> None:
        """Begin a write; ``then`` is called when it is over, unless it was forgotten meanwhile."""
        begun = self._under_way = Write(write)

        def end(_: None) -> None:
            if self._under_way is begun:
                then()

        self._executor(begun.run, end)

    def end(self) -> None:
        """End the write that is over; raises StorageError if the disk did not take it."""
        ended, self._under_way = self._under_way, None
        if ended is not None:
            ended.wait()
            ended.check()

    def forget(self) -> None:
        """Do not call back at the end of the write under way."""
        self._under_way = None
