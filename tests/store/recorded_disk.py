"""A disk that remembers in which order it was written and flushed, so that its power can be cut at any point later.

It is a file system of two files, made with the kernel's FUSE and nothing else: ``disk``, which a loop device turns
into a disk, and ``acknowledged``, into which a writer puts what it has acknowledged. Whatever is written to either,
and every flush of the disk, goes into a log in the order in which it came. Only root may mount it, on Linux.

``python -m tests.store.recorded_disk PLACE IMAGE LOG`` serves it until it is unmounted; its first line says that it is
there.
"""

from __future__ import annotations

import ctypes
import os
import stat
import struct
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from enum import IntEnum
from errno import EINVAL, ENODEV, ENOENT, ENOSYS
from pathlib import Path
from random import Random
from typing import BinaryIO

from tests.patience import PATIENCE_S, started

SECTOR = 512
"""What a disk writes whole or not at all."""
PAGE = 4096
LONGEST_WRITE = 1 << 17
NAMES = (b"disk", b"acknowledged")
ROOT, DISK, ACKNOWLEDGED = 1, 2, 3
"""Numbers of the folder and its files."""


class Kind(IntEnum):
    """What stands in the log."""

    WRITE = 1
    FLUSH = 2
    ACKNOWLEDGED = 3


@dataclass(frozen=True)
class Entry:
    """One line of the log."""

    kind: Kind
    at: int
    data: bytes


_ENTRY = struct.Struct("<BQI")


def read_log(log: Path) -> list[Entry]:
    """Return all that came to the disk, in order."""
    entries, content, at = [], log.read_bytes(), 0
    while at < len(content):
        kind, place, size = _ENTRY.unpack_from(content, at)
        at += _ENTRY.size
        entries.append(Entry(Kind(kind), place, content[at : at + size]))
        at += size
    return entries


def after_a_cut(image: bytearray, unflushed: list[Entry], chance: Random) -> bytearray:
    """Return what a disk may hold after its power was cut: all that was flushed, and of the rest anything.

    Of what was not flushed nothing, all, a beginning or a random part is there; a write may be torn between sectors.
    """
    image = image[:]
    writes = [entry for entry in unflushed if entry.kind is Kind.WRITE]
    match chance.choice(("nothing", "all", "beginning", "part", "part")):
        case "nothing":
            writes = []
        case "beginning":
            writes = writes[: chance.randint(0, len(writes))]
        case "part":
            writes = [entry for entry in writes if chance.random() < 0.5]
            chance.shuffle(writes)
    torn = chance.randrange(len(writes)) if writes and chance.random() < 0.5 else None
    for number, entry in enumerate(writes):
        for start in range(0, len(entry.data), SECTOR):
            if number != torn or chance.random() < 0.5:
                sector = entry.data[start : start + SECTOR]
                image[entry.at + start : entry.at + start + len(sector)] = sector
    return image


# The server


class Opcode(IntEnum):
    """What the kernel asks for."""

    LOOKUP = 1
    FORGET = 2
    GETATTR = 3
    SETATTR = 4
    OPEN = 14
    READ = 15
    WRITE = 16
    STATFS = 17
    RELEASE = 18
    FSYNC = 20
    FLUSH = 25
    INIT = 26
    OPENDIR = 27
    RELEASEDIR = 29
    ACCESS = 34
    DESTROY = 38
    BATCH_FORGET = 42


_ASKED = struct.Struct("<IIQQIIII")
_ANSWERED = struct.Struct("<IiQ")
_INIT = struct.Struct("<IIIIHHIIHHI28x")
_ATTRIBUTES = struct.Struct("<QQQQQQIIIIIIIIII")
_READ_OR_WRITE = struct.Struct("<QQIIQII")
_VALID_S = 3600
_MAJOR, _MINOR = 7, 31
_BIG_WRITES, _MAX_PAGES = 1 << 5, 1 << 22
_DIRECT = 1
"""Writes to the file come at once, and are not put together."""
_WELL = {Opcode.RELEASE, Opcode.RELEASEDIR, Opcode.FLUSH, Opcode.ACCESS, Opcode.DESTROY}
"""Nothing is to be done for them."""
_WITHOUT_ANSWER = {Opcode.FORGET, Opcode.BATCH_FORGET}


