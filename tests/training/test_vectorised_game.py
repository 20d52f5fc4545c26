"""The kernel plays exactly the rules of the game and the assistant, compiled or not."""

from __future__ import annotations

import os
import stat
import subprocess
import sys
from functools import cache
from pathlib import Path
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kiosk.assistance.mentaliser import Hint, Mentaliser, TargetRule
from kiosk.assistance.policy import ActionSpec, FlipInMove, Gate, State
from kiosk.game import Board, Concentration
from kiosk.training import native, simulation, vectorised_game
from kiosk.training.vectorised_game import (
    CARDS,
    COUNT,
    FIRST,
    FOUND,
    HELP,
    LAST,
    LISTED,
    MATE,
    NOWHERE,
    copy_compiled,
    place_of_compiled,
)
from tests.patience import PATIENCE_S
from tests.samples import mixed

GATES = st.builds(Gate, st.integers(0, 12), st.integers(0, 8), st.integers(0, 16))
FLIPS_WATCHED = 90


def board_of(game: vectorised_game.Ints) -> Board:
    """Return the board that the kernel has dealt."""
    return Board(
        vectorised_game.ROWS, vectorised_game.COLUMNS, tuple(str(min(p, int(game[MATE + p]))) for p in range(CARDS))
    )


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 1 << 40), GATES, st.sampled_from(TargetRule), st.integers(0, 99))
def test_with_the_same_choices_every_step_of_a_game_is_the_same(
    seed: int, gate: Gate, rule: TargetRule, table: int
) -> None:
    mine, plan, rng = vectorised_game.new_game(seed), vectorised_game.gate_plan(gate, rule), Random(seed)
    vectorised_game.deal(mine)
    theirs, policy, mentaliser = Concentration(board_of(mine)), mixed(table, gate), Mentaliser(rule, rng)
    q = vectorised_game.floats([value for row in policy.values for value in row])
    last = ActionSpec.NO_HELP
    while not theirs.over and theirs.flips < FLIPS_WATCHED:
        state, verdict = State.of(theirs, last), gate.decide(theirs)
        action = policy.action(state) if verdict.is_open else ActionSpec.NO_HELP
        assert int(vectorised_game.state(mine)) == state.index
        assert bool(vectorised_game.is_open(mine, plan)) == verdict.is_open
        assert int(simulation.greedy(q, state.index, 4)) == int(policy.action(state))
        target = mentaliser.target(theirs)
        assert candidates(mine, rule) == {theirs.board.location(place) for place in target.candidates}
        place = rng.choice(theirs.closed)
        here, there = theirs.board.location(place), theirs.board.location(target.position)
        if action is not ActionSpec.NO_HELP:
            hint = Hint(action, FlipInMove.coming(theirs), target, "")
            assert bool(simulation.follows(int(action), there, here)) == hint.followed_by(place)
        flip = theirs.flip(place)
        assert bool(vectorised_game.flip(mine, here)) == bool(flip.matched)
        theirs.turn_back()
        last = action
        mine[HELP] = int(action)
        assert snapshot(mine) == history_of(theirs)


def candidates(game: vectorised_game.Ints, rule: TargetRule) -> set[int]:
    """Return the places that the kernel lets a hint point at."""
    number = vectorised_game.list_candidates(game, vectorised_game.TARGET_RULES.index(rule))
    listed = {int(place) for place in game[LISTED : LISTED + number]}
    assert number == len(listed)
    return listed


def snapshot(game: vectorised_game.Ints) -> list[tuple[int, int, bool, bool]]:
    """Of every place in the kernel: flips, last flip, whether found, whether closed."""
    where = range(CARDS)
    return [
        (int(game[COUNT + p]), int(game[LAST + p]), game[FOUND + p] == 1, bool(vectorised_game.closed(game, p)))
        for p in where
    ]


def history_of(game: Concentration) -> list[tuple[int, int, bool, bool]]:
    """Return the same of a game."""
    count, last = game.history.count, game.history.last
    return [(count(p), last(p), p in game.found, p in game.closed) for p in game.board]


def test_a_dealt_board_holds_every_pair_once() -> None:
    game = vectorised_game.new_game(5)
    for _ in range(50):
        vectorised_game.deal(game)
        assert all(game[MATE + int(game[MATE + p])] == p != game[MATE + p] for p in range(CARDS))
    assert game[FIRST] == NOWHERE


def test_every_place_is_the_mate_of_the_first_equally_often() -> None:
    game, games = vectorised_game.new_game(11), 4600
    mates = [0] * CARDS
    for _ in range(games):
        vectorised_game.deal(game)
        mates[int(game[MATE])] += 1
    expected = games / (CARDS - 1)
    # Chi-square with 22 degrees of freedom: above 51 once in 2,000 seeds, and the seed is fixed.
    assert sum((n - expected) ** 2 / expected for n in mates[1:]) < 51


