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

from kiosk import UserInputError
from kiosk.config import Allocation, ConsentConfig, Privacy, RobotConfig
from kiosk.experiment.events import ResponseGiven
from kiosk.experiment.items import ShortText
from kiosk.experiment.outcomes import Stage
from kiosk.export.bids import Bids
from kiosk.export.columns import ExportOption
from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import Layout, PsychDs
from kiosk.export.records import TELLS_THE_ORDER, AgeBands, StudyMaterials
from kiosk.store.database import FILE
from kiosk.store.session_records import SHUFFLING_FILE
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
        ((code,),) = connection.execute("SELECT hex(hash) FROM withdrawal_code").fetchall()
    out = told.parent / "out"
    export_dataset(told, out, layout)
    secrets = (code, code.lower(), str(SEED), NAME_TYPED, REASON, "robot.at.home", "me@example.org")
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


AGE, FIRST_AGE = 87, 83
BAND, FIRST_BAND = "85 to 89", "80 to 84"


def aged(privacy: Privacy = Privacy()) -> Driver:  # noqa: B008 - it is frozen
    """Return a visitor who types one age and then another one."""
    plan = study_plan()
    driver = Driver(replace(plan, settings=plan.settings.model_copy(update={"privacy": privacy})), SEED)
    driver.to(Stage.ABOUT_YOU)
    driver.answer(FIRST_AGE, "age")
    driver.answer(AGE, "age")
    driver.go_on()
    driver.end()
    return driver


