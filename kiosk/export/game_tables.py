"""The tables of the boards: cards, flips, and the ways of the pointer."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from kiosk.assistance.policy import FlipInMove
from kiosk.experiment.dealt_boards import BoardFlip, BoardHint, DealtBoard
from kiosk.experiment.events import InputDevice
from kiosk.export.columns import (
    AT,
    BOARD,
    COLUMN,
    FLIP,
    FOLLOWED,
    MOVE_CARD,
    PARTICIPANT,
    PICTURE,
    ROW,
    STAGE,
    Column,
    ColumnKind,
    Table,
    Variable,
    enum_levels,
    make_columns,
)
from kiosk.store.session_records import SessionRecord


@dataclass(frozen=True)
class _Card:
    kept: SessionRecord
    dealt: DealtBoard
    row: int
    column: int
    picture: str


@dataclass(frozen=True)
class _Flip:
    kept: SessionRecord
    dealt: DealtBoard
    flip: BoardFlip

    @property
    def hint(self) -> BoardHint | None:
        return self.dealt.hints.get(self.flip.event.number)


def _cards(kept: SessionRecord) -> Iterator[_Card]:
    for dealt in kept.state.boards:
        for place, picture in enumerate(dealt.event.cards):
            yield _Card(kept, dealt, *divmod(place, dealt.event.columns), picture)


def _flips(kept: SessionRecord) -> Iterator[_Flip]:
    for dealt in kept.state.boards:
        yield from (_Flip(kept, dealt, flip) for flip in dealt.flips.values())


_CARD_COLUMNS: tuple[Column[_Card], ...] = make_columns(
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

_FLIP_COLUMNS: tuple[Column[_Flip], ...] = make_columns(
    (PARTICIPANT, lambda row: row.kept.name),
    (BOARD, lambda row: row.dealt.number),
    (STAGE, lambda row: row.dealt.stage.value),
    (FLIP, lambda row: row.flip.event.number),
    (
        Variable("move", "The number of the move on this board, from 1.", ColumnKind.WHOLE),
        lambda row: row.flip.event.move,
    ),
    (MOVE_CARD, lambda row: (FlipInMove.FIRST if row.flip.event.matched is None else FlipInMove.SECOND).value),
    (ROW, lambda row: row.flip.event.position.row + 1),
    (COLUMN, lambda row: row.flip.event.position.column + 1),
    (PICTURE, lambda row: row.flip.event.card),
    (
        Variable(
            "matched",
            "Whether the two cards of the move show the same picture.",
            ColumnKind.TRUTH,
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
            ColumnKind.WHOLE,
            "ms",
        ),
        lambda row: row.flip.decision_ms,
    ),
    (
        Variable(
            "exposure_ms",
            "How long the card lay open: from its flip until it was turned back or its pair was found, less pauses. "
            "The time that a hint for the second card holds the board is in it.",
            ColumnKind.WHOLE,
            "ms",
            empty="the board ended before",
        ),
        lambda row: row.flip.exposure_ms,
    ),
    (
        Variable(
            "input_device",
            "What the visitor tapped the card with.",
            levels=enum_levels(InputDevice),
            empty="it was not noted",
        ),
        lambda row: row.flip.device.value if row.flip.device else None,
    ),
    (
        Variable("hinted", "Whether a hint had been given for this flip.", ColumnKind.TRUTH),
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


@dataclass(frozen=True)
class _Place:
    kept: SessionRecord
    dealt: DealtBoard
    flip: BoardFlip
    number: int

    @property
    def place(self) -> tuple[int, float, float]:
        return self.flip.trace[self.number - 1]


def _places(kept: SessionRecord) -> Iterator[_Place]:
    for row in _flips(kept):
        yield from (_Place(kept, row.dealt, row.flip, number) for number, _ in enumerate(row.flip.trace, 1))


_POINTER_COLUMNS: tuple[Column[_Place], ...] = make_columns(
    (PARTICIPANT, lambda row: row.kept.name),
    (BOARD, lambda row: row.dealt.number),
    (FLIP, lambda row: row.flip.event.number),
    (
        Variable("pointer_place", "The number of the place on the way to this flip, from 1.", ColumnKind.WHOLE),
        lambda row: row.number,
    ),
    (
        Variable("pointer_ms", "When the pointer was there, from the session's first event.", ColumnKind.WHOLE, "ms"),
        lambda row: row.flip.event.at_ms - row.place[0],
    ),
    (
        Variable(
            "pointer_x", "Where it was, in cards from the left edge of the board (0).", ColumnKind.NUMBER, "cards"
        ),
        lambda row: row.place[1],
    ),
    (
        Variable("pointer_y", "The same from its upper edge.", ColumnKind.NUMBER, "cards"),
        lambda row: row.place[2],
    ),
)

POINTER_TRACES = Table(
    "pointer",
    "One row for every place of the pointer on its way to a card, at most 30 a second while it moved and the last 900 "
    "before each flip, of visitors who agreed to that.",
    (PARTICIPANT.name, BOARD.name, FLIP.name, "pointer_place"),
    _POINTER_COLUMNS,
    _places,
)
