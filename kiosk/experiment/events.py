"""What happened in a session, in the past tense; every event is written before its effect is shown.

World events come from outside and are what ``Session.handle`` takes. Session events are what the session concluded;
they follow from the world events, and are recorded beside them so that the data can be read without the program.
"""

from __future__ import annotations

from dataclasses import asdict
from enum import Enum
from typing import ClassVar

from kiosk.assistance.memory_model import MemoryEstimate
from kiosk.assistance.mentaliser import HintReason
from kiosk.assistance.policy import ActionSpec, FlipInMove, GateDecision, MoveOutcome, Phase
from kiosk.experiment.items import Response
from kiosk.experiment.outcomes import EmbodimentName, Stage, Status
from kiosk.game import FlipRejection, Position
from kiosk.lazy_dataclass import dataclass


class Timer(Enum):
    """Something that a session waits for; one that is started while it runs starts anew."""

    TURN_BACK = "turn_back"
    MARK = "mark"
    READING = "reading"
    SPEECH_DEADLINE = "speech_deadline"
    HOLD = "hold"
    MOOD = "mood"
    FINISH = "finish"
    PRACTICE = "practice"
    THANKS = "thanks"
    PAUSE = "pause"
    IDLE = "idle"
    STILL_THERE = "still_there"
    HESITATION = "hesitation"


class TextSize(Enum):
    """How large a visitor has the texts, in three steps."""

    NORMAL = "normal"
    LARGE = "large"
    LARGEST = "largest"


class PracticeEnd(Enum):
    """How the practice came to its end."""

    FOUND = "found"
    LEFT = "left"
    TIME = "time"


class FallbackReason(Enum):
    """Why another body than the one that was meant helps when a session begins."""

    CHOSEN = "chosen"
    """The experimenter chose the avatar."""
    SOUGHT = "sought"
    """The robot was still being looked for."""
    FAILED = "failed"
    """The robot was not found, or had failed."""


class HintCue(Enum):
    """How a hint is given."""

    WORDS = "words"
    """It is said; one that names a place is marked on the board as well."""
    GAZE = "gaze"
    """The helper looks toward the place, and says nothing."""


class RemarkTrigger(Enum):
    """What a remark came from."""

    DECISION = "decision"
    """The decision before the flip: an action of the table."""
    COMMENT = "comment"
    """The move before: praise for a pair, or encouragement after a miss."""


class InputDevice(Enum):
    """What a visitor used."""

    MOUSE = "mouse"
    TOUCH = "touch"
    PEN = "pen"
    KEYBOARD = "keyboard"


HOURS_IN_A_BAND = 4


@dataclass(frozen=True)
class SessionSetup:
    """What a session began with, besides what it follows.

    ``intended`` is the body that was meant. If another one helps, ``fallback`` says why, and ``detail`` what the
    robot's driver said. Sizes of the screen and the window are in pixels of the screen, ``screen_scale`` is how many
    of them the system counts as one, and millimetres are 0 where the screen does not tell them. ``hour_band`` is the
    hour of the day, local time, by four hours: 0 for 0 to 4 o'clock. ``visitors_before`` counts the stored sessions of
    the same kind and site that had begun on that day. Both are None where time is not that of a clock.
    """

    intended: EmbodimentName
    fallback: FallbackReason | None
    detail: str
    screen_width: int
    screen_height: int
    screen_scale: float
    screen_width_mm: int
    screen_height_mm: int
    window_width: int
    window_height: int
    hour_band: int | None = None
    visitors_before: int | None = None


@dataclass(frozen=True, kw_only=True)
class Event:
    """Anything that happened, ``at_ms`` milliseconds after the session's first event."""

    at_ms: int


@dataclass(frozen=True, kw_only=True)
class WorldEvent(Event):
    """Something that came from outside."""

    by_visitor: ClassVar[bool] = False
    """Whether it shows that a visitor is there."""


@dataclass(frozen=True, kw_only=True)
class SessionStarted(WorldEvent):
    """The visitor began; the session exists from here. ``setup`` is what it began with, where that was noted."""

    by_visitor = True
    setup: SessionSetup | None = None


@dataclass(frozen=True, kw_only=True)
class ContinuePressed(WorldEvent):
    """The visitor goes on to what comes next."""

    by_visitor = True


@dataclass(frozen=True, kw_only=True)
class BackPressed(WorldEvent):
    """The visitor goes back to the page before."""

    by_visitor = True


