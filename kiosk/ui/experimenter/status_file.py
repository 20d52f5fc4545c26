"""Write status.json as long as the kiosk runs."""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path

from kiosk import why
from kiosk.experiment.booth_status import CLOSED, FILE, WRITE_EVERY_S, BoothStatus, DayCounts, EndedSession
from kiosk.files import read_bytes, replace_file
from kiosk.ui.event_loop import Clock, Executor, TimerWait
from kiosk.units import MS_PER_SECOND

LOOK_MS = 1_000
"""How often it is seen whether anything has changed."""

READ_EVERY_MS = 60_000
"""How often the records are read again within a stage: the last hour goes on, and so does the day."""

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
        self._read_at = 0
        self._written: BoothStatus | None = None
        self._written_at = 0
        self._failed = False
        self._tick: TimerWait | None = None
        self.observers: list[Callable[[BoothStatus], None]] = []
        """Called with what is written, each time; they return at once."""

    def begin(self) -> None:
        """Write it now, and go on writing it."""
        self._look()

    @property
    def day(self) -> Day:
        """The sessions of today, as they were last read."""
        return self._day

    def close(self) -> None:
        """Write for the last time: the kiosk is closed."""
        if self._tick is None:
            return
        self._tick.cancel()
        self._tick = None
        closed = replace(self._status(), stage=CLOSED)
        self._publish(closed)
        self._took(write_status(self._file, closed))

    def _look(self) -> None:
        status = self._status()
        if status.stage != self._stage or self._clock.now_ms() - self._read_at >= READ_EVERY_MS:
            # Sessions begin and end with a change of stage, and the hour goes on: the records are read again.
            self._stage, self._read_at = status.stage, self._clock.now_ms()
            self._work(self._read_day, self._take_day)
        since_ms = self._clock.now_ms() - self._written_at
        if status.changed_from(self._written) or since_ms >= WRITE_EVERY_S * MS_PER_SECOND:
            self._written, self._written_at = status, self._clock.now_ms()
            self._publish(status)
            self._work(partial(write_status, self._file, status), self._took)
        self._tick = self._clock.after(LOOK_MS, self._look)

    def _publish(self, status: BoothStatus) -> None:
        for observer in self.observers:
            observer(status)

    def _status(self) -> BoothStatus:
        today, ended = self._day
        return replace(self._now(), today=today, ended=ended)

    def _take_day(self, day: Day) -> None:
        self._day = day

    def _took(self, why: str) -> None:
        if why and not self._failed:
            _log.warning("%s cannot be written: %s", self._file, why)
        self._failed = bool(why)


def was_cut_off(folder: Path) -> bool:
    """Tell from status.json whether the kiosk before ended without being left."""
    try:
        before = BoothStatus.from_json(read_bytes(folder / FILE).decode("utf-8"))
    except (OSError, ValueError):
        return False
    return before.stage != CLOSED


def write_status(file: Path, status: BoothStatus) -> str:
    """Replace the file as a whole, for its owner alone; returns why it could not be, or an empty text."""
    try:
        replace_file(file, status.to_json(), 0o600, durable=False)
    except OSError as error:
        return why(error)
    return ""