class Server:
    """Answers the kernel."""

    def __init__(self, image: Path, log: BinaryIO) -> None:
        """Serve the content of a file, which stays as it is."""
        self._disk = bytearray(image.read_bytes())
        self._log = log

    def serve(self, device: int) -> None:
        """Answer until the file system is unmounted."""
        while True:
            try:
                asked = os.read(device, LONGEST_WRITE + PAGE)
            except OSError as error:
                if error.errno == ENODEV:
                    return
                raise
            _, opcode, unique, node, *_ = _ASKED.unpack_from(asked)
            if opcode in _WITHOUT_ANSWER:
                continue
            answer = self._answer(opcode, node, asked[_ASKED.size :])
            failed, content = (-answer, b"") if isinstance(answer, int) else (0, answer)
            os.write(device, _ANSWERED.pack(_ANSWERED.size + len(content), failed, unique) + content)

    def _answer(self, opcode: int, node: int, body: bytes) -> bytes | int:
        """Return what to answer, or the number of an error."""
        answers: dict[int, Callable[[int, bytes], bytes | int]] = {
            Opcode.INIT: self._begin,
            Opcode.LOOKUP: self._find,
            Opcode.GETATTR: self._describe,
            Opcode.SETATTR: self._describe,
            Opcode.OPEN: self._open,
            Opcode.OPENDIR: self._open,
            Opcode.READ: self._read,
            Opcode.WRITE: self._write,
            Opcode.FSYNC: self._flush,
            Opcode.STATFS: lambda _node, _body: struct.pack("<QQQQQIIII24x", 0, 0, 0, 0, 0, PAGE, 255, PAGE, 0),
        }
        nothing: bytes | int = b"" if opcode in _WELL else ENOSYS
        return answers[opcode](node, body) if opcode in answers else nothing

    def _begin(self, _node: int, _body: bytes) -> bytes:
        flags, pages = _BIG_WRITES | _MAX_PAGES, LONGEST_WRITE // PAGE
        return _INIT.pack(_MAJOR, _MINOR, LONGEST_WRITE, flags, 16, 12, LONGEST_WRITE, 1, pages, 0, 0)

    def _find(self, _node: int, body: bytes) -> bytes | int:
        name = body.rstrip(b"\0")
        if name not in NAMES:
            return ENOENT
        node = DISK + NAMES.index(name)
        return struct.pack("<QQQQII", node, 0, _VALID_S, _VALID_S, 0, 0) + self._attributes(node)

    def _describe(self, node: int, _body: bytes) -> bytes:
        return struct.pack("<QII", _VALID_S, 0, 0) + self._attributes(node)

    def _open(self, node: int, _body: bytes) -> bytes:
        return struct.pack("<QII", 0, _DIRECT if node == ACKNOWLEDGED else 0, 0)

    def _read(self, node: int, body: bytes) -> bytes:
        _, at, size, *_ = _READ_OR_WRITE.unpack_from(body)
        return bytes(self._disk[at : at + size]) if node == DISK else b""

    def _flush(self, node: int, _body: bytes) -> bytes:
        if node == DISK:
            self._note(Kind.FLUSH)
        return b""

    def _write(self, node: int, body: bytes) -> bytes | int:
        _, at, size, *_ = _READ_OR_WRITE.unpack_from(body)
        data = body[_READ_OR_WRITE.size : _READ_OR_WRITE.size + size]
        if node == ACKNOWLEDGED:
            self._note(Kind.ACKNOWLEDGED, 0, data)
        elif at + size > len(self._disk):
            return EINVAL
        else:
            self._disk[at : at + size] = data
            self._note(Kind.WRITE, at, data)
        return struct.pack("<II", size, 0)

    def _note(self, kind: Kind, at: int = 0, data: bytes = b"") -> None:
        self._log.write(_ENTRY.pack(kind, at, len(data)) + data)

    def _attributes(self, node: int) -> bytes:
        size = len(self._disk) if node == DISK else 0
        mode = stat.S_IFDIR | 0o755 if node == ROOT else stat.S_IFREG | 0o600
        return _ATTRIBUTES.pack(node, size, size // SECTOR, 0, 0, 0, 0, 0, 0, mode, 1, 0, 0, 0, PAGE, 0)


def serve(place: Path, image: Path, log: Path) -> None:
    """Mount the file system and serve it; raises OSError where that is not allowed."""
    device = os.open("/dev/fuse", os.O_RDWR)
    options = f"fd={device},rootmode={stat.S_IFDIR:o},user_id=0,group_id=0,max_read={LONGEST_WRITE}"
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.mount(b"recorded", bytes(place), b"fuse.recorded", 0, options.encode()) != 0:
        raise OSError(ctypes.get_errno(), "cannot be mounted", str(place))
    sys.stdout.write("mounted\n")
    sys.stdout.flush()
    with log.open("wb") as noted:
        Server(image, noted).serve(device)


# Disks of a test


def make_image(image: Path, mib: int) -> None:
    """Make an empty file system of the kind that Debian makes."""
    with image.open("wb") as file:
        file.truncate(mib << 20)
    # What it would do later by itself has no part in what is tried.
    lazy = "lazy_itable_init=0,lazy_journal_init=0"
    _do("mkfs.ext4", "-q", "-F", "-b", str(PAGE), "-J", "size=4", "-E", lazy, str(image))


@contextmanager
def mounted(image: Path, place: Path) -> Iterator[Path]:
    """Provide the file system in a file, as after a start of the machine."""
    place.mkdir(exist_ok=True)
    _do("mount", "-o", "loop", str(image), str(place))
    try:
        yield place
    finally:
        _do("umount", str(place))


@contextmanager
def recorded_disk(image: Path, folder: Path, log: Path) -> Iterator[tuple[Path, Path]]:
    """Provide a mounted copy of an image whose writes and flushes are logged, and the file for acknowledgements.

    The log is whole when it is over. Raises CalledProcessError for those who may not mount anything.
    """
    below, place = folder / "below", folder / "disk"
    below.mkdir()
    command = [sys.executable, "-m", __name__, str(below), str(image), str(log)]
    with ExitStack() as undo:
        server = undo.enter_context(started(command, stdout=subprocess.PIPE, text=True))
        if not server.stdout.readline():
            raise subprocess.CalledProcessError(server.wait(), command)
        undo.callback(_do, "umount", str(below))
        undo.enter_context(mounted(below / "disk", place))
        yield place, below / "acknowledged"


def _do(*command: str) -> None:
    subprocess.run(command, check=True, capture_output=True, timeout=PATIENCE_S)


if __name__ == "__main__":
    serve(*map(Path, sys.argv[1:]))
