"""What is to be done, in the imperative: the only way the study speaks to the world.

Record commands come first in every list; nothing after them happens before they are on the disk.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from kiosk.game import Position
from kiosk.study.declared.information import ConsentPage, Page
from kiosk.study.declared.questionnaire import Answer, Item
from kiosk.study.events import BodyName, SessionEvent, Status, Timer, Unstored


class Mood(Enum):
    """What the assistant's face shows."""

    IDLE = "idle"
    HAPPY = "happy"
    CONFUSED = "confused"
    SAD = "sad"
    THINKING = "thinking"
    LISTENING = "listening"


class Wait(Enum):
    """Why cards cannot be tapped just now."""

    SPEAKING = "speaking"
    TURNING_BACK = "turning_back"


@dataclass(frozen=True)
class Command:
    """Something to be done."""


@dataclass(frozen=True)
class Record(Command):
    """Write down what the session concluded, with the event that it came from."""

    event: SessionEvent


@dataclass(frozen=True)
class KeepSitting(Command):
    """Write everything from here on; what was held back so far is written first."""


@dataclass(frozen=True)
class ForgetSitting(Command):
    """Write nothing of this sitting, now or later, but that there was one; and why."""

    why: Unstored


@dataclass(frozen=True)
class ShowAbout(Command):
    """Show what the study is about."""

    page: Page


@dataclass(frozen=True)
class ShowConsent(Command):
    """Show what can be agreed to; nothing is ticked."""

    page: ConsentPage


@dataclass(frozen=True)
class ShowTicks(Command):
    """Show which purposes are ticked."""

    purposes: frozenset[str]


@dataclass(frozen=True)
class ShowAgeQuestion(Command):
    """Ask whether the visitor is at least so old."""

    adult: int


@dataclass(frozen=True)
class ShowIntroduction(Command):
    """Show what the game is about; hints are spoken of only where there are some."""

    helped: bool = True


@dataclass(frozen=True)
class ShowBoard(Command):
    """Show a board of closed cards from a deck; which card lies where is not told. A practice can be left."""

    rows: int
    columns: int
    pairs: int
    deck: str
    practice: bool = False


@dataclass(frozen=True)
class TurnUp(Command):
    """Show the picture of one card."""

    position: Position
    card: str


@dataclass(frozen=True)
class TurnBack(Command):
    """Close these cards again."""

    positions: tuple[Position, ...]


@dataclass(frozen=True)
class ShowPair(Command):
    """Show that these two cards are found; they stay open."""

    positions: tuple[Position, ...]


@dataclass(frozen=True)
class ShowProgress(Command):
    """Show how far the game is."""

    pairs_found: int
    moves: int


@dataclass(frozen=True)
class HoldBoard(Command):
    """Show that cards cannot be tapped just now, and why."""

    wait: Wait


@dataclass(frozen=True)
class OpenBoard(Command):
    """Show that cards can be tapped."""


@dataclass(frozen=True)
class ShowMark(Command):
    """Mark a card, a row (no column) or a column (no row), counted from 0."""

    row: int | None
    column: int | None


@dataclass(frozen=True)
class ClearMark(Command):
    """Take the mark away."""


@dataclass(frozen=True)
class Speak(Command):
    """Show a sentence in the assistant's bubble and say it; SpeechStarted, then -Finished or -Failed come back."""

    utterance: int
    sentence: str


@dataclass(frozen=True)
class StopSpeaking(Command):
    """Say no more of the sentence; it stays in the bubble."""


@dataclass(frozen=True)
class ChangeBody(Command):
    """Have this body help from now on; the other one is not to be used again in this sitting."""

    body: BodyName


@dataclass(frozen=True)
class ClearBubble(Command):
    """Take the sentence away."""


@dataclass(frozen=True)
class Express(Command):
    """Show a mood on the assistant's face."""

    mood: Mood


@dataclass(frozen=True)
class ShowResult(Command):
    """Show what the visitor achieved."""

    pairs: int
    moves: int
    time_ms: int


@dataclass(frozen=True)
class ShowItems(Command):
    """Show a page of items, none of them answered; ``number`` ``of`` so many pages, from 1."""

    items: tuple[Item, ...]
    number: int
    of: int


@dataclass(frozen=True)
class ShowAnswer(Command):
    """Show which answer is chosen for an item, None for none."""

    item: str
    value: Answer | None


@dataclass(frozen=True)
class ShowMissing(Command):
    """Show what has to be done before the visitor can go on: these purposes or items."""

    names: tuple[str, ...]


@dataclass(frozen=True)
class ShowDebrief(Command):
    """Show what the study was about, and the code to withdraw with."""

    page: Page


@dataclass(frozen=True)
class ShowThanks(Command):
    """Thank the visitor, and see them off."""


@dataclass(frozen=True)
class ShowPause(Command):
    """Cover everything with a calm word until the experimenter lets it go on."""


@dataclass(frozen=True)
class HidePause(Command):
    """Take that cover away."""


@dataclass(frozen=True)
class AskStillThere(Command):
    """Ask whether anybody is there, over whatever is shown."""


@dataclass(frozen=True)
class HideStillThere(Command):
    """Take that question away."""


@dataclass(frozen=True)
class StartTimer(Command):
    """Send TimerEnded in so many milliseconds; a timer that runs starts anew."""

    timer: Timer
    after_ms: int


@dataclass(frozen=True)
class StopTimer(Command):
    """Do not send this TimerEnded after all."""

    timer: Timer


@dataclass(frozen=True)
class EndSitting(Command):
    """Close the sitting and get ready for the next visitor."""

    status: Status


class Script:
    """The commands that one event leads to, put together in their order: what is written, then what is done."""

    def __init__(self, at_ms: int) -> None:
        """Everything in it happens at the time of the event it follows from."""
        self.at_ms = at_ms
        self.notes: list[SessionEvent] = []
        self.deeds: list[Command] = []

    def note(self, event: SessionEvent) -> None:
        """Write this down."""
        self.notes.append(event)

    def do(self, *commands: Command) -> None:
        """Then do this."""
        self.deeds.extend(commands)

    @property
    def commands(self) -> tuple[Command, ...]:
        """All of it, the records first."""
        return (*map(Record, self.notes), *self.deeds)
