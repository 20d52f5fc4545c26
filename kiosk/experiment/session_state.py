"""Read the events of a session once into its state, from which every number and table follows."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import field, replace
from enum import Enum
from itertools import islice
from typing import TypeVar

from kiosk.assistance.mentaliser import points_to
from kiosk.assistance.policy import ActionSpec
from kiosk.experiment.events import (
    AssistanceDecided,
    BackPressed,
    BoardDealt,
    BoardUnlocked,
    CardFlipped,
    CardSelected,
    ConsentGiven,
    EmbodimentChanged,
    EmbodimentName,
    Event,
    GameFinished,
    HesitationNoticed,
    HiddenItemsChanged,
    HintCue,
    HintGiven,
    HintHighlighted,
    InputDevice,
    LanguageSelected,
    MemoryEstimated,
    PauseEnded,
    PauseRequested,
    PracticeEnd,
    PracticeFinished,
    QuestionnairePageShown,
    RemarkGiven,
    ResponseGiven,
    RobotDisconnected,
    SentenceRepeated,
    SentenceRequested,
    SessionEnded,
    SessionResumed,
    SessionSetup,
    SessionStarted,
    SpeechCutShort,
    SpeechFailed,
    SpeechFinished,
    SpeechStarted,
    StageEntered,
    Timer,
    TimerExpired,
)
from kiosk.experiment.items import Answer, NotApplicable, Response
from kiosk.experiment.outcomes import CARDS_IN_A_MOVE, Stage, Status
from kiosk.game import Board
from kiosk.lazy_dataclass import dataclass


@dataclass(frozen=True)
class Interval:
    """A stretch of a session, in ms from its first event; ``until_ms`` is None while it lasts."""

    since_ms: int
    until_ms: int | None = None


def elapsed_ms(begin_ms: int, end_ms: int, without: Collection[Interval] = ()) -> int:
    """Measure the time between two moments in ms, less these intervals; where they overlap they count once."""
    spent, reached = end_ms - begin_ms, begin_ms
    if not without:
        return spent
    for interval in sorted(without, key=lambda each: each.since_ms):
        until_ms = end_ms if interval.until_ms is None else min(interval.until_ms, end_ms)
        spent -= max(0, until_ms - max(interval.since_ms, reached))
        reached = max(reached, until_ms)
    return spent


@dataclass(frozen=True)
class StageVisit:
    """A stage, and when it began, in ms; a stage that was resumed is there again."""

    stage: Stage
    at_ms: int


@dataclass(frozen=True)
class BoardFlip:
    """A flip; times in ms without pauses.

    ``decision_ms`` is how long the visitor took for it while the board could be tapped. ``exposure_ms`` is how long its
    card lay open, until it was turned back or its pair was found; None if neither came. ``device`` is what the visitor
    tapped it with; None if that is not known.
    """

    event: CardFlipped
    decision_ms: int
    exposure_ms: int | None = None
    device: InputDevice | None = None
    trace: tuple[tuple[int, float, float], ...] = ()
    """The way of the pointer since the tap before, as CardSelected has it."""


@dataclass(frozen=True)
class BoardHint:
    """A hint, when it was marked, and when the board opened again, in ms; None if that never came."""

    given: HintGiven
    marked_ms: int | None = None
    opened_ms: int | None = None

    @property
    def is_located(self) -> bool:
        """Whether it named a place; one that did not only reminds of its pair."""
        return (self.given.row, self.given.column) != (None, None)

    @property
    def level(self) -> float:
        """How much assistance it was; a reminder gives no place away, so it is none."""
        return self.given.action.level if self.is_located else ActionSpec.NO_HELP.level

    def followed_by(self, flip: CardFlipped) -> bool:
        """Tell whether a flip follows the hint.

        It goes where the hint points, or to a card that it reminds of.
        """
        given = self.given
        return points_to(given.row, given.column, flip.position) if self.is_located else flip.card == given.name


@dataclass(frozen=True)
class BoardRemark:
    """A remark, which points nowhere, and when the board opened again, in ms; None if that never came."""

    given: RemarkGiven
    opened_ms: int | None = None


@dataclass(frozen=True)
class DealtBoard:
    """One board that was dealt; flips, hints, remarks and decisions go by the number of the flip, from 1.

    ``number`` counts the boards of a session from 1. The measures leave out all boards but the game's.
    """

    number: int
    stage: Stage
    event: BoardDealt
    flips: Mapping[int, BoardFlip]
    hints: Mapping[int, BoardHint]
    decisions: Mapping[int, AssistanceDecided]
    remarks: Mapping[int, BoardRemark]
    memories: Mapping[int, MemoryEstimated] = field(default_factory=dict)
    hesitations: Mapping[int, HesitationNoticed] = field(default_factory=dict)

    @property
    def board(self) -> Board:
        """The cards as they lay."""
        return Board(self.event.rows, self.event.columns, self.event.cards)

    def action(self, flip: int) -> ActionSpec:
        """Return the help that a flip had: what was decided, or what hesitating led to."""
        helped = self.hesitations.get(flip) or self.decisions.get(flip)
        return helped.action if helped else ActionSpec.NO_HELP

    def followed(self, hint: BoardHint) -> bool | None:
        """Tell whether the flip that the hint was for went where it pointed; None if there was no such flip."""
        flip = self.flips.get(hint.given.flip)
        return None if flip is None else hint.followed_by(flip.event)

    def move_matched(self, flip: int) -> bool | None:
        """Tell whether the move of this flip ended in a match; None if it did not end."""
        last = self.flips.get(flip + flip % CARDS_IN_A_MOVE)
        return None if last is None else last.event.matched


class SentencePurpose(Enum):
    """What a sentence was for."""

    HINT = "hint"
    REMARK = "remark"
    SPEECH = "speech"
    REPEAT = "repeat"


@dataclass(frozen=True)
class SpeechAttempt:
    """One embodiment's attempt to say a sentence, in ms; what did not happen is None.

    ``embodiment`` is None where it helped from the start and nothing says which one it was. An attempt that neither
    finished nor failed was cut short: the visitor or a deadline went on, or the session ended.
    """

    embodiment: EmbodimentName | None
    at_ms: int
    started_ms: int | None = None
    finished_ms: int | None = None
    failed_ms: int | None = None
    cut_ms: int | None = None
    """When a tap ended it."""
    heard: SpeechStarted | None = None
    """What is known of the voice that said it."""


@dataclass(frozen=True)
class SpokenSentence:
    """A sentence, and every attempt to say it: a robot's that was lost, then the avatar's."""

    utterance: int
    purpose: SentencePurpose
    stage: Stage
    sentence: str
    attempts: tuple[SpeechAttempt, ...]


@dataclass(frozen=True)
class ItemResponse:
    """One item of a session; times in ms since its page was shown first, without pauses.

    ``response`` is None where nothing was answered, or nothing was left of it. ``first_ms`` and ``last_ms`` are the
    times of the first and the last answer, also of one that was taken back; None where there was none. ``changes``
    counts the answers that differ from the one before; the first is no change.
    """

    questionnaire: str
    item: str
    response: Response | None = None
    first_ms: int | None = None
    last_ms: int | None = None
    changes: int = 0
    hidden: bool = False
    """Whether the item's condition did not hold, so that it was not asked, or its answer was withdrawn."""

    @property
    def value(self) -> Answer | None:
        """The answer; None if there is none, also where the item does not apply."""
        return None if isinstance(self.response, NotApplicable) else self.response

    @property
    def does_not_apply(self) -> bool:
        """Whether the visitor said that the item does not apply."""
        return isinstance(self.response, NotApplicable)

    def answered(self, value: Response | None, after_ms: int) -> ItemResponse:
        """Add one more answer."""
        value = effective_answer(value)
        first = after_ms if self.first_ms is None else self.first_ms
        changed = self.first_ms is not None and value != self.response
        return replace(self, response=value, first_ms=first, last_ms=after_ms, changes=self.changes + changed)


