"""The stage of a questionnaire: its pages, what was answered on them, and what is hidden."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby
from random import Random

from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.effects import Mood, OutcomeBuilder
from kiosk.experiment.events import WorldEvent
from kiosk.experiment.item_responses import effective_answer
from kiosk.experiment.items import Likert, Question, Response, TextPage, in_language
from kiosk.experiment.page_stages import StageHandler
from kiosk.experiment.questionnaire import Item, ItemOrder, Questionnaire
from kiosk.experiment.relevance import hidden_items
from kiosk.experiment.session_config import Translation
from kiosk.lazy_dataclass import dataclass


@dataclass(frozen=True)
class ItemPage:
    """Items that are shown together; all of one questionnaire."""

    questionnaire: str
    items: tuple[Item, ...]
    title: Mapping[str, str] | None = None


def item_pages(questionnaire: Questionnaire, chance: Random) -> Iterator[ItemPage]:
    """Yield the pages of a questionnaire, in the order of this session.

    A text page stands alone. Items between two of them are shared out evenly: 10 items, at most 4 on a page, make pages
    of 4, 3 and 3.
    """
    ordered = _ordered(questionnaire, chance)
    for alone, together in groupby(ordered, key=lambda item: isinstance(item, TextPage)):
        for items in _shared_out(tuple(together), 1 if alone else questionnaire.per_page):
            yield ItemPage(questionnaire.id, items, questionnaire.title)


def _shared_out(items: tuple[Item, ...], most: int) -> Iterator[tuple[Item, ...]]:
    """Yield the items in as few groups as hold them.

    The first groups have one item more where not all can be alike.
    """
    groups = -(-len(items) // most)
    least, larger = divmod(len(items), groups)
    begin = 0
    for number in range(groups):
        end = begin + least + (number < larger)
        yield items[begin:end]
        begin = end


def pages_alike(pages: Sequence[tuple[Item, ...]], page: tuple[Item, ...]) -> tuple[tuple[Item, ...], ...]:
    """Return the pages that ask on the same scale as this one.

    There are none if the page has one item only, or items that share no scale.
    """
    scale = _scale(page)
    return tuple(other for other in pages if _scale(other) == scale) if scale is not None else ()


def _scale(page: tuple[Item, ...]) -> tuple[object, ...] | None:
    """Return the one scale of a page of several ratings."""
    ratings = [item for item in page if isinstance(item, Likert)]
    scales = [(item.points, item.lowest, item.highest) for item in ratings]
    if not len(scales) == len(page) > 1 or any(scale != scales[0] for scale in scales):
        return None
    return (*scales[0], any(item.not_applicable for item in ratings))


def _ordered(questionnaire: Questionnaire, chance: Random) -> list[Item]:
    """Return the items in their order, or shuffled between the text pages, which keep their places."""
    if questionnaire.order is ItemOrder.FIXED:
        return list(questionnaire.items)
    shuffled = [item for item in questionnaire.items if not isinstance(item, TextPage)]
    chance.shuffle(shuffled)
    rest = iter(shuffled)
    return [item if isinstance(item, TextPage) else next(rest) for item in questionnaire.items]


class QuestionnaireStage(StageHandler):
    """One or more questionnaires, one after another."""

    mood = Mood.LISTENING

    def __init__(
        self, questionnaires: Sequence[Questionnaire], chance: Random, language: str, *, rates: bool = False
    ) -> None:
        """Ask these in a language; ``chance`` shuffles what is to be shuffled.

        With ``rates`` they are about the assistant, which does not look on.
        """
        self._rates = rates
        self._language = language
        self._pages = tuple(page for asked in questionnaires for page in item_pages(asked, chance))
        self._asked = {asked.id: asked for asked in questionnaires}
        self._number = self._furthest = 0
        self._hidden: dict[str, tuple[str, ...]] = {}
        """What the conditions hide, by questionnaire, on the pages up to the furthest."""
        self._answers: dict[tuple[str, str], Response] = {}
        self._pointed_out: set[tuple[str, str]] = set()

    @property
    def characters(self) -> int:
        """How long the longest of the pages is."""
        return max((self._length(page) for page in self._pages), default=0)

    def _length(self, page: ItemPage) -> int:
        return sum(len(in_language(words, self._language)) for item in page.items for words in item.texts())

    def enter(self, outcome: OutcomeBuilder) -> None:
        """Show the first page; nothing is answered."""
        self._number = self._furthest = 0
        self._hidden.clear()
        self._answers.clear()
        self._pointed_out.clear()
        self._show(outcome)

    def come_back(self, outcome: OutcomeBuilder) -> None:
        """Show the last page as it was left."""
        self._show(outcome)

    @property
    def goes_back(self) -> bool:
        """Whether this is not the first page."""
        return self._number > 0

    def translate(self, to: Translation) -> None:
        """Ask in another language; the items on the screen hold all of theirs."""
        self._language = to.catalogue.language

    def accepts(self, event: WorldEvent) -> bool:
        """Whether an answer is one that an item of this page can have."""
        match event:
            case happened.ResponseGiven(item=name, value=value):
                item = next((item for item in self._page.items if item.id == name), None)
                return isinstance(item, Question) and self._is_seen(item) and (value is None or item.takes(value))
        return True

    def react(self, event: WorldEvent, outcome: OutcomeBuilder) -> None:
        """Keep an answer, or go on to the next page."""
        match event:
            case happened.ResponseGiven(item=item, value=value):
                hidden = self._hidden_here
                self._keep(item, value)
                outcome.effect(do.ShowAnswer(item, value))
                self._hide(outcome)
                if hidden != self._hidden_here:
                    outcome.effect(do.HideItems(self._hidden_here))
            case happened.ContinuePressed():
                self._go_on(outcome)
            case happened.BackPressed() if self.goes_back:
                self._number = next(number for number in reversed(range(self._number)) if self._is_asked(number))
                self._show(outcome)

    def _keep(self, item: str, value: Response | None) -> None:
        key = (self._page.questionnaire, item)
        if value is None:
            self._answers.pop(key, None)
        else:
            self._answers[key] = value

    def _answer(self, item: Item) -> Response | None:
        return self._answers.get((self._page.questionnaire, item.id))

    def _go_on(self, outcome: OutcomeBuilder) -> None:
        missing = tuple(item.id for item in self._page.items if self._lacks(item))
        if missing:
            self._pointed_out |= {(self._page.questionnaire, item) for item in missing}
            outcome.emit(happened.SkippedItemsShown(at_ms=outcome.at_ms, items=missing))
            outcome.effect(do.ShowValidationErrors(missing))
            return
        for number in range(self._number + 1, len(self._pages)):
            self._furthest = max(self._furthest, number)
            if self._is_asked(number):
                self._number = number
                self._show(outcome)
                return
            self._hide(outcome, number)
        outcome.emit(happened.QuestionnairesCompleted(at_ms=outcome.at_ms))

    def _lacks(self, item: Item) -> bool:
        """Whether an item is still to be answered: it is required, or it was not pointed out yet."""
        if isinstance(item, TextPage) or not self._is_seen(item) or effective_answer(self._answer(item)) is not None:
            return False
        if item.required == "once":
            return (self._page.questionnaire, item.id) not in self._pointed_out
        return item.required

    def _show(self, outcome: OutcomeBuilder) -> None:
        self._hide(outcome)
        names = tuple(item.id for item in self._page.items if self._is_seen(item))
        outcome.emit(
            happened.QuestionnairePageShown(at_ms=outcome.at_ms, questionnaire=self._page.questionnaire, items=names)
        )
        page, number, of = self._page, self._number + 1, len(self._pages)
        alike = pages_alike([each.items for each in self._pages], page.items)
        outcome.effect(do.ShowItems(page.items, number, of, self._rates, self._hidden_here, page.title, alike))
        given = ((item.id, self._answer(item)) for item in self._page.items)
        outcome.effect(*(do.ShowAnswer(item, value) for item, value in given if value is not None))

    def _hidden_of(self, questionnaire: str) -> tuple[str, ...]:
        given = {item: value for (of, item), value in self._answers.items() if of == questionnaire}
        return hidden_items(self._asked[questionnaire].items, given)

    def _is_asked(self, number: int) -> bool:
        """Whether any item of a page is to be seen."""
        page = self._pages[number]
        return not {item.id for item in page.items} <= set(self._hidden_of(page.questionnaire))

    def _is_seen(self, item: Item) -> bool:
        return item.id not in self._hidden.get(self._page.questionnaire, ())

    @property
    def _hidden_here(self) -> tuple[str, ...]:
        return tuple(item.id for item in self._page.items if not self._is_seen(item))

    def _hide(self, outcome: OutcomeBuilder, number: int | None = None) -> None:
        """Hide what the answers hide by now in the questionnaire of a page, by default the one that is shown."""
        of = self._pages[self._number if number is None else number].questionnaire
        hidden = self._hidden_of(of)
        withdrawn = tuple(item for item in hidden if self._answers.pop((of, item), None) is not None)
        reached = {
            item.id for page in self._pages[: self._furthest + 1] if page.questionnaire == of for item in page.items
        }
        hidden = tuple(item for item in hidden if item in reached)
        if hidden == self._hidden.get(of, ()):
            return
        self._hidden[of] = hidden
        outcome.emit(
            happened.HiddenItemsChanged(at_ms=outcome.at_ms, questionnaire=of, hidden=hidden, withdrawn=withdrawn)
        )

    @property
    def _page(self) -> ItemPage:
        return self._pages[self._number]