@dataclass(frozen=True, kw_only=True)
class StopPressed(WorldEvent):
    """The visitor stops the session, and has confirmed it."""

    by_visitor = True


@dataclass(frozen=True, kw_only=True)
class RepeatPressed(WorldEvent):
    """The visitor wants to hear the last sentence again."""

    by_visitor = True


@dataclass(frozen=True, kw_only=True)
class LanguageSelected(WorldEvent):
    """The visitor goes on in another language."""

    by_visitor = True
    language: str


@dataclass(frozen=True, kw_only=True)
class TextSizeSelected(WorldEvent):
    """The visitor makes all texts larger or smaller."""

    by_visitor = True
    size: TextSize


@dataclass(frozen=True, kw_only=True)
class SoundSelected(WorldEvent):
    """The visitor turns voice and sounds off, or on again; the text stays."""

    by_visitor = True
    on: bool


@dataclass(frozen=True, kw_only=True)
class ConsentPurposeToggled(WorldEvent):
    """The visitor set or took away the tick of one purpose of the consent."""

    by_visitor = True
    purpose: str
    ticked: bool


@dataclass(frozen=True, kw_only=True)
class ConsentSubmitted(WorldEvent):
    """The visitor agrees to what is ticked; it counts once every purpose that is required is."""

    by_visitor = True


@dataclass(frozen=True, kw_only=True)
class ConsentDeclined(WorldEvent):
    """The visitor wants to play without anything being stored."""

    by_visitor = True


@dataclass(frozen=True, kw_only=True)
class AgeConfirmed(WorldEvent):
    """The visitor said whether they are old enough for the study."""

    by_visitor = True
    adult: bool


@dataclass(frozen=True, kw_only=True)
class PracticeSkipped(WorldEvent):
    """The visitor leaves the practice early."""

    by_visitor = True


@dataclass(frozen=True, kw_only=True)
class CardSelected(WorldEvent):
    """The visitor tapped a card, whether or not it could be turned. ``device`` is what with, where that is known.

    ``trace`` is the way of the pointer since the tap before, where the visitor agreed to that: for each place how many
    ms before this tap, and where on the board, from 0 at its left and top, in cards.
    """

    by_visitor = True
    position: Position
    device: InputDevice | None = None
    trace: tuple[tuple[int, float, float], ...] = ()


@dataclass(frozen=True, kw_only=True)
class ResponseGiven(WorldEvent):
    """The visitor chose an answer to an item that is shown.

    The last one given counts, and None takes it back. Where the visitor said that the item does not apply, the value
    is the object ``{"not_applicable": true}``.
    """

    by_visitor = True
    item: str
    value: Response | None


@dataclass(frozen=True, kw_only=True)
class TypingActivity(WorldEvent):
    """The visitor is typing an answer; what it says is theirs until they are done. Told every few letters."""

    by_visitor = True


@dataclass(frozen=True, kw_only=True)
class UserActivity(WorldEvent):
    """The visitor scrolled, dragged, or moved the pointer, and did it last ``ago_ms`` milliseconds before.

    It is sent in place of the end of the idle time, or of a wait for hesitation, and so at most once in each.
    """

    by_visitor = True
    ago_ms: int


@dataclass(frozen=True, kw_only=True)
class PresenceConfirmed(WorldEvent):
    """The visitor is still there."""

    by_visitor = True


@dataclass(frozen=True, kw_only=True)
class TimerExpired(WorldEvent):
    """A wait that the session asked for is over."""

    timer: Timer


@dataclass(frozen=True, kw_only=True)
class SpeechStarted(WorldEvent):
    """The body began to say a sentence.

    For the avatar's voice it says what spoke: the engine or pack of clips, by the hash of all its clips, at which
    volume, and on which sound device. Of a robot's own voice nothing is known.
    """

    utterance: int
    engine: str = ""
    engine_version: str = ""
    voice: str = ""
    pack: str = ""
    device: str = ""
    volume: float | None = None


@dataclass(frozen=True, kw_only=True)
class SpeechFinished(WorldEvent):
    """The body has said the sentence to its end."""

    utterance: int


@dataclass(frozen=True, kw_only=True)
class SpeechFailed(WorldEvent):
    """The sentence will not be heard, or not to its end; it stays on the screen to be read."""

    utterance: int
    why: str


