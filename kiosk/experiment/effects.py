"""What the session asks the program to do, and the outcome of one event: new events first, then effects."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum

from kiosk.experiment.events import SessionEvent, TextSize, Timer
from kiosk.experiment.information import ConsentPage, Page
from kiosk.experiment.items import Response
from kiosk.experiment.outcomes import EmbodimentName, NotRecordedReason
from kiosk.experiment.questionnaire import Item
from kiosk.game import Position
from kiosk.lazy_dataclass import dataclass


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
    LOOKING = "looking"
    """The hint is a look, and words about it would be a hint of another kind."""
    TURNING_BACK = "turning_back"


@dataclass(frozen=True)
class ShowAbout:
    """Show what the study is about."""

    page: Page


@dataclass(frozen=True)
class ShowConsent:
    """Show what can be agreed to; nothing is ticked."""

    page: ConsentPage


@dataclass(frozen=True)
class ShowTicks:
    """Show which purposes are ticked."""

    purposes: frozenset[str]


@dataclass(frozen=True)
class ShowAgeQuestion:
    """Ask whether the visitor is at least so old."""

    adult: int


@dataclass(frozen=True)
class ShowIntroduction:
    """Show what the game is about; hints are spoken of only where there are some.

    ``points`` tells whether they mark a place on the board.
    """

    helped: bool = True
    points: bool = True


@dataclass(frozen=True)
class ShowBoard:
    """Show a board of closed cards from a deck, without their places.

    A practice can be left.
    """

    rows: int
    columns: int
    pairs: int
    deck: str
    practice: bool = False


@dataclass(frozen=True)
class RevealCard:
    """Show the picture of one card."""

    position: Position
    card: str


@dataclass(frozen=True)
class HideCards:
    """Close these cards again."""

    positions: tuple[Position, ...]


@dataclass(frozen=True)
class MarkMatched:
    """Show that these two cards are found; they stay open."""

    positions: tuple[Position, ...]


@dataclass(frozen=True)
class ShowProgress:
    """Show how far the game is."""

    pairs_found: int
    moves: int


@dataclass(frozen=True)
class LockBoard:
    """Show that cards cannot be tapped just now, and why."""

    wait: BoardWait


@dataclass(frozen=True)
class UnlockBoard:
    """Show that cards can be tapped."""


@dataclass(frozen=True)
class HighlightHint:
    """Mark a card, a row (no column) or a column (no row), counted from 0."""

    row: int | None
    column: int | None


@dataclass(frozen=True)
class LookAt:
    """Look toward a card, a row (no column) or a column (no row), counted from 0.

    The board is not marked.
    """

    row: int | None
    column: int | None


@dataclass(frozen=True)
class ClearHighlight:
    """Take the mark away, and look at the visitor again."""


@dataclass(frozen=True)
class Speak:
    """Show a sentence in the assistant's bubble and say it; SpeechStarted, then -Finished or -Failed come back."""

    utterance: int
    sentence: str
    advice: str = ""
    """The end of a sentence that says where to look or what to do; the bubble shows it first."""


@dataclass(frozen=True)
class StopSpeaking:
    """Say no more of the sentence; it stays in the bubble."""


@dataclass(frozen=True)
class SwitchEmbodiment:
    """Have this body help from now on; the other one is not to be used again in this session."""

    embodiment: EmbodimentName


@dataclass(frozen=True)
class ClearBubble:
    """Take the sentence away."""


@dataclass(frozen=True)
class SetExpression:
    """Show a mood on the assistant's face."""

    mood: Mood


@dataclass(frozen=True)
class ShowResult:
    """Show what the visitor achieved; the time is their own, without speech, as they rate the robot after this."""

    pairs: int
    moves: int
    time_ms: int
    hints: int = 0


@dataclass(frozen=True)
class ShowItems:
    """Show a page of items, none of them answered; ``number`` ``of`` so many pages, from 1.

    With ``rates`` they are about the assistant, which is not there meanwhile.
    """

    items: tuple[Item, ...]
    number: int
    of: int
    rates: bool = False
    hidden: tuple[str, ...] = ()
    """Those of the items that are not to be seen for now."""
    title: Mapping[str, str] | None = None
    """The title of their questionnaire in its languages, if it has one."""
    alike: tuple[tuple[Item, ...], ...] = ()
    """All pages of the form that ask on the same scale as this one: they are laid out alike."""


