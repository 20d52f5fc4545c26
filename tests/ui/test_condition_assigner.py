"""What the next session follows: the experimenter's choice holds for one session, and a later one for the one after."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from kiosk import StorageError
from kiosk.config import Settings
from kiosk.experiment.condition import AllocationSlot, Condition
from kiosk.experiment.outcomes import AllocationSource, SessionKind
from kiosk.store.recorder import Recorder
from kiosk.study.loader import read_study
from kiosk.ui.condition_assigner import ConditionAssigner, RunContext

LISTED = Settings.model_validate(
    {
        "languages": ["en"],
        "questionnaires": ["trust"],
        "randomisation": {"target_n": {"tom": 2, "notom": 2}, "block_size": 2},
    }
)
ORIGIN = RunContext("a test", kind=SessionKind.SIMULATED, seed=lambda: 1)


@pytest.fixture
def recorder(tmp_path: Path) -> Iterator[Recorder]:
    with Recorder(tmp_path) as recorder:
        yield recorder


@pytest.fixture
def assigner(recorder: Recorder) -> ConditionAssigner:
    return ConditionAssigner(read_study(LISTED), recorder, ORIGIN)


def test_a_choice_holds_for_the_next_session_and_no_longer(assigner: ConditionAssigner) -> None:
    assigner.choose(Condition.NO_ASSISTANCE, "a test")
    session = assigner.next_session("en")
    assert (session.plan.condition, session.allocation_source) == (Condition.NO_ASSISTANCE, AllocationSource.OVERRIDE)
    assigner.confirm_recorded(session)
    assert assigner.chosen is None
    assert assigner.next_session("en").allocation_source is AllocationSource.LIST


def test_a_choice_outlasts_a_session_that_is_not_kept(assigner: ConditionAssigner) -> None:
    assigner.choose(Condition.NO_ASSISTANCE, "a test")
    assigner.next_session("en")
    assert assigner.next_session("en").plan.condition == Condition.NO_ASSISTANCE


@pytest.mark.parametrize("later", [Condition.TOM, Condition.NO_ASSISTANCE], ids=lambda condition: condition.name)
def test_what_is_chosen_while_somebody_decides_holds_for_the_session_after_theirs(
    assigner: ConditionAssigner, later: Condition
) -> None:
    assigner.choose(Condition.NO_ASSISTANCE, "a test")
    session = assigner.next_session("en")
    assigner.choose(later, "another one")
    assigner.confirm_recorded(session)
    assert assigner.chosen == later


def test_a_list_that_the_disk_does_not_take_is_the_disk_s_failure_and_not_the_study_s(tmp_path: Path) -> None:
    class Full(Recorder):
        def create_allocation_list(self, *_: object, **__: object) -> tuple[AllocationSlot, ...]:
            raise StorageError("the disk is full")

    with Full(tmp_path) as recorder, pytest.raises(StorageError, match="the disk is full"):
        ConditionAssigner(read_study(LISTED), recorder, ORIGIN)