@dataclass(frozen=True, kw_only=True)
class RobotDisconnected(WorldEvent):
    """The robot that was helping cannot be counted on any more in this session."""

    why: str


@dataclass(frozen=True, kw_only=True)
class RepeatRequested(WorldEvent):
    """The experimenter wants the last sentence said again."""


@dataclass(frozen=True, kw_only=True)
class PauseRequested(WorldEvent):
    """The experimenter stops the session for a while; no clock of the game counts that time."""


@dataclass(frozen=True, kw_only=True)
class PauseEnded(WorldEvent):
    """The experimenter lets the session go on."""


@dataclass(frozen=True, kw_only=True)
class AbortRequested(WorldEvent):
    """The experimenter ends the session."""

    reason: str


@dataclass(frozen=True, kw_only=True)
class NextParticipantRequested(WorldEvent):
    """The experimenter gets ready for the next visitor, as this one is being thanked already."""


@dataclass(frozen=True, kw_only=True)
class MuteChanged(WorldEvent):
    """The experimenter made voice and sounds silent, or heard again; the text stays."""

    muted: bool


@dataclass(frozen=True, kw_only=True)
class SessionResumed(WorldEvent):
    """A session that was cut off goes on, from the start of its stage.

    ``embodiment`` helps from here on.
    """

    embodiment: EmbodimentName


@dataclass(frozen=True, kw_only=True)
class ApplicationClosed(WorldEvent):
    """The program is being closed in the middle of a session."""


@dataclass(frozen=True, kw_only=True)
class SessionEvent(Event):
    """Something that the session concluded."""


@dataclass(frozen=True, kw_only=True)
class StageEntered(SessionEvent):
    """The session went on to another stage."""

    stage: Stage


@dataclass(frozen=True, kw_only=True)
class ConsentGiven(SessionEvent):
    """The visitor agreed: to this text, by its version and hash, in this language, for these purposes."""

    version: str
    sha256: str
    language: str
    purposes: tuple[str, ...]


@dataclass(frozen=True, kw_only=True)
class QuestionnairePageShown(SessionEvent):
    """A page of a questionnaire came; response times count from here."""

    questionnaire: str
    items: tuple[str, ...]


@dataclass(frozen=True, kw_only=True)
class HiddenItemsChanged(SessionEvent):
    """The answers changed which items are hidden by their conditions.

    ``hidden`` are all that are hidden on the pages of the questionnaire up to the furthest that came; ``withdrawn`` are
    those that lost an answer by it.
    """

    questionnaire: str
    hidden: tuple[str, ...]
    withdrawn: tuple[str, ...] = ()


@dataclass(frozen=True, kw_only=True)
class SkippedItemsShown(SessionEvent):
    """Items that the visitor had left out were pointed out.

    Those that are not required may be left the next time.
    """

    items: tuple[str, ...]


@dataclass(frozen=True, kw_only=True)
class SentenceRequested(SessionEvent):
    """The body was asked to say a sentence that is no hint; a hint's sentence stands in HintGiven."""

    utterance: int
    sentence: str


@dataclass(frozen=True, kw_only=True)
class EmbodimentChanged(SessionEvent):
    """Another body helps from here on; the one at the start stands with the session."""

    embodiment: EmbodimentName
    why: str


@dataclass(frozen=True, kw_only=True)
class BoardDealt(SessionEvent):
    """A game began: the cards by name, row by row."""

    rows: int
    columns: int
    cards: tuple[str, ...]


@dataclass(frozen=True, kw_only=True)
class AssistanceDecided(SessionEvent):
    """Before flip number ``flip`` (from 1): what the two layers saw and how much help they chose.

    ``greedy`` is the action that gate and table come to, and ``probability`` that of the action taken, in this state
    and under this policy. Where it is below 1, the action was drawn (``randomised``).
    """

    flip: int
    card: FlipInMove
    game: Phase
    last: ActionSpec
    outcome: MoveOutcome
    gate: GateDecision
    action: ActionSpec
    greedy: ActionSpec
    probability: float
    randomised: bool