def effective_answer(value: Response | None) -> Response | None:
    """Give an answer, or None for one that says nothing: an empty text, or none of the options."""
    return None if value in {"", ()} else value


@dataclass(frozen=True)
class SessionState:
    """What a session came to, from all its events.

    ``responses`` go by questionnaire and item, each since its stage began last; ``shown_items`` are the items of a
    questionnaire in the order in which they came. ``embodiment_changes`` are those within the session; which body helps
    after a resumption stands in ``resumptions``. A pause ends with whatever ends its session or goes on with it.
    ``status`` is how it ended; None while it has not, also where it went on after an interruption.
    """

    stages: tuple[StageVisit, ...]
    pauses: tuple[Interval, ...]
    boards: tuple[DealtBoard, ...]
    sentences: tuple[SpokenSentence, ...]
    responses: Mapping[tuple[str, str], ItemResponse]
    shown_items: Mapping[str, tuple[str, ...]]
    consent: ConsentGiven | None
    practice_end: PracticeEnd | None
    game_completed: bool
    embodiment_changes: tuple[EmbodimentChanged, ...]
    resumptions: tuple[SessionResumed, ...]
    status: Status | None
    setup: SessionSetup | None = None
    hidden_items: frozenset[tuple[str, str]] = frozenset()
    """The items that their conditions hid in the end, by questionnaire and item."""

    @classmethod
    def from_events(cls, events: Iterable[Event], embodiment: EmbodimentName | None = None) -> SessionState:
        """Read the events in their order; ``embodiment`` is the one that helped when the session began."""
        course, board, asked, speech = _Course(), _Boards(), _Responses(), _Speech(embodiment)
        stage = Stage.ATTRACT
        for event in events:
            if type(event) is StageEntered:
                stage = event.stage
            # Most events concern one part or none, and a day has a million of them.
            of_course, of_boards, of_responses, of_speech = _PARTS.get(type(event), _NO_PARTS)
            if of_course or course.status:
                course.take(event)
            if of_boards:
                board.take(event, stage, course.pauses)
            if of_responses or asked.goes_back:
                asked.take(event, course.pauses)
            if of_speech:
                speech.take(event, stage)
        return cls(
            stages=tuple(course.stages),
            pauses=tuple(course.pauses),
            boards=tuple(board.dealt),
            sentences=tuple(speech.sentences.values()),
            responses=asked.given,
            shown_items={asked: tuple(items) for asked, items in asked.shown.items()},
            consent=course.consent,
            practice_end=course.practice_end,
            game_completed=course.game_completed,
            embodiment_changes=tuple(course.embodiment_changes),
            resumptions=tuple(course.resumptions),
            status=course.status,
            setup=course.setup,
            hidden_items=asked.hidden,
        )

    @property
    def last_stage(self) -> Stage | None:
        """The stage that it is in, or was in last before its end; None if it never came to one."""
        return next((visit.stage for visit in reversed(self.stages) if visit.stage is not Stage.OVER), None)

    @property
    def input_devices(self) -> frozenset[InputDevice]:
        """What cards were turned with, on any board."""
        flips = (flip for dealt in self.boards for flip in dealt.flips.values())
        return frozenset(flip.device for flip in flips if flip.device is not None)

    @property
    def game(self) -> DealtBoard | None:
        """The board of the game; the practice's does not count. None if none was dealt."""
        return next((dealt for dealt in reversed(self.boards) if dealt.stage is Stage.GAME), None)