@dataclass(frozen=True)
class HideItems:
    """Of the items of the page that is shown, hide these and no others."""

    items: tuple[str, ...]


@dataclass(frozen=True)
class ShowAnswer:
    """Show which answer is chosen for an item, None for none."""

    item: str
    value: Response | None


@dataclass(frozen=True)
class ShowValidationErrors:
    """Show what has to be done before the visitor can go on: these purposes or items."""

    names: tuple[str, ...]


@dataclass(frozen=True)
class ShowDebrief:
    """Show what the study was about, and the code to withdraw with."""

    page: Page


@dataclass(frozen=True)
class ShowThanks:
    """Thank the visitor, and see them off."""


@dataclass(frozen=True)
class ShowPause:
    """Cover everything with a calm word until the experimenter lets it go on."""


@dataclass(frozen=True)
class HidePause:
    """Take that cover away."""


@dataclass(frozen=True)
class AskStillThere:
    """Ask whether anybody is there, over whatever is shown."""

    wait_ms: int = 0
    """How long an answer is waited for; 0 shows no time."""


@dataclass(frozen=True)
class HideStillThere:
    """Take that question away."""


@dataclass(frozen=True)
class OfferBack:
    """Let the visitor go back to the page before, or not."""

    offered: bool


@dataclass(frozen=True)
class SetLanguage:
    """Show everything in another language, and speak it; what is answered and typed stays."""

    language: str


@dataclass(frozen=True)
class SetTextSize:
    """Show all texts in this size."""

    size: TextSize


@dataclass(frozen=True)
class SetSound:
    """Let the visitor hear voice and sounds, or not."""

    on: bool


@dataclass(frozen=True)
class StartTimer:
    """Send TimerExpired in so many milliseconds; a timer that runs starts anew."""

    timer: Timer
    after_ms: int


@dataclass(frozen=True)
class StopTimer:
    """Do not send this TimerExpired after all."""

    timer: Timer


Effect = (
    ShowAbout
    | ShowConsent
    | ShowTicks
    | ShowAgeQuestion
    | ShowIntroduction
    | ShowBoard
    | RevealCard
    | HideCards
    | MarkMatched
    | ShowProgress
    | LockBoard
    | UnlockBoard
    | HighlightHint
    | LookAt
    | ClearHighlight
    | Speak
    | StopSpeaking
    | SwitchEmbodiment
    | ClearBubble
    | SetExpression
    | ShowResult
    | ShowItems
    | HideItems
    | ShowAnswer
    | ShowValidationErrors
    | ShowDebrief
    | ShowThanks
    | ShowPause
    | HidePause
    | AskStillThere
    | HideStillThere
    | OfferBack
    | SetLanguage
    | SetTextSize
    | SetSound
    | StartTimer
    | StopTimer
)
"""Everything that a session can ask for; the renderer carries out each of them."""


@dataclass(frozen=True)
class StartRecording:
    """Write the session to the database from here on; what was held back so far is written first."""


@dataclass(frozen=True)
class DiscardRecording:
    """Write nothing of this session, now or later, except that there was one, and why it was not recorded."""

    why: NotRecordedReason


RecordingDecision = StartRecording | DiscardRecording
"""What becomes of the record; there is one such decision in every session."""


@dataclass(frozen=True)
class Outcome:
    """What one event leads to. The events are on the disk before any of the effects is carried out."""

    events: tuple[SessionEvent, ...]
    """What the session concluded, in order; all of it at the time of the event that it follows from."""
    effects: tuple[Effect, ...]
    """What is shown, said and waited for, in order."""
    recording: RecordingDecision | None = None
    """Whether the session is recorded, if this event decides it."""


class OutcomeBuilder:
    """Collects the outcome of one event while the session works it out."""

    def __init__(self, at_ms: int) -> None:
        """Give every event in it the time of the event that it follows from."""
        self.at_ms = at_ms
        self.events: list[SessionEvent] = []
        self.effects: list[Effect] = []
        self.recording: RecordingDecision | None = None

    def emit(self, event: SessionEvent) -> None:
        """Add an event to the record."""
        self.events.append(event)

    def effect(self, *effects: Effect) -> None:
        """Add effects, to be carried out in this order."""
        self.effects.extend(effects)

    def build(self) -> Outcome:
        """Return the outcome as it is now."""
        return Outcome(tuple(self.events), tuple(self.effects), self.recording)
