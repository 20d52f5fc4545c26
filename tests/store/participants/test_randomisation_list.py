"""The allocation list is fixed once; games that are completed consume it, and nothing else does."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Sequence
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import pytest

from kiosk import UserInputError
from kiosk.experiment.condition import AllocationSlot, Condition, allocation_slots
from kiosk.experiment.events import Event
from kiosk.experiment.outcomes import AllocationSource, SessionKind
from kiosk.store.database import FILE
from kiosk.store.recorder import Provenance, Recorder
from tests.store.visitors import BEGUN, FINISHED, LEFT, rows, seated

FOUR = {Condition.TOM: 4, Condition.NOTOM: 4}
EIGHT = {Condition.TOM: 8, Condition.NOTOM: 8}
THREE = {Condition.TOM: 3, Condition.NOTOM: 3}


# Fixed


def test_a_list_is_fixed_and_found_again(folder: Path) -> None:
    for _ in range(2):
        with Recorder(folder) as recorder:
            assert recorder.create_allocation_list(FOUR, 4, 7, kind=SessionKind.STUDY) == allocation_slots(FOUR, 4, 7)
    assert rows(folder, "SELECT site, kind, seed, block_size FROM allocation_list") == [("", 0, 7, 4)]


def test_a_seed_that_nobody_gave_is_drawn_and_kept(folder: Path) -> None:
    lists = []
    for _ in range(3):
        with Recorder(folder) as recorder:
            lists.append(recorder.create_allocation_list(FOUR, 4, None, kind=SessionKind.STUDY))
    ((seed,),) = rows(folder, "SELECT seed FROM allocation_list")
    assert lists == [allocation_slots(FOUR, 4, seed)] * 3


def test_a_stored_list_can_be_read_without_the_program(folder: Path) -> None:
    with Recorder(folder) as recorder:
        listed = recorder.create_allocation_list(FOUR, 4, 7, kind=SessionKind.STUDY)
    ((quotas, blocks),) = rows(folder, "SELECT quotas, slots FROM allocation_list")
    assert json.loads(quotas) == {"tom": 4, "notom": 4}
    assert json.loads(blocks) == [
        [place.condition.name for place in listed if place.block == block] for block in (1, 2)
    ]


def test_raised_quotas_make_the_list_longer_and_change_nothing_of_it(folder: Path) -> None:
    with Recorder(folder) as recorder:
        short = recorder.create_allocation_list(FOUR, 4, 7, kind=SessionKind.STUDY)
        longer = recorder.create_allocation_list(EIGHT, 4, None, kind=SessionKind.STUDY)
    assert longer[: len(short)] == short
    assert longer == allocation_slots(EIGHT, 4, 7)
    assert rows(folder, "SELECT seed, quotas FROM allocation_list") == [
        (7, '{"tom": 4, "notom": 4}'),
        (7, '{"tom": 8, "notom": 8}'),
    ]


def test_a_list_that_ended_within_a_block_can_be_made_longer_too(folder: Path) -> None:
    with Recorder(folder) as recorder:
        short = recorder.create_allocation_list(THREE, 4, 7, kind=SessionKind.STUDY)
        longer = recorder.create_allocation_list(EIGHT, 4, 7, kind=SessionKind.STUDY)
        assert longer[: len(short)] == short
        assert recorder.create_allocation_list(EIGHT, 4, 7, kind=SessionKind.STUDY) == longer
    assert len(rows(folder, "SELECT 1 FROM allocation_list")) == 2


@pytest.mark.parametrize(
    ("quotas", "block", "seed"),
    [
        (THREE, 4, 7),
        (FOUR, 2, 7),
        (FOUR, 4, 8),
        (EIGHT, 4, 8),
        ({Condition.TOM: 8, Condition.NOTOM: 4}, 6, 7),
        ({Condition.TOM: 8, Condition.RANDOM_EXPLAINED: 8}, 4, 7),
    ],
)
def test_another_list_is_refused_and_the_first_one_stays(
    folder: Path, quotas: dict[Condition, int], block: int, seed: int
) -> None:
    with Recorder(folder) as recorder:
        recorder.create_allocation_list(FOUR, 4, 7, kind=SessionKind.STUDY)
        before = rows(folder, "SELECT * FROM allocation_list")
        with pytest.raises(
            UserInputError,
            match=r"another allocation list is already fixed in this data folder \(4 tom, 4 notom, in blocks of 4\)",
        ):
            recorder.create_allocation_list(quotas, block, seed, kind=SessionKind.STUDY)
        assert rows(folder, "SELECT * FROM allocation_list") == before
        recorder.create_allocation_list(FOUR, 4, 7, kind=SessionKind.STUDY)


def test_a_list_that_there_cannot_be_is_refused_and_not_stored(folder: Path) -> None:
    with Recorder(folder) as recorder, pytest.raises(UserInputError, match="a block of 3 slots"):
        recorder.create_allocation_list(FOUR, 3, 7, kind=SessionKind.STUDY)
    assert rows(folder, "SELECT * FROM allocation_list") == []


def test_people_rehearsals_trials_and_every_site_have_lists_of_their_own(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.create_allocation_list(FOUR, 4, 1, kind=SessionKind.STUDY)
        recorder.create_allocation_list(FOUR, 2, 2, kind=SessionKind.SIMULATED)
        for _ in range(3):
            seated(recorder, provenance)
        recorder.create_allocation_list(EIGHT, 4, 3, kind=SessionKind.TRIAL)
        seated(recorder, provenance, kind=SessionKind.TRIAL)
        assert recorder.next_slot(kind=SessionKind.TRIAL) == allocation_slots(EIGHT, 4, 3)[1]
        assert recorder.next_slot(kind=SessionKind.SIMULATED) == allocation_slots(FOUR, 2, 2)[3]
        assert recorder.next_slot(kind=SessionKind.STUDY) == allocation_slots(FOUR, 4, 1)[0]
    with Recorder(folder, "MI") as recorder:
        assert recorder.next_slot(kind=SessionKind.STUDY) is None
        recorder.create_allocation_list(EIGHT, 8, 3, kind=SessionKind.STUDY)
        assert recorder.next_slot(kind=SessionKind.STUDY) == allocation_slots(EIGHT, 8, 3)[0]


# Consumed


def test_a_completed_game_consumes_its_place(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        listed = recorder.create_allocation_list(FOUR, 4, 7, kind=SessionKind.SIMULATED)
        assert [seated(recorder, provenance) for _ in listed] == list(listed)
        assert recorder.next_slot(kind=SessionKind.SIMULATED) is None


@pytest.mark.parametrize("events", [BEGUN, LEFT])
def test_a_game_that_is_not_completed_gives_its_place_back(
    folder: Path, provenance: Provenance, events: Sequence[Event]
) -> None:
    with Recorder(folder) as recorder:
        listed = recorder.create_allocation_list(FOUR, 4, 7, kind=SessionKind.SIMULATED)
        assert [seated(recorder, provenance, events) for _ in range(3)] == [listed[0]] * 3
        assert seated(recorder, provenance) == listed[0]
        assert seated(recorder, provenance) == listed[1]


def test_whoever_leaves_after_the_game_has_consumed_the_place(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        listed = recorder.create_allocation_list(FOUR, 4, 7, kind=SessionKind.SIMULATED)
        seated(recorder, provenance, FINISHED)
        assert recorder.next_slot(kind=SessionKind.SIMULATED) == listed[1]


@pytest.mark.parametrize("allocation_source", [AllocationSource.OVERRIDE, AllocationSource.BEYOND])
def test_what_was_not_allocated_by_the_list_takes_no_slot(
    folder: Path, provenance: Provenance, allocation_source: AllocationSource
) -> None:
    with Recorder(folder) as recorder:
        listed = recorder.create_allocation_list(FOUR, 4, 7, kind=SessionKind.SIMULATED)
        assert seated(recorder, provenance, allocation_source=allocation_source) is None
        assert recorder.next_slot(kind=SessionKind.SIMULATED) == listed[0]
    assert rows(folder, "SELECT allocation_list, allocation_slot, allocation_source FROM session") == [
        (None, None, allocation_source.value)
    ]


def test_a_place_stays_consumed_when_its_game_is_withdrawn(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        listed = recorder.create_allocation_list(FOUR, 4, 7, kind=SessionKind.SIMULATED)
        for _ in range(2):
            seated(recorder, provenance)
    for session, completed in ((1, 1), (2, 0)):
        with closing(sqlite3.connect(folder / FILE)) as connection, connection:
            connection.execute(
                "INSERT INTO tombstone VALUES"
                " (:session, '', :session, 1, 'tom', 1, :session, 'list', 'completed', :completed, '2026-01-31', 1)",
                {"session": session, "completed": completed},
            )
            for table, key in (("event", "session"), ("participant", "session"), ("session", "id")):
                connection.execute(f"DELETE FROM {table} WHERE {key} = ?", (session,))  # noqa: S608 - a table of ours
    with Recorder(folder) as recorder:
        assert recorder.next_slot(kind=SessionKind.SIMULATED) == listed[1]


def test_places_stay_consumed_when_the_list_is_made_longer(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.create_allocation_list(THREE, 4, 7, kind=SessionKind.SIMULATED)
        for _ in range(6):
            seated(recorder, provenance)
        assert recorder.next_slot(kind=SessionKind.SIMULATED) is None
        longer = recorder.create_allocation_list(EIGHT, 4, 7, kind=SessionKind.SIMULATED)
        assert [seated(recorder, provenance) for _ in range(10)] == list(longer[6:])
    assert rows(folder, "SELECT allocation_list, count(*) FROM session GROUP BY allocation_list") == [(1, 6), (2, 10)]


def test_the_text_of_a_list_is_read_once_and_of_a_longer_one_once_more(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.create_allocation_list(FOUR, 4, 7, kind=SessionKind.SIMULATED)
        asked: list[str] = []
        recorder._connection.set_trace_callback(lambda query: asked.append(query) if "SELECT slots" in query else None)
        for _ in range(3):
            seated(recorder, provenance)
        assert len(asked) == 1
        recorder.create_allocation_list(EIGHT, 4, 7, kind=SessionKind.SIMULATED)
        for _ in range(3):
            seated(recorder, provenance)
        assert len(asked) == 2


def test_a_session_s_row_says_how_it_came_to_its_condition(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        first, *_ = recorder.create_allocation_list(FOUR, 4, 7, kind=SessionKind.SIMULATED)
        seated(recorder, provenance)
        recorder.begin(provenance, BEGUN)
    assert rows(folder, "SELECT condition, allocation_list, allocation_slot, allocation_source FROM session") == [
        (first.condition.name, 1, 1, "list"),
        ("tom", None, None, None),
    ]


def test_a_place_that_is_not_free_is_not_taken(folder: Path, provenance: Provenance) -> None:
    other = AllocationSlot(1, 1, provenance.plan.condition)
    with Recorder(folder) as recorder:
        with pytest.raises(ValueError, match="there is no free"):
            recorder.begin(replace(provenance, slot=other, allocation_source=AllocationSource.LIST), BEGUN)
        recorder.create_allocation_list(FOUR, 4, 7, kind=SessionKind.SIMULATED)
        taken = seated(recorder, provenance)
        assert taken is not None
        plan = replace(provenance.plan, condition=taken.condition)
        with pytest.raises(ValueError, match="there is no free"):
            recorder.begin(replace(provenance, plan=plan, slot=taken, allocation_source=AllocationSource.LIST), BEGUN)
    assert rows(folder, "SELECT count(*) FROM session") == [(1,)]


def test_a_place_of_another_condition_is_not_taken(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        listed = recorder.create_allocation_list(FOUR, 4, 7, kind=SessionKind.SIMULATED)
        place = next(place for place in listed if place.condition is not provenance.plan.condition)
        with pytest.raises(ValueError, match="is not one for Condition"):
            recorder.begin(replace(provenance, slot=place, allocation_source=AllocationSource.LIST), BEGUN)


@pytest.mark.parametrize("allocation_source", [None, AllocationSource.OVERRIDE, AllocationSource.BEYOND])
def test_a_slot_and_how_it_was_allocated_go_together(
    folder: Path, provenance: Provenance, allocation_source: AllocationSource | None
) -> None:
    with Recorder(folder) as recorder:
        recorder.create_allocation_list(FOUR, 4, 7, kind=SessionKind.SIMULATED)
        place = recorder.next_slot(kind=SessionKind.SIMULATED)
        with pytest.raises(ValueError, match="cannot take AllocationSlot"):
            recorder.begin(replace(provenance, slot=place, allocation_source=allocation_source), BEGUN)
        with pytest.raises(ValueError, match="cannot take None"):
            recorder.begin(replace(provenance, allocation_source=AllocationSource.LIST), BEGUN)
