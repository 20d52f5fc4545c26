"""The simulated players play as long as they are known to, and as the reference players do.

Tolerances are four standard errors of the mean at this number of games: one seed in 16,000 falls outside by chance,
and the seeds are fixed. The figures of many thousand games stand in docs/explanation/learning.md, with the
command that makes them.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from random import Random
from typing import Any, cast

import pytest

from kiosk import UserInputError
from kiosk.assistance.mentaliser import TargetRule
from kiosk.assistance.policy import ActionSpec, QTable
from kiosk.training.simulated_players import ChancePlayer, Counting, MemoryPlayer, SimulatedPlayer, TextPlayer
from kiosk.training.simulation import GameResults, Spread, simulate_games
from tests.samples import always, mixed
from tests.training.reference import ByChance, Person, Played, WithMemory, play

GAMES = 1200
REFERENCE_GAMES = 150
SIGMAS = 4.0


def alone(player: SimulatedPlayer, seed: int = 1) -> Spread:
    """Simulate games without any help, and return their moves."""
    return simulate_games(QTable.blank(), player, TargetRule.RANDOM, GAMES, seed).moves


@pytest.mark.parametrize(
    ("player", "mean", "sd"),
    [
        (ChancePlayer(0.5), 48.19, 7.57),
        (ChancePlayer(0.1), 25.18, 3.79),
        (MemoryPlayer((0.0, 0.0)), 18.84, 0.81),
        (MemoryPlayer((0.2, 0.2)), 30.55, 4.2),
        (MemoryPlayer((0.45, 0.45)), 47.2, 10.5),
        (TextPlayer(0.12), 47.5, 11.1),
    ],
    ids=lambda value: getattr(value, "name", ""),
)
def test_a_player_alone_needs_the_known_number_of_moves(player: SimulatedPlayer, mean: float, sd: float) -> None:
    moves = alone(player)
    assert moves.mean == pytest.approx(mean, abs=SIGMAS * sd / math.sqrt(GAMES))
    # The standard error of an SD is about sd / sqrt(2 n); the tails here are heavier than a normal's, hence 6.
    assert moves.sd == pytest.approx(sd, abs=6 * sd / math.sqrt(2 * GAMES))


def test_nobody_with_a_memory_beats_the_optimum() -> None:
    best = MemoryPlayer((0.0, 0.0))
    assert alone(best).ci95[1] > 18.8
    assert min(simulate_games(QTable.blank(), best, TargetRule.RANDOM, GAMES, 2).each(0)) >= 24


def apart(ours: Spread, theirs: Spread, games: int) -> float:
    """How many standard errors two means lie apart."""
    return abs(ours.mean - theirs.mean) / math.sqrt(ours.sd**2 / games + theirs.sd**2 / REFERENCE_GAMES)


@pytest.mark.parametrize("rule", TargetRule)
@pytest.mark.parametrize(
    ("player", "person"),
    [
        (ChancePlayer(0.5), lambda rng: ByChance(0.5, rng)),
        (ChancePlayer(0.1), lambda rng: ByChance(0.1, rng)),
        (MemoryPlayer((0.25, 0.25)), lambda rng: WithMemory(0.25, rng)),
    ],
    ids=["chance .5", "chance .1", "memory .25"],
)
def test_players_who_are_helped_do_as_the_reference_players(
    player: SimulatedPlayer, person: Callable[[Random], Person], rule: TargetRule
) -> None:
    policy, rng = mixed(4), Random(9)
    ours = simulate_games(policy, player, rule, GAMES, 3)
    theirs = [play(policy, person(rng), rule, rng) for _ in range(REFERENCE_GAMES)]
    for mine, other in compared(ours, theirs):
        assert apart(mine, other, GAMES) < SIGMAS


def compared(ours: GameResults, theirs: list[Played]) -> list[tuple[Spread, Spread]]:
    """Flips, assistance and first-card hints of both."""
    return [
        (ours.flips, Spread.of([float(game.flips) for game in theirs])),
        (ours.assistance, Spread.of([game.levels / game.flips for game in theirs])),
        (ours.first_card_hints, Spread.of([float(game.first_card_hints) for game in theirs])),
    ]


def test_a_card_hint_before_every_flip_leaves_nothing_to_chance() -> None:
    games = simulate_games(always(ActionSpec.SUG_CARD), ChancePlayer(), TargetRule.RANDOM, 50, 1)
    assert set(games.each(0)) == {24.0}


def test_a_player_who_never_follows_plays_as_if_alone() -> None:
    deaf = simulate_games(always(ActionSpec.SUG_CARD), MemoryPlayer((0.2, 0.2), 0.0), TargetRule.RANDOM, GAMES, 5).moves
    assert deaf.mean == pytest.approx(30.55, abs=SIGMAS * 4.2 / math.sqrt(GAMES))


def test_hints_are_followed_as_often_as_the_player_says() -> None:
    games = simulate_games(always(ActionSpec.SUG_CARD), MemoryPlayer((0.3, 0.3), 0.6), TargetRule.RANDOM, GAMES, 5)
    # A player who does not follow may still take the card, so the measured share is a little higher, never lower.
    assert 0.6 < games.measures()["followed"] < 0.75


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: ChancePlayer(1.5), "threshold must be a number from 0 to 1, not 1.5"),
        (lambda: ChancePlayer(math.nan), "threshold must be a number from 0 to 1, not nan"),
        (lambda: MemoryPlayer((-0.1, 0.2)), "forgetting must be a number from 0 to 1, not -0.1"),
        (lambda: MemoryPlayer((0.4, 0.2)), "forgetting must be a number from 0.4 to 1, not 0.2"),
        (lambda: MemoryPlayer(follow=2), "follow must be a number from 0 to 1, not 2"),
        (lambda: TextPlayer(2), "forgetting must be a number from 0 to 1, not 2"),
        (lambda: TextPlayer(math.nan), "forgetting must be a number from 0 to 1, not nan"),
        (lambda: MemoryPlayer((0.1, math.nan)), "forgetting must be a number from 0.1 to 1, not nan"),
        (lambda: ChancePlayer(-math.inf), "threshold must be a number from 0 to 1, not -inf"),
        (lambda: ChancePlayer(follow=cast("Any", "1")), "follow must be a number from 0 to 1, not '1'"),
        (lambda: ChancePlayer(follow=cast("Any", None)), "follow must be a number from 0 to 1, not None"),
        (lambda: ChancePlayer(follow=True), "follow must be a number from 0 to 1, not True"),
        (lambda: TextPlayer(counting=cast("Any", "total")), "counting must be one of .*, not 'total'"),
        (lambda: MemoryPlayer(cast("Any", 0.2)), "forgetting must be a range of two numbers, .*, not 0.2"),
        (lambda: MemoryPlayer(cast("Any", (0.2,))), r"forgetting must be a range of two numbers, .*, not \(0.2,\)"),
    ],
)
def test_impossible_parameters_are_refused_in_words(make: Callable[[], SimulatedPlayer], sentence: str) -> None:
    with pytest.raises(UserInputError, match=f"^{sentence}$"):
        make()


def test_the_reading_of_the_text_under_which_games_do_not_end_is_refused() -> None:
    with pytest.raises(UserInputError, match=r"never finishes a game: use a forgetting below 0\.05"):
        TextPlayer(0.05, Counting.TOTAL)
    finishing = simulate_games(QTable.blank(), TextPlayer(0.04, Counting.TOTAL), TargetRule.RANDOM, 300, 1)
    assert max(finishing.each(0)) < 300


def test_a_player_who_forgets_everything_at_once_still_finishes() -> None:
    assert alone(MemoryPlayer((1.0, 1.0))).mean > 60
