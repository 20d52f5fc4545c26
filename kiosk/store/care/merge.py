"""Data folders of several kiosks brought together in a new one; what is merged is copied and never changed."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, closing
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from kiosk import BadInput
from kiosk.store.care.backup import Progress
from kiosk.store.database import in_use, open_for_reading, open_for_writing
from kiosk.store.people.participants import participant_name
from kiosk.store.recorder import StoreFailed
from kiosk.store.rows import insert
from kiosk.store.whole_folder import whole_folder

Row = dict[str, Any]


def merge(folders: Sequence[Path], out: Path, tell: Progress = lambda _done, _of: None) -> int:
    """Bring data folders together in a new one, all of it or nothing; returns how many sittings it has.

    Sittings are numbered anew, in the order in which they began, whatever the order of the folders; a participant's
    number, site and code stay. Raises BadInput if a folder cannot be read or is written in, if one participant or code
    stands in two of them, or if ``out`` is not empty; StoreFailed if the disk does not take it.
    """
    out = out.absolute()
    _check_folders(folders, out)
    with ExitStack() as opened:
        parts = [_Part(folder, opened.enter_context(closing(open_for_reading(folder)))) for folder in folders]
        _check_at_rest(parts)
        _check_apart(parts)
        try:
            with whole_folder(out) as unfinished, closing(open_for_writing(unfinished)) as target:
                target.execute("BEGIN IMMEDIATE")
                sittings = _copy(parts, target, tell)
                target.execute("COMMIT")
        except (OSError, sqlite3.Error) as error:
            raise StoreFailed(f"{out} could not be written: {error}") from error
    return sittings


@dataclass
class _Part:
    """One of the folders, and what its sittings and lists are numbered in the new one."""

    folder: Path
    connection: sqlite3.Connection
    sittings: dict[int, int] = field(default_factory=dict)
    lists: dict[int, int] = field(default_factory=dict)

    def rows(self, table: str, where: str = "", *values: int) -> Iterator[Row]:
        """Rows of a table by their columns' names."""
        cursor = self.connection.execute(f"SELECT * FROM {table} {where}", values)  # noqa: S608 - the names are ours
        names = [name for name, *_ in cursor.description]
        return (dict(zip(names, row, strict=True)) for row in cursor)


def _check_folders(folders: Sequence[Path], out: Path) -> None:
    if len({folder.resolve() for folder in folders}) < len(folders):
        raise BadInput("a data folder is named twice; each can be merged once")
    if out.exists() and (not out.is_dir() or any(out.iterdir())):
        raise BadInput(f"{out} is not an empty folder; nothing was merged")


def _check_at_rest(parts: Sequence[_Part]) -> None:
    for part in parts:
        if in_use(part.folder):
            raise BadInput(f"a kiosk is writing in {part.folder}: close it first, then merge")


def _check_apart(parts: Sequence[_Part]) -> None:
    """Refuse two folders that hold one participant, or one code."""
    people: dict[tuple[str, int, int], Path] = {}
    codes: dict[str, Path] = {}
    for part in parts:
        for row in (*part.rows("participant"), *part.rows("tombstone")):
            who = (row["site"], row["simulated"], row["number"])
            first = people.setdefault(who, part.folder)
            if first != part.folder:
                name = participant_name(row["site"], row["number"])
                raise BadInput(
                    f"participant {name} stands in {first} and in {part.folder}; nothing was merged "
                    "(kiosks whose data will be merged need a --site each)"
                )
            first = codes.setdefault(row["code"], part.folder) if "code" in row else part.folder
            if first != part.folder:
                raise BadInput(f"the code {row['code']} stands in {first} and in {part.folder}; nothing was merged")


def _copy(parts: Sequence[_Part], target: sqlite3.Connection, tell: Progress) -> int:
    for part in parts:
        for row in part.rows("source"):
            target.execute("INSERT INTO source VALUES (?, ?) ON CONFLICT DO NOTHING", tuple(row.values()))
    _copy_lists(parts, target)
    _copy_tombstones(parts, target)
    for table, keys in (("visit", ("why", "simulated")), ("booth_event", ("wall_ms", "type", "body"))):
        for _, row in _ordered(parts, table, *keys):
            insert(target, table, {name: value for name, value in row.items() if name != "id"})
    return _copy_sittings(parts, target, tell)


def _copy_lists(parts: Sequence[_Part], target: sqlite3.Connection) -> None:
    for part, row in _ordered(parts, "allocation", "fixed_at", "site", "simulated", "id"):
        part.lists[row["id"]] = insert(target, "allocation", {n: value for n, value in row.items() if n != "id"})


def _copy_tombstones(parts: Sequence[_Part], target: sqlite3.Connection) -> None:
    """They stand before the sittings, so that no sitting that is yet to come takes their numbers."""
    ordered = _ordered(parts, "tombstone", "site", "simulated", "number")
    for number, (part, row) in enumerate(ordered, 1):
        insert(target, "tombstone", row | {"sitting": number, "list": part.lists.get(row["list"])})
    target.execute("INSERT INTO sqlite_sequence VALUES ('sitting', ?)", (len(ordered),))


def _copy_sittings(parts: Sequence[_Part], target: sqlite3.Connection, tell: Progress) -> int:
    ordered = _ordered(parts, "sitting", "started_at", "site", "simulated", "seed", "id")
    for done, (part, row) in enumerate(ordered):
        tell(done, len(ordered))
        old = row.pop("id")
        new = insert(target, "sitting", row | {"list": part.lists.get(row["list"])})
        for table in ("event", "participant"):
            for own in part.rows(table, "WHERE sitting = ?", old):
                insert(target, table, own | {"sitting": new})
    return len(ordered)


def _ordered(parts: Sequence[_Part], table: str, *keys: str) -> list[tuple[_Part, Row]]:
    """The rows of all folders in an order that does not depend on that of the folders."""
    rows = [(part, row) for part in parts for row in part.rows(table)]
    return sorted(rows, key=lambda each: tuple(each[1][key] for key in keys))