_OF_THE_COURSE: frozenset[type[Event]] = frozenset(
    {
        *(SessionStarted, StageEntered, ConsentGiven, PracticeFinished, GameFinished, EmbodimentChanged),
        *(SessionResumed, PauseRequested, PauseEnded, SessionEnded),
    }
)
_OF_BOARDS: frozenset[type[Event]] = frozenset(
    {
        CardSelected,
        BoardDealt,
        CardFlipped,
        TimerExpired,
        AssistanceDecided,
        MemoryEstimated,
        HesitationNoticed,
        HintGiven,
        RemarkGiven,
        HintHighlighted,
        BoardUnlocked,
    }
)
_OF_RESPONSES: frozenset[type[Event]] = frozenset(
    {StageEntered, HiddenItemsChanged, QuestionnairePageShown, ResponseGiven, BackPressed}
)
_SPEECH_REQUESTS: frozenset[type[Event]] = frozenset({HintGiven, RemarkGiven, SentenceRequested, SentenceRepeated})
_SPEECH_REPORTS: frozenset[type[Event]] = frozenset({SpeechStarted, SpeechFinished, SpeechFailed, SpeechCutShort})
_OF_SPEECH: frozenset[type[Event]] = frozenset(
    {
        *_SPEECH_REQUESTS,
        *_SPEECH_REPORTS,
        *(StageEntered, TimerExpired, BoardUnlocked, CardFlipped),
        *(RobotDisconnected, EmbodimentChanged, SessionResumed),
    }
)
"""Which events each part of the state takes notice of; the other ones cannot change it."""

