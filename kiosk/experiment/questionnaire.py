"""Questionnaires: their items, pages, answers and scales, and the texts in several languages."""

from __future__ import annotations

import hashlib
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from enum import Enum
from typing import Annotated, Any, Literal, Self
from unicodedata import category

from pydantic import AfterValidator, BeforeValidator, Field, TypeAdapter, field_validator, model_validator

from kiosk.config import ConfigModel
from kiosk.language_codes import standard

Text = Annotated[str, Field(min_length=1)]


def _by_language(given: object) -> object:
    if isinstance(given, str):
        raise ValueError(f"{given!r} stands in no language; write {{ en = {given!r} }}")
    if not isinstance(given, Mapping) or not all(isinstance(code, str) for code in given):
        return given
    spelt = {code: standard(code) for code in given}
    if len(set(spelt.values())) < len(spelt):
        raise ValueError(f"one language stands twice in {', '.join(spelt)}")
    return {spelt[code]: text for code, text in given.items()}


Words = Annotated[dict[str, Text], Field(min_length=1), BeforeValidator(_by_language)]
"""One text in several languages, by their codes."""


def in_language(words: Mapping[str, str], language: str) -> str:
    """The text in this language, or in the first one there is."""
    return words.get(language) or next(iter(words.values()))


_REFUSED = frozenset({"Cc", "Cs"})
"""Control characters, and halves of characters, which no file can hold. Everything else is kept as it was typed."""

_MINUS_SIGNS = "-\N{MINUS SIGN}\N{FULLWIDTH HYPHEN-MINUS}\N{SMALL HYPHEN-MINUS}"
"""What keyboards and input methods send for a minus sign."""


def can_be_kept(text: str) -> bool:
    """Tell whether a text can be stored as it was typed: it holds no control character."""
    return not any(category(character) in _REFUSED for character in text)


@dataclass(frozen=True)
class NumberInput:
    """A field for whole numbers from ``lowest`` to ``highest``, with digits of any script."""

    lowest: int
    highest: int

    @property
    def has_minus(self) -> bool:
        """Whether a negative number can be entered."""
        return self.lowest < 0

    @property
    def longest(self) -> str:
        """The longest number that is allowed, as a text."""
        return max(str(self.lowest), str(self.highest), key=len)

    @property
    def digits(self) -> int:
        """How many digits the longest number has."""
        return max(len(str(abs(end))) for end in (self.lowest, self.highest))

    @property
    def pattern(self) -> str:
        """A regular expression for everything that may stand in the field while a number is typed."""
        sign = f"[{_MINUS_SIGNS}]?" if self.has_minus else ""
        return rf"^{sign}\p{{Nd}}{{0,{self.digits}}}$"

    def read(self, text: str) -> int | None:
        """Read the number that stands in the field; return None if it is none, or has too many digits."""
        digits = text[1:] if self.has_minus and text[:1] in tuple(_MINUS_SIGNS) else text
        # Python reads no number of thousands of digits.
        if not digits.isdecimal() or len(digits) > self.digits:
            return None
        return int(digits) if digits == text else -int(digits)

    def step(self, text: str, by: int) -> int:
        """Return the next number up or down; from no number, up begins at the lowest and down at the highest."""
        now = self.read(text)
        if now is None:
            return self.lowest if by > 0 else self.highest
        return max(self.lowest, min(self.highest, now + by))

    def negate(self, text: str) -> str:
        """Put a minus sign before what stands in the field, or take it away."""
        return text[1:] if text[:1] in tuple(_MINUS_SIGNS) else f"-{text}"


Answer = int | str | tuple[str, ...]
"""A point on a scale or a number; an option's id or a text; the ids of several options."""


def _name(name: str) -> str:
    if not re.fullmatch("[A-Za-z][A-Za-z0-9_-]*", name):
        raise ValueError(f"{name!r} is no name; a name begins with a letter and has letters, digits, _ and - only")
    return name


