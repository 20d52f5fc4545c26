"""The tables of decisions about help, and of what the model of memory held at each."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

from kiosk.assistance.policy import MoveOutcome, Phase
from kiosk.experiment.dealt_boards import DealtBoard
from kiosk.experiment.events import AssistanceDecided, MemoryEstimated
from kiosk.export.columns import (
    ACTION,
    AT,
    BOARD,
    COLUMN,
    FLIP,
    GATE,
    MOVE_CARD,
    PARTICIPANT,
    ROW,
    Column,
    ColumnKind,
    Table,
    Variable,
    enum_levels,
    make_columns,
)
from kiosk.store.session_records import SessionRecord


@dataclass(frozen=True)
class _Decision:
    kept: SessionRecord
    dealt: DealtBoard
    event: AssistanceDecided


def _decisions(kept: SessionRecord) -> Iterator[_Decision]:
    for dealt in kept.state.boards:
        yield from (_Decision(kept, dealt, decision) for decision in dealt.decisions.values())


_DECISION_COLUMNS: tuple[Column[_Decision], ...] = make_columns(
    (PARTICIPANT, lambda row: row.kept.name),
    (BOARD, lambda row: row.dealt.number),
    (FLIP, lambda row: row.event.flip),
    (AT, lambda row: row.event.at_ms),
    (MOVE_CARD, lambda row: row.event.card.value),
    (
        Variable("phase", "How far the game was, in thirds of its pairs.", levels=enum_levels(Phase)),
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
            levels=enum_levels(
                MoveOutcome,
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
    (
        Variable("greedy_action", "The action that gate and table came to.", levels=ACTION.levels),
        lambda row: row.event.greedy.label,
    ),
    (
        Variable(
            "action_probability",
            "The probability of the action that was taken, given the state and the policy; 1 where nothing was drawn.",
            ColumnKind.NUMBER,
        ),
        lambda row: row.event.probability,
    ),
    (
        Variable("randomised", "Whether the action was drawn.", ColumnKind.TRUTH),
        lambda row: row.event.randomised,
    ),
)

DECISIONS = Table(
    "decisions",
    "One row for every decision about help, which is taken before every flip of the game: what the assistant's two "
    "layers saw, and what they chose. Without help there are none.",
    ("participant_id", "board", "flip"),
    _DECISION_COLUMNS,
    _decisions,
)


@dataclass(frozen=True)
class _Memory:
    kept: SessionRecord
    dealt: DealtBoard
    event: MemoryEstimated
    place: int


def _memories(kept: SessionRecord) -> Iterator[_Memory]:
    for dealt in kept.state.boards:
        for event in dealt.memories.values():
            yield from (_Memory(kept, dealt, event, place) for place in range(len(event.recall)))


_MEMORY_COLUMNS: tuple[Column[_Memory], ...] = make_columns(
    (PARTICIPANT, lambda row: row.kept.name),
    (BOARD, lambda row: row.dealt.number),
    (FLIP, lambda row: row.event.flip),
    (ROW, lambda row: row.place // row.dealt.event.columns + 1),
    (COLUMN, lambda row: row.place % row.dealt.event.columns + 1),
    (
        Variable(
            "recalled_percent",
            "How likely the model of the visitor's memory took the card there to be recalled; 0 for cards that were "
            "found or never turned up.",
            ColumnKind.WHOLE,
            "percent",
        ),
        lambda row: row.event.recall[row.place],
    ),
)

MEMORY = Table(
    "memory",
    "One row for every card at every decision: what the model of the visitor's memory held before the flip. Only of "
    "studies with a model of memory.",
    (PARTICIPANT.name, BOARD.name, FLIP.name, ROW.name, COLUMN.name),
    _MEMORY_COLUMNS,
    _memories,
)


def _of_memory(name: str) -> Callable[[_Decision], float | None]:
    """Return what reads a number of the estimate at a decision."""

    def read(row: _Decision) -> float | None:
        memory = row.dealt.memories.get(row.event.flip)
        return None if memory is None else getattr(memory, name)

    return read


_MODELLED: tuple[Column[_Decision], ...] = make_columns(
    (
        Variable(
            "forgetting",
            "What the model of memory held of the visitor's forgetting a flip, the mean over its grid.",
            ColumnKind.NUMBER,
        ),
        _of_memory("forgetting"),
    ),
    (
        Variable(
            "match_recalled",
            "How likely, for the model, a pair was recalled, or before a second card the mate of the open one.",
            ColumnKind.NUMBER,
        ),
        _of_memory("match_recalled"),
    ),
    (
        Variable(
            "completes_predicted",
            "How likely, for the model, the coming flip completes a pair without help.",
            ColumnKind.NUMBER,
            empty="a first card was coming",
        ),
        _of_memory("completes"),
    ),
    (
        Variable(
            "last_flip_predicted",
            "How likely, for the model and without help, the card of the flip before was.",
            ColumnKind.NUMBER,
            empty="there was no flip before",
        ),
        _of_memory("last_flip"),
    ),
)

MODELLED_DECISIONS = replace(DECISIONS, columns=(*_DECISION_COLUMNS, *_MODELLED))
"""The decisions of a study that has a model of memory, some of whose sessions may have had none."""
