"""Compiles the rules when the program is installed: ``python -m kiosk.training.ahead``.

The first table or simulation of every user then begins at once. Without numba there is nothing to compile.
"""

from __future__ import annotations

import shutil
from dataclasses import replace

from kiosk.assistance.mentaliser import TargetRule
from kiosk.assistance.policy import QTable
from kiosk.training.learning import RECIPES, Learner
from kiosk.training.rewards import Reward
from kiosk.training.simulated_players import MemoryPlayer
from kiosk.training.simulation import record_games, simulate_games
from kiosk.training.vectorised_game import AHEAD, KEPT_IN, copy_compiled


def compile_rules() -> None:
    """Play every kind of game once, which compiles all rules, and keep them with the installation."""
    if KEPT_IN is None:
        return
    policy, player, target = QTable.named("default"), MemoryPlayer((0.2, 0.2)), TargetRule.MOST_FLIPPED
    Learner(replace(RECIPES[Reward.RETRIEVAL], episodes=2)).study()
    simulate_games(policy, player, target, games=2, seed=1)
    list(record_games(policy, player, target, games=1, seed=1))
    for old in AHEAD.parent.glob("rules-*"):
        shutil.rmtree(old)
    copy_compiled(KEPT_IN, AHEAD)


if __name__ == "__main__":
    compile_rules()
