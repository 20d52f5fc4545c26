"""Import questionnaires from tables that people and survey tools write."""

from __future__ import annotations

import codecs
import csv
import io
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from difflib import get_close_matches
from pathlib import Path
from types import NoneType
from typing import Any, get_args, get_origin

import tomlkit
from pydantic import ValidationError
from pydantic.fields import FieldInfo
from tomlkit.items import Array, InlineTable, Table

from kiosk import UserInputError
from kiosk.config import read_content
from kiosk.errors import error_message, validation_errors, validation_messages
from kiosk.experiment.items import BaseItem, Question
from kiosk.experiment.questionnaire import ITEM_KINDS, ItemOrder, Questionnaire
from kiosk.files import write_file
from kiosk.language_codes import is_right, standard

_YES = dict.fromkeys(
    (
        *("yes", "y", "true", "1", "x", "vero", "sì", "si", "verdadero", "sí", "ja", "j", "wahr", "oui", "o", "vrai"),
        *("sim", "verdadeiro", "waar", "sand", "sant", "tak", "prawda", "ano", "pravda"),
    ),
    True,
)
_NO = dict.fromkeys(
    (
        *("no", "n", "false", "0", "falso", "nein", "falsch", "non", "faux", "não", "nee", "onwaar", "falsk", "nej"),
        *("nei", "nie", "fałsz", "ne", "nepravda"),
    ),
    False,
)
"""Spreadsheet programs and people write truth in their own language."""


def field_reader(field_: FieldInfo) -> Callable[[str], Any] | None:
    """How the cell of a field is read; None if it is words, with a column for each language."""
    if field_.annotation == Question.model_fields["required"].annotation:
        return _requirement
    kinds = [each for each in get_args(field_.annotation) if each is not NoneType] or [field_.annotation]
    kind = get_args(kinds[0])[0] if hasattr(kinds[0], "__metadata__") else kinds[0]
    if (get_origin(kind) or kind) in {dict, tuple} or get_origin(field_.annotation) in {dict, tuple}:
        return None
    return {int: _number, bool: _yes_or_no}.get(kind, str)


def _requirement(cell: str) -> bool | str:
    if cell.lower() == "once":
        return "once"
    if cell.lower() not in _YES | _NO:
        raise ValueError(f"it must be yes, no or once, but it is {cell!r}")
    return (_YES | _NO)[cell.lower()]


def _number(cell: str) -> int:
    if not re.fullmatch(r"-?\d{1,9}", cell, re.ASCII):
        raise ValueError(f"it must be a whole number, but it is {cell!r}")
    return int(cell)


def _yes_or_no(cell: str) -> bool:
    if cell.lower() not in _YES | _NO:
        raise ValueError(f"it must be yes or no, but it is {cell!r}")
    return (_YES | _NO)[cell.lower()]


_COLUMNS = ("id", "kind", "points", "scale", "reverse", "required", "lowest", "highest", "longest", "pictures")
_WORDED = ("text", "lowest", "highest", "left", "right", "options")
_FIELDS = {key: field for model in ITEM_KINDS.values() for key, field in model.model_fields.items()}

PLAIN = (
    *_COLUMNS,
    *(key for key, field in _FIELDS.items() if key not in (*_COLUMNS, *_WORDED) and field_reader(field)),
)
"""Columns with one value, whatever the language; a kind of another package adds those of its own fields."""
WORDED = (
    *_WORDED,
    *(key for key, field in _FIELDS.items() if key not in (*_COLUMNS, *_WORDED) and not field_reader(field)),
)
"""Columns that there is one of for each language, such as text_en."""
NEEDED = ("id", "kind")

DELIMITERS = ",;\t"
_SEPARATOR = re.compile(r"sep=([,;\t])[,;]*", re.IGNORECASE)
"""A first line that some spreadsheet programs write and read."""


@dataclass(frozen=True)
class CsvRow:
    """The cells of an item that are not empty, by their columns; ``number`` is the spreadsheet's."""

    number: int
    cells: Mapping[str, str]


