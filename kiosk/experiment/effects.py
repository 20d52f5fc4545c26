"""What is to be done, in the imperative: the only way the study speaks to the world.

Record commands come first in every list; nothing after them happens before they are on the disk.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from kiosk.experiment.events import EmbodimentName, NotRecordedReason, SessionEvent, Status, Timer
from kiosk.experiment.information import ConsentPage, Page
from kiosk.experiment.questionnaire import Answer, Item
from kiosk.game import Position


class Mood(Enum):
    """What the assistant's face shows."""

    IDLE = "idle"
    HAPPY = "happy"
    CONFUSED = "confused"
    SAD = "sad"
    THINKING = "thinking"
    LISTENING = "listening"


class BoardWait(Enum):
    """Why cards cannot be tapped just now."""

    SPEAKING = "speaking"
    TURNING_BACK = "turning_back"


@dataclass(frozen=True)
class Effect:
    """Something to be done."""


@dataclass(frozen=True)
class EmitEvent(Effect):
    """Write down what the session concluded, with the event that it came from."""

    event: SessionEvent


@dataclass(frozen=True)
class StartRecording(Effect):
    """Write everything from here on; what was held back so far is written first."""


@dataclass(frozen=True)
class DiscardRecording(Effect):
    """Write nothing of this session, now or later, but that there was one; and why."""

    why: NotRecordedReason


@dataclass(frozen=True)
class ShowAbout(Effect):
    """Show what the study is about."""

    page: Page


@dataclass(frozen=True)
class ShowConsent(Effect):
    """Show what can be agreed to; nothing is ticked."""

    page: ConsentPage


@dataclass(frozen=True)
class ShowTicks(Effect):
    """Show which purposes are ticked."""

    purposes: frozenset[str]


@dataclass(frozen=True)
class ShowAgeQuestion(Effect):
    """Ask whether the visitor is at least so old."""

    adult: int


@dataclass(frozen=True)
class ShowIntroduction(Effect):
    """Show what the game is about; hints are spoken of only where there are some."""

    helped: bool = True


@dataclass(frozen=True)
class ShowBoard(Effect):
    """Show a board of closed cards from a deck; which card lies where is not told. A practice can be left."""

    rows: int
    columns: int
    pairs: int
    deck: str
    practice: bool = False


@dataclass(frozen=True)
class RevealCard(Effect):
    """Show the picture of one card."""

    position: Position
    card: str


@dataclass(frozen=True)
class HideCards(Effect):
    """Close these cards again."""

    positions: tuple[Position, ...]


@dataclass(frozen=True)
class MarkMatched(Effect):
    """Show that these two cards are found; they stay open."""

    positions: tuple[Position, ...]


@dataclass(frozen=True)
class ShowProgress(Effect):
    """Show how far the game is."""

    pairs_found: int
    moves: int


@dataclass(frozen=True)
class LockBoard(Effect):
    """Show that cards cannot be tapped just now, and why."""

    wait: BoardWait


@dataclass(frozen=True)
class UnlockBoard(Effect):
    """Show that cards can be tapped."""


@dataclass(frozen=True)
class HighlightHint(Effect):
    """Mark a card, a row (no column) or a column (no row), counted from 0."""

    row: int | None
    column: int | None


@dataclass(frozen=True)
class ClearHighlight(Effect):
    """Take the mark away."""


@dataclass(frozen=True)
class Speak(Effect):
    """Show a sentence in the assistant's bubble and say it; SpeechStarted, then -Finished or -Failed come back."""

    utterance: int
    sentence: str


@dataclass(frozen=True)
class StopSpeaking(Effect):
    """Say no more of the sentence; it stays in the bubble."""


@dataclass(frozen=True)
class SwitchEmbodiment(Effect):
    """Have this body help from now on; the other one is not to be used again in this session."""

    body: EmbodimentName


@dataclass(frozen=True)
class ClearBubble(Effect):
    """Take the sentence away."""


@dataclass(frozen=True)
class SetExpression(Effect):
    """Show a mood on the assistant's face."""

    mood: Mood


@dataclass(frozen=True)
class ShowResult(Effect):
    """Show what the visitor achieved; the time is their own, without speech, as they rate the robot after this."""

    pairs: int
    moves: int
    time_ms: int


@dataclass(frozen=True)
class ShowItems(Effect):
    """Show a page of items, none of them answered; ``number`` ``of`` so many pages, from 1."""

    items: tuple[Item, ...]
    number: int
    of: int


@dataclass(frozen=True)
class ShowAnswer(Effect):
    """Show which answer is chosen for an item, None for none."""

    item: str
    value: Answer | None


@dataclass(frozen=True)
class ShowValidationErrors(Effect):
    """Show what has to be done before the visitor can go on: these purposes or items."""

    names: tuple[str, ...]


@dataclass(frozen=True)
class ShowDebrief(Effect):
    """Show what the study was about, and the code to withdraw with."""

    page: Page


@dataclass(frozen=True)
class ShowThanks(Effect):
    """Thank the visitor, and see them off."""


@dataclass(frozen=True)
class ShowPause(Effect):
    """Cover everything with a calm word until the experimenter lets it go on."""


@dataclass(frozen=True)
class HidePause(Effect):
    """Take that cover away."""


@dataclass(frozen=True)
class AskStillThere(Effect):
    """Ask whether anybody is there, over whatever is shown."""


@dataclass(frozen=True)
class HideStillThere(Effect):
    """Take that question away."""


@dataclass(frozen=True)
class StartTimer(Effect):
    """Send TimerExpired in so many milliseconds; a timer that runs starts anew."""

    timer: Timer
    after_ms: int


@dataclass(frozen=True)
class StopTimer(Effect):
    """Do not send this TimerExpired after all."""

    timer: Timer


@dataclass(frozen=True)
class EndSession(Effect):
    """Close the session and get ready for the next visitor."""

    status: Status


class Script:
    """The commands that one event leads to, put together in their order: what is written, then what is done."""

    def __init__(self, at_ms: int) -> None:
        """Everything in it happens at the time of the event it follows from."""
        self.at_ms = at_ms
        self.notes: list[SessionEvent] = []
        self.actions: list[Effect] = []

    def note(self, event: SessionEvent) -> None:
        """Write this down."""
        self.notes.append(event)

    def do(self, *commands: Effect) -> None:
        """Then do this."""
        self.actions.extend(commands)

    @property
    def commands(self) -> tuple[Effect, ...]:
        """All of it, the records first."""
        return (*map(EmitEvent, self.notes), *self.actions)
