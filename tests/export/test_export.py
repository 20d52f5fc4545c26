"""A data set is written as a whole or not at all, session by session, from whatever can still be read."""

from __future__ import annotations

import gc
import sqlite3
import weakref
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import pytest

from kiosk import StorageError, UserInputError
from kiosk.experiment.condition import Condition
from kiosk.experiment.events import RobotDisconnected, SentenceRequested, SessionStarted, SpeechStarted
from kiosk.experiment.outcomes import AllocationSource, NotRecordedReason, SessionKind, Stage
from kiosk.export.columns import ExportOption
from kiosk.export.dataset import Exported, export_dataset
from kiosk.export.flow import ParticipantFlow
from kiosk.export.layouts import PsychDs
from kiosk.export.log_tables import SoundDevice
from kiosk.store.database import FILE
from kiosk.store.recorder import Provenance, Recorder
from kiosk.store.session_records import SessionRecord, open_records
from tests.experiment.driver import Voice, driven_to
from tests.export.conftest import PARTICIPANTS, rows_of
from tests.export.psych_ds import issues
from tests.export.visitors import COMMIT, store, study_plan, unsharing, visitor


def contents(folder: Path) -> dict[str, bytes]:
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_the_same_data_give_the_same_data_set_byte_for_byte(stored: Path, exported: Path, tmp_path: Path) -> None:
    export_dataset(stored, tmp_path / "again", PsychDs)
    assert contents(tmp_path / "again") == contents(exported)


