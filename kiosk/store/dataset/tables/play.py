"""The tables of what was played: the cards as they lay, the flips, and the decisions about help."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from kiosk.assistant.mdp import Card, Outcome, Phase
from kiosk.store.dataset.column import Column, Kind, Table, Variable, named
from kiosk.store.dataset.stored.boards import Dealt, Flip, Hint, boards
from kiosk.store.dataset.stored.kept import Kept
from kiosk.store.dataset.tables.shared import (
    ACTION,
    AT,
    BOARD,
    COLUMN,
    FLIP,
    FOLLOWED,
    GATE,
    MOVE_CARD,
    PARTICIPANT,
    PICTURE,
    ROW,
    STAGE,
    columns,
)
from kiosk.study.events import AssistanceDecided


@dataclass(frozen=True)
class _Card:
    kept: Kept
    dealt: Dealt
    row: int
    column: int
    picture: str


@dataclass(frozen=True)
class _Flip:
    kept: Kept
    dealt: Dealt
    flip: Flip

    @property
    def hint(self) -> Hint | None:
        return self.dealt.hints.get(self.flip.event.number)


@dataclass(frozen=True)
class _Decision:
    kept: Kept
    dealt: Dealt
    event: AssistanceDecided


def _cards(kept: Kept) -> Iterator[_Card]:
    for dealt in boards(kept):
        for place, picture in enumerate(dealt.event.cards):
            yield _Card(kept, dealt, *divmod(place, dealt.event.columns), picture)


def _flips(kept: Kept) -> Iterator[_Flip]:
    for dealt in boards(kept):
        yield from (_Flip(kept, dealt, flip) for flip in dealt.flips.values())


def _decisions(kept: Kept) -> Iterator[_Decision]:
    for dealt in boards(kept):
        yield from (_Decision(kept, dealt, decision) for decision in dealt.decisions.values())


_CARD_COLUMNS: tuple[Column[_Card], ...] = columns(
    (PARTICIPANT, lambda row: row.kept.name),
    (BOARD, lambda row: row.dealt.number),
    (STAGE, lambda row: row.dealt.stage.value),
    (ROW, lambda row: row.row + 1),
    (COLUMN, lambda row: row.column + 1),
    (PICTURE, lambda row: row.picture),
)

CARDS = Table(
    "cards",
    "One row for every card of every board that was dealt: which picture lay where.",
    ("participant_id", "board", "row", "column"),
    _CARD_COLUMNS,
    _cards,
)

_FLIP_COLUMNS: tuple[Column[_Flip], ...] = columns(
    (PARTICIPANT, lambda row: row.kept.name),
    (BOARD, lambda row: row.dealt.number),
    (STAGE, lambda row: row.dealt.stage.value),
    (FLIP, lambda row: row.flip.event.number),
    (Variable("move", "The number of the move on this board, from 1.", Kind.WHOLE), lambda row: row.flip.event.move),
    (MOVE_CARD, lambda row: (Card.FIRST if row.flip.event.matched is None else Card.SECOND).value),
    (ROW, lambda row: row.flip.event.position.row + 1),
    (COLUMN, lambda row: row.flip.event.position.column + 1),
    (PICTURE, lambda row: row.flip.event.card),
    (
        Variable(
            "matched",
            "Whether the two cards of the move show the same picture.",
            Kind.TRUTH,
            empty="the flip was the first of its move",
        ),
        lambda row: row.flip.event.matched,
    ),
    (AT, lambda row: row.flip.event.at_ms),
    (
        Variable(
            "decision_ms",
            "How long the visitor took for the flip: since the board could be tapped (dealt, flipped before, turned "
            "back, or opened after a hint), less pauses.",
            Kind.WHOLE,
            "ms",
        ),
        lambda row: row.flip.decision_ms,
    ),
    (
        Variable("hinted", "Whether a hint had been given for this flip.", Kind.TRUTH),
        lambda row: row.hint is not None,
    ),
    (FOLLOWED, lambda row: None if row.hint is None else row.dealt.followed(row.hint)),
)

FLIPS = Table(
    "flips",
    "One row for every card that was turned up, in the practice and in the game.",
    ("participant_id", "board", "flip"),
    _FLIP_COLUMNS,
    _flips,
)

_DECISION_COLUMNS: tuple[Column[_Decision], ...] = columns(
    (PARTICIPANT, lambda row: row.kept.name),
    (BOARD, lambda row: row.dealt.number),
    (FLIP, lambda row: row.event.flip),
    (AT, lambda row: row.event.at_ms),
    (MOVE_CARD, lambda row: row.event.card.value),
    (
        Variable("phase", "How far the game was, in thirds of its pairs.", levels=named(Phase)),
        lambda row: row.event.game.name.lower(),
    ),
    (
        Variable("last_action", "The help that was chosen for the flip before.", levels=ACTION.levels),
        lambda row: row.event.last.label,
    ),
    (
        Variable(
            "outcome",
            "Which card of the move was coming, and whether the last completed move had matched.",
            levels=named(
                Outcome,
                f_correct="first card, after a match or before any move",
                f_wrong="first card, after a miss",
                s_correct="second card, after a match or before any move",
                s_wrong="second card, after a miss",
            ),
        ),
        lambda row: row.event.outcome.name.lower(),
    ),
    (GATE, lambda row: row.event.gate.name.lower()),
    (ACTION, lambda row: row.event.action.label),
)

DECISIONS = Table(
    "decisions",
    "One row for every decision about help, which is taken before every flip of the game: what the assistant's two "
    "layers saw, and what they chose. Where nobody helps there are none.",
    ("participant_id", "board", "flip"),
    _DECISION_COLUMNS,
    _decisions,
)
