"""Import questionnaires from survey programs: XLSForm, REDCap, LimeSurvey and Qualtrics.

What a questionnaire here can ask is taken; everything else is named line by line.
"""

from __future__ import annotations

import csv
import html
import io
import re
import xml.etree.ElementTree as ET
import zipfile
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from xml.parsers import expat

from pydantic import ValidationError

from kiosk import UserInputError
from kiosk.errors import validation_messages
from kiosk.experiment.questionnaire import ItemOrder, Questionnaire
from kiosk.experiment.relevance import read_condition
from kiosk.files import open_to_read, parse_json
from kiosk.language_codes import is_right, standard
from kiosk.study.csv_import import Heading, text_of_table

MOST_BYTES = 16 * 1024 * 1024
"""No questionnaire is larger, also when it is unpacked."""

_YES_NO = {"en": ("Yes", "No"), "it": ("Sì", "No"), "es": ("Sí", "No"), "de": ("Ja", "Nein"), "fr": ("Oui", "Non")}
_WIDEST = 999_999


@dataclass(frozen=True)
class _Shown:
    """When a file shows a question or a group."""

    where: str
    left: str
    """What to say if that cannot be here."""
    condition: str | None
    """In our words; None if it cannot be said in them."""


@dataclass
class Survey:
    """What was taken of a file, and a sentence for everything that was not."""

    name: str
    language: str
    items: list[dict[str, Any]] = field(default_factory=list)
    left: list[str] = field(default_factory=list)
    _since: int = 0
    conditions: dict[str, list[_Shown]] = field(default_factory=dict)
    """When the file shows an item, by its name: the conditions of its groups from the outermost, and its own."""

    def leave(self, where: str, what: str) -> None:
        """Note that something was not taken."""
        self.left.append(f"{where}: {what}")

    def words(self, where: str, text: str) -> dict[str, str]:
        """Return a text in the language of the file, without markup."""
        return {self.language: self.plain(where, text)}

    def plain(self, where: str, text: str) -> str:
        """Return a text without markup."""
        bare = html.unescape(re.sub(r"<[^>]*>", " ", re.sub(r"(?i)<br\s*/?>|</p>|</div>", "\n", text)))
        bare = "\n".join(" ".join(line.split()) for line in bare.splitlines() if line.strip())
        if re.search(r"<[a-zA-Z/]", text):
            self.leave(where, "its markup is not taken; the words are")
        if re.search(r"\$\{|\{[A-Za-z]|\[[a-z_]+\]", bare):
            self.leave(where, "something in its text is filled in by that program, and stands here as it is written")
        return bare

    def add(self, where: str, name: str, kind: str, text: Mapping[str, str], **more: Any) -> None:
        """Take an item; its name is changed if it cannot be one here."""
        ident = _ident(name)
        if ident != name:
            self.leave(where, f"the name {name!r} is {ident!r} here")
        if not any(text.values()):
            self.leave(where, f"{name!r} has no text, so it is not taken")
            return
        self.items.append({"id": ident, "kind": kind, "text": dict(text)} | more)

    def show_if(self, shown: Iterable[_Shown]) -> None:
        """Show what was added since the last ``begin`` only if all of these conditions hold."""
        said = []
        for each in shown:
            if each.condition is None or len(self.items) == self._since:
                self.leave(each.where, each.left)
            else:
                said.append(each)
        if said:
            self.conditions |= {item["id"]: said for item in self.items[self._since :]}

    def begin(self) -> None:
        """Begin a question of the file, which may be several items here."""
        self._since = len(self.items)

    def set_conditions(self, order: ItemOrder) -> None:
        """Give the items their conditions, but not those that cannot be here, as about what was not taken."""
        for item in self.items:
            kept = [each for each in self.conditions.get(item["id"], []) if self._can_be(item, [each], order)]
            if not self._can_be(item, kept, order):
                kept.pop()
            for each in self.conditions.get(item["id"], []):
                if each not in kept:
                    self.leave(each.where, each.left)
            if kept:
                item["relevant"] = _all_of(kept)

    def _can_be(self, item: dict[str, Any], shown: Sequence[_Shown], order: ItemOrder) -> bool:
        """Whether an item can be shown on these conditions."""
        if not shown:
            return True
        items = [*self.items[: self.items.index(item)], item | {"relevant": _all_of(shown)}]
        try:
            Questionnaire.model_validate({"id": "survey", "version": "1", "note": "-", "order": order, "items": items})
        except ValidationError as error:
            return not any(fault["loc"][::2] == ("items", "relevant") for fault in error.errors())
        return True


