"""Columns and tables of the data set, how their cells are written, and the columns that tables share."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum, IntEnum
from functools import lru_cache
from typing import Any, Generic, TypeVar

from kiosk.assistance.policy import FlipInMove, GateDecision
from kiosk.config import KNOWN_CONDITIONS, ConditionConfig, Settings
from kiosk.experiment.labels import fold_name, read_as
from kiosk.experiment.outcomes import EmbodimentKind, SessionKind, Stage
from kiosk.extensions import ExtensionGroup, installed


class ExportOption(Enum):
    """Something that is left out unless it is asked for."""

    DATES = "dates"
    """When each session began."""
    REHEARSALS = "rehearsals"
    """Sessions without a visitor."""
    TRIALS = "trials"
    """Sessions at a kiosk without a PIN."""
    TEXTS = "texts"
    """What people typed, and what a failure said."""
    AGES = "ages"
    """Exact ages, instead of bands of some years."""
    UNSHARED = "unshared"
    """Sessions whose visitor did not agree to publishing."""


Cell = str | int | float | bool | tuple[str, ...] | dict[str, Any] | None
"""What may stand in a cell; None is an empty one."""

Row = TypeVar("Row")
Whole = TypeVar("Whole")

SEPARATOR = ";"
"""Between the names of a cell that holds several."""

MARK = "'"
"""Stands before a text that a spreadsheet, pandas or R would not read as text; removing one restores the text."""


class ColumnKind(Enum):
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
    kind: ColumnKind = ColumnKind.TEXT
    unit: str = ""
    levels: tuple[Level, ...] = ()
    empty: str = ""
    least: int | None = None
    most: int | None = None

    def __post_init__(self) -> None:
        """Refuse, with a ValueError, a variable that a reader could not understand."""
        if not self.name or not self.description.endswith("."):
            raise ValueError(f"the column {self.name!r} needs a description in a sentence")


@dataclass(frozen=True)
class Column(Generic[Row]):
    """A variable, and where its value is found in a row."""

    variable: Variable
    of: Callable[[Row], Cell]


@dataclass(frozen=True)
class TableShape:
    """The description of a table: its name, what a row is, its keys, and all its variables."""

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
    def shape(self) -> TableShape:
        """The table without its contents."""
        return TableShape(self.name, self.about, self.key, tuple(column.variable for column in self.columns))

    def cells(self, whole: Whole) -> Iterator[tuple[str, ...]]:
        """Return the rows as texts, in the order of the columns."""
        return zip(*self.written(whole), strict=True)

    def written(self, whole: Whole) -> list[Sequence[str]]:
        """Return the columns as texts, each in the order of the rows."""
        rows = tuple(self.rows(whole))
        return [_column(column, rows) for column in self.columns]


def _column(column: Column[Row], rows: Sequence[Row]) -> Sequence[str]:
    """Return the cells of a column as they stand in a file."""
    if column.variable is PARTICIPANT and rows:
        # All rows are about the same one.
        return [format_cell(column.of(rows[0]))] * len(rows)
    if column.variable.kind is ColumnKind.JSON:
        return _written_json(tuple(map(column.of, rows)))
    if len(rows) == 1:
        return [format_cell(column.of(rows[0]))]
    # A column's cells are mostly of one kind, so that what writes them is chosen once and not for every cell.
    return _written(tuple(map(column.of, rows)))


class Label(str):
    """A text that is to stay one even where it is a plain number.

    It comes out of every program as it went in.
    """

    __slots__ = ()


# json.dumps makes an encoder at each call where it is asked for anything but ASCII.
_as_json = json.JSONEncoder(ensure_ascii=False, separators=(",", ":")).encode

SEPARATES_OBJECTS = "\x1e"
"""Stands between objects that are written together; where it is in one of them as well, each is written by itself."""


def _written(cells: Sequence[Cell]) -> Sequence[str]:
    """Return the cells of a column as they stand in a file."""
    kinds = set(map(type, cells))
    if len(kinds) == 1:
        return list(map(_FORMATS.get(kinds.pop(), format_cell), cells))
    return [_FORMATS.get(type(cell), format_cell)(cell) for cell in cells]


def _written_json(cells: Sequence[Cell]) -> Sequence[str]:
    """Do the same for a column of JSON, in which a text is an object that is written already."""
    texts = iter(_as_jsons([cell for cell in cells if type(cell) is dict]))
    return [cell if type(cell) is str else "" if cell is None else next(texts) for cell in cells]


def _as_jsons(cells: Sequence[dict[str, Any]]) -> list[str]:
    """Return each object as JSON; all at once takes a third of the time."""
    if not cells:
        return []
    apart: list[dict[str, Any] | str] = [SEPARATES_OBJECTS] * (2 * len(cells) - 1)
    apart[::2] = cells
    texts = _as_json(apart)[1:-1].split(f",{_as_json(SEPARATES_OBJECTS)},")
    return texts if len(texts) == len(cells) else list(map(_as_json, cells))


def format_cell(cell: Cell) -> str:
    """Return a cell as it stands in a file: numbers so that they can be read back exactly."""
    written = _FORMATS.get(type(cell))
    return written(cell) if written else next(_FORMATS[kind] for kind in type(cell).__mro__ if kind in _FORMATS)(cell)


def distinct(names: Iterable[str], taken: Iterable[str] = ()) -> dict[str, str]:
    """Return each name as it can stand beside the others and what is ``taken``.

    Where two are one, a number is put behind it.
    """
    used = {fold_name(name) for name in taken}
    found: dict[str, str] = {}
    for name in names:
        free = (name, *(f"{name}_{number}" for number in range(2, len(used) + 3)))
        found[name] = next(each for each in free if fold_name(each) not in used)
        used.add(fold_name(found[name]))
    return found


@lru_cache(maxsize=4096)
def marked(text: str) -> str:
    """Return a text as it stands in a cell.

    A mark is put before it if it would be misread, or begins with a mark or a quote.
    """
    # A quote at the beginning makes those who read a file without quotes swallow the cells that follow.
    return MARK + text if text.startswith((MARK, '"')) or read_as(text) else text


_FORMATS: Mapping[type, Callable[[Any], str]] = {
    type(None): lambda _: "",
    bool: lambda cell: "true" if cell else "false",
    int: str,
    float: str,
    str: marked,
    dict: _as_json,
    Label: lambda cell: MARK + cell if cell.isdigit() else marked(str(cell)),
    tuple: lambda cell: marked(SEPARATOR.join(cell)),
}
"""How each kind of cell is written."""


def enum_levels(members: type[Enum] | Iterable[Enum], **meanings: str) -> tuple[Level, ...]:
    """Return the values of a closed set as they are recorded.

    Those that count go by their names, others by their values.
    """
    names = [member.name.lower() if isinstance(member, IntEnum) else str(member.value) for member in members]
    strange = meanings.keys() - set(names)
    if strange:
        raise ValueError(f"there is no {strange} among {names}")
    return tuple(Level(name, meanings.get(name, "")) for name in names)


PARTICIPANT = Variable(
    "participant_id",
    "Who it is about: the site, where there is more than one, and a number in the order in which people came or, where "
    "the README says that the names are shuffled, digits and letters that say nothing of that order. It has nothing to "
    "do with the code that the visitor keeps.",
)
AT = Variable("at_ms", "When it happened, from the session's first event.", ColumnKind.WHOLE, "ms")
STAGE = Variable("stage", "The stage of the session that it fell into.", levels=enum_levels(Stage))
BOARD = Variable(
    "board",
    "Which of the boards that were dealt in this session, from 1: the practice's, then the game's; a practice that was "
    "cut off and gone on with is dealt anew.",
    ColumnKind.WHOLE,
)
FLIP = Variable("flip", "The number of the flip on this board, from 1; two flips are a move.", ColumnKind.WHOLE)
MOVE_CARD = Variable(
    "move_card", "Whether the flip is the first or the second of its move.", levels=enum_levels(FlipInMove)
)
ROW = Variable("row", "The row on the board, from 1 at the top.", ColumnKind.WHOLE)
COLUMN = Variable("column", "The column on the board, from 1 at the left.", ColumnKind.WHOLE)
PICTURE = Variable("picture", "The name of the picture on the card; every picture lies on a board twice.")
ACTION = Variable(
    "action",
    "How much help was chosen for the flip.",
    levels=(
        Level("no_help", "nothing was said"),
        Level("sug_col", "the column of a card was named"),
        Level("sug_row", "the row of a card was named"),
        Level("sug_card", "a card was named by row and column"),
        Level("encouragement", "an encouragement was said, which names no place"),
        *(
            Level(each.name, f"an action of the package {each.package} {each.version}")
            for each in installed(ExtensionGroup.ACTIONS)
            if not each.is_built_in
        ),
    ),
)
GATE = Variable(
    "gate",
    "What the gate, which stands before the table, said of the flip: open, or why no help was considered.",
    levels=tuple(Level(verdict.name.lower(), "" if verdict.is_open else verdict.value) for verdict in GateDecision),
)


def condition_in_words(declared: ConditionConfig) -> str:
    """Say what a condition comes to, for a codebook."""
    comments = [
        *([f"praises {100 * declared.praise:g} % of the pairs"] if declared.praise else []),
        *([f"encourages after {100 * declared.encourage:g} % of the misses"] if declared.encourage else []),
    ]
    added = f"; it {' and '.join(comments)}, where it does not help with the next card" if comments else ""
    return _help_in_words(declared) + added


def _help_in_words(declared: ConditionConfig) -> str:
    if not declared.helps:
        return "no help at all"
    first = _TARGETS[declared.target_rule]
    told = [
        *(["the row or column"] if declared.location else []),
        *(["what the visitor has seen of the pair"] if declared.explanation else []),
    ]
    other = [f"the policy {declared.policy}"] if declared.policy else []
    other += [f"{key} = {value}" for key, value in declared.timing.items()]
    says = "is a look toward the place, without words" if declared.gaze_only else f"says {' and '.join(told)}"
    return f"{first}; a hint {says}" + (f"; with {', '.join(other)}" if other else "")


_TARGETS = {
    "mentalised": "a target chosen by what the visitor has seen",
    "most_flipped": "a target by the card that the visitor has turned up most often",
    "most_recent": "a target by the card that the visitor has turned up last",
    "random": "a random target for first cards",
}


def condition_variable(studies: Iterable[Settings]) -> Variable:
    """Describe the condition, with every name that is known or that one of these studies declared."""
    declared = dict(KNOWN_CONDITIONS)
    for settings in reversed(tuple(studies)):
        declared |= settings.conditions
    levels = tuple(Level(name, condition_in_words(each)) for name, each in declared.items())
    return Variable("condition", "The help that this visitor was given.", levels=levels)


FOLLOWED = Variable(
    "followed",
    "Whether the flip after the hint is the hinted card, or lies in the hinted row or column; after a hint that named "
    "no place, whether it is a card of the pair that the hint was about.",
    ColumnKind.TRUTH,
    empty="there was no hint, or no flip after it",
)
_LOOK = "the hint was a look without words"
SENTENCE = Variable(
    "sentence", "What was said and shown, in the session's language; a sentence of the program.", empty=_LOOK
)
UTTERANCE = Variable("utterance", "The number of the sentence in its session.", ColumnKind.WHOLE, empty=_LOOK)
EMBODIMENT = Variable(
    "embodiment",
    "What helped with voice and face: when the session began; of a sentence, in this attempt to say it.",
    levels=enum_levels(EmbodimentKind),
)
ROBOT = Variable("robot", "Which robot that was, by the name of its driver.", empty="the avatar helped")
SIMULATED = Variable("simulated", "Whether a program sat there instead of a person.", ColumnKind.TRUTH)
TRIAL = Variable("trial", "Whether the kiosk had no PIN, so that the session is none of the study's.", ColumnKind.TRUTH)


def who_sat_there(extras: frozenset[ExportOption]) -> Iterator[tuple[Variable, SessionKind]]:
    """Yield the columns that tell sessions apart which are none of the study's, with the kind that each is about."""
    if ExportOption.REHEARSALS in extras:
        yield SIMULATED, SessionKind.SIMULATED
    if ExportOption.TRIALS in extras:
        yield TRIAL, SessionKind.TRIAL


def make_columns(*pairs: tuple[Variable, Callable[[Row], Cell]]) -> tuple[Column[Row], ...]:
    """Columns from variables and where their values are found."""
    return tuple(Column(variable, of) for variable, of in pairs)
