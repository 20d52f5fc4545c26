"""A thread that does one slow thing after another, so that nobody else has to wait for a device."""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Callable

Job = Callable[[], None]

_QUIT_S = 0.5


class Lane:
    """Jobs wait under a key; a newer job of the same key takes the place of the one that waits."""

    def __init__(self, name: str, between: Job, every_s: float) -> None:
        """``between`` is done whenever no job came for ``every_s`` seconds. No job may raise."""
        self._between = between
        self._every_s = every_s
        self._jobs: OrderedDict[str, Job] = OrderedDict()
        self._changed = threading.Condition()
        self._open = True
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)
        self._thread.start()

    def post(self, key: str, job: Job) -> bool:
        """Do this after what waits already; returns whether another job of the key will now never be done."""
        with self._changed:
            replaced = self._jobs.pop(key, None) is not None
            self._jobs[key] = job
            self._changed.notify()
        return replaced

    def clear(self) -> int:
        """Do nothing of what waits; returns how many jobs that were."""
        with self._changed:
            waiting = len(self._jobs)
            self._jobs.clear()
        return waiting

    def close(self) -> None:
        """Do nothing more once what is under way is over; wait for that, but not for long."""
        with self._changed:
            self._open = False
            self._changed.notify()
        self._thread.join(_QUIT_S)

    def _run(self) -> None:
        while True:
            with self._changed:
                if not self._jobs and self._open:
                    self._changed.wait(self._every_s)
                if not self._jobs and not self._open:
                    return
                job = self._jobs.popitem(last=False)[1] if self._jobs else self._between
            job()
