"""What a visitor would see of the outcomes so far."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from kiosk.experiment import effects as do
from kiosk.experiment.effects import BoardWait, Effect, Mood, Outcome, RecordingDecision
from kiosk.experiment.events import SessionEnded, SessionResumed, SpeechFailed, SpeechFinished, TextSize, WorldEvent
from kiosk.experiment.items import Response
from kiosk.experiment.outcomes import NotRecordedReason, Status
from kiosk.game import Position


@dataclass
class View:
    """What there is to see, and what was said about keeping it."""

    screen: str = "attract"
    consent: do.ShowConsent | None = None
    ticks: frozenset[str] = frozenset()
    adult: int | None = None
    missing: tuple[str, ...] = ()
    rows: int = 0
    columns: int = 0
    deck: str = ""
    up: dict[Position, str] = field(default_factory=dict)
    found: set[Position] = field(default_factory=set)
    held: BoardWait | None = None
    mark: tuple[int | None, int | None] | None = None
    looked: tuple[int | None, int | None] | None = None
    bubble: str | None = None
    speaking: int | None = None
    mood: Mood = Mood.IDLE
    progress: tuple[int, int] = (0, 0)
    result: do.ShowResult | None = None
    page: do.ShowItems | None = None
    hidden: tuple[str, ...] = ()
    """The items of the page that its conditions hide."""
    answers: dict[str, Response] = field(default_factory=dict)
    still_there: bool = False
    paused: bool = False
    goes_back: bool = False
    language: str = ""
    text_size: TextSize = TextSize.NORMAL
    sound: bool = True
    kept: list[RecordingDecision] = field(default_factory=list)
    ended: Status | None = None

    @property
    def closed(self) -> list[Position]:
        """Every closed card, row by row."""
        places = (Position(row, column) for row in range(self.rows) for column in range(self.columns))
        return [place for place in places if place not in self.up]

    @property
    def forgotten(self) -> NotRecordedReason | None:
        """Why nothing of it is kept, if so."""
        return next((said.why for said in self.kept if isinstance(said, do.DiscardRecording)), None)

    def hear(self, event: WorldEvent) -> None:
        """Note that the body finished or failed a sentence, or that a session was resumed."""
        if isinstance(event, SpeechFinished | SpeechFailed) and event.utterance == self.speaking:
            self.speaking = None
        if isinstance(event, SessionResumed):
            self.ended = None

    def follow(self, outcome: Outcome) -> None:
        """Note what becomes of the session, and show what is to be shown."""
        if outcome.recording is not None:
            self.kept.append(outcome.recording)
        for event in outcome.events:
            if isinstance(event, SessionEnded):
                self.ended = event.status
        self.show(outcome.effects)

    def show(self, effects: Iterable[Effect]) -> None:
        """Show what these effects say."""
        for effect in effects:
            if not (self._show_screen(effect) or self._show_board(effect) or self._show_other(effect)):
                assert isinstance(effect, do.StartTimer | do.StopTimer | do.SwitchEmbodiment), effect

    def _show_screen(self, effect: Effect) -> bool:  # noqa: C901 - one case per effect
        match effect:
            case do.ShowAbout():
                self.screen = "about"
            case do.ShowConsent():
                self.screen, self.consent, self.ticks = "consent", effect, frozenset()
            case do.ShowAgeQuestion(adult=adult):
                self.screen, self.adult = "age", adult
            case do.ShowIntroduction():
                self.screen = "introduction"
            case do.ShowBoard(rows=rows, columns=columns, deck=deck, practice=practice):
                self.screen = "practice" if practice else "board"
                self.rows, self.columns, self.deck = rows, columns, deck
                self.up, self.found, self.held, self.mark, self.progress = {}, set(), None, None, (0, 0)
            case do.ShowResult():
                self.screen, self.result = "result", effect
            case do.HideItems(items=hidden):
                kept = {item: value for item, value in self.answers.items() if item not in hidden}
                self.answers, self.missing = kept, tuple(item for item in self.missing if item not in hidden)
                self.hidden = hidden
            case do.ShowItems():
                self.screen, self.page, self.answers, self.missing = "questions", effect, {}, ()
                self.hidden = effect.hidden
            case do.ShowDebrief():
                self.screen = "debrief"
            case do.ShowThanks():
                self.screen = "thanks"
            case _:
                return False
        return True

    def _show_board(self, effect: Effect) -> bool:  # noqa: C901 - one case per effect
        match effect:
            case do.RevealCard(position=position, card=card):
                self.up[position] = card
            case do.HideCards(positions=positions):
                for position in positions:
                    del self.up[position]
            case do.MarkMatched(positions=positions):
                self.found |= set(positions)
            case do.ShowProgress(pairs_found=pairs_found, moves=moves):
                self.progress = (pairs_found, moves)
            case do.LockBoard(wait=wait):
                self.held = wait
            case do.UnlockBoard():
                self.held = None
            case do.HighlightHint(row=row, column=column):
                self.mark = (row, column)
            case do.LookAt(row=row, column=column):
                self.looked = (row, column)
            case do.ClearHighlight():
                self.mark = None
            case _:
                return False
        return True

    def _show_other(self, effect: Effect) -> bool:  # noqa: C901, PLR0912 - one case per effect
        match effect:
            case do.ShowTicks(purposes=purposes):
                self.ticks, self.missing = purposes, ()
            case do.ShowValidationErrors(names=names):
                self.missing = names
            case do.ShowAnswer(item=item, value=None):
                self.answers.pop(item, None)
            case do.ShowAnswer(item=item, value=value) if value is not None:
                self.answers[item] = value
            case do.Speak(utterance=utterance, sentence=sentence):
                self.bubble, self.speaking = sentence, utterance
            case do.StopSpeaking():
                self.speaking = None
            case do.ClearBubble():
                self.bubble = None
            case do.SetExpression(mood=mood):
                self.mood = mood
            case do.AskStillThere():
                self.still_there = True
            case do.HideStillThere():
                self.still_there = False
            case do.ShowPause():
                self.paused = True
            case do.HidePause():
                self.paused = False
            case do.OfferBack(offered=offered):
                self.goes_back = offered
            case do.SetLanguage(language=language):
                self.language = language
            case do.SetTextSize(size=size):
                self.text_size = size
            case do.SetSound(on=on):
                self.sound = on
            case _:
                return False
        return True
