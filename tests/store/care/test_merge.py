"""Folders of several kiosks become one: everything is there once, whatever the order, or nothing is made."""

from __future__ import annotations

import shutil
import sqlite3
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from kiosk import BadInput
from kiosk.store.care import merge as merge_module
from kiosk.store.care.merge import merge
from kiosk.store.care.verify import verify
from kiosk.store.care.withdraw import withdraw
from kiosk.store.database import FILE
from kiosk.store.reading import archive
from kiosk.store.recorder import Provenance, Recorder, StoreFailed
from kiosk.study.condition import Condition
from kiosk.study.events import Unstored
from tests.store.visitors import BEGUN, COMPLETED, a_day, rows

MUSEUM = Path(__file__).parents[1] / "museum"
TABLES = ("allocation", "booth_event", "event", "participant", "sitting", "source", "tombstone", "visit")


@pytest.fixture
def milan(tmp_path: Path, provenance: Provenance) -> Path:
    """A day in Milan, after which somebody withdrew."""
    folder = tmp_path / "milan"
    people = a_day(folder, provenance, "MI", seed=1)
    withdraw(folder, people[0].code)
    return folder


@pytest.fixture
def girona(tmp_path: Path, provenance: Provenance) -> Path:
    """A day in Girona."""
    a_day(tmp_path / "girona", provenance, "GI", seed=2)
    return tmp_path / "girona"


@pytest.fixture
def out(tmp_path: Path) -> Path:
    """Where the merged data go; it is not there yet."""
    return tmp_path / "out"


def contents(folder: Path) -> dict[str, list[tuple[Any, ...]]]:
    """All that is stored."""
    return {table: rows(folder, f"SELECT * FROM {table}") for table in TABLES}  # noqa: S608 - tables of ours


def people(folder: Path) -> list[tuple[Any, ...]]:
    """Everybody by number and code, with what is stored of them but the sitting's own number."""
    return rows(
        folder,
        """
        SELECT participant.site, participant.simulated, number, code, started_at, seed, condition, place,
            (SELECT group_concat(seq || type || body || at_ms || wall_ms) FROM event WHERE sitting = id)
        FROM participant JOIN sitting ON id = sitting ORDER BY 1, 2, 3
        """,
    )


def test_everything_is_in_the_merged_folder(milan: Path, girona: Path, out: Path) -> None:
    assert merge([milan, girona], out) == 7
    parts, whole = [contents(folder) for folder in (milan, girona)], contents(out)
    for table in TABLES:
        if table != "source":
            assert len(whole[table]) == sum(len(part[table]) for part in parts)
    assert set(whole["source"]) == {row for part in parts for row in part["source"]}
    assert people(out) == sorted(people(milan) + people(girona))
    assert verify(out) == []


def test_every_sitting_is_measured_as_it_was(milan: Path, girona: Path, out: Path) -> None:
    merge([milan, girona], out)
    told = {}
    for folder in (milan, girona, out):
        with archive(folder) as stored:
            told[folder] = {
                sitting.code: (sitting.measures, sitting.status, sitting.stage, sitting.allotted, sitting.participant)
                for sitting in stored.sittings()
            }
    assert told[out] == told[milan] | told[girona]


def test_the_order_of_the_folders_does_not_matter(milan: Path, girona: Path, out: Path, tmp_path: Path) -> None:
    merge([milan, girona], out)
    merge([girona, milan], tmp_path / "other")
    assert contents(out) == contents(tmp_path / "other")


def test_a_sitting_keeps_its_list(milan: Path, girona: Path, out: Path) -> None:
    merge([girona, milan], out)
    mixed = """
        SELECT sitting.site, allocation.site FROM sitting JOIN allocation ON list = allocation.id
        UNION ALL SELECT tombstone.site, allocation.site FROM tombstone JOIN allocation ON list = allocation.id
    """
    assert sorted(rows(out, mixed)) == [("GI", "GI")] * 3 + [("MI", "MI")] * 3


def test_counts_are_those_of_all_together(milan: Path, girona: Path, out: Path) -> None:
    merge([milan, girona], out)
    with archive(out) as stored:
        counts = stored.counts(simulated=False)
    assert sum(cell.quota for cell in counts.cells.values()) == 16
    assert sum(cell.begun for cell in counts.cells.values()) == 6
    assert sum(cell.withdrawn for cell in counts.cells.values()) == 1
    assert counts.visits == {Unstored.DECLINED: 2, Unstored.UNDER_AGE: 2, Unstored.LEFT: 0}
    assert set(counts.cells) == {Condition.TOM, Condition.NOTOM}


def test_what_is_merged_is_left_as_it_was(milan: Path, girona: Path, out: Path) -> None:
    before = [(folder / FILE).read_bytes() for folder in (milan, girona)]
    merge([milan, girona], out)
    assert [(folder / FILE).read_bytes() for folder in (milan, girona)] == before


def test_a_kiosk_goes_on_with_the_merged_folder(milan: Path, girona: Path, out: Path, provenance: Provenance) -> None:
    merge([milan, girona], out)
    with Recorder(out, "MI") as recorder:
        assert recorder.recovered == ()
        person = recorder.begin(replace(provenance, simulated=False), BEGUN)
    assert (person.sitting, person.name) == (9, "MI-4")


def test_whoever_withdraws_is_found_in_the_merged_folder(milan: Path, girona: Path, out: Path) -> None:
    merge([milan, girona], out)
    ((code,),) = rows(out, "SELECT code FROM participant WHERE site = 'GI' AND number = 2 AND NOT simulated")
    withdraw(out, code)
    assert len(rows(out, "SELECT 1 FROM tombstone")) == 2
    assert verify(out) == []


