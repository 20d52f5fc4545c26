"""Carry copies away: find a stick, copy to it, read the copy back, and encrypt it for a lab."""

from __future__ import annotations

import hashlib
import os
import platform
import shutil
import sqlite3
from collections.abc import Iterable, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from kiosk import StorageError, UserInputError
from kiosk.files import sync_folder
from kiosk.store.connecting import reason
from kiosk.store.database import open_as_it_is
from kiosk.store.maintenance import STEP_PAGES, UNFINISHED, Progress, alone, copy_name
from kiosk.store.tombstones import add_tombstones, withdrawn_hashes

ANY = "stick"
"""Names the one stick that is plugged in."""
FOLDER = "recollect-backups"
"""Where copies lie on a drive; each machine has a folder of its own in it."""
ENCRYPTED = ".age"
_MOUNTED_UNDER = tuple(map(Path, ("/media", "/run/media", "/Volumes")))
_FORMAT_VERSIONS = slice(18, 20)
"""Of SQLite's header: 2 where a write-ahead log belongs to the file, 1 where it stands alone."""
_CHUNK = 1 << 20


@dataclass(frozen=True)
class Drive:
    """A removable drive that is mounted."""

    name: str
    mount: Path


@dataclass(frozen=True)
class CarriedCopy:
    """A copy that was written and read back; ``sha256`` is of the file, encrypted or not."""

    file: Path
    sha256: str
    bytes: int
    encrypted: bool
    kept: int


def removable_drives() -> tuple[Drive, ...]:
    """Return the sticks and other removable drives that are mounted, by the name of where they are."""
    import psutil  # noqa: PLC0415 - the start screen does not wait for it

    mounts = (Path(part.mountpoint) for part in psutil.disk_partitions() if _is_removable(part))
    return tuple(sorted((Drive(mount.name or str(mount), mount) for mount in mounts), key=lambda drive: drive.name))


def _is_removable(part: Any) -> bool:
    if "removable" in part.opts.split(","):
        return True
    mount = Path(part.mountpoint)
    return mount != Path("/Volumes") and any(mount.is_relative_to(place) for place in _MOUNTED_UNDER)


def destination(to: str) -> Path:
    """Return the folder that copies go to: a folder as it is named, or this machine's own on a drive.

    ``to`` is a path, a drive's name, or ``stick`` for the only one. Raises UserInputError for a drive that is not
    plugged in, rather than writing to the folder that it would be mounted on.
    """
    path = Path(to)
    if path.name != to or path.is_dir():
        _check_mounted(path)
        return path
    drives = removable_drives()
    found = drives if to == ANY else tuple(drive for drive in drives if drive.name.casefold() == to.casefold())
    if len(found) == 1:
        return found[0].mount / FOLDER / (platform.node() or "kiosk")
    there = ", ".join(f"{drive.name!r} ({drive.mount})" for drive in drives) or "none"
    if found:
        raise UserInputError(f"several drives are plugged in, name one of them: {there}")
    what = "no stick is plugged in and mounted" if to == ANY else f"there is no drive {to!r}"
    raise UserInputError(f"{what}; drives that are there: {there}; a folder here is written as {os.curdir}{os.sep}{to}")


def _check_mounted(path: Path) -> None:
    whole = path.absolute()
    for place in _MOUNTED_UNDER:
        if whole != place and whole.is_relative_to(place) and place.is_dir():
            there = next(each for each in (whole, *whole.parents) if each.exists())
            if there.stat().st_dev == place.stat().st_dev:
                raise UserInputError(f"no drive is mounted at {path}: plug it in and open it, then try again")


def recipients(keys: Iterable[str]) -> tuple[Any, ...]:
    """Read public keys: age's (``age1...``), SSH's, or files with one on each line; raises UserInputError."""
    try:
        from pyrage import RecipientError, ssh, x25519  # noqa: PLC0415 - an extra
    except ImportError as error:
        raise UserInputError("encrypting needs pyrage: pip install 'recollect[encrypt]'") from error
    found = []
    for key in (line for given in keys for line in _lines(given)):
        if key.upper().startswith("AGE-SECRET-KEY-"):
            raise UserInputError("this is a secret key, which stays with the lab: give its public key, age1...")
        try:
            found.append((ssh if key.startswith("ssh-") else x25519).Recipient.from_str(key))
        except RecipientError as error:
            raise UserInputError(f"{key[:20]!r} is no public key of age (age1...) or SSH") from error
    return tuple(found)