def _all_of(shown: Sequence[_Shown]) -> str:
    if len(shown) == 1:
        return str(shown[0].condition)
    return " and ".join(f"({each.condition})" for each in shown)


def _ident(name: str) -> str:
    plain = re.sub(r"[^A-Za-z0-9_-]+", "_", name.strip()).strip("_")
    return plain if re.match("[A-Za-z]", plain) else f"q_{plain}"


def _option(name: str) -> str:
    return name if re.fullmatch("0|[1-9][0-9]{0,3}", name) else _ident(name)


def is_survey(file: Path) -> bool:
    """Whether a file is one of a survey program, and not a table as docs/how-to/extend.md describes it."""
    if file.suffix.lower() in {".xlsx", ".qsf"}:
        return True
    if file.suffix.lower() not in {".csv", ".txt", ".tsv"} or not file.is_file():
        return False
    first = text_of_table(f"the table {file}", file).partition("\n")[0]
    return _is_redcap(first) or _is_limesurvey(first)


def _is_redcap(first: str) -> bool:
    return "Variable / Field Name" in first or first.startswith(("field_name,", '"field_name"'))


def _is_limesurvey(first: str) -> bool:
    return {"class", "type/scale", "name", "text"} <= set(first.replace('"', "").strip().split("\t"))


def read_survey(file: Path, heading: Heading, language: str = "en") -> tuple[Questionnaire, list[str]]:
    """Return the questionnaire of a survey program's file, and what of it was not taken.

    ``language`` is that of formats that do not name one. Raises UserInputError if the file is none, or nothing in it
    can be asked here.
    """
    if not is_right(language):
        raise UserInputError(f"{language!r} is no language code, such as 'de' or 'pt-BR'")
    survey = Survey(f"the file {file}", standard(language))
    if file.suffix.lower() == ".xlsx":
        _xlsform(survey, _workbook(survey.name, file))
    elif file.suffix.lower() == ".qsf":
        _qualtrics(survey, _json(survey.name, file))
    else:
        text = text_of_table(survey.name, file)
        first = text.partition("\n")[0]
        take = _redcap if _is_redcap(first) else _limesurvey
        dialect = "," if take is _redcap else "\t"
        take(survey, list(csv.DictReader(io.StringIO(text, newline=""), delimiter=dialect)))
    if not survey.items:
        raise UserInputError(f"{survey.name} has nothing that can be asked here", *survey.left)
    survey.set_conditions(heading.order)
    given = {**vars(heading), "items": survey.items}
    try:
        return Questionnaire.model_validate(given), list(dict.fromkeys(survey.left))
    except ValidationError as error:
        faults = validation_messages(error, given, Questionnaire)
        raise UserInputError(*(f"{survey.name}: {each}" for each in faults)) from error


def _json(name: str, file: Path) -> Any:
    try:
        if file.stat().st_size > MOST_BYTES:
            raise UserInputError(f"{name} is too large for a questionnaire")
        with open_to_read(file) as opened:
            return parse_json(opened.read().decode("utf-8-sig"))
    except OSError as error:
        raise UserInputError(f"{name} cannot be read: {error.strerror}") from error
    except ValueError as error:
        raise UserInputError(f"{name} is not a QSF file: it is not JSON") from error


# Conditions

