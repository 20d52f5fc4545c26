"""Clearing the bytes of a database file that belong to nothing.

When SQLite moves rows to another page, their bytes stay on the page they came from, between the rows that are left.
``secure_delete`` clears what a deleted row took last, and not such older traces. ``VACUUM`` would write the whole file
anew, twice; here it is read once, and only traces are written over. The format is that of https://sqlite.org/fileformat
and has been the same since 2004.
"""

from __future__ import annotations

import os
import struct
import sys
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path
from typing import BinaryIO

from kiosk.lazy_dataclass import dataclass

_FILE_HEADER = 100
"""The first page has the file's header before its own."""

_HEADERS = {2: 12, 5: 12, 10: 8, 13: 8}
"""How long the header of a page of a tree is, by its first byte; pages of other kinds begin with 0."""

_ROWS_OF_TABLE = 13
_BRANCH_OF_INDEX = 2
_BRANCH_OF_TABLE = 5
"""This one holds no content of rows."""

_FREE_HEADER = 4
"""An unused piece of a page begins with where the next one is, and how long it is itself."""

_TWO_BYTES = 128
"""From this first byte on, a length takes more than one; no length of one byte goes over the page."""

_PAGES_AT_ONCE = 256
_LARGEST = 65_536
_SIZES = {2**power for power in range(9, 17)}
_MOVES_PAGES = slice(52, 56)
"""Set where SQLite gives free pages back by itself: then pages of one more kind are there, of another form."""
_ZEROS = bytes(_LARGEST)


_MOST_AT_THE_END = 256
"""How many stretches of pages are cleared at the end of a file at most: 256 MiB, or half a second of a processor."""


def clear_remnants(path: Path) -> None:
    """Write zeros over every byte of a database file that holds no row.

    Raises OSError, or ValueError if the file is damaged. No connection of this process may be open to it: closing the
    file here would take away SQLite's locks. The log has to be empty, and the caller keeps others from writing. Where
    it is cut off, the database is as sound as before.
    """
    with path.open("r+b", buffering=0) as file:
        header = file.read(_FILE_HEADER)
        pages = _pages(file, header)
        if pages is None:
            return
        pages.clear_free(header)
        number = 1
        while there := pages.read(number, _PAGES_AT_ONCE):
            _clear_stretch(pages, number, there)
            number += _PAGES_AT_ONCE
        os.fsync(file.fileno())


def clear_end(path: Path) -> None:
    """Clear the pages at the end of a file, back to the first stretch that is clear.

    Its callers see to the same as those of ``clear_remnants``. Sessions are added at the end, so a withdrawal finds
    little to write if this is done every day. Nothing relies on it: a withdrawal looks at all pages, so this does not
    wait for the disk.
    """
    with path.open("r+b", buffering=0) as file:
        pages = _pages(file, file.read(_FILE_HEADER))
        if pages is None:
            return
        following = 1 + file.seek(0, os.SEEK_END) // pages.size
        for _ in range(_MOST_AT_THE_END):
            number = max(1, following - _PAGES_AT_ONCE)
            if not _clear_stretch(pages, number, pages.read(number, following - number)):
                return
            following = number


def _pages(file: BinaryIO, header: bytes) -> Pages | None:
    """Return the pages of a file; None if they may be of a form that is not known here."""
    size = int.from_bytes(header[16:18], "big")
    size = _LARGEST if size == 1 else size
    if size not in _SIZES or any(header[_MOVES_PAGES]):
        return None
    return Pages(file, size, size - header[20])


