"""Whether a data folder has room, is nobody else's, and takes a record before a person would notice."""

from __future__ import annotations

import os
import shutil
import sqlite3
import stat
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing
from pathlib import Path

from kiosk import BadInput
from kiosk.findings import Finding
from kiosk.store.care.disk import REFUSE_MIB, WARN_MIB, Level, room
from kiosk.store.connecting import reason
from kiosk.store.database import durable

ROOM, FOLDER, WRITING = "disk", "data folder", "writing"

TIMES = 20
LONGEST_S = 3.0
"""A disk that takes longer for so many records has said enough."""

SLOW_MS = 16.0
"""A record is on the disk before the screen changes: in the usual case that must fit into one frame."""
STALL_MS = 250.0
"""A tap whose answer takes so long is tapped again."""

_PREFIX = ".recollect-check-"
_STALE_S = 60
_RECORD = "x" * 400
"""A tap and what comes of it take some 400 bytes."""

_OTHERS = stat.S_IRWXG | stat.S_IRWXO


def space(folder: Path) -> Iterator[Finding]:
    """The room that is left."""
    try:
        left = room(folder)
    except BadInput as failure:
        yield Finding.bad(ROOM, str(failure), "see that the disk is there")
        return
    words = f"{left.free_mib:,} MiB are free"
    match left.level:
        case Level.ENOUGH:
            yield Finding.good(ROOM, words)
        case Level.WARN:
            yield Finding.warning(ROOM, words, f"make room, to {WARN_MIB} MiB: below {REFUSE_MIB} nobody can begin")
        case Level.REFUSE:
            yield Finding.bad(ROOM, f"{words}, and nobody can begin", f"make room, to {WARN_MIB} MiB")


def access(folder: Path) -> Iterator[Finding]:
    """Who may read the data, and whether we may write there."""
    place = standing(folder)
    if not os.access(place, os.W_OK | os.X_OK):
        yield Finding.bad(FOLDER, f"{place} cannot be written", "give it to the user who runs the kiosk")
    elif place != folder.absolute():
        yield Finding.good(FOLDER, f"{folder} is not there yet; it is made when the kiosk opens")
    elif sys.platform != "win32" and stat.S_IMODE(folder.stat().st_mode) & _OTHERS:
        yield Finding.warning(FOLDER, f"others on this machine can look into {folder}", f"chmod 700 {folder}")
    else:
        yield Finding.good(FOLDER, f"{folder} is this user's alone")


def writing(folder: Path, measure: Callable[[Path], Sequence[float]] | None = None) -> Iterator[Finding]:
    """How long a record takes to be on the disk; ``measure`` stands in for the disk in tests."""
    try:
        times = sorted((measure or written_ms)(standing(folder)))
    except (OSError, sqlite3.Error) as failure:
        yield Finding.bad(
            WRITING,
            f"the disk takes no records: {reason(failure, standing(folder))}",
            "see that it is neither full nor read-only",
        )
        return
    usual, longest = times[len(times) // 2], times[-1]
    words = f"a record is on the disk in {usual:.1f} ms, at most {longest:.0f} ms, of {len(times)}"
    if usual > SLOW_MS or longest > STALL_MS:
        remedy = "use a disk of this machine, not a memory card or a network; end what else writes to it"
        yield Finding.warning(WRITING, words, remedy)
    else:
        yield Finding.good(WRITING, words)


def written_ms(place: Path) -> list[float]:
    """How long each of some records takes, in a database of its own on the same disk that is gone afterwards, in ms."""
    _remove_stale(place)
    times: list[float] = []
    with (
        tempfile.TemporaryDirectory(prefix=_PREFIX, dir=place) as folder,
        closing(sqlite3.connect(Path(folder) / "records.db", isolation_level=None)) as connection,
    ):
        durable(connection)
        connection.execute("CREATE TABLE record (body TEXT)")
        end = time.monotonic() + LONGEST_S
        while len(times) < TIMES and (not times or time.monotonic() < end):
            begun = time.perf_counter()
            connection.execute("INSERT INTO record VALUES (?)", (_RECORD,))
            times.append((time.perf_counter() - begun) * 1000)
    return times


def standing(folder: Path) -> Path:
    """The data folder, or what is there of the way to it."""
    folder = folder.absolute()
    return next(place for place in (folder, *folder.parents) if place.is_dir())


def _remove_stale(place: Path) -> None:
    """Clear what a look that was cut off has left; one that is under way is younger."""
    for left in place.glob(f"{_PREFIX}*"):
        if time.time() - left.stat().st_mtime > _STALE_S:
            shutil.rmtree(left, ignore_errors=True)
