"""What was played in a sitting, board by board, put together from its events."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from kiosk.store.dataset.stored.kept import Kept
from kiosk.study.after.measures import CARDS_IN_A_MOVE, followed
from kiosk.study.events import (
    AssistanceDecided,
    BoardDealt,
    BoardOpened,
    CardFlipped,
    HintGiven,
    HintMarked,
    PauseAsked,
    PauseEnded,
    Stage,
    Timer,
    TimerEnded,
)


@dataclass
class Hint:
    """A hint, when it was marked, and when the board opened again, in ms; None if that never came."""

    given: HintGiven
    marked_ms: int | None = None
    opened_ms: int | None = None


@dataclass(frozen=True)
class Flip:
    """A flip, and how long the visitor took for it while the board could be tapped, in ms."""

    event: CardFlipped
    decision_ms: int


@dataclass
class Dealt:
    """One board that was dealt; ``number`` counts from 1 in the sitting. What came before each flip goes by its number.

    The measures leave out all boards but the game's.
    """

    number: int
    stage: Stage
    event: BoardDealt
    flips: dict[int, Flip] = field(default_factory=dict)
    hints: dict[int, Hint] = field(default_factory=dict)
    decisions: dict[int, AssistanceDecided] = field(default_factory=dict)

    def followed(self, hint: Hint) -> bool | None:
        """Whether the flip that the hint was for went where it pointed; None if there was no such flip."""
        flip = self.flips.get(hint.given.flip)
        return None if flip is None else followed(hint.given, flip.event)

    def move_matched(self, flip: int) -> bool | None:
        """Whether the move of this flip ended in a match; None if it did not end."""
        last = self.flips.get(flip + flip % CARDS_IN_A_MOVE)
        return None if last is None else last.event.matched


class _Hand:
    """Since when the board could be tapped, less the pauses."""

    def __init__(self) -> None:
        self._since = 0
        self._paused_at: int | None = None

    def open(self, at_ms: int) -> None:
        self._since = at_ms

    def pause(self, at_ms: int) -> None:
        self._paused_at = at_ms

    def go_on(self, at_ms: int) -> None:
        if self._paused_at is not None:
            self._since += at_ms - max(self._paused_at, self._since)
        self._paused_at = None

    def spent(self, at_ms: int) -> int:
        return at_ms - self._since


def boards(kept: Kept) -> Iterator[Dealt]:
    """Every board of a sitting, in their order."""
    dealt: Dealt | None = None
    hand = _Hand()
    for record in kept.records:
        match record.event:
            case BoardDealt() as event:
                if dealt is not None:
                    yield dealt
                dealt = Dealt(dealt.number + 1 if dealt else 1, record.stage, event)
                hand.open(event.at_ms)
            case PauseAsked(at_ms=at_ms):
                hand.pause(at_ms)
            case PauseEnded(at_ms=at_ms):
                hand.go_on(at_ms)
            case _ if dealt is not None:
                _take(dealt, record.event, hand)
    if dealt is not None:
        yield dealt


def _take(dealt: Dealt, event: object, hand: _Hand) -> None:
    """Add what one event tells of a board."""
    match event:
        case CardFlipped(at_ms=at_ms, number=number):
            dealt.flips[number] = Flip(event, hand.spent(at_ms))
            hand.open(at_ms)
        case AssistanceDecided(flip=flip):
            dealt.decisions[flip] = event
        case HintGiven(flip=flip):
            dealt.hints[flip] = Hint(event)
        case HintMarked(at_ms=at_ms, flip=flip) if flip in dealt.hints:
            dealt.hints[flip].marked_ms = at_ms
        case BoardOpened(at_ms=at_ms) if dealt.hints:
            next(reversed(dealt.hints.values())).opened_ms = at_ms
            hand.open(at_ms)
        case TimerEnded(timer=Timer.TURN_BACK, at_ms=at_ms):
            hand.open(at_ms)
