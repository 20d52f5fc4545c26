"""A participant who came back has a row for each visit, and the data set says that they are one person."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from kiosk.config import ReturningConfig
from kiosk.experiment.outcomes import AllocationSource, SessionKind
from kiosk.experiment.session_config import SessionConfig
from kiosk.export.bids import Bids
from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import PsychDs
from kiosk.store.participants import ReturningVisitor
from kiosk.store.recorder import Provenance, Recorder
from tests.experiment.driver import Driver, with_memory
from tests.export.conftest import rows_of
from tests.export.visitors import study_plan
from tests.samples import likert, questionnaire


def returning_plan(visit: int) -> SessionConfig:
    """Return the plan of a study that asks one of its items at the first visit only."""
    plan = study_plan()
    settings = plan.settings.model_copy(update={"returning": ReturningConfig(enabled=True)})
    about = questionnaire("about", likert("games", visits="first"), likert("mood"))
    once = questionnaire("once", likert("habit"), visits="first")
    return replace(plan, settings=settings, about_you=about, questionnaires=(once, *plan.questionnaires), visit=visit)


@pytest.fixture(scope="module")
def visited(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a data folder with two visits of one participant, and one of another between them."""
    folder = tmp_path_factory.mktemp("visited") / "data"
    with Recorder(folder, "MI") as recorder:
        for number, visit in ((1, 1), (2, 1), (1, 2)):
            seed = 10 * number + visit
            driver = Driver(returning_plan(visit), seed)
            driver.whole_session(with_memory(seed))
            again = ReturningVisitor(number, visit, (driver.plan.condition,), "MI-22222-22222") if visit > 1 else None
            source = AllocationSource.RETURNING if again else None
            session = Provenance(driver.plan, seed, "avatar", "abc", SessionKind.STUDY, None, source, again)
            recorder.begin(session, driver.events)
    return folder


def test_each_visit_has_a_row_that_names_the_person(visited: Path, tmp_path: Path) -> None:
    export_dataset(visited, tmp_path / "out", PsychDs)
    people = rows_of(tmp_path / "out", "participants")
    columns = ("participant_id", "participant", "visit", "days_since_first_visit", "allocation_source")
    assert [tuple(row[name] for name in columns) for row in people] == [
        ("MI-P0001", "MI-P0001", "1", "0", ""),
        ("MI-P0002", "MI-P0002", "1", "0", ""),
        ("MI-P0001v2", "MI-P0001", "2", "0", "returning"),
    ]
    assert [bool(row["questionnaire_versions"].count("once=")) for row in people] == [True, True, False]
    assert people[2]["games"] == ""
    asked = {(row["participant_id"], row["item"]) for row in rows_of(tmp_path / "out", "answers")}
    assert {("MI-P0001", "games"), ("MI-P0001", "habit"), ("MI-P0001v2", "mood")} <= asked
    assert not {("MI-P0001v2", "games"), ("MI-P0001v2", "habit")} & asked
    flow = {(row["quantity"], row["count"]) for row in rows_of(tmp_path / "out", "flow")}
    assert ("returning", "1") in flow


def test_shuffled_names_keep_the_visits_of_a_person_together(visited: Path, tmp_path: Path) -> None:
    export_dataset(visited, tmp_path / "out", PsychDs, shuffled_ids=True)
    people = {row["participant_id"]: row for row in rows_of(tmp_path / "out", "participants")}
    (again,) = (name for name in people if name.endswith("v2"))
    assert people[again]["participant"] == again.removesuffix("v2") in people
    assert "0001" not in again


def test_each_visit_is_a_session_for_bids(visited: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    export_dataset(visited, out, Bids)
    assert sorted(path.relative_to(out).as_posix() for path in out.glob("sub-*/**/*.tsv")) == [
        f"sub-MInP000{name}"
        for name in (
            "1/ses-1/beh/sub-MInP0001_ses-1_task-concentration_beh.tsv",
            "1/ses-1/beh/sub-MInP0001_ses-1_task-concentration_events.tsv",
            "1/ses-2/beh/sub-MInP0001_ses-2_task-concentration_beh.tsv",
            "1/ses-2/beh/sub-MInP0001_ses-2_task-concentration_events.tsv",
            "1/sub-MInP0001_sessions.tsv",
            "2/ses-1/beh/sub-MInP0002_ses-1_task-concentration_beh.tsv",
            "2/ses-1/beh/sub-MInP0002_ses-1_task-concentration_events.tsv",
            "2/sub-MInP0002_sessions.tsv",
        )
    ]
    people = (out / "participants.tsv").read_text("utf-8").splitlines()
    assert [line.split("\t")[0] for line in people] == ["participant_id", "sub-MInP0001", "sub-MInP0002"]
    visits = (out / "sub-MInP0001" / "sub-MInP0001_sessions.tsv").read_text("utf-8").splitlines()
    assert [line.split("\t")[0] for line in visits] == ["session_id", "ses-1", "ses-2"]
    mood = (out / "phenotype" / "about.tsv").read_text("utf-8").splitlines()
    assert [line.split("\t")[:2] for line in mood][1:] == [
        ["sub-MInP0001", "ses-1"],
        ["sub-MInP0002", "ses-1"],
        ["sub-MInP0001", "ses-2"],
    ]
