"""The kinds of questionnaire items: what each asks, its answers, how it is shown and scored."""

from __future__ import annotations

import re
from abc import abstractmethod
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from enum import Enum
from pathlib import Path
from random import Random
from typing import Annotated, Any, ClassVar, Final, Literal, Self

from pydantic import AfterValidator, BeforeValidator, Field, Strict, field_validator, model_validator

from kiosk.config import MOST_IN_TEXT, ConfigModel
from kiosk.experiment.typed_input import NumberInput, can_be_kept
from kiosk.language_codes import standard
from kiosk.lazy_dataclass import dataclass

Text = Annotated[str, Field(min_length=1, max_length=MOST_IN_TEXT)]


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

Title = Annotated[
    dict[str, Annotated[str, Field(min_length=1, max_length=120)]], Field(min_length=1), BeforeValidator(_by_language)
]
"""A heading in several languages; a longer one would leave no room for what stands below it."""


def in_language(words: Mapping[str, str], language: str) -> str:
    """Return the text in this language, or in the first one there is."""
    return words.get(language) or next(iter(words.values()))


Answer = int | str | tuple[str, ...]
"""A point on a scale or a number; an option's id or a text; the ids of several options."""


class NotApplicable(Enum):
    """The response that an item does not apply, which is neither an answer to it nor a missing one."""

    NOT_APPLICABLE = "not_applicable"


NOT_APPLICABLE: Final = NotApplicable.NOT_APPLICABLE

Response = Answer | NotApplicable
"""What a visitor can say to an item."""


def _name(name: str) -> str:
    if not re.fullmatch("[A-Za-z][A-Za-z0-9_-]*", name):
        raise ValueError(f"{name!r} is no name; a name begins with a letter and has letters, digits, _ and - only")
    return name


MOST_IN_NAME = 64
"""What SPSS takes, and short enough for two of them in the name of a file."""

Name = Annotated[str, Field(max_length=MOST_IN_NAME), AfterValidator(_name)]
"""Names go into records, columns and messages."""


def _option_name(name: str) -> str:
    # Survey programs number their options: "1=female".
    return name if re.fullmatch("0|[1-9][0-9]{0,3}", name) else _name(name)


OptionName = Annotated[str, Field(max_length=MOST_IN_NAME), AfterValidator(_option_name)]
"""A name, or a whole number up to 9999 without zeros before it."""

Points = Annotated[int, Field(ge=2, le=11)]
Bound = Annotated[int, Field(ge=-999_999_999, le=999_999_999)]
"""One end of what can be answered; the interface counts in 32 bits."""


@dataclass(frozen=True)
class Tap:
    """A tap on what QML calls by this object name.

    ``across`` is from 0 at its left to 1 at its right.
    """

    name: str
    across: float = 0.5


@dataclass(frozen=True)
class Typing:
    """A text that is typed on a real keyboard."""

    text: str


Act = Tap | Typing
"""One thing that a simulated visitor does to answer."""


@dataclass(frozen=True)
class AnswerFormat:
    """What an answer looks like in tables: one option or several, a whole number between two ends, or a text."""

    options: tuple[Option, ...] = ()
    several: bool = False
    ends: tuple[int, int] | None = None


Visits = Literal["every", "first"]
"""At which visits of a participant who comes back something is asked."""


class BaseItem(ConfigModel):
    """What all items have: a name within the questionnaire, and a text.

    A kind of item is a class derived from ``Question``, with a field ``kind`` that has its name as the only value. The
    fields are the keys in a questionnaire, and the columns of a table that is brought in.
    """

    qml: ClassVar[Path | None] = None
    """The QML file that draws how it is answered; None for what comes with Recollect."""

    id: Name
    text: Words
    relevant: Annotated[str, Field(max_length=2_000, exclude_if=lambda condition: not condition)] = ""
    """The condition to show it, as kiosk.experiment.relevance reads it; empty if it is always shown.

    An empty one stays out of dumps, so that the hash of a questionnaire without conditions is what it always was.
    """
    visits: Annotated[Visits, Field(exclude_if=lambda visits: visits == "every")] = "every"
    """Whether it is asked at every visit of a participant who comes back, or at the first one only."""

    def view(self, language: str) -> dict[str, Any]:  # noqa: ARG002 - for the kinds that have words
        """Return what QML draws besides the text, as JSON values in a language."""
        return {}

    def simulate(self, chance: Random, *, last: bool) -> Iterator[Act]:  # noqa: ARG002 - for the kinds that are answered
        """How a simulated visitor answers; ``last``: nothing follows on the page."""
        yield from ()

    @property
    def answer_format(self) -> AnswerFormat:
        """What an answer looks like in tables."""
        return AnswerFormat()

    def score(self, answer: Answer) -> int | None:  # noqa: ARG002 - for the kinds that are scored
        """Return the number that an answer counts as; None if it is not counted."""
        return None

    def texts(self) -> Iterator[Mapping[str, str]]:
        """Everything of it that is worded."""
        yield self.text

    @abstractmethod
    def accepts(self, answer: Answer) -> bool:
        """Whether this can be an answer to it."""


