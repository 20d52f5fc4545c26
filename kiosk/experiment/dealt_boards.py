"""The boards of a session, read from its events: flips, hints, remarks and decisions."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import field
from itertools import islice

from kiosk.assistance.mentaliser import points_to
from kiosk.assistance.policy import ActionSpec
from kiosk.experiment.events import (
    AssistanceDecided,
    BoardDealt,
    BoardUnlocked,
    CardFlipped,
    CardSelected,
    Event,
    HesitationNoticed,
    HintGiven,
    HintHighlighted,
    InputDevice,
    MemoryEstimated,
    RemarkGiven,
    Timer,
    TimerExpired,
)
from kiosk.experiment.intervals import Interval, elapsed_ms
from kiosk.experiment.outcomes import CARDS_IN_A_MOVE, Stage
from kiosk.game import Board
from kiosk.lazy_dataclass import dataclass, with_values

OF_BOARDS: frozenset[type[Event]] = frozenset(
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
"""The events that change the boards."""


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


class BoardsReader:
    """Reads events into boards; it knows since when the last one can be tapped."""

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
        """Read an event that fell into ``stage``, after these pauses."""
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
                self._hints[flip] = with_values(self._hints[flip], marked_ms=at_ms)
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
                self._flips[number] = with_values(flip, exposure_ms=exposure_ms)

    def _unlock(self, at_ms: int) -> None:
        """Note when the board opened again after the last hint or remark."""
        flip = max((*self._hints, *self._remarks), default=None)
        if flip in self._hints:
            self._hints[flip] = with_values(self._hints[flip], opened_ms=at_ms)
        elif flip is not None:
            self._remarks[flip] = with_values(self._remarks[flip], opened_ms=at_ms)
