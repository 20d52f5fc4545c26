"""Before a kiosk opens, a questionnaire is found that changed without a new version."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from random import Random

from kiosk.experiment.outcomes import SessionKind, Stage
from kiosk.preflight import Severity
from kiosk.store.checks import forms
from kiosk.store.database import FILE
from tests.experiment.driver import Driver
from tests.export.visitors import answer_all, store, study_plan
from tests.samples import likert, questionnaire

PLAN = replace(study_plan(), about_you=questionnaire("about-you", likert("first", scale="L")))
CHANGED = questionnaire("about-you", likert("first", scale="L", points=7), likert("second"))


def store_answers(folder: Path, *, kind: SessionKind = SessionKind.STUDY) -> None:
    """Store the answers of one participant."""
    driver = Driver(PLAN, 1)
    driver.to(Stage.ABOUT_YOU)
    answer_all(driver, Random(1))
    driver.end()
    store(folder, [(driver, 1)], kind=kind)


def test_a_study_that_is_as_it_was_is_well(tmp_path: Path) -> None:
    store_answers(tmp_path)
    assert [result.severity for result in forms(tmp_path, PLAN)] == [Severity.OK]


def test_a_form_that_changed_under_its_version_is_told(tmp_path: Path) -> None:
    store_answers(tmp_path)
    (result,) = forms(tmp_path, replace(PLAN, about_you=CHANGED))
    assert result.severity is Severity.WARNING
    assert (
        "'about-you' is still version '1', but visitors were asked otherwise before: first, second, L" in result.message
    )
    renewed = CHANGED.model_copy(update={"version": "2"})
    assert [result.severity for result in forms(tmp_path, replace(PLAN, about_you=renewed))] == [Severity.OK]


def test_what_was_only_rehearsed_may_change(tmp_path: Path) -> None:
    store_answers(tmp_path, kind=SessionKind.SIMULATED)
    assert [result.severity for result in forms(tmp_path, replace(PLAN, about_you=CHANGED))] == [Severity.OK]


def test_a_folder_without_a_database_or_with_a_spoilt_one_is_no_matter_of_it(tmp_path: Path) -> None:
    assert [result.severity for result in forms(tmp_path, PLAN)] == [Severity.OK]
    assert list(tmp_path.iterdir()) == []
    (tmp_path / FILE).write_bytes(b"spoilt" * 1000)
    assert [result.severity for result in forms(tmp_path, PLAN)] == [Severity.OK]
