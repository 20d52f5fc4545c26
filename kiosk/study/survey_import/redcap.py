"""REDCap: a data dictionary with a row for each field."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from kiosk.study.survey_import.survey import (
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
    yes_or_no,
)


def is_redcap(first: str) -> bool:
    """Whether a table with this first line is a data dictionary."""
    return "Variable / Field Name" in first or first.startswith(("field_name,", '"field_name"'))


_CONDITION: tuple[Rule, ...] = (
    (r"\[(\w+)\((\w+)\)\]\s*=\s*['\"]?1['\"]?", "selected({1}, '{2}')"),
    (r"\[(\w+)\((\w+)\)\]\s*(?:=\s*['\"]?0['\"]?|(?:<>|!=)\s*['\"]?1['\"]?)", "not selected({1}, '{2}')"),
    (r"\[(\w+)\]\s*(?:<>|!=)\s*(?:''|\"\")", "answered({1})"),
    (r"\[(\w+)\]\s*=\s*(?:''|\"\")", "not answered({1})"),
    (rf"\[(\w+)\]{SIGN}({VALUE})", "{1} {2} {3}"),
    *SHARED_RULES,
)


_COLUMNS = {
    "name": ("Variable / Field Name", "field_name"),
    "type": ("Field Type", "field_type"),
    "label": ("Field Label", "field_label"),
    "choices": ("Choices, Calculations, OR Slider Labels", "select_choices_or_calculations"),
    "validation": (
        "Text Validation Type OR Show Slider Number",
        "text_validation_type_or_show_slider_number",
    ),
    "lowest": ("Text Validation Min", "text_validation_min"),
    "highest": ("Text Validation Max", "text_validation_max"),
    "branching": ("Branching Logic (Show field only if...)", "branching_logic"),
    "required": ("Required Field?", "required_field"),
}


def take_redcap(survey: Survey, rows: Rows) -> None:
    """Take the fields of a data dictionary."""
    for number, raw in enumerate(rows, 2):
        row = {key: next((raw[each] or "" for each in names if raw.get(each)), "") for key, names in _COLUMNS.items()}
        _take_field(survey, f"row {number}, {row['name']}", row)


def _take_field(survey: Survey, where: str, row: Mapping[str, str]) -> None:
    survey.begin()
    name, kind, text = row["name"], row["type"].lower(), survey.words(where, row["label"])
    more: dict[str, Any] = {"required": True} if row["required"].lower() == "y" else {}
    match kind:
        case "radio" | "dropdown":
            survey.add(where, name, "single", text, **more, options=_options(survey, where, row["choices"]))
        case "checkbox":
            survey.add(where, name, "multiple", text, **more, options=_options(survey, where, row["choices"]))
        case "yesno" | "truefalse":
            survey.add(where, name, "single", text, **more, options=yes_or_no(survey, where))
        case "text" | "notes":
            _take_typed(survey, where, row, text, more)
        case "descriptive":
            survey.add(where, name, "page", text)
        case "slider":
            survey.add(where, name, "slider", text, **more, **_slider_ends(survey, where, row["choices"]))
        case _:
            survey.leave(where, f"the field type {row['type']!r} is not taken")
            return
    if row["branching"]:
        told = f"its branching logic ({row['branching']}) is not taken: it is always asked"
        survey.show_if([Shown(where, told, in_our_words(row["branching"], _CONDITION))])


def _take_typed(
    survey: Survey, where: str, row: Mapping[str, str], text: Mapping[str, str], more: Mapping[str, Any]
) -> None:
    """Take a field that is typed into: a whole number, or a text, whose validation is left."""
    if row["type"].lower() == "text" and row["validation"] in {"integer", "number"}:
        ends = {sign: row[key] for sign, key in ((">=", "lowest"), ("<=", "highest"))}
        limits = " and ".join(f". {sign} {end}" for sign, end in ends.items() if re.fullmatch(r"-?\d{1,9}", end))
        survey.add(where, row["name"], "integer", text, **more, **bounds(survey, where, limits))
        return
    if row["validation"]:
        survey.leave(where, f"its validation {row['validation']!r} is not taken")
    survey.add(where, row["name"], "text", text, **more)


def _slider_ends(survey: Survey, where: str, choices: str) -> dict[str, Any]:
    """Return the words at the ends of a slider: its first and last label, or 0 and 100."""
    labels = [each.strip() or "-" for each in choices.split("|")] if choices else ["0", "100"]
    return {"left": survey.words(where, labels[0]), "right": survey.words(where, labels[-1])}


def _options(survey: Survey, where: str, choices: str) -> list[dict[str, Any]]:
    pairs = [each.partition(",") for each in choices.split("|") if each.strip()]
    return [
        {"id": option_id(code.strip()), "text": survey.words(where, text.strip() or code)} for code, _, text in pairs
    ]
