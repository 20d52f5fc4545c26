"""The tables of help that was given in the game: hints and remarks."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from enum import Enum

from kiosk.assistance.mentaliser import HintReason
from kiosk.assistance.policy import ACTIONS
from kiosk.experiment.dealt_boards import BoardHint, BoardRemark, DealtBoard
from kiosk.experiment.events import AssistanceDecided, HesitationNoticed, HintCue, RemarkTrigger
from kiosk.export.columns import (
    ACTION,
    AT,
    BOARD,
    FLIP,
    FOLLOWED,
    GATE,
    MOVE_CARD,
    PARTICIPANT,
    PICTURE,
    SENTENCE,
    UTTERANCE,
    Column,
    ColumnKind,
    Table,
    Variable,
    enum_levels,
    make_columns,
)
from kiosk.store.session_records import SessionRecord


class HintTrigger(Enum):
    """What a hint came from."""

    DECISION = "decision"
    HESITATION = "hesitation"


@dataclass(frozen=True)
class _Hint:
    kept: SessionRecord
    dealt: DealtBoard
    hint: BoardHint

    @property
    def decision(self) -> AssistanceDecided | None:
        return self.dealt.decisions.get(self.hint.given.flip)

    @property
    def hesitation(self) -> HesitationNoticed | None:
        return self.dealt.hesitations.get(self.hint.given.flip)

    @property
    def trigger(self) -> HintTrigger:
        return HintTrigger.HESITATION if self.hesitation else HintTrigger.DECISION


def _hints(kept: SessionRecord) -> Iterator[_Hint]:
    dealt = kept.state.game
    if dealt is not None:
        yield from (_Hint(kept, dealt, hint) for hint in dealt.hints.values())


_HINT_COLUMNS: tuple[Column[_Hint], ...] = make_columns(
    (PARTICIPANT, lambda row: row.kept.name),
    (BOARD, lambda row: row.dealt.number),
    (FLIP, lambda row: row.hint.given.flip),
    (MOVE_CARD, lambda row: row.hint.given.card.value),
    (ACTION, lambda row: row.hint.given.action.label),
    (
        Variable(
            "level",
            "How much help that is: "
            + ", ".join(f"{action.level:g} for {action.label}" for action in ACTIONS)
            + "; 0 for a hint that named no place. Assistance per flip is their sum over all flips.",
            ColumnKind.NUMBER,
        ),
        lambda row: row.hint.level,
    ),
    (
        Variable("target_row", "The row of the card that the hint was about, from 1, told or not.", ColumnKind.WHOLE),
        lambda row: row.hint.given.target.row + 1,
    ),
    (
        Variable("target_column", "The column of that card, from 1, told or not.", ColumnKind.WHOLE),
        lambda row: row.hint.given.target.column + 1,
    ),
    (PICTURE, lambda row: row.hint.given.name),
    (
        Variable(
            "told_row",
            "The row that the visitor was told, from 1.",
            ColumnKind.WHOLE,
            empty="the hint did not name a row",
        ),
        lambda row: None if row.hint.given.row is None else row.hint.given.row + 1,
    ),
    (
        Variable(
            "told_column",
            "The column that the visitor was told, from 1.",
            ColumnKind.WHOLE,
            empty="the hint did not name a column",
        ),
        lambda row: None if row.hint.given.column is None else row.hint.given.column + 1,
    ),
    (
        Variable("seen", "How often the visitor had turned up the target before.", ColumnKind.WHOLE),
        lambda row: row.hint.given.seen,
    ),
    (
        Variable("mate_seen", "How often the visitor had turned up the other card of its pair.", ColumnKind.WHOLE),
        lambda row: row.hint.given.mate_seen,
    ),
    (
        Variable(
            "reason",
            "What the visitor's history gives as the reason; said only in conditions with an explanation.",
            levels=enum_levels(HintReason),
        ),
        lambda row: row.hint.given.reason.value,
    ),
    (
        Variable("allowed_cards", "How many cards the target rule could point at.", ColumnKind.WHOLE),
        lambda row: row.hint.given.allowed,
    ),
    (
        Variable(
            "target_probability",
            "The probability with which the rule points at this card: one in the number of cards that it allowed.",
            ColumnKind.NUMBER,
        ),
        lambda row: row.hint.given.target_probability,
    ),
    (GATE, lambda row: None if row.decision is None else row.decision.gate.name.lower()),
    (SENTENCE, lambda row: row.hint.given.sentence or None),
    (UTTERANCE, lambda row: row.hint.given.utterance or None),
    (
        Variable("given_ms", "When the sentence came, from the session's first event.", ColumnKind.WHOLE, "ms"),
        lambda row: row.hint.given.at_ms,
    ),
    (
        Variable(
            "marked_ms",
            "When the card, row or column was marked on the board, from the session's first event.",
            ColumnKind.WHOLE,
            "ms",
            empty="the session ended before, or the hint named no place",
        ),
        lambda row: row.hint.marked_ms,
    ),
    (
        Variable(
            "opened_ms",
            "When cards could be tapped again, from the session's first event; the clock without speech stands still "
            "from the sentence until then.",
            ColumnKind.WHOLE,
            "ms",
            empty="the session ended before",
        ),
        lambda row: row.hint.opened_ms,
    ),
    (
        Variable(
            "hold_ms",
            "How long the hint held the board: from its sentence until cards could be tapped again, pauses included.",
            ColumnKind.WHOLE,
            "ms",
            empty="the session ended before",
        ),
        lambda row: None if row.hint.opened_ms is None else row.hint.opened_ms - row.hint.given.at_ms,
    ),
    (FOLLOWED, lambda row: row.dealt.followed(row.hint)),
    (
        Variable(
            "move_matched",
            "Whether the move that the hint was for ended in a match.",
            ColumnKind.TRUTH,
            empty="the move did not end",
        ),
        lambda row: row.dealt.move_matched(row.hint.given.flip),
    ),
)

_TRIGGERS: tuple[Column[_Hint], ...] = make_columns(
    (
        Variable(
            "trigger",
            "What the hint came from.",
            levels=enum_levels(
                HintTrigger,
                decision="the decision before the flip",
                hesitation="the visitor waited longer than they usually do",
            ),
        ),
        lambda row: row.trigger.value,
    ),
    (
        Variable(
            "waited_ms",
            "How long the visitor had waited when a hint came because they hesitated.",
            ColumnKind.WHOLE,
            "ms",
            empty="the hint came from the decision before the flip",
        ),
        lambda row: row.hesitation.waited_ms if row.hesitation else None,
    ),
    (
        Variable(
            "usual_ms",
            "The visitor's own usual time for this card of a move, by then.",
            ColumnKind.WHOLE,
            "ms",
            empty="the hint came from the decision before the flip",
        ),
        lambda row: row.hesitation.usual_ms if row.hesitation else None,
    ),
)

_CUES: tuple[Column[_Hint], ...] = make_columns(
    (
        Variable(
            "cue",
            "How the hint was given.",
            levels=enum_levels(
                HintCue,
                words="it was said, and one that named a place was marked on the board",
                gaze="the helper looked toward the place and said nothing; its sentence and marked_ms are empty",
            ),
        ),
        lambda row: row.hint.given.cue.value,
    ),
)

HINTS = Table(
    "hints",
    "One row for every hint that was given in the game. Those of the practice stand in the table sentences.",
    ("participant_id", "board", "flip"),
    _HINT_COLUMNS,
    _hints,
)


def hints_table(*, triggered: bool, looks: bool) -> Table[SessionRecord, _Hint]:
    """Return the table of hints of a study.

    ``triggered``: visitors who hesitate get some; ``looks``: some are without words.
    """
    columns = (*_HINT_COLUMNS, *(_TRIGGERS if triggered else ()), *(_CUES if looks else ()))
    return replace(HINTS, columns=columns)


@dataclass(frozen=True)
class _Remark:
    kept: SessionRecord
    dealt: DealtBoard
    remark: BoardRemark


def _remarks(kept: SessionRecord) -> Iterator[_Remark]:
    dealt = kept.state.game
    if dealt is not None:
        yield from (_Remark(kept, dealt, remark) for remark in dealt.remarks.values())


_REMARK_COLUMNS: tuple[Column[_Remark], ...] = make_columns(
    (PARTICIPANT, lambda row: row.kept.name),
    (BOARD, lambda row: row.dealt.number),
    (FLIP, lambda row: row.remark.given.flip),
    (MOVE_CARD, lambda row: row.remark.given.card.value),
    (
        Variable(
            "remark",
            "What the helper said: praise after a pair, encouragement after a miss, or an action of the table.",
        ),
        lambda row: row.remark.given.action.label,
    ),
    (
        Variable(
            "remark_trigger",
            "What it came from.",
            levels=enum_levels(
                RemarkTrigger,
                decision="the decision before the flip: the table has such an action",
                comment="the move before, after which comments come at the rate of the condition",
            ),
        ),
        lambda row: row.remark.given.trigger.value,
    ),
    (
        Variable(
            "remark_probability",
            "The chance of a comment after such a move, where no help was decided for the next card; 1 for an action "
            "of the table.",
            ColumnKind.NUMBER,
        ),
        lambda row: row.remark.given.probability,
    ),
    (SENTENCE, lambda row: row.remark.given.sentence),
    (UTTERANCE, lambda row: row.remark.given.utterance),
    (AT, lambda row: row.remark.given.at_ms),
    (
        Variable(
            "remark_hold_ms",
            "How long it held the board: from its sentence until cards could be tapped again, pauses included.",
            ColumnKind.WHOLE,
            "ms",
            empty="the session ended before",
        ),
        lambda row: None if row.remark.opened_ms is None else row.remark.opened_ms - row.remark.given.at_ms,
    ),
    (
        Variable(
            "next_move_matched",
            "Whether the move that the remark came before, or in, ended in a match.",
            ColumnKind.TRUTH,
            empty="the move did not end",
        ),
        lambda row: row.dealt.move_matched(row.remark.given.flip),
    ),
)

REMARKS = Table(
    "remarks",
    "One row for every remark in the game: praise, encouragement, and what else was said that points nowhere. Only of "
    "studies that have such.",
    (PARTICIPANT.name, BOARD.name, FLIP.name),
    _REMARK_COLUMNS,
    _remarks,
)
