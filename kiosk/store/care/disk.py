"""Whether there is room left: said in time, and before the disk says it in the middle of a sitting."""

from __future__ import annotations

import shutil
from dataclasses import dataclass
from enum import Enum
from pathlib import Path

from kiosk import BadInput
from kiosk.units import MIB

WARN_MIB = 512
"""A sitting takes some 30 KiB; if it took twice that, a day of 200 would take 12 MiB, and each copy that is kept as
much again. 512 MiB is days of that, and what else a system writes in them: time enough to make room in the evening."""

REFUSE_MIB = 64
"""One sitting, the write-ahead log (4 MiB), the program's logs (4 MB) and one more copy of the database must fit in, or
the sitting that begins now could be lost in its middle. Below this no new one begins."""


class Level(Enum):
    """What the room that is left allows."""

    ENOUGH = "enough"
    WARN = "warn"
    REFUSE = "refuse"


@dataclass(frozen=True)
class Room:
    """The room that is left on the disk of a data folder, in MiB."""

    free_mib: int

    @property
    def level(self) -> Level:
        """What it allows."""
        if self.free_mib < REFUSE_MIB:
            return Level.REFUSE
        return Level.WARN if self.free_mib < WARN_MIB else Level.ENOUGH


def room(folder: Path) -> Room:
    """The room that is left for a data folder, whether or not it is there yet; raises BadInput if nobody can say."""
    there = next((place for place in (folder, *folder.absolute().parents) if place.is_dir()), folder)
    try:
        return Room(shutil.disk_usage(there).free // MIB)
    except OSError as error:
        raise BadInput(f"the room that is left for {folder} cannot be told: {error.strerror}") from error
