"""Send a marker of every recorded event to the process that has a Lab Streaming Layer outlet."""

from __future__ import annotations

import json
import logging
import time
from collections.abc import Callable, Iterable

from PySide6.QtCore import QObject, QProcess

from kiosk import program
from kiosk.config import MarkersConfig
from kiosk.experiment.events import Event
from kiosk.units import MS_PER_SECOND

MOST_WAITING = 1 << 18
"""Bytes that may wait for the process; a marker beyond them is dropped, for one that comes late is of no use."""
_QUIT_MS = 1_000

_log = logging.getLogger(__name__)


class MarkerStream(QObject):
    """Names each event and the moment it happened, but no answer, code or condition."""

    def __init__(
        self,
        settings: MarkersConfig,
        source: str,
        owner: QObject,
        now_s: Callable[[], float] = time.monotonic,
        command: tuple[str, ...] = (),
    ) -> None:
        """Start the process, or ``command`` in its place; ``source`` names this kiosk among others."""
        super().__init__(owner)
        self._now_s = now_s
        self._dropped = 0
        self._process = QProcess(self)
        self._process.setProcessChannelMode(QProcess.ProcessChannelMode.SeparateChannels)
        self._process.setStandardErrorFile(QProcess.nullDevice())
        self._process.setStandardOutputFile(QProcess.nullDevice())
        self._process.finished.connect(self._ended)
        self._process.errorOccurred.connect(self._ended)
        words = command or program("_markers", settings.stream, source)
        self._process.start(words[0], list(words[1:]))

    @property
    def is_alive(self) -> bool:
        """Whether the process is there."""
        return self._process.state() is not QProcess.ProcessState.NotRunning

    def send(self, participant: str, events: Iterable[Event], now_ms: int) -> None:
        """Send a marker for each event of a session; ``now_ms`` is the present on the events' clock, in ms."""
        if not self.is_alive:
            return
        now_s = self._now_s()
        for event in events:
            if self._process.bytesToWrite() > MOST_WAITING:
                self._dropped += 1
                continue
            happened = now_s - (now_ms - event.at_ms) / MS_PER_SECOND
            fields = {
                "happened": happened,
                "event": type(event).__name__,
                "participant": participant,
                "at_ms": event.at_ms,
            }
            self._process.write(json.dumps(fields).encode() + b"\n")

    def close(self) -> None:
        """Let the process send what waits, and end."""
        self._process.blockSignals(True)  # noqa: FBT003 - Qt's signature
        self._process.closeWriteChannel()
        if not self._process.waitForFinished(_QUIT_MS):
            self._process.kill()
            self._process.waitForFinished(_QUIT_MS)
        if self._dropped:
            _log.warning("%d markers were dropped, for the process that sends them did not take them", self._dropped)

    def _ended(self) -> None:
        _log.warning("the process that sends markers has ended: %s", self._process.errorString())