_NO_PARTS = (False, False, False, False)
_PARTS: Mapping[type[Event], tuple[bool, bool, bool, bool]] = {
    kind: (kind in _OF_THE_COURSE, kind in _OF_BOARDS, kind in _OF_RESPONSES, kind in _OF_SPEECH)
    for kind in _OF_THE_COURSE | _OF_BOARDS | _OF_RESPONSES | _OF_SPEECH
}
"""Which parts an event concerns: the course, the boards, the responses, and the speech."""


_Kept = TypeVar("_Kept")
_AnyEvent = TypeVar("_AnyEvent", bound=Event | None)


def with_stages(events: Iterable[_AnyEvent]) -> Iterator[tuple[Stage, _AnyEvent]]:
    """Go through the events, each with the stage that it fell into; None is an event that cannot be read."""
    stage = Stage.ATTRACT
    for event in events:
        if isinstance(event, StageEntered):
            stage = event.stage
        yield stage, event


def language_before_flip(events: Iterable[Event], flip: int) -> str | None:
    """Return the changed language in which a flip (from 1) of the game was decided; else None."""
    language = None
    for stage, event in with_stages(events):
        match event:
            case LanguageSelected(language=chosen):
                language = chosen
            case AssistanceDecided(flip=number) | CardFlipped(number=number) if stage is Stage.GAME and number >= flip:
                break
    return language


class _Course:
    """How a session went on: its stages, pauses and changes, and how it ended."""

    def __init__(self) -> None:
        self.stages: list[StageVisit] = []
        self.pauses: list[Interval] = []
        self.embodiment_changes: list[EmbodimentChanged] = []
        self.resumptions: list[SessionResumed] = []
        self.consent: ConsentGiven | None = None
        self.practice_end: PracticeEnd | None = None
        self.game_completed = False
        self.status: Status | None = None
        self.setup: SessionSetup | None = None

    def take(self, event: Event) -> None:
        self.status = event.status if isinstance(event, SessionEnded) else None
        self._pause(event)
        match event:
            case SessionStarted(setup=setup):
                self.setup = setup
            case StageEntered(stage=stage, at_ms=at_ms):
                self.stages.append(StageVisit(stage, at_ms))
            case ConsentGiven() if self.consent is None:
                self.consent = event
            case PracticeFinished(how=how) if self.practice_end is None:
                self.practice_end = how
            case GameFinished():
                self.game_completed = True
            case EmbodimentChanged():
                self.embodiment_changes.append(event)
            case SessionResumed():
                self.resumptions.append(event)

    def _pause(self, event: Event) -> None:
        lasting = bool(self.pauses) and self.pauses[-1].until_ms is None
        match event:
            case PauseRequested(at_ms=at_ms) if not lasting:
                self.pauses.append(Interval(at_ms))
            case PauseEnded(at_ms=at_ms) | SessionEnded(at_ms=at_ms) | SessionResumed(at_ms=at_ms) if lasting:
                self.pauses[-1] = replace(self.pauses[-1], until_ms=at_ms)