Name = Annotated[str, AfterValidator(_name)]
"""Names go into records, columns and messages."""

Points = Annotated[int, Field(ge=2, le=11)]
Bound = Annotated[int, Field(ge=-999_999_999, le=999_999_999)]
"""One end of what can be answered; the interface counts in 32 bits."""


class _Item(ConfigModel):
    """What all items have: a name within the questionnaire, and a text."""

    id: Name
    text: Words

    def texts(self) -> Iterator[Mapping[str, str]]:
        """Everything of it that is worded."""
        yield self.text

    def accepts(self, answer: Answer) -> bool:
        """Whether this can be an answer to it."""
        raise NotImplementedError


class _Question(_Item):
    """An item that is answered; ``scale`` names what it belongs to, if it is summed with others."""

    required: bool = False
    scale: Name | None = None


class _Rating(_Question):
    """A question answered by a whole number between two ends; ``reverse`` turns it round before it is summed."""

    reverse: bool = False

    @property
    def ends(self) -> tuple[int, int]:
        """The lowest and the highest answer."""
        raise NotImplementedError

    def accepts(self, answer: Answer) -> bool:
        """Whether it is a number between the ends."""
        lowest, highest = self.ends
        return isinstance(answer, int) and not isinstance(answer, bool) and lowest <= answer <= highest

    def scored(self, answer: int) -> int:
        """The answer as it counts: turned round if the item is reversed."""
        return sum(self.ends) - answer if self.reverse else answer


class _Pointed(_Rating):
    """A rating from 1 to ``points``."""

    points: Points = 5

    @property
    def ends(self) -> tuple[int, int]:
        """1 and the number of points."""
        return 1, self.points


class Likert(_Pointed):
    """Points between two worded ends."""

    kind: Literal["likert"]
    lowest: Words
    highest: Words

    def texts(self) -> Iterator[Mapping[str, str]]:
        """The question and the ends."""
        yield from (self.text, self.lowest, self.highest)


class Differential(_Pointed):
    """A semantic differential: points between two opposite words."""

    kind: Literal["differential"]
    left: Words
    right: Words

    def texts(self) -> Iterator[Mapping[str, str]]:
        """The question and the opposites."""
        yield from (self.text, self.left, self.right)


class Pictures(_Pointed):
    """Points shown as pictures: 1.svg and so on, in a folder of assets/scales or beside the study file."""

    kind: Literal["pictures"]
    pictures: str = "faces"
    lowest: Words
    highest: Words

    def texts(self) -> Iterator[Mapping[str, str]]:
        """The question and, for those who do not see the pictures, the ends."""
        yield from (self.text, self.lowest, self.highest)


class Slider(_Rating):
    """A line between two words on which nothing is chosen beforehand."""

    kind: Literal["slider"]
    lowest: Bound = 0
    highest: Bound = 100
    left: Words
    right: Words

    @property
    def ends(self) -> tuple[int, int]:
        """As declared."""
        return self.lowest, self.highest

    def texts(self) -> Iterator[Mapping[str, str]]:
        """The question and the ends."""
        yield from (self.text, self.left, self.right)

    @model_validator(mode="after")
    def _have_a_length(self) -> Self:
        if self.lowest >= self.highest:
            raise ValueError(f"its lowest {self.lowest} must be below its highest {self.highest}")
        return self


class Integer(_Question):
    """A whole number, typed or stepped to."""

    kind: Literal["integer"]
    lowest: Bound = 0
    highest: Bound = 120

    @property
    def input(self) -> NumberInput:
        """How its number is typed and stepped to."""
        return NumberInput(self.lowest, self.highest)

    def accepts(self, answer: Answer) -> bool:
        """Whether it is a number between lowest and highest."""
        return isinstance(answer, int) and not isinstance(answer, bool) and self.lowest <= answer <= self.highest

    @model_validator(mode="after")
    def _have_a_length(self) -> Self:
        if self.lowest >= self.highest:
            raise ValueError(f"its lowest {self.lowest} must be below its highest {self.highest}")
        return self


