"""Conditions to show an item: read them, check them, and tell which items they hide.

A condition compares earlier items of the same questionnaire with values::

    plays = 'daily' and (age >= 18 or not selected(games, 'memory'))

``answered(item)`` is true once an item has an answer. An item without an answer equals nothing and is above and below
nothing, so only ``!=`` and ``not`` are true of it. An item that is hidden, or does not apply, has no answer.
"""

from __future__ import annotations

import operator
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import combinations
from typing import Final

from kiosk.experiment.items import Answer, BaseItem, NotApplicable, Question, Response, ShortText
from kiosk.lazy_dataclass import dataclass

_OPERATORS: Final[Mapping[str, Callable[[int, int], bool]]] = {
    "=": operator.eq,
    "!=": operator.ne,
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
}
_WORDS = ("and", "or", "not")
_TOKEN = re.compile(
    r"\s*(?:(?P<text>'[^']*'|\"[^\"]*\")|(?P<number>-?\d{1,9}(?![\w.]))|(?P<name>[A-Za-z][\w-]*)|(?P<sign>!=|<=|>=|[=<>(),]))",
    re.ASCII,
)
_DEEPEST = 50
"""How deep parentheses may stand in one another."""
_MOST_TRIALS = 50_000
"""How many combinations of answers are tried to find one that shows an item; with more, it is taken to be shown."""


@dataclass(frozen=True)
class Compared:
    """An item's answer is equal to a value, unequal, above or below."""

    item: str
    sign: str
    value: int | str


@dataclass(frozen=True)
class Selected:
    """An option is among the answers to an item."""

    item: str
    option: str


@dataclass(frozen=True)
class Answered:
    """An item has an answer."""

    item: str


@dataclass(frozen=True)
class Not:
    """A condition does not hold."""

    of: Condition


@dataclass(frozen=True)
class Both:
    """Two conditions hold."""

    one: Condition
    other: Condition


@dataclass(frozen=True)
class Either:
    """One of two conditions holds, or both do."""

    one: Condition
    other: Condition


Condition = Compared | Selected | Answered | Not | Both | Either


@lru_cache(maxsize=1024)
def read_condition(text: str) -> Condition:
    """Read a condition; raises ValueError with what is wrong."""
    reader = _Reader(text)
    condition = reader.either()
    reader.end()
    return condition


class _Reader:
    """Reads one condition from its left to its right."""

    def __init__(self, text: str) -> None:
        self._tokens: list[tuple[str, str]] = []
        self._next = 0
        self._depth = 0
        place = 0
        while text[place:].strip():
            found = _TOKEN.match(text, place)
            if found is None:
                raise ValueError(f"{text[place:].strip()[:20]!r} is not understood in it")
            self._tokens.append((str(found.lastgroup), found[0].strip()))
            place = found.end()

    def either(self) -> Condition:
        condition = self._both()
        while self._take("or"):
            condition = Either(condition, self._both())
        return condition

    def end(self) -> None:
        if self._next < len(self._tokens):
            raise ValueError(f"after the condition stands {self._tokens[self._next][1]!r}; join conditions by and, or")

    def _both(self) -> Condition:
        condition = self._one()
        while self._take("and"):
            condition = Both(condition, self._one())
        return condition

    def _one(self) -> Condition:
        self._depth += 1
        if self._depth > _DEEPEST:
            raise ValueError("its parentheses stand too deep in one another")
        try:
            if self._take("not"):
                return Not(self._one())
            if self._take("("):
                inner = self.either()
                self._need(")")
                return inner
            return self._simple()
        finally:
            self._depth -= 1

    def _simple(self) -> Condition:
        name = self._of_kind("name", "the name of an item")
        if name in _WORDS:
            raise ValueError(f"the name of an item must stand where {name!r} stands")
        if name in {"selected", "answered"} and self._take("("):
            item = self._of_kind("name", "the name of an item")
            if name == "answered":
                self._need(")")
                return Answered(item)
            self._need(",")
            option = str(self._value())
            self._need(")")
            return Selected(item, option)
        sign = self._of_kind("sign", f"=, !=, <, <=, > or >= after {name}")
        if sign not in _OPERATORS:
            raise ValueError(f"after {name} must stand =, !=, <, <=, > or >=, but there stands {sign!r}")
        return Compared(name, sign, self._value())

    def _value(self) -> int | str:
        kind, token = self._peek()
        if kind not in {"text", "number"}:
            raise ValueError(f"a number or a word in quotes must stand where {token or 'it ends'!r} stands")
        self._next += 1
        return int(token) if kind == "number" else token[1:-1]

    def _peek(self) -> tuple[str, str]:
        return self._tokens[self._next] if self._next < len(self._tokens) else ("end", "")

    def _of_kind(self, kind: str, what: str) -> str:
        found, token = self._peek()
        if found != kind:
            raise ValueError(f"it lacks {what}" + (f", where {token!r} stands" if token else " at its end"))
        self._next += 1
        return token

    def _take(self, token: str) -> bool:
        found = self._peek()
        taken = found[0] in {"name", "sign"} and found[1] == token
        self._next += taken
        return taken

    def _need(self, token: str) -> None:
        if not self._take(token):
            raise ValueError(f"it lacks {token!r}" + (f" before {self._peek()[1]!r}" if self._peek()[1] else ""))


