"""New files of a data set: tables as CSV and TSV, JSON, texts, and the folder they lie in."""

from __future__ import annotations

import csv
import json
import os
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, TextIO

from kiosk import UserInputError, unwritable
from kiosk.experiment.labels import fold_name, is_reserved
from kiosk.export.tables import DatasetTables
from kiosk.store.connecting import atomic_directory
from kiosk.store.session_records import SessionRecord

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
        self._writer = _csv_writer(self._file)
        self._writer.writerow(names)

    def write(self, rows: Iterable[Sequence[str]]) -> None:
        """Add rows."""
        self._writer.writerows(rows)

    def append(self, text: str) -> None:
        """Add rows that are written as such a file has them."""
        self._file.write(text)

    def close(self) -> None:
        """Nothing follows."""
        self._file.close()


def _csv_writer(file: TextIO) -> Any:
    return csv.writer(file, lineterminator="\r\n")


def csv_texts(tables: DatasetTables, kept: SessionRecord) -> dict[str, str]:
    """Return the rows that one session adds to each table, as they stand in a CSV file."""
    return {table.name: csv_lines(table.written(kept)) for table in tables.sessions}


def csv_lines(written: Sequence[Sequence[str]]) -> str:
    """Return the lines of a table of at least two columns, as ``csv.writer`` would write them."""
    lines = list(map(",".join, zip(*map(_quoted, written), strict=True)))
    return "\r\n".join((*lines, "")) if lines else ""


def _quoted(cells: Sequence[str]) -> Sequence[str]:
    """Return the cells of a column as CSV has them."""
    # Most columns need no quotes, which one look at all their cells tells.
    if not _needs_quotes("".join(cells)):
        return cells
    # JSON needs them for its own quotes, which is looked at first, and here, because a call takes as long.
    return ['"' + cell.replace('"', '""') + '"' if '"' in cell or _needs_quotes(cell) else cell for cell in cells]


def _needs_quotes(text: str) -> bool:
    return '"' in text or "," in text or "\r" in text or "\n" in text


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
    """Return the path, if nothing beside it has this name.

    Raises UserInputError instead of writing over what is there.
    """
    name = fold_name(path.name)
    beside = next((other.name for other in path.parent.iterdir() if fold_name(other.name) == name), None)
    if beside is not None or is_reserved(path.name):
        why = f"{beside!r} is one file with it" if beside else "Windows keeps this name for a device"
        raise UserInputError(
            f"the data set cannot have a file {path.name!r} in {path.parent.name!r}: {why} on some systems"
        )
    return path


def _check_columns(path: Path, names: Sequence[str]) -> None:
    """Raise UserInputError if two columns of a table are one for programs that do not tell capitals apart."""
    first: dict[str, str] = {}
    for name in names:
        if fold_name(name) in first:
            other = first[fold_name(name)]
            raise UserInputError(
                f"the table {path.name!r} cannot have the columns {other!r} and {name!r}, one for many programs"
            )
        first[fold_name(name)] = name


@contextmanager
def new_folder(out: Path) -> Iterator[Path]:
    """Provide a folder beside ``out`` to write in.

    It takes the place of ``out`` at the end and is gone if anything goes wrong.

    Raises UserInputError, and leaves everything as it was, if ``out`` holds something or cannot be written.
    """
    try:
        _check_free(out)
        with atomic_directory(out) as made:
            yield made
            _take_the_dates_away(made)
    except OSError as error:
        raise unwritable(f"the data set cannot be written to {out}", error) from error


def _check_free(out: Path) -> None:
    if not out.name:
        raise UserInputError(f"the data set needs a folder of its own, not {out}")
    if out.exists() and not out.is_dir():
        raise UserInputError(f"the data set needs a folder, but {out} is a file")
    if out.exists() and any(out.iterdir()):
        raise UserInputError(f"the folder {out} is not empty; a data set is written into a new one")


def _take_the_dates_away(folder: Path) -> None:
    for path in (*folder.rglob("*"), folder):
        os.utime(path, (UNDATED, UNDATED))
