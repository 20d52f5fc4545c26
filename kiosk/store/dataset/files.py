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

from kiosk import BadInput
from kiosk.store.whole_folder import whole_folder

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
        self._file = path.open("w", encoding="utf-8", errors="backslashreplace", newline="")
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
        self._file = path.open("w", encoding="utf-8", errors="backslashreplace", newline="\n")
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
    """Write a text, and the folders it lies in."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, "utf-8", errors="backslashreplace", newline="\n")


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
        raise BadInput(f"the data set cannot be written to {out}: {error.strerror}") from error


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