def simple_conditions(condition: Condition) -> Iterator[Compared | Selected | Answered]:
    """Yield every simple condition within one, from left to right."""
    match condition:
        case Not(of):
            yield from simple_conditions(of)
        case Both(one, other) | Either(one, other):
            yield from simple_conditions(one)
            yield from simple_conditions(other)
        case _:
            yield condition


def holds(condition: Condition, given: Mapping[str, Response]) -> bool:
    """Tell whether a condition holds for the answers of the items that are shown."""
    match condition:
        case Not(of):
            return not holds(of, given)
        case Both(one, other):
            return holds(one, given) and holds(other, given)
        case Either(one, other):
            return holds(one, given) or holds(other, given)
        case _:
            return _is_true(condition, _effective(given.get(condition.item)))


def _is_true(condition: Compared | Selected | Answered, answer: Answer | None) -> bool:
    match condition:
        case Answered():
            return answer is not None
        case Selected(option=option):
            return answer == option or (isinstance(answer, tuple) and option in answer)
        case Compared(sign=sign, value=value):
            if isinstance(answer, int) and isinstance(value, int):
                return _OPERATORS[sign](answer, value)
            # Options may be called by numbers, so a number is compared with them as a word.
            return (sign == "=" and answer == str(value)) or (sign == "!=" and answer != str(value))


def _effective(response: Response | None) -> Answer | None:
    # As everywhere, an empty text and none of the options are no answer.
    return None if isinstance(response, NotApplicable) or response in {"", ()} else response


def hidden_items(items: Sequence[BaseItem], given: Mapping[str, Response]) -> tuple[str, ...]:
    """Return the items whose condition does not hold, in their order; a hidden item counts as not answered."""
    hidden: list[str] = []
    counted: dict[str, Response] = {}
    for item in items:
        if item.relevant and not holds(read_condition(item.relevant), counted):
            hidden.append(item.id)
        elif item.id in given:
            counted[item.id] = given[item.id]
    return tuple(hidden)


def condition_faults(items: Sequence[BaseItem]) -> Iterator[tuple[int, str]]:
    """Yield what is wrong with conditions, each with the position of its item from 0."""
    conditions: dict[str, Condition] = {}
    for at, item in enumerate(items):
        if not item.relevant:
            continue
        try:
            condition = read_condition(item.relevant)
        except ValueError as error:
            yield at, f"the condition {item.relevant!r} cannot be read: {error}"
            continue
        wrong = [each for part in simple_conditions(condition) if (each := _fault(part, at, items))]
        yield from ((at, each) for each in dict.fromkeys(wrong))
        if wrong:
            continue
        conditions[item.id] = condition
        if not _can_hold(condition, items[:at], conditions):
            yield at, f"no answers make {item.relevant!r} true, so the item would never be shown"