class Option(ConfigModel):
    """One of the answers to choose from."""

    id: Name
    text: Words


class _Choice(_Question):
    options: Annotated[tuple[Option, ...], Field(min_length=2, max_length=12, strict=False)]

    def texts(self) -> Iterator[Mapping[str, str]]:
        """The question and its options."""
        yield self.text
        yield from (option.text for option in self.options)

    @property
    def ids(self) -> tuple[str, ...]:
        """The names of the options."""
        return tuple(option.id for option in self.options)

    @field_validator("options")
    @classmethod
    def _name_every_option_once(cls, options: tuple[Option, ...]) -> tuple[Option, ...]:
        refuse_twice("option", (option.id for option in options))
        return options


class Single(_Choice):
    """One of several options."""

    kind: Literal["single"]

    def accepts(self, answer: Answer) -> bool:
        """Whether it is one of the options."""
        return isinstance(answer, str) and answer in self.ids


class Multiple(_Choice):
    """Any number of several options."""

    kind: Literal["multiple"]

    def accepts(self, answer: Answer) -> bool:
        """Whether all of it are options, none twice."""
        return isinstance(answer, tuple) and set(answer) <= set(self.ids) and len(set(answer)) == len(answer)


class ShortText(_Question):
    """A few words, typed."""

    kind: Literal["text"]
    longest: Annotated[int, Field(ge=1, le=500)] = 120

    def accepts(self, answer: Answer) -> bool:
        """Whether it is a text that is not too long and has no control characters, such as a line break."""
        return isinstance(answer, str) and len(answer) <= self.longest and can_be_kept(answer)


class TextPage(_Item):
    """A text to read; nothing is answered, and it stands alone."""

    kind: Literal["page"]

    def accepts(self, answer: Answer) -> bool:  # noqa: ARG002 - whatever it is
        """Nothing can be."""
        return False


Item = Annotated[
    Likert | Differential | Slider | Pictures | Single | Multiple | Integer | ShortText | TextPage,
    Field(discriminator="kind"),
]
Rating = Likert | Differential | Slider | Pictures
Choice = Single | Multiple
KINDS = ("likert", "differential", "slider", "pictures", "single", "multiple", "integer", "text", "page")
"""Every kind of item."""


class ItemOrder(Enum):
    """In which order the items come."""

    FIXED = "fixed"
    SHUFFLED = "shuffled"
    """Anew for every session; text pages keep their places."""


