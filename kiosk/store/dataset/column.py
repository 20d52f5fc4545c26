"""What a column is: one declaration, from which the cells, the codebook and the metadata are made.

There is no other way into a data set: a table writes the columns that it declares, and a column without a description
cannot be made.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from enum import Enum, IntEnum
from functools import lru_cache
from typing import Any, Generic, TypeVar

from kiosk.study.declared.labels import fold_name, read_as

Cell = str | int | float | bool | tuple[str, ...] | dict[str, Any] | None
"""What may stand in a cell; None is an empty one."""

Row = TypeVar("Row")
Whole = TypeVar("Whole")

SEPARATOR = ";"
"""Between the names of a cell that holds several."""

MARK = "'"
"""Stands before a text that a spreadsheet, pandas or R would not read as text; removing one restores the text."""


class Kind(Enum):
    """What the cells of a column are."""

    TEXT = "text"
    WHOLE = "whole number"
    NUMBER = "number"
    TRUTH = "true or false"
    NAMES = "names with a semicolon between them"
    JSON = "JSON"


@dataclass(frozen=True)
class Level:
    """One value of a closed set."""

    name: str
    meaning: str = ""


@dataclass(frozen=True)
class Variable:
    """What a column says, wherever it stands; ``empty`` says when its cell is empty, "" if it never is.

    ``least`` and ``most`` are the ends of what it can be, where they are declared.
    """

    name: str
    description: str
    kind: Kind = Kind.TEXT
    unit: str = ""
    levels: tuple[Level, ...] = ()
    empty: str = ""
    least: int | None = None
    most: int | None = None

    def __post_init__(self) -> None:
        """Refuse, with a ValueError, a variable that nobody could understand."""
        if not self.name or not self.description.endswith("."):
            raise ValueError(f"the column {self.name!r} needs a description in a sentence")


@dataclass(frozen=True)
class Column(Generic[Row]):
    """A variable, and where its value is found in a row."""

    variable: Variable
    of: Callable[[Row], Cell]


@dataclass(frozen=True)
class Shape:
    """A table as it is told of: its name, what one row is, which columns tell rows apart, and all its variables."""

    name: str
    about: str
    key: tuple[str, ...]
    variables: tuple[Variable, ...]

    @property
    def names(self) -> tuple[str, ...]:
        """The heads of its columns."""
        return tuple(variable.name for variable in self.variables)


@dataclass(frozen=True)
class Table(Generic[Whole, Row]):
    """A table with its columns in their order; ``rows`` finds its rows in what it is about."""

    name: str
    about: str
    key: tuple[str, ...]
    columns: tuple[Column[Row], ...]
    rows: Callable[[Whole], Iterable[Row]]

    @property
    def shape(self) -> Shape:
        """The table without its contents."""
        return Shape(self.name, self.about, self.key, tuple(column.variable for column in self.columns))

    def cells(self, whole: Whole) -> Iterator[list[str]]:
        """The rows as texts, in the order of the columns."""
        for row in self.rows(whole):
            yield [as_text(column.of(row)) for column in self.columns]


class Label(str):
    """A text that is to stay one even where it is a plain number, which comes out of every program as it went in."""

    __slots__ = ()


def as_text(cell: Cell) -> str:
    """A cell as it stands in a file: numbers so that they can be read back exactly."""
    match cell:
        case None:
            return ""
        case bool():
            return str(cell).lower()
        case dict():
            return json.dumps(cell, ensure_ascii=False)
        case tuple():
            return marked(SEPARATOR.join(cell))
        case str():
            return MARK + cell if isinstance(cell, Label) and cell.isdigit() else marked(str(cell))
    return str(cell)


def distinct(names: Iterable[str], taken: Iterable[str] = ()) -> dict[str, str]:
    """Each name as it can stand beside the others and what is ``taken``: with a number behind it where two are one."""
    used = {fold_name(name) for name in taken}
    found: dict[str, str] = {}
    for name in names:
        free = (name, *(f"{name}_{number}" for number in range(2, len(used) + 3)))
        found[name] = next(each for each in free if fold_name(each) not in used)
        used.add(fold_name(found[name]))
    return found


@lru_cache(maxsize=4096)
def marked(text: str) -> str:
    """A text as it stands in a cell: with a mark before it if it would be misread, or begins with a mark or a quote."""
    # A quote at the beginning makes those who read a file without quotes swallow the cells that follow.
    return MARK + text if text.startswith((MARK, '"')) or read_as(text) else text


def unmarked(cell: str) -> str:
    """The text that ``marked`` made this cell of."""
    return cell.removeprefix(MARK)


def named(members: type[Enum] | Iterable[Enum], **meanings: str) -> tuple[Level, ...]:
    """The values of a closed set as they are recorded: those that count by their names, others by their values."""
    names = [member.name.lower() if isinstance(member, IntEnum) else str(member.value) for member in members]
    strange = meanings.keys() - set(names)
    if strange:
        raise ValueError(f"there is no {strange} among {names}")
    return tuple(Level(name, meanings.get(name, "")) for name in names)
