"""A sitting that was cut off, read from the records so that it can go on."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from kiosk import BadInput
from kiosk.store.recorder import Provenance
from kiosk.study.events import WorldEvent


@dataclass(frozen=True)
class CutOff:
    """What it followed, and what had happened to it from outside, the closing of the kiosk included."""

    number: int
    sitting: Provenance
    past: tuple[WorldEvent, ...]


@dataclass(frozen=True)
class Unreadable:
    """Why it cannot be read."""

    why: str


def read_cut_off(folder: Path, number: int) -> CutOff | Unreadable:
    """Read a sitting; it takes its time, so it is done on a thread of its own."""
    from kiosk.store.reading import archive  # noqa: PLC0415 - a third of a second that opening need not pay

    try:
        with archive(folder) as stored:
            seen = stored.sitting(number)
            story = stored.story(number)
            sitting = Provenance(stored.plan(number), stored.seed(number), seen.body, "", simulated=seen.kind)
    except BadInput as failure:
        return Unreadable(str(failure))
    return CutOff(number, sitting, tuple(event for event in story if isinstance(event, WorldEvent)))
