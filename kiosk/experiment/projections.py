"""Fold the events of a session into what readers ask for: answers, scores, measures, speech."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import TypeVar

from kiosk.assistance.policy import Action, FlipInMove
from kiosk.experiment.events import (
    BoardUnlocked,
    CardFlipped,
    ConsentGiven,
    EmbodimentChanged,
    Event,
    GameFinished,
    HintGiven,
    PauseEnded,
    PauseRequested,
    QuestionnairePageShown,
    ResponseGiven,
    RobotDisconnected,
    SentenceRepeated,
    SentenceRequested,
    SessionEnded,
    SessionResumed,
    SpeechFailed,
    SpeechFinished,
    Stage,
    StageEntered,
    Status,
)
from kiosk.experiment.questionnaire import Answer, Questionnaire, Rating


@dataclass(frozen=True)
class ItemResponse:
    """One item of a session; times in ms since its page was shown, without pauses.

    ``value`` is None where nothing was answered, or nothing was left of it. ``first_ms`` and ``last_ms`` are the times
    of the first and the last answer, also of one that was taken back; None where there was none. ``changes`` counts
    the answers that differ from the one before; the first is no change.
    """

    questionnaire: str
    item: str
    value: Answer | None = None
    first_ms: int | None = None
    last_ms: int | None = None
    changes: int = 0

    def answered(self, value: Answer | None, after_ms: int) -> ItemResponse:
        """The same with one more answer."""
        value = effective_answer(value)
        first = after_ms if self.first_ms is None else self.first_ms
        changed = self.first_ms is not None and value != self.value
        return replace(self, value=value, first_ms=first, last_ms=after_ms, changes=self.changes + changed)


def effective_answer(value: Answer | None) -> Answer | None:
    """An answer, or None for one that says nothing: an empty text, or none of the options."""
    return None if value in {"", ()} else value


def item_responses(events: Iterable[Event], questionnaires: Sequence[Questionnaire]) -> tuple[ItemResponse, ...]:
    """What became of every item that can be answered, in the order in which they are declared."""
    given = {
        (answered.questionnaire, answered.item): answered
        for stage in _stages(events).values()
        for answered in stage.answered.values()
    }
    return tuple(
        given.get((asked.id, item.id), ItemResponse(asked.id, item.id))
        for asked in questionnaires
        for item in asked.questions
    )


@dataclass
class _Clock:
    """The time since a page was shown; it stands still while the session is paused."""

    begun_at: int = 0
    paused_at: int | None = None

    def show(self, at_ms: int) -> None:
        self.begun_at = at_ms
        if self.paused_at is not None:
            self.paused_at = at_ms

    def pause(self, at_ms: int) -> None:
        if self.paused_at is None:
            self.paused_at = at_ms

    def go_on(self, at_ms: int) -> None:
        if self.paused_at is not None:
            self.begun_at += at_ms - self.paused_at
            self.paused_at = None

    def since(self, at_ms: int) -> int:
        return (at_ms if self.paused_at is None else self.paused_at) - self.begun_at


@dataclass
class _Asked:
    """One stage, from its last beginning on: which questionnaire is shown, and what was answered."""

    questionnaire: str = ""
    answered: dict[tuple[str, str], ItemResponse] = field(default_factory=dict)

    def take(self, event: ResponseGiven, after_ms: int) -> None:
        """Add one answer to an item of the page that is shown."""
        key = (self.questionnaire, event.item)
        self.answered[key] = self.answered.get(key, ItemResponse(*key)).answered(event.value, after_ms)


def _stages(events: Iterable[Event]) -> dict[Stage, _Asked]:
    """What was answered in each stage since it was entered last."""
    stages: dict[Stage, _Asked] = {}
    here, clock = _Asked(), _Clock()
    for event in events:
        match event:
            case StageEntered(stage=stage):
                here = stages[stage] = _Asked()
            case QuestionnairePageShown(questionnaire=questionnaire):
                here.questionnaire = questionnaire
                clock.show(event.at_ms)
            case ResponseGiven():
                here.take(event, clock.since(event.at_ms))
            case PauseRequested():
                clock.pause(event.at_ms)
            case PauseEnded() | SessionResumed() | SessionEnded():
                clock.go_on(event.at_ms)
    return stages


@dataclass(frozen=True)
class ScaleScore:
    """One scale; reversed items are turned round (x becomes lowest + highest - x) before anything is added up.

    ``total`` is the sum, None unless all ``items`` are answered; ``mean`` is that of the answered ones, None if there
    is none.
    """

    questionnaire: str
    scale: str
    items: int
    answered: int
    total: int | None
    mean: float | None


def scale_scores(answers: Iterable[ItemResponse], questionnaires: Iterable[Questionnaire]) -> tuple[ScaleScore, ...]:
    """Every scale of these questionnaires, in the order in which they are declared."""
    values = {(answered.questionnaire, answered.item): answered.value for answered in answers}
    return tuple(
        _score(asked.id, scale, items, [values.get((asked.id, item.id)) for item in items])
        for asked in questionnaires
        for scale, items in asked.scales.items()
    )


def _score(questionnaire: str, scale: str, items: Sequence[Rating], values: Sequence[Answer | None]) -> ScaleScore:
    counted = [item.scored(value) for item, value in zip(items, values, strict=True) if isinstance(value, int)]
    return ScaleScore(
        questionnaire=questionnaire,
        scale=scale,
        items=len(items),
        answered=len(counted),
        total=sum(counted) if len(counted) == len(items) else None,
        mean=sum(counted) / len(counted) if counted else None,
    )


CARDS_IN_A_MOVE = 2


@dataclass(frozen=True)
class Measures:
    """Times in ms, shares from 0 to 1; None where there is nothing to divide by.

    ``flips`` and ``moves`` (two flips) are both kept and never compared with each other: the paper's simulations
    count moves, its results with people count flips. ``completion_ms`` is the player's own time from the first flip to
    the last match: it leaves out pauses, and the time from each hint until the board opens again. An explained hint
    takes about three times as long to say, so ``completion_with_speech_ms``, which leaves out pauses only, compares
    sentences rather than players. ``followed``: the flip
    after the hint is the hinted card, or lies in the hinted row or column, per hint. ``first_led_to_match``: first-card
    hints that were followed and whose move matched, per first-card hint.
    """

    flips: int = 0
    moves: int = 0
    pairs: int = 0
    hints: int = 0
    completion_ms: int = 0
    completion_with_speech_ms: int = 0
    assistance_per_flip: float | None = None
    followed: float | None = None
    first_followed: float | None = None
    first_led_to_match: float | None = None

    @property
    def per_match_ms(self) -> float | None:
        """Completion time per pair found, without speech."""
        return self.completion_ms / self.pairs if self.pairs else None

    @property
    def per_match_with_speech_ms(self) -> float | None:
        """Completion time per pair found, with speech."""
        return self.completion_with_speech_ms / self.pairs if self.pairs else None


def of_the_game(events: Iterable[Event]) -> Iterator[Event]:
    """The events of the game itself; a practice has cards and flips as well, and does not count."""
    in_game = False
    for event in events:
        if isinstance(event, StageEntered):
            in_game = event.stage is Stage.GAME
        if in_game:
            yield event


def measure(events: Iterable[Event]) -> Measures:
    """The measures of a session's game, finished or not; events of other stages do not matter."""
    events = tuple(of_the_game(events))
    flips = [event for event in events if isinstance(event, CardFlipped)]
    hints = [_Hinted.of(event, flips) for event in events if isinstance(event, HintGiven)]
    firsts = [hint for hint in hints if hint.given.card is FlipInMove.FIRST]
    matches = [flip for flip in flips if flip.matched]
    begin = flips[0].at_ms if flips else 0
    end = matches[-1].at_ms if matches else begin
    paused = tuple(_spans(events, PauseRequested, PauseEnded, end))
    held = tuple(_spans(events, HintGiven, BoardUnlocked, end))
    return Measures(
        flips=len(flips),
        moves=len(flips) // CARDS_IN_A_MOVE,
        pairs=len(matches),
        hints=len(hints),
        completion_ms=end - begin - _length((*paused, *held), begin, end),
        completion_with_speech_ms=end - begin - _length(paused, begin, end),
        assistance_per_flip=_share(sum(hint.given.action.level for hint in hints), len(flips)),
        followed=_share(sum(hint.followed for hint in hints), len(hints)),
        first_followed=_share(sum(hint.followed for hint in firsts), len(firsts)),
        first_led_to_match=_share(sum(hint.followed and hint.matched for hint in firsts), len(firsts)),
    )


