"""Read the events of a session once into its state, from which every number and table follows."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import TypeVar

from kiosk.experiment.dealt_boards import OF_BOARDS, BoardsReader, DealtBoard
from kiosk.experiment.events import (
    AssistanceDecided,
    CardFlipped,
    ConsentGiven,
    EmbodimentChanged,
    Event,
    GameFinished,
    InputDevice,
    LanguageSelected,
    PauseEnded,
    PauseRequested,
    PracticeEnd,
    PracticeFinished,
    SessionEnded,
    SessionResumed,
    SessionSetup,
    SessionStarted,
    StageEntered,
)
from kiosk.experiment.intervals import Interval
from kiosk.experiment.item_responses import OF_RESPONSES, ItemResponse, ResponsesReader
from kiosk.experiment.outcomes import EmbodimentName, Stage, Status
from kiosk.experiment.spoken_sentences import OF_SPEECH, SpeechReader, SpokenSentence
from kiosk.lazy_dataclass import dataclass


@dataclass(frozen=True)
class StageVisit:
    """A stage, and when it began, in ms; a stage that was resumed is there again."""

    stage: Stage
    at_ms: int


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
        course, board, asked, speech = _Course(), BoardsReader(), ResponsesReader(), SpeechReader(embodiment)
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
_NO_PARTS = (False, False, False, False)
_PARTS: Mapping[type[Event], tuple[bool, bool, bool, bool]] = {
    kind: (kind in _OF_THE_COURSE, kind in OF_BOARDS, kind in OF_RESPONSES, kind in OF_SPEECH)
    for kind in _OF_THE_COURSE | OF_BOARDS | OF_RESPONSES | OF_SPEECH
}
"""Which parts an event concerns: the course, the boards, the responses, and the speech."""


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
