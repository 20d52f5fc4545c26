"""Write status.json into the data folder: at each change, and every few seconds."""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path

from kiosk import why
from kiosk.experiment.booth_status import CLOSED, FILE, WRITE_EVERY_S, BoothStatus, DayCounts, EndedSession
from kiosk.files import replace_file
from kiosk.ui.event_loop import Clock, Executor, TimerWait
from kiosk.units import MS_PER_SECOND

LOOK_MS = 1_000
"""How often it is seen whether anything has changed."""

Day = tuple[DayCounts, tuple[EndedSession, ...]]

_log = logging.getLogger(__name__)


class StatusFile:
    """Keeps status.json true as long as the kiosk runs.

    A disk that does not take it is no fault of a session.
    """

    def __init__(
        self,
        folder: Path,
        now: Callable[[], BoothStatus],
        read_day: Callable[[], Day],
        clock: Clock,
        work: Executor,
    ) -> None:
        """``now`` gives the status but for the day's sessions; ``read_day`` reads those, on the executor ``work``."""
        self._file = folder / FILE
        self._now = now
        self._read_day = read_day
        self._clock = clock
        self._work = work
        self._day: Day = (DayCounts(), ())
        self._stage = ""
        self._written: BoothStatus | None = None
        self._written_at = 0
        self._failed = False
        self._tick: TimerWait | None = None

    def begin(self) -> None:
        """Write it now, and go on writing it."""
        self._look()

    def close(self) -> None:
        """Write for the last time: the kiosk is closed."""
        if self._tick is None:
            return
        self._tick.cancel()
        self._tick = None
        self._took(write_status(self._file, replace(self._status(), stage=CLOSED)))

    def _look(self) -> None:
        status = self._status()
        if status.stage != self._stage:
            # Sessions begin and end with a change of stage, and the hour goes on: the records are read again.
            self._stage = status.stage
            self._work(self._read_day, self._take_day)
        since_ms = self._clock.now_ms() - self._written_at
        if status.changed_from(self._written) or since_ms >= WRITE_EVERY_S * MS_PER_SECOND:
            self._written, self._written_at = status, self._clock.now_ms()
            self._work(partial(write_status, self._file, status), self._took)
        self._tick = self._clock.after(LOOK_MS, self._look)

    def _status(self) -> BoothStatus:
        today, ended = self._day
        return replace(self._now(), today=today, ended=ended)

    def _take_day(self, day: Day) -> None:
        self._day = day

    def _took(self, why: str) -> None:
        if why and not self._failed:
            _log.warning("%s cannot be written: %s", self._file, why)
        self._failed = bool(why)


def write_status(file: Path, status: BoothStatus) -> str:
    """Replace the file as a whole, for its owner alone; returns why it could not be, or an empty text."""
    try:
        replace_file(file, status.to_json(), 0o600, durable=False)
    except OSError as error:
        return why(error)
    return ""