@dataclass(frozen=True)
class _Hinted:
    """A hint and what became of it."""

    given: HintGiven
    followed: bool
    matched: bool

    @classmethod
    def of(cls, hint: HintGiven, flips: list[CardFlipped]) -> _Hinted:
        """Look up the flip that the hint was for, and the end of its move; neither need have come."""
        flip = next((flip for flip in flips if flip.number == hint.flip), None)
        move = (hint.flip + 1) // CARDS_IN_A_MOVE
        return cls(
            hint,
            followed=flip is not None and followed(hint, flip),
            matched=any(flip.matched for flip in flips if flip.move == move),
        )


def followed(hint: HintGiven, flip: CardFlipped) -> bool:
    """Whether this flip went where the hint pointed: to the card, or into the row or column."""
    if hint.action is Action.NO_HELP:
        return False
    return hint.row in (None, flip.position.row) and hint.column in (None, flip.position.column)


def _spans(events: Iterable[Event], starts: type[Event], ends: type[Event], last: int) -> Iterator[tuple[int, int]]:
    """From when to when it was between events of these two kinds, in ms; what never ends goes on to ``last``."""
    since = None
    for event in events:
        if isinstance(event, starts) and since is None:
            since = event.at_ms
        elif isinstance(event, ends) and since is not None:
            yield since, event.at_ms
            since = None
    if since is not None:
        yield since, last


