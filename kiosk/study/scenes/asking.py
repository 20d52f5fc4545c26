"""The scene of questionnaires: page by page, nothing chosen beforehand, no answer needed but what is required."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from random import Random

from kiosk.study import commands as do
from kiosk.study import events as happened
from kiosk.study.after.answers import meant
from kiosk.study.commands import Mood, Script
from kiosk.study.declared.questionnaire import Answer, Item, Order, Questionnaire, TextPage
from kiosk.study.declared.words import in_language
from kiosk.study.events import WorldEvent
from kiosk.study.scenes.scene import Scene


@dataclass(frozen=True)
class Sheet:
    """Items that are shown together; all of one questionnaire."""

    questionnaire: str
    items: tuple[Item, ...]


def sheets(questionnaire: Questionnaire, chance: Random) -> Iterator[Sheet]:
    """The pages of a questionnaire, in the order of this sitting."""
    together: list[Item] = []
    for item in _ordered(questionnaire, chance):
        if isinstance(item, TextPage) or len(together) == questionnaire.per_page:
            yield from _sheet(questionnaire, together)
            together = []
        if isinstance(item, TextPage):
            yield Sheet(questionnaire.id, (item,))
        else:
            together.append(item)
    yield from _sheet(questionnaire, together)


def _sheet(questionnaire: Questionnaire, items: list[Item]) -> Iterator[Sheet]:
    if items:
        yield Sheet(questionnaire.id, tuple(items))


def _ordered(questionnaire: Questionnaire, chance: Random) -> list[Item]:
    """The items in their order, or shuffled between the text pages, which keep their places."""
    if questionnaire.order is Order.FIXED:
        return list(questionnaire.items)
    shuffled = [item for item in questionnaire.items if not isinstance(item, TextPage)]
    chance.shuffle(shuffled)
    rest = iter(shuffled)
    return [item if isinstance(item, TextPage) else next(rest) for item in questionnaire.items]


class Asking(Scene):
    """One or more questionnaires, one after another."""

    mood = Mood.LISTENING

    def __init__(self, questionnaires: Sequence[Questionnaire], chance: Random, language: str) -> None:
        """Ask these in a language; ``chance`` shuffles what is to be shuffled."""
        self._language = language
        self._sheets = tuple(sheet for asked in questionnaires for sheet in sheets(asked, chance))
        self._number = 0
        self._answers: dict[str, Answer] = {}

    @property
    def characters(self) -> int:
        """How long the longest of the pages is."""
        return max((self._length(sheet) for sheet in self._sheets), default=0)

    def _length(self, sheet: Sheet) -> int:
        return sum(len(in_language(words, self._language)) for item in sheet.items for words in item.texts())

    def enter(self, script: Script) -> None:
        """Show the first page."""
        self._number = 0
        self._show(script)

    def accepts(self, event: WorldEvent) -> bool:
        """Whether an answer is one that an item of this page can have."""
        match event:
            case happened.AnswerGiven(item=name, value=value):
                item = next((item for item in self._sheet.items if item.id == name), None)
                return item is not None and not isinstance(item, TextPage) and (value is None or item.accepts(value))
        return True

    def react(self, event: WorldEvent, script: Script) -> None:
        """Keep an answer, or go on to the next page."""
        match event:
            case happened.AnswerGiven(item=item, value=value):
                self._keep(item, value)
                script.do(do.ShowAnswer(item, value))
            case happened.ContinueTapped():
                self._go_on(script)

    def _keep(self, item: str, value: Answer | None) -> None:
        if value is None:
            self._answers.pop(item, None)
        else:
            self._answers[item] = value

    def _go_on(self, script: Script) -> None:
        missing = tuple(item.id for item in self._sheet.items if self._lacks(item))
        if missing:
            script.do(do.ShowMissing(missing))
        elif self._number + 1 < len(self._sheets):
            self._number += 1
            self._show(script)
        else:
            script.note(happened.QuestionsFinished(at_ms=script.at_ms))

    def _lacks(self, item: Item) -> bool:
        return not isinstance(item, TextPage) and item.required and meant(self._answers.get(item.id)) is None

    def _show(self, script: Script) -> None:
        self._answers.clear()
        names = tuple(item.id for item in self._sheet.items)
        script.note(happened.ItemsShown(at_ms=script.at_ms, questionnaire=self._sheet.questionnaire, items=names))
        script.do(do.ShowItems(self._sheet.items, self._number + 1, len(self._sheets)))

    @property
    def _sheet(self) -> Sheet:
        return self._sheets[self._number]
