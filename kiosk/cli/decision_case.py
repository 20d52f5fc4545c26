"""The case files of `explain`: a board, the flips so far, and the condition and policy that decide."""

from __future__ import annotations

import reprlib
from pathlib import Path
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError
from pydantic_core import ErrorDetails

from kiosk import UserInputError
from kiosk.assistance.mentaliser import TargetRule
from kiosk.assistance.policy import QTable, find_action, said_once
from kiosk.cli.options import read_catalogue
from kiosk.config import AssistanceConfig, Game
from kiosk.experiment.condition import Condition
from kiosk.experiment.replay import DecisionContext
from kiosk.files import parse_json
from kiosk.game import Board

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
