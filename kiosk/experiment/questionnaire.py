"""Questionnaires: their items, pages, answers and scales, and the texts in several languages."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterable, Iterator
from enum import Enum
from functools import reduce
from operator import or_
from typing import TYPE_CHECKING, Annotated, Any, Self

from pydantic import Field, TypeAdapter, ValidationError, ValidationInfo, field_validator, model_validator
from pydantic_core import InitErrorDetails, PydanticCustomError

from kiosk import UserInputError
from kiosk.config import ConfigModel
from kiosk.experiment.items import (
    BaseItem,
    Choice,
    Differential,
    Integer,
    Likert,
    Multiple,
    Name,
    Pictures,
    Question,
    Rating,
    ShortText,
    Single,
    Slider,
    Text,
    TextPage,
    Title,
    Visits,
    in_language,
    refuse_twice,
)
from kiosk.experiment.relevance import condition_faults, read_condition, simple_conditions
from kiosk.extensions import Extension, ExtensionGroup, find, installed


def load_item(extension: Extension) -> type[BaseItem]:
    """Import a kind of item; raises UserInputError if it is none, or lacks what every kind has."""
    model = extension.load()
    if not isinstance(model, type) or not issubclass(model, BaseItem):
        raise extension.broken(f"{extension.entry.value} is no class derived from kiosk.experiment.items.Question")
    kind = model.model_fields.get("kind")
    if kind is None or getattr(kind.annotation, "__args__", None) != (extension.name,):
        raise extension.broken(f"its class must have the field kind: Literal[{extension.name!r}]")
    if extension.is_built_in:
        return model
    if model.qml is None or not model.qml.is_file():
        raise extension.broken(f"its class must have qml, the path of a QML file; it is {str(model.qml)!r}")
    if model.simulate is BaseItem.simulate:
        raise extension.broken("its class lacks simulate, by which a simulated visitor answers it")
    return model


def _load_kinds() -> tuple[dict[str, type[BaseItem]], dict[str, str]]:
    """Import every kind of item by its name, and say of those that cannot be used why."""
    kinds: dict[str, type[BaseItem]] = {}
    broken: dict[str, str] = {}
    for extension in installed(ExtensionGroup.ITEMS):
        try:
            find(ExtensionGroup.ITEMS, extension.name)
            kinds[extension.name] = load_item(extension)
        except UserInputError as error:
            broken[extension.name] = str(error)
    return kinds, broken


ITEM_KINDS, BROKEN_KINDS = _load_kinds()
"""The model of every kind of item that can be used, and why the others cannot."""

KINDS = tuple(ITEM_KINDS)
"""Every kind of item."""

if TYPE_CHECKING:
    Item = Likert | Differential | Slider | Pictures | Single | Multiple | Integer | ShortText | TextPage
else:
    Item = Annotated[reduce(or_, ITEM_KINDS.values()), Field(discriminator="kind")]


class ItemOrder(Enum):
    """In which order the items come."""

    FIXED = "fixed"
    SHUFFLED = "shuffled"
    """Anew for every session; text pages keep their places."""


_SHUFFLED = "the items are shuffled, so what the condition asks about may come later; a condition needs a fixed order"


MOST_ITEMS = 600
"""Items of a questionnaire; the longest inventories have 567."""


TITLE = "the title"
"""What the title is called among the items; no item can have this name."""


class Questionnaire(ConfigModel):
    """Items in their order; ``version`` changes whenever one or the title does, and ``note`` says whose wording it is.

    In a file, a table that is named like a kind holds what all items of that kind have, unless they say otherwise.
    """

    file_kind = "questionnaire"

    id: Name
    version: Text
    note: Text
    title: Annotated[Title | None, Field(exclude_if=lambda title: title is None)] = None
    """What stands above its pages, such as the question that all items answer; None for the words of the language.

    None stays out of dumps, so that the hash of a questionnaire without a title is what it always was.
    """
    per_page: Annotated[int, Field(ge=1, le=8)] = 1
    order: Annotated[ItemOrder, Field(strict=False)] = ItemOrder.FIXED
    least_answered: Annotated[float, Field(ge=0, le=1)] = 0.5
    """The share of a scale's items that must be answered for the scale to have a mean; one is needed in any case."""
    visits: Annotated[Visits, Field(exclude_if=lambda visits: visits == "every")] = "every"
    """At which visits all of it is asked; an item can say for itself that it is asked at the first one only."""
    items: Annotated[tuple[Item, ...], Field(min_length=1, max_length=MOST_ITEMS, strict=False)]

    def at_visit(self, visit: int) -> Self | None:
        """Return what of it is asked at a visit, counted from 1; None if nothing is."""
        if visit == 1:
            return self
        items = tuple(item for item in self.items if "first" not in (self.visits, item.visits))
        if len(items) == len(self.items):
            return self
        return self.model_copy(update={"items": items}) if items else None

    @property
    def sha256(self) -> str:
        """The hash of all of it, wording included."""
        return hashlib.sha256(self.model_dump_json().encode()).hexdigest()

    @property
    def questions(self) -> tuple[Question, ...]:
        """The items that are answered."""
        return tuple(item for item in self.items if isinstance(item, Question))

    @property
    def scales(self) -> dict[str, tuple[Rating, ...]]:
        """The ratings of every scale, by its name, in the order in which they stand."""
        scales: dict[str, list[Rating]] = {}
        for item in self.items:
            if isinstance(item, Rating) and item.scale is not None:
                scales.setdefault(item.scale, []).append(item)
        return {name: tuple(items) for name, items in scales.items()}

    def needed(self, scale: str) -> int:
        """Return how many items of a scale must be answered for the scale to have a mean."""
        # A share such as .7 of 10 items is 7 items, though the product is a little more.
        return max(1, math.ceil(round(self.least_answered * len(self.scales[scale]), 9)))

    def unworded(self, language: str) -> tuple[str, ...]:
        """Return the items that lack a text in this language, after the title if that lacks one."""
        title = (TITLE,) if self.title is not None and language not in self.title else ()
        return (*title, *(item.id for item in self.items if any(language not in words for words in item.texts())))

    @model_validator(mode="before")
    @classmethod
    def _give_items_what_their_kind_has(cls, given: Any) -> Any:
        if not isinstance(given, dict) or not isinstance(given.get("items"), list):
            return given
        for item in given["items"]:
            if isinstance(item, dict) and (why := BROKEN_KINDS.get(str(item.get("kind")))):
                raise ValueError(why)
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

    @field_validator("items")
    @classmethod
    def _show_items_on_conditions_that_can_be(cls, items: tuple[Item, ...], info: ValidationInfo) -> tuple[Item, ...]:
        shuffled = info.data.get("order") is ItemOrder.SHUFFLED
        faults = (
            [(at, _SHUFFLED) for at, item in enumerate(items) if item.relevant]
            if shuffled
            else [*condition_faults(items), *_asked_later(items)]
        )
        if faults:
            raise ValidationError.from_exception_data(
                cls.__name__,
                [
                    InitErrorDetails(
                        type=PydanticCustomError("condition", "{what}", {"what": what}),
                        loc=(at, "relevant"),
                        input=items[at].relevant,
                    )
                    for at, what in faults
                ],
            )
        return items

    @model_validator(mode="after")
    def _sum_only_what_can_be_summed(self) -> Self:
        for item in self.items:
            if isinstance(item, Question) and item.scale is not None and not isinstance(item, Rating):
                raise ValueError(f"items: {item.id!r} is no rating, so it cannot belong to the scale {item.scale!r}")
        for scale, items in self.scales.items():
            if len({item.ends for item in items}) > 1:
                raise ValueError(f"items: those of the scale {scale!r} have different ends, so they cannot be summed")
        return self


