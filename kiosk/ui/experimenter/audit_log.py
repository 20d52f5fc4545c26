"""Write down what the experimenter does, and keep for later what the disk did not take."""

from __future__ import annotations

import logging
import time
from collections import deque
from collections.abc import Mapping
from typing import Any

from kiosk import StorageError
from kiosk.experiment.experimenter import AuditEvent
from kiosk.store.recorder import Recorder, StoreBusy
from kiosk.ui.event_loop import Clock, TimerWait

KEPT_RETRY_MS = 100
"""How long until a note of what has happened is tried again."""
CLOSING_WAIT_MS = 500
"""How long closing waits for the last notes, after it has waited for the session."""
NS_PER_MS = 1_000_000


_log = logging.getLogger(__name__)


class AuditLog:
    """Writes down what happens at the booth, and remembers in words what the disk did not take."""

    def __init__(self, recorder: Recorder, clock: Clock) -> None:
        """Try again on this clock to write what another program holds up."""
        self.error = ""
        """Why the last thing could not be written; empty if it could."""
        self._recorder = recorder
        self._clock = clock
        self._kept: deque[tuple[AuditEvent, Mapping[str, Any], int]] = deque()
        self._again: TimerWait | None = None

    def __call__(self, note: AuditEvent, payload: Mapping[str, Any]) -> bool:
        """Write it down before it is done; whether the disk took it. Raises StoreBusy, and can be called again."""
        while self._kept:
            self._write(*self._kept[0])
            self._kept.popleft()
        return self._write(note, payload, None)

    def record(self, note: AuditEvent, payload: Mapping[str, Any]) -> None:
        """Write down what has happened already: now, or as soon as another program lets go of the database."""
        self._kept.append((note, payload, time.time_ns() // NS_PER_MS))
        if self._again is None:
            self._write_kept()

    def close(self) -> None:
        """Write down what is left, or tell the log that it cannot be."""
        if self._again is not None:
            self._again.cancel()
            self._again = None
        with self._recorder.retrying(CLOSING_WAIT_MS):
            self._write_kept()
        if self._again is not None:
            _log.error("the last notes could not be written: another program holds the database")
            self._again.cancel()

    def _write_kept(self) -> None:
        self._again = None
        while self._kept:
            try:
                self._write(*self._kept[0])
            except StoreBusy:
                self._again = self._clock.after(KEPT_RETRY_MS, self._write_kept)
                return
            self._kept.popleft()

    def _write(self, note: AuditEvent, payload: Mapping[str, Any], wall_ms: int | None) -> bool:
        try:
            self._recorder.add_audit_event(note.value, payload, wall_ms)
        except StoreBusy as busy:
            self.error = str(busy)
            raise
        except StorageError as failure:
            _log.error("%s", failure)
            self.error = str(failure)
            return False
        self.error = ""
        return True