@dataclass(frozen=True)
class CsvTable:
    """The rows that are not empty; ``name`` is what the table is called in a refusal."""

    name: str
    columns: tuple[str, ...]
    rows: tuple[CsvRow, ...]

    @classmethod
    def read(cls, file: Path) -> CsvTable:
        """Read a CSV file; raises UserInputError if it is none, or its columns are not those of a questionnaire."""
        name = f"the table {file}"
        lines, first = _lines(name, file)
        header, *lines = lines or [[]]
        columns = _without_tail(header)
        faults = tuple(_wrong_columns(columns))
        if faults:
            raise UserInputError(*(f"{name}: {fault}" for fault in faults))
        numbered = enumerate(lines, first)
        rows = tuple(_row(name, number, columns, line) for number, line in numbered if any(map(str.strip, line)))
        if not rows:
            raise UserInputError(f"{name} has no items under its columns")
        return cls(name, columns, rows)

    @property
    def languages(self) -> tuple[str, ...]:
        """The languages of the table, in the order of its columns of texts."""
        return _languages(self.columns)


def _lines(name: str, file: Path) -> tuple[list[list[str]], int]:
    """Return the lines of a table from its column names on, and their spreadsheet line number."""
    text = text_of_table(name, file)
    header, *_ = text.splitlines() or [""]
    told = _SEPARATOR.fullmatch(header.strip())
    try:
        # The names of columns hold none of them, so the first line is enough, and texts cannot mislead.
        delimiter = told[1] if told else csv.Sniffer().sniff(header, DELIMITERS).delimiter
    except csv.Error as error:
        raise UserInputError(
            f"{name}: its first line must name the columns, with commas or semicolons between them"
        ) from error
    try:
        lines = list(csv.reader(io.StringIO(text, newline=""), delimiter=delimiter, strict=True))
    except csv.Error as error:
        raise UserInputError(f"{name} is not CSV: {error}") from error
    # A spreadsheet hides the line that tells the separator.
    return (lines[1:] if told else lines), 2


def text_of_table(name: str, file: Path) -> str:
    """Return the text of a table; spreadsheet programs mark UTF-16, and UTF-8 if they are asked for it."""
    content = read_content(name, file)
    try:
        if content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
            return content.decode("utf-16")
        try:
            return content.decode("utf-8-sig")
        except UnicodeDecodeError:
            # What spreadsheet programs on Windows write in the West when they are not asked for UTF-8.
            return content.decode("cp1252")
    except UnicodeDecodeError as error:
        raise UserInputError(f"{name} is neither UTF-8 nor Windows-1252; save it as CSV UTF-8") from error


def _without_tail(header: Sequence[str]) -> tuple[str, ...]:
    """Return the names of the columns, spelt in one way; some programs end the line with columns that have none."""
    names = [_spelt(cell.strip()) for cell in header]
    while names and not names[-1]:
        names.pop()
    return tuple(names)


def _spelt(column: str) -> str:
    """Return a column's name in small letters, and the code of its language as it is always spelt."""
    stem, _, code = column.partition("_")
    if stem.lower() in WORDED and is_right(code):
        return f"{stem.lower()}_{standard(code)}"
    return column.lower() if column.lower() in PLAIN else column


def _row(name: str, number: int, columns: Sequence[str], line: Sequence[str]) -> CsvRow:
    if len(line) > len(columns) and any(map(str.strip, line[len(columns) :])):
        raise UserInputError(f"{name}, row {number}: it has {len(line)} cells, but there are {len(columns)} columns")
    cells = {column: cell.strip() for column, cell in zip(columns, line, strict=False)}
    cells["kind"] = cells.get("kind", "").lower()
    return CsvRow(number, {column: cell for column, cell in cells.items() if cell})


def _wrong_columns(columns: Sequence[str]) -> Iterator[str]:
    """Yield a sentence for every column that is unknown, missing or there twice."""
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
    """Return what a column holds the words of, and in which language."""
    stem, _, code = column.partition("_")
    return (stem, standard(code)) if stem in WORDED and is_right(code) else None


