"""What a report says of looks, remarks and the model of memory."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from kiosk.analysis.behaviours import BINS, MemoryCalibration, calibrated
from kiosk.analysis.data import load_study
from kiosk.analysis.report import make_report, report_json
from kiosk.analysis.report_page import report_page
from kiosk.assistance.memory_model import MemoryModel
from kiosk.assistance.mentaliser import TargetRule
from kiosk.assistance.policy import ActionSpec, FlipInMove, Gate, Phase
from kiosk.config import AssistanceConfig, ConditionConfig
from kiosk.experiment.condition import Condition
from kiosk.experiment.events import CardFlipped, HintGiven, MemoryEstimated, RemarkGiven
from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import PsychDs
from kiosk.training.simulated_players import ChancePlayer, PopulationPlayer, SimulatedPlayer
from kiosk.training.simulation import lay, playing, start, take
from kiosk.training.vectorised_game import CARDS, FLIPS, LAST, MATE, NO_HELP, gate_plan
from tests.experiment.driver import Driver, forgetful
from tests.export.visitors import store, study_plan
from tests.samples import policy_that

HELPS_IN_THE_MIDDLE = policy_that(
    lambda state: ActionSpec.SUG_COL if state.game is Phase.MIDDLE else ActionSpec.NO_HELP, Gate()
)


def test_right_predictions_are_calibrated_and_their_intervals_hold() -> None:
    rng = np.random.default_rng(4)
    whose = np.repeat([f"P{number}" for number in range(40)], 100)
    chances = rng.random(len(whose))
    found = calibrated(chances, (rng.random(len(whose)) < chances).astype(float), whose)
    assert (found.cards, found.people, len(found.bins)) == (4000, 40, BINS)
    # The Brier score of a chance that is right and evenly spread is 1/6.
    assert found.brier == pytest.approx(1 / 6, abs=0.01)
    assert found.calibration_error < 0.03
    assert sum(each.matched_low <= each.predicted <= each.matched_high for each in found.bins) >= BINS - 2


def test_predictions_that_are_too_high_have_an_error_and_a_worse_score() -> None:
    whose = np.array([f"P{number % 5}" for number in range(100)])
    hits = (np.arange(100) % 4 == 0).astype(float)
    found = calibrated(np.full(100, 0.75), hits, whose)
    assert found.calibration_error == pytest.approx(0.5)
    assert found.brier == pytest.approx(0.25 * 0.0625 + 0.75 * 0.5625)
    assert found.brier > found.brier_of_share == pytest.approx(0.1875)


def test_a_share_of_two_people_has_no_interval() -> None:
    (only,) = calibrated(np.array([0.4, 0.45]), np.array([1.0, 0.0]), np.array(["P1", "P2"])).bins
    assert math.isnan(only.matched_low)
    assert only.matched == pytest.approx(0.5)


def predictions(player: SimulatedPlayer, games: int, seed: int) -> MemoryCalibration:
    """Return the calibration over games without help."""
    table = lay(player, gate_plan(Gate(), TargetRule.RANDOM), seed)
    rows = []
    for number in range(games):
        start(table)
        game = table.game
        model = MemoryModel([int(mate) for mate in game[MATE : MATE + CARDS]])
        while playing(game):
            completes = model.estimate().completes
            matched = take(table, NO_HELP)
            if completes is not None:
                rows.append((completes, float(matched), f"P{number}"))
            model.flip(next(place for place in range(CARDS) if game[LAST + place] == game[FLIPS]))
    chances, hits, whose = zip(*rows, strict=True)
    return calibrated(np.array(chances), np.array(hits), np.array(whose))


def test_the_model_is_calibrated_for_players_that_it_is_a_model_of() -> None:
    found = predictions(PopulationPlayer(), 30, 3)
    assert found.people == 30
    assert found.brier < 0.8 * found.brier_of_share
    assert found.calibration_error < 0.06


def test_the_model_is_found_wrong_for_players_of_another_kind() -> None:
    """The chance player has sure matches that no memory explains."""
    assert predictions(ChancePlayer(), 15, 3).calibration_error > 0.1


@pytest.fixture(scope="module")
def played(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[Driver]]:
    """Return the data set of six visitors with a model of memory, half of them praised, and their games."""
    folder = tmp_path_factory.mktemp("behaviours")
    drivers = []
    for number in range(6):
        plan = study_plan(Condition.TOM if number % 2 else Condition("praised"))
        changes = {
            "assistance": AssistanceConfig(memory_model=True),
            "conditions": {"praised": ConditionConfig(praise=1)},
        }
        settings = plan.settings.model_copy(update=changes)
        driver = Driver(replace(plan, settings=settings, policy=HELPS_IN_THE_MIDDLE), number)
        driver.to_the_game()
        driver.play(forgetful(number))
        driver.end()
        drivers.append(driver)
    store(folder / "data", [(driver, number) for number, driver in enumerate(drivers)])
    export_dataset(folder / "data", folder / "out", PsychDs)
    return folder / "out", drivers


def test_a_report_counts_remarks_and_compares_predictions_with_what_came(played: tuple[Path, list[Driver]]) -> None:
    folder, drivers = played
    report = make_report(load_study(folder))
    counted = {(each.condition, each.behaviour): each.times for each in report.behaviours}
    assert counted == {
        ("praised", "praise"): sum(len(driver.noted(RemarkGiven)) for driver in drivers),
        ("tom", "praise"): 0,
    }
    predicted = [memory.completes for driver in drivers for memory in driver.noted(MemoryEstimated)]
    seconds = sum(flip.matched is not None for driver in drivers for flip in driver.noted(CardFlipped))
    assert report.memory is not None
    helped = sum(hint.card is FlipInMove.SECOND for driver in drivers for hint in driver.noted(HintGiven))
    assert report.memory.cards == sum(chance is not None for chance in predicted) - helped < seconds
    assert 0 < report.memory.brier < 1
    assert {"behaviours", "memory"} <= {section.id for section in report_page(report).sections}
    assert report_json(report)["memory_model"]["cards"] == report.memory.cards
