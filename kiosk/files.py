"""Read what others may have written, and have files and folders whole on the disk, whenever the power is cut."""

from __future__ import annotations

import errno
import json
import os
from contextlib import suppress
from io import BufferedReader
from pathlib import Path
from typing import Any

from kiosk import UserInputError, unwritable


def check_writable(path: Path) -> Path:
    """Return where a file is to be written, links followed.

    Raises UserInputError for a folder, and for a place whose folder is not there.
    """
    place = path.resolve()
    if place.exists() and not place.is_file():
        raise UserInputError(f"{path} cannot be written: it is not a file")
    if not place.parent.is_dir():
        raise UserInputError(f"{path} cannot be written: there is no folder {place.parent}")
    return place


def write_file(path: Path, content: str | bytes) -> None:
    """Put a file in its place whole, or raise UserInputError and leave what was there untouched."""
    path = check_writable(path)
    try:
        replace_file(path, content)
    except OSError as error:
        raise unwritable(f"{path} cannot be written", error) from error


def open_to_read(path: Path) -> BufferedReader:
    """Open a file to read its bytes; raises OSError, also for a pipe, where nothing may ever come."""
    if path.is_fifo():
        raise OSError(errno.ESPIPE, "it is a pipe and no file")
    return path.open("rb")


def read_bytes(path: Path) -> bytes:
    """Return a file's bytes; raises OSError, also for a pipe."""
    with open_to_read(path) as file:
        return file.read()


def parse_json(text: str | bytes, **options: Any) -> Any:
    """Return what a text in JSON says, as ``json.loads`` does.

    Raises ValueError also for brackets that are nested too deeply, of which ``json`` makes a RecursionError.
    """
    try:
        return json.loads(text, **options)
    except RecursionError as error:
        raise json.JSONDecodeError("brackets stand in brackets too often", "", 0) from error


def replace_file(path: Path, content: str | bytes, mode: int = 0o666, *, durable: bool = True) -> None:
    """Put a file in its place whole, with this mode less the umask; raises OSError and leaves nothing half written.

    ``durable`` waits until the disk has it, so that a power cut does not leave an empty file or the old one.
    """
    beside = path.with_name(f".{path.name}.{os.getpid()}.new")
    try:
        with open(os.open(beside, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, mode), "wb") as file:  # noqa: PTH123 - a mode
            file.write(content.encode() if isinstance(content, str) else content)
            if durable:
                file.flush()
                os.fsync(file.fileno())
        beside.replace(path)
        if durable:
            sync_folder(path.parent)
    except OSError:
        with suppress(OSError):
            beside.unlink()
        raise


_NOT_TOLD = {errno.EACCES, errno.EPERM, errno.EINVAL, errno.ENOTSUP}
"""What systems answer where a folder may not be opened, or cannot be told to be on the disk."""


def make_folder(folder: Path) -> None:
    """Make a folder for its owner alone, with those above it, and have its name on the disk.

    Nothing is changed if it is there. Raises FileExistsError if it is a file, and OSError.
    """
    above = [each for each in (folder, *folder.parents) if not each.exists()]
    for each in reversed(above or [folder]):  # mkdir(parents=True) would leave those above open to others
        each.mkdir(mode=0o700, exist_ok=True)
    for each in above:
        sync_folder(each.parent)


def sync_folder(folder: Path) -> None:
    """Have the names in a folder on the disk, where the system can do that; raises OSError."""
    if os.name != "posix":
        return
    try:
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
    except OSError as error:
        if error.errno not in _NOT_TOLD:
            raise


def sync_tree(folder: Path) -> None:
    """Have all that is in a folder on the disk, its files and the folders in it; raises OSError."""
    for path in folder.rglob("*"):
        if path.is_file():
            # Windows wants the right to write, which not every file gives.
            with suppress(PermissionError), path.open("rb" if os.name == "posix" else "r+b") as file:
                os.fsync(file.fileno())
        else:
            sync_folder(path)
    sync_folder(folder)
