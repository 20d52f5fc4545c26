"""The shipped tables do in play what is claimed of them; what is measured is what the study measures.

The games here are few, and the intervals wide; the figures in docs/explanation/learning.md are made with
20,000 games an arm.
"""

from __future__ import annotations

import math
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kiosk import UserInputError
from kiosk.assistance.mentaliser import TargetRule
from kiosk.assistance.policy import ACTIONS, ActionSpec, Gate, MoveOutcome, PolicyError, QTable, State
from kiosk.cli.evidence import difference
from kiosk.config import POLICIES
from kiosk.training import policies, simulation
from kiosk.training.simulated_players import ChancePlayer, MemoryPlayer
from kiosk.training.simulation import (
    T_CARD,
    T_COL,
    T_FIRST,
    T_FLIPS,
    T_ROW,
    T_SECOND,
    GameResults,
    Spread,
    simulate_games,
)
from tests.samples import always, mixed, policy_that

GAMES = 1000
TOM, NOTOM = TargetRule.MOST_FLIPPED, TargetRule.RANDOM


def forgetting(d: float) -> MemoryPlayer:
    """Return a player with a memory."""
    return MemoryPlayer((d, d))


@cache
def played(player: ChancePlayer | MemoryPlayer, target: TargetRule) -> GameResults:
    """Games under the default table."""
    return simulate_games(QTable.named("default"), player, target, GAMES, 17)


@pytest.mark.parametrize("player", [ChancePlayer(), forgetting(0.2), forgetting(0.25)])
def test_the_default_table_helps_about_as_much_as_the_study_did(player: ChancePlayer | MemoryPlayer) -> None:
    assert 0.2 <= played(player, NOTOM).assistance.mean <= 0.36


@pytest.mark.parametrize("d", [0.2, 0.25])
def test_the_default_table_hints_on_first_cards(d: float) -> None:
    assert 2 <= played(forgetting(d), NOTOM).first_card_hints.mean <= 6


def test_the_default_table_shortens_the_chance_player_s_games_by_a_tenth_at_least() -> None:
    moves = played(ChancePlayer(), NOTOM).moves
    assert moves.ci95[1] < 0.9 * 48.19
    assert abs(moves.mean - 41.73) < 8.83


def test_tom_saves_flips_with_less_assistance() -> None:
    without, tom = played(forgetting(0.2), NOTOM), played(forgetting(0.2), TOM)
    low, saved, _ = difference(without.flips, tom.flips, GAMES)
    assert saved >= 2
    assert low > 0
    assert tom.assistance.mean < without.assistance.mean


def test_the_conditions_are_equal_for_a_player_without_a_memory() -> None:
    low, _, high = difference(played(ChancePlayer(), NOTOM).flips, played(ChancePlayer(), TOM).flips, GAMES)
    assert low - 1 < 0 < high + 1


@pytest.mark.parametrize("player", [ChancePlayer(), forgetting(0.2)])
@pytest.mark.parametrize("target", [TOM, NOTOM])
def test_the_paper_s_four_sentences_hold_of_the_default_table(
    player: ChancePlayer | MemoryPlayer, target: TargetRule
) -> None:
    rates = played(player, target).measures()["hint_rate"]
    said = policies.policy_claims(QTable.named("default"), rates["first"], rates["second"])
    assert [sentence.text for sentence in said if not sentence.holds] == []
    assert len(said) == 4


def test_a_table_that_never_helps_fails_the_paper_s_sentences_about_helping() -> None:
    holds = [sentence.holds for sentence in policies.policy_claims(QTable.blank(), 0, 0)]
    assert holds == [True, False, False, False]


def test_without_the_gate_a_table_that_always_helps_steps_in_too_soon() -> None:
    assert not policies.policy_claims(always(ActionSpec.SUG_ROW), 1, 1)[0].holds
    assert policies.policy_claims(always(ActionSpec.SUG_ROW, Gate()), 1, 1)[0].holds


def test_a_tally_adds_up() -> None:
    games = simulate_games(mixed(3), MemoryPlayer((0.2, 0.4), 0.8), TOM, 50, 1)
    for tally in games.tallies:
        assert tally[T_FIRST] + tally[T_SECOND] == tally[T_COL] + tally[T_ROW] + tally[T_CARD] <= tally[T_FLIPS]
        assert tally[T_FLIPS] % 2 == 0


def test_assistance_per_flip_is_the_mean_level_of_help() -> None:
    level = {ActionSpec.SUG_COL: 0.5, ActionSpec.SUG_ROW: 1.0, ActionSpec.SUG_CARD: 2.0, ActionSpec.NO_HELP: 0.0}
    for action in ACTIONS:
        games = simulate_games(always(action), ChancePlayer(), NOTOM, 20, 1)
        assert games.assistance == Spread(level[action], 0.0, (level[action], level[action]))


