"""The stages that are pages: information, age, consent, questionnaires, result, debrief."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from random import Random
from typing import ClassVar

from kiosk.assistance.wording import Wording
from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.effects import Effect, Mood, OutcomeBuilder
from kiosk.experiment.events import Event, Timer, WorldEvent
from kiosk.experiment.information import RETURNING, ConsentPage, Information, Page
from kiosk.experiment.item_responses import effective_answer
from kiosk.experiment.items import (
    Question,
    Response,
    TextPage,
    in_language,
)
from kiosk.experiment.projections import Measures, measure
from kiosk.experiment.questionnaire import (
    Item,
    ItemOrder,
    Questionnaire,
)
from kiosk.experiment.relevance import hidden_items
from kiosk.experiment.session_config import Translation
from kiosk.lazy_dataclass import dataclass


class StageHandler:
    """One stage; by default it shows nothing and takes whatever the table of stages lets through."""

    mood: ClassVar[Mood] = Mood.IDLE
    """The assistant's face as the stage begins, whatever it showed before."""

    @property
    def characters(self) -> int:
        """How much there is to read on its longest page, in characters."""
        return 0

    @property
    def goes_back(self) -> bool:
        """Whether there is a page before within the stage."""
        return False

    def enter(self, outcome: OutcomeBuilder) -> None:
        """Begin, or begin anew."""

    def come_back(self, outcome: OutcomeBuilder) -> None:
        """Show it to a visitor who goes back to it."""
        self.enter(outcome)

    def translate(self, to: Translation) -> None:
        """Speak another language from now on."""

    def show_again(self, outcome: OutcomeBuilder) -> None:
        """Show what is worded in another language by now."""

    def accepts(self, event: WorldEvent) -> bool:  # noqa: ARG002 - most stages take whatever comes
        """Whether this event makes sense now."""
        return True

    def react(self, event: WorldEvent, outcome: OutcomeBuilder) -> None:
        """Handle an event within the stage."""


class SpeechWriter:
    """Says what stands in the catalogue; every sentence of a session has a number of its own."""

    def __init__(self, wording: Wording, numbers: Iterator[int]) -> None:
        """Speak in these words; ``numbers`` go on through the whole session."""
        self._wording = wording
        self._numbers = numbers
        self._last: tuple[str, dict[str, str | int]] | None = None

    def say_again(self, outcome: OutcomeBuilder) -> None:
        """Say what was said last, in the present language."""
        if self._last is not None:
            message, variables = self._last
            self.say(message, outcome, **variables)

    def say(self, message: str, outcome: OutcomeBuilder, **variables: str | int) -> None:
        """Have one wording of the message said."""
        self._last = (message, variables)
        sentence, number = self._wording.say(message, **variables), next(self._numbers)
        outcome.emit(happened.SentenceRequested(at_ms=outcome.at_ms, utterance=number, sentence=sentence))
        outcome.effect(do.Speak(number, sentence))

    def repeat(self, said: do.Speak, outcome: OutcomeBuilder) -> None:
        """Have a sentence said once more."""
        number = next(self._numbers)
        outcome.emit(happened.SentenceRepeated(at_ms=outcome.at_ms, of=said.utterance, utterance=number))
        outcome.effect(do.Speak(number, said.sentence, said.advice))


