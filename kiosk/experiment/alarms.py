"""Eight alarms that call the experimenter, and when each of them sounds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from datetime import datetime, time
from enum import Enum

from kiosk.config import read_hours
from kiosk.experiment.outcomes import Status
from kiosk.lazy_dataclass import dataclass
from kiosk.units import MS_PER_HOUR, MS_PER_MINUTE, MS_PER_SECOND

AGAIN_MS = 10 * MS_PER_MINUTE
"""An alarm that has not passed sounds again after so long."""

AGAIN_SEEN_MS = MS_PER_HOUR
"""The same for one that the experimenter has seen in the panel."""

BACKUP_OLD_MS = 24 * MS_PER_HOUR
EARLY_IN_A_ROW = 3
PASSED_KEPT = 5
"""How many alarms that have passed are still listed."""


class AlarmKind(Enum):
    """What has happened; the most urgent first."""

    ROBOT_LOST = "robot_lost"
    VOICE_LOST = "voice_lost"
    DISK_LOW = "disk_low"
    EARLY_EXITS = "early_exits"
    RESTARTED = "restarted"
    CLOCK_CHANGED = "clock_changed"
    BACKUP_OLD = "backup_old"
    NO_VISITOR = "no_visitor"


HOLDS_MS: Mapping[AlarmKind, int] = {
    AlarmKind.ROBOT_LOST: 15 * MS_PER_SECOND,
    AlarmKind.VOICE_LOST: 5 * MS_PER_SECOND,
    AlarmKind.BACKUP_OLD: 5 * MS_PER_MINUTE,
}
"""How long it has to be so before it is an alarm: a robot is still being reached, the morning's backup being made."""

PASS_WHEN_SEEN = frozenset({AlarmKind.EARLY_EXITS, AlarmKind.RESTARTED, AlarmKind.CLOCK_CHANGED})
"""Alarms about something that happened and is over: they have passed once the experimenter has seen them."""


@dataclass(frozen=True)
class BoothSigns:
    """What alarms follow from; times are in ms, ``now`` is the local time."""

    now: datetime
    robot_well: bool
    """True if there is no robot."""
    voice_well: bool
    """True if it is silent on purpose, or if there is none."""
    disk_free_mib: int | None
    disk_hour_mib: int
    """What the next hour may need."""
    clock_jump_ms: int
    """How far the clock was set since the start, or stood behind the records then; 0 if it goes as it should."""
    since_backup_ms: int
    """Since the last good backup, or since the start if there is none."""
    ended: Sequence[str]
    """How today's sessions ended (``Status``), the newest first."""
    restarted: bool
    """Whether the kiosk before this one ended without being left."""
    alone_ms: int
    """For how long no visitor has been there; 0 during a session."""


@dataclass(frozen=True)
class OpeningHours:
    """When visitors can come; ``alone_ms`` without one are an alarm."""

    alone_ms: int
    opens: time
    closes: time

    @classmethod
    def from_text(cls, text: str, alone_ms: int) -> OpeningHours:
        """Read hours such as ``10:00-18:00``; an empty text is never open. Raises ValueError for anything else."""
        opens, closes = read_hours(text) if text else (time.min, time.min)
        return cls(alone_ms, opens, closes)

    def alone_since_opening_ms(self, signs: BoothSigns) -> int:
        """Return for how long of the opening hours no visitor has been there; 0 outside of them."""
        if not self.opens <= signs.now.time() < self.closes:
            return 0
        opened = signs.now.replace(hour=self.opens.hour, minute=self.opens.minute, second=0, microsecond=0)
        return min(signs.alone_ms, round((signs.now - opened).total_seconds() * MS_PER_SECOND))


def early_in_a_row(ended: Sequence[str]) -> int:
    """Return how many of the newest sessions ended early, up to the first that was completed."""
    return next((at for at, status in enumerate(ended) if status == Status.COMPLETED.value), len(ended))