def _clear_stretch(pages: Pages, number: int, there: bytes) -> bool:
    """Clear the pages from this number on, whose bytes are given; returns whether there was anything to write."""
    written = False
    for place in range(len(there) // pages.size):
        try:
            page = there[place * pages.size : (place + 1) * pages.size]
            written = pages.clear(number + place, page) or written
        except (struct.error, IndexError) as damaged:
            raise ValueError(f"page {number + place} is damaged") from damaged
    return written


@dataclass(frozen=True)
class Pages:
    """The pages of a file, by their numbers from 1."""

    file: BinaryIO
    size: int
    usable: int

    def read(self, number: int, count: int = 1) -> bytes:
        """Return pages from this one on, as many of them as there are."""
        self.file.seek((number - 1) * self.size)
        return self.file.read(count * self.size)

    def zero(self, number: int, page: bytes, begin: int, end: int) -> bool:
        """Write zeros over a part of a page, if anything else stands there; returns whether that was so."""
        if _ZEROS.startswith(page[begin:end]):
            return False
        if sys.platform == "win32":
            self.file.seek((number - 1) * self.size + begin)
            self.file.write(_ZEROS[: end - begin])
        else:
            # One call to the system instead of two; nearly every page has such bytes the first time.
            os.pwrite(self.file.fileno(), _ZEROS[: end - begin], (number - 1) * self.size + begin)
        return True

    def clear(self, number: int, page: bytes) -> bool:
        """Clear a page of a tree, and what follows its rows elsewhere; any other page is left alone.

        Returns whether anything was written.
        """
        at = _FILE_HEADER if number == 1 else 0
        if page[at] not in _HEADERS:
            return False
        written = False
        for begin, end in _unused(page, at, self.usable):
            written = self.zero(number, page, begin, end) or written
        for length, first in _continued(page, at, self.usable):
            written = self._clear_end(first, length) or written
        return written

    def _clear_end(self, number: int, length: int) -> bool:
        """Clear what follows a row on the last of the pages that it goes on on."""
        room = self.usable - 4
        while length > room:
            number, length = int.from_bytes(self.read(number)[:4], "big"), length - room
        return self.zero(number, self.read(number), 4 + length, self.size)

    def clear_free(self, header: bytes) -> None:
        """Clear the pages that SQLite keeps for later."""
        trunk, left = struct.unpack_from(">II", header, 32)
        while trunk and left > 0:
            following, kept = struct.unpack_from(">II", page := self.read(trunk))
            end = 8 + 4 * kept
            if end > self.usable:
                raise ValueError(f"page {trunk} is damaged")
            self.zero(trunk, page, end, self.size)
            for number in struct.unpack_from(f">{kept}I", page, 8):
                self.zero(number, self.read(number), 0, self.size)
            trunk, left = following, left - kept - 1


def _unused(page: bytes, at: int, usable: int) -> list[tuple[int, int]]:
    """Return where what no row takes begins and ends on a page of a tree, whose header is at ``at``."""
    free, rows, content = _THREE_NUMBERS(page, at + 1)
    begin, end = at + _HEADERS[page[at]] + 2 * rows, content or _LARGEST
    if begin > end or end > usable:
        raise IndexError(begin, end)
    found = [(begin, end)]
    while free:
        following, length = _TWO_NUMBERS(page, free)
        if free + length > usable or 0 < following < free + length:
            raise IndexError(free, length)
        if length > _FREE_HEADER:
            found.append((free + _FREE_HEADER, free + length))
        free = following
    return found


def _continued(page: bytes, at: int, usable: int) -> list[tuple[int, int]]:
    """Return how many bytes of each long row stand on pages of their own, and the first of those."""
    kind = page[at]
    if kind == _BRANCH_OF_TABLE:
        return []
    before = 4 if kind == _BRANCH_OF_INDEX else 0
    most = usable - 35 if kind == _ROWS_OF_TABLE else (usable - 12) * 64 // 255 - 23
    found: list[tuple[int, int]] = []
    # A length of two bytes that is too much for the page begins with this or more.
    much = _TWO_BYTES | (most + 1 >> 7)
    content = page[before:] if before else page
    for place in _numbers(page[at + 3] << 8 | page[at + 4])(page, at + _HEADERS[kind]):
        if (first := content[place]) < _TWO_BYTES or (first < much and content[place + 1] < _TWO_BYTES):
            continue
        length, row = _number(page, place + before)
        if length <= most:
            continue
        if kind == _ROWS_OF_TABLE:
            _, row = _number(page, row)
        least = (usable - 12) * 32 // 255 - 23
        here = least + (length - least) % (usable - 4)
        here = here if here <= most else least
        found.append((length - here, int.from_bytes(page[row + here : row + here + 4], "big")))
    return found


_TWO_NUMBERS = struct.Struct(">HH").unpack_from
_THREE_NUMBERS = struct.Struct(">HHH").unpack_from


@lru_cache(maxsize=256)
def _numbers(count: int) -> Callable[[bytes, int], tuple[int, ...]]:
    """Return what reads so many numbers of two bytes."""
    return struct.Struct(f">{count}H").unpack_from


def _number(page: bytes, at: int) -> tuple[int, int]:
    """Return a number of one to nine bytes, and where it ends."""
    value = 0
    for place in range(at, at + 8):
        value = value << 7 | page[place] & 0x7F
        if page[place] < _TWO_BYTES:
            return value, place + 1
    return value << 8 | page[at + 8], at + 9