_VALUE = r"""(?:'[^']*'|"[^"]*"|-?\d+)"""
_Rule = tuple[str, str]
_SHARED: tuple[_Rule, ...] = ((r"(?i)\b(and|or|not)\b", "{0}"), (r"[()]", "{0}"), (r"\s+", " "))
_SIGN = r"\s*(!=|<>|<=|>=|==?|<|>|\beq\b|\bne\b|\blt\b|\ble\b|\bgt\b|\bge\b)\s*"
_SIGNS = {"<>": "!=", "==": "=", "eq": "=", "ne": "!=", "lt": "<", "le": "<=", "gt": ">", "ge": ">="}
_XLSFORM_CONDITION: tuple[_Rule, ...] = (
    (rf"selected\(\s*\$\{{([\w.-]+)\}}\s*,\s*({_VALUE})\s*\)", "selected({1}, {2})"),
    (r"\$\{([\w.-]+)\}\s*!=\s*(?:''|\"\")", "answered({1})"),
    (r"\$\{([\w.-]+)\}\s*=\s*(?:''|\"\")", "not answered({1})"),
    (rf"\$\{{([\w.-]+)\}}{_SIGN}({_VALUE})", "{1} {2} {3}"),
    *_SHARED,
)
_REDCAP_CONDITION: tuple[_Rule, ...] = (
    (r"\[(\w+)\((\w+)\)\]\s*=\s*['\"]?1['\"]?", "selected({1}, '{2}')"),
    (r"\[(\w+)\((\w+)\)\]\s*(?:=\s*['\"]?0['\"]?|(?:<>|!=)\s*['\"]?1['\"]?)", "not selected({1}, '{2}')"),
    (r"\[(\w+)\]\s*(?:<>|!=)\s*(?:''|\"\")", "answered({1})"),
    (r"\[(\w+)\]\s*=\s*(?:''|\"\")", "not answered({1})"),
    (rf"\[(\w+)\]{_SIGN}({_VALUE})", "{1} {2} {3}"),
    *_SHARED,
)
_LIME_CONDITION: tuple[_Rule, ...] = (
    (r"!\s*is_empty\(\s*(\w+?)(?:\.(?:NAOK|value))?\s*\)", "answered({1})"),
    (r"is_empty\(\s*(\w+?)(?:\.(?:NAOK|value))?\s*\)", "not answered({1})"),
    (rf"\b(?!and\b|or\b|not\b)([A-Za-z]\w*)(?:\.(?:NAOK|value))?{_SIGN}({_VALUE})", "{1} {2} {3}"),
    (r"&&", " and "),
    (r"\|\|", " or "),
    (r"!(?!=)", "not "),
    *_SHARED,
)


def _condition(text: str, rules: Sequence[_Rule]) -> str | None:
    """Return the condition of another program in our words; None if something in it cannot be said."""
    said, place = "", 0
    while place < len(text):
        for pattern, here in rules:
            found = re.compile(pattern).match(text, place)
            if found:
                said += here.format(found[0].lower(), *map(_in_our_words, found.groups()))
                place = found.end()
                break
        else:
            return None
    return _readable(" ".join(said.split()))


def _in_our_words(part: str) -> str:
    if part.lower() in _SIGNS:
        return _SIGNS[part.lower()]
    # Numbers stand in quotes in some programs, also where they are compared as numbers.
    bare = re.fullmatch(r"""(['"])(-?\d{1,9})\1""", part)
    if bare:
        return bare[2]
    return _ident(part) if re.fullmatch(r"[A-Za-z][\w.-]*", part) else part


def _readable(condition: str) -> str | None:
    try:
        read_condition(condition)
    except ValueError:
        return None
    return condition


# XLSForm

Rows = list[dict[str, str]]
_SHEET = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"
_RELATION = "{http://schemas.openxmlformats.org/officeDocument/2006/relationships}id"


def _workbook(name: str, file: Path) -> dict[str, Rows]:
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