class ConsentStage(StageHandler):
    """One box for each purpose, none ticked; agreeing counts once every required one is."""

    def __init__(self, information: Information, language: str, *, back: bool = False) -> None:
        """Ask for the consent of this sheet; a visitor who came ``back`` has to agree that visits are linked."""
        self._information = information
        self._language = language
        self._back = back
        self._ticked: frozenset[str] = frozenset()

    @property
    def characters(self) -> int:
        """How long the page is, boxes and all."""
        return self._information.consent.characters

    def enter(self, outcome: OutcomeBuilder) -> None:
        """Show the boxes, with the ticks of a visitor who was here before."""
        outcome.effect(do.ShowConsent(self._page))
        if self._ticked:
            outcome.effect(do.ShowTicks(self._ticked))

    def translate(self, to: Translation) -> None:
        """Ask for the consent of another sheet from now on."""
        self._information = to.information
        self._language = to.catalogue.language

    def show_again(self, outcome: OutcomeBuilder) -> None:
        """Show the sheet of the language."""
        self.enter(outcome)

    def accepts(self, event: WorldEvent) -> bool:
        """Whether the purpose is one of those that are shown."""
        match event:
            case happened.ConsentPurposeToggled(purpose=purpose):
                return purpose in (offered.id for offered in self._information.consent.purposes)
        return True

    def react(self, event: WorldEvent, outcome: OutcomeBuilder) -> None:
        """Keep the ticks, or conclude from them."""
        match event:
            case happened.ConsentPurposeToggled(purpose=purpose, ticked=ticked):
                self._ticked = self._ticked | {purpose} if ticked else self._ticked - {purpose}
                outcome.effect(do.ShowTicks(self._ticked))
            case happened.ConsentSubmitted():
                self._agree(outcome)

    @property
    def _page(self) -> ConsentPage:
        """The page as it is asked; its hash stays that of the sheet."""
        page = self._information.consent
        if not self._back:
            return page
        purposes = (
            each.model_copy(update={"required": each.required or each.id == RETURNING}) for each in page.purposes
        )
        return page.model_copy(update={"purposes": tuple(purposes)})

    def _agree(self, outcome: OutcomeBuilder) -> None:
        missing = self._page.required - self._ticked
        purposes = tuple(purpose.id for purpose in self._information.consent.purposes)
        if missing:
            outcome.effect(do.ShowValidationErrors(tuple(purpose for purpose in purposes if purpose in missing)))
            return
        outcome.emit(
            happened.ConsentGiven(
                at_ms=outcome.at_ms,
                version=self._information.version,
                sha256=self._information.sha256,
                language=self._language,
                purposes=tuple(purpose for purpose in purposes if purpose in self._ticked),
            )
        )


class AgeStage(StageHandler):
    """Whether the visitor is old enough for their session to be stored."""

    def __init__(self, adult: int) -> None:
        """Ask for this age in years."""
        self._adult = adult

    def enter(self, outcome: OutcomeBuilder) -> None:
        """Ask."""
        outcome.effect(do.ShowAgeQuestion(self._adult))


FEW_MOVES = 25
SOME_MOVES = 30
"""Below FEW_MOVES and below SOME_MOVES the assistant praises; the study's two limits, for its twelve pairs."""

STUDY_PAIRS = 12


class TextStage(StageHandler):
    """A page of text on the information sheet: what the study is about, or the debriefing."""

    def __init__(
        self, information: Information, page_of: Callable[[Information], Page], show: Callable[[Page], Effect]
    ) -> None:
        """Show the page that ``page_of`` takes from the sheet, with the effect that ``show`` makes."""
        self._page = page_of(information)
        self._page_of = page_of
        self._show = show

    @property
    def characters(self) -> int:
        """How long the page is."""
        return self._page.characters

    def enter(self, outcome: OutcomeBuilder) -> None:
        """Show it."""
        outcome.effect(self._show(self._page))

    def translate(self, to: Translation) -> None:
        """Take the page from the sheet of another language."""
        self._page = self._page_of(to.information)

    def show_again(self, outcome: OutcomeBuilder) -> None:
        """Show the page of the language."""
        self.enter(outcome)


