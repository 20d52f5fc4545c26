"""A case file: one moment of a game as a person writes it down, to be explained. Whatever is wrong is one sentence."""

from __future__ import annotations

import json
import reprlib
from pathlib import Path
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError
from pydantic_core import ErrorDetails

from kiosk import BadInput
from kiosk.assistant.mdp import Action
from kiosk.assistant.mentaliser import TargetRule
from kiosk.assistant.qtable import QTable, said_once
from kiosk.cli.languages import catalogue
from kiosk.game import Board
from kiosk.settings import Assistance, Game
from kiosk.study.after.moment import Moment
from kiosk.study.condition import Condition

SHAPE = Game()
"""The board of a case is the study's."""
CARDS = SHAPE.rows * SHAPE.columns


class Case(BaseModel):
    """The keys of a case file; those with a value here may be left out."""

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)

    board: list[Annotated[str, Field(min_length=1)]]
    flips: list[Annotated[int, Field(ge=0, lt=CARDS)]]
    last_action: str
    condition: str
    policy: str
    language: str
    action: str | None = None
    seed: int = 0
    target_rule: Literal["most_flipped", "most_recent"] = Assistance().target_rule

    def moment(self) -> Moment:
        """What the case describes; raises BadInput or ValueError for names that do not exist and impossible boards."""
        board = Board(SHAPE.rows, SHAPE.columns, tuple(self.board))
        return Moment(
            board=board,
            flips=tuple(map(board.position, self.flips)),
            last=_action(self.last_action),
            condition=Condition.named(self.condition),
            rule=TargetRule(self.target_rule),
            policy=QTable.named(self.policy),
            catalogue=catalogue(self.language),
            override=None if self.action is None else _action(self.action),
            seed=self.seed,
        )


def read(path: Path) -> Case:
    """Read a case file (JSON); raises BadInput with one sentence that names the key."""
    try:
        return Case.model_validate(json.loads(path.read_bytes(), object_pairs_hook=said_once))
    except OSError as error:
        raise BadInput(f"the case {path} cannot be read: {error.strerror}") from error
    except ValidationError as error:
        raise BadInput(f"the case {path}: {_sentence(error.errors()[0])}") from error
    except (ValueError, RecursionError) as error:
        raise BadInput(f"the case {path} is not JSON: {error}") from error


def _action(name: str) -> Action:
    for action in Action:
        if action.label == name:
            return action
    raise BadInput(f"there is no action {name!r}; there are {', '.join(action.label for action in Action)}")


def _sentence(error: ErrorDetails) -> str:
    """What pydantic found wrong, as a person would say it; places in a list are counted from 1."""
    key = ", number ".join(str(part + 1) if isinstance(part, int) else part for part in error["loc"])
    match error["type"]:
        case "missing":
            return f"the key {key!r} is missing"
        case "extra_forbidden":
            return f"there is no key {key!r}"
        case _:
            what = error["msg"].removeprefix("Input ")
            return f"{key or 'it'} {what}, but it is {reprlib.repr(error['input'])}"