def test_random_words_are_the_ones_that_the_formula_gives() -> None:
    game = vectorised_game.new_game(1)
    word = int(game[vectorised_game.RANDOM])
    for _ in range(100):
        word = vectorised_game.MULTIPLIER * (word & 0xFFFFFFFF) + (word >> 32)
        assert word < 1 << 63
        assert int(vectorised_game.draw_bits(game)) == (word ^ (word >> 32)) & 0xFFFFFFFF


def test_neighbouring_seeds_have_nothing_in_common() -> None:
    games = map(vectorised_game.new_game, range(50))
    first = [[int(vectorised_game.draw_bits(game)) for _ in range(50)] for game in games]
    assert len({word for words in first for word in words}) == 50 * 50


SAME = """
from dataclasses import replace
from kiosk.assistance.mentaliser import TargetRule
from kiosk.training import native, vectorised_game
from kiosk.training.learning import RECIPES, Learner
from kiosk.training.simulated_players import ChancePlayer, MemoryPlayer, TextPlayer
from kiosk.training.simulation import simulate_games
print(vectorised_game.COMPILED, native.library() is not None)
for recipe in RECIPES.values():
    for player in ChancePlayer(follow=.9), MemoryPlayer((.1, .4), .8), TextPlayer():
        learner = Learner(replace(recipe, episodes=60, player=player))
        learner.study()
        table = learner.freeze("same", "")
        print(table.sha256, simulate_games(table, player, TargetRule.MOST_RECENT, 20, 3).measures())
"""


@cache
def plainly() -> list[str]:
    """Return what the script prints where nothing is compiled."""
    return printed({"NUMBA_DISABLE_JIT": "1"})


def printed(environment: dict[str, str], before: str = "") -> list[str]:
    """Return what the script prints in an interpreter of its own."""
    command = [sys.executable, "-W", "error", "-c", before + SAME]
    done = subprocess.run(
        command, capture_output=True, text=True, check=True, env=os.environ | environment, timeout=PATIENCE_S
    )
    return done.stdout.splitlines()


NO_NUMBA = "import sys; sys.modules['numba'] = None\n"
NO_C = "from kiosk.training import native; native.library = lambda: None\n"


def test_compiled_and_plain_give_the_same_numbers_for_a_seed() -> None:
    pytest.importorskip("numba")
    compiled = printed({}, NO_C)
    plain = plainly()
    assert (compiled[0], plain[0]) == ("True False", "False False")
    assert compiled[1:] == plain[1:]
    assert len(set(plain[1:])) == 9


@pytest.mark.skipif(native.COMPILER is None, reason="there is no C compiler")
@pytest.mark.parametrize(("before", "numba"), [("", vectorised_game.COMPILED), (NO_NUMBA, False)])
def test_the_long_loops_in_c_give_the_same_numbers_for_a_seed(before: str, *, numba: bool) -> None:
    in_c = printed({}, before)
    assert in_c[0] == f"{numba} True"
    assert in_c[1:] == plainly()[1:]


def compiled_ahead(folder: Path) -> Path:
    """Make a folder as an installation keeps it, which may not be written in."""
    rules = folder / "rules-1" / "training_1"
    rules.mkdir(parents=True)
    (rules / "simulation.play.nbi").write_bytes(b"compiled")
    for each in (rules, rules.parent):
        each.chmod(0o555)
    return rules.parent


def test_rules_compiled_by_the_installation_are_copied_to_the_cache_of_the_user(tmp_path: Path) -> None:
    place = place_of_compiled(tmp_path / "cache", compiled_ahead(tmp_path / "installed"))
    assert place == tmp_path / "cache" / "rules-1"
    assert (place / "training_1" / "simulation.play.nbi").read_bytes() == b"compiled"
    assert all(each.stat().st_mode & stat.S_IWUSR for each in (place, *place.rglob("*")))
    assert list(place.parent.iterdir()) == [place]


def test_what_the_user_has_compiled_is_kept(tmp_path: Path) -> None:
    own = tmp_path / "cache" / "rules-1" / "training_1" / "own.nbi"
    own.parent.mkdir(parents=True)
    own.write_bytes(b"own")
    ahead = compiled_ahead(tmp_path / "installed")
    copy_compiled(ahead, tmp_path / "cache" / "rules-1")
    assert place_of_compiled(tmp_path / "cache", ahead) == tmp_path / "cache" / "rules-1"
    assert [each.name for each in own.parent.iterdir()] == ["own.nbi"]


def test_without_a_folder_to_write_in_nothing_is_kept(tmp_path: Path) -> None:
    (tmp_path / "cache").write_text("a file")
    assert place_of_compiled(tmp_path / "cache", tmp_path / "rules-1") is None