def _languages(columns: Sequence[str]) -> tuple[str, ...]:
    return tuple(worded[1] for worded in filter(None, map(_worded, columns)) if worded[0] == "text")


@dataclass(frozen=True)
class Heading:
    """What a questionnaire has besides its items."""

    id: str
    version: str
    note: str
    per_page: int = 1
    order: ItemOrder = ItemOrder.FIXED


def read_items(file: Path, heading: Heading) -> Questionnaire:
    """Return the questionnaire that a CSV table holds; raises UserInputError with a sentence for every bad cell."""
    table = CsvTable.read(file)
    reading = _Reading(table)
    items = tuple(reading.item(row) for row in table.rows)
    reading.check_ids()
    if reading.faults:
        raise UserInputError(*reading.faults)
    given = {**vars(heading), "items": items}
    try:
        return Questionnaire.model_validate(given)
    except ValidationError as error:
        raise UserInputError(*_whole_faults(error, table, given)) from error


def _whole_faults(error: ValidationError, table: CsvTable, given: Mapping[str, Any]) -> Iterator[str]:
    """Yield what is wrong between the items; of a condition, with its row."""
    conditions = [fault for fault in error.errors() if fault["loc"][::2] == ("items", "relevant")]
    for fault in conditions:
        yield f"{table.name}, row {table.rows[int(fault['loc'][1])].number}, column relevant: {fault['msg']}"
    if not conditions:
        yield from (f"{table.name}: {each}" for each in validation_messages(error, given, Questionnaire))


@dataclass
class _Reading:
    """Makes items of rows; what is wrong with a cell becomes a sentence in ``faults``."""

    table: CsvTable
    faults: list[str] = field(default_factory=list)

    def check_ids(self) -> None:
        """No two items have the same id."""
        first: dict[str, int] = {}
        for row in self.table.rows:
            name = row.cells.get("id", "")
            if name and first.setdefault(name, row.number) != row.number:
                self._blame(row, "id", f"{name!r} stands in row {first[name]} too")

    def item(self, row: CsvRow) -> Any:
        """Return the item of a row, or None."""
        kind = row.cells.get("kind", "")
        if kind not in ITEM_KINDS:
            what = f"it must be one of {', '.join(ITEM_KINDS)}, but it is {kind!r}" if kind else "it is empty"
            self._blame(row, "kind", what)
            return None
        given, used = self._given(row, ITEM_KINDS[kind])
        for column in (column for column in row.cells if column not in used):
            self._blame(row, column, f"an item of the kind {kind!r} has none, so the cell must be empty")
        try:
            return ITEM_KINDS[kind].model_validate(given)
        except ValidationError as error:
            # What is missing was said when its cell was read.
            for fault in (fault for fault in validation_errors(error) if fault["type"] != "missing"):
                what = error_message(fault, ITEM_KINDS[kind])
                self._blame(row, self._column(fault["loc"]), f"it {what}" if what.startswith("must ") else what)
            return None

    def _given(self, row: CsvRow, model: type[BaseItem]) -> tuple[dict[str, Any], set[str]]:
        """Return what a row gives for the fields of a model, and the columns that it stands in."""
        given: dict[str, Any] = {}
        used: set[str] = set()
        for key, field_ in model.model_fields.items():
            reading = field_reader(field_)
            columns = (key,) if reading else tuple(f"{key}_{language}" for language in self.table.languages)
            used |= set(columns)
            filled = [column for column in columns if column in row.cells]
            if not filled and not field_.is_required():
                continue
            for column in columns:
                if column not in row.cells:
                    lacks = "it is empty" if column in self.table.columns else "there is no such column"
                    self._blame(row, column, f"{lacks}, but an item of the kind {row.cells['kind']!r} needs it")
            if len(filled) == len(columns) and (value := self._read(row, key, columns, reading)) is not None:
                given[key] = value
        return given, used

    def _read(self, row: CsvRow, key: str, columns: Sequence[str], reading: Callable[[str], Any] | None) -> Any:
        """Return the value of one field; None if there is none.

        Words come from the cells of every language.
        """
        if key == "options":
            return self._options(row, columns)
        if reading is None:
            return {column.removeprefix(f"{key}_"): row.cells[column] for column in columns}
        try:
            return reading(row.cells[key])
        except ValueError as error:
            self._blame(row, key, str(error))
            return None

    def _options(self, row: CsvRow, columns: Sequence[str]) -> list[dict[str, Any]] | None:
        """Return the options of a choice: ``id=word;id=word`` in each language, with the same ids in the same order."""
        words = {column: self._pairs(row, column) for column in columns}
        first, *others = words
        if not all(words.values()):
            return None
        for column in others:
            if list(words[column]) != list(words[first]):
                self._blame(row, column, f"its ids must be those of {first}, in the same order")
        return [
            {"id": name, "text": {column.removeprefix("options_"): words[column].get(name, "?") for column in columns}}
            for name in words[first]
        ]

    def _pairs(self, row: CsvRow, column: str) -> dict[str, str]:
        """Return the words of a cell by their ids; nothing if they cannot be told."""
        pairs = [tuple(map(str.strip, pair.partition("=")[::2])) for pair in row.cells[column].split(";")]
        told = {name: word for name, word in pairs if name and word}
        if len(told) < len(pairs):
            self._blame(row, column, f"it must be like id=word;id=word, each id once, but it is {row.cells[column]!r}")
            return {}
        return told

    def _column(self, place: Sequence[int | str]) -> str:
        """Return the column in which a fault of an item stands.

        The only fault of an item as a whole is about its ends.
        """
        match place:
            case ():
                return "lowest"
            case ("options", *_):
                return f"options_{self.table.languages[0]}"
            case (str(stem), str(language)) if stem in WORDED:
                return f"{stem}_{language}"
        return str(place[0])

    def _blame(self, row: CsvRow, column: str, what: str) -> None:
        self.faults.append(f"{self.table.name}, row {row.number}, column {column}: {what}")


