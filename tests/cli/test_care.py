"""The commands that look after what is stored say what they did, ask before they delete, and refuse in one sentence."""

from __future__ import annotations

import json
import shutil
import sqlite3
from contextlib import closing
from datetime import datetime
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from kiosk import StorageError, UserInputError
from kiosk.cli import sessions as listing
from kiosk.cli.main import recollect
from kiosk.experiment.outcomes import SessionKind
from kiosk.store import withdrawal as withdrawing
from kiosk.store.copies import FILE as COPIES
from kiosk.store.database import FILE
from kiosk.store.maintenance import FOLDER, list_backups
from kiosk.store.recorder import Provenance, Recorder
from tests.samples import plan
from tests.store.visitors import BEGUN, a_day, new_code, rows

PEOPLE = Provenance(plan(), 1, "avatar", "abc123", kind=SessionKind.STUDY)


def run(*words: object, answer: str = "") -> Result:
    """Call the command line."""
    return CliRunner().invoke(recollect, [*map(str, words)], input=answer)


def said(*words: object) -> Any:
    """Return what a command that went well says to a program."""
    result = run(*words, "--json")
    assert result.exit_code == 0, result.output
    return json.loads(result.stdout)


@pytest.fixture
def day(tmp_path: Path) -> Path:
    """Return a day at a booth."""
    a_day(tmp_path / "day", PEOPLE, "MI")
    return tmp_path / "day"


def code_of(folder: Path, number: int) -> str:
    """Return a code of a participant by number."""
    ((session,),) = rows(folder, f"SELECT session FROM participant WHERE number = {number} AND kind = 0")  # noqa: S608
    return new_code(folder, session)


# sessions


def test_the_list_says_who_it_was_where_it_ended_and_how_it_was_allocated(day: Path) -> None:
    listed = run("sessions", "--data", day).output
    header, first, *_ = [line.split() for line in listed.splitlines()]
    assert header[:2] == ["session", "participant"]
    assert {"stage", "allocation_source"} <= set(header)
    assert first[:2] == ["1", "MI-1"]
    assert "4 sessions: 1 abandoned, 3 completed; a completed one lasts 0:00 (median)." in listed
    heads, *people = [line.split() for line in listed.splitlines()[-3:]]
    # "Withdrawn" is what a session is called that its visitor stopped; its data may be there still.
    assert heads[-1] == "deleted"
    assert people == [["tom", "4", "1", "0", "3", "0"], ["notom", "4", "1", "1", "3", "0"]]
    assert "list" in first
    (one, *_) = said("sessions", "--data", day)
    assert (one["participant"], one["allocation_source"], one["stage"]) == ("MI-1", "list", None)


