"""Policies, plans and sentences for tests. Nothing here reads ``policies/``: a test's table is made on the spot."""

from __future__ import annotations

from collections.abc import Callable
from random import Random
from typing import Any

from kiosk.assistant.gate import NO_GATE, Gate
from kiosk.assistant.mdp import STATES, Action, State
from kiosk.assistant.qtable import QTable
from kiosk.assistant.wording import Catalogue
from kiosk.game import Board
from kiosk.settings import ASSETS, Settings
from kiosk.study.condition import Condition
from kiosk.study.declared.questionnaire import Questionnaire
from kiosk.study.plan import Plan

CATALOGUES = {folder.name: Catalogue(folder) for folder in sorted((ASSETS / "sentences").iterdir())}
ENGLISH = CATALOGUES["en"]
ANIMALS = tuple(sorted(picture.stem for picture in (ASSETS / "cards" / "animals").glob("*.svg")))
CLOSING = Questionnaire.read(ASSETS / "questionnaires" / "closing.toml")


def policy_that(choose: Callable[[State], Action], gate: Gate = NO_GATE) -> QTable:
    """A table whose greedy action in every state is the chosen one."""
    values = [[float(action is choose(state)) for action in Action] for state in STATES]
    return QTable.freeze("made for a test", gate, values, {"by": "hand"})


def always(action: Action, gate: Gate = NO_GATE) -> QTable:
    """A table that always takes this action."""
    return policy_that(lambda _: action, gate)


def mixed(seed: int = 0, gate: Gate = NO_GATE) -> QTable:
    """A table that takes any action anywhere, drawn by a seed."""
    rng = Random(seed)
    chosen = {state: rng.choice(list(Action)) for state in STATES}
    return policy_that(chosen.__getitem__, gate)


def plan(condition: Condition = Condition.TOM, policy: QTable | None = None, **settings: Any) -> Plan:
    """A plan for a whole sitting; ``settings`` are sections of the study file."""
    return Plan(Settings(**settings), condition, policy or mixed(), ENGLISH, CLOSING, ANIMALS)


def board_of(*rows: str) -> Board:
    """A board from one word per row, one letter per card: ``board_of("abc", "cab")``."""
    return Board(len(rows), len(rows[0]), tuple("".join(rows)))