class Questionnaire(ConfigModel):
    """Items in their order; ``version`` changes whenever one does, and ``note`` says where the wording is from.

    In a file, a table that is named like a kind holds what all items of that kind have, unless they say otherwise.
    """

    file_kind = "questionnaire"

    id: Name
    version: Text
    note: Text
    per_page: Annotated[int, Field(ge=1, le=8)] = 1
    order: Annotated[ItemOrder, Field(strict=False)] = ItemOrder.FIXED
    items: Annotated[tuple[Item, ...], Field(min_length=1, strict=False)]

    @property
    def sha256(self) -> str:
        """The hash of all of it, wording included."""
        return hashlib.sha256(self.model_dump_json().encode()).hexdigest()

    @property
    def questions(self) -> tuple[_Question, ...]:
        """The items that are answered."""
        return tuple(item for item in self.items if isinstance(item, _Question))

    @property
    def scales(self) -> dict[str, tuple[Rating, ...]]:
        """The ratings of every scale, by its name, in the order in which they stand."""
        scales: dict[str, list[Rating]] = {}
        for item in self.items:
            if isinstance(item, Rating) and item.scale is not None:
                scales.setdefault(item.scale, []).append(item)
        return {name: tuple(items) for name, items in scales.items()}

    def unworded(self, language: str) -> tuple[str, ...]:
        """The items that lack a text in this language."""
        return tuple(item.id for item in self.items if any(language not in words for words in item.texts()))

    @model_validator(mode="before")
    @classmethod
    def _give_items_what_their_kind_has(cls, given: Any) -> Any:
        if not isinstance(given, dict) or not isinstance(given.get("items"), list):
            return given
        shared = {kind: given[kind] for kind in KINDS if isinstance(given.get(kind), dict)}
        items = [
            shared.get(str(item.get("kind")), {}) | item if isinstance(item, dict) else item for item in given["items"]
        ]
        return {key: value for key, value in given.items() if key not in shared} | {"items": items}

    @field_validator("items")
    @classmethod
    def _name_every_item_once(cls, items: tuple[Item, ...]) -> tuple[Item, ...]:
        refuse_twice("item", (item.id for item in items))
        return items

    @model_validator(mode="after")
    def _sum_only_what_can_be_summed(self) -> Self:
        for item in self.items:
            if isinstance(item, _Question) and item.scale is not None and not isinstance(item, Rating):
                raise ValueError(f"items: {item.id!r} is no rating, so it cannot belong to the scale {item.scale!r}")
        for scale, items in self.scales.items():
            if len({item.ends for item in items}) > 1:
                raise ValueError(f"items: those of the scale {scale!r} have different ends, so they cannot be summed")
        return self


QUESTIONNAIRES = TypeAdapter(tuple[Questionnaire, ...])
"""Reads and writes several of them together."""


def refuse_twice(what: str, names: Iterable[str]) -> None:
    """Raise ValueError if one of the names is there more than once."""
    twice = [name for name, count in Counter(names).items() if count > 1]
    if twice:
        raise ValueError(f"the {what} {twice[0]!r} stands twice")


def differences(one: Questionnaire, other: Questionnaire) -> list[str]:
    """The items and scales in which two contents of a questionnaire differ, in the languages that both have."""
    both = [{item.id: item for item in each.items} for each in (one, other)]
    languages = set.intersection(*({code for item in each.items for code in item.text} for each in (one, other)))
    names = dict.fromkeys((*both[0], *both[1]))
    found = [name for name in names if _differs(both[0].get(name), both[1].get(name), languages)]
    scales = [{name: summed(items) for name, items in each.scales.items()} for each in (one, other)]
    found += [name for name in dict.fromkeys((*scales[0], *scales[1])) if scales[0].get(name) != scales[1].get(name)]
    return found


def _differs(one: Item | None, other: Item | None, languages: Iterable[str]) -> bool:
    if one is None or other is None:
        return True
    return one.kind != other.kind or any(facts(one, code) != facts(other, code) for code in (*languages, ""))


def summed(items: Iterable[Rating]) -> tuple[object, ...]:
    """What a scale is the sum of."""
    return tuple((item.id, item.ends, item.reverse) for item in items)


def facts(item: Item, language: str) -> str:
    """What an item asks and what can be answered, in a language; in none of them, what can be answered."""
    match item:
        case Single() | Multiple():
            kind = "one of" if isinstance(item, Single) else "any of"
            told = (
                option.id + (f" ({in_language(option.text, language)})" if language else "") for option in item.options
            )
            answer = f"{kind} {', '.join(told)}"
        case Integer():
            answer = f"a whole number from {item.lowest} to {item.highest}"
        case _ if isinstance(item, Rating):
            least, most = item.ends
            answer = f"{least} to {most}" + (", turned round" if item.reverse else "")
            _, *ends = (f'"{in_language(words, language)}"' for words in item.texts())
            answer += f", from {' to '.join(ends)}" if language else ""
        case TextPage():
            answer = "a page to read"
        case _:
            answer = "a text"
    return f'"{in_language(item.text, language).strip()}" {answer}' if language else answer
