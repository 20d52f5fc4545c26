"""The one way from other threads back to the interface's: what is given to it is done there, soon."""

from __future__ import annotations

from collections.abc import Callable
from threading import Lock

from PySide6.QtCore import QObject, Qt, Signal


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
