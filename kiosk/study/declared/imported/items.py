"""Makes a questionnaire of a table: each row becomes an item of its kind, or a sentence for each of its bad cells."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from types import NoneType
from typing import Any, get_args, get_origin

from pydantic import ValidationError
from pydantic.fields import FieldInfo

from kiosk import BadInput
from kiosk.refusals import complaint, faults, refusals
from kiosk.study.declared.imported.table import WORDED, Row, Table
from kiosk.study.declared.questionnaire import (
    Differential,
    Integer,
    Likert,
    Multiple,
    Order,
    Pictures,
    Questionnaire,
    ShortText,
    Single,
    Slider,
    TextPage,
)

Model = type[Likert | Differential | Slider | Pictures | Single | Multiple | Integer | ShortText | TextPage]

MODELS: Mapping[str, Model] = {
    "likert": Likert,
    "differential": Differential,
    "slider": Slider,
    "pictures": Pictures,
    "single": Single,
    "multiple": Multiple,
    "integer": Integer,
    "text": ShortText,
    "page": TextPage,
}

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


@dataclass(frozen=True)
class Heading:
    """What a questionnaire has besides its items."""

    id: str
    version: str
    note: str
    per_page: int = 1
    order: Order = Order.FIXED


def read_items(file: Path, heading: Heading) -> Questionnaire:
    """The questionnaire that a CSV table holds; raises BadInput with a sentence for every bad cell."""
    table = Table.read(file)
    reading = _Reading(table)
    items = tuple(reading.item(row) for row in table.rows)
    reading.check_ids()
    if reading.faults:
        raise BadInput(*reading.faults)
    given = {**vars(heading), "items": items}
    try:
        return Questionnaire.model_validate(given)
    except ValidationError as error:
        raise BadInput(*(f"{table.name}: {each}" for each in refusals(error, given, Questionnaire))) from error


@dataclass
class _Reading:
    """Makes items of rows; what is wrong with a cell becomes a sentence in ``faults``."""

    table: Table
    faults: list[str] = field(default_factory=list)

    def check_ids(self) -> None:
        """No two items have the same id."""
        first: dict[str, int] = {}
        for row in self.table.rows:
            name = row.cells.get("id", "")
            if name and first.setdefault(name, row.number) != row.number:
                self._blame(row, "id", f"{name!r} stands in row {first[name]} too")

    def item(self, row: Row) -> Any:
        """The item of a row, or None."""
        kind = row.cells.get("kind", "")
        if kind not in MODELS:
            what = f"it must be one of {', '.join(MODELS)}, but it is {kind!r}" if kind else "it is empty"
            self._blame(row, "kind", what)
            return None
        given, used = self._given(row, MODELS[kind])
        for column in (column for column in row.cells if column not in used):
            self._blame(row, column, f"an item of the kind {kind!r} has none, so the cell must be empty")
        try:
            return MODELS[kind].model_validate(given)
        except ValidationError as error:
            # What is missing was said when its cell was read.
            for fault in (fault for fault in faults(error) if fault["type"] != "missing"):
                what = complaint(fault, MODELS[kind])
                self._blame(row, self._column(fault["loc"]), f"it {what}" if what.startswith("must ") else what)
            return None

    def _given(self, row: Row, model: Model) -> tuple[dict[str, Any], set[str]]:
        """What a row gives for the fields of a model, and the columns that it stands in."""
        given: dict[str, Any] = {}
        used: set[str] = set()
        for key, field_ in model.model_fields.items():
            reading = _reading(field_)
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

    def _read(self, row: Row, key: str, columns: Sequence[str], reading: Callable[[str], Any] | None) -> Any:
        """The value of one field, from its cell or, for words, from that of every language; None if it is none."""
        if key == "options":
            return self._options(row, columns)
        if reading is None:
            return {column.removeprefix(f"{key}_"): row.cells[column] for column in columns}
        try:
            return reading(row.cells[key])
        except ValueError as error:
            self._blame(row, key, str(error))
            return None

    def _options(self, row: Row, columns: Sequence[str]) -> list[dict[str, Any]] | None:
        """The options of a choice: ``id=word;id=word`` in each language, with the same ids in the same order."""
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

    def _pairs(self, row: Row, column: str) -> dict[str, str]:
        """The words of a cell by their ids; nothing if they cannot be told."""
        pairs = [tuple(map(str.strip, pair.partition("=")[::2])) for pair in row.cells[column].split(";")]
        told = {name: word for name, word in pairs if name and word}
        if len(told) < len(pairs):
            self._blame(row, column, f"it must be like id=word;id=word, each id once, but it is {row.cells[column]!r}")
            return {}
        return told

    def _column(self, place: Sequence[int | str]) -> str:
        """The column in which a fault of an item stands; the only one of an item as a whole is about its ends."""
        match place:
            case ():
                return "lowest"
            case ("options", *_):
                return f"options_{self.table.languages[0]}"
            case (str(stem), str(language)) if stem in WORDED:
                return f"{stem}_{language}"
        return str(place[0])

    def _blame(self, row: Row, column: str, what: str) -> None:
        self.faults.append(f"{self.table.name}, row {row.number}, column {column}: {what}")


def _reading(field_: FieldInfo) -> Callable[[str], Any] | None:
    """How the cell of a field is read; None if it is words, with a column for each language."""
    kinds = [each for each in get_args(field_.annotation) if each is not NoneType] or [field_.annotation]
    kind = get_args(kinds[0])[0] if hasattr(kinds[0], "__metadata__") else kinds[0]
    if (get_origin(kind) or kind) in {dict, tuple} or get_origin(field_.annotation) in {dict, tuple}:
        return None
    return {int: _number, bool: _yes_or_no}.get(kind, str)


def _number(cell: str) -> int:
    if not re.fullmatch(r"-?\d{1,9}", cell, re.ASCII):
        raise ValueError(f"it must be a whole number, but it is {cell!r}")
    return int(cell)


def _yes_or_no(cell: str) -> bool:
    if cell.lower() not in _YES | _NO:
        raise ValueError(f"it must be yes or no, but it is {cell!r}")
    return (_YES | _NO)[cell.lower()]
