"""The measures of a game, from its events and nothing else: the screen, the export and the analysis all ask here."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from kiosk.assistant.mdp import Action, Card
from kiosk.study.events import (
    BoardOpened,
    CardFlipped,
    Event,
    HintGiven,
    PauseAsked,
    PauseEnded,
    Stage,
    StageEntered,
)

CARDS_IN_A_MOVE = 2


@dataclass(frozen=True)
class Measures:
    """Times in ms, shares from 0 to 1; None where there is nothing to divide by.

    ``flips`` and ``moves`` (two flips) are both kept and never compared with each other: the paper's simulations
    count moves, its results with people count flips. ``completion_ms`` runs from the first flip to the last match, but
    for pauses; the clock without speech stands still from a hint until the board opens again. ``followed``: the flip
    after the hint is the hinted card, or lies in the hinted row or column, per hint. ``first_led_to_match``: first-card
    hints that were followed and whose move matched, per first-card hint.
    """

    flips: int = 0
    moves: int = 0
    pairs: int = 0
    hints: int = 0
    completion_ms: int = 0
    completion_without_speech_ms: int = 0
    assistance_per_flip: float | None = None
    followed: float | None = None
    first_followed: float | None = None
    first_led_to_match: float | None = None

    @property
    def per_match_ms(self) -> float | None:
        """Completion time per pair found."""
        return self.completion_ms / self.pairs if self.pairs else None


def of_the_game(events: Iterable[Event]) -> Iterator[Event]:
    """The events of the game itself; a practice has cards and flips as well, and does not count."""
    in_game = False
    for event in events:
        if isinstance(event, StageEntered):
            in_game = event.stage is Stage.GAME
        if in_game:
            yield event


def measure(events: Iterable[Event]) -> Measures:
    """The measures of a sitting's game, finished or not; events of other stages do not matter."""
    events = tuple(of_the_game(events))
    flips = [event for event in events if isinstance(event, CardFlipped)]
    hints = [_Hinted.of(event, flips) for event in events if isinstance(event, HintGiven)]
    firsts = [hint for hint in hints if hint.given.card is Card.FIRST]
    matches = [flip for flip in flips if flip.matched]
    begin = flips[0].at_ms if flips else 0
    end = matches[-1].at_ms if matches else begin
    paused = tuple(_spans(events, PauseAsked, PauseEnded, end))
    held = tuple(_spans(events, HintGiven, BoardOpened, end))
    return Measures(
        flips=len(flips),
        moves=len(flips) // CARDS_IN_A_MOVE,
        pairs=len(matches),
        hints=len(hints),
        completion_ms=end - begin - _length(paused, begin, end),
        completion_without_speech_ms=end - begin - _length((*paused, *held), begin, end),
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