def test_several_processes_write_the_same(
    stored: Path, exported: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("kiosk.export.dataset.WORTH_IT", 1)
    seen: list[tuple[int, int]] = []
    told = export_dataset(stored, tmp_path / "again", PsychDs, tell=lambda *done: seen.append(done), processes=2)
    assert told == Exported(PARTICIPANTS, not_shared=0, under_way=0)
    assert contents(tmp_path / "again") == contents(exported)
    assert seen == [(done, PARTICIPANTS) for done in range(1, PARTICIPANTS + 1)]


def test_events_that_were_written_after_the_export_began_are_left_out(stored: Path) -> None:
    with open_records(stored, frozenset({SessionKind.STUDY})) as records:
        session = next(records.stored())
        earlier = records.read(session._replace(last_seq=3))
    assert [record.seq for record in earlier.records] == [1, 2, 3]


def test_a_session_that_was_deleted_after_the_export_began_is_named(stored: Path) -> None:
    with open_records(stored, frozenset({SessionKind.STUDY})) as records:
        session = next(records.stored())
        gone = session._replace(row={**session.row, "id": 999})
        with pytest.raises(UserInputError, match="session 999 was deleted while it was read"):
            records.read(gone)


def test_an_empty_folder_is_written_into(stored: Path, tmp_path: Path) -> None:
    assert export_dataset(stored, tmp_path, PsychDs) == Exported(PARTICIPANTS, not_shared=0, under_way=0)


def test_a_folder_that_holds_something_is_refused_and_left_as_it_was(stored: Path, tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "mine.txt").write_text("mine", "utf-8")
    with pytest.raises(UserInputError, match="is not empty; a data set is written into a new one"):
        export_dataset(stored, tmp_path / "out", PsychDs)
    assert contents(tmp_path) == {"out/mine.txt": b"mine"}


def test_a_file_in_its_place_is_refused(stored: Path, tmp_path: Path) -> None:
    (tmp_path / "out").write_text("mine", "utf-8")
    with pytest.raises(UserInputError, match="is a file"):
        export_dataset(stored, tmp_path / "out", PsychDs)


def test_a_folder_that_cannot_be_made_is_refused(stored: Path, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("mine", "utf-8")
    with pytest.raises(UserInputError, match="cannot be used"):
        export_dataset(stored, tmp_path / "file" / "out", PsychDs)


class Failing(PsychDs):
    """Fails at the end."""

    def finish(self, flows: tuple[ParticipantFlow, ...]) -> None:  # noqa: ARG002 - it fails whatever they are
        raise OSError(28, "No space left on device")


def test_nothing_stays_of_a_data_set_that_could_not_be_finished(stored: Path, tmp_path: Path) -> None:
    with pytest.raises(StorageError, match="disk full"):
        export_dataset(stored, tmp_path / "out", Failing)
    assert list(tmp_path.iterdir()) == []


def test_one_session_is_in_memory_at_a_time(stored: Path, tmp_path: Path) -> None:
    alive: list[weakref.ref[SessionRecord]] = []
    most = 0

    class Watching(PsychDs):
        def add(self, kept: SessionRecord) -> None:
            nonlocal most
            super().add(kept)
            alive.append(weakref.ref(kept))
            gc.collect()
            most = max(most, sum(ref() is not None for ref in alive))

    # Only what the export makes is looked through at each session, not all that the tests hold.
    gc.freeze()
    export_dataset(stored, tmp_path / "out", Watching)
    assert len(alive) == PARTICIPANTS
    assert most <= 2


def test_how_far_it_is_is_told_session_by_session(stored: Path, tmp_path: Path) -> None:
    told: list[tuple[int, int]] = []
    export_dataset(stored, tmp_path / "out", PsychDs, tell=lambda done, of: told.append((done, of)))
    assert told == [(done, PARTICIPANTS) for done in range(1, PARTICIPANTS + 1)]


def test_without_a_session_there_is_no_data_set(tmp_path: Path) -> None:
    with Recorder(tmp_path / "data"):
        pass
    with pytest.raises(UserInputError, match="there is no session in"):
        export_dataset(tmp_path / "data", tmp_path / "out", PsychDs)
    assert not (tmp_path / "out").exists()


def test_a_folder_without_a_database_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UserInputError, match="no database"):
        export_dataset(tmp_path, tmp_path / "out", PsychDs)


def test_rehearsals_are_left_out_unless_they_are_asked_for(tmp_path: Path) -> None:
    data = tmp_path / "data"
    store(data, [(visitor(1), 1)], kind=SessionKind.SIMULATED)
    with pytest.raises(UserInputError, match="rehearsals are left out"):
        export_dataset(data, tmp_path / "out", PsychDs)
    store(data, [(visitor(2), 2)])
    export_dataset(data, tmp_path / "people", PsychDs)
    assert [row["participant_id"] for row in rows_of(tmp_path / "people", "participants")] == ["P0001"]
    assert "simulated" not in rows_of(tmp_path / "people", "participants")[0]
    export_dataset(data, tmp_path / "all", PsychDs, frozenset({ExportOption.REHEARSALS}))
    told = [(row["participant_id"], row["simulated"]) for row in rows_of(tmp_path / "all", "participants")]
    assert told == [("r0001", "true"), ("P0001", "false")]
    assert {row["simulated"] for row in rows_of(tmp_path / "all", "flow")} == {"true", "false"}
    assert issues(tmp_path / "all") == []


def test_trials_are_left_out_unless_they_are_asked_for(tmp_path: Path) -> None:
    data = tmp_path / "data"
    store(data, [(visitor(1), 1)], kind=SessionKind.TRIAL)
    with pytest.raises(UserInputError, match="it holds no participant; trials are left out without --with-trials"):
        export_dataset(data, tmp_path / "out", PsychDs)
    store(data, [(visitor(2), 2)])
    store(data, [(visitor(3), 3)], kind=SessionKind.SIMULATED)
    assert export_dataset(data, tmp_path / "people", PsychDs).trials == 1
    assert [row["participant_id"] for row in rows_of(tmp_path / "people", "participants")] == ["P0001"]
    assert {"trial", "simulated"}.isdisjoint(rows_of(tmp_path / "people", "participants")[0])
    assert export_dataset(data, tmp_path / "tried", PsychDs, frozenset({ExportOption.TRIALS})).trials == 0
    told = [(row["participant_id"], row["trial"]) for row in rows_of(tmp_path / "tried", "participants")]
    assert told == [("t0001", "true"), ("P0001", "false")]
    assert {row["trial"] for row in rows_of(tmp_path / "tried", "flow")} == {"true", "false"}
    assert issues(tmp_path / "tried") == []


def test_who_did_not_agree_to_publishing_in_a_trial_is_left_out_as_well(tmp_path: Path) -> None:
    store(tmp_path / "data", [(unsharing(1), 1), (visitor(2), 2)], kind=SessionKind.TRIAL)
    exported = export_dataset(tmp_path / "data", tmp_path / "out", PsychDs, frozenset({ExportOption.TRIALS}))
    assert (exported.participants, exported.not_shared) == (1, 1)


def test_a_site_stands_before_the_number(tmp_path: Path) -> None:
    store(tmp_path / "data", [(visitor(1), 1)], site="A")
    export_dataset(tmp_path / "data", tmp_path / "out", PsychDs)
    (person,) = rows_of(tmp_path / "out", "participants")
    assert (person["participant_id"], person["site"]) == ("A-P0001", "A")


def test_a_session_that_is_going_on_is_left_out_and_counted(tmp_path: Path) -> None:
    data = tmp_path / "data"
    store(data, [(visitor(1), 1)])
    with Recorder(data) as recorder:
        recorder.begin(Provenance(study_plan(), 2, "avatar", COMMIT, kind=SessionKind.STUDY), [SessionStarted(at_ms=0)])
        assert export_dataset(data, tmp_path / "out", PsychDs) == Exported(1, not_shared=0, under_way=1)
    flow = {(row["quantity"], row["group"]): row["count"] for row in rows_of(tmp_path / "out", "flow")}
    assert flow["not_ended", "tom"] == "1"


def test_one_that_was_cut_off_is_told_as_interrupted(tmp_path: Path) -> None:
    data = tmp_path / "data"
    with Recorder(data) as recorder:
        recorder.begin(Provenance(study_plan(), 2, "avatar", COMMIT, kind=SessionKind.STUDY), [SessionStarted(at_ms=0)])
    export_dataset(data, tmp_path / "out", PsychDs)
    (person,) = rows_of(tmp_path / "out", "participants")
    assert (person["status"], person["last_stage"], person["flips"]) == ("interrupted", "attract", "0")


def test_people_who_were_not_stored_are_counted_by_reason(tmp_path: Path) -> None:
    data = tmp_path / "data"
    store(data, [(visitor(1), 1)])
    with Recorder(data) as recorder:
        recorder.count_visit(NotRecordedReason.DECLINED, kind=SessionKind.STUDY)
        recorder.count_visit(NotRecordedReason.DECLINED, kind=SessionKind.STUDY)
        recorder.count_visit(NotRecordedReason.UNDER_AGE, kind=SessionKind.SIMULATED)
    export_dataset(data, tmp_path / "out", PsychDs)
    counted = [
        (row["group"], row["count"]) for row in rows_of(tmp_path / "out", "flow") if row["quantity"] == "not_stored"
    ]
    assert counted == [("declined", "2")]


def test_of_an_event_that_cannot_be_read_no_field_is_told_unless_texts_are_asked_for(tmp_path: Path) -> None:
    store(tmp_path / "data", [(visitor(1), 1)])
    with closing(sqlite3.connect(tmp_path / "data" / FILE)) as connection, connection:
        row = "1, 0, 0, 'world', 'NameTyped', '{\"name\": \"Zaphod\"}', zeroblob(32)"
        connection.execute(f"INSERT INTO event (session, seq, at_ms, origin, type, payload, hash) VALUES ({row})")  # noqa: S608
    told = {}
    for extras in (frozenset[ExportOption](), frozenset({ExportOption.TEXTS})):
        export_dataset(tmp_path / "data", tmp_path / f"with-{len(extras)}", PsychDs, extras)
        first = rows_of(tmp_path / f"with-{len(extras)}", "events")[0]
        told[len(extras)] = (first["type"], first["fields"])
    assert told == {0: ("NameTyped", "{}"), 1: ("NameTyped", '{"name":"Zaphod"}')}


def test_a_sentence_that_the_robot_broke_off_has_a_row_for_the_robot_and_one_for_the_avatar(tmp_path: Path) -> None:
    driver = driven_to(Stage.INTRODUCTION, study_plan(), voice=Voice.IS_SILENT)
    asked_ms = driver.noted(SentenceRequested)[0].at_ms
    driver.spend(100)
    driver.send(SpeechStarted(at_ms=driver.now, utterance=1))
    driver.spend(600)
    driver.send(RobotDisconnected(at_ms=driver.now, why="the plug"))
    driver.spend(200)
    driver.send(SpeechStarted(at_ms=driver.now, utterance=1))
    driver.to(Stage.OVER)
    with Recorder(tmp_path / "data") as recorder:
        recorder.begin(Provenance(driver.plan, 5, "robot:furhat", COMMIT, kind=SessionKind.STUDY), driver.events)
    export_dataset(tmp_path / "data", tmp_path / "out", PsychDs)
    robot, avatar, *_ = rows_of(tmp_path / "out", "sentences")
    assert robot["sentence"] == avatar["sentence"]
    times = ("attempt", "embodiment", "robot", "at_ms", "started_ms", "finished_ms", "failed_ms")
    begun, lost, anew = (str(asked_ms + later) for later in (100, 700, 900))
    assert tuple(robot[name] for name in times) == ("1", "robot", "furhat", str(asked_ms), begun, "", lost)
    assert tuple(avatar[name] for name in times[:5]) == ("2", "avatar", "", lost, anew)
    assert avatar["failed_ms"] == ""


def test_a_session_of_the_list_tells_its_block_and_with_which_probability_it_was_drawn(tmp_path: Path) -> None:
    plan = study_plan()
    with Recorder(tmp_path / "data") as recorder:
        recorder.create_allocation_list({Condition.TOM: 6, Condition.NOTOM: 2}, 4, 7, kind=SessionKind.STUDY)
        for seed in range(5):
            slot = recorder.next_slot(kind=SessionKind.STUDY)
            assert slot is not None
            driver = driven_to(Stage.OVER, replace(plan, condition=slot.condition))
            session = Provenance(driver.plan, seed, "avatar", COMMIT, SessionKind.STUDY, slot, AllocationSource.LIST)
            recorder.begin(session, driver.events)
    export_dataset(tmp_path / "data", tmp_path / "out", PsychDs)
    people = rows_of(tmp_path / "out", "participants")
    assert [row["allocation_block"] for row in people] == ["1", "1", "1", "1", "2"]
    assert {row["allocation_block_size"] for row in people} == {"4"}
    assert {(row["condition"], row["allocation_probability"]) for row in people} == {("tom", "0.75"), ("notom", "0.25")}
    assert len({row["allocation_sha256"] for row in people}) == 1


def test_of_a_sound_device_its_kind_is_told_and_not_its_name(tmp_path: Path) -> None:
    driver = driven_to(Stage.INTRODUCTION, study_plan(), voice=Voice.IS_SILENT)
    driver.send(SpeechStarted(at_ms=driver.now, utterance=1, engine="piper", device="Anna's AirPods Pro"))
    driver.to(Stage.OVER)
    store(tmp_path / "data", [(driver, 1)])
    export_dataset(tmp_path / "data", tmp_path / "out", PsychDs)
    kinds = {row["sound_device"] for row in rows_of(tmp_path / "out", "sentences")}
    assert kinds == {"", "bluetooth"}
    assert not any("Anna" in file.read_text("utf-8") for file in (tmp_path / "out").rglob("*.*") if file.is_file())


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("USB Audio CODEC", SoundDevice.USB),
        ("HDA Intel HDMI 0", SoundDevice.DISPLAY),
        ("Cuffie di Marco", SoundDevice.HEADPHONES),
        ("Built-in Audio Analog Stereo", SoundDevice.SPEAKERS),
        ("system default (PulseAudio)", SoundDevice.SYSTEM_DEFAULT),
        ("null", SoundDevice.SILENT),
        ("Marta's", SoundDevice.OTHER),
    ],
)
def test_the_kind_of_a_sound_device_follows_from_its_name(name: str, kind: SoundDevice) -> None:
    assert SoundDevice.of(name) is kind


def test_its_files_are_closed_whatever_goes_wrong(stored: Path, tmp_path: Path) -> None:
    closed: list[Path] = []

    class Broken(PsychDs):
        def add(self, kept: SessionRecord) -> None:
            raise RuntimeError(kept.name)

        def close(self) -> None:
            super().close()
            closed.append(self.root)

    with pytest.raises(RuntimeError, match="P0001"):
        export_dataset(stored, tmp_path / "out", Broken)
    assert len(closed) == 1
    assert list(tmp_path.iterdir()) == []
