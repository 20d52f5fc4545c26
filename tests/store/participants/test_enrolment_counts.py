"""Every visitor is counted once, however the session ended, also after a withdrawal."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from kiosk.experiment.condition import Condition
from kiosk.experiment.outcomes import AllocationSource, Disposition, NotRecordedReason, SessionKind
from kiosk.store.participants import CountCell, EnrolmentCounts
from kiosk.store.queries import open_repository
from kiosk.store.recorder import Provenance, Recorder
from kiosk.store.withdrawal import withdraw
from tests.store.visitors import BEGUN, COMPLETED, FINISHED, FOUR, LEFT, seated

TWO = {Condition.TOM: 2}


def counted(folder: Path, *, kind: SessionKind = SessionKind.SIMULATED) -> EnrolmentCounts:
    """Return the counts of a folder."""
    with open_repository(folder) as stored:
        return stored.counts(kind=kind)


def told(cell: CountCell) -> dict[str, int]:
    """Return what there is of a cell, without what there is not."""
    return {name: number for name, number in cell.to_json().items() if number}


def test_of_a_folder_in_which_nothing_happened_there_is_nothing_to_count(folder: Path) -> None:
    with Recorder(folder):
        pass
    assert counted(folder) == EnrolmentCounts({}, dict.fromkeys(NotRecordedReason, 0))


def test_every_condition_that_has_a_quota_is_told(folder: Path) -> None:
    with Recorder(folder) as recorder:
        recorder.create_allocation_list(FOUR, 4, 1, kind=SessionKind.SIMULATED)
    assert {condition: told(cell) for condition, cell in counted(folder).cells.items()} == {
        Condition.TOM: {"quota": 4},
        Condition.NOTOM: {"quota": 4},
    }


def test_every_fate_is_told_apart(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.create_allocation_list(TWO, 1, 1, kind=SessionKind.SIMULATED)
        for events in (LEFT, COMPLETED, BEGUN, BEGUN, FINISHED):
            seated(recorder, provenance, events)
        for allocation_source in (AllocationSource.OVERRIDE, AllocationSource.BEYOND, AllocationSource.BEYOND):
            seated(recorder, provenance, allocation_source=allocation_source)
        recorder.begin(provenance, COMPLETED)
    assert told(counted(folder).cells[Condition.TOM]) == {
        "quota": 2,
        "begun": 9,
        "consumed": 2,
        "dropped_out": 3,
        "overridden": 1,
        "beyond": 2,
        "unlisted": 1,
    }


def test_a_session_is_under_way_while_somebody_writes(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.create_allocation_list(TWO, 1, 1, kind=SessionKind.SIMULATED)
        seated(recorder, provenance, LEFT)
        seated(recorder, provenance, BEGUN)
        assert told(counted(folder).cells[Condition.TOM]) == {"quota": 2, "begun": 2, "dropped_out": 1, "under_way": 1}
    assert told(counted(folder).cells[Condition.TOM]) == {"quota": 2, "begun": 2, "dropped_out": 2}


def test_people_and_rehearsals_are_counted_apart(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.create_allocation_list(TWO, 1, 1, kind=SessionKind.STUDY)
        seated(recorder, provenance, kind=SessionKind.STUDY)
        recorder.begin(replace(provenance, kind=SessionKind.SIMULATED), COMPLETED)
        recorder.count_visit(NotRecordedReason.LEFT, kind=SessionKind.SIMULATED)
        recorder.count_visit(NotRecordedReason.DECLINED, kind=SessionKind.STUDY)
        recorder.begin(replace(provenance, kind=SessionKind.TRIAL), BEGUN)
        recorder.count_visit(NotRecordedReason.LEFT, kind=SessionKind.TRIAL)
    people, rehearsals = (counted(folder, kind=kind) for kind in (SessionKind.STUDY, SessionKind.SIMULATED))
    assert told(people.cells[Condition.TOM]) == {"quota": 2, "begun": 1, "consumed": 1}
    assert told(rehearsals.cells[Condition.TOM]) == {"begun": 1, "unlisted": 1}
    assert people.visits == {NotRecordedReason.DECLINED: 1, NotRecordedReason.UNDER_AGE: 0, NotRecordedReason.LEFT: 0}
    assert rehearsals.visits == {
        NotRecordedReason.DECLINED: 0,
        NotRecordedReason.UNDER_AGE: 0,
        NotRecordedReason.LEFT: 1,
    }


def test_raised_quotas_are_counted_once(folder: Path) -> None:
    with Recorder(folder) as recorder:
        recorder.create_allocation_list(TWO, 1, 1, kind=SessionKind.SIMULATED)
        recorder.create_allocation_list({Condition.TOM: 6}, 1, 1, kind=SessionKind.SIMULATED)
    with Recorder(folder, "MI") as recorder:
        recorder.create_allocation_list(TWO, 1, 1, kind=SessionKind.SIMULATED)
    assert counted(folder).cells[Condition.TOM].quota == 8


@pytest.mark.parametrize(
    ("events", "fate"),
    [(COMPLETED, Disposition.CONSUMED), (FINISHED, Disposition.CONSUMED), (LEFT, Disposition.DROPPED_OUT)],
)
def test_counts_add_up_after_somebody_withdrew(
    folder: Path, provenance: Provenance, events: tuple[object, ...], fate: Disposition
) -> None:
    with Recorder(folder) as recorder:
        recorder.create_allocation_list(TWO, 1, 1, kind=SessionKind.SIMULATED)
        placed = replace(
            provenance, slot=recorder.next_slot(kind=SessionKind.SIMULATED), allocation_source=AllocationSource.LIST
        )
        code = recorder.begin(placed, events).code  # type: ignore[arg-type]  # events they are
        seated(recorder, provenance)
    before = counted(folder).cells[Condition.TOM]
    withdraw(folder, code)
    after = counted(folder).cells[Condition.TOM]
    assert after == replace(before, withdrawn=1)
    assert after.fates[fate] >= 1
    assert after.begun == 2
