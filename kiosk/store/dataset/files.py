"""Files of a data set: tables of separated cells, JSON, and a folder that is there as a whole or not at all."""

from __future__ import annotations

import csv
import json
import os
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from kiosk import BadInput, unwritable
from kiosk.store.whole_folder import whole_folder
from kiosk.study.declared.labels import fold_name, is_reserved

UNDATED = datetime(1980, 1, 2, tzinfo=UTC).timestamp()
"""What every file says of when it was changed: nothing. No archive format knows an earlier day than this one's eve."""

NOTHING = "n/a"
"""How BIDS writes an empty cell."""

_WITHIN_A_LINE = str.maketrans("\t\r\n", "   ")


class CsvFile:
    """A table as CSV (RFC 4180) in UTF-8; halves of characters, which no file can hold, stand escaped."""

    def __init__(self, path: Path, names: Sequence[str]) -> None:
        """Begin the file with a line of names."""
        # With line ends of two characters every cell that holds either of them is put in quotes.
        _check_columns(path, names)
        self._file = _new(path).open("x", encoding="utf-8", errors="backslashreplace", newline="")
        self._writer = csv.writer(self._file, lineterminator="\r\n")
        self._writer.writerow(names)

    def write(self, rows: Iterable[Sequence[str]]) -> None:
        """Add rows."""
        self._writer.writerows(rows)

    def close(self) -> None:
        """Nothing follows."""
        self._file.close()


class TsvFile:
    """A table as BIDS wants it: tabs between cells, none within them, and a word for an empty one."""

    def __init__(self, path: Path, names: Sequence[str]) -> None:
        """Begin the file with a line of names."""
        _check_columns(path, names)
        self._file = _new(path).open("x", encoding="utf-8", errors="backslashreplace", newline="\n")
        self.write([names])

    def write(self, rows: Iterable[Sequence[str]]) -> None:
        """Add rows."""
        for row in rows:
            self._file.write("\t".join(cell.translate(_WITHIN_A_LINE) or NOTHING for cell in row) + "\n")

    def close(self) -> None:
        """Nothing follows."""
        self._file.close()


def write_json(path: Path, content: Any) -> None:
    """Write JSON for programs that a person may read as well."""
    write_text(path, json.dumps(content, ensure_ascii=False, indent=2) + "\n")


def write_text(path: Path, text: str) -> None:
    """Write a text into a new file, and make the folders it lies in."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with _new(path).open("x", encoding="utf-8", errors="backslashreplace", newline="\n") as file:
        file.write(text)


def _new(path: Path) -> Path:
    """The path, if nothing beside it has this name; raises BadInput instead of writing over what is there."""
    name = fold_name(path.name)
    beside = next((other.name for other in path.parent.iterdir() if fold_name(other.name) == name), None)
    if beside is not None or is_reserved(path.name):
        why = f"{beside!r} is one file with it" if beside else "Windows keeps this name for a device"
        raise BadInput(f"the data set cannot have a file {path.name!r} in {path.parent.name!r}: {why} on some systems")
    return path


def _check_columns(path: Path, names: Sequence[str]) -> None:
    """Raise BadInput if two columns of a table are one for programs that do not tell capitals apart."""
    first: dict[str, str] = {}
    for name in names:
        if fold_name(name) in first:
            other = first[fold_name(name)]
            raise BadInput(
                f"the table {path.name!r} cannot have the columns {other!r} and {name!r}, one for many programs"
            )
        first[fold_name(name)] = name


@contextmanager
def new_folder(out: Path) -> Iterator[Path]:
    """A folder beside ``out`` to write in, which takes its place at the end and is gone if anything goes wrong.

    Raises BadInput, and leaves everything as it was, if ``out`` holds something or cannot be written.
    """
    try:
        _check_free(out)
        with whole_folder(out) as made:
            yield made
            _take_the_dates_away(made)
    except OSError as error:
        raise unwritable(f"the data set cannot be written to {out}", error) from error


def _check_free(out: Path) -> None:
    if not out.name:
        raise BadInput(f"the data set needs a folder of its own, not {out}")
    if out.exists() and not out.is_dir():
        raise BadInput(f"the data set needs a folder, but {out} is a file")
    if out.exists() and any(out.iterdir()):
        raise BadInput(f"the folder {out} is not empty; a data set is written into a new one")


def _take_the_dates_away(folder: Path) -> None:
    for path in (*folder.rglob("*"), folder):
        os.utime(path, (UNDATED, UNDATED))