def _fault(part: Compared | Selected | Answered, at: int, items: Sequence[BaseItem]) -> str | None:
    """Return what is wrong with a simple condition of the item at a position."""
    place, asked = next(((place, item) for place, item in enumerate(items) if item.id == part.item), (at, None))
    if asked is None:
        return f"there is no item {part.item!r} in this questionnaire"
    if place >= at:
        return f"the item {part.item!r} does not come before this one"
    if not isinstance(asked, Question):
        return f"the item {part.item!r} is a page to read and has no answer"
    if isinstance(part, Selected):
        has_options = bool(asked.answer_format.options)
        return _unknown_option(asked, part.option) if has_options else f"the item {part.item!r} has no options"
    return _wrong_comparison(part, asked) if isinstance(part, Compared) else None


def _unknown_option(asked: Question, option: str) -> str | None:
    known = [each.id for each in asked.answer_format.options]
    return None if option in known else f"the item {asked.id!r} has no option {option!r}, but {', '.join(known)}"


def _wrong_comparison(part: Compared, asked: Question) -> str | None:
    """Return why an item's answer cannot be compared with a value, if it cannot."""
    form, value = asked.answer_format, str(part.value)
    if form.ends is not None:
        return None if isinstance(part.value, int) else f"the answer to {asked.id!r} is a number, not {value!r}"
    what: str | None = None
    if form.several:
        what = f"the item {asked.id!r} has several answers; write selected({asked.id}, {value!r})"
    elif part.sign not in {"=", "!="}:
        what = f"the answer to {asked.id!r} is no number, so it is compared by = or != only"
    elif form.options:
        what = _unknown_option(asked, value)
    elif not isinstance(asked, ShortText):
        what = f"an answer to {asked.id!r} cannot be compared; write answered({asked.id})"
    elif not value or not asked.accepts(value):
        what = f"the answer to {asked.id!r} cannot be {value!r}; answered({asked.id}) says whether there is one"
    return what


def _can_hold(condition: Condition, items: Sequence[BaseItem], conditions: Mapping[str, Condition]) -> bool:
    """Whether some answers that can be given together make a condition true."""
    parts = list(simple_conditions(condition))
    needed: dict[str, None] = {}
    open_ = [part.item for part in parts]
    while open_:
        name = open_.pop()
        if name not in needed:
            needed[name] = None
            more = list(simple_conditions(conditions[name])) if name in conditions else []
            parts += more
            open_ += [part.item for part in more]
    asked = [item for item in items if item.id in needed and isinstance(item, Question)]
    values = [_samples(item, [part for part in parts if part.item == item.id]) for item in asked]
    trials = 0

    def search(number: int, given: dict[str, Response]) -> bool:
        nonlocal trials
        trials += 1
        if trials > _MOST_TRIALS:
            return True
        if number == len(asked):
            return holds(condition, given)
        item = asked[number]
        own = conditions.get(item.id)
        if own is not None and not holds(own, given):
            return search(number + 1, given)
        left = item.required is not True or item.not_applicable
        return (left and search(number + 1, given)) or any(
            search(number + 1, given | {item.id: value}) for value in values[number]
        )

    return search(0, {})


def _samples(item: Question, parts: Sequence[Compared | Selected | Answered]) -> list[Answer]:
    """Return answers to an item that make each condition on it true once and false once, in each mixture."""
    form = item.answer_format
    if form.several:
        named = [option.id for option in form.options]
        told = [name for name in named if any(isinstance(part, Selected) and part.option == name for part in parts)]
        other = [name for name in named if name not in told][:1]
        subsets = (set(each) for size in range(len(told + other) + 1) for each in combinations(told + other, size))
        picked = [tuple(name for name in named if name in each) for each in subsets if each]
        return list(picked)
    if form.options:
        return [option.id for option in form.options]
    compared = [part.value for part in parts if isinstance(part, Compared)]
    if form.ends is not None:
        lowest, highest = form.ends
        near = {value + step for value in compared if isinstance(value, int) for step in (-1, 0, 1)}
        return sorted(number for number in near | {lowest, highest} if lowest <= number <= highest)
    texts = dict.fromkeys((*map(str, compared), "a", "b", "c"))
    return [text for text in texts if item.accepts(text)] or ["a"]
