"""Qualtrics: a QSF file, which is JSON with an element for each question."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from kiosk import UserInputError
from kiosk.files import open_to_read, parse_json
from kiosk.study.survey_import.survey import MOST_BYTES, Shown, Survey, bounds, item_id, joined, option_id, readable


def read_document(name: str, file: Path) -> Any:
    """Return what a QSF file holds; raises UserInputError if it is none."""
    try:
        if file.stat().st_size > MOST_BYTES:
            raise UserInputError(f"{name} is too large for a questionnaire")
        with open_to_read(file) as opened:
            return parse_json(opened.read().decode("utf-8-sig"))
    except OSError as error:
        raise UserInputError(f"{name} cannot be read: {error.strerror}") from error
    except ValueError as error:
        raise UserInputError(f"{name} is not a QSF file: it is not JSON") from error


def take_qualtrics(survey: Survey, document: Any) -> None:
    """Take the questions of what a QSF file holds; raises UserInputError if it is not as Qualtrics writes it."""
    elements = document.get("SurveyElements") if isinstance(document, Mapping) else None
    if not isinstance(elements, list):
        raise UserInputError(f"{survey.name} is not a QSF file: it has no SurveyElements")
    names: dict[str, tuple[str, Mapping[str, Any]]] = {}
    for element in elements:
        if isinstance(element, Mapping) and element.get("Element") == "SQ" and isinstance(element.get("Payload"), dict):
            payload = element["Payload"]
            name = str(payload.get("DataExportTag") or element.get("PrimaryAttribute") or "q")
            names[str(element.get("PrimaryAttribute") or payload.get("QuestionID"))] = (name, payload)
            try:
                _take_question(survey, f"the question {name}", name, payload, names)
            except (KeyError, TypeError, ValueError, AttributeError) as error:
                raise UserInputError(f"{survey.name}: the question {name} is not as Qualtrics writes it") from error


def _take_question(  # noqa: C901 - a case for each type of that program
    survey: Survey,
    where: str,
    name: str,
    payload: Mapping[str, Any],
    names: Mapping[str, tuple[str, Mapping[str, Any]]],
) -> None:
    survey.begin()
    text = survey.words(where, str(payload.get("QuestionText", "")))
    settings = payload.get("Validation") or {}
    told = settings.get("Settings") if isinstance(settings, Mapping) else None
    validation = told if isinstance(told, Mapping) else {}
    more: dict[str, Any] = {"required": True} if validation.get("ForceResponse") == "ON" else {}
    choices = _options(survey, where, payload.get("Choices"), payload.get("ChoiceOrder"))
    selector = str(payload.get("Selector", ""))
    match payload.get("QuestionType"):
        case "MC" if choices:
            several = selector.startswith("M")
            survey.add(where, name, "multiple" if several else "single", text, **more, options=choices)
        case "Matrix" if choices and selector == "Likert":
            answers = _options(survey, where, payload.get("Answers"), payload.get("AnswerOrder"))
            for row in choices:
                said = joined(text, row["text"])
                survey.add(where, f"{name}_{row['id']}", "single", said, **more, options=answers)
        case "TE" if validation.get("ContentType") == "ValidNumber":
            survey.add(where, name, "integer", text, **more, **bounds(survey, where, ""))
        case "TE":
            survey.add(where, name, "text", text, **more)
        case "DB":
            survey.add(where, name, "page", text)
        case "Slider" if choices:
            for row in choices:
                left, right = survey.words(where, "0"), survey.words(where, "100")
                said = joined(text, row["text"])
                survey.add(where, f"{name}_{row['id']}", "slider", said, **more, left=left, right=right)
        case kind:
            survey.leave(where, f"the question type {kind!r} {selector} is not taken".replace("  ", " "))
            return
    if payload.get("DisplayLogic"):
        told = "its display logic is not taken: it is always asked"
        survey.show_if([Shown(where, told, _display_logic(payload["DisplayLogic"], names))])


def _options(survey: Survey, where: str, choices: Any, order: Any) -> list[dict[str, Any]]:
    if not isinstance(choices, Mapping):
        return []
    keys = [str(key) for key in order] if isinstance(order, list) and order else list(choices)
    return [{"id": option_id(key), "text": survey.words(where, str(choices[key]["Display"]))} for key in keys]


def _display_logic(logic: Any, names: Mapping[str, tuple[str, Mapping[str, Any]]]) -> str | None:
    """Return a display logic in our words; None if something in it cannot be said."""
    if not isinstance(logic, Mapping) or logic.get("Type") != "BooleanExpression":
        return None
    groups = [group for key, group in sorted(logic.items()) if key.isdigit()]
    said = ""
    for group in groups:
        if not isinstance(group, Mapping):
            return None
        inner = ""
        for number, part in enumerate(each for key, each in sorted(group.items()) if key.isdigit()):
            simple = _logic_expression(part, names)
            if simple is None:
                return None
            joint = {"AndIf": " and ", "And": " and ", "OrIf": " or ", "Or": " or "}.get(part.get("Conjuction", ""))
            if number and joint is None:
                return None
            # That program goes from left to right, whatever the conjunction is.
            inner = f"({inner}){joint}{simple}" if number else simple
        joint = " or " if group.get("Type") == "ElseIf" else " and "
        said = f"({said}){joint}({inner})" if said else inner
    return readable(said)


def _logic_expression(part: Any, names: Mapping[str, tuple[str, Mapping[str, Any]]]) -> str | None:
    """Return one line of a display logic: a choice that is selected or not."""
    if not isinstance(part, Mapping) or part.get("LogicType") != "Question":
        return None
    place = re.fullmatch(r"q://(\w+)/SelectableChoice/(\w+)", str(part.get("LeftOperand") or part.get("ChoiceLocator")))
    if place is None or place[1] not in names:
        return None
    name, payload = names[place[1]]
    if payload.get("QuestionType") != "MC":
        return None
    chosen = f"selected({item_id(name)}, '{option_id(place[2])}')"
    return {"Selected": chosen, "NotSelected": f"not {chosen}"}.get(str(part.get("Operator")))
