"""REDCap: a data dictionary with a row for each field."""

from __future__ import annotations

import re
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


def take_redcap(survey: Survey, rows: Rows) -> None:  # noqa: C901 - a case for each type of that program
    """Take the fields of a data dictionary."""
    for number, raw in enumerate(rows, 2):
        row = {key: next((raw[each] or "" for each in names if raw.get(each)), "") for key, names in _COLUMNS.items()}
        where = f"row {number}, {row['name']}"
        survey.begin()
        text = survey.words(where, row["label"])
        more: dict[str, Any] = {"required": True} if row["required"].lower() == "y" else {}
        kind = row["type"].lower()
        match kind:
            case "radio" | "dropdown" | "checkbox":
                more["options"] = _options(survey, where, row["choices"])
                survey.add(where, row["name"], "multiple" if kind == "checkbox" else "single", text, **more)
            case "yesno" | "truefalse":
                survey.add(where, row["name"], "single", text, **more, options=yes_or_no(survey, where))
            case "text" if row["validation"] in {"integer", "number"}:
                ends = {key: int(row[key]) for key in ("lowest", "highest") if re.fullmatch(r"-?\d{1,9}", row[key])}
                limits = " and ".join(f". {'>=' if key == 'lowest' else '<='} {end}" for key, end in ends.items())
                survey.add(where, row["name"], "integer", text, **more, **bounds(survey, where, limits))
            case "text" | "notes":
                if row["validation"]:
                    survey.leave(where, f"its validation {row['validation']!r} is not taken")
                survey.add(where, row["name"], "text", text, **more)
            case "descriptive":
                survey.add(where, row["name"], "page", text)
            case "slider":
                ends_ = [each.strip() for each in row["choices"].split("|")] if row["choices"] else ["0", "100"]
                left, right = (survey.words(where, each or "-") for each in (ends_[0], ends_[-1]))
                survey.add(where, row["name"], "slider", text, **more, left=left, right=right)
            case _:
                survey.leave(where, f"the field type {row['type']!r} is not taken")
                continue
        if row["branching"]:
            told = f"its branching logic ({row['branching']}) is not taken: it is always asked"
            survey.show_if([Shown(where, told, in_our_words(row["branching"], _CONDITION))])


def _options(survey: Survey, where: str, choices: str) -> list[dict[str, Any]]:
    pairs = [each.partition(",") for each in choices.split("|") if each.strip()]
    return [
        {"id": option_id(code.strip()), "text": survey.words(where, text.strip() or code)} for code, _, text in pairs
    ]
