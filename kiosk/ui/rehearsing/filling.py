"""How a simulated visitor fills in a page of a form: click by click, item after item."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from random import Random

from kiosk.study.declared.questionnaire import (
    Differential,
    Integer,
    Item,
    Likert,
    Multiple,
    Pictures,
    ShortText,
    Single,
    Slider,
)
from kiosk.ui.rehearsing.hand import Hand

Errand = Callable[[], None]
"""One thing that is done at one moment."""

WORDS = ("perché no", "qué bien", "Ça va", "it was fun", "23 pairs, or so", "mañana")


class Filling:
    """Fills in the items of one page; what is chosen is chance's."""

    def __init__(self, hand: Hand, chance: Random, *, hasty: bool) -> None:
        """Do it with this hand; the hasty click everything twice."""
        self._type = hand.type
        self._click = hand.double_click if hasty else hand.click
        self._chance = chance

    def errands(self, items: tuple[Item, ...]) -> Iterator[Errand]:
        """What is to be done for these items, in their order."""
        for number, item in enumerate(items):
            yield from self._item(item, last=number == len(items) - 1)

    def _item(self, item: Item, *, last: bool) -> Iterator[Errand]:
        match item:
            case Likert() | Differential() | Pictures():
                yield partial(self._click, f"answer-{item.id}-{self._chance.randint(*item.ends)}")
            case Slider():
                yield partial(self._click, f"slider-{item.id}", self._chance.uniform(0.05, 0.95))
            case Single() | Multiple():
                most = len(item.ids) if isinstance(item, Multiple) else 1
                for option in self._chance.sample(item.ids, self._chance.randint(1, most)):
                    yield partial(self._click, f"option-{item.id}-{option}")
            case Integer():
                yield from self._number(item)
            case ShortText():
                yield from self._text(item, last=last)

    def _number(self, item: Integer) -> Iterator[Errand]:
        """With the keys on the screen, or by a step up and a step down."""
        if self._chance.random() < 1 / 3:
            yield partial(self._click, f"more-{item.id}")
            yield partial(self._click, f"more-{item.id}")
            yield partial(self._click, f"less-{item.id}")
            return
        yield partial(self._click, f"number-{item.id}")
        yield from self._keys(str(self._chance.randint(item.lowest, item.highest)))
        yield partial(self._click, "key-done")

    def _text(self, item: ShortText, *, last: bool) -> Iterator[Errand]:
        """With a real keyboard, or with the keys on the screen; at the end of a page, nobody taps "Done"."""
        words = self._chance.choice(WORDS)[: item.longest]
        yield partial(self._click, f"text-{item.id}")
        if self._chance.random() < 1 / 2:
            yield partial(self._type, words)
        else:
            yield from self._keys(words.lower())
        if not last:
            yield partial(self._click, "key-done")

    def _keys(self, text: str) -> Iterator[Errand]:
        for letter in text:
            yield partial(self._click, "key-space" if letter == " " else f"key-{letter}")