def _with(one: _Kept, **changes: object) -> _Kept:
    """Return an object with other values; as dataclasses.replace, in a third of the time."""
    made = object.__new__(type(one))
    object.__setattr__(made, "__dict__", {**vars(one), **changes})
    return made


class _Boards:
    """The boards, and since when the last one can be tapped."""

    def __init__(self) -> None:
        self.dealt: list[DealtBoard] = []
        self._flips: dict[int, BoardFlip] = {}
        self._hints: dict[int, BoardHint] = {}
        self._decisions: dict[int, AssistanceDecided] = {}
        self._remarks: dict[int, BoardRemark] = {}
        self._memories: dict[int, MemoryEstimated] = {}
        self._hesitations: dict[int, HesitationNoticed] = {}
        self._open_since = 0
        self._tap: CardSelected | None = None
        """The last tap; a card is turned by the tap before."""

    def take(self, event: Event, stage: Stage, pauses: Collection[Interval]) -> None:
        # The kinds that come most often stand first: every case before one takes its time.
        match event:
            case CardSelected():
                self._tap = event
            case CardFlipped(at_ms=at_ms):
                self._flip(event, pauses)
                self._open_since = at_ms
            case BoardUnlocked(at_ms=at_ms):
                self._unlock(at_ms)
                self._open_since = at_ms
            case TimerExpired(timer=timer, at_ms=at_ms):
                if timer is Timer.TURN_BACK:
                    self._cover(at_ms, pauses)
                    self._open_since = at_ms
            case BoardDealt(at_ms=at_ms):
                self._deal(event, stage)
                self._open_since = at_ms
            case _:
                self._take_help(event)

    def _take_help(self, event: Event) -> None:
        match event:
            case AssistanceDecided(flip=flip):
                self._decisions[flip] = event
            case HintGiven(flip=flip):
                self._hints[flip] = BoardHint(event)
            case HintHighlighted(flip=flip, at_ms=at_ms) if flip in self._hints:
                self._hints[flip] = _with(self._hints[flip], marked_ms=at_ms)
            case MemoryEstimated(flip=flip):
                self._memories[flip] = event
            case HesitationNoticed(flip=flip):
                self._hesitations[flip] = event
            case RemarkGiven(flip=flip):
                self._remarks[flip] = BoardRemark(event)

    def _deal(self, event: BoardDealt, stage: Stage) -> None:
        self._flips, self._hints, self._decisions, self._remarks = {}, {}, {}, {}
        self._memories, self._hesitations = {}, {}
        number, helped = len(self.dealt) + 1, (self._hints, self._decisions, self._remarks)
        noticed = (self._memories, self._hesitations)
        self.dealt.append(DealtBoard(number, stage, event, self._flips, *helped, *noticed))

    def _flip(self, event: CardFlipped, pauses: Collection[Interval]) -> None:
        decision_ms = elapsed_ms(self._open_since, event.at_ms, pauses)
        device, trace = (self._tap.device, self._tap.trace) if self._tap else (None, ())
        self._flips[event.number] = BoardFlip(event, decision_ms, device=device, trace=trace)
        if event.matched:
            self._cover(event.at_ms, pauses)

    def _cover(self, at_ms: int, pauses: Collection[Interval]) -> None:
        """Note how long the cards of the last move lay open."""
        last = tuple(islice(reversed(self._flips.items()), CARDS_IN_A_MOVE))
        for number, flip in last:
            if flip.event.move == last[0][1].event.move:
                exposure_ms = elapsed_ms(flip.event.at_ms, at_ms, pauses)
                self._flips[number] = _with(flip, exposure_ms=exposure_ms)

    def _unlock(self, at_ms: int) -> None:
        """Note when the board opened again after the last hint or remark."""
        flip = max((*self._hints, *self._remarks), default=None)
        if flip in self._hints:
            self._hints[flip] = _with(self._hints[flip], opened_ms=at_ms)
        elif flip is not None:
            self._remarks[flip] = _with(self._remarks[flip], opened_ms=at_ms)