def _asked_later(items: tuple[Item, ...]) -> Iterator[tuple[int, str]]:
    """Yield items of every visit whose condition depends on an item of the first visit, by their positions."""
    first = {item.id for item in items if item.visits == "first"}
    for at, item in enumerate(items):
        if item.visits == "first" or not item.relevant:
            continue
        try:
            asked = [part.item for part in simple_conditions(read_condition(item.relevant)) if part.item in first]
        except ValueError:
            # The condition itself is refused as one that cannot be read.
            continue
        if asked:
            yield at, f"the item {asked[0]!r} is asked at the first visit only, so this one must be as well"


QUESTIONNAIRES = TypeAdapter(tuple[Questionnaire, ...])
"""Reads and writes several of them together."""


def differences(one: Questionnaire, other: Questionnaire) -> list[str]:
    """Return where two contents of a questionnaire differ: the title, items and scales.

    Only languages that both have are compared.
    """
    both = [{item.id: item for item in each.items} for each in (one, other)]
    languages = set.intersection(*({code for item in each.items for code in item.text} for each in (one, other)))
    names = dict.fromkeys((*both[0], *both[1]))
    found = [TITLE] if titles_differ(one, other, languages) else []
    found += [name for name in names if _differs(both[0].get(name), both[1].get(name), languages)]
    scales = [
        {name: (each.needed(name), summed(items)) for name, items in each.scales.items()} for each in (one, other)
    ]
    found += [name for name in dict.fromkeys((*scales[0], *scales[1])) if scales[0].get(name) != scales[1].get(name)]
    return found


def titles_differ(one: Questionnaire, other: Questionnaire, languages: Iterable[str]) -> bool:
    """Whether visitors read another title, or one where there was none, in any of these languages."""
    if one.title is None or other.title is None:
        return one.title is not other.title
    both = one.title.keys() & other.title.keys()
    return any(one.title[code] != other.title[code] for code in languages if code in both)


def _differs(one: Item | None, other: Item | None, languages: Iterable[str]) -> bool:
    if one is None or other is None:
        return True
    return one.kind != other.kind or any(facts(one, code) != facts(other, code) for code in (*languages, ""))


def summed(items: Iterable[Rating]) -> tuple[object, ...]:
    """Return what a scale is the sum of."""
    return tuple((item.id, item.ends, item.reverse) for item in items)


def facts(item: Item, language: str) -> str:
    """Return what an item asks and what can be answered, in a language.

    In no language, it is what can be answered.
    """
    match item:
        case _ if isinstance(item, Choice):
            told = (
                option.id + (f" ({in_language(option.text, language)})" if language else "") for option in item.options
            )
            answer = f"{item.picks} {', '.join(told)}"
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
    if isinstance(item, Question) and item.not_applicable:
        answer += ", or that it does not apply"
    if item.relevant and language:
        answer += f", asked if {item.relevant}"
    return f'"{in_language(item.text, language).strip()}" {answer}' if language else answer