def _length(spans: Iterable[tuple[int, int]], begin: int, end: int) -> int:
    """How long some spans are together between two times, what they share counted once, in ms."""
    total, reached = 0, begin
    for since, until in sorted(spans):
        total += max(0, min(until, end) - max(since, reached))
        reached = max(reached, until)
    return total


def _share(part: float, whole: int) -> float | None:
    return part / whole if whole else None


_Kind = TypeVar("_Kind", bound=Event)


@dataclass(frozen=True)
class StageVisit:
    """A stage, and when it began; a stage that was resumed stands there again. Time in ms."""

    stage: Stage
    at_ms: int


@dataclass(frozen=True)
class PauseInterval:
    """From when to when the experimenter stopped the session, in ms; ``until_ms`` is None while it lasts."""

    since_ms: int
    until_ms: int | None = None


@dataclass(frozen=True)
class SessionSummary:
    """What became of a session.

    ``last`` is the stage that it was in, or last in before its end; None if it never came to one. ``status`` is how it
    ended; None while it has not, also where it went on after an interruption. ``body_changes`` are those within the
    session; which body helps after a resumption stands in ``resumptions``. A pause ends with whatever ends its session
    or goes on with it.
    """

    entered: tuple[StageVisit, ...]
    last: Stage | None
    status: Status | None
    game_completed: bool
    consent: ConsentGiven | None
    body_changes: tuple[EmbodimentChanged, ...]
    pauses: tuple[PauseInterval, ...]
    resumptions: tuple[SessionResumed, ...]


def summarise_session(events: Iterable[Event]) -> SessionSummary:
    """See what became of a session."""
    events = tuple(events)
    entered = tuple(StageVisit(event.stage, event.at_ms) for event in _all(StageEntered, events))
    return SessionSummary(
        entered=entered,
        last=next((stage.stage for stage in reversed(entered) if stage.stage is not Stage.OVER), None),
        status=_status(events),
        game_completed=bool(_all(GameFinished, events)),
        consent=next(iter(_all(ConsentGiven, events)), None),
        body_changes=_all(EmbodimentChanged, events),
        pauses=_pauses(events),
        resumptions=_all(SessionResumed, events),
    )


def _all(kind: type[_Kind], events: Sequence[Event]) -> tuple[_Kind, ...]:
    return tuple(event for event in events if isinstance(event, kind))


def _status(events: Sequence[Event]) -> Status | None:
    last = events[-1] if events else None
    return last.status if isinstance(last, SessionEnded) else None


def _pauses(events: Sequence[Event]) -> tuple[PauseInterval, ...]:
    pauses: list[PauseInterval] = []
    for event in events:
        lasting = bool(pauses) and pauses[-1].until_ms is None
        match event:
            case PauseRequested() if not lasting:
                pauses.append(PauseInterval(event.at_ms))
            case PauseEnded() | SessionEnded() | SessionResumed() if lasting:
                pauses[-1] = replace(pauses[-1], until_ms=event.at_ms)
    return tuple(pauses)


@dataclass(frozen=True)
class SpeechCounts:
    """How many sentences were asked for, and what the embodiments made of them.

    Every sentence is either ``finished``, heard to its end, or ``shown_only``, left to be read in the bubble because
    its voice failed, or was cut short when the visitor or a deadline went on. ``failed`` counts those that some body
    failed to say; the avatar may still have finished them.
    """

    requested: int
    finished: int
    failed: int
    shown_only: int


def count_speech(events: Iterable[Event]) -> SpeechCounts:
    """Count the sentences of one session."""
    requested: set[int] = set()
    finished: set[int] = set()
    failed: set[int] = set()
    under_way: int | None = None
    for event in events:
        match event:
            case HintGiven(utterance=number) | SentenceRequested(utterance=number) | SentenceRepeated(utterance=number):
                requested.add(number)
                under_way = number
            case StageEntered() | BoardUnlocked():
                under_way = None
            case SpeechFinished(utterance=number):
                finished.add(number)
                under_way = None
            case SpeechFailed(utterance=number):
                failed.add(number)
            case RobotDisconnected() if under_way is not None:
                failed.add(under_way)
    return SpeechCounts(len(requested), len(finished), len(failed), len(requested - finished))


def count_embodiment_changes(events: Iterable[Event]) -> int:
    """How often another body had to help."""
    return sum(isinstance(event, EmbodimentChanged) for event in events)
