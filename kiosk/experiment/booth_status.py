"""What a running booth says about itself in status.json: never a condition, a code or an answer."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict
from datetime import UTC, datetime
from typing import Any, Self

from kiosk.files import parse_json
from kiosk.lazy_dataclass import dataclass
from kiosk.units import MS_PER_SECOND

FORMAT = "recollect-status-1"
FILE = "status.json"
"""What the file in the data folder is called."""

WRITE_EVERY_S = 5
"""The file is written at each change, and after so long without one."""

STALE_S = 15
"""A kiosk whose file is older has ended without saying so, or hangs."""

PACE_SESSIONS = 3
PACE_S = 30 * 60
"""Fewer sessions in less time tell nothing of the hours to come."""

S_PER_HOUR = 3_600

CLOSED = "closed"
"""The stage in the last file of a kiosk that was left."""


@dataclass(frozen=True)
class DayCounts:
    """The sessions since midnight by the machine's clock; ``last_hour`` are those completed in the last 60 minutes."""

    begun: int = 0
    completed: int = 0
    ended_early: int = 0
    last_hour: int = 0
    since: str | None = None
    """When the first of them began (UTC)."""

    def hours_for(self, games: int, now: datetime) -> float | None:
        """Return how many hours ``games`` more completed sessions take at the pace of today.

        None while fewer than PACE_SESSIONS are completed, or the first began less than PACE_S ago: that is no pace.
        """
        if self.since is None or self.completed < PACE_SESSIONS:
            return None
        seconds = (now - datetime.fromisoformat(self.since)).total_seconds()
        return None if seconds < PACE_S else games * seconds / self.completed / S_PER_HOUR


@dataclass(frozen=True)
class EndedSession:
    """How a session ended: when (UTC, ISO 8601), with which status, and in which stage."""

    at: str
    status: str
    stage: str


@dataclass(frozen=True)
class PartStatus:
    """How one part of the booth is; the message is in the language of the console."""

    name: str
    ok: bool
    message: str


@dataclass(frozen=True)
class AlarmStatus:
    """An alarm: its kind, since when (UTC), whether the experimenter has seen it, and when it passed, if it has."""

    kind: str
    since: str
    seen: bool
    passed: str | None


_ABOUT = {"robot_lost": "robot", "voice_lost": "voice", "disk_low": "disk"}
"""Of an alarm's kind the name of the part that it is about."""


@dataclass(frozen=True)
class BoothStatus:
    """The whole of status.json; times are UTC in ISO 8601."""

    at: str
    started_at: str
    version: str
    pid: int
    site: str
    study: str
    study_sha256: str
    kind: str
    stage: str
    stage_since: str
    paused: bool
    supervised: bool
    today: DayCounts
    ended: tuple[EndedSession, ...]
    parts: tuple[PartStatus, ...]
    disk_free_mib: int | None
    last_backup_at: str | None
    alarms: tuple[AlarmStatus, ...] = ()
    """Those that hold, the most urgent first, then the last that have passed."""

    def to_json(self) -> str:
        """Return the text of the file."""
        return json.dumps({"format": FORMAT, **asdict(self)}, ensure_ascii=False, indent=2) + "\n"

    @classmethod
    def from_json(cls, text: str) -> Self:
        """Read the text of a file; raises ValueError if it is none of this format."""
        try:
            given = parse_json(text)
            return cls(
                **{key: value for key, value in given.items() if (key, value) != ("format", FORMAT)}
                | {
                    "today": DayCounts(**given["today"]),
                    "ended": tuple(EndedSession(**each) for each in given["ended"]),
                    "parts": tuple(PartStatus(**each) for each in given["parts"]),
                    "alarms": tuple(AlarmStatus(**each) for each in given.get("alarms", ())),
                }
            )
        except (AttributeError, KeyError, TypeError, ValueError) as error:
            raise ValueError(f"it is not of the format {FORMAT}") from error

    def age_s(self, now: datetime) -> float:
        """Return how many seconds ago the file was written."""
        return (now - datetime.fromisoformat(self.at)).total_seconds()

    def is_alive(self, now: datetime) -> bool:
        """Return whether the kiosk still writes."""
        return self.stage != CLOSED and self.age_s(now) < STALE_S

    @property
    def failing(self) -> tuple[PartStatus, ...]:
        """The parts that are not well."""
        return tuple(part for part in self.parts if not part.ok)

    @property
    def holding_alarms(self) -> tuple[AlarmStatus, ...]:
        """The alarms that hold, but for those of a failing part, which says more itself."""
        failing = {part.name for part in self.failing}
        return tuple(alarm for alarm in self.alarms if alarm.passed is None and _ABOUT.get(alarm.kind) not in failing)

    def changed_from(self, earlier: BoothStatus | None) -> bool:
        """Return whether anything but the time of writing is different."""
        return earlier is None or _without_time(self) != _without_time(earlier)


def utc(wall_ms: int) -> str:
    """Return a time of the wall's clock, in ms since 1970, as status.json writes it."""
    return datetime.fromtimestamp(wall_ms / MS_PER_SECOND, UTC).isoformat(timespec="seconds")


def _without_time(status: BoothStatus) -> Mapping[str, Any]:
    # The free room changes with every record: a full MiB more or less is no news.
    return {key: value for key, value in asdict(status).items() if key not in {"at", "disk_free_mib"}}
