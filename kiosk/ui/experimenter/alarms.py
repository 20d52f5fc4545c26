"""Ring for the experimenter: look at the booth each second, and sound, show and log its alarms."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator
from datetime import datetime

from kiosk.assistance.wording import Catalogue
from kiosk.config import ExperimenterConfig
from kiosk.experiment.alarms import Alarm, AlarmBook, AlarmKind, BoothSigns, OpeningHours, alarms_of
from kiosk.experiment.booth_status import AlarmStatus, utc
from kiosk.ui.event_loop import Clock, TimerWait
from kiosk.ui.experimenter.view_model import Row
from kiosk.units import MS_PER_MINUTE, MS_PER_SECOND

LOOK_MS = 1_000

_log = logging.getLogger(__name__)


class AlarmBell:
    """The alarms of one booth."""

    def __init__(  # noqa: PLR0913, PLR0917 - whom it has to do with
        self,
        settings: ExperimenterConfig,
        signs: Callable[[], BoothSigns],
        resting: Callable[[], bool],
        play: Callable[[], None],
        clock: Clock,
        now_ms: Callable[[], int],
    ) -> None:
        """``signs`` tells how the booth is; ``play`` sounds; ``resting`` tells whether no session is under way."""
        self.changed: Callable[[], None] = lambda: None
        """Called when an alarm comes, is seen, or passes."""
        self._sound = settings.alarm_sound
        self._hours = OpeningHours.from_text(settings.opening_hours, settings.alone_alarm * MS_PER_MINUTE)
        self._signs = signs
        self._resting = resting
        self._play = play
        self._clock = clock
        self._now_ms = now_ms
        self._book = AlarmBook()
        self._rings_later = False
        self._tick: TimerWait | None = None

    def begin(self) -> None:
        """Look now, and go on looking."""
        before = self.alarms
        sounding = self._book.update(alarms_of(self._signs(), self._hours), self._clock.now_ms(), self._now_ms())
        if sounding:
            _log.warning("alarm: %s", ", ".join(kind.value for kind in sounding))
        self._ring(anew=bool(sounding))
        if self.alarms != before:
            self.changed()
        self._tick = self._clock.after(LOOK_MS, self.begin)

    def close(self) -> None:
        """Look no more."""
        if self._tick is not None:
            self._tick.cancel()
            self._tick = None

    def see(self) -> None:
        """Note that the experimenter looks at the alarms."""
        self._rings_later = False
        self._book.see(self._clock.now_ms(), self._now_ms())
        self.changed()

    @property
    def alarms(self) -> tuple[Alarm, ...]:
        """Those that hold, then those that have passed."""
        return (*self._book.holding, *self._book.passed)

    @property
    def calls(self) -> bool:
        """Whether an alarm holds that the experimenter has not seen."""
        return any(not alarm.seen for alarm in self._book.holding)

    def _ring(self, *, anew: bool) -> None:
        """Sound now, or after the session."""
        if anew or self._rings_later:
            waits = self._sound == "between" and not self._resting()
            self._rings_later = waits
            if not waits and self._sound != "never":
                self._play()


def alarm_status(alarms: tuple[Alarm, ...]) -> tuple[AlarmStatus, ...]:
    """Return the alarms as status.json has them."""
    return tuple(
        AlarmStatus(
            alarm.kind.value,
            utc(alarm.since_ms),
            alarm.seen,
            None if alarm.passed_ms is None else utc(alarm.passed_ms),
        )
        for alarm in alarms
    )


def alarm_rows(alarms: tuple[Alarm, ...], catalogue: Catalogue) -> list[Row]:
    """Return the alarms as the panel shows them."""
    return list(_rows(alarms, catalogue))


def _rows(alarms: tuple[Alarm, ...], catalogue: Catalogue) -> Iterator[Row]:
    for alarm in alarms:
        until = "" if alarm.passed_ms is None else catalogue.text("console-alarm-until", time=_time(alarm.passed_ms))
        yield {
            "when": _time(alarm.since_ms),
            "words": f"{alarm_words(alarm.kind, catalogue)}{until}",
            "holds": alarm.passed_ms is None,
        }


def alarm_words(kind: AlarmKind, catalogue: Catalogue) -> str:
    """Return what an alarm says."""
    return catalogue.text(f"console-alarm-{kind.value.replace('_', '-')}")


def _time(wall_ms: int) -> str:
    return f"{datetime.fromtimestamp(wall_ms / MS_PER_SECOND).astimezone():%H:%M}"
