"""Reads a CSV table as spreadsheet programs write it: its columns are those of a questionnaire, its rows are items.

Every bad cell gets a sentence of its own, with its row as the spreadsheet counts it and its column's name.
"""

from __future__ import annotations

import codecs
import csv
import io
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path

from kiosk import BadInput
from kiosk.language_codes import is_right, standard

PLAIN = ("id", "kind", "points", "scale", "reverse", "required", "lowest", "highest", "longest", "pictures")
"""Columns with one value, whatever the language."""
WORDED = ("text", "lowest", "highest", "left", "right", "options")
"""Columns that there is one of for each language, such as text_en."""
NEEDED = ("id", "kind")

DELIMITERS = ",;\t"
_SEPARATOR = re.compile(r"sep=([,;\t])[,;]*", re.IGNORECASE)
"""A first line that some spreadsheet programs write and read."""


@dataclass(frozen=True)
class Row:
    """The cells of an item that are not empty, by their columns; ``number`` is the spreadsheet's."""

    number: int
    cells: Mapping[str, str]


@dataclass(frozen=True)
class Table:
    """The rows that are not empty; ``name`` is what the table is called in a refusal."""

    name: str
    columns: tuple[str, ...]
    rows: tuple[Row, ...]

    @classmethod
    def read(cls, file: Path) -> Table:
        """Read a CSV file; raises BadInput if it is none, or its columns are not those of a questionnaire."""
        name = f"the table {file}"
        lines, first = _lines(name, file)
        header, *lines = lines or [[]]
        columns = _without_tail(header)
        faults = tuple(_wrong_columns(columns))
        if faults:
            raise BadInput(*(f"{name}: {fault}" for fault in faults))
        numbered = enumerate(lines, first)
        rows = tuple(_row(name, number, columns, line) for number, line in numbered if any(map(str.strip, line)))
        if not rows:
            raise BadInput(f"{name} has no items under its columns")
        return cls(name, columns, rows)

    @property
    def languages(self) -> tuple[str, ...]:
        """The languages of the table, in the order of its columns of texts."""
        return _languages(self.columns)


def _lines(name: str, file: Path) -> tuple[list[list[str]], int]:
    """The lines of a table from that of its columns on, and the number of the one after it in a spreadsheet."""
    text = _text(name, file)
    header, *_ = text.splitlines() or [""]
    told = _SEPARATOR.fullmatch(header.strip())
    try:
        # The names of columns hold none of them, so the first line is enough, and texts cannot mislead.
        delimiter = told[1] if told else csv.Sniffer().sniff(header, DELIMITERS).delimiter
    except csv.Error as error:
        raise BadInput(
            f"{name}: its first line must name the columns, with commas or semicolons between them"
        ) from error
    try:
        lines = list(csv.reader(io.StringIO(text, newline=""), delimiter=delimiter, strict=True))
    except csv.Error as error:
        raise BadInput(f"{name} is not CSV: {error}") from error
    # A spreadsheet hides the line that tells the separator.
    return (lines[1:] if told else lines), 2


def _text(name: str, file: Path) -> str:
    """The text of a table; spreadsheet programs mark UTF-16, and UTF-8 if they are asked for it."""
    try:
        content = file.read_bytes()
        wide = content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
        return content.decode("utf-16" if wide else "utf-8-sig")
    except OSError as error:
        raise BadInput(f"{name} cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise BadInput(f"{name} is not UTF-8; save it as CSV UTF-8") from error


def _without_tail(header: Sequence[str]) -> tuple[str, ...]:
    """The names of the columns, spelt in one way; some programs end the line with columns that have none."""
    names = [_spelt(cell.strip()) for cell in header]
    while names and not names[-1]:
        names.pop()
    return tuple(names)


def _spelt(column: str) -> str:
    """A column's name in small letters, and the code of its language as it is always spelt."""
    stem, _, code = column.partition("_")
    if stem.lower() in WORDED and is_right(code):
        return f"{stem.lower()}_{standard(code)}"
    return column.lower() if column.lower() in PLAIN else column


def _row(name: str, number: int, columns: Sequence[str], line: Sequence[str]) -> Row:
    if len(line) > len(columns) and any(map(str.strip, line[len(columns) :])):
        raise BadInput(f"{name}, row {number}: it has {len(line)} cells, but there are {len(columns)} columns")
    cells = {column: cell.strip() for column, cell in zip(columns, line, strict=False)}
    cells["kind"] = cells.get("kind", "").lower()
    return Row(number, {column: cell for column, cell in cells.items() if cell})


def _wrong_columns(columns: Sequence[str]) -> Iterator[str]:
    """A sentence for every column that is unknown, missing or there twice."""
    for at, column in enumerate(columns):
        if column in columns[:at]:
            yield f"the column {column!r} is there twice"
        elif column not in PLAIN and _worded(column) is None:
            yield f"there is no column {column!r}; {_meant(column)}"
    yield from (f"the column {column!r} is missing" for column in NEEDED if column not in columns)
    languages = _languages(columns)
    if not languages:
        yield "a column with texts is missing, such as 'text_en'"
        return
    for stem, language in filter(None, map(_worded, columns)):
        if language not in languages:
            yield f"there is a column '{stem}_{language}', but no column 'text_{language}'"


def _meant(column: str) -> str:
    close = get_close_matches(column, PLAIN, n=1)
    return f"did you mean {close[0]!r}?" if close else f"there are {', '.join((*PLAIN, *(f'{w}_en' for w in WORDED)))}"


def _worded(column: str) -> tuple[str, str] | None:
    """What a column holds the words of, and in which language."""
    stem, _, code = column.partition("_")
    return (stem, standard(code)) if stem in WORDED and is_right(code) else None


def _languages(columns: Sequence[str]) -> tuple[str, ...]:
    return tuple(worded[1] for worded in filter(None, map(_worded, columns)) if worded[0] == "text")
