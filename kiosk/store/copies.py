"""Where copies, merged folders and data sets of a data folder went, so that a withdrawal can name them."""

from __future__ import annotations

import json
import logging
import os
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import UTC, datetime
from enum import Enum
from pathlib import Path

from kiosk.files import parse_json, read_bytes, sync_folder
from kiosk.store.connecting import PRIVATE, give_to_owner_of_folder, make_private
from kiosk.store.database import FILE as DATABASE
from kiosk.store.tombstones import sessions_in

FILE = "recollect.copies"

_log = logging.getLogger(__name__)


class CopyKind(Enum):
    """What was made of a data folder."""

    BACKUP = "backup"
    MERGE = "merged folder"
    EXPORT = "data set"


@dataclass(frozen=True)
class KnownCopy:
    """Something that may hold people of a data folder, where it was made, and when (UTC)."""

    kind: CopyKind
    place: Path
    made_at: str


def note_copy(folder: Path, kind: CopyKind, place: Path) -> None:
    """Add a line to the list beside a database; where it cannot be written, that is logged and nothing else."""
    line = {"made_at": datetime.now(UTC).isoformat(timespec="seconds"), "kind": kind.value}
    text = json.dumps(line | {"place": str(place.absolute())}) + "\n"
    file = folder / FILE
    try:
        # One write at the end: two programs may note something at once, and a torn line is passed over.
        # A pipe in its place is an error at once, and not waited for.
        flags = os.O_WRONLY | os.O_APPEND | os.O_CREAT | getattr(os, "O_NONBLOCK", 0)
        descriptor = os.open(file, flags, PRIVATE)
        try:
            os.write(descriptor, text.encode())
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
        make_private(file)
        give_to_owner_of_folder(file)
        sync_folder(folder)
    except OSError as error:
        _log.warning("%s could not be noted in %s: %s", place, file, error)


def known_copies(folder: Path) -> list[KnownCopy]:
    """Return what was noted and may still be there, each place once, oldest first.

    A place on a drive that is not plugged in counts as there.
    """
    found = {copy.place: copy for copy in _read(folder / FILE)}
    return [copy for copy in found.values() if copy.place.exists() or not copy.place.parent.exists()]


@dataclass(frozen=True)
class Elsewhere:
    """What was found in the copies of a folder that are elsewhere."""

    holding: tuple[tuple[KnownCopy, list[int]], ...] = ()
    """Copies that hold people who withdrew, and their sessions there."""
    unseen: tuple[tuple[KnownCopy, str], ...] = ()
    """Copies that could not be looked into, and why."""


def look_elsewhere(folder: Path, hashes: frozenset[bytes], last_day: str) -> Elsewhere:
    """Look for people who withdrew in all copies elsewhere that are known of.

    ``last_day`` is the newest day of a withdrawal: a data set that was made later holds none of them.
    """
    holding: list[tuple[KnownCopy, list[int]]] = []
    unseen: list[tuple[KnownCopy, str]] = []
    for copy in known_copies(folder) if hashes else ():
        if copy.kind is CopyKind.EXPORT:
            if copy.made_at[: len(last_day)] <= last_day:
                unseen.append((copy, f"a data set names no codes; the last withdrawal was on {last_day}"))
            continue
        database = copy.place / DATABASE if copy.kind is CopyKind.MERGE else copy.place
        sessions = sessions_in(database, hashes)
        if sessions:
            holding.append((copy, sessions))
        elif sessions is None:
            why = "it cannot be read, or is encrypted" if database.exists() else "it is not there, or not plugged in"
            unseen.append((copy, why))
    return Elsewhere(tuple(holding), tuple(unseen))


def _read(file: Path) -> Iterator[KnownCopy]:
    try:
        lines = read_bytes(file).decode("utf-8", "replace").splitlines()
    except OSError:
        return
    for line in lines:
        try:
            told = parse_json(line)
            yield KnownCopy(CopyKind(told["kind"]), Path(told["place"]), str(told["made_at"]))
        except (ValueError, KeyError, TypeError):
            continue
