"""The stages that are pages, but for questionnaires: information, age, consent, result, debrief and thanks."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import ClassVar

from kiosk.assistance.hint_sentences import Wording
from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.effects import Effect, Mood, OutcomeBuilder
from kiosk.experiment.events import Event, Timer, WorldEvent
from kiosk.experiment.information import RETURNING, ConsentPage, Information, Page
from kiosk.experiment.projections import Measures, measure
from kiosk.experiment.session_config import Translation


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
        self._last: tuple[str, str, dict[str, str | int]] | None = None

    def say_again(self, outcome: OutcomeBuilder) -> None:
        """Say what was said last, in the present language."""
        if self._last is not None:
            message, advice, variables = self._last
            self.say(message, outcome, advice, **variables)

    def say(self, message: str, outcome: OutcomeBuilder, advice: str = "", **variables: str | int) -> None:
        """Have one wording of the message said; ``advice`` is the message at its end that the bubble shows first."""
        self._last = (message, advice, variables)
        sentence, number = self._wording.say(message, **variables), next(self._numbers)
        outcome.emit(happened.SentenceRequested(at_ms=outcome.at_ms, utterance=number, sentence=sentence))
        outcome.effect(do.Speak(number, sentence, self._wording.catalogue.text(advice) if advice else ""))

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