class _Responses:
    """What was answered in each stage since it was entered last, and what was shown."""

    def __init__(self) -> None:
        self.shown: dict[str, list[str]] = {}
        self._by_stage: dict[Stage, dict[tuple[str, str], ItemResponse]] = {}
        self._here: dict[tuple[str, str], ItemResponse] = {}
        self._questionnaire = ""
        self._shown_ms: dict[tuple[str, str], int] = {}
        self._shown_by_stage: dict[Stage, dict[tuple[str, str], int]] = {}
        self._hidden_by_stage: dict[Stage, dict[str, tuple[str, ...]]] = {}
        self._hidden: dict[str, tuple[str, ...]] = {}
        self.goes_back = False

    @property
    def hidden(self) -> frozenset[tuple[str, str]]:
        by_questionnaire = (pair for hidden in self._hidden_by_stage.values() for pair in hidden.items())
        return frozenset((questionnaire, item) for questionnaire, items in by_questionnaire for item in items)

    @property
    def given(self) -> dict[tuple[str, str], ItemResponse]:
        return {key: response for given in self._by_stage.values() for key, response in given.items()}

    def take(self, event: Event, pauses: Collection[Interval]) -> None:
        match event:
            case StageEntered(stage=stage):
                # A visitor who goes back finds the answers given there; a stage that begins anew has none.
                if not self.goes_back:
                    self._by_stage[stage], self._shown_by_stage[stage], self._hidden_by_stage[stage] = {}, {}, {}
                self._here = self._by_stage.setdefault(stage, {})
                self._shown_ms = self._shown_by_stage.setdefault(stage, {})
                self._hidden = self._hidden_by_stage.setdefault(stage, {})
                self._questionnaire = ""
            case HiddenItemsChanged(questionnaire=questionnaire, hidden=hidden, withdrawn=withdrawn):
                self._hidden[questionnaire] = hidden
                lost = {(questionnaire, item) for item in withdrawn} & self._here.keys()
                self._here |= {key: _with(self._here[key], response=None) for key in lost}
            case QuestionnairePageShown(questionnaire=questionnaire, items=items, at_ms=at_ms):
                self._questionnaire = questionnaire
                for item in items:
                    self._shown_ms.setdefault((questionnaire, item), at_ms)
                shown = self.shown.setdefault(questionnaire, [])
                shown += [item for item in items if item not in shown]
            case ResponseGiven(item=item, value=value, at_ms=at_ms):
                key = (self._questionnaire, item)
                after_ms = elapsed_ms(self._shown_ms.get(key, at_ms), at_ms, pauses)
                self._here[key] = self._here.get(key, ItemResponse(*key)).answered(value, after_ms)
        if not isinstance(event, StageEntered | QuestionnairePageShown):
            self.goes_back = isinstance(event, BackPressed)


