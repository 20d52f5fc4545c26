"""LimeSurvey: a table with rows for groups, questions, their parts and their answers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from kiosk.language_codes import is_right, standard
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
    joined,
    option_id,
    yes_or_no,
)


def is_limesurvey(first: str) -> bool:
    """Whether a table with this first line is one of LimeSurvey."""
    return {"class", "type/scale", "name", "text"} <= set(first.replace('"', "").strip().split("\t"))


_CONDITION: tuple[Rule, ...] = (
    (r"!\s*is_empty\(\s*(\w+?)(?:\.(?:NAOK|value))?\s*\)", "answered({1})"),
    (r"is_empty\(\s*(\w+?)(?:\.(?:NAOK|value))?\s*\)", "not answered({1})"),
    (rf"\b(?!and\b|or\b|not\b)([A-Za-z]\w*)(?:\.(?:NAOK|value))?{SIGN}({VALUE})", "{1} {2} {3}"),
    (r"&&", " and "),
    (r"\|\|", " or "),
    (r"!(?!=)", "not "),
    *SHARED_RULES,
)


@dataclass
class _Question:
    """A question with what stands below it, in every language."""

    where: str
    kind: str
    shown: tuple[Shown, ...]
    required: bool
    text: dict[str, str] = field(default_factory=dict)
    parts: dict[str, dict[str, str]] = field(default_factory=dict)
    answers: dict[str, dict[str, str]] = field(default_factory=dict)

    def asked(self, name: str) -> Iterator[tuple[str, dict[str, str]]]:
        """Yield the name and the text of each item here: one for each part, or the question alone."""
        if not self.parts:
            yield name, self.text
        for key, words in self.parts.items():
            yield f"{name}_{key}", joined(self.text, words)


def take_limesurvey(survey: Survey, rows: Rows) -> None:
    """Take the questions of a table."""
    questions: dict[str, _Question] = {}
    now: _Question | None = None
    group: tuple[Shown, ...] = ()
    for number, row in enumerate(rows, 2):
        where, name = f"row {number}, {row.get('name', '')}", row.get("name") or ""
        code = row.get("language") or survey.language
        code = standard(code) if is_right(code) else survey.language
        text = survey.plain(where, row.get("text") or "")
        match row.get("class"):
            case "Q":
                kind, asked = row.get("type/scale") or "", (row.get("mandatory") or "").upper() == "Y"
                shown = (*group, *_relevance(where, row, "it is always asked"))
                now = questions.setdefault(name, _Question(where, kind, shown, asked))
                now.text[code] = text
            case "SQ" if now:
                now.parts.setdefault(name, {})[code] = text
            case "A" if now:
                now.answers.setdefault(name, {})[code] = text
            case "G":
                now, group = None, _relevance(where, row, "what is in the group is always asked")
    for name, question in questions.items():
        _take_question(survey, name, question)


def _relevance(where: str, row: Mapping[str, str], otherwise: str) -> tuple[Shown, ...]:
    """Return the condition of a row, if it has one."""
    relevance = row.get("relevance") or "1"
    if relevance == "1":
        return ()
    told = f"its relevance ({relevance}) is not taken: {otherwise}"
    return (Shown(where, told, in_our_words(relevance, _CONDITION)),)


_POINTS = {"5": 5, "A": 5, "B": 10}


def _take_question(survey: Survey, name: str, question: _Question) -> None:  # noqa: C901 - a case for each of its types
    survey.begin()
    more: dict[str, Any] = {"required": True} if question.required else {}
    where, kind, text = question.where, question.kind, question.text
    answers, parts = _options(question.answers), _options(question.parts)
    match kind:
        case "L" | "!" | "O" if answers:
            survey.add(where, name, "single", text, **more, options=answers)
        case "M" | "P" if parts:
            survey.add(where, name, "multiple", text, **more, options=parts)
        case "F" | "H" if answers:
            for each, said in question.asked(name):
                survey.add(where, each, "single", said, **more, options=answers)
        case "5" | "A" | "B":
            points = _POINTS[kind]
            for each, said in question.asked(name):
                low, high = dict.fromkeys(said, "1"), dict.fromkeys(said, str(points))
                survey.add(where, each, "likert", said, **more, points=points, lowest=low, highest=high)
        case "Y":
            survey.add(where, name, "single", text, **more, options=yes_or_no(survey, where))
        case "N":
            survey.add(where, name, "integer", text, **more, **bounds(survey, where, ""))
        case "S" | "T" | "U":
            survey.add(where, name, "text", text, **more)
        case "X":
            survey.add(where, name, "page", text)
        case _:
            survey.leave(where, f"the type {kind!r} is not taken")
            return
    survey.show_if(question.shown)


def _options(texts: Mapping[str, dict[str, str]]) -> list[dict[str, Any]]:
    return [{"id": option_id(key), "text": words} for key, words in texts.items()]