def alarms_of(signs: BoothSigns, hours: OpeningHours) -> dict[AlarmKind, int]:
    """Return the alarms that hold; another number for the same kind means that it has happened once more."""
    early = early_in_a_row(signs.ended) // EARLY_IN_A_ROW
    table = (
        (AlarmKind.ROBOT_LOST, 0, not signs.robot_well),
        (AlarmKind.VOICE_LOST, 0, not signs.voice_well),
        (AlarmKind.DISK_LOW, 0, signs.disk_free_mib is not None and signs.disk_free_mib < signs.disk_hour_mib),
        (AlarmKind.EARLY_EXITS, early, early > 0),
        (AlarmKind.RESTARTED, 0, signs.restarted),
        (AlarmKind.CLOCK_CHANGED, round(signs.clock_jump_ms / MS_PER_MINUTE), signs.clock_jump_ms != 0),
        (AlarmKind.BACKUP_OLD, 0, signs.since_backup_ms > BACKUP_OLD_MS),
        (AlarmKind.NO_VISITOR, 0, 0 < hours.alone_ms <= hours.alone_since_opening_ms(signs)),
    )
    return {kind: number for kind, number, holds in table if holds}


@dataclass(frozen=True)
class Alarm:
    """One alarm; ``since_ms`` and ``passed_ms`` are times of the wall's clock, in ms since 1970."""

    kind: AlarmKind
    since_ms: int
    seen: bool = False
    passed_ms: int | None = None


@dataclass
class _Held:
    """An alarm that holds.

    It says which time it is, since when by a clock that cannot be set, and when it sounded last.
    """

    number: int
    from_ms: int
    alarm: Alarm
    sounded_ms: int | None = None
    hidden: bool = False
    """It was seen, and is about something that is over."""


class AlarmBook:
    """Keeps the alarms of one booth: each sounds once, and again only while it has not passed."""

    def __init__(self) -> None:
        """Begin without any."""
        self._held: dict[AlarmKind, _Held] = {}
        self._passed: list[Alarm] = []

    def update(self, found: Mapping[AlarmKind, int], run_ms: int, wall_ms: int) -> tuple[AlarmKind, ...]:
        """Take in which alarms hold now, and return those that sound now.

        ``run_ms`` is a clock that cannot be set, ``wall_ms`` the wall's.
        """
        for kind in [kind for kind, held in self._held.items() if found.get(kind) != held.number]:
            self._pass(self._held.pop(kind), wall_ms)
        for kind, number in found.items():
            self._held.setdefault(kind, _Held(number, run_ms, Alarm(kind, wall_ms)))
        sounding = [kind for kind in AlarmKind if kind in self._held and _is_due(self._held[kind], run_ms)]
        for kind in sounding:
            self._held[kind].sounded_ms = run_ms
        return tuple(sounding)

    def see(self, run_ms: int, wall_ms: int) -> None:
        """Note that the experimenter has seen every alarm."""
        for held in self._held.values():
            if held.sounded_ms is None or held.hidden:
                continue
            held.sounded_ms = run_ms
            held.alarm = replace(held.alarm, seen=True)
            if held.alarm.kind in PASS_WHEN_SEEN:
                self._pass(held, wall_ms)
                held.hidden = True

    @property
    def holding(self) -> tuple[Alarm, ...]:
        """The alarms that have not passed, the most urgent first."""
        return tuple(
            held.alarm
            for kind in AlarmKind
            if (held := self._held.get(kind)) and held.sounded_ms is not None and not held.hidden
        )

    @property
    def passed(self) -> tuple[Alarm, ...]:
        """The last that have passed, the newest first."""
        return tuple(reversed(self._passed))

    def _pass(self, held: _Held, wall_ms: int) -> None:
        if held.sounded_ms is not None and not held.hidden:
            self._passed = [*self._passed, replace(held.alarm, passed_ms=wall_ms)][-PASSED_KEPT:]


def _is_due(held: _Held, run_ms: int) -> bool:
    if held.hidden:
        return False
    if held.sounded_ms is None:
        return run_ms - held.from_ms >= HOLDS_MS.get(held.alarm.kind, 0)
    return run_ms - held.sounded_ms >= (AGAIN_SEEN_MS if held.alarm.seen else AGAIN_MS)
