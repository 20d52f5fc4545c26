"""Games in which the model of memory decides when to help, and the choice of its thresholds."""

from __future__ import annotations

import tomllib
from dataclasses import replace
from pathlib import Path

import pytest

from kiosk import UserInputError
from kiosk.assistance.memory_model import MemoryEstimate, MemoryTiming
from kiosk.assistance.mentaliser import TargetRule
from kiosk.assistance.policy import ActionSpec, Gate, QTable
from kiosk.config import AssistanceConfig
from kiosk.training.memory_timing import TimingExperiment, TunedTiming, best_timing, timing_grid
from kiosk.training.simulated_players import MemoryPlayer
from kiosk.training.simulation import T_FIRST, T_SECOND, GameResults, simulate_games
from tests.training.test_commands import run, told

PLAYER = MemoryPlayer((0.3, 0.3))
TARGET = TargetRule.MOST_FLIPPED
GAMES, SEED = 6, 3
EXPERIMENT = TimingExperiment(Gate(), PLAYER, TARGET, GAMES, SEED)


def played(first: float, second: float, seed: int = SEED) -> GameResults:
    """Play a few games with these thresholds."""
    return replace(EXPERIMENT, seed=seed).play(MemoryTiming(first, second))


def test_thresholds_of_0_never_help_and_the_games_are_those_without_help() -> None:
    alone = simulate_games(QTable.blank(), PLAYER, TARGET, GAMES, SEED)
    assert played(0, 0) == alone


def test_each_threshold_is_for_its_card() -> None:
    first, second = played(0.9, 0), played(0, 0.9)
    assert (first.total(T_SECOND), second.total(T_FIRST)) == (0, 0)
    assert min(first.total(T_FIRST), second.total(T_SECOND)) > 0


def test_higher_thresholds_help_more_and_leave_fewer_flips() -> None:
    little, much = played(0.05, 0.05), played(0.5, 0.9)
    assert little.assistance.mean < much.assistance.mean
    assert little.flips.mean > much.flips.mean


def test_the_same_seed_plays_the_same_games() -> None:
    assert played(0.2, 0.4) == played(0.2, 0.4)
    assert played(0.2, 0.4) != played(0.2, 0.4, SEED + 1)


def test_the_best_thresholds_have_the_fewest_flips_at_no_more_than_the_assistance() -> None:
    tried = list(EXPERIMENT.tune(timing_grid((0.0, 0.5), (0.0,), (0,))))
    assert [(each.timing.first, each.timing.second) for each in tried] == [(0, 0), (0, 0.5), (0.5, 0), (0.5, 0.5)]
    allowed = sorted(each.results.assistance.mean for each in tried)[2]
    best = best_timing(tried, allowed)
    others = [each for each in tried if each.results.assistance.mean <= allowed]
    assert best in others
    assert best.results.flips.mean == min(each.results.flips.mean for each in others)


def test_the_games_that_are_played_are_counted_over_all_timings() -> None:
    counted: list[int] = []
    assert len(list(EXPERIMENT.tune(timing_grid((0.1, 0.2), (0.0,), (24,)), counted.append))) == 4
    assert counted == list(range(1, 4 * GAMES + 1))


def test_where_all_help_too_much_the_one_that_helps_least_is_taken() -> None:
    tried = [TunedTiming(MemoryTiming(*each), played(*each)) for each in ((0.3, 0.6), (0.1, 0.2))]
    assert best_timing(tried, 0.0) is tried[1]


def test_a_lower_spread_can_be_asked_for() -> None:
    tried = list(EXPERIMENT.tune(timing_grid((0.0, 0.5), (0.0, 0.1), (0,))))
    spreads = sorted(each.results.flips.sd for each in tried)
    assert best_timing(tried, 9, spreads[0]).results.flips.sd == spreads[0]
    assert best_timing(tried, 9, 0).results.flips.sd == spreads[0]
    assert best_timing(tried, 9).results.flips.mean == min(each.results.flips.mean for each in tried)


def test_a_card_that_was_seen_and_is_forgotten_is_named() -> None:
    timing = MemoryTiming(0.2, 0.4, 0.1)
    before = MemoryEstimate(0.2, 0.05, None, None, ())
    column, none = ActionSpec.SUG_COL, ActionSpec.NO_HELP
    cases = ((0.0, column), (0.05, ActionSpec.SUG_CARD), (0.1, column), (0.4, none))
    for recalled, action in cases:
        assert timing.action(replace(before, completes=0.1, match_recalled=recalled), 9) is action
    assert timing.action(before, 9) is ActionSpec.SUG_COL
    assert "was seen" in timing.told(replace(before, completes=0.1), 9)


def test_help_goes_to_long_games_where_it_begins_after_some_flips() -> None:
    timing = MemoryTiming(0.2, 0.4, 0.1, 24)
    before = MemoryEstimate(0.2, 0.05, None, None, ())
    assert [timing.action(before, flips) for flips in (23, 24)] == [ActionSpec.NO_HELP, ActionSpec.SUG_COL]
    assert "no help before 24" in timing.told(before, 23)
    assert "below 0.2" in timing.told(before, 24)
    early, late = (EXPERIMENT.play(replace(timing, flips=flips)) for flips in (0, 24))
    assert late.total(T_SECOND) < early.total(T_SECOND)


@pytest.fixture
def few(monkeypatch: pytest.MonkeyPatch) -> None:
    """Have the command try four pairs of thresholds."""
    monkeypatch.setattr("kiosk.cli.learning.timing_grid", lambda: timing_grid((0.1, 0.4), (0.07,), (12,)))


@pytest.mark.usefixtures("few")
def test_train_writes_thresholds_that_a_study_file_can_take(tmp_path: Path) -> None:
    out = tmp_path / "thresholds.toml"
    document = told("train", "--timing", "model", "--games", "3", "--out", str(out))
    read = AssistanceConfig(**tomllib.loads(out.read_text("utf-8"))["assistance"])
    assert read.timing == "model"
    assert read.threshold_card == document["threshold_card"] == 0.07
    assert read.threshold_flips == document["threshold_flips"] == 12
    assert (read.threshold_first, read.threshold_second) == (document["threshold_first"], document["threshold_second"])


def test_simulate_plays_by_the_model() -> None:
    words = ("simulate", "--player", "memory", "--games", "3", "--timing", "model", "--threshold-second", ".7")
    document = told(*words)
    assert document["timing"] == {"first": 0.2, "second": 0.7, "card": 0.05, "flips": 24}
    assert document["assistance_per_flip"] > 0


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ("simulate --threshold-first .3", "--threshold-first, -second, -card and -flips are for --timing model only"),
        ("simulate --timing model --threshold-first 3", "the threshold of first cards must be a number from 0 to 1"),
        ("train --out x.toml --games 5", "--games, --assistance and --spread are for --timing model only"),
        ("train --out x.toml --timing model --gamma .5", "--gamma is for a table; --timing model learns thresholds"),
        ("train --out x.toml --timing model --games 1", "there must be at least 2 games, not 1"),
    ],
)
def test_options_of_the_other_timing_are_refused(
    words: str, sentence: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(UserInputError, match=sentence):
        run(*words.split())
    assert not list(tmp_path.iterdir())
