"""How well the model of the player's memory predicts the next card, and how long it takes."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest

from kiosk.assistance.memory_model import MemoryModel
from kiosk.assistance.mentaliser import TargetRule
from kiosk.assistance.policy import QTable
from kiosk.training.simulated_players import MemoryPlayer
from kiosk.training.simulation import RecordedGame, record_games
from kiosk.training.vectorised_game import NO_HELP
from tests.bench.percentiles import tell_percentiles

GAMES = 120
MOST_MS = 1.0


@pytest.fixture(scope="module")
def games() -> list[RecordedGame]:
    """Games of players with d from .10 to .45 under the default table."""
    policy = QTable.load(Path("policies/default.json"))
    return list(record_games(policy, MemoryPlayer((0.1, 0.45)), TargetRule.MOST_FLIPPED, GAMES, seed=1))


def test_the_next_card_is_predicted_better_than_by_the_rules(games: list[RecordedGame]) -> None:
    """Mean of -log p over flips without help; a player who knows the rules only has 2.50 and 1.90 nats."""
    surprise: dict[int, list[float]] = {0: [], 1: []}
    for game in games:
        model = MemoryModel(game.mates)
        for number, (place, action, _) in enumerate(game.flips):
            if action == NO_HELP:
                surprise[number % 2].append(-math.log(model.next_card()[place]))
            model.flip(place, hinted=action != NO_HELP)
    first, second = (sum(each) / len(each) for each in surprise.values())
    assert first <= 2.42, first
    assert second <= 1.78, second


def test_a_decision(benchmark: Any, games: list[RecordedGame]) -> None:
    """One flip recorded, and all that is asked before the next: each card's recall and the chance of a match."""
    flips = [(game, number) for game in games[:40] for number in range(len(game.flips))]
    models = {id(game): MemoryModel(game.mates) for game in games[:40]}
    todo = iter(flips)

    def decide() -> None:
        game, number = next(todo)
        model = models[id(game)]
        model.flip(game.flips[number][0])
        if number + 1 < len(game.flips):
            model.chance_to_match()
            model.recall()

    benchmark.pedantic(decide, rounds=len(flips) - 1)
    tell_percentiles(benchmark)
    assert benchmark.stats.stats.median * 1000 < MOST_MS