class Question(BaseItem):
    """An item that is answered; ``scale`` names what it belongs to, if it is summed with others."""

    required: Annotated[bool, Strict()] | Literal["once"] = False
    """Whether the visitor has to answer; an item that is asked for ``"once"`` is pointed out, and may then be left."""
    not_applicable: bool = False
    """Whether the visitor can say that the item does not apply. It is a response, so a required item has one."""
    scale: Name | None = None

    def takes(self, response: Response) -> bool:
        """Whether a visitor can say this to the item."""
        return self.not_applicable if isinstance(response, NotApplicable) else self.accepts(response)


class Rating(Question):
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

    @property
    def answer_format(self) -> AnswerFormat:
        """A whole number."""
        return AnswerFormat(ends=self.ends)

    def score(self, answer: Answer) -> int | None:
        """Return the answer as it counts: turned round if the item is reversed."""
        return self.scored(answer) if isinstance(answer, int) else None

    def scored(self, answer: int) -> int:
        """Return the answer as it counts: turned round if the item is reversed."""
        return sum(self.ends) - answer if self.reverse else answer


class _Pointed(Rating):
    """A rating from 1 to ``points``."""

    points: Points = 5

    @property
    def ends(self) -> tuple[int, int]:
        """1 and the number of points."""
        return 1, self.points

    def simulate(self, chance: Random, *, last: bool) -> Iterator[Act]:  # noqa: ARG002 - it needs no keyboard
        """Tap one of the points."""
        yield Tap(f"answer-{self.id}-{chance.randint(*self.ends)}")


class Likert(_Pointed):
    """Points between two worded ends."""

    kind: Literal["likert"]
    lowest: Words
    highest: Words

    def texts(self) -> Iterator[Mapping[str, str]]:
        """Yield the question and the ends."""
        yield from (self.text, self.lowest, self.highest)

    def view(self, language: str) -> dict[str, Any]:
        """Return the ends and the points."""
        return _ends(self.lowest, self.highest, language) | {"points": self.points, "pictures": []}


class Differential(_Pointed):
    """A semantic differential: points between two opposite words."""

    kind: Literal["differential"]
    left: Words
    right: Words

    def texts(self) -> Iterator[Mapping[str, str]]:
        """Yield the question and the opposites."""
        yield from (self.text, self.left, self.right)

    def view(self, language: str) -> dict[str, Any]:
        """Return the ends and the points."""
        return _ends(self.left, self.right, language) | {"points": self.points, "pictures": []}


class Pictures(_Pointed):
    """Points shown as pictures: 1.svg and so on, in a folder of assets/scales or beside the study file."""

    kind: Literal["pictures"]
    pictures: str = "faces"
    lowest: Words
    highest: Words

    def texts(self) -> Iterator[Mapping[str, str]]:
        """Yield the question and, for those who do not see the pictures, the ends."""
        yield from (self.text, self.lowest, self.highest)

    def view(self, language: str) -> dict[str, Any]:
        """Return the ends and the points; where the pictures lie is known to the interface."""
        return _ends(self.lowest, self.highest, language) | {"points": self.points}


class Slider(Rating):
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
        """Yield the question and the ends."""
        yield from (self.text, self.left, self.right)

    def view(self, language: str) -> dict[str, Any]:
        """Return the ends, in words and in numbers."""
        return _ends(self.left, self.right, language) | {"lowest": self.lowest, "highest": self.highest}

    def simulate(self, chance: Random, *, last: bool) -> Iterator[Act]:  # noqa: ARG002 - it needs no keyboard
        """Tap somewhere on the line."""
        yield Tap(f"slider-{self.id}", chance.uniform(0.05, 0.95))

    @model_validator(mode="after")
    def _have_a_length(self) -> Self:
        if self.lowest >= self.highest:
            raise ValueError(f"its lowest {self.lowest} must be below its highest {self.highest}")
        return self


class Integer(Question):
    """A whole number, typed or stepped to."""

    kind: Literal["integer"]
    lowest: Bound = 0
    highest: Bound = 120

    @property
    def input(self) -> NumberInput:
        """How its number is typed and stepped to."""
        return NumberInput(self.lowest, self.highest)

    @property
    def answer_format(self) -> AnswerFormat:
        """A whole number."""
        return AnswerFormat(ends=(self.lowest, self.highest))

    def view(self, language: str) -> dict[str, Any]:  # noqa: ARG002 - digits are the same
        """Return what can be typed; the range in words is known to the interface."""
        return {"minus": self.input.has_minus, "widest": self.input.longest, "pattern": self.input.pattern}

    def simulate(self, chance: Random, *, last: bool) -> Iterator[Act]:  # noqa: ARG002 - "Done" is always tapped
        """Type it with the keys on the screen; one in three then steps up and down."""
        steps = chance.random() < 1 / 3
        yield Tap(f"number-{self.id}")
        yield from _keys(str(self.lowest if steps else chance.randint(self.lowest, self.highest)))
        yield Tap("key-done")
        if steps:
            yield from (Tap(f"more-{self.id}"), Tap(f"less-{self.id}"))

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

    id: OptionName
    text: Words


