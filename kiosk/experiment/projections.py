"""Derive the numbers of a session from its state: responses, scores of scales, measures of the game, speech."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from kiosk.assistance.policy import FlipInMove
from kiosk.experiment.events import Event
from kiosk.experiment.intervals import Interval, elapsed_ms
from kiosk.experiment.item_responses import ItemResponse
from kiosk.experiment.items import Rating
from kiosk.experiment.outcomes import CARDS_IN_A_MOVE
from kiosk.experiment.questionnaire import (
    Questionnaire,
)
from kiosk.experiment.session_state import SessionState
from kiosk.lazy_dataclass import dataclass


def item_responses(state: SessionState, questionnaires: Sequence[Questionnaire]) -> tuple[ItemResponse, ...]:
    """Tell what became of every item that can be answered, in the order in which they are declared."""
    return tuple(
        replace(state.responses.get(key, ItemResponse(*key)), hidden=key in state.hidden_items)
        for asked in questionnaires
        for item in asked.questions
        for key in [(asked.id, item.id)]
    )


@dataclass(frozen=True)
class ScaleScore:
    """One scale; reversed items are turned round (x becomes lowest + highest - x) before anything is added up.

    ``total`` is the sum, None unless all ``items`` are answered; ``mean`` is that of the ``answered`` ones, None if
    they are fewer than ``needed``. Items that the visitor said do not apply are not among the answered ones; they are
    counted as ``not_applicable``. So are those that their condition hid, as ``hidden``.
    """

    questionnaire: str
    scale: str
    items: int
    answered: int
    not_applicable: int
    needed: int
    total: int | None
    mean: float | None
    hidden: int = 0


def scale_scores(answers: Iterable[ItemResponse], questionnaires: Iterable[Questionnaire]) -> tuple[ScaleScore, ...]:
    """Every scale of these questionnaires, in the order in which they are declared."""
    responses = {(answered.questionnaire, answered.item): answered for answered in answers}
    return tuple(
        _score(asked, scale, items, [responses.get((asked.id, item.id)) for item in items])
        for asked in questionnaires
        for scale, items in asked.scales.items()
    )


def _score(
    questionnaire: Questionnaire, scale: str, items: Sequence[Rating], responses: Sequence[ItemResponse | None]
) -> ScaleScore:
    given = [(item, response) for item, response in zip(items, responses, strict=True) if response is not None]
    counted = [item.scored(response.value) for item, response in given if isinstance(response.value, int)]
    needed = questionnaire.needed(scale)
    return ScaleScore(
        questionnaire=questionnaire.id,
        scale=scale,
        items=len(items),
        answered=len(counted),
        not_applicable=sum(response.does_not_apply for _, response in given),
        hidden=sum(response.hidden for _, response in given),
        needed=needed,
        total=sum(counted) if len(counted) == len(items) else None,
        mean=sum(counted) / len(counted) if len(counted) >= needed else None,
    )


@dataclass(frozen=True)
class Measures:
    """Times in ms, shares from 0 to 1; None where there is nothing to divide by.

    ``flips`` and ``moves`` (two flips) are both kept and never compared with each other: the paper's simulations
    count moves, its results with people count flips. ``completion_ms`` is the player's own time from the first flip to
    the last match: it leaves out pauses, and the time from each hint until the board opens again. An explained hint
    takes about three times as long to say, so ``completion_with_speech_ms``, which leaves out pauses only, compares
    sentences rather than players. ``followed``: the flip
    after the hint is the hinted card, or lies in the hinted row or column, per hint; after a hint that names no place,
    it is a card of the pair that the hint reminds of. ``first_led_to_match``: first-card
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


def measure(events: Iterable[Event]) -> Measures:
    """Measure a session's game from its events, finished or not; those of other stages do not matter."""
    return measure_game(SessionState.from_events(events))


def measure_game(state: SessionState) -> Measures:
    """Measure a session's game, finished or not."""
    game = state.game
    if game is None:
        return Measures()
    flips = [flip.event for flip in game.flips.values()]
    hints = tuple(game.hints.values())
    firsts = [hint for hint in hints if hint.given.card is FlipInMove.FIRST]
    matches = [flip for flip in flips if flip.matched]
    begin = flips[0].at_ms if flips else 0
    end = matches[-1].at_ms if matches else begin
    held = [Interval(hint.given.at_ms, hint.opened_ms) for hint in hints]
    held += [Interval(remark.given.at_ms, remark.opened_ms) for remark in game.remarks.values()]
    led = [hint for hint in firsts if game.followed(hint) and game.move_matched(hint.given.flip)]
    return Measures(
        flips=len(flips),
        moves=len(flips) // CARDS_IN_A_MOVE,
        pairs=len(matches),
        hints=len(hints),
        completion_ms=elapsed_ms(begin, end, (*state.pauses, *held)),
        completion_with_speech_ms=elapsed_ms(begin, end, state.pauses),
        assistance_per_flip=_share(sum(hint.level for hint in hints), len(flips)),
        followed=_share(sum(game.followed(hint) is True for hint in hints), len(hints)),
        first_followed=_share(sum(game.followed(hint) is True for hint in firsts), len(firsts)),
        first_led_to_match=_share(len(led), len(firsts)),
    )


@dataclass(frozen=True)
class WaitingShares:
    """The share, from 0 to 1, of a game in which taps on cards wait.

    They wait for a hint's sentence, and for cards to turn back.

    The game is from the moment its board was dealt to the last match, without pauses.
    """

    hint: float
    turning_back: float


def waiting_shares(state: SessionState) -> WaitingShares | None:
    """Measure how long taps waited in a game that was finished; None for any other."""
    game = state.game
    if game is None or not state.game_completed:
        return None
    begin = game.event.at_ms
    end = max(flip.event.at_ms for flip in game.flips.values() if flip.event.matched)
    whole = elapsed_ms(begin, end, state.pauses)
    held = [(hint.given.at_ms, hint.opened_ms) for hint in game.hints.values()]
    held += [(remark.given.at_ms, remark.opened_ms) for remark in game.remarks.values()]
    hints = sum(elapsed_ms(begun, end if opened is None else opened, state.pauses) for begun, opened in held)
    missed = sum(flip.exposure_ms or 0 for flip in game.flips.values() if flip.event.matched is False)
    return WaitingShares(hints / whole, missed / whole)


def _share(part: float, whole: int) -> float | None:
    return part / whole if whole else None


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


def count_speech(state: SessionState) -> SpeechCounts:
    """Count the sentences of one session."""
    requested = len(state.sentences)
    finished = sum(any(each.finished_ms is not None for each in said.attempts) for said in state.sentences)
    failed = sum(any(each.failed_ms is not None for each in said.attempts) for said in state.sentences)
    return SpeechCounts(requested, finished, failed, requested - finished)
