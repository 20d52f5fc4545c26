"""The list of people who withdrew lies beside the database from the first start on, so that its absence is noticed."""

from __future__ import annotations

import shutil
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from kiosk import UserInputError
from kiosk.cli.main import recollect
from kiosk.experiment.experimenter import AuditEvent
from kiosk.experiment.outcomes import SessionKind
from kiosk.store.copies import CopyKind, note_copy
from kiosk.store.database import FILE
from kiosk.store.drives import carry
from kiosk.store.maintenance import back_up
from kiosk.store.merge import merge
from kiosk.store.recorder import Provenance, Recorder
from kiosk.store.snapshot import read_snapshot
from kiosk.store.tombstones import FILE as LIST
from kiosk.store.verify import Verification, look_through, verify
from kiosk.store.withdrawal import withdraw
from tests.store.visitors import COMPLETED


@pytest.fixture
def codes(folder: Path, provenance: Provenance) -> list[str]:
    """Return the codes of two people in a folder."""
    with Recorder(folder) as recorder:
        return [recorder.begin(replace(provenance, kind=SessionKind.STUDY), COMPLETED).code for _ in range(2)]


def found(folder: Path) -> list[str]:
    """Return what is wrong with the list, and nothing else may be."""
    flaws = verify(folder)
    assert {flaw.check for flaw in flaws} <= {Verification.LIST}
    return [flaw.what for flaw in flaws]


def told(folder: Path) -> list[tuple[AuditEvent, dict[str, Any]]]:
    """Return what the panel tells of today."""
    seen = read_snapshot(folder, datetime.now(UTC), kind=SessionKind.STUDY)
    return [(note.kind, note.payload) for note in seen.deviations]


def test_the_list_is_there_from_the_first_start_on(folder: Path, codes: list[str]) -> None:
    assert len(codes) == 2
    assert (folder / LIST).read_bytes() == b""
    assert (found(folder), told(folder)) == ([], [])


def test_a_database_that_was_carried_without_its_list_is_noticed(
    folder: Path, codes: list[str], tmp_path: Path
) -> None:
    """A person may have withdrawn after it was copied."""
    copy = tmp_path / "copy"
    copy.mkdir()
    shutil.copy(folder / FILE, copy)
    withdraw(folder, codes[0])
    (sentence,) = found(copy)
    assert sentence.startswith("is missing: put the one that lay beside this database with it")
    with pytest.raises(UserInputError, match=r"recollect\.withdrawn: is missing"):
        merge([copy], tmp_path / "out")
    with Recorder(copy):
        assert told(copy) == [(AuditEvent.WITHDRAWN_LIST_MISSING, {"list": LIST})]
    assert found(copy) == []


def test_a_copy_that_was_made_by_command_has_its_list(folder: Path, codes: list[str], tmp_path: Path) -> None:
    assert codes
    back_up(folder, tmp_path / "stick").rename(tmp_path / "stick" / FILE)
    assert found(tmp_path / "stick") == []


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        ("", "lacks 1 codes of people who withdrew by the database"),
        ("0" * 64 + " 12345678\n", "has 1 lines that cannot be read"),
    ],
)
def test_a_list_that_is_shorter_or_damaged_is_noticed(
    folder: Path, codes: list[str], content: str, sentence: str
) -> None:
    withdraw(folder, codes[0])
    assert found(folder) == []
    (folder / LIST).write_text(content)
    assert found(folder)[0] == sentence


def test_people_who_are_deleted_again_at_a_start_are_told_in_the_panel(
    folder: Path, codes: list[str], tmp_path: Path
) -> None:
    shutil.copy(folder / FILE, tmp_path / "older.db")
    withdraw(folder, codes[0])
    shutil.copy(tmp_path / "older.db", folder / FILE)
    with Recorder(folder):
        assert told(folder) == [(AuditEvent.WITHDRAWN_AGAIN, {"people": 1})]
    with Recorder(folder):
        assert len(told(folder)) == 1


def test_verify_looks_into_copies_elsewhere_and_names_those_that_it_cannot_reach(
    folder: Path, codes: list[str], tmp_path: Path
) -> None:
    stick, merged = tmp_path / "stick", tmp_path / "merged"
    carried = carry(folder, stick, keep=1)
    merge([folder], merged)
    for kind, place in (
        (CopyKind.BACKUP, carried.file),
        (CopyKind.MERGE, merged),
        (CopyKind.BACKUP, tmp_path / "unplugged" / "recollect-1.db"),
        (CopyKind.EXPORT, tmp_path),
    ):
        note_copy(folder, kind, place)
    assert look_through(folder) == ([], [])
    withdraw(folder, codes[0])
    assert [(flaw.check, flaw.what.partition(":")[0]) for flaw in verify(folder)] == [
        (Verification.ELSEWHERE, "it holds session 1 of people who withdrew")
    ] * 2
    unseen = look_through(folder).copies_not_looked_into
    assert [why.partition(";")[0] for _, why in unseen] == [
        "it is not there, or not plugged in",
        "a data set names no codes",
    ]
    told = CliRunner().invoke(recollect, ["verify", "--data", str(folder)])
    assert told.exit_code == 1
    assert "unplugged" in told.stderr
    withdraw(merged, codes[0])
    carried.file.unlink()
    assert found(folder) == []
