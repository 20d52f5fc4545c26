"""Slow work on a thread of its own, and the one way back to the interface's: what lands is done there, soon."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from queue import SimpleQueue
from threading import Lock, Thread
from typing import Protocol, TypeVar

from PySide6.QtCore import QObject, Qt, Signal

_Result = TypeVar("_Result")

END_S = 2.0
"""How long closing waits for the work at hand; what takes longer ends with the program."""


class Landing(QObject):
    """Takes jobs from any thread, and does them in order on the thread that it was made on."""

    _landed = Signal(object)

    def __init__(self) -> None:
        super().__init__()
        self._lock = Lock()
        self._open = True
        self._landed.connect(self._do, Qt.ConnectionType.QueuedConnection)

    def __call__(self, job: Callable[[], None]) -> None:
        """Have this done on the interface's thread; not at all once it is closed."""
        with self._lock:
            if self._open:
                self._landed.emit(job)

    def close(self) -> None:
        """Do nothing more, whoever still comes."""
        with self._lock:
            self._open = False

    def _do(self, job: Callable[[], None]) -> None:
        if self._open:
            job()


class Work(Protocol):
    """Has something done that may take a while."""

    def __call__(self, job: Callable[[], _Result], then: Callable[[_Result], None]) -> None:
        """Do ``job`` somewhere, and then, on the interface's thread, ``then`` with its result."""
        ...


class Worker:
    """Does one job after another on a thread of its own; a fault in one is raised on the interface's thread."""

    def __init__(self, landing: Landing) -> None:
        """Results come back by this way."""
        self._landing = landing
        self._jobs: SimpleQueue[Callable[[], None] | None] = SimpleQueue()
        self._thread = Thread(target=self._run, name="worker", daemon=True)
        self._thread.start()

    def __call__(self, job: Callable[[], _Result], then: Callable[[_Result], None]) -> None:
        """Do ``job`` when those before it are done, and then, on the interface's thread, ``then``."""
        self._jobs.put(partial(self._do, job, then))

    def close(self) -> None:
        """Begin no further job."""
        self._jobs.put(None)
        self._thread.join(END_S)

    def _run(self) -> None:
        while (job := self._jobs.get()) is not None:
            job()

    def _do(self, job: Callable[[], _Result], then: Callable[[_Result], None]) -> None:
        try:
            result = job()
        except Exception as fault:  # noqa: BLE001 - whatever it is, it is raised where faults are seen
            self._landing(partial(_raise, fault))
        else:
            self._landing(partial(then, result))


class AtOnce:
    """Does every job on the spot: where time is virtual, nothing takes any."""

    def __call__(self, job: Callable[[], _Result], then: Callable[[_Result], None]) -> None:
        """Do ``job``, then ``then``."""
        then(job())

    def close(self) -> None:
        """Nothing is under way."""


def _raise(fault: Exception) -> None:
    raise fault