def _xlsform(survey: Survey, sheets: Mapping[str, Rows]) -> None:
    if "survey" not in sheets:
        raise UserInputError(f"{survey.name} is not an XLSForm: it has no sheet 'survey'")
    choices: dict[str, list[dict[str, Any]]] = {}
    for row in sheets.get("choices", []):
        words = _labels(survey, f"choices, row {row['#']}", row)
        if words and row.get("name"):
            choices.setdefault(row.get("list_name", row.get("list name", "")), []).append(
                {"id": _option(row["name"]), "text": words}
            )
    _xlsform_survey(survey, sheets["survey"], choices)


def _xlsform_survey(survey: Survey, rows: Rows, choices: Mapping[str, list[dict[str, Any]]]) -> None:
    groups: list[_Shown | None] = []
    """Those that a row stands in, from the outermost, each with its condition if it has one."""
    for row in rows:
        where = f"survey, row {row['#']}"
        verb, _, what = row.get("type", "").strip().lower().replace("_", " ").partition(" ")
        if what in {"group", "repeat"} and verb in {"begin", "end"}:
            survey.leave(where, f"{row['type']} is not taken; what is in it stands one after another")
            if verb == "begin":
                groups.append(_xlsform_condition(where, row, "what is in it is always asked"))
            elif groups:
                groups.pop()
        elif verb:
            survey.begin()
            _xlsform_row(survey, where, row, choices)
            survey.show_if(filter(None, (*groups, _xlsform_condition(where, row, "it is always asked"))))


def _xlsform_condition(where: str, row: Mapping[str, str], otherwise: str) -> _Shown | None:
    """Return the condition of a row; None if it has none."""
    relevant = row.get("relevant")
    if not relevant:
        return None
    told = f"its condition ({relevant}) is not taken: {otherwise}"
    return _Shown(where, told, _condition(relevant, _XLSFORM_CONDITION))


_NOT_TAKEN = {
    "hint": "its hint is not taken",
    "default": "its default is not taken: nothing is chosen beforehand",
    "choice_filter": "its choice filter is not taken",
    "appearance": "its appearance ({}) is not taken",
}


def _xlsform_row(  # noqa: C901 - a case for each type of that program
    survey: Survey, where: str, row: Mapping[str, str], choices: Mapping[str, list[dict[str, Any]]]
) -> None:
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
            survey.add(where, name, "integer", texts, **more, **_bounds(survey, where, row.get("constraint", "")))
        case "text":
            survey.add(where, name, "text", texts, **more)
        case "note":
            survey.add(where, name, "page", texts)
        case "range":
            ends = dict(re.findall(r"(start|end)\s*=\s*(-?\d+)", row.get("parameters", "")))
            low, high = int(ends.get("start", 0)), int(ends.get("end", 10))
            words = [{code: str(end) for code in texts} for end in (low, high)]
            survey.add(where, name, "slider", texts, **more, lowest=low, highest=high, left=words[0], right=words[1])
        case _:
            survey.leave(where, f"the type {row['type']!r} is not taken")
            return
    for column, what in _NOT_TAKEN.items():
        if row.get(column):
            survey.leave(where, what.format(row[column]))


def _bounds(survey: Survey, where: str, constraint: str) -> dict[str, int]:
    found = {"lowest": 0, "highest": _WIDEST}
    told = set()
    for sign, number in re.findall(r"\.\s*(>=|<=|>|<)\s*(-?\d+)", constraint):
        end = "lowest" if sign.startswith(">") else "highest"
        found[end] = int(number) + {">": 1, "<": -1}.get(sign, 0)
        told.add(end)
    for end in sorted(found.keys() - told):
        survey.leave(where, f"it has no {end} number, so {found[end]} is taken")
    return found


# REDCap

