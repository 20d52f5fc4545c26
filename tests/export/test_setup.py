"""What a session began with, and what deviated at the booth, stand in the data set."""

from __future__ import annotations

import json
import sqlite3
from contextlib import closing
from dataclasses import replace
from datetime import UTC, datetime, timedelta, timezone
from pathlib import Path

import pytest

from kiosk.experiment.event_records import from_record, to_record
from kiosk.experiment.events import FallbackReason, InputDevice, SessionSetup, SessionStarted
from kiosk.experiment.experimenter import AuditEvent, DeviationReason
from kiosk.experiment.outcomes import EmbodimentName, SessionKind, Stage
from kiosk.export.columns import ExportOption
from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import PsychDs
from kiosk.store.database import FILE
from kiosk.store.recorder import Provenance, Recorder
from tests.experiment.driver import Driver
from tests.export.conftest import rows_of
from tests.export.visitors import COMMIT, study_plan

SETUP = SessionSetup(
    intended=EmbodimentName.robot("furhat"),
    fallback=FallbackReason.FAILED,
    detail="robot.at.home does not answer",
    screen_width=1920,
    screen_height=1080,
    screen_scale=1.25,
    screen_width_mm=0,
    screen_height_mm=300,
    window_width=1900,
    window_height=1000,
    hour_band=3,
    visitors_before=7,
)


def begun(seed: int) -> Driver:
    """Return a session that began with that, in which the first card was touched."""
    driver = Driver(study_plan(), seed)
    driver.send(SessionStarted(at_ms=0, setup=SETUP))
    driver.to(Stage.GAME)
    driver.wait_until_open()
    driver.tap(driver.view.closed[0], InputDevice.TOUCH)
    driver.wait_until_open()
    driver.tap(driver.view.closed[0], InputDevice.KEYBOARD)
    driver.end()
    return driver


def keep(recorder: Recorder, seed: int) -> None:
    """Write such a session."""
    driver = begun(seed)
    recorder.begin(Provenance(driver.plan, seed, "avatar", COMMIT, kind=SessionKind.STUDY), driver.events)


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a data folder with a session, and deviations before, within and after it."""
    folder = tmp_path_factory.mktemp("setup") / "data"
    wished = {"condition": "tom", "reason": DeviationReason.OTHER.in_own_words("Trillian asked")}
    with Recorder(folder) as recorder:
        recorder.add_audit_event(AuditEvent.CONDITION_CHOSEN.value, wished, 1_000)
        recorder.add_audit_event(AuditEvent.PANEL_OPENED.value, {}, 1_000)
        keep(recorder, 1)
        # All events were written just now, the last of them as it happened.
        with closing(sqlite3.connect(folder / FILE)) as connection:
            (last,) = connection.execute("SELECT max(wall_ms) FROM event").fetchone()
        recorder.add_audit_event(AuditEvent.VOLUME_CHANGED.value, {"volume": 0.5}, last - 1)
        recorder.add_audit_event(AuditEvent.APPLICATION_QUIT.value, {"reason": "test run"}, last + 60_000)
    return folder


def test_a_session_tells_what_it_began_with(data: Path, tmp_path: Path) -> None:
    export_dataset(data, tmp_path / "out", PsychDs)
    person = rows_of(tmp_path / "out", "participants")[0]
    told = {
        "intended_embodiment": "robot",
        "embodiment_fallback": "failed",
        "hour_band": "12 to 16 o'clock",
        "visitors_before": "7",
        "screen_width": "1920",
        "screen_scale": "1.25",
        "screen_width_mm": "",
        "screen_height_mm": "300",
        "window_height": "1000",
        "input_devices": "keyboard;touch",
    }
    assert {name: person[name] for name in told} == told
    flips = [row for row in rows_of(tmp_path / "out", "flips") if row["participant_id"] == person["participant_id"]]
    assert [row["input_device"] for row in flips if row["stage"] == "game"] == ["touch", "keyboard"]


def test_what_the_robot_s_driver_said_is_a_free_text(data: Path, tmp_path: Path) -> None:
    for extras, with_detail in ((frozenset[ExportOption](), False), (frozenset({ExportOption.TEXTS}), True)):
        out = tmp_path / f"out-{with_detail}"
        export_dataset(data, out, PsychDs, extras)
        first = json.loads(rows_of(out, "events")[0]["fields"])["setup"]
        assert first["fallback"] == "failed"
        assert ("detail" in first) is with_detail


def test_how_many_came_before_is_told_nowhere_where_names_are_shuffled(data: Path, tmp_path: Path) -> None:
    export_dataset(data, tmp_path / "out", PsychDs, shuffled_ids=True)
    assert "visitors_before" not in rows_of(tmp_path / "out", "participants")[0]
    setups = [json.loads(row["fields"])["setup"] for row in rows_of(tmp_path / "out", "events") if row["seq"] == "1"]
    assert all("visitors_before" not in setup and setup["hour_band"] == 3 for setup in setups)


def test_deviations_stand_with_the_session_that_they_concern(data: Path, tmp_path: Path) -> None:
    export_dataset(data, tmp_path / "out", PsychDs)
    chosen, changed = rows_of(tmp_path / "out", "deviations")
    assert (chosen["participant_id"], chosen["what_deviated"]) == ("P0001", "ConditionChosen")
    assert (chosen["deviation_ms"], chosen["deviation_stage"], chosen["deviation_reason"]) == ("", "", "other")
    assert json.loads(chosen["deviation_detail"]) == {"condition": "tom"}
    assert (changed["what_deviated"], changed["participant_id"]) == ("VolumeChanged", "P0001")
    (person,) = rows_of(tmp_path / "out", "participants")
    assert int(changed["deviation_ms"]) == int(person["duration_ms"]) - 1
    assert changed["deviation_stage"] == "game"
    assert "Trillian" not in "".join(path.read_text("utf-8") for path in (tmp_path / "out" / "data").glob("*.csv"))
    export_dataset(data, tmp_path / "texts", PsychDs, frozenset({ExportOption.TEXTS}))
    assert rows_of(tmp_path / "texts", "deviations")[0]["words"] == "other: Trillian asked"


def test_sessions_of_the_day_are_counted_by_kind_and_site(tmp_path: Path) -> None:
    with Recorder(tmp_path) as recorder:
        keep(recorder, 1)
        hour_ago = datetime.now(UTC) - timedelta(hours=1)
        assert recorder.count_sessions_since(hour_ago, kind=SessionKind.STUDY) == 1
        elsewhere = hour_ago.astimezone(timezone(timedelta(hours=9)))
        assert recorder.count_sessions_since(elsewhere, kind=SessionKind.STUDY) == 1
        assert recorder.count_sessions_since(hour_ago, kind=SessionKind.TRIAL) == 0
        assert recorder.count_sessions_since(hour_ago + timedelta(hours=2), kind=SessionKind.STUDY) == 0


def test_records_from_before_it_was_noted_are_read() -> None:
    assert from_record({"type": "SessionStarted", "at_ms": 3}) == SessionStarted(at_ms=3)
    event = SessionStarted(at_ms=0, setup=replace(SETUP, fallback=None))
    assert from_record(json.loads(json.dumps(to_record(event)))) == event