@pytest.fixture(scope="module")
def old(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a data folder with that visitor in it."""
    folder = tmp_path_factory.mktemp("old") / "data"
    store(folder, [(aged(), SEED)])
    return folder


def ages_told(out: Path) -> tuple[str, tuple[str, str], list[object], str]:
    """Return the age as the table of participants, that of answers and the events tell it, and how it is described."""
    (answer,) = (row for row in rows_of(out, "answers") if row["item"] == "age")
    events = [json.loads(row["fields"]) for row in rows_of(out, "events") if row["type"] == ResponseGiven.__name__]
    described = json.loads((out / "dataset_description.json").read_text("utf-8"))["variableMeasured"]
    kind = next(variable["additionalType"] for variable in described if variable["name"] == "age")
    given = [event["value"] for event in events if event["item"] == "age"]
    return rows_of(out, "participants")[0]["age"], (answer["value"], answer["number"]), given, kind


@pytest.mark.parametrize("extras", [frozenset(), frozenset({ExportOption.TEXTS})], ids=["plain", "with texts"])
def test_ages_stand_in_bands_in_every_table_and_event(
    old: Path, tmp_path: Path, extras: frozenset[ExportOption]
) -> None:
    export_dataset(old, tmp_path / "out", PsychDs, extras)
    assert ages_told(tmp_path / "out") == (BAND, (BAND, ""), [FIRST_BAND, BAND], "text")
    assert "bands" in (tmp_path / "out" / "README.md").read_text("utf-8")
    export_dataset(old, tmp_path / "bids", Bids, extras)
    phenotype = (tmp_path / "bids" / "phenotype" / "about_you.tsv").read_text("utf-8")
    people = (tmp_path / "bids" / "participants.tsv").read_text("utf-8")
    assert BAND in phenotype
    assert BAND in people
    assert re.search(rf"\t{AGE}\b", phenotype + people) is None


def test_exact_ages_are_told_to_those_who_ask_for_them_and_the_data_set_says_so(old: Path, tmp_path: Path) -> None:
    export_dataset(old, tmp_path / "out", PsychDs, frozenset({ExportOption.AGES}))
    told = ages_told(tmp_path / "out")
    assert told == (str(AGE), (str(AGE), str(AGE)), [FIRST_AGE, AGE], "whole number")
    assert "NOT FOR PUBLISHING: it holds exact ages" in (tmp_path / "out" / "README.md").read_text("utf-8")


def test_a_study_says_how_wide_the_bands_are_and_which_items_ask_for_ages(tmp_path: Path) -> None:
    driver = aged(Privacy(age_bands=10, age_items=("age", "years-here")))
    assert StudyMaterials((driver.plan,)).age_bands == AgeBands(10, frozenset({"age", "years-here"}))
    store(tmp_path / "data", [(driver, SEED)])
    export_dataset(tmp_path / "data", tmp_path / "out", PsychDs)
    assert ages_told(tmp_path / "out")[0] == "80 to 89"


def names(out: Path, table: str = "participants") -> list[str]:
    """Return the participants of a table in the order of its rows, each once."""
    return list(dict.fromkeys(row["participant_id"] for row in rows_of(out, table)))


@pytest.fixture(scope="module")
def came(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a data folder with ten visitors, each of whom has another age."""
    folder = tmp_path_factory.mktemp("came") / "data"
    drivers = []
    for number in range(10):
        driver = Driver(study_plan(), number)
        driver.to(Stage.ABOUT_YOU)
        driver.answer(20 + number, "age")
        driver.go_on()
        driver.end()
        drivers.append((driver, number))
    store(folder, drivers)
    return folder


def test_shuffled_names_say_nothing_of_the_order_and_are_the_same_in_every_export(came: Path, tmp_path: Path) -> None:
    ages = frozenset({ExportOption.AGES})
    for name in ("one", "two"):
        export_dataset(came, tmp_path / name, PsychDs, ages, shuffled_ids=True)
    told = {row["age"]: row["participant_id"] for row in rows_of(tmp_path / "one", "participants")}
    assert told == {row["age"]: row["participant_id"] for row in rows_of(tmp_path / "two", "participants")}
    assert all(re.fullmatch("P[0-9A-F]{12}", name) for name in told.values())
    assert names(tmp_path / "one") == sorted(told.values()) == names(tmp_path / "one", "events")
    assert list(told) != sorted(told)
    assert "shuffled" in (tmp_path / "one" / "README.md").read_text("utf-8")
    secret = came / SHUFFLING_FILE
    assert secret.stat().st_mode & 0o077 == 0
    assert [path for path, text in texts(tmp_path / "one") if secret.read_text("ascii") in text] == []


def test_another_data_folder_shuffles_otherwise(came: Path, tmp_path: Path) -> None:
    (tmp_path / "copy").mkdir()
    (tmp_path / "copy" / FILE).write_bytes((came / FILE).read_bytes())
    export_dataset(came, tmp_path / "one", PsychDs, shuffled_ids=True)
    export_dataset(tmp_path / "copy", tmp_path / "two", PsychDs, shuffled_ids=True)
    assert set(names(tmp_path / "one")).isdisjoint(names(tmp_path / "two"))


def test_nothing_else_tells_the_order_where_names_are_shuffled(came: Path, tmp_path: Path) -> None:
    export_dataset(came, tmp_path / "out", PsychDs, shuffled_ids=True)
    assert not TELLS_THE_ORDER & set(rows_of(tmp_path / "out", "participants")[0])
    export_dataset(came, tmp_path / "bids", Bids, shuffled_ids=True)
    assert sorted(path.name for path in (tmp_path / "bids").glob("sub-*")) == [
        f"sub-{name}" for name in names(tmp_path / "out")
    ]
    with pytest.raises(UserInputError, match="dates tell the order"):
        export_dataset(came, tmp_path / "no", PsychDs, frozenset({ExportOption.DATES}), shuffled_ids=True)
    assert not (tmp_path / "no").exists()


def test_a_study_file_can_ask_for_shuffled_names(tmp_path: Path) -> None:
    store(tmp_path / "data", [(aged(Privacy(shuffled_ids=True)), SEED)])
    export_dataset(tmp_path / "data", tmp_path / "out", PsychDs)
    assert names(tmp_path / "out") != ["P0001"]


@pytest.mark.parametrize("content", ["", "no secret", "00"])
def test_a_damaged_secret_is_refused(came: Path, tmp_path: Path, content: str) -> None:
    (tmp_path / "data").mkdir()
    (tmp_path / "data" / FILE).write_bytes((came / FILE).read_bytes())
    (tmp_path / "data" / SHUFFLING_FILE).write_text(content, "ascii")
    with pytest.raises(UserInputError, match="is not the secret"):
        export_dataset(tmp_path / "data", tmp_path / "out", PsychDs, shuffled_ids=True)