def test_more_than_two_are_merged_and_one_is_copied(
    milan: Path, girona: Path, out: Path, tmp_path: Path, provenance: Provenance
) -> None:
    a_day(tmp_path / "naples", provenance, "NA", seed=3)
    assert merge([milan, girona, tmp_path / "naples"], out) == 11
    assert merge([girona], tmp_path / "alone") == 4
    assert people(tmp_path / "alone") == people(girona)


def test_folders_of_one_site_are_merged_if_nobody_clashes(
    tmp_path: Path, milan: Path, out: Path, provenance: Provenance
) -> None:
    """People in one, rehearsals in the other."""
    rehearsals = tmp_path / "rehearsals"
    with Recorder(rehearsals, "MI") as recorder:
        for seed in (8, 9):
            recorder.begin(replace(provenance, seed=seed), COMPLETED)
    with Recorder(tmp_path / "people", "MI") as recorder:
        recorder.begin(replace(provenance, seed=7, simulated=False), COMPLETED)
    assert merge([rehearsals, tmp_path / "people"], out) == 3
    with pytest.raises(BadInput, match=r"participant MI-1 stands in .*milan and in .*people"):
        merge([milan, tmp_path / "people"], tmp_path / "other")


def test_what_an_older_program_wrote_is_merged_too(girona: Path, out: Path, tmp_path: Path) -> None:
    old = tmp_path / "old"
    old.mkdir()
    shutil.copy(MUSEUM / "schema-1.db", old / FILE)
    before = (old / FILE).read_bytes()
    assert merge([girona, old], out) == 7
    assert (old / FILE).read_bytes() == before
    with archive(out) as stored:
        assert [sitting.participant for sitting in stored.sittings()].count(None) == 3
    assert verify(out) == []


def test_an_empty_folder_may_be_there_already(milan: Path, girona: Path, out: Path) -> None:
    out.mkdir()
    assert merge([milan, girona], out) == 7


# Refused


def test_a_participant_who_stands_in_two_folders_is_refused(milan: Path, out: Path, tmp_path: Path) -> None:
    shutil.copytree(milan, tmp_path / "copy")
    with pytest.raises(BadInput, match=r"participant MI-\d stands in .*milan and in .*copy; nothing was merged"):
        merge([milan, tmp_path / "copy"], out)
    assert not out.exists()


def test_a_participant_who_withdrew_in_one_of_them_is_refused_as_well(
    milan: Path, out: Path, tmp_path: Path, provenance: Provenance
) -> None:
    """Otherwise a copy from before the withdrawal would bring them back."""
    with Recorder(tmp_path / "before", "MI") as recorder:
        recorder.begin(replace(provenance, simulated=False, seed=999), COMPLETED)
    with pytest.raises(BadInput, match=r"participant MI-1 stands in"):
        merge([tmp_path / "before", milan], out)


def test_a_code_that_stands_in_two_folders_is_refused(out: Path, tmp_path: Path, provenance: Provenance) -> None:
    codes = []
    for name, simulated in (("one", False), ("two", True)):
        with Recorder(tmp_path / name) as recorder:
            codes.append(recorder.begin(replace(provenance, simulated=simulated), COMPLETED).code)
    code, _ = codes
    with pytest.raises(BadInput, match=rf"the code {code} stands in .*one and in .*two; nothing was merged"):
        merge([tmp_path / "one", tmp_path / "two"], out)
    assert not out.exists()


def test_a_folder_that_is_not_empty_is_refused_and_left_alone(milan: Path, girona: Path, out: Path) -> None:
    out.mkdir()
    (out / "thesis.txt").write_text("years of work")
    with pytest.raises(BadInput, match="is not an empty folder; nothing was merged"):
        merge([milan, girona], out)
    assert [(file.name, file.read_text()) for file in out.iterdir()] == [("thesis.txt", "years of work")]
    with pytest.raises(BadInput, match="is not an empty folder"):
        merge([milan, girona], out / "thesis.txt")


def test_a_folder_that_is_named_twice_is_refused(milan: Path, out: Path) -> None:
    with pytest.raises(BadInput, match="a data folder is named twice"):
        merge([milan, milan.parent / "." / "milan"], out)


def test_a_folder_without_data_is_refused(milan: Path, out: Path, tmp_path: Path) -> None:
    with pytest.raises(BadInput, match="there is no database in"):
        merge([milan, tmp_path / "nowhere"], out)
    assert not out.exists()
    assert not (tmp_path / "nowhere").exists()


def test_a_folder_that_is_written_in_is_refused(milan: Path, girona: Path, out: Path) -> None:
    with Recorder(girona), pytest.raises(BadInput, match=r"a kiosk is writing in .*girona: close it first"):
        merge([milan, girona], out)
    assert not out.exists()


# Failed


def test_a_disk_that_fails_in_the_middle_leaves_nothing(
    milan: Path, girona: Path, out: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    written: list[str] = []

    def failing(connection: sqlite3.Connection, table: str, row: dict[str, Any]) -> int:
        if len(written) == 20:
            raise sqlite3.OperationalError("database or disk is full")
        written.append(table)
        with closing(connection.cursor()) as cursor:
            marks = ", ".join("?" * len(row))
            cursor.execute(f"INSERT INTO {table} ({', '.join(row)}) VALUES ({marks})", tuple(row.values()))  # noqa: S608
            return cursor.lastrowid or 0

    there = sorted(milan.parent.iterdir())
    with monkeypatch.context() as patched:
        patched.setattr(merge_module, "insert", failing)
        with pytest.raises(StoreFailed, match=r"out could not be written: database or disk is full"):
            merge([milan, girona], out)
    assert sorted(milan.parent.iterdir()) == there
    assert merge([milan, girona], out) == 7
