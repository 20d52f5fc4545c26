"""The way of the pointer is recorded of those who agreed to it, and of no others."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from kiosk.config import Privacy
from kiosk.experiment.events import CardSelected
from kiosk.experiment.information import POINTER, Purpose
from kiosk.experiment.outcomes import Stage
from kiosk.experiment.session_config import SessionConfig
from kiosk.experiment.transitions import InvalidTransition
from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import PsychDs
from tests.experiment.driver import Driver
from tests.export.conftest import rows_of
from tests.export.visitors import store, study_plan

WAY = ((120, 0.5, 0.25), (87, 1.25, 0.5))


def tracing(*, on: bool = True) -> SessionConfig:
    """Return a plan whose consent offers the purpose, and whose settings ask for the way of the pointer."""
    plan = study_plan()
    consent = plan.information.consent
    purposes = (*consent.purposes, Purpose(id=POINTER, text="the way of the mouse", required=False))
    information = plan.information.model_copy(update={"consent": consent.model_copy(update={"purposes": purposes})})
    settings = plan.settings.model_copy(update={"privacy": Privacy(pointer_trace=on)})
    return replace(plan, settings=settings, information=information)


def playing(plan: SessionConfig, *, agrees: bool) -> Driver:
    """Return a session in the game, whose visitor agreed to the purpose or not."""
    driver = Driver(plan, 1)
    driver.to(Stage.CONSENT)
    offered = [purpose.id for purpose in plan.information.consent.purposes]
    driver.tick(*(name for name in offered if agrees or name != POINTER))
    driver.agree()
    driver.to(Stage.GAME)
    driver.wait_until_open()
    return driver


def tap(driver: Driver) -> None:
    """Tap a card to which the pointer came on that way."""
    driver.send(CardSelected(at_ms=driver.now, position=driver.view.closed[0], trace=WAY))


@pytest.mark.parametrize(("on", "agrees"), [(False, True), (True, False), (False, False)])
def test_without_setting_or_consent_no_way_is_taken(*, on: bool, agrees: bool) -> None:
    driver = playing(tracing(on=on), agrees=agrees)
    assert not driver.session.traces_pointer
    with pytest.raises(InvalidTransition):
        tap(driver)
    driver.tap(driver.view.closed[0])


def test_the_way_stands_in_a_table_of_its_own(tmp_path: Path) -> None:
    driver = playing(tracing(), agrees=True)
    tap(driver)
    tapped = driver.now
    driver.end()
    store(tmp_path / "data", [(driver, 1)])
    export_dataset(tmp_path / "data", tmp_path / "out", PsychDs)
    rows = rows_of(tmp_path / "out", "pointer")
    assert [(row["flip"], row["pointer_place"], row["pointer_x"], row["pointer_y"]) for row in rows] == [
        ("1", "1", "0.5", "0.25"),
        ("1", "2", "1.25", "0.5"),
    ]
    assert [int(row["pointer_ms"]) for row in rows] == [tapped - 120, tapped - 87]
    assert all("trace" not in json.loads(row["fields"]) for row in rows_of(tmp_path / "out", "events"))


def test_a_study_without_it_has_no_such_table(tmp_path: Path) -> None:
    driver = playing(tracing(on=False), agrees=True)
    driver.end()
    store(tmp_path / "data", [(driver, 1)])
    export_dataset(tmp_path / "data", tmp_path / "out", PsychDs)
    assert list((tmp_path / "out" / "data").glob("*pointer*")) == []
