"""Whether the wall's clock can be right: it stands before nothing that has already happened."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import UTC, datetime, timedelta
from pathlib import Path

from kiosk import BadInput
from kiosk.findings import Finding
from kiosk.store.database import FILE
from kiosk.store.glance import last_written_ms
from kiosk.units import MS_PER_SECOND

WHAT = "clock"

SLACK = timedelta(minutes=1)
"""A clock that is set by the network may go back a little."""

_REMEDY = "set the clock (Debian: timedatectl set-ntp true); sittings before that keep their wrong dates"


def clock(folder: Path, now: datetime, made: datetime | None) -> Iterator[Finding]:
    """``now`` is the wall's clock with its zone; ``made`` is when this program was."""
    shown = f"{now:%Y-%m-%d %H:%M}, {now.tzname()} ({now:%z})"
    written = newest(folder)
    if written is not None and now + SLACK < written:
        last = f"{written.astimezone(now.tzinfo):%Y-%m-%d %H:%M}"
        words = f"{shown} is before the last record, of {last}: it was set back"
        yield Finding.warning(WHAT, words, _REMEDY)
    elif made is not None and now + SLACK < made:
        yield Finding.warning(WHAT, f"{shown} is before this program was made, {made:%Y-%m-%d}", _REMEDY)
    else:
        yield Finding.good(WHAT, shown)


def newest(folder: Path) -> datetime | None:
    """When anything was written last; None if nothing was, or nobody can tell."""
    if not (folder / FILE).exists():
        return None
    try:
        written_ms = last_written_ms(folder)
    except BadInput:
        return None
    return datetime.fromtimestamp(written_ms / MS_PER_SECOND, UTC) if written_ms else None
