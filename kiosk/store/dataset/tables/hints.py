"""The table of hints: what was said before which flip, why, and what came of it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from kiosk.assistant.hint import Reason
from kiosk.assistant.mdp import Action
from kiosk.store.dataset.column import Column, Kind, Table, Variable, named
from kiosk.store.dataset.stored.boards import Dealt, Hint, boards
from kiosk.store.dataset.stored.kept import Kept
from kiosk.store.dataset.tables.shared import (
    ACTION,
    BOARD,
    FLIP,
    FOLLOWED,
    GATE,
    MOVE_CARD,
    PARTICIPANT,
    PICTURE,
    SENTENCE,
    UTTERANCE,
    columns,
)
from kiosk.study.events import AssistanceDecided


@dataclass(frozen=True)
class _Hint:
    kept: Kept
    dealt: Dealt
    hint: Hint

    @property
    def decision(self) -> AssistanceDecided | None:
        return self.dealt.decisions.get(self.hint.given.flip)


def _hints(kept: Kept) -> Iterator[_Hint]:
    for dealt in boards(kept):
        yield from (_Hint(kept, dealt, hint) for hint in dealt.hints.values())


_HINT_COLUMNS: tuple[Column[_Hint], ...] = columns(
    (PARTICIPANT, lambda row: row.kept.name),
    (BOARD, lambda row: row.dealt.number),
    (FLIP, lambda row: row.hint.given.flip),
    (MOVE_CARD, lambda row: row.hint.given.card.value),
    (ACTION, lambda row: row.hint.given.action.label),
    (
        Variable(
            "level",
            "How much help that is: "
            + ", ".join(f"{action.level:g} for {action.label}" for action in Action)
            + "; assistance per flip is their sum over all flips.",
            Kind.NUMBER,
        ),
        lambda row: row.hint.given.action.level,
    ),
    (
        Variable("target_row", "The row of the card that was pointed at, from 1, told or not.", Kind.WHOLE),
        lambda row: row.hint.given.target.row + 1,
    ),
    (
        Variable("target_column", "The column of that card, from 1, told or not.", Kind.WHOLE),
        lambda row: row.hint.given.target.column + 1,
    ),
    (PICTURE, lambda row: row.hint.given.name),
    (
        Variable(
            "told_row", "The row that the visitor was told, from 1.", Kind.WHOLE, empty="the hint did not name a row"
        ),
        lambda row: None if row.hint.given.row is None else row.hint.given.row + 1,
    ),
    (
        Variable(
            "told_column",
            "The column that the visitor was told, from 1.",
            Kind.WHOLE,
            empty="the hint did not name a column",
        ),
        lambda row: None if row.hint.given.column is None else row.hint.given.column + 1,
    ),
    (
        Variable("seen", "How often the visitor had turned up the target before.", Kind.WHOLE),
        lambda row: row.hint.given.seen,
    ),
    (
        Variable("mate_seen", "How often the visitor had turned up the other card of its pair.", Kind.WHOLE),
        lambda row: row.hint.given.mate_seen,
    ),
    (
        Variable(
            "reason",
            "What the visitor's history gives as the reason; said only in conditions with an explanation.",
            levels=named(Reason),
        ),
        lambda row: row.hint.given.reason.value,
    ),
    (GATE, lambda row: None if row.decision is None else row.decision.gate.name.lower()),
    (SENTENCE, lambda row: row.hint.given.sentence),
    (UTTERANCE, lambda row: row.hint.given.utterance),
    (
        Variable("given_ms", "When the sentence came, from the sitting's first event.", Kind.WHOLE, "ms"),
        lambda row: row.hint.given.at_ms,
    ),
    (
        Variable(
            "marked_ms",
            "When the card, row or column was marked on the board, from the sitting's first event.",
            Kind.WHOLE,
            "ms",
            empty="the sitting ended before",
        ),
        lambda row: row.hint.marked_ms,
    ),
    (
        Variable(
            "opened_ms",
            "When cards could be tapped again, from the sitting's first event; the clock without speech stands still "
            "from the sentence until then.",
            Kind.WHOLE,
            "ms",
            empty="the sitting ended before",
        ),
        lambda row: row.hint.opened_ms,
    ),
    (FOLLOWED, lambda row: row.dealt.followed(row.hint)),
    (
        Variable(
            "move_matched",
            "Whether the move that the hint was for ended in a match.",
            Kind.TRUTH,
            empty="the move did not end",
        ),
        lambda row: row.dealt.move_matched(row.hint.given.flip),
    ),
)

HINTS = Table(
    "hints",
    "One row for every hint that was given.",
    ("participant_id", "board", "flip"),
    _HINT_COLUMNS,
    _hints,
)
