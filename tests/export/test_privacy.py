"""What is not to be told is nowhere in a data set, in no file and in no file's date."""

from __future__ import annotations

import json
import re
import sqlite3
from collections.abc import Iterable
from contextlib import closing
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from random import Random

import pytest

from kiosk.config import Allocation, ConsentConfig, RobotConfig
from kiosk.experiment.events import ResponseGiven, Stage
from kiosk.experiment.items import ShortText
from kiosk.export.columns import ExportOption
from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import Bids, Layout, PsychDs
from kiosk.store.database import FILE
from tests.experiment.driver import Driver
from tests.export.conftest import rows_of
from tests.export.visitors import answer_all, store, study_plan, unsharing, visitor

NAME_TYPED = "Zaphod Beeblebrox"
REASON = "Trillian came for him"
SEED = 3_141_592_653
BOTH = (PsychDs, Bids)


def texts(folder: Path) -> Iterable[tuple[Path, str]]:
    return ((path, path.read_text("utf-8")) for path in folder.rglob("*") if path.is_file())


def talkative() -> Driver:
    """Return a visitor who types their name, and whom the experimenter sends away with another one."""
    plan = study_plan()
    plan = replace(
        plan,
        settings=plan.settings.model_copy(
            update={"robot": RobotConfig(host="robot.at.home"), "consent": ConsentConfig(contact="me@example.org")}
        ),
        about_you=plan.about_you.model_copy(
            update={
                "items": tuple(
                    item.model_copy(update={"longest": 120}) if isinstance(item, ShortText) else item
                    for item in plan.about_you.items
                )
            }
        ),
    )
    driver = Driver(plan, SEED)
    driver.to(Stage.ABOUT_YOU)
    answer_all(driver, Random(1), {"job": NAME_TYPED})
    driver.to(Stage.GAME)
    driver.flip(driver.view.closed[0])
    driver.end(REASON)
    return driver


@pytest.fixture
def told(tmp_path: Path) -> Path:
    """Return a data folder with that visitor in it."""
    driver = talkative()
    assert any(isinstance(event, ResponseGiven) and event.value == NAME_TYPED for event in driver.events)
    store(tmp_path / "data", [(driver, SEED)])
    return tmp_path / "data"


@pytest.mark.parametrize("layout", BOTH)
def test_neither_code_nor_seed_nor_typed_text_nor_place_is_told(told: Path, layout: type[Layout]) -> None:
    with closing(sqlite3.connect(told / FILE)) as connection:
        ((code,),) = connection.execute("SELECT code FROM participant").fetchall()
    out = told.parent / "out"
    export_dataset(told, out, layout)
    secrets = (code, str(SEED), NAME_TYPED, REASON, "robot.at.home", "me@example.org")
    assert [(path, secret) for path, text in texts(out) for secret in secrets if secret in text] == []


def test_of_the_allocation_the_blocks_are_told_and_the_seed_is_not(tmp_path: Path) -> None:
    plan = study_plan()
    allocation = Allocation(target_n={"tom": 9, "notom": 9}, block_size=6, seed=SEED)
    driver = Driver(replace(plan, settings=plan.settings.model_copy(update={"randomisation": allocation})), 1)
    driver.to(Stage.GAME)
    store(tmp_path / "data", [(driver, 1)])
    export_dataset(tmp_path / "data", tmp_path / "out", PsychDs)
    (settings,) = (json.loads(path.read_text("utf-8")) for path in (tmp_path / "out").glob("materials/settings/*"))
    assert settings["randomisation"] == {"target_n": {"tom": 9, "notom": 9}, "block_size": 6}
    assert settings["consent"] == {"adult": plan.settings.consent.adult}


@pytest.mark.parametrize("layout", BOTH)
def test_no_date_is_told_by_any_text_or_file(stored: Path, tmp_path: Path, layout: type[Layout]) -> None:
    out = tmp_path / "out"
    export_dataset(stored, out, layout)
    date = re.compile(rf"{datetime.now(UTC).year}-\d\d|\d\d:\d\d:\d\d|datePublished|dateCreated")
    assert [path for path, text in texts(out) if date.search(text)] == []
    dates = {datetime.fromtimestamp(path.stat().st_mtime, UTC).date() for path in (out, *out.rglob("*"))}
    assert {day.isoformat() for day in dates} == {"1980-01-02"}


def test_texts_are_told_to_those_who_ask_for_them_and_the_data_set_says_so(told: Path) -> None:
    out = told.parent / "out"
    export_dataset(told, out, PsychDs, frozenset({ExportOption.TEXTS}))
    assert next(row["value"] for row in rows_of(out, "answers") if row["item"] == "job") == NAME_TYPED
    assert rows_of(out, "participants")[0]["job"] == NAME_TYPED
    assert any(json.loads(row["fields"]).get("reason") == REASON for row in rows_of(out, "events"))
    assert "NOT FOR PUBLISHING" in (out / "README.md").read_text("utf-8")
    assert "NOT FOR PUBLISHING" in json.loads((out / "dataset_description.json").read_text("utf-8"))["description"]


def test_an_answer_that_was_chosen_is_told_and_one_that_was_typed_is_not(told: Path) -> None:
    out = told.parent / "out"
    export_dataset(told, out, PsychDs)
    answers = {row["item"]: row["value"] for row in rows_of(out, "answers")}
    assert answers["job"] == ""
    assert answers["age"] != ""
    assert "job" not in rows_of(out, "participants")[0]


def test_the_start_of_each_session_is_told_to_those_who_ask_for_it(stored: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    export_dataset(stored, out, PsychDs, frozenset({ExportOption.DATES}))
    started = [datetime.fromisoformat(row["started_at"]) for row in rows_of(out, "participants")]
    assert all(when.tzinfo is not None for when in started)
    assert "started_at" not in rows_of(out, "flips")[0]


def test_who_did_not_agree_to_publishing_is_left_out_and_counted(tmp_path: Path) -> None:
    store(tmp_path / "data", [(unsharing(1), 1), (visitor(2), 2)])
    told = export_dataset(tmp_path / "data", tmp_path / "out", PsychDs)
    assert (told.participants, told.not_shared) == (1, 1)
    assert [row["participant_id"] for row in rows_of(tmp_path / "out", "participants")] == ["P0002"]
    flow = {row["quantity"]: row["count"] for row in rows_of(tmp_path / "out", "flow")}
    assert (flow["not_shared"], flow["exported"]) == ("1", "1")


def test_they_are_told_to_those_who_ask_for_them_and_the_data_set_says_so(tmp_path: Path) -> None:
    store(tmp_path / "data", [(unsharing(1), 1)])
    export_dataset(tmp_path / "data", tmp_path / "out", PsychDs, frozenset({ExportOption.UNSHARED}))
    assert rows_of(tmp_path / "out", "participants")[0]["agreed_share"] == "false"
    assert "NOT FOR PUBLISHING" in (tmp_path / "out" / "README.md").read_text("utf-8")


def test_where_publishing_was_not_asked_about_nobody_is_left_out(tmp_path: Path) -> None:
    plan = study_plan()
    consent = plan.information.consent
    asked = consent.model_copy(update={"purposes": tuple(each for each in consent.purposes if each.id != "share")})
    driver = Driver(replace(plan, information=plan.information.model_copy(update={"consent": asked})), 1)
    driver.to(Stage.OVER)
    store(tmp_path / "data", [(driver, 1)])
    assert export_dataset(tmp_path / "data", tmp_path / "out", PsychDs).participants == 1
