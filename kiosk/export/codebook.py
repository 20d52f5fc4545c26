"""The codebook of a data set: what every table and column says, for readers and as schema.org has it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import fields
from typing import Any

from kiosk.experiment.events import Event, SessionEvent, WorldEvent
from kiosk.export.columns import ColumnKind, TableShape, Variable

MARKED = (
    "A text that a spreadsheet, pandas or R would take for a formula, a number, a date, true or false, or a missing "
    "value has an apostrophe (') before it. So has a text that itself begins with an apostrophe or a quote. To "
    "have every text as it was, take one apostrophe away where a cell begins with one. Numbers never have it, nor do "
    "true and false of the program's own."
)
"""How texts stand in cells, and how to undo it; for the readers of every layout."""

CODEBOOK_VERSION = "1"
"""The version of tables and columns, which every data set names; it changes when a column is renamed or removed."""

CONTEXT = {"@context": "https://schema.org/", "@type": "Dataset"}
"""How schema.org is named, as Psych-DS asks for."""


def property_value(variable: Variable) -> dict[str, Any]:
    """Return a variable as schema.org's PropertyValue."""
    told: dict[str, Any] = {
        "@type": "PropertyValue",
        "name": variable.name,
        "description": full_description(variable),
        "additionalType": variable.kind.value,
    }
    optional = {
        "unitText": variable.unit or None,
        "minValue": variable.least,
        "maxValue": variable.most,
        "valueReference": [
            {"@type": "PropertyValue", "name": level.name} | ({"description": level.meaning} if level.meaning else {})
            for level in variable.levels
        ]
        or None,
    }
    return told | {key: value for key, value in optional.items() if value is not None}


def full_description(variable: Variable) -> str:
    """Return the description, with what an empty cell means."""
    return f"{variable.description} Empty: {variable.empty}." if variable.empty else variable.description


def variables(shapes: Iterable[TableShape]) -> list[Variable]:
    """Every variable of some tables, once."""
    found: dict[str, Variable] = {}
    for shape in shapes:
        for variable in shape.variables:
            if found.setdefault(variable.name, variable) != variable:
                raise ValueError(f"the column {variable.name!r} means two things")
    return list(found.values())


def variables_measured(shapes: Iterable[TableShape]) -> dict[str, Any]:
    """Return the variables of some tables as schema.org has them."""
    return {"variableMeasured": [property_value(variable) for variable in variables(shapes)]}


def codebook_markdown(shapes: Iterable[TableShape], file_of: dict[str, str]) -> str:
    """Return the codebook for a reader; ``file_of`` names the file of each table."""
    return "\n".join(["# Codebook", "", _OPENING, *_tables(shapes, file_of), *_kinds_of_events()])


_OPENING = (
    "Every table is a CSV file in UTF-8 with a line of column names. An empty cell means that there is nothing to "
    "tell; what that says of the participant stands with each column. Where nothing is said of it, no cell is empty. "
    + MARKED
)


def _tables(shapes: Iterable[TableShape], file_of: dict[str, str]) -> Iterator[str]:
    for shape in shapes:
        yield from ("", f"## {shape.name}", "", f"`{file_of[shape.name]}`. {shape.about}")
        yield f"A row is identified by {', '.join(f'`{name}`' for name in shape.key)}."
        yield from ("", "| column | what it says | kind | unit |", "|---|---|---|---|")
        for variable in shape.variables:
            yield f"| `{variable.name}` | {_cell(_with_levels(variable))} | {_kind(variable)} | {variable.unit} |"


def _with_levels(variable: Variable) -> str:
    levels = "; ".join(f"`{level.name}`" + (f": {level.meaning}" if level.meaning else "") for level in variable.levels)
    return f"{full_description(variable)} {levels}." if levels else full_description(variable)


def _kind(variable: Variable) -> str:
    if variable.least is None and variable.most is None:
        return "one of a few names" if variable.levels and variable.kind is ColumnKind.TEXT else variable.kind.value
    return f"{variable.kind.value}, {variable.least} to {variable.most}"


def _cell(text: str) -> str:
    """Return a text that does not break its line or its cell."""
    return as_written(" ".join(text.split())).replace("|", "\\|")


def as_written(text: str) -> str:
    """Escape what a Markdown reader would take for HTML, for a link or for a picture to be fetched."""
    return text.replace("&", "&amp;").replace("<", "&lt;").replace("[", "\\[")


def _kinds_of_events() -> Iterator[str]:
    """Yield what the column ``type`` of the events can be, from the classes themselves."""
    yield from ("", "## Kinds of events", "", "What stands in the column `type`, and the fields of each.", "")
    yield from ("| type | what happened | fields |", "|---|---|---|")
    for base in (WorldEvent, SessionEvent):
        for kind in base.__subclasses__():
            own = ", ".join(f"`{field.name}`" for field in fields(kind) if field.name not in _ELSEWHERE)
            yield f"| `{kind.__name__}` | {_cell(kind.__doc__ or '')} | {own} |"
    yield ""


_ELSEWHERE = {field.name for field in fields(Event)}
"""Fields with a column of their own."""