@dataclass(frozen=True, kw_only=True)
class MemoryEstimated(SessionEvent):
    """What the model of the visitor's memory held at the decision about flip number ``flip``.

    The fields are those of ``MemoryEstimate``; ``recall`` is in percent, for each place row by row.
    """

    flip: int
    forgetting: float
    match_recalled: float
    completes: float | None
    last_flip: float | None
    recall: tuple[int, ...]

    @classmethod
    def of(cls, estimate: MemoryEstimate, flip: int, at_ms: int) -> MemoryEstimated:
        """Return an estimate as it is recorded."""
        return cls(at_ms=at_ms, flip=flip, **asdict(estimate))

    @property
    def estimate(self) -> MemoryEstimate:
        """The estimate as the assistant had it."""
        return MemoryEstimate(self.forgetting, self.match_recalled, self.completes, self.last_flip, self.recall)


@dataclass(frozen=True, kw_only=True)
class HintGiven(SessionEvent):
    """A hint for flip number ``flip``.

    ``row`` and ``column`` are what it gave away, from 0; None where it did not. ``allowed`` counts the cards that the
    target rule could choose, each with the same chance: ``target_probability``. A look (``cue``) has no sentence, and
    its utterance is 0.
    """

    flip: int
    card: FlipInMove
    action: ActionSpec
    target: Position
    name: str
    seen: int
    mate_seen: int
    reason: HintReason
    allowed: int
    target_probability: float
    row: int | None
    column: int | None
    sentence: str
    utterance: int
    cue: HintCue = HintCue.WORDS


@dataclass(frozen=True, kw_only=True)
class HesitationNoticed(SessionEvent):
    """The visitor hesitated before flip number ``flip``, for which no help had been decided, and gets a hint.

    They had waited ``waited_ms``. From ``threshold_ms`` on they hesitate, which follows from ``usual_ms``, their own
    usual time for this card of a move.
    """

    flip: int
    card: FlipInMove
    waited_ms: int
    usual_ms: int
    threshold_ms: int
    action: ActionSpec


@dataclass(frozen=True, kw_only=True)
class RemarkGiven(SessionEvent):
    """Before flip number ``flip`` the assistant said something that points nowhere; it holds the board like a hint.

    ``trigger`` is what it came from, and ``probability`` the chance of a comment after such a move.
    """

    flip: int
    card: FlipInMove
    action: ActionSpec
    sentence: str
    utterance: int
    trigger: RemarkTrigger = RemarkTrigger.DECISION
    probability: float = 1.0


@dataclass(frozen=True, kw_only=True)
class HintHighlighted(SessionEvent):
    """The hint's card, row or column was marked on the board."""

    flip: int


@dataclass(frozen=True, kw_only=True)
class BoardUnlocked(SessionEvent):
    """Cards may be tapped again after a hint; from HintGiven until here the clock without speech stands still."""


@dataclass(frozen=True, kw_only=True)
class SpeechCutShort(SessionEvent):
    """The sentence of a hint was ended by the tap on the next card."""

    utterance: int


@dataclass(frozen=True, kw_only=True)
class CardSelectionRejected(SessionEvent):
    """A card was tapped that could not be turned."""

    position: Position
    why: FlipRejection | None
    """The rule that forbids it; None while the assistant speaks."""


@dataclass(frozen=True, kw_only=True)
class CardFlipped(SessionEvent):
    """A card was turned up; ``matched`` is None for the first card of a move; numbers count from 1."""

    number: int
    move: int
    position: Position
    card: str
    matched: bool | None


@dataclass(frozen=True, kw_only=True)
class PolicyUpdated(SessionEvent):
    """The table that went on learning during this game came out of it with this hash.

    The file is as it was.
    """

    sha256: str


@dataclass(frozen=True, kw_only=True)
class SentenceRepeated(SessionEvent):
    """The body was asked to say this sentence once more, under a new number."""

    of: int
    utterance: int


@dataclass(frozen=True, kw_only=True)
class PracticeFinished(SessionEvent):
    """The practice is over."""

    how: PracticeEnd


@dataclass(frozen=True, kw_only=True)
class GameFinished(SessionEvent):
    """Every pair was found and has been looked at."""


@dataclass(frozen=True, kw_only=True)
class QuestionnairesCompleted(SessionEvent):
    """The visitor went past the last page of this stage's questionnaires."""


@dataclass(frozen=True, kw_only=True)
class ThanksTimedOut(SessionEvent):
    """The thanks have been up long enough."""


@dataclass(frozen=True, kw_only=True)
class IdleTimedOut(SessionEvent):
    """The question whether the visitor is still there was not answered."""


@dataclass(frozen=True, kw_only=True)
class SessionEnded(SessionEvent):
    """The session is over; nothing of it follows, unless it is resumed."""

    status: Status
