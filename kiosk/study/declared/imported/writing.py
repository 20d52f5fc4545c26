"""Writes a questionnaire as a TOML file that a person goes on with; the file is written whole or not at all."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import tomlkit
from tomlkit.items import Array, InlineTable, Table

from kiosk import BadInput, unwritable
from kiosk.study.declared.questionnaire import Questionnaire


def write_questionnaire(questionnaire: Questionnaire, out: Path) -> None:
    """Write a new file; raises BadInput or StoreFailed if it cannot be, and leaves nothing behind."""
    text = as_toml(questionnaire)
    if out.exists():
        raise BadInput(f"{out} is there already; choose another name")
    part = out.with_name(f"{out.name}.part")
    try:
        part.write_text(text, "utf-8", newline="\n")
        part.replace(out)
    except OSError as error:
        part.unlink(missing_ok=True)
        raise unwritable(f"{out} cannot be written", error) from error


def as_toml(questionnaire: Questionnaire) -> str:
    """The text of a file that is read as this questionnaire."""
    document = tomlkit.document()
    given = questionnaire.model_dump(mode="json", exclude_defaults=True)
    items = given.pop("items")
    for key, value in given.items():
        document.add(key, value)
    tables = tomlkit.aot()
    for item in items:
        tables.append(_table({"id": item.pop("id"), "kind": item.pop("kind")} | item))
    document.add("items", tables)
    return tomlkit.dumps(document)


def _table(item: Mapping[str, Any]) -> Table:
    """An item, with a line for each language of a text and for each option."""
    table = tomlkit.table()
    for key, value in item.items():
        match value:
            case dict():
                for language, words in value.items():
                    table.add(tomlkit.key((key, language)), words)
            case list():
                table.add(key, _lines(value))
            case _:
                table.add(key, value)
    return table


def _lines(tables: Sequence[Mapping[str, Any]]) -> Array:
    lines = tomlkit.array()
    for table in tables:
        lines.append(_inline(table))
    return lines.multiline(multiline=True)


def _inline(table: Mapping[str, Any]) -> InlineTable:
    inline = tomlkit.inline_table()
    for key, value in table.items():
        inline.append(key, _inline(value) if isinstance(value, Mapping) else value)
    return inline
