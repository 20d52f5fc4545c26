"""Where the data of a folder also lie: its copies, merged folders, data sets and source folders."""

from __future__ import annotations

import json
import logging
import os
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from datetime import UTC, datetime
from enum import Enum
from pathlib import Path

from kiosk.files import parse_json, read_bytes, sync_folder
from kiosk.store.connecting import PRIVATE, give_to_owner_of_folder, make_private
from kiosk.store.database import BACKUPS
from kiosk.store.database import FILE as DATABASE
from kiosk.store.maintenance import list_backups
from kiosk.store.tombstones import sessions_in

FILE = "recollect.copies"

_log = logging.getLogger(__name__)


class CopyKind(Enum):
    """What was made of a data folder, or what it was made of."""

    BACKUP = "backup"
    MERGE = "merged folder"
    EXPORT = "data set"
    SOURCE = "source folder"
    """What a merged folder was merged from."""


@dataclass(frozen=True)
class KnownCopy:
    """Something that may hold people of a data folder, where it lies, and when it was noted (UTC)."""

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


def copies_to_see_to(folder: Path, withdrawn: frozenset[bytes]) -> Iterator[tuple[KnownCopy, list[int]]]:
    """Yield the known copies that may hold people who withdrew, and their sessions there.

    A database that can be read and holds none of them is left out; of one that cannot be read there are no sessions.
    """
    for copy in known_copies(folder):
        sessions = _sessions(copy, withdrawn) if withdrawn else None
        if sessions is None or sessions:
            yield copy, sessions or []


@dataclass(frozen=True)
class Backup:
    """A copy of the database of a data folder, and when it was made."""

    file: Path
    at: datetime


def backups_of(folder: Path) -> list[Backup]:
    """Return the copies of a database, oldest first: those in its folder, and those that were carried elsewhere."""
    found = []
    for file in list_backups(folder / BACKUPS):
        # A newer copy may just have taken its place.
        with suppress(OSError):
            found.append(Backup(file, datetime.fromtimestamp(file.stat().st_mtime, UTC)))
    for copy in known_copies(folder):
        if copy.kind is CopyKind.BACKUP and copy.place.parent != folder.absolute() / BACKUPS:
            with suppress(ValueError):
                found.append(Backup(copy.place, datetime.fromisoformat(copy.made_at).astimezone(UTC)))
    return sorted(found, key=lambda each: each.at)


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
        sessions = _sessions(copy, hashes)
        if sessions:
            holding.append((copy, sessions))
        elif sessions is None:
            is_there = _database(copy).exists()
            why = "it cannot be read, or is encrypted" if is_there else "it is not there, or not plugged in"
            unseen.append((copy, why))
    return Elsewhere(tuple(holding), tuple(unseen))


def _database(copy: KnownCopy) -> Path:
    return copy.place if copy.kind is CopyKind.BACKUP else copy.place / DATABASE


def _sessions(copy: KnownCopy, withdrawn: frozenset[bytes]) -> list[int] | None:
    """Return the sessions that a copy holds of people who withdrew; None if that cannot be seen."""
    return None if copy.kind is CopyKind.EXPORT else sessions_in(_database(copy), withdrawn)


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
