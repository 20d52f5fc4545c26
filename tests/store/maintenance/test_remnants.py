"""No byte of a row that went is left in the file, wherever SQLite had kept it before."""

from __future__ import annotations

import shutil
import sqlite3
from contextlib import closing
from itertools import count
from pathlib import Path
from random import Random

import pytest

from kiosk.store import remnants
from kiosk.store.remnants import Pages, clear_end, clear_remnants

OWNERS = 10
TABLES = {
    "a tree by the key": "CREATE TABLE kept (owner INTEGER, number INTEGER, what TEXT, PRIMARY KEY (owner, number)) "
    "WITHOUT ROWID",
    "rows and an index": "CREATE TABLE kept (owner INTEGER, number INTEGER, what TEXT UNIQUE)",
}


def written(file: Path, table: str, page_bytes: int, seed: int) -> None:
    """Write a database as a kiosk does, in small steps, with rows that go on on other pages among them."""
    chance = Random(seed)
    with closing(sqlite3.connect(file, isolation_level=None)) as connection:
        connection.execute(f"PRAGMA page_size = {page_bytes}")
        connection.execute("PRAGMA synchronous = OFF")
        connection.execute("PRAGMA secure_delete = OFF")
        connection.execute(table)
        for number in range(OWNERS * 20):
            # Several write at once, so that pages are split in the middle as well.
            owner = number // 40 * 2 + chance.randrange(2)
            what = f"owner{owner:03} {number} {'x' * chance.choice((0, 30, 300, page_bytes * chance.randrange(4)))}"
            connection.execute("INSERT INTO kept VALUES (?, ?, ?)", (owner, number, what))
        # Its pages are used again, with what stood there, by what is written next.
        connection.execute("DELETE FROM kept WHERE owner < 4")
        connection.executemany("INSERT INTO kept VALUES (?, ?, ?)", [(99, n, f"later {n}" * 200) for n in range(20)])


@pytest.mark.parametrize("page_bytes", [512, 4096, 65536])
@pytest.mark.parametrize("table", TABLES.values(), ids=TABLES)
def test_nothing_is_left_of_rows_that_were_deleted(tmp_path: Path, table: str, page_bytes: int) -> None:
    written(tmp_path / "all.db", table, page_bytes, seed=page_bytes)
    left_by_sqlite = 0
    for owner in range(4, OWNERS):
        file = Path(shutil.copy(tmp_path / "all.db", tmp_path / "one.db"))
        with closing(sqlite3.connect(file, isolation_level=None)) as connection:
            connection.execute("PRAGMA secure_delete = ON")
            connection.execute("DELETE FROM kept WHERE owner = ?", (owner,))
            others = connection.execute("SELECT * FROM kept ORDER BY owner, number").fetchall()
        left_by_sqlite += file.read_bytes().count(b"owner%03d" % owner)
        clear_remnants(file)
        content = file.read_bytes()
        assert b"owner%03d" % owner not in content
        assert b"owner000" not in content
        assert everything(file) == others
    assert left_by_sqlite > 0 or page_bytes == 65536


def test_the_end_of_a_file_is_cleared_back_to_what_is_clear_already(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(remnants, "_PAGES_AT_ONCE", 8)
    looked_at: list[int] = []
    clear = Pages.clear

    def watched(self: Pages, number: int, page: bytes) -> bool:
        looked_at.append(number)
        return clear(self, number, page)

    monkeypatch.setattr(Pages, "clear", watched)
    file = tmp_path / "one.db"
    with closing(sqlite3.connect(file, isolation_level=None)) as connection:
        connection.execute("PRAGMA page_size = 512")
        connection.execute("PRAGMA synchronous = OFF")
        connection.execute(TABLES["a tree by the key"])
    pages: list[int] = []
    for day in range(10):
        # In no order, so that pages are split, and the rows that move leave their bytes behind.
        numbers = Random(day).sample(range(400), 400)
        with closing(sqlite3.connect(file)) as connection, connection:
            connection.execute("PRAGMA synchronous = OFF")
            connection.executemany("INSERT INTO kept VALUES (?, ?, 'said by a visitor')", [(day, n) for n in numbers])
        whole = everything(file)
        clear_end(file)
        pages.append(len(looked_at))
        looked_at.clear()
        assert everything(file) == whole
    assert 8 < pages[-1] < file.stat().st_size // 512 // 2
    clear_end(file)
    assert len(looked_at) == 8
    before = file.read_bytes()
    clear_remnants(file)
    after = file.read_bytes()
    changed = [at for at in range(0, len(after), 512) if before[at : at + 512] != after[at : at + 512]]
    assert len(changed) < len(after) // 512 // 10


def test_wherever_it_is_cut_off_the_rows_are_whole_and_the_next_time_clears_the_rest(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    written(tmp_path / "all.db", TABLES["a tree by the key"], 512, seed=512)
    with closing(sqlite3.connect(tmp_path / "all.db", isolation_level=None)) as connection:
        connection.execute("PRAGMA secure_delete = ON")
        connection.execute("DELETE FROM kept WHERE owner = 5")
    whole = Path(shutil.copy(tmp_path / "all.db", tmp_path / "whole.db"))
    steps, zero = [0, 0], Pages.zero

    def cut_off(self: Pages, number: int, page: bytes, begin: int, end: int) -> None:
        steps[0] += 1
        if steps[0] == steps[1]:
            # A kill stops a write at any byte.
            zero(self, number, page, begin, (begin + end) // 2)
            raise InterruptedError
        zero(self, number, page, begin, end)

    clear_remnants(whole)
    monkeypatch.setattr(Pages, "zero", cut_off)
    cuts = 0
    for step in count(1, 7):
        file = Path(shutil.copy(tmp_path / "all.db", tmp_path / "one.db"))
        steps[:] = 0, step
        try:
            clear_remnants(file)
        except InterruptedError:
            cuts += 1
        else:
            break
        assert everything(file) == everything(whole)
        clear_remnants(file)
        assert file.read_bytes() == whole.read_bytes()
    assert cuts > 10


def everything(file: Path) -> list[object]:
    """Return all rows of a database that is sound."""
    with closing(sqlite3.connect(file)) as connection:
        assert connection.execute("PRAGMA integrity_check").fetchall() == [("ok",)]
        return connection.execute("SELECT * FROM kept ORDER BY owner, number").fetchall()


@pytest.mark.parametrize("at", [3, 5], ids=["number of rows", "start of the content"])
def test_a_damaged_page_is_not_called_clear(tmp_path: Path, at: int) -> None:
    file = tmp_path / "one.db"
    written(file, TABLES["rows and an index"], 512, seed=1)
    content = bytearray(file.read_bytes())
    content[512 + at : 512 + at + 2] = b"\xff\xff"
    file.write_bytes(content)
    with pytest.raises(ValueError, match="page 2 is damaged"):
        clear_remnants(file)


def test_a_file_that_sqlite_makes_smaller_by_itself_is_left_alone(tmp_path: Path) -> None:
    file = tmp_path / "one.db"
    with closing(sqlite3.connect(file)) as connection:
        connection.execute("PRAGMA auto_vacuum = FULL")
        connection.execute("CREATE TABLE kept (what TEXT)")
    before = file.read_bytes()
    clear_remnants(file)
    assert file.read_bytes() == before