def write_questionnaire(questionnaire: Questionnaire, out: Path) -> None:
    """Write a new file; raises UserInputError or StorageError if it cannot be, and leaves nothing behind."""
    text = as_toml(questionnaire)
    if out.exists():
        raise UserInputError(f"{out} is there already; choose another name")
    write_file(out, text)


def as_toml(questionnaire: Questionnaire) -> str:
    """Return the text of a file that is read as this questionnaire."""
    document = tomlkit.document()
    given = questionnaire.model_dump(mode="json", exclude_defaults=True)
    items = given.pop("items")
    for key, value in given.items():
        _add(document, key, value)
    tables = tomlkit.aot()
    for item in items:
        tables.append(_table({"id": item.pop("id"), "kind": item.pop("kind")} | item))
    document.add("items", tables)
    return tomlkit.dumps(document)


def _table(item: Mapping[str, Any]) -> Table:
    """Return an item, with a line for each language of a text and for each option."""
    table = tomlkit.table()
    for key, value in item.items():
        _add(table, key, value)
    return table


def _add(table: Table | tomlkit.TOMLDocument, key: str, value: Any) -> None:
    match value:
        case dict():
            for language, words in value.items():
                table.add(tomlkit.key((key, language)), words)
        case list():
            table.add(key, _item_lines(value))
        case _:
            table.add(key, value)


def _item_lines(tables: Sequence[Mapping[str, Any]]) -> Array:
    lines = tomlkit.array()
    for table in tables:
        lines.append(_inline(table))
    return lines.multiline(multiline=True)


def _inline(table: Mapping[str, Any]) -> InlineTable:
    inline = tomlkit.inline_table()
    for key, value in table.items():
        inline.append(key, _inline(value) if isinstance(value, Mapping) else value)
    return inline
