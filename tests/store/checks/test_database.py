"""Checks of the database, its copies, its allocation list, and the clock; none of them changes a byte."""

from __future__ import annotations

import json
import os
import shutil
import sqlite3
from contextlib import closing
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest

from kiosk.config import Allocation
from kiosk.experiment.outcomes import SessionKind
from kiosk.preflight import Severity
from kiosk.store.checks import OLD, SLACK, allocation_check, backup_check, clock_check, database_check, sessions_check
from kiosk.store.copies import FILE as COPIES
from kiosk.store.copies import CopyKind, backups_of, note_copy
from kiosk.store.database import FILE, in_use
from kiosk.store.drives import carry
from kiosk.store.maintenance import FOLDER, back_up
from kiosk.store.migrations import SCHEMA
from kiosk.store.recorder import Provenance, Recorder
from tests.store.visitors import BEGUN, COMPLETED, FOUR, a_day, seated

DECLARED = Allocation(target_n={"tom": 4, "notom": 4}, block_size=4)


def files(folder: Path) -> dict[str, bytes]:
    """Everything in a folder."""
    return {str(file.relative_to(folder)): file.read_bytes() for file in folder.rglob("*") if file.is_file()}


def test_a_folder_without_a_database_is_well_and_gets_none(tmp_path: Path) -> None:
    now = datetime.now(UTC)
    found = [
        *database_check(tmp_path, busy=False),
        *backup_check(tmp_path, now),
        *allocation_check(tmp_path, "", DECLARED),
    ]
    assert {each.severity for each in found} == {Severity.OK}
    assert list(sessions_check(tmp_path, busy=False)) == []
    assert not in_use(tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_looking_at_a_folder_that_is_not_there_does_not_make_it(tmp_path: Path) -> None:
    assert not in_use(tmp_path / "new")
    assert not (tmp_path / "new").exists()


def test_a_day_is_counted_and_nothing_of_it_is_touched(folder: Path, provenance: Provenance) -> None:
    a_day(folder, provenance)
    before = files(folder)
    (whole,) = database_check(folder, busy=False)
    (stored,) = sessions_check(folder, busy=False)
    assert whole.severity is Severity.OK
    assert stored.message == "3 of people, 0 of them cut off"
    assert files(folder) == before


def test_a_session_that_was_cut_off_is_told(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.create_allocation_list(FOUR, 4, 1, kind=SessionKind.STUDY)
        seated(recorder, provenance, BEGUN, kind=SessionKind.STUDY)
        seated(recorder, provenance, COMPLETED, kind=SessionKind.STUDY)
        seated(recorder, provenance, BEGUN, kind=SessionKind.STUDY)
    (stored,) = sessions_check(folder, busy=False)
    assert stored.message == "3 of people, 2 of them cut off"


def test_a_kiosk_at_work_is_seen_and_goes_on(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, BEGUN)
        (found,) = database_check(folder, busy=in_use(folder))
        recorder.append(COMPLETED[1:])
    assert (found.severity, "is open" in found.message) == (Severity.WARNING, True)
    assert not in_use(folder)


def foreign(path: Path) -> str:
    with closing(sqlite3.connect(path)) as other:
        other.execute("CREATE TABLE theirs (x)")
    return "not a Recollect database"


def nonsense(path: Path) -> str:
    path.write_bytes(b"no database at all" * 20)
    return "not a Recollect database"


def newer(path: Path) -> str:
    with closing(sqlite3.connect(path)) as ours:
        ours.execute(f"PRAGMA user_version = {SCHEMA + 1}")
    return "newer Recollect"


def torn(path: Path) -> str:
    content = bytearray(path.read_bytes())
    content[4096:] = bytes(len(content) - 4096)
    path.write_bytes(content)
    return ""


@pytest.mark.parametrize("spoil", [foreign, nonsense, newer, torn])
def test_a_database_that_cannot_be_gone_on_with_is_bad_and_left_as_it_is(
    spoil: object, folder: Path, provenance: Provenance
) -> None:
    a_day(folder, provenance)
    if spoil in (foreign, nonsense):
        (folder / FILE).unlink()
    words = spoil(folder / FILE)  # type: ignore[operator]
    before = files(folder)
    (found,) = database_check(folder, busy=False)
    assert (found.severity, words in found.message) == (Severity.ERROR, True)
    rest = [
        *sessions_check(folder, busy=False),
        *allocation_check(folder, "", DECLARED),
        *clock_check(folder, datetime.now(UTC), None),
    ]
    assert Severity.ERROR not in {each.severity for each in rest}
    assert files(folder) == before


# Copies


def test_people_without_a_copy_are_told_of(folder: Path, provenance: Provenance) -> None:
    a_day(folder, provenance)
    (found,) = backup_check(folder, datetime.now(UTC))
    assert (found.severity, found.remedy) == (Severity.WARNING, "recollect backup")


def test_a_copy_of_today_is_well_and_an_old_one_only_if_nothing_came_since(
    folder: Path, provenance: Provenance
) -> None:
    a_day(folder, provenance)
    made = back_up(folder, folder / FOLDER)
    now = datetime.now(UTC)
    (fresh,) = backup_check(folder, now)
    (rested,) = backup_check(folder, now + 3 * OLD)
    long_ago = (now - 2 * OLD).timestamp()
    os.utime(made, (long_ago, long_ago))
    (old,) = backup_check(folder, now)
    assert [each.severity for each in (fresh, rested, old)] == [Severity.OK, Severity.OK, Severity.WARNING]


def test_a_copy_that_was_carried_away_counts_also_where_its_drive_is_unplugged(
    folder: Path, provenance: Provenance, tmp_path: Path
) -> None:
    a_day(folder, provenance)
    stick = tmp_path / "mounts" / "stick"
    copy = carry(folder, stick, keep=1).file
    note_copy(folder, CopyKind.BACKUP, copy)
    now = datetime.now(UTC)
    (there,) = backup_check(folder, now)
    shutil.rmtree(stick)
    (unplugged,) = backup_check(folder, now)
    stick.mkdir()
    (deleted,) = backup_check(folder, now)
    assert [each.severity for each in (there, unplugged, deleted)] == [Severity.OK, Severity.OK, Severity.WARNING]


def test_the_newest_copy_counts_wherever_it_is(folder: Path, provenance: Provenance, tmp_path: Path) -> None:
    a_day(folder, provenance)
    made = back_up(folder, folder / FOLDER)
    long_ago = (datetime.now(UTC) - 2 * OLD).timestamp()
    os.utime(made, (long_ago, long_ago))
    copy = carry(folder, tmp_path / "stick", keep=1).file
    note_copy(folder, CopyKind.BACKUP, copy)
    # What was noted by hand, and wrongly, counts for nothing.
    with (folder / COPIES).open("a", encoding="utf-8") as notes:
        notes.write(json.dumps({"made_at": "soon", "kind": "backup", "place": str(tmp_path)}) + "\n")
    assert [each.file for each in backups_of(folder)] == [made, copy]


# Places


def test_the_list_tells_how_much_of_it_is_left(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.create_allocation_list(FOUR, 4, 1, kind=SessionKind.STUDY)
        first = seated(recorder, provenance, kind=SessionKind.STUDY)
    assert first is not None
    (found,) = allocation_check(folder, "", DECLARED)
    assert f"{first.condition.name} 1 of 4" in found.message
    (elsewhere,) = allocation_check(folder, "ROME", DECLARED)
    assert "fixed when the kiosk opens" in elsewhere.message


def test_a_list_that_is_used_up_is_told_of(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.create_allocation_list(FOUR, 4, 1, kind=SessionKind.STUDY)
        for _ in range(8):
            seated(recorder, provenance, kind=SessionKind.STUDY)
    (found,) = allocation_check(folder, "", DECLARED)
    assert (found.severity, found.message) == (Severity.WARNING, "used up: tom 4 of 4, notom 4 of 4")
    raised = Allocation(target_n={"tom": 8, "notom": 8}, block_size=4)
    (more,) = allocation_check(folder, "", raised)
    assert (more.severity, more.message) == (Severity.OK, "tom 4 of 8, notom 4 of 8")


@pytest.mark.parametrize(
    "other",
    [
        {"target_n": {"tom": 4, "notom": 8}, "block_size": 6},
        {"block_size": 8},
        {"seed": 2},
        {"target_n": {"tom": 2, "notom": 2}},
    ],
)
def test_another_list_than_the_fixed_one_is_bad_before_the_kiosk_refuses_it(
    other: dict[str, object], folder: Path, provenance: Provenance
) -> None:
    a_day(folder, provenance)
    (found,) = allocation_check(folder, "", DECLARED.model_copy(update=other))
    assert (found.severity, "another allocation list" in found.message) == (Severity.ERROR, True)


def test_a_study_without_quotas_has_no_list(folder: Path) -> None:
    (found,) = allocation_check(folder, "", Allocation(target_n={}))
    assert found.severity is Severity.OK


# Clock


def test_a_clock_that_was_set_back_is_told_with_both_times(folder: Path, provenance: Provenance) -> None:
    a_day(folder, provenance)
    now = datetime.now(UTC)
    (right,) = clock_check(folder, now, now - timedelta(days=9))
    (a_little,) = clock_check(folder, now - SLACK / 2, None)
    (back,) = clock_check(folder, now - timedelta(hours=3), None)
    assert [each.severity for each in (right, a_little, back)] == [Severity.OK, Severity.OK, Severity.WARNING]
    assert f"{now:%Y-%m-%d %H:%M}" in back.message
    assert "UTC" in right.message


def test_a_clock_from_before_the_program_was_made_is_told_of(tmp_path: Path) -> None:
    made = datetime(2026, 5, 1, tzinfo=UTC)
    (found,) = clock_check(tmp_path, datetime(1970, 1, 1, tzinfo=UTC), made)
    assert (found.severity, "2026-05-01" in found.message) == (Severity.WARNING, True)