_REDCAP = {
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


def _redcap(survey: Survey, rows: Rows) -> None:  # noqa: C901 - a case for each type of that program
    for number, raw in enumerate(rows, 2):
        row = {key: next((raw[each] or "" for each in names if raw.get(each)), "") for key, names in _REDCAP.items()}
        where = f"row {number}, {row['name']}"
        survey.begin()
        text = survey.words(where, row["label"])
        more: dict[str, Any] = {"required": True} if row["required"].lower() == "y" else {}
        kind = row["type"].lower()
        match kind:
            case "radio" | "dropdown" | "checkbox":
                more["options"] = _redcap_options(survey, where, row["choices"])
                survey.add(where, row["name"], "multiple" if kind == "checkbox" else "single", text, **more)
            case "yesno" | "truefalse":
                survey.add(where, row["name"], "single", text, **more, options=_yes_or_no(survey, where))
            case "text" if row["validation"] in {"integer", "number"}:
                ends = {key: int(row[key]) for key in ("lowest", "highest") if re.fullmatch(r"-?\d{1,9}", row[key])}
                limits = " and ".join(f". {'>=' if key == 'lowest' else '<='} {end}" for key, end in ends.items())
                survey.add(where, row["name"], "integer", text, **more, **_bounds(survey, where, limits))
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
            survey.show_if([_Shown(where, told, _condition(row["branching"], _REDCAP_CONDITION))])


def _redcap_options(survey: Survey, where: str, choices: str) -> list[dict[str, Any]]:
    pairs = [each.partition(",") for each in choices.split("|") if each.strip()]
    return [{"id": _option(code.strip()), "text": survey.words(where, text.strip() or code)} for code, _, text in pairs]


def _yes_or_no(survey: Survey, where: str) -> list[dict[str, Any]]:
    if survey.language not in _YES_NO:
        survey.leave(where, "its answers are in English; translate them")
    yes, no = _YES_NO.get(survey.language, _YES_NO["en"])
    return [{"id": "1", "text": {survey.language: yes}}, {"id": "0", "text": {survey.language: no}}]


# LimeSurvey


@dataclass
class _Lime:
    """A question with what stands below it, in every language."""

    where: str
    kind: str
    shown: tuple[_Shown, ...]
    required: bool
    text: dict[str, str] = field(default_factory=dict)
    parts: dict[str, dict[str, str]] = field(default_factory=dict)
    answers: dict[str, dict[str, str]] = field(default_factory=dict)


def _limesurvey(survey: Survey, rows: Rows) -> None:
    questions: dict[str, _Lime] = {}
    now: _Lime | None = None
    group: tuple[_Shown, ...] = ()
    for number, row in enumerate(rows, 2):
        where, name = f"row {number}, {row.get('name', '')}", row.get("name") or ""
        code = row.get("language") or survey.language
        code = standard(code) if is_right(code) else survey.language
        text = survey.plain(where, row.get("text") or "")
        match row.get("class"):
            case "Q":
                kind, asked = row.get("type/scale") or "", (row.get("mandatory") or "").upper() == "Y"
                shown = (*group, *_lime_relevance(where, row, "it is always asked"))
                now = questions.setdefault(name, _Lime(where, kind, shown, asked))
                now.text[code] = text
            case "SQ" if now:
                now.parts.setdefault(name, {})[code] = text
            case "A" if now:
                now.answers.setdefault(name, {})[code] = text
            case "G":
                now, group = None, _lime_relevance(where, row, "what is in the group is always asked")
    for name, question in questions.items():
        _lime_question(survey, name, question)


def _lime_relevance(where: str, row: Mapping[str, str], otherwise: str) -> tuple[_Shown, ...]:
    """Return the condition of a row, if it has one."""
    relevance = row.get("relevance") or "1"
    if relevance == "1":
        return ()
    told = f"its relevance ({relevance}) is not taken: {otherwise}"
    return (_Shown(where, told, _condition(relevance, _LIME_CONDITION)),)


_LIME_POINTS = {"5": 5, "A": 5, "B": 10}


def _lime_question(survey: Survey, name: str, question: _Lime) -> None:  # noqa: C901 - a case for each type of that program
    survey.begin()
    more: dict[str, Any] = {"required": True} if question.required else {}
    where, kind, text = question.where, question.kind, question.text
    answers = [{"id": _option(key), "text": words} for key, words in question.answers.items()]
    parts = [{"id": _option(key), "text": words} for key, words in question.parts.items()]
    asked = [(f"{name}_{key}", words) for key, words in question.parts.items()] or [(name, text)]
    match kind:
        case "L" | "!" | "O" if answers:
            survey.add(where, name, "single", text, **more, options=answers)
        case "M" | "P" if parts:
            survey.add(where, name, "multiple", text, **more, options=parts)
        case "F" | "H" if answers:
            for each, words in asked:
                survey.add(where, each, "single", _joined(text, words), **more, options=answers)
        case "5" | "A" | "B":
            for each, words in asked:
                ends = (dict.fromkeys(words, end) for end in ("1", str(_LIME_POINTS[kind])))
                low, high = ends
                said = words if words is text else _joined(text, words)
                survey.add(where, each, "likert", said, **more, points=_LIME_POINTS[kind], lowest=low, highest=high)
        case "Y":
            survey.add(where, name, "single", text, **more, options=_yes_or_no(survey, where))
        case "N":
            survey.add(where, name, "integer", text, **more, **_bounds(survey, where, ""))
        case "S" | "T" | "U":
            survey.add(where, name, "text", text, **more)
        case "X":
            survey.add(where, name, "page", text)
        case _:
            survey.leave(where, f"the type {kind!r} is not taken")
            return
    survey.show_if(question.shown)


def _joined(text: Mapping[str, str], words: Mapping[str, str]) -> dict[str, str]:
    return {code: "\n".join(filter(None, (text.get(code, ""), each))) for code, each in words.items()}


# Qualtrics


def _qualtrics(survey: Survey, document: Any) -> None:
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
                _qualtrics_question(survey, f"the question {name}", name, payload, names)
            except (KeyError, TypeError, ValueError, AttributeError) as error:
                raise UserInputError(f"{survey.name}: the question {name} is not as Qualtrics writes it") from error


def _qualtrics_question(  # noqa: C901 - a case for each type of that program
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
    choices = _qualtrics_options(survey, where, payload.get("Choices"), payload.get("ChoiceOrder"))
    selector = str(payload.get("Selector", ""))
    match payload.get("QuestionType"):
        case "MC" if choices:
            several = selector.startswith("M")
            survey.add(where, name, "multiple" if several else "single", text, **more, options=choices)
        case "Matrix" if choices and selector == "Likert":
            answers = _qualtrics_options(survey, where, payload.get("Answers"), payload.get("AnswerOrder"))
            for row in choices:
                said = _joined(text, row["text"])
                survey.add(where, f"{name}_{row['id']}", "single", said, **more, options=answers)
        case "TE" if validation.get("ContentType") == "ValidNumber":
            survey.add(where, name, "integer", text, **more, **_bounds(survey, where, ""))
        case "TE":
            survey.add(where, name, "text", text, **more)
        case "DB":
            survey.add(where, name, "page", text)
        case "Slider" if choices:
            for row in choices:
                left, right = survey.words(where, "0"), survey.words(where, "100")
                said = _joined(text, row["text"])
                survey.add(where, f"{name}_{row['id']}", "slider", said, **more, left=left, right=right)
        case kind:
            survey.leave(where, f"the question type {kind!r} {selector} is not taken".replace("  ", " "))
            return
    if payload.get("DisplayLogic"):
        told = "its display logic is not taken: it is always asked"
        survey.show_if([_Shown(where, told, _display_logic(payload["DisplayLogic"], names))])


def _qualtrics_options(survey: Survey, where: str, choices: Any, order: Any) -> list[dict[str, Any]]:
    if not isinstance(choices, Mapping):
        return []
    keys = [str(key) for key in order] if isinstance(order, list) and order else list(choices)
    return [{"id": _option(key), "text": survey.words(where, str(choices[key]["Display"]))} for key in keys]


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
    return _readable(said)


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
    chosen = f"selected({_ident(name)}, '{_option(place[2])}')"
    return {"Selected": chosen, "NotSelected": f"not {chosen}"}.get(str(part.get("Operator")))
