"""A database that a disk, a cable or a cut copy has damaged: verify finds all that changes what is stored."""

from __future__ import annotations

import random
import shutil
import sqlite3
from collections.abc import Callable, Iterator
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest

from kiosk import UserInputError
from kiosk.store.database import FILE
from kiosk.store.recorder import Provenance, Recorder
from kiosk.store.verify import verify
from tests.store.visitors import COMPLETED

PAGE = 4096
FLIPS = 2
"""So many bits of each page are tried here; more are tried with another number."""


def stored(file: Path) -> list[Any]:
    """Return all that a database says."""
    with closing(sqlite3.connect(f"file:{file}?mode=ro", uri=True)) as connection:
        schema = connection.execute("SELECT type, name, tbl_name, sql FROM sqlite_master ORDER BY 1, 2").fetchall()
        tables = [name for kind, name, *_ in schema if kind == "table"]
        rows = [sorted(map(repr, connection.execute(f"SELECT * FROM {name}"))) for name in tables]  # noqa: S608 - ours
        header = [connection.execute(f"PRAGMA {name}").fetchone() for name in ("user_version", "application_id")]
        return [schema, rows, header]


def is_noticed(folder: Path) -> bool:
    """Return whether verify finds anything, or cannot open the database at all."""
    try:
        return bool(verify(folder))
    except UserInputError:
        return True


def says_the_same(file: Path, before: list[Any]) -> bool:
    """Return whether a database can be read and says what it said."""
    try:
        return stored(file) == before
    except sqlite3.Error:
        return False


def flips(content: bytes) -> Iterator[tuple[int, bytes]]:
    """Yield a place on each page, twice, and the content with one bit changed there, where it holds something."""
    chance = random.Random(21)
    for start in range(0, len(content), PAGE):
        filled = [at for at in range(start, start + PAGE) if content[at]]
        for at in chance.choices(filled, k=FLIPS):
            damaged = bytearray(content)
            damaged[at] ^= 1 << chance.randrange(8)
            yield at, bytes(damaged)


def test_a_changed_bit_of_any_table_or_index_is_found(day: Path) -> None:
    """Each of them begins on a page of its own."""
    file = day / FILE
    before, content = stored(file), file.read_bytes()
    passed = []
    for at, damaged in flips(content):
        file.write_bytes(damaged)
        if not is_noticed(day) and not says_the_same(file, before):
            passed.append(at)
    assert passed == []


def page_of(content: bytes, number: int) -> slice:
    """Return where a page stands, counted from the end if the number is negative."""
    start = (number % (len(content) // PAGE)) * PAGE
    return slice(start, start + PAGE)


def swapped(content: bytes, one: int, other: int) -> bytes:
    """Return the content with two pages in each other's place."""
    changed = bytearray(content)
    changed[page_of(content, one)], changed[page_of(content, other)] = (
        content[page_of(content, other)],
        content[page_of(content, one)],
    )
    return bytes(changed)


def with_page(content: bytes, number: int, page: bytes) -> bytes:
    """Return the content with another page in the place of one."""
    changed = bytearray(content)
    changed[page_of(content, number)] = page
    return bytes(changed)


def with_header(content: bytes, at: int, *values: int) -> bytes:
    """Return the content with other bytes in its header."""
    return content[:at] + bytes(values) + content[at + len(values) :]


DAMAGES: dict[str, Callable[[bytes], bytes]] = {
    "cut to nothing": lambda content: content[:0],
    "cut in its header": lambda content: content[:50],
    "cut to its first page": lambda content: content[:PAGE],
    "cut to a half": lambda content: content[: len(content) // PAGE // 2 * PAGE],
    "cut in the middle of a page": lambda content: content[: len(content) - PAGE // 2],
    "without its last page": lambda content: content[:-PAGE],
    "without its first page": lambda content: content[PAGE:],
    "with a page of zeros": lambda content: with_page(content, 9, bytes(PAGE)),
    "with a last page of zeros": lambda content: with_page(content, -1, bytes(PAGE)),
    "with a page of ones": lambda content: with_page(content, 12, b"\xff" * PAGE),
    "with one page twice": lambda content: with_page(content, 7, content[page_of(content, 8)]),
    "with two pages swapped": lambda content: swapped(content, 2, 3),
    "with the first and the last page swapped": lambda content: swapped(content, 0, -1),
    "with the second half of a page from another": lambda content: (
        content[: 10 * PAGE + PAGE // 2] + content[11 * PAGE + PAGE // 2 : 12 * PAGE] + content[11 * PAGE :]
    ),
    "with text for bytes": lambda content: content.replace(b"\n", b"\r\n"),
    "with lines of Unix": lambda content: content.replace(b"\r", b""),
    "with seven bits": lambda content: bytes(byte & 127 for byte in content),
    "with another name of its format": lambda content: with_header(content, 0, 0),
    "with another size of pages": lambda content: with_header(content, 16, 2, 0),
    "with bytes kept free on each page": lambda content: with_header(content, 20, 8),
    "with a cookie of its schema's format": lambda content: with_header(content, 44, 0, 0, 0, 9),
    "with another encoding of texts": lambda content: with_header(content, 56, 0, 0, 0, 2),
    "with another version": lambda content: with_header(content, 60, 0, 0, 0, 1),
    "with another owner": lambda content: with_header(content, 68, 1, 2, 3, 4),
    "with free pages that are none": lambda content: with_header(content, 32, 0, 0, 0, 5, 0, 0, 0, 1),
    "of another program": lambda content: b"%PDF-1.7\n" + content,
}


@pytest.mark.parametrize("damage", DAMAGES.values(), ids=DAMAGES)
def test_a_file_that_is_not_whole_is_found(day: Path, damage: Callable[[bytes], bytes]) -> None:
    file = day / FILE
    content = file.read_bytes()
    damaged = damage(content)
    assert damaged != content
    file.write_bytes(damaged)
    assert is_noticed(day)


def test_what_lies_behind_the_database_changes_nothing(day: Path) -> None:
    before = stored(day / FILE)
    with (day / FILE).open("ab") as file:
        file.write(b"x" * PAGE)
    assert is_noticed(day) or stored(day / FILE) == before


LOGS: dict[str, Callable[[bytes], bytes]] = {
    "without the log": lambda log: log[:0],
    "with a half of the log": lambda log: log[: len(log) // 2],
    "with a bit of the log changed": lambda log: log[:3000] + bytes([log[3000] ^ 1]) + log[3001:],
    "with a log of zeros": lambda log: bytes(len(log)),
}


@pytest.mark.parametrize("damage", LOGS.values(), ids=LOGS)
def test_the_end_of_a_record_that_was_lost_with_the_log_is_found(
    folder: Path, tmp_path: Path, provenance: Provenance, damage: Callable[[bytes], bytes]
) -> None:
    copy = tmp_path / "copy"
    with Recorder(folder) as recorder:
        for _ in range(3):
            recorder.begin(provenance, COMPLETED)
        shutil.copytree(folder, copy)
    log = copy / f"{FILE}-wal"
    assert not is_noticed(copy)
    (copy / f"{FILE}-shm").unlink(missing_ok=True)
    log.write_bytes(damage(log.read_bytes()))
    assert is_noticed(copy)
