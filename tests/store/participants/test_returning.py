"""A participant who comes back keeps number and code, and all visits go together."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Sequence
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import pytest

from kiosk.experiment import events as happened
from kiosk.experiment.condition import Condition
from kiosk.experiment.events import Event
from kiosk.experiment.information import RETURNING
from kiosk.experiment.outcomes import AllocationSource, Disposition, SessionKind
from kiosk.store.codes import hashes_of
from kiosk.store.database import FILE
from kiosk.store.maintenance import FOLDER, back_up
from kiosk.store.merge import merge
from kiosk.store.participants import Participant, ReturningVisitor
from kiosk.store.queries import open_repository
from kiosk.store.recorder import Provenance, Recorder
from kiosk.store.session_records import open_records
from kiosk.store.verify import Verification, verify
from kiosk.store.withdrawal import find_withdrawal, withdraw
from tests.store.visitors import COMPLETED, FOUR, LEFT, rows, saying

KIND = SessionKind.STUDY


def agreeing(events: Sequence[Event] = COMPLETED, purposes: tuple[str, ...] = ("take_part", RETURNING)) -> list[Event]:
    """Return the events of a session in which the visitor agreed to these purposes."""
    consent = happened.ConsentGiven(at_ms=0, version="1", sha256="", language="en", purposes=purposes)
    return [events[0], consent, *events[1:]]


def known(recorder: Recorder, code: str) -> ReturningVisitor | None:
    """Return who has a code, as the kiosk asks."""
    return recorder.returning_visitor(code, hashes_of(code, recorder.code_keys()), KIND)


def begin(recorder: Recorder, provenance: Provenance, code: str = "", events: Sequence[Event] = ()) -> Participant:
    """Have a visitor come, who types a code if they were here before."""
    returning = known(recorder, code) if code else None
    plan = replace(provenance.plan, visit=returning.visit if returning else 1)
    source = AllocationSource.RETURNING if returning else None
    session = replace(provenance, plan=plan, kind=KIND, returning=returning, allocation_source=source)
    return recorder.begin(session, events or agreeing())


def test_someone_who_comes_back_keeps_number_and_code(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder, "MI") as recorder:
        first, other = begin(recorder, provenance), begin(recorder, provenance)
        again = begin(recorder, provenance, first.code.lower())
        third = begin(recorder, provenance, again.code)
        newcomer = begin(recorder, provenance)
    assert [(each.name, each.visit) for each in (first, other, again, third, newcomer)] == [
        ("MI-1", 1),
        ("MI-2", 1),
        ("MI-1", 2),
        ("MI-1", 3),
        ("MI-3", 1),
    ]
    assert first.code == again.code == third.code
    assert verify(folder) == []


def test_what_the_visits_before_were_like_is_known(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        code = begin(recorder, provenance).code
        begin(recorder, replace(provenance, plan=replace(provenance.plan, condition=Condition.NOTOM)), code)
        assert known(recorder, code) == ReturningVisitor(1, 3, (provenance.plan.condition, Condition.NOTOM), code)


@pytest.mark.parametrize("purposes", [(), ("take_part",)])
def test_who_did_not_agree_to_come_back_is_not_known(
    folder: Path, provenance: Provenance, purposes: tuple[str, ...]
) -> None:
    with Recorder(folder) as recorder:
        code = begin(recorder, provenance, events=agreeing(purposes=purposes)).code
        assert known(recorder, code) is None


def test_a_code_of_another_booth_site_or_kind_is_not_known(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder, "MI") as recorder:
        code = begin(recorder, provenance).code
        assert recorder.returning_visitor(code, hashes_of(code, recorder.code_keys()), SessionKind.TRIAL) is None
    with Recorder(folder, "GI") as recorder:
        assert known(recorder, code) is None
    with Recorder(folder / "other", "MI") as recorder:
        assert known(recorder, code) is None


def test_a_merged_folder_knows_the_codes_of_each_booth(folder: Path, provenance: Provenance) -> None:
    codes: dict[str, str] = {}
    for site in ("MI", "GI"):
        with Recorder(folder / site, site) as recorder:
            codes[site] = begin(recorder, provenance).code
            begin(recorder, provenance, codes[site])
    merge([folder / "MI", folder / "GI"], folder / "both")
    assert verify(folder / "both") == []
    for site, code in codes.items():
        with Recorder(folder / "both", site) as recorder:
            again = begin(recorder, provenance, code)
            assert (again.name, again.visit) == (f"{site}-1", 3)
    with open_records(folder / "both", frozenset({KIND})) as records:
        names = sorted(record.name for record in records)
    assert names == ["GI-P0001", "GI-P0001v2", "GI-P0001v3", "MI-P0001", "MI-P0001v2", "MI-P0001v3"]


def test_a_later_visit_takes_no_slot_and_is_counted_by_itself(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.create_allocation_list(FOUR, 4, 7, kind=KIND)
        before = recorder.next_slot(kind=KIND)
        code = begin(recorder, provenance).code
        begin(recorder, provenance, code)
        assert recorder.next_slot(kind=KIND) == before
    with open_repository(folder) as archive:
        counts = archive.counts(kind=KIND)
        assert [session.visit for session in archive.sessions()] == [1, 2]
    cell = counts.cells[provenance.plan.condition]
    assert (cell.begun, cell.fates[Disposition.UNLISTED], cell.fates[Disposition.RETURNING]) == (2, 1, 1)


def test_a_stored_visit_is_read_with_the_plan_of_its_visit(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        code = begin(recorder, provenance).code
        begin(recorder, provenance, code)
    with open_repository(folder) as archive:
        assert [archive.plan(number).visit for number in (1, 2)] == [1, 2]
    with open_records(folder, frozenset({KIND})) as records:
        kept = list(records)
    assert [(each.name, each.participant, each.visit) for each in kept] == [
        ("P0001", "P0001", 1),
        ("P0001v2", "P0001", 2),
    ]
    assert [each.plan.visit for each in kept if each.plan] == [1, 2]


def test_a_visit_that_is_resumed_has_one_more_code_for_the_same_person(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        code = begin(recorder, provenance).code
        begin(recorder, provenance, code, agreeing(COMPLETED[:1]))
    with Recorder(folder) as recorder:
        resumed = recorder.resume(2)
        assert (resumed.number, resumed.visit) == (1, 2)
        assert resumed.code != code
        recorder.append(COMPLETED[1:])
        again = known(recorder, resumed.code)
        assert again is not None
        assert (again.number, again.visit) == (1, 3)


@pytest.mark.parametrize("which", ["code", "last session"])
def test_all_visits_are_withdrawn_together(folder: Path, provenance: Provenance, which: str) -> None:
    words = "a sentence of the visitor who withdraws"
    with Recorder(folder) as recorder:
        code = begin(recorder, provenance, events=agreeing(saying(words))).code
        begin(recorder, provenance)
        begin(recorder, provenance, code, agreeing(saying(words)))
    back_up(folder, folder / FOLDER)
    who = code if which == "code" else 3
    assert find_withdrawal(folder, who).sessions == (1, 3)
    withdraw(folder, who)
    assert rows(folder, "SELECT session, number, visit FROM tombstone") == [(1, 1, 1), (3, 1, 2)]
    assert rows(folder, "SELECT session, number FROM participant") == [(2, 2)]
    assert verify(folder) == []
    for file in folder.rglob("*"):
        assert not file.is_file() or words.encode() not in file.read_bytes(), file
    with Recorder(folder) as recorder:
        assert known(recorder, code) is None
        assert begin(recorder, provenance).number == 3


def test_a_visit_that_was_deleted_at_once_is_counted_and_the_others_stay(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        code = begin(recorder, provenance).code
        begin(recorder, provenance, code, agreeing(LEFT[:1]))
        recorder.append_and_withdraw(LEFT[1:])
        assert begin(recorder, provenance, code).visit == 3
    with Recorder(folder):
        pass
    assert verify(folder) == []
    assert find_withdrawal(folder, code).sessions == (1, 3)


def test_verify_finds_a_visit_that_is_missing(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        code = begin(recorder, provenance).code
        begin(recorder, provenance, code)
    with closing(sqlite3.connect(folder / FILE)) as connection, connection:
        (trigger,) = connection.execute(
            "SELECT sql FROM sqlite_master WHERE name = 'participant_is_never_updated'"
        ).fetchone()
        connection.execute("DROP TRIGGER participant_is_never_updated")
        connection.execute("UPDATE participant SET visit = 4 WHERE session = 2")
        connection.execute(trigger)
    assert [(flaw.check, flaw.what) for flaw in verify(folder)] == [
        (Verification.PARTICIPANTS, "has 2 visits, and the last one is number 4")
    ]


def test_the_plan_must_be_that_of_the_visit(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder, pytest.raises(ValueError, match="a plan of visit 2"):
        recorder.begin(replace(provenance, plan=replace(provenance.plan, visit=2)), COMPLETED)


def test_withdrawing_says_as_json_which_sessions_go(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        code = begin(recorder, provenance).code
        begin(recorder, provenance, code)
    told = json.loads(json.dumps(find_withdrawal(folder, code).to_json()))
    assert (told["session"], told["sessions"], told["participant"]) == (1, [1, 2], "1")