def test_led_to_match_counts_first_card_hints_that_were_followed_into_a_match() -> None:
    def second_cards(state: State) -> ActionSpec:
        return (
            ActionSpec.SUG_CARD if state.outcome in (MoveOutcome.S_CORRECT, MoveOutcome.S_WRONG) else ActionSpec.SUG_ROW
        )

    assert simulate_games(policy_that(second_cards), ChancePlayer(), NOTOM, 20, 1).measures()["led_to_match"] == 1.0
    assert simulate_games(QTable.blank(), ChancePlayer(), NOTOM, 20, 1).measures()["led_to_match"] is None


def test_shares_of_hints_are_means_over_games_as_over_people_with_the_pooled_ones_beside_them() -> None:
    # flips, first, second, column, row, card, followed first, followed second, led to a match
    one = (40, 1, 1, 2, 0, 0, 1, 1, 1)
    other = (80, 10, 0, 10, 0, 0, 2, 0, 1)
    without = (40, 0, 0, 0, 0, 0, 0, 0, 0)
    measures = GameResults((one, other, without)).measures()
    assert measures["followed"] == pytest.approx((2 / 2 + 2 / 10) / 2)
    assert measures["followed_first_card"] == pytest.approx((1 / 1 + 2 / 10) / 2)
    assert measures["led_to_match"] == pytest.approx((1 / 1 + 1 / 10) / 2)
    assert measures["pooled"] == pytest.approx(
        {"followed": 4 / 12, "followed_first_card": 3 / 11, "led_to_match": 2 / 11}
    )
    assert measures["games_with"] == {"followed": 2, "followed_first_card": 2, "led_to_match": 2}


@given(st.lists(st.floats(-1e6, 1e6), min_size=2, max_size=40))
def test_a_spread_is_the_mean_the_sample_sd_and_a_normal_interval(values: list[float]) -> None:
    spread = Spread.of(values)
    mean = sum(values) / len(values)
    sd = math.sqrt(sum((value - mean) ** 2 for value in values) / (len(values) - 1))
    assert spread.mean == pytest.approx(mean, abs=1e-6)
    assert spread.sd == pytest.approx(sd, rel=1e-6, abs=1e-6)
    half = (spread.ci95[1] - spread.ci95[0]) / 2
    assert half == pytest.approx(1.96 * sd / math.sqrt(len(values)), rel=1e-4, abs=1e-6)


def test_games_follow_from_the_seed_whatever_the_batches() -> None:
    few = simulate_games(QTable.blank(), ChancePlayer(), NOTOM, 10, 3)
    assert simulate_games(QTable.blank(), ChancePlayer(), NOTOM, 600, 3).tallies[:10] == few.tallies
    assert simulate_games(QTable.blank(), ChancePlayer(), NOTOM, 10, 4) != few


def test_progress_is_told_how_many_games_are_through() -> None:
    told: list[int] = []
    simulate_games(QTable.blank(), forgetting(0), NOTOM, simulation.BATCH + 1, 1, told.append)
    assert told == [simulation.BATCH, simulation.BATCH + 1]


@pytest.mark.parametrize(
    ("games", "seed", "sentence"),
    [
        (1, 1, "at least 2 games, not 1"),
        (-4, 1, "at least 2 games, not -4"),
        (2.5, 1, "the number of games must be a whole number, not 2.5"),
        (float("nan"), 1, "the number of games must be a whole number, not nan"),
        ("9", 1, "the number of games must be a whole number, not '9'"),
        (9, -1, "0 or more, not -1"),
        (9, 1.0, "the seed must be a whole number, not 1.0"),
        (9, True, "the seed must be a whole number, not True"),
    ],
)
def test_impossible_numbers_are_refused_in_words(games: Any, seed: Any, sentence: str) -> None:
    with pytest.raises(UserInputError, match=sentence):
        simulate_games(QTable.blank(), ChancePlayer(), NOTOM, games, seed)


def test_a_game_that_was_given_up_is_a_refusal_and_no_number() -> None:
    with pytest.raises(UserInputError, match="a game was given up after 5,000 flips"):
        simulation.refuse_endless(5000)


def test_comparing_counts_only_states_that_both_tables_know() -> None:
    default = QTable.named("default")
    same = policies.compare_policies(default, default)
    assert (same.agreement, same.largest) == (1.0, 0.0)
    assert set(same.compared) == set(policies.visits(default))
    other = policies.compare_policies(default, QTable.blank())
    assert set(other.different) == set(policies.helped(default))


@pytest.mark.parametrize("name", ["default", "study-like", "no-help"])
def test_every_shipped_table_is_found_by_its_name_and_has_a_card(name: str) -> None:
    assert QTable.named(name).name == name
    card = (POLICIES / f"{name}.md").read_text("utf-8")
    assert QTable.named(name).sha256 in card
    assert QTable.named(name).training["command"] in card


def test_a_policy_that_is_not_there_is_one_sentence(tmp_path: Path) -> None:
    with pytest.raises(PolicyError, match="cannot be read: No such file or directory"):
        QTable.named(str(tmp_path / "nothing.json"))
