"""The units that more than one room reckons in."""

from __future__ import annotations

from dataclasses import dataclass

MS_PER_SECOND = 1000
SECONDS_PER_MINUTE = 60
MS_PER_MINUTE = MS_PER_SECOND * SECONDS_PER_MINUTE
MS_PER_HOUR = MS_PER_MINUTE * 60

MIB = 1024 * 1024


def as_minutes(ms: float) -> str:
    """Return a time as in 12:05, to the nearest second."""
    minutes, seconds = divmod(round(ms / MS_PER_SECOND), SECONDS_PER_MINUTE)
    return f"{minutes}:{seconds:02}"


@dataclass(frozen=True)
class Unit:
    """What a setting is measured in."""

    name: str
