"""Writes on a thread of their own, so that the screen is drawn while the disk works."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future

from kiosk.ui.event_loop import Executor


class DiskWriter:
    """Has one write done at a time, and says when it is over."""

    def __init__(self, executor: Executor) -> None:
        """Have the executor do the writes; it calls back on the interface's thread."""
        self._executor = executor
        self._under_way: Future[None] | None = None

    @property
    def is_under_way(self) -> bool:
        """Whether a write was begun whose end was not asked for."""
        return self._under_way is not None

    def begin(self, write: Callable[[], None], then: Callable[[], None]) -> None:
        """Begin a write; ``then`` is called when it is over, unless it was forgotten meanwhile."""
        begun = self._under_way = Future[None]()

        def run() -> None:
            try:
                write()
            except Exception as fault:  # noqa: BLE001 - whatever it is, ``end`` raises it
                begun.set_exception(fault)
            else:
                begun.set_result(None)

        def end(_: None) -> None:
            if self._under_way is begun:
                then()

        self._executor(run, end)

    def end(self) -> None:
        """End the write that is over; raises StorageError if the disk did not take it."""
        ended, self._under_way = self._under_way, None
        if ended is not None:
            ended.result()

    def forget(self) -> None:
        """Do not call back at the end of the write under way."""
        self._under_way = None