class Choice(Question):
    """A question answered by one or several of its options."""

    picks: ClassVar[str]
    """How options make an answer, in words before their names."""

    options: Annotated[tuple[Option, ...], Field(min_length=2, max_length=12, strict=False)]

    def texts(self) -> Iterator[Mapping[str, str]]:
        """Yield the question and its options."""
        yield self.text
        yield from (option.text for option in self.options)

    @property
    def ids(self) -> tuple[str, ...]:
        """The names of the options."""
        return tuple(option.id for option in self.options)

    def view(self, language: str) -> dict[str, Any]:
        """Return the options."""
        return {"options": [{"id": each.id, "text": in_language(each.text, language)} for each in self.options]}

    @field_validator("options")
    @classmethod
    def _name_every_option_once(cls, options: tuple[Option, ...]) -> tuple[Option, ...]:
        refuse_twice("option", (option.id for option in options))
        return options


class Single(Choice):
    """One of several options."""

    picks: ClassVar[str] = "one of"
    kind: Literal["single"]

    @property
    def answer_format(self) -> AnswerFormat:
        """One option."""
        return AnswerFormat(self.options)

    def simulate(self, chance: Random, *, last: bool) -> Iterator[Act]:  # noqa: ARG002 - it needs no keyboard
        """Tap an option."""
        yield from _options(self, chance, 1)

    def accepts(self, answer: Answer) -> bool:
        """Whether it is one of the options."""
        return isinstance(answer, str) and answer in self.ids


class Multiple(Choice):
    """Any number of several options."""

    picks: ClassVar[str] = "any of"
    kind: Literal["multiple"]

    @property
    def answer_format(self) -> AnswerFormat:
        """Any number of options."""
        return AnswerFormat(self.options, several=True)

    def simulate(self, chance: Random, *, last: bool) -> Iterator[Act]:  # noqa: ARG002 - it needs no keyboard
        """Tap some of the options."""
        yield from _options(self, chance, len(self.ids))

    def accepts(self, answer: Answer) -> bool:
        """Whether all of it are options, none twice."""
        return isinstance(answer, tuple) and set(answer) <= set(self.ids) and len(set(answer)) == len(answer)


class ShortText(Question):
    """A few words, typed."""

    kind: Literal["text"]
    longest: Annotated[int, Field(ge=1, le=500)] = 120

    def view(self, language: str) -> dict[str, Any]:  # noqa: ARG002 - letters are counted in any language
        """How much can be typed."""
        return {"longest": self.longest}

    def simulate(self, chance: Random, *, last: bool) -> Iterator[Act]:
        """Type with a real keyboard, or with the keys on the screen.

        At the end of a page, "Done" is not tapped.
        """
        words = chance.choice(WORDS)[: self.longest]
        yield Tap(f"text-{self.id}")
        if chance.random() < 1 / 2:
            yield Typing(words)
        else:
            yield from _keys(words.lower())
        if not last:
            yield Tap("key-done")

    def accepts(self, answer: Answer) -> bool:
        """Whether it is a text that is not too long and has no control characters, such as a line break."""
        return isinstance(answer, str) and len(answer) <= self.longest and can_be_kept(answer)


class TextPage(BaseItem):
    """A text to read; nothing is answered, and it stands alone."""

    kind: Literal["page"]

    def accepts(self, answer: Answer) -> bool:  # noqa: ARG002 - whatever it is
        """Nothing can be."""
        return False


WORDS = ("perché no", "qué curioso", "Ça va", "it was fun", "23 pairs, or so", "mañana")
"""What simulated visitors type."""


def _ends(left: Mapping[str, str], right: Mapping[str, str], language: str) -> dict[str, Any]:
    """Return the words at the two ends of a rating."""
    return {"left": in_language(left, language), "right": in_language(right, language)}


def _options(item: Choice, chance: Random, most: int) -> Iterator[Act]:
    """Taps on one to ``most`` options."""
    yield from (Tap(f"option-{item.id}-{each}") for each in chance.sample(item.ids, chance.randint(1, most)))


def _keys(text: str) -> Iterator[Act]:
    """Taps on the keys that are on the screen."""
    yield from (Tap("key-space" if letter == " " else f"key-{letter}") for letter in text)


def refuse_twice(what: str, names: Iterable[str]) -> None:
    """Raise ValueError if one of the names is there more than once."""
    twice = [name for name, count in Counter(names).items() if count > 1]
    if twice:
        raise ValueError(f"the {what} {twice[0]!r} stands twice")