def test_the_list_comes_in_pages_and_only_of_what_is_asked_for(day: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(listing, "PER_PAGE", 3)

    def numbers(*words: object) -> list[str]:
        lines = run("sessions", "--data", day, *words).output.splitlines()
        return [line.split()[0] for line in lines[1 : lines.index("")]]

    assert numbers() == ["2", "3", "4"]
    assert numbers("--page", 2) == ["1"]
    assert numbers("--all") == ["1", "2", "3", "4"]
    assert numbers("--visitor", "simulated") == ["3"]
    assert numbers("--status", "abandoned") == ["2"]
    assert numbers("--until", "2001-01-01") == []
    assert "Shown: 1 to 1 of 4." in run("sessions", "--data", day, "--page", 2).output
    assert [row["session"] for row in said("sessions", "--data", day)] == [1, 2, 3, 4]
    assert [row["session"] for row in said("sessions", "--data", day, "--page", 2)] == [1]
    assert run("sessions", "--data", day, "--page", 2, "--all").exit_code == 2
    refusal = run("sessions", "--data", day, "--condition", "tomm").exception
    assert str(refusal) == "no session is in the condition 'tomm'; there are notom, tom"


def test_times_are_those_of_the_machine(day: Path) -> None:
    (first, *_) = said("sessions", "--data", day)
    began = datetime.fromisoformat(first["started_at"])
    assert datetime.fromisoformat(first["started_local"]) == began.replace(microsecond=0)
    assert f"{began.astimezone():%Y-%m-%d %H:%M}" in run("sessions", "--data", day).output


# backup


def test_a_backup_says_where_it_is(day: Path, tmp_path: Path) -> None:
    told = said("backup", "--data", day)
    assert [str(copy) for copy in list_backups(day / FOLDER)] == [told["backup"]]
    assert told["bytes"] == Path(told["backup"]).stat().st_size
    told = said("backup", "--data", day, "--to", tmp_path / "stick", "--keep", 2)
    assert Path(told["backup"]).parent == tmp_path / "stick"


def test_a_backup_is_made_while_a_kiosk_is_writing(day: Path) -> None:
    with Recorder(day) as recorder:
        recorder.begin(PEOPLE, BEGUN)
        assert "one of 1 that are kept there" in run("backup", "--data", day).output


def test_only_as_many_backups_are_kept_as_are_asked_for(day: Path) -> None:
    assert [said("backup", "--data", day, "--keep", 2)["kept"] for _ in range(4)] == [1, 2, 2, 2]


# verify


def test_what_is_sound_ends_with_0(day: Path) -> None:
    result = run("verify", "--data", day)
    assert result.exit_code == 0
    assert "every event can be read" in result.output
    assert said("verify", "--data", day) == {"data": str(day), "sound": True, "results": []}


def test_what_is_wrong_is_told_and_ends_with_1(day: Path) -> None:
    with closing(sqlite3.connect(day / FILE)) as connection, connection:
        connection.execute("DROP TRIGGER event_is_never_updated")
        connection.execute("UPDATE event SET at_ms = -5 WHERE seq = 1 AND session = 1")
    result = run("verify", "--data", day, "--json")
    assert result.exit_code == 1
    told = json.loads(result.stdout)
    assert not told["sound"]
    assert [result["check"] for result in told["results"]] == ["schema", "chain", "time"]
    result = run("verify", "--data", day)
    assert result.exit_code == 1
    assert "is at -5 ms" in result.output


# withdraw


def test_a_withdrawal_says_what_goes_and_asks(day: Path) -> None:
    code = code_of(day, 1)
    result = run("withdraw", code, "--data", day, answer="n\n")
    assert result.exit_code == 1
    assert "Participant MI-1, session 1, begun " in result.output
    assert "4 events will be deleted for ever" in result.output
    assert rows(day, "SELECT * FROM tombstone") == []
    result = run("withdraw", code, "--data", day, answer="y\n")
    assert result.exit_code == 0
    assert "All of participant MI-1 is deleted." in result.output
    assert len(rows(day, "SELECT * FROM tombstone")) == 1


def test_with_yes_nothing_is_asked(day: Path) -> None:
    assert said("withdraw", code_of(day, 1), "--data", day, "--yes")["participant"] == "MI-1"


def test_while_a_kiosk_is_writing_it_is_refused_before_anything_is_asked(day: Path) -> None:
    with Recorder(day):
        result = run("withdraw", code_of(day, 1), "--data", day)
    assert isinstance(result.exception, UserInputError)
    assert "a kiosk is writing in" in str(result.exception)
    assert result.output == ""


def test_what_the_disk_did_not_do_is_said_in_one_sentence(day: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def failing(*_: object) -> None:
        raise StorageError("nothing was withdrawn: the disk is full")

    monkeypatch.setattr(withdrawing, "withdraw", failing)
    result = run("withdraw", code_of(day, 1), "--data", day, "--yes")
    assert result.exit_code == 1
    assert result.output == "Error: nothing was withdrawn: the disk is full\n"


def test_the_same_command_finishes_a_withdrawal_that_was_cut_off(day: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    code = code_of(day, 1)
    assert run("backup", "--data", day).exit_code == 0

    def failing(*_: object, **__: object) -> None:
        raise StorageError("disk full")

    with monkeypatch.context() as patched:
        patched.setattr(withdrawing, "back_up", failing)
        assert run("withdraw", code, "--data", day, "--yes").exit_code == 1
        result = run("verify", "--data", day)
        assert result.exit_code == 1
        assert "recollect withdraw" in " ".join(result.output.split())
        assert "could not be deleted: the participant was withdrawn, but" in result.stderr
    result = run("withdraw", code, "--data", day)
    assert result.output == "The withdrawal of participant MI-1, which had been cut off, is finished.\n"
    assert run("verify", "--data", day).exit_code == 0


def test_verify_finishes_what_was_cut_off_and_export_refuses_who_is_back(day: Path, tmp_path: Path) -> None:
    before = (day / FILE).read_bytes()
    assert run("withdraw", "--session", 1, "--data", day, "--yes").exit_code == 0
    (day / FILE).write_bytes(before)
    refused = run("export", "--data", day, "--out", tmp_path / "out").exception
    assert "still holds people who withdrew (session 1)" in str(refused)
    result = run("verify", "--data", day)
    assert "session 1: was withdrawn, and is still there" in result.stderr
    assert result.exit_code == 0
    assert rows(day, "SELECT session FROM tombstone") == [(1,)]
    assert run("export", "--data", day, "--out", tmp_path / "out").exit_code == 0


def test_a_withdrawal_names_the_copies_that_are_elsewhere(day: Path, tmp_path: Path) -> None:
    stick, whole, out = tmp_path / "stick", tmp_path / "all", tmp_path / "out"
    copy = said("backup", "--data", day, "--to", stick)["backup"]
    for words in (("merge", day, "--out", whole), ("export", "--data", day, "--out", out)):
        assert run(*words).exit_code == 0
    shutil.rmtree(out)
    told = said("withdraw", "--session", 1, "--data", day, "--yes")["copies_elsewhere"]
    assert [(each["kind"], each["place"]) for each in told] == [("backup", copy), ("merged folder", str(whole))]
    assert str(whole) in run("withdraw", "--session", 2, "--data", day, "--yes").stderr
    assert (day / COPIES).stat().st_mode & 0o777 == 0o600


def test_a_withdrawal_from_a_merged_folder_names_the_folder_that_the_person_came_from(
    day: Path, tmp_path: Path
) -> None:
    other, whole = tmp_path / "other", tmp_path / "all"
    a_day(other, PEOPLE, "GI", seed=2)
    assert run("merge", day, other, "--out", whole).exit_code == 0
    ((session, number),) = rows(
        whole,
        "SELECT session, number FROM participant JOIN session ON id = session"
        " WHERE session.site = 'GI' AND participant.kind = 0 LIMIT 1",
    )
    told = run("withdraw", "--session", session, "--data", whole, "--yes")
    assert told.exit_code == 0
    assert str(day) not in told.stderr
    # The session has another number there.
    ((there,),) = rows(other, f"SELECT session FROM participant WHERE number = {number} AND kind = 0")  # noqa: S608
    assert f"source folder: {other}: recollect withdraw --session {there} --data {other}" in told.stderr
    assert f"the source folder {other}" in said_wrong(whole)
    assert run("withdraw", "--session", there, "--data", other, "--yes").exit_code == 0
    assert run("verify", "--data", whole).exit_code == 0


def said_wrong(folder: Path) -> list[str]:
    """Return where verify finds something."""
    return [found["where"] for found in json.loads(run("verify", "--data", folder, "--json").stdout)["results"]]


def test_a_source_folder_that_cannot_be_looked_into_is_named_with_the_code_to_give(day: Path, tmp_path: Path) -> None:
    whole = tmp_path / "all"
    assert run("merge", day, "--out", whole).exit_code == 0
    (day / FILE).write_bytes(b"torn")
    told = run("withdraw", "--session", 1, "--data", whole, "--yes").stderr
    assert f"source folder: {day}: recollect withdraw CODE --data {day}" in told


def test_a_copy_from_before_the_visit_is_not_named(day: Path, tmp_path: Path) -> None:
    copy = said("backup", "--data", day, "--to", tmp_path / "stick")["backup"]
    with Recorder(day) as recorder:
        begun = recorder.begin(PEOPLE, BEGUN)
    told = said("withdraw", "--session", begun.session, "--data", day, "--yes")["copies_elsewhere"]
    assert told == []
    assert said("withdraw", "--session", 1, "--data", day, "--yes")["copies_elsewhere"][0]["place"] == copy


# merge


def test_folders_are_merged(day: Path, tmp_path: Path) -> None:
    a_day(tmp_path / "other", PEOPLE, "GI", seed=2)
    told = said("merge", day, tmp_path / "other", "--out", tmp_path / "all")
    assert told.pop("studies")[0]["sessions"] == 3
    assert told == {"out": str(tmp_path / "all"), "folders": 2, "sessions": 8}
    assert len(said("sessions", "--data", tmp_path / "all")) == 8


def test_what_clashes_is_refused(day: Path, tmp_path: Path) -> None:
    a_day(tmp_path / "other", PEOPLE, "MI", seed=2)
    result = run("merge", day, tmp_path / "other", "--out", tmp_path / "all")
    assert isinstance(result.exception, UserInputError)
    assert "participant MI-1 is in" in str(result.exception)
