"""The variables that stand in several tables, declared once for all of them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TypeVar

from kiosk.assistant.gate import Verdict
from kiosk.assistant.mdp import Action, Card
from kiosk.store.dataset.column import Cell, Column, Kind, Level, Variable, named
from kiosk.store.dataset.extras import Extra
from kiosk.study.condition import Condition
from kiosk.study.events import Stage
from kiosk.study.session_kind import SessionKind

_Row = TypeVar("_Row")

PARTICIPANT = Variable(
    "participant_id",
    "Who it is about: the site, where there is more than one, and a number in the order in which people came. It has "
    "nothing to do with the code that the visitor keeps.",
)
AT = Variable("at_ms", "When it happened, from the sitting's first event.", Kind.WHOLE, "ms")
STAGE = Variable("stage", "The stage of the sitting that it fell into.", levels=named(Stage))
BOARD = Variable(
    "board",
    "Which of the boards that were dealt in this sitting, from 1: the practice's, then the game's; a practice that was "
    "cut off and gone on with is dealt anew.",
    Kind.WHOLE,
)
FLIP = Variable("flip", "The number of the flip on this board, from 1; two flips are a move.", Kind.WHOLE)
MOVE_CARD = Variable("move_card", "Whether the flip is the first or the second of its move.", levels=named(Card))
ROW = Variable("row", "The row on the board, from 1 at the top.", Kind.WHOLE)
COLUMN = Variable("column", "The column on the board, from 1 at the left.", Kind.WHOLE)
PICTURE = Variable("picture", "The name of the picture on the card; every picture lies on a board twice.")
ACTION = Variable(
    "action",
    "How much help was chosen for the flip.",
    levels=named(
        Action,
        no_help="nothing was said",
        sug_col="the column of a card was named",
        sug_row="the row of a card was named",
        sug_card="a card was named by row and column",
    ),
)
GATE = Variable(
    "gate",
    "What the gate, which stands before the table, said of the flip: open, or why no help was considered.",
    levels=tuple(Level(verdict.name.lower(), "" if verdict.is_open else verdict.value) for verdict in Verdict),
)
CONDITION = Variable(
    "condition",
    "The help that this visitor was given.",
    levels=named(
        Condition,
        tom="a target chosen by what the visitor has seen, and a reason given",
        notom="a random target for first cards, and no reason",
        mentalised_unexplained="a target chosen by what the visitor has seen, and no reason",
        random_explained="a random target for first cards, and a reason given",
        no_assistance="no help at all",
    ),
)
FOLLOWED = Variable(
    "followed",
    "Whether the flip after the hint is the hinted card, or lies in the hinted row or column.",
    Kind.TRUTH,
    empty="there was no hint, or no flip after it",
)
SENTENCE = Variable("sentence", "What was said and shown, in the sitting's language; a sentence of the program.")
UTTERANCE = Variable("utterance", "The number of the sentence in its sitting.", Kind.WHOLE)
SIMULATED = Variable("simulated", "Whether a program sat there instead of a person.", Kind.TRUTH)
TRIAL = Variable("trial", "Whether the kiosk had no PIN, so that the sitting is none of the study's.", Kind.TRUTH)


def who_sat_there(extras: frozenset[Extra]) -> Iterator[tuple[Variable, SessionKind]]:
    """Yield the columns that tell sittings apart which are none of the study's, with the kind that each is about."""
    if Extra.REHEARSALS in extras:
        yield SIMULATED, SessionKind.SIMULATED
    if Extra.TRIALS in extras:
        yield TRIAL, SessionKind.TRIAL


def columns(*pairs: tuple[Variable, Callable[[_Row], Cell]]) -> tuple[Column[_Row], ...]:
    """Columns from variables and where their values are found."""
    return tuple(Column(variable, of) for variable, of in pairs)
