"""XLSForm: a workbook with a sheet of questions and a sheet of choices."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
import zipfile
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any
from xml.parsers import expat

from kiosk import UserInputError
from kiosk.language_codes import is_right, standard
from kiosk.study.survey_import.survey import (
    MOST_BYTES,
    SHARED_RULES,
    SIGN,
    VALUE,
    Rows,
    Rule,
    Shown,
    Survey,
    bounds,
    in_our_words,
    option_id,
)

_CONDITION: tuple[Rule, ...] = (
    (rf"selected\(\s*\$\{{([\w.-]+)\}}\s*,\s*({VALUE})\s*\)", "selected({1}, {2})"),
    (r"\$\{([\w.-]+)\}\s*!=\s*(?:''|\"\")", "answered({1})"),
    (r"\$\{([\w.-]+)\}\s*=\s*(?:''|\"\")", "not answered({1})"),
    (rf"\$\{{([\w.-]+)\}}{SIGN}({VALUE})", "{1} {2} {3}"),
    *SHARED_RULES,
)


_SHEET = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"
_RELATION = "{http://schemas.openxmlformats.org/officeDocument/2006/relationships}id"


def read_workbook(name: str, file: Path) -> dict[str, Rows]:
    """Return the sheets of a workbook, as rows of cells by the words in the first row."""
    try:
        with zipfile.ZipFile(file) as archive:
            if sum(entry.file_size for entry in archive.infolist()) > MOST_BYTES:
                raise UserInputError(f"{name} is too large for a questionnaire when it is unpacked")
            parts = {
                entry.filename: _xml(name, archive.read(entry))
                for entry in archive.infolist()
                if entry.filename.endswith((".xml", ".rels"))
            }
    except OSError as error:
        raise UserInputError(f"{name} cannot be read: {error.strerror}") from error
    except (zipfile.BadZipFile, RuntimeError, NotImplementedError, EOFError) as error:
        raise UserInputError(f"{name} is not an .xlsx workbook") from error
    try:
        shared = [
            "".join(text.text or "" for text in each.iter(f"{_SHEET}t"))
            for each in parts.get("xl/sharedStrings.xml", ET.Element("none"))
        ]
        places = {each.get("Id"): each.get("Target", "") for each in parts["xl/_rels/workbook.xml.rels"]}
        sheets = parts["xl/workbook.xml"].iter(f"{_SHEET}sheet")
        named = {each.get("name", ""): places[each.get(_RELATION)] for each in sheets}
        return {
            title.lower(): _rows(parts[f"xl/{place.removeprefix('/xl/')}"], shared) for title, place in named.items()
        }
    except (KeyError, IndexError, ValueError) as error:
        raise UserInputError(f"{name} is not an .xlsx workbook") from error


def _xml(name: str, content: bytes) -> ET.Element:
    def refuse(*_: object) -> None:
        raise UserInputError(f"{name} has a document type in its XML, which is refused")

    parser = expat.ParserCreate()
    parser.StartDoctypeDeclHandler = refuse
    try:
        parser.Parse(content, True)  # noqa: FBT003 - expat's own
        return ET.fromstring(content)  # noqa: S314 - entities, which need a document type, were refused
    except (expat.ExpatError, ET.ParseError) as error:
        raise UserInputError(f"{name} is not an .xlsx workbook: {error}") from error


def _rows(sheet: ET.Element, shared: Sequence[str]) -> Rows:
    table: list[dict[str, str]] = []
    for row in sheet.iter(f"{_SHEET}row"):
        cells: dict[str, str] = {}
        for cell in row.iter(f"{_SHEET}c"):
            column = re.sub(r"\d", "", cell.get("r", ""))
            value = cell.find(f"{_SHEET}v")
            if cell.get("t") == "inlineStr":
                cells[column] = "".join(text.text or "" for text in cell.iter(f"{_SHEET}t"))
            elif value is not None and value.text:
                cells[column] = shared[int(value.text)] if cell.get("t") == "s" else value.text
        table.append(cells | {"#": row.get("r", str(len(table) + 1))})
    if not table:
        return []
    heads = {column: title.strip().lower() for column, title in table[0].items() if column != "#"}
    return [
        {heads[column]: text.strip() for column, text in row.items() if column in heads} | {"#": row["#"]}
        for row in table[1:]
    ]


def _labels(survey: Survey, where: str, row: Mapping[str, str]) -> dict[str, str]:
    """Return a label in every language that has one, such as ``label::English (en)``."""
    words: dict[str, str] = {}
    for column, text in row.items():
        stem, _, language = column.partition("::")
        if stem != "label" or not text:
            continue
        code = re.search(r"\(([\w-]+)\)\s*$", language)
        spelt = code[1] if code else language.strip() or survey.language
        if is_right(spelt):
            words[standard(spelt)] = survey.plain(where, text)
        else:
            survey.leave(where, f"the language {language!r} has no code, such as in 'label::Deutsch (de)'")
    return words


def take_xlsform(survey: Survey, sheets: Mapping[str, Rows]) -> None:
    """Take the questions of a workbook; raises UserInputError if it is no XLSForm."""
    if "survey" not in sheets:
        raise UserInputError(f"{survey.name} is not an XLSForm: it has no sheet 'survey'")
    choices: dict[str, list[dict[str, Any]]] = {}
    for row in sheets.get("choices", []):
        words = _labels(survey, f"choices, row {row['#']}", row)
        if words and row.get("name"):
            choices.setdefault(row.get("list_name", row.get("list name", "")), []).append(
                {"id": option_id(row["name"]), "text": words}
            )
    _take_rows(survey, sheets["survey"], choices)


def _take_rows(survey: Survey, rows: Rows, choices: Mapping[str, list[dict[str, Any]]]) -> None:
    groups: list[Shown | None] = []
    """Those that a row stands in, from the outermost, each with its condition if it has one."""
    for row in rows:
        where = f"survey, row {row['#']}"
        verb, _, what = row.get("type", "").strip().lower().replace("_", " ").partition(" ")
        if what in {"group", "repeat"} and verb in {"begin", "end"}:
            survey.leave(where, f"{row['type']} is not taken; what is in it stands one after another")
            if verb == "begin":
                groups.append(_condition_of(where, row, "what is in it is always asked"))
            elif groups:
                groups.pop()
        elif verb:
            survey.begin()
            _take_row(survey, where, row, choices)
            survey.show_if(filter(None, (*groups, _condition_of(where, row, "it is always asked"))))


def _condition_of(where: str, row: Mapping[str, str], otherwise: str) -> Shown | None:
    """Return the condition of a row; None if it has none."""
    relevant = row.get("relevant")
    if not relevant:
        return None
    told = f"its condition ({relevant}) is not taken: {otherwise}"
    return Shown(where, told, in_our_words(relevant, _CONDITION))


_NOT_TAKEN = {
    "hint": "its hint is not taken",
    "default": "its default is not taken: nothing is chosen beforehand",
    "choice_filter": "its choice filter is not taken",
    "appearance": "its appearance ({}) is not taken",
}


def _take_row(survey: Survey, where: str, row: Mapping[str, str], choices: Mapping[str, list[dict[str, Any]]]) -> None:
    kind, _, rest = row["type"].strip().partition(" ")
    texts, name = _labels(survey, where, row), row.get("name", "")
    more: dict[str, Any] = {}
    if row.get("required", "").lower() in {"yes", "true", "true()", "1"}:
        more["required"] = True
    match kind.lower():
        case "select_one" | "select_multiple" if choices.get(rest.split(" ")[0]):
            more["options"] = choices[rest.split(" ")[0]]
            survey.add(where, name, "single" if kind == "select_one" else "multiple", texts, **more)
        case "integer":
            survey.add(where, name, "integer", texts, **more, **bounds(survey, where, row.get("constraint", "")))
        case "text":
            survey.add(where, name, "text", texts, **more)
        case "note":
            survey.add(where, name, "page", texts)
        case "range":
            survey.add(where, name, "slider", texts, **more, **_slider_ends(row.get("parameters", ""), texts))
        case _:
            survey.leave(where, f"the type {row['type']!r} is not taken")
            return
    _leave_columns(survey, where, row)


def _leave_columns(survey: Survey, where: str, row: Mapping[str, str]) -> None:
    for column, what in _NOT_TAKEN.items():
        if row.get(column):
            survey.leave(where, what.format(row[column]))


def _slider_ends(parameters: str, languages: Iterable[str]) -> dict[str, Any]:
    """Return the ends of a range, in numbers and in words, from parameters such as ``start=0 end=10``."""
    given = dict(re.findall(r"(start|end)\s*=\s*(-?\d+)", parameters))
    low, high = int(given.get("start", 0)), int(given.get("end", 10))
    left, right = (dict.fromkeys(languages, str(end)) for end in (low, high))
    return {"lowest": low, "highest": high, "left": left, "right": right}
