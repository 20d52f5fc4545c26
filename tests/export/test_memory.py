"""What the model of memory held stands in the data set of a study that has one, and of no other."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from kiosk.config import AssistanceConfig
from kiosk.experiment.events import MemoryEstimated
from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import PsychDs
from tests.experiment.driver import Driver, forgetful
from tests.export.conftest import rows_of
from tests.export.visitors import store, study_plan


def test_every_card_and_every_decision_has_its_chances(tmp_path: Path) -> None:
    plan = study_plan()
    settings = plan.settings.model_copy(update={"assistance": AssistanceConfig(memory_model=True)})
    driver = Driver(replace(plan, settings=settings), 1)
    driver.to_the_game()
    driver.play(forgetful(1))
    driver.end()
    store(tmp_path / "data", [(driver, 1)])
    export_dataset(tmp_path / "data", tmp_path / "out", PsychDs)

    held = driver.noted(MemoryEstimated)
    cells = [int(row["recalled_percent"]) for row in rows_of(tmp_path / "out", "memory")]
    assert cells == [percent for memory in held for percent in memory.recall]
    decisions = rows_of(tmp_path / "out", "decisions")
    for name, of in (("match_recalled", "match_recalled"), ("completes_predicted", "completes")):
        told = [float(row[name]) if row[name] else None for row in decisions]
        assert told == [getattr(memory, of) for memory in held]
    assert decisions[0]["last_flip_predicted"] == ""


def test_a_study_without_a_model_has_no_such_table_and_columns(exported: Path) -> None:
    assert not list(exported.glob("**/memory*.csv"))
    assert "match_recalled" not in rows_of(exported, "decisions")[0]
