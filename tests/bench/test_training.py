"""How fast games are played and episodes learnt: the kernel against the reference loop, and from nothing to a table.

Run them alone, on a quiet machine: ``pytest tests/bench/test_training.py --benchmark-columns=mean,ops``. "ops" is per
call; the number of games or episodes in a call is in the name, and the rate in ``extra_info`` of ``--benchmark-json``.
"""

from __future__ import annotations

import ctypes
import os
import subprocess
import sys
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from multiprocessing import get_context
from pathlib import Path
from random import Random
from typing import Any

import pytest

from kiosk.assistance.mentaliser import TargetRule
from kiosk.assistance.policy import QTable
from kiosk.training.learning import RECIPES, Learner
from kiosk.training.native import COMPILER
from kiosk.training.rewards import Reward
from kiosk.training.simulated_players import MemoryPlayer
from kiosk.training.simulation import TALLY, lay, play_all, simulate_games
from kiosk.training.vectorised_game import COMPILED, NATIVE, RANDOM, floats, gate_plan, ints
from tests.patience import PATIENCE_S
from tests.training.reference import WithMemory, learn, play

Benchmark = Any
MANY = 20_000 if COMPILED or NATIVE else 1_000
FEW = 50


def measured(benchmark: Benchmark, what: Callable[[], object], number: int, rounds: int = 9) -> None:
    """Time ``what``, once warm, and note its rate."""
    benchmark.pedantic(what, rounds=rounds, warmup_rounds=1)
    if benchmark.stats is not None:
        benchmark.extra_info["a second"] = round(number / benchmark.stats.stats.mean)


def games(number: int) -> None:
    """Games of the memory player under the default table."""
    simulate_games(QTable.named("default"), MemoryPlayer((0.2, 0.2)), TargetRule.MOST_FLIPPED, number, 1)


def episodes(number: int) -> None:
    """Episodes of the default recipe."""
    Learner(replace(RECIPES[Reward.RETRIEVAL], episodes=number)).study()


def reference_games() -> None:
    """Play the same games one by one on the real modules."""
    table, rng = QTable.named("default"), Random(1)
    for _ in range(FEW):
        play(table, WithMemory(0.2, rng), TargetRule.MOST_FLIPPED, rng)


@pytest.mark.benchmark(group="games", timer=time.process_time)
def test_games_of_the_kernel(benchmark: Benchmark) -> None:
    measured(benchmark, lambda: games(MANY), MANY)


@pytest.mark.benchmark(group="games", timer=time.process_time)
def test_games_of_the_reference(benchmark: Benchmark) -> None:
    measured(benchmark, reference_games, FEW)


@pytest.mark.benchmark(group="games", timer=time.process_time)
@pytest.mark.skipif(COMPILER is None, reason="there is no C compiler")
def test_games_in_c(benchmark: Benchmark, tmp_path: Path) -> None:
    """The same games, number for number, in plain C with -O2."""
    source, library = Path(__file__).with_name("games.c"), tmp_path / "games.so"
    subprocess.run(
        [str(COMPILER), "-O2", "-shared", "-fPIC", "-o", str(library), str(source)], check=True, timeout=PATIENCE_S
    )
    policy, forgetting = QTable.named("default"), 0.2
    plan = gate_plan(policy.gate, TargetRule.MOST_FLIPPED, policy.actions)
    table = lay(MemoryPlayer((forgetting, forgetting)), plan, 1)
    random = ctypes.c_uint64(int(table.game[RANDOM]))
    q = floats([value for row in policy.values for value in row])
    in_c, here = ints([0] * (MANY * TALLY)), ints([0] * (MANY * TALLY))

    def at(array: Any) -> ctypes.c_void_p:
        return ctypes.c_void_p(ctypes.addressof(ctypes.c_char.from_buffer(array)))

    play = ctypes.CDLL(str(library)).play
    arguments = (random, at(plan), at(q), ctypes.c_double(forgetting), ctypes.c_int64(MANY), at(in_c))
    measured(benchmark, lambda: play(*arguments), MANY)
    play_all(table, q, here)
    assert list(in_c) == list(here)


@pytest.mark.benchmark(group="games", timer=time.process_time)
def test_games_of_the_kernel_without_their_results(benchmark: Benchmark) -> None:
    policy = QTable.named("default")
    plan = gate_plan(policy.gate, TargetRule.MOST_FLIPPED, policy.actions)
    table, tallies = lay(MemoryPlayer((0.2, 0.2)), plan, 1), ints([0] * (MANY * TALLY))
    q = floats([value for row in policy.values for value in row])
    measured(benchmark, lambda: play_all(table, q, tallies), MANY)


@pytest.mark.benchmark(group="games in processes")
@pytest.mark.parametrize("processes", [1, 2])
def test_games_in_processes(benchmark: Benchmark, processes: int) -> None:
    """As many games in each of them; two take as long as one on two idle cores."""
    with ProcessPoolExecutor(processes, get_context("fork")) as pool:
        measured(benchmark, lambda: list(pool.map(games, [MANY] * processes)), processes * MANY)


@pytest.mark.benchmark(group="episodes")
def test_episodes_of_the_kernel(benchmark: Benchmark) -> None:
    measured(benchmark, lambda: episodes(MANY), MANY)


@pytest.mark.benchmark(group="episodes")
def test_episodes_of_the_reference(benchmark: Benchmark) -> None:
    measured(benchmark, lambda: learn(FEW, Random(1)), FEW)


HOW = {
    "in C, first time ever": "sys.modules['numba'] = None",
    "in C, compiled before": "sys.modules['numba'] = None",
    "numba alone, first time ever": "from kiosk.training import native; native.COMPILER = None",
    "numba alone, compiled before": "from kiosk.training import native; native.COMPILER = None",
    "plain Python": "sys.modules['numba'] = None; from kiosk.training import native; native.COMPILER = None",
}
"""What the process does before it begins; none of them finds what the installation compiled."""


@pytest.mark.benchmark(group="from nothing to the default table")
@pytest.mark.parametrize("how", list(HOW))
def test_from_nothing_to_the_default_table(benchmark: Benchmark, tmp_path: Path, how: str) -> None:
    out = tmp_path / "default.json"
    environment = os.environ | {"XDG_CACHE_HOME": str(tmp_path / "cache")}
    program = f"import sys; sys.prefix = sys.argv.pop(1); {HOW[how]}; from kiosk.__main__ import main; main()"
    command = [sys.executable, "-c", program, str(tmp_path), "train", "--name", "default", "--out", str(out)]

    def train() -> None:
        subprocess.run(command, check=True, capture_output=True, env=environment, timeout=PATIENCE_S)

    if "before" in how:
        train()
    benchmark.pedantic(train, rounds=1)
    assert QTable.load(out).values == QTable.named("default").values
