"""Stretches of a session, such as its pauses, and the time between two moments without them."""

from __future__ import annotations

from collections.abc import Collection

from kiosk.lazy_dataclass import dataclass


@dataclass(frozen=True)
class Interval:
    """A stretch of a session, in ms from its first event; ``until_ms`` is None while it lasts."""

    since_ms: int
    until_ms: int | None = None


def elapsed_ms(begin_ms: int, end_ms: int, without: Collection[Interval] = ()) -> int:
    """Measure the time between two moments in ms, less these intervals; where they overlap they count once."""
    spent, reached = end_ms - begin_ms, begin_ms
    if not without:
        return spent
    for interval in sorted(without, key=lambda each: each.since_ms):
        until_ms = end_ms if interval.until_ms is None else min(interval.until_ms, end_ms)
        spent -= max(0, until_ms - max(interval.since_ms, reached))
        reached = max(reached, until_ms)
    return spent
