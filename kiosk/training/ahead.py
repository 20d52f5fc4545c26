"""Compiles the rules when the program is installed: ``python -m kiosk.training.ahead``.

The first table or simulation of every user then begins at once. With the name of a file it makes the library that a
build brings along.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

from kiosk.assistance.mentaliser import TargetRule
from kiosk.assistance.policy import QTable
from kiosk.training.learning import RECIPES, Learner
from kiosk.training.native import AHEAD, COMPILER, compile_library, keep, places
from kiosk.training.rewards import REWARDS, Reward, reward_flip, reward_of
from kiosk.training.simulated_players import MemoryPlayer
from kiosk.training.simulation import lay, playing, record_games, simulate_games, start, take
from kiosk.training.vectorised_game import KEPT_IN, NO_HELP, copy_compiled, floats, gate_plan, is_open, state

PLAYER = MemoryPlayer((0.2, 0.2))


def compile_rules() -> None:
    """Compile all rules with what there is, a C compiler and numba, and keep them with the installation."""
    for old in AHEAD.parent.glob("rules-*"):
        shutil.rmtree(old)
    if KEPT_IN is not None:
        play_every_kind()
        play_step_by_step()
        copy_compiled(KEPT_IN, AHEAD)
    if COMPILER is not None:
        make_library(COMPILER, places()[0])


def make_library(compiler: str, place: Path) -> None:
    """Compile the long loops into a library at ``place``."""
    with TemporaryDirectory() as folder:
        made = Path(folder) / place.name
        compile_library(compiler, made)
        keep(made, place)


def play_every_kind() -> None:
    """Run each of the long loops once."""
    policy, target = QTable.named("default"), TargetRule.MOST_FLIPPED
    Learner(replace(RECIPES[Reward.RETRIEVAL], episodes=2)).study()
    simulate_games(policy, PLAYER, target, games=2, seed=1)
    list(record_games(policy, PLAYER, target, games=1, seed=1))


def play_step_by_step() -> None:
    """Play a game with the rules that the environment for Gymnasium calls one by one."""
    table = lay(PLAYER, gate_plan(QTable.named("default").gate, TargetRule.MOST_FLIPPED), 1)
    purse = floats([0.0])
    start(table)
    while playing(table.game):
        state(table.game), is_open(table.game, table.plan)
        seen = reward_flip(table.game, NO_HELP)
        reward_of(REWARDS.index(Reward.RETRIEVAL), seen, take(table, NO_HELP), purse)


def main(arguments: Sequence[str]) -> int:
    """Compile for this installation, or a library into the file that is named; the exit code."""
    if not arguments:
        compile_rules()
        return 0
    if COMPILER is None:
        return 1
    try:
        make_library(COMPILER, Path(arguments[0]))
    except subprocess.CalledProcessError as failure:
        sys.stderr.write(failure.stderr)
        return 1
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