class IntroductionStage(StageHandler):
    """The assistant greets, and says what is to be done."""

    def __init__(self, speaker: SpeechWriter, pairs: int, *, helped: bool, points: bool = True) -> None:
        """Introduce a game of so many pairs, with help or without; ``points``: whether hints name a place."""
        self._speaker = speaker
        self._pairs = pairs
        self._helped, self._points = helped, points

    def enter(self, outcome: OutcomeBuilder) -> None:
        """Show the rules and say them."""
        outcome.effect(do.ShowIntroduction(helped=self._helped, points=self._points))
        speech = "introduction-speech" if self._helped else "introduction-speech-alone"
        self._speaker.say(speech, outcome, cards=2 * self._pairs, pairs=self._pairs)

    def show_again(self, outcome: OutcomeBuilder) -> None:
        """Greet in the present language."""
        self._speaker.say_again(outcome)


class ResultStage(StageHandler):
    """What the visitor achieved."""

    mood = Mood.HAPPY

    def __init__(self, speaker: SpeechWriter, log: Callable[[OutcomeBuilder], Sequence[Event]]) -> None:
        """``log`` tells everything that was concluded, with what the outcome at hand adds."""
        self._speaker = speaker
        self._log = log

    def enter(self, outcome: OutcomeBuilder) -> None:
        """Show the figures and remark on them."""
        measures = measure(self._log(outcome))
        outcome.effect(do.ShowResult(measures.pairs, measures.moves, measures.completion_ms, measures.hints))
        self._speaker.say(_remark(measures), outcome, moves=measures.moves)

    def show_again(self, outcome: OutcomeBuilder) -> None:
        """Show the figures and remark on them in the present language."""
        self.enter(outcome)


class ThanksStage(StageHandler):
    """The end, for a moment, or until it is tapped away."""

    mood = Mood.HAPPY

    def __init__(self, speaker: SpeechWriter, stay_ms: int) -> None:
        """Stay so long."""
        self._speaker = speaker
        self._stay_ms = stay_ms

    def enter(self, outcome: OutcomeBuilder) -> None:
        """Thank the visitor."""
        outcome.effect(do.ShowThanks(), do.StartTimer(Timer.THANKS, self._stay_ms))
        self._speaker.say("thanks-speech", outcome)

    def show_again(self, outcome: OutcomeBuilder) -> None:
        """Thank in the present language."""
        self._speaker.say_again(outcome)

    def react(self, event: WorldEvent, outcome: OutcomeBuilder) -> None:
        """Leave when the time is over."""
        match event:
            case happened.TimerExpired(timer=Timer.THANKS):
                outcome.emit(happened.ThanksTimedOut(at_ms=outcome.at_ms))


def _remark(measures: Measures) -> str:
    """Return the message for the end of a game; the study's limits hold for its own board, others in proportion."""
    return result_speech(measures.moves, measures.pairs)


def result_speech(moves: int, pairs: int) -> str:
    """Name the message for a game of so many pairs that took so many moves."""
    in_study = moves * STUDY_PAIRS / max(1, pairs)
    if in_study < FEW_MOVES:
        return "result-speech-few"
    return "result-speech-some" if in_study < SOME_MOVES else "result-speech-many"


@dataclass(frozen=True)
class ItemPage:
    """Items that are shown together; all of one questionnaire."""

    questionnaire: str
    items: tuple[Item, ...]
    title: Mapping[str, str] | None = None


def item_pages(questionnaire: Questionnaire, chance: Random) -> Iterator[ItemPage]:
    """Yield the pages of a questionnaire, in the order of this session."""
    together: list[Item] = []
    for item in _ordered(questionnaire, chance):
        if isinstance(item, TextPage) or len(together) == questionnaire.per_page:
            yield from _page_of(questionnaire, together)
            together = []
        if isinstance(item, TextPage):
            yield ItemPage(questionnaire.id, (item,), questionnaire.title)
        else:
            together.append(item)
    yield from _page_of(questionnaire, together)


def _page_of(questionnaire: Questionnaire, items: list[Item]) -> Iterator[ItemPage]:
    if items:
        yield ItemPage(questionnaire.id, tuple(items), questionnaire.title)


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
        outcome.effect(do.ShowItems(page.items, number, of, self._rates, self._hidden_here, page.title))
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
