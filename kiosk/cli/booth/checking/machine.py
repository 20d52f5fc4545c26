"""The machine as a whole, and the program on it: memory, processors, log, version."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Self

import psutil

from kiosk import __version__
from kiosk.cli.wiring import LOG, LOG_BYTES, LOGS_KEPT
from kiosk.findings import Finding
from kiosk.units import MIB

MACHINE, PROGRAM, LOGGED = "machine", "program", "log"

LEAST_MIB = 400
"""At rest, at 1080p, the kiosk, its voice, the keeper and the calm window took 328 MiB, 174 of them theirs alone; a day
adds nothing."""
BUSY = 1.0
"""Programs that wait for each processor, over the last five minutes; the kiosk itself needs 14 % of one."""

SHORT_COMMIT = 8
_DIRTY = "-dirty"


@dataclass(frozen=True)
class Load:
    """What is left of the machine."""

    free_mib: int
    processors: int
    waiting: float
    """Programs that ran or waited for a processor, on average over five minutes."""

    @classmethod
    def now(cls) -> Self:
        """As it is."""
        _, waiting, _ = psutil.getloadavg()
        return cls(psutil.virtual_memory().available // MIB, psutil.cpu_count() or 1, waiting)


def machine(load: Load) -> Iterator[Finding]:
    """Whether the kiosk will have the memory and the time that it needs."""
    processors = "1 processor" if load.processors == 1 else f"{load.processors} processors"
    words = f"{load.free_mib:,} MiB of memory are free; {processors}, {load.waiting:.1f} programs at work"
    if load.free_mib < LEAST_MIB:
        yield Finding.warning(MACHINE, words, f"end other programs: the kiosk needs {LEAST_MIB} MiB")
    elif load.waiting > BUSY * load.processors:
        yield Finding.warning(MACHINE, words, "end other programs: they take the time that frames and sounds need")
    else:
        yield Finding.good(MACHINE, words)


def program(commit: str) -> Iterator[Finding]:
    """Which Recollect this is; what was changed since its commit cannot be named in the data."""
    words = f"{__version__}, {commit.removesuffix(_DIRTY)[:SHORT_COMMIT]}"
    if commit.endswith(_DIRTY):
        remedy = "commit the changes, or undo them, before people come: the data name the commit"
        yield Finding.warning(PROGRAM, f"{words}, and changed since", remedy)
    else:
        yield Finding.good(PROGRAM, words)


def log(folder: Path) -> Iterator[Finding]:
    """Whether faults can be written down, and how much there is."""
    file = folder / LOG
    size = sum(each.stat().st_size for each in folder.glob(f"{LOG}*")) if folder.is_dir() else 0
    if file.exists() and not os.access(file, os.W_OK):
        yield Finding.bad(LOGGED, f"{file} cannot be written", "give it to the user who runs the kiosk")
    elif size > LOG_BYTES * (LOGS_KEPT + 2):
        words = f"{size / MIB:.1f} MiB; it should be renewed at {LOG_BYTES / MIB:.0f} MiB"
        yield Finding.warning(LOGGED, words, f"look into {file}, then remove it while no kiosk is open")
    else:
        yield Finding.good(LOGGED, f"{size / MIB:.1f} MiB in {LOG}" if size else "nothing was logged yet")