class _Speech:
    """The sentences, and which of them is being said by which body."""

    def __init__(self, embodiment: EmbodimentName | None) -> None:
        self.sentences: dict[int, SpokenSentence] = {}
        self._embodiment = embodiment
        self._hinted_flip: int | None = None
        self._under_way: int | None = None
        self._broken_off: int | None = None
        self._trails: int | None = None
        """A sentence during which cards can be tapped already."""

    def take(self, event: Event, stage: Stage) -> None:
        kind = type(event)
        if kind in _SPEECH_REPORTS:
            self._report(event)
        elif kind in _SPEECH_REQUESTS:
            self._request(event, stage)
        else:
            self._end_or_begin_anew(event)

    def _end_or_begin_anew(self, event: Event) -> None:
        """Take what ends a sentence, or has it said by another body, without a word of the voice."""
        match event:
            case StageEntered() | TimerExpired(timer=Timer.SPEECH_DEADLINE):
                self._under_way = None
            case BoardUnlocked():
                self._trails = self._under_way
            case CardFlipped(number=flip) if flip == self._hinted_flip and self._under_way != self._trails:
                self._under_way = None
            case RobotDisconnected(at_ms=at_ms) if self._under_way is not None:
                self._broken_off = self._under_way
                self._fail(self._under_way, at_ms)
            case EmbodimentChanged(embodiment=embodiment, at_ms=at_ms):
                self._embodiment = embodiment
                self._say_again(at_ms)
            case SessionResumed(embodiment=embodiment):
                self._embodiment = embodiment

    def _request(self, event: Event, stage: Stage) -> None:
        match event:
            case HintGiven(cue=HintCue.GAZE):
                # Nothing is said.
                pass
            case HintGiven(utterance=number, sentence=sentence, flip=flip):
                self._hinted_flip = flip
                self._begin(number, SentencePurpose.HINT, stage, sentence, event.at_ms)
            case RemarkGiven(utterance=number, sentence=sentence, flip=flip):
                self._hinted_flip = flip
                self._begin(number, SentencePurpose.REMARK, stage, sentence, event.at_ms)
            case SentenceRequested(utterance=number, sentence=sentence):
                self._begin(number, SentencePurpose.SPEECH, stage, sentence, event.at_ms)
            case SentenceRepeated(utterance=number, of=before):
                sentence = self.sentences[before].sentence if before in self.sentences else ""
                self._begin(number, SentencePurpose.REPEAT, stage, sentence, event.at_ms)

    def _begin(self, number: int, purpose: SentencePurpose, stage: Stage, sentence: str, at_ms: int) -> None:
        attempts = (SpeechAttempt(self._embodiment, at_ms),)
        self.sentences[number] = SpokenSentence(number, purpose, stage, sentence, attempts)
        self._under_way = number

    def _report(self, event: Event) -> None:
        match event:
            case SpeechStarted(utterance=number, at_ms=at_ms) if number in self.sentences:
                self._set_last(number, _with(self._last(number), started_ms=at_ms, heard=event))
            case SpeechFinished(utterance=number, at_ms=at_ms) if number in self.sentences:
                self._set_last(number, _with(self._last(number), finished_ms=at_ms))
                self._stop(number)
            case SpeechFailed(utterance=number, at_ms=at_ms) if number in self.sentences:
                self._fail(number, at_ms)
            case SpeechCutShort(utterance=number, at_ms=at_ms) if number in self.sentences:
                self._set_last(number, _with(self._last(number), cut_ms=at_ms))
                self._stop(number)

    def _fail(self, number: int, at_ms: int) -> None:
        self._set_last(number, _with(self._last(number), failed_ms=at_ms))
        self._stop(number)

    def _stop(self, number: int) -> None:
        if self._under_way == number:
            self._under_way = None

    def _last(self, number: int) -> SpeechAttempt:
        return self.sentences[number].attempts[-1]

    def _set_last(self, number: int, attempt: SpeechAttempt) -> None:
        said = self.sentences[number]
        self.sentences[number] = _with(said, attempts=(*said.attempts[:-1], attempt))

    def _say_again(self, at_ms: int) -> None:
        """Begin anew with the sentence that was broken off, if one was."""
        number, self._broken_off = self._broken_off, None
        if number is not None:
            said = self.sentences[number]
            self.sentences[number] = _with(said, attempts=(*said.attempts, SpeechAttempt(self._embodiment, at_ms)))
            self._under_way = number