def _lines(given: str) -> list[str]:
    file = Path(given)
    if given.startswith(("age1", "ssh-", "AGE-SECRET-KEY-")) or not file.is_file():
        return [given]
    lines = (line.strip() for line in file.read_text("utf-8").splitlines())
    return [line for line in lines if line and not line.startswith("#")]


def carry(
    folder: Path,
    into: Path,
    keep: int,
    keys: Sequence[Any] = (),
    tell: Progress = lambda _done, _of: None,
) -> CarriedCopy:
    """Copy the database of a data folder to a drive, read the copy back, and keep the newest ``keep``.

    With ``keys`` the copy is encrypted in memory, and nothing else reaches the drive. The file has its name only once
    it is whole. Raises UserInputError if there is nothing to copy or no room, StorageError if the copy cannot be
    written or reads back as something else; older copies are then as they were.
    """
    content, gone = _content(folder, tell)
    if keys:
        import pyrage  # noqa: PLC0415 - an extra

        content = pyrage.encrypt(content, list(keys))
    with alone(into):
        free = shutil.disk_usage(into).free
        if free < len(content):
            raise UserInputError(f"{into} has {free:,} bytes left, and the copy takes {len(content):,}")
        file = into / f"{copy_name()}{ENCRYPTED if keys else ''}"
        unfinished = file.with_name(f"{file.name}{UNFINISHED}")
        try:
            sha256 = _write(unfinished, content)
            unfinished.replace(file)
            add_tombstones(into, gone)
            sync_folder(into)
            older = [each for each in carried(into) if each != file]
            for each in older[: max(0, len(older) + 1 - keep)]:
                each.unlink()
        except OSError as error:
            raise StorageError(f"the copy in {into} could not be written: {reason(error, into)}") from error
        finally:
            _remove(unfinished)
    return CarriedCopy(file, sha256, len(content), bool(keys), len(carried(into)))


def carried(into: Path) -> list[Path]:
    """Return the whole copies in a folder, oldest first, encrypted ones among them."""
    return sorted([*into.glob("recollect-*.db"), *into.glob(f"recollect-*.db{ENCRYPTED}")])


def _content(folder: Path, tell: Progress) -> tuple[bytes, frozenset[bytes]]:
    """Return the database as one file, whole and checked, and the hashes of people who withdrew."""
    with closing(open_as_it_is(folder)) as source, closing(sqlite3.connect(":memory:")) as copy:
        source.execute("BEGIN")
        source.execute("SELECT count(*) FROM sqlite_master").fetchone()
        source.backup(copy, pages=STEP_PAGES, progress=lambda _, left, of: tell(of - left, of))
        source.execute("ROLLBACK")
        answers = [answer for (answer,) in copy.execute("PRAGMA integrity_check")]
        if answers != ["ok"]:
            raise StorageError(f"the copy is not whole: {answers[0]}")
        content = bytearray(copy.serialize())
        gone = withdrawn_hashes(copy, folder)
    content[_FORMAT_VERSIONS] = b"\x01\x01"
    return bytes(content), gone


def _write(file: Path, content: bytes) -> str:
    """Write a file, and read it back from the drive; returns its SHA-256."""
    with open(file, "wb", opener=lambda name, flags: os.open(name, flags, mode=0o600)) as out:
        out.write(content)
        out.flush()
        os.fsync(out.fileno())
        if hasattr(os, "posix_fadvise"):
            # Else it would be read from memory, where it is well whatever the drive did.
            os.posix_fadvise(out.fileno(), 0, 0, os.POSIX_FADV_DONTNEED)
    digest = hashlib.sha256()
    with file.open("rb") as back:
        while chunk := back.read(_CHUNK):
            digest.update(chunk)
    if digest.hexdigest() != hashlib.sha256(content).hexdigest():
        raise StorageError(f"the drive did not keep the copy in {file.parent} as it was written: take another drive")
    return digest.hexdigest()


def _remove(unfinished: Path) -> None:
    try:
        unfinished.unlink(missing_ok=True)
    except OSError:
        # The drive was pulled out: what is left on it has no copy's name, and goes with the next copy.
        return
