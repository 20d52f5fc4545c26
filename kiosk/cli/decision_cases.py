"""Decisions to explain that no session holds: of a case file, and the examples of the table of reasons."""

from __future__ import annotations

import reprlib
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError
from pydantic_core import ErrorDetails

from kiosk import UserInputError
from kiosk.assistance.assistant import game_after
from kiosk.assistance.hint_sentences import ReasonedSentences, Wording
from kiosk.assistance.mentaliser import Hint, HintReason, Mentaliser, TargetRule
from kiosk.assistance.policy import ActionSpec, FlipInMove, QTable, find_action, said_once
from kiosk.cli.options import read_catalogue, shipped_languages
from kiosk.config import AssistanceConfig, Game
from kiosk.experiment.condition import Condition
from kiosk.experiment.replay import DecisionContext
from kiosk.files import parse_json
from kiosk.game import Board, Position

SHAPE = Game()
"""The board of a case is the study's."""
CASE_CARDS = SHAPE.rows * SHAPE.columns


class DecisionCase(BaseModel):
    """The keys of a case file; those with a value here may be left out."""

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)

    board: list[Annotated[str, Field(min_length=1)]]
    flips: list[Annotated[int, Field(ge=0, lt=CASE_CARDS)]]
    last_action: str
    condition: str
    policy: str
    language: str
    action: str | None = None
    seed: int = 0
    target_rule: Literal["most_flipped", "most_recent"] = AssistanceConfig().target_rule

    def moment(self) -> DecisionContext:
        """Return what the case describes; raise UserInputError or ValueError if it cannot be."""
        board, condition = Board(SHAPE.rows, SHAPE.columns, tuple(self.board)), Condition.from_name(self.condition)
        return DecisionContext(
            board=board,
            flips=tuple(map(board.position, self.flips)),
            last=find_action(self.last_action),
            condition=condition,
            cell=condition.known,
            rule=TargetRule(self.target_rule),
            policy=QTable.named(self.policy),
            catalogue=read_catalogue(self.language),
            override=None if self.action is None else find_action(self.action),
            seed=self.seed,
        )


def read_case(path: Path) -> DecisionCase:
    """Read a case file (JSON); raises UserInputError with one sentence that names the key."""
    try:
        return DecisionCase.model_validate(parse_json(path.read_bytes(), object_pairs_hook=said_once))
    except OSError as error:
        raise UserInputError(f"the case {path} cannot be read: {error.strerror}") from error
    except ValidationError as error:
        raise UserInputError(f"the case {path}: {_sentence(error.errors()[0])}") from error
    except ValueError as error:
        raise UserInputError(f"the case {path} is not JSON: {error}") from error


def _sentence(error: ErrorDetails) -> str:
    """Return what pydantic found wrong, as a person would say it; places in a list are counted from 1."""
    key = ", number ".join(str(part + 1) if isinstance(part, int) else part for part in error["loc"])
    match error["type"]:
        case "missing":
            return f"the key {key!r} is missing"
        case "extra_forbidden":
            return f"there is no key {key!r}"
        case _:
            what = error["msg"].removeprefix("Input ")
            return f"{key or 'it'} {what}, but it is {reprlib.repr(error['input'])}"


CARDS = (
    *("owl", "cat", "frog", "duck", "bear", "fish"),
    *("rabbit", "turtle", "hedgehog", "elephant", "ladybird", "butterfly"),
)
BOARD = Board(4, 6, CARDS * 2)
"""Every card's first copy lies in rows 1 and 2, its second copy in the same place in rows 3 and 4."""

EXAMPLES = (
    "",
    "owl cat",
    "owl cat, owl' frog",
    "owl cat, owl frog",
    "owl cat, owl frog, owl' duck",
    "owl cat, owl frog, owl' duck, owl' bear",
    "owl",
    "owl' cat, owl",
    "owl cat, owl",
    "owl cat, owl' frog, owl",
    "owl' cat, owl' frog, owl",
    "owl cat, owl' frog, owl' duck, owl",
)
"""Moves before a hint, by card; a dash marks its second copy. The hint is about the owls, or about new cards."""


@dataclass(frozen=True)
class ReasonExample:
    """What a history comes to: the card that is coming, the reason, and one sentence per language."""

    moves: str
    card: FlipInMove
    reason: HintReason
    target: int
    other: int
    sentences: tuple[str, ...]


def reason_example(moves: str) -> ReasonExample:
    """Play these moves and ask for a hint about a row."""
    game = game_after(BOARD, map(_place, moves.replace(",", "").split()))
    mentaliser = Mentaliser(TargetRule.MOST_FLIPPED, Random(0))
    owls = [position for position in mentaliser.candidates(game) if BOARD.card(position) == CARDS[0]]
    target = mentaliser.pointing_at(owls[-1], game)
    hint = Hint.coming(ActionSpec.SUG_ROW, target, game)
    return ReasonExample(moves, hint.card, target.reason, target.seen, target.mate_seen, _sentences(hint))


def reasons_table() -> str:
    """All examples as a table in Markdown."""
    head = ("card", "reason", "turned up: target, other", "example: moves so far", *shipped_languages())
    rows = [head, ("---",) * len(head), *(_row(reason_example(moves)) for moves in EXAMPLES)]
    return "".join(f"| {' | '.join(row)} |\n" for row in rows)


def _row(shown: ReasonExample) -> tuple[str, ...]:
    moves = shown.moves or "none"
    return (shown.card.value, shown.reason.value, f"{shown.target}, {shown.other}", moves, *shown.sentences)


def _sentences(hint: Hint) -> tuple[str, ...]:
    wordings = (Wording(read_catalogue(language), Random(0)) for language in shipped_languages())
    return tuple(ReasonedSentences(wording).all_wordings(hint)[0] for wording in wordings)


def _place(card: str) -> Position:
    location = CARDS.index(card.removesuffix("'"))
    return BOARD.position(location + len(CARDS) if card.endswith("'") else location)
