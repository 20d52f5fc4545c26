"""Write a file whole: a reader finds the old one or the new one, and never half of one."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

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


def replace_file(path: Path, content: str | bytes, mode: int = 0o666, *, durable: bool = True) -> None:
    """Put a file in its place whole, with this mode less the umask; raises OSError and leaves nothing half written.

    ``durable`` waits until the disk has it, so that a power cut does not leave an empty file.
    """
    beside = path.with_name(f".{path.name}.{os.getpid()}.new")
    try:
        with open(os.open(beside, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, mode), "wb") as file:  # noqa: PTH123 - a mode
            file.write(content.encode() if isinstance(content, str) else content)
            if durable:
                file.flush()
                os.fsync(file.fileno())
        beside.replace(path)
    except OSError:
        with suppress(OSError):
            beside.unlink()
        raise
