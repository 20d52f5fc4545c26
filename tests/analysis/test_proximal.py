"""The effect of each kind of hint on its own move, from decisions that were drawn at random."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from random import Random

import numpy as np
import pytest

from kiosk.analysis.data import load_study
from kiosk.analysis.proximal import Draws, estimate, proximal_effects
from kiosk.analysis.report import make_report
from kiosk.analysis.report_page import report_page
from kiosk.analysis.statistics import NotEstimableError
from kiosk.config import AssistanceConfig
from kiosk.experiment.condition import Condition
from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import PsychDs
from tests.experiment.driver import Driver, forgetful
from tests.export.visitors import store, study_plan

NONE, CARD = "no_help", "sug_card"


def study(people: int, seed: int) -> Draws:
    """Return decisions in which help comes more often to those in need, and adds .3 to the chance of a match."""
    rng = Random(seed)
    rows = []
    for who in range(people):
        for _ in range(20):
            needs = rng.random() < 0.5
            chance = 0.8 if needs else 0.2
            helped = rng.random() < chance
            matched = rng.random() < (0.2 if needs else 0.6) + 0.3 * helped
            rows.append((CARD if helped else NONE, chance if helped else 1 - chance, str(who), float(matched)))
    actions, chances, whose, hits = zip(*rows, strict=True)
    return Draws(actions, np.array(chances), whose, np.array(hits))


def test_the_estimate_is_right_where_those_in_need_are_helped_more_often() -> None:
    found = [estimate(study(30, seed), CARD) for seed in range(200)]
    effects = np.array([effect for _, _, effect, _, _ in found])
    assert abs(effects.mean() - 0.3) < 0.01
    assert 0.92 <= np.mean([low <= 0.3 <= high for _, _, _, low, high in found]) <= 0.98
    drawn = study(200, 1)
    taken = np.array(drawn.action) == CARD
    plain = drawn.matched[taken].mean() - drawn.matched[~taken].mean()
    assert plain < 0.2


def test_too_few_people_give_a_reason_and_no_number() -> None:
    with pytest.raises(NotEstimableError, match="only 2 people"):
        estimate(study(2, 1), CARD)


def test_a_report_has_the_effects_of_a_study_that_explores(tmp_path: Path) -> None:
    drivers = []
    for number in range(6):
        plan = study_plan(Condition.TOM if number % 2 else Condition.NOTOM)
        explored = plan.settings.model_copy(update={"assistance": AssistanceConfig(explore=0.6)})
        driver = Driver(replace(plan, settings=explored), number)
        driver.to_the_game()
        driver.play(forgetful(number))
        driver.end()
        drivers.append((driver, number))
    store(tmp_path / "data", drivers)
    export_dataset(tmp_path / "data", tmp_path / "out", PsychDs)

    read = load_study(tmp_path / "out")
    assert read.decisions is not None
    report = make_report(read)
    assert {(each.card, each.action) for each in report.proximal} <= {
        (card, action) for card in ("first", "second") for action in ("sug_col", "sug_row", "sug_card")
    }
    drawn = zip(read.decisions.truths("randomised"), read.decisions.text("action"), strict=True)
    assert sum(each.decisions for each in report.proximal) == sum(random and action != NONE for random, action in drawn)
    assert all(-1 <= each.low < each.effect < each.high <= 1 for each in report.proximal if not each.note)
    assert any(section.id == "proximal" for section in report_page(report).sections)
    assert proximal_effects(read.decisions, read.tables["flips"], ()) == ()
