"""What is taken of a survey program's file, with the conditions under which items are shown."""

from __future__ import annotations

import html
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from pydantic import ValidationError

from kiosk.experiment.questionnaire import ItemOrder, Questionnaire
from kiosk.experiment.relevance import read_condition

MOST_BYTES = 16 * 1024 * 1024
"""No questionnaire is larger, also when it is unpacked."""

_YES_NO = {"en": ("Yes", "No"), "it": ("Sì", "No"), "es": ("Sí", "No"), "de": ("Ja", "Nein"), "fr": ("Oui", "Non")}
_WIDEST = 999_999

Rows = list[dict[str, str]]
"""A table: each row with its cells by the words in the first row."""


@dataclass(frozen=True)
class Shown:
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
    conditions: dict[str, list[Shown]] = field(default_factory=dict)
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
        ident = item_id(name)
        if ident != name:
            self.leave(where, f"the name {name!r} is {ident!r} here")
        if not any(text.values()):
            self.leave(where, f"{name!r} has no text, so it is not taken")
            return
        self.items.append({"id": ident, "kind": kind, "text": dict(text)} | more)

    def show_if(self, shown: Iterable[Shown]) -> None:
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

    def _can_be(self, item: dict[str, Any], shown: Sequence[Shown], order: ItemOrder) -> bool:
        """Whether an item can be shown on these conditions."""
        if not shown:
            return True
        items = [*self.items[: self.items.index(item)], item | {"relevant": _all_of(shown)}]
        try:
            Questionnaire.model_validate({"id": "survey", "version": "1", "note": "-", "order": order, "items": items})
        except ValidationError as error:
            return not any(fault["loc"][::2] == ("items", "relevant") for fault in error.errors())
        return True


def _all_of(shown: Sequence[Shown]) -> str:
    if len(shown) == 1:
        return str(shown[0].condition)
    return " and ".join(f"({each.condition})" for each in shown)


def item_id(name: str) -> str:
    """Return the nearest name that an item can have here."""
    plain = re.sub(r"[^A-Za-z0-9_-]+", "_", name.strip()).strip("_")
    return plain if re.match("[A-Za-z]", plain) else f"q_{plain}"


def option_id(name: str) -> str:
    """Return the nearest name that an option can have here, which may be a number."""
    return name if re.fullmatch("0|[1-9][0-9]{0,3}", name) else item_id(name)


def bounds(survey: Survey, where: str, constraint: str) -> dict[str, int]:
    """Return the ends of a number, as a constraint such as ``. >= 18`` gives them."""
    found = {"lowest": 0, "highest": _WIDEST}
    told = set()
    for sign, number in re.findall(r"\.\s*(>=|<=|>|<)\s*(-?\d+)", constraint):
        end = "lowest" if sign.startswith(">") else "highest"
        found[end] = int(number) + {">": 1, "<": -1}.get(sign, 0)
        told.add(end)
    for end in sorted(found.keys() - told):
        survey.leave(where, f"it has no {end} number, so {found[end]} is taken")
    return found


def yes_or_no(survey: Survey, where: str) -> list[dict[str, Any]]:
    """Return the options Yes (1) and No (0) in the language of the file."""
    if survey.language not in _YES_NO:
        survey.leave(where, "its answers are in English; translate them")
    yes, no = _YES_NO.get(survey.language, _YES_NO["en"])
    return [{"id": "1", "text": {survey.language: yes}}, {"id": "0", "text": {survey.language: no}}]


def joined(text: Mapping[str, str], words: Mapping[str, str]) -> dict[str, str]:
    """Return the text of a question with that of one of its parts below it."""
    return {code: "\n".join(filter(None, (text.get(code, ""), each))) for code, each in words.items()}


# Conditions

VALUE = r"""(?:'[^']*'|"[^"]*"|-?\d+)"""
"""A text in quotes or a number."""

Rule = tuple[str, str]
"""What a piece of a condition looks like, and how it is written here: ``{0}`` is all of it, ``{1}`` its first group."""

SHARED_RULES: tuple[Rule, ...] = ((r"(?i)\b(and|or|not)\b", "{0}"), (r"[()]", "{0}"), (r"\s+", " "))
"""What is the same in every program."""

SIGN = r"\s*(!=|<>|<=|>=|==?|<|>|\beq\b|\bne\b|\blt\b|\ble\b|\bgt\b|\bge\b)\s*"
"""What compares."""

_SIGNS = {"<>": "!=", "==": "=", "eq": "=", "ne": "!=", "lt": "<", "le": "<=", "gt": ">", "ge": ">="}


def in_our_words(text: str, rules: Sequence[Rule]) -> str | None:
    """Return the condition of another program in our words; None if something in it cannot be said."""
    said, place = "", 0
    while place < len(text):
        for pattern, here in rules:
            found = re.compile(pattern).match(text, place)
            if found:
                said += here.format(found[0].lower(), *map(_part_in_our_words, found.groups()))
                place = found.end()
                break
        else:
            return None
    return readable(" ".join(said.split()))


def _part_in_our_words(part: str) -> str:
    if part.lower() in _SIGNS:
        return _SIGNS[part.lower()]
    # Numbers stand in quotes in some programs, also where they are compared as numbers.
    bare = re.fullmatch(r"""(['"])(-?\d{1,9})\1""", part)
    if bare:
        return bare[2]
    return item_id(part) if re.fullmatch(r"[A-Za-z][\w.-]*", part) else part


def readable(condition: str) -> str | None:
    """Return a condition as it is; None if it cannot be read."""
    try:
        read_condition(condition)
    except ValueError:
        return None
    return condition
