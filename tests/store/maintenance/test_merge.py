"""Folders of several kiosks become one: everything is there once, whatever the order, or nothing is made."""

from __future__ import annotations

import os
import shlex
import shutil
import sqlite3
from collections.abc import Callable
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from kiosk import StorageError, UserInputError
from kiosk.cli.main import recollect
from kiosk.experiment.condition import Condition
from kiosk.experiment.outcomes import NotRecordedReason, SessionKind
from kiosk.store import merge as merge_module
from kiosk.store.database import FILE
from kiosk.store.merge import merge
from kiosk.store.queries import open_repository
from kiosk.store.recorder import Provenance, Recorder
from kiosk.store.verify import verify
from kiosk.store.withdrawal import withdraw
from tests.store.visitors import BEGUN, COMPLETED, a_day, rows

TABLES = (
    *("allocation_list", "audit_event", "code_key", "event", "participant", "session", "source", "tombstone", "visit"),
    *("withdrawal_code", "withdrawn_code"),
)


@pytest.fixture
def milan(tmp_path: Path, provenance: Provenance) -> Path:
    """Return a day in Milan, after which a participant withdrew."""
    folder = tmp_path / "milan"
    people = a_day(folder, provenance, "MI", seed=1)
    withdraw(folder, people[0].code)
    return folder


@pytest.fixture
def girona(tmp_path: Path, provenance: Provenance) -> Path:
    """Return a day in Girona."""
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
    """All participants by number and code, with what is stored of them but the session's own number."""
    return rows(
        folder,
        """
        SELECT participant.site, participant.kind, number, hex(hash), started_at, seed, condition, allocation_slot,
            (SELECT group_concat(seq || type || payload || at_ms || wall_ms) FROM event WHERE session = id)
        FROM participant JOIN session ON id = session JOIN withdrawal_code USING (session) ORDER BY 1, 2, 3
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


def test_every_session_is_measured_as_it_was(milan: Path, girona: Path, out: Path) -> None:
    merge([milan, girona], out)
    told = {}
    for folder in (milan, girona, out):
        with open_repository(folder) as stored:
            told[folder] = {
                session.participant: (
                    (session.flips, session.pairs, session.hints, session.duration_ms),
                    session.status,
                    session.stage,
                    session.allocation_source,
                    session.participant,
                )
                for session in stored.sessions()
            }
    assert told[out] == told[milan] | told[girona]


def test_the_order_of_the_folders_does_not_matter(milan: Path, girona: Path, out: Path, tmp_path: Path) -> None:
    merge([milan, girona], out)
    merge([girona, milan], tmp_path / "other")
    assert contents(out) == contents(tmp_path / "other")


def test_folders_that_sqlite_cannot_attach_are_copied_alike(
    milan: Path, girona: Path, out: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    merge([milan, girona], out)
    monkeypatch.setattr(merge_module, "_MOST_ATTACHED", 1)
    merge([milan, girona], tmp_path / "other")
    assert contents(out) == contents(tmp_path / "other")


def test_a_session_keeps_its_list(milan: Path, girona: Path, out: Path) -> None:
    merge([girona, milan], out)
    mixed = """
        SELECT session.site, list.site FROM session JOIN allocation_list AS list ON allocation_list = list.id
        UNION ALL
        SELECT tombstone.site, list.site FROM tombstone JOIN allocation_list AS list ON allocation_list = list.id
    """
    assert sorted(rows(out, mixed)) == [("GI", "GI")] * 3 + [("MI", "MI")] * 3


def test_counts_are_those_of_all_together(milan: Path, girona: Path, out: Path) -> None:
    merge([milan, girona], out)
    with open_repository(out) as stored:
        counts = stored.counts(kind=SessionKind.STUDY)
    assert sum(cell.quota for cell in counts.cells.values()) == 16
    assert sum(cell.begun for cell in counts.cells.values()) == 6
    assert sum(cell.withdrawn for cell in counts.cells.values()) == 1
    assert counts.visits == {NotRecordedReason.DECLINED: 2, NotRecordedReason.UNDER_AGE: 2, NotRecordedReason.LEFT: 0}
    assert set(counts.cells) == {Condition.TOM, Condition.NOTOM}


def test_what_is_merged_is_left_as_it_was(milan: Path, girona: Path, out: Path) -> None:
    before = [(folder / FILE).read_bytes() for folder in (milan, girona)]
    merge([milan, girona], out)
    assert [(folder / FILE).read_bytes() for folder in (milan, girona)] == before


def test_a_kiosk_goes_on_with_the_merged_folder(milan: Path, girona: Path, out: Path, provenance: Provenance) -> None:
    merge([milan, girona], out)
    with Recorder(out, "MI") as recorder:
        assert recorder.recovered == ()
        person = recorder.begin(replace(provenance, kind=SessionKind.STUDY), BEGUN)
    assert (person.session, person.name) == (9, "MI-4")


def test_whoever_withdraws_is_found_in_the_merged_folder(milan: Path, girona: Path, out: Path) -> None:
    merge([milan, girona], out)
    ((session,),) = rows(out, "SELECT session FROM participant WHERE site = 'GI' AND number = 2 AND kind = 0")
    withdraw(out, session)
    assert len(rows(out, "SELECT 1 FROM tombstone")) == 2
    assert verify(out) == []


def test_more_than_two_are_merged_and_one_is_copied(
    milan: Path, girona: Path, out: Path, tmp_path: Path, provenance: Provenance
) -> None:
    a_day(tmp_path / "naples", provenance, "NAP", seed=3)
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
        recorder.begin(replace(provenance, seed=7, kind=SessionKind.STUDY), COMPLETED)
    assert merge([rehearsals, tmp_path / "people"], out) == 3
    with pytest.raises(UserInputError, match=r"participant MI-1 is in .*milan and in .*people"):
        merge([milan, tmp_path / "people"], tmp_path / "other")


def test_an_empty_folder_may_be_there_already(milan: Path, girona: Path, out: Path) -> None:
    out.mkdir()
    assert merge([milan, girona], out) == 7


# Refused


def test_a_participant_who_stands_in_two_folders_is_refused(milan: Path, out: Path, tmp_path: Path) -> None:
    shutil.copytree(milan, tmp_path / "copy")
    with pytest.raises(UserInputError, match=r"participant MI-\d is in .*milan and in .*copy; nothing was merged"):
        merge([milan, tmp_path / "copy"], out)
    assert not out.exists()


def test_a_participant_who_withdrew_in_one_of_them_is_refused_as_well(
    milan: Path, out: Path, tmp_path: Path, provenance: Provenance
) -> None:
    """Otherwise a copy from before the withdrawal would bring them back."""
    with Recorder(tmp_path / "before", "MI") as recorder:
        recorder.begin(replace(provenance, kind=SessionKind.STUDY, seed=999), COMPLETED)
    with pytest.raises(UserInputError, match=r"participant MI-1 is in"):
        merge([tmp_path / "before", milan], out)


def test_one_person_who_has_another_number_in_a_copy_is_told_by_the_code(
    out: Path, tmp_path: Path, provenance: Provenance
) -> None:
    for name in ("one", "two"):
        with Recorder(tmp_path / name) as recorder:
            recorder.begin(replace(provenance, kind=SessionKind.STUDY), COMPLETED)
    shutil.rmtree(tmp_path / "two")
    shutil.copytree(tmp_path / "one", tmp_path / "two")
    sites = [(tmp_path / "one", "ONE"), (tmp_path / "two", "TWO")]
    with pytest.raises(UserInputError, match=r"code is valid in .*one and in .*two; nothing was merged"):
        merge([tmp_path / "one", tmp_path / "two"], out, sites=sites)
    assert not out.exists()


def test_a_folder_that_is_not_empty_is_refused_and_left_alone(milan: Path, girona: Path, out: Path) -> None:
    out.mkdir()
    (out / "thesis.txt").write_text("years of work")
    with pytest.raises(UserInputError, match="is not an empty folder; nothing was merged"):
        merge([milan, girona], out)
    assert [(file.name, file.read_text()) for file in out.iterdir()] == [("thesis.txt", "years of work")]
    with pytest.raises(UserInputError, match="is not an empty folder"):
        merge([milan, girona], out / "thesis.txt")


def test_a_folder_that_is_named_twice_is_refused(milan: Path, out: Path) -> None:
    with pytest.raises(UserInputError, match="a data folder is named twice"):
        merge([milan, milan.parent / "." / "milan"], out)


def test_a_folder_without_data_is_refused(milan: Path, out: Path, tmp_path: Path) -> None:
    with pytest.raises(UserInputError, match="there is no database in"):
        merge([milan, tmp_path / "nowhere"], out)
    assert not out.exists()
    assert not (tmp_path / "nowhere").exists()


def test_a_folder_that_is_written_in_is_refused(milan: Path, girona: Path, out: Path) -> None:
    with Recorder(girona), pytest.raises(UserInputError, match=r"a kiosk is writing in .*girona: close it first"):
        merge([milan, girona], out)
    assert not out.exists()


WHERE_IT_IS_NOT_TO_BE: dict[str, Callable[[Path], Path]] = {
    "a source itself": lambda source: source,
    "inside a source": lambda source: source / "all",
    "deep inside a source": lambda source: source / "new" / "all",
    "by way of another folder": lambda source: source.parent / "elsewhere" / ".." / source.name / "all",
    "by a relative path": lambda source: Path(os.path.relpath(source / "all")),
    "by a link to the source": lambda source: link_to(source) / "all",
    "by a link into the source": lambda source: link_to(source / "all", made=True),
}


def link_to(folder: Path, *, made: bool = False) -> Path:
    """Return a link, beside all data folders, to a folder that is there or is made."""
    if made:
        folder.mkdir()
    link = folder.parents[folder.parts[::-1].index("girona")] / "link"
    link.symlink_to(folder)
    return link


@pytest.mark.parametrize("where", WHERE_IT_IS_NOT_TO_BE.values(), ids=WHERE_IT_IS_NOT_TO_BE)
def test_a_folder_within_what_is_merged_is_refused(
    milan: Path, girona: Path, where: Callable[[Path], Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(milan)
    out = where(girona)
    before = sorted(girona.rglob("*"))
    with pytest.raises(UserInputError, match=r"is, or lies in, the data folder .*girona, which is only read"):
        merge([milan, girona], out)
    assert sorted(girona.rglob("*")) == before
    assert not list(milan.parent.rglob("*.unfinished"))


def test_where_capitals_do_not_count_a_folder_within_what_is_merged_is_refused_by_any_capitals(
    milan: Path, girona: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Windows and macOS know by the folder itself whether two names are one."""

    def samefile(one: Path, other: Path) -> bool:
        return str(one).casefold() == str(other).casefold()

    monkeypatch.setattr(Path, "samefile", samefile)
    with pytest.raises(UserInputError, match="is, or lies in, the data folder"):
        merge([milan, girona], girona.with_name("Girona") / "all")
    with pytest.raises(UserInputError, match="a data folder is named twice"):
        merge([milan, girona, girona.with_name("GIRONA")], milan.parent / "all")


def test_a_folder_beside_what_is_merged_may_have_a_longer_name(milan: Path, girona: Path) -> None:
    assert merge([milan, girona], girona.with_name("girona-and-milan")) == 7


# Kiosks without a site


@pytest.fixture
def nameless(tmp_path: Path, provenance: Provenance) -> list[Path]:
    """Return a day at each of two kiosks without a site; at one of them a participant withdrew."""
    hall, library = tmp_path / "the hall", tmp_path / "the=library"
    a_day(hall, provenance, seed=3)
    participant, *_ = a_day(library, provenance, seed=4)
    withdraw(library, participant.code)
    return [hall, library]


def test_kiosks_without_a_site_get_one_in_the_merged_folder(nameless: list[Path], out: Path) -> None:
    before = [(folder / FILE).read_bytes() for folder in nameless]
    assert merge(nameless, out, sites=list(zip(nameless, ["HALL", "LIB"], strict=True))) == 7
    hall, library = map(people, nameless)
    assert people(out) == [("HALL", *row[1:]) for row in hall] + [("LIB", *row[1:]) for row in library]
    for table in ("session", "participant", "allocation_list", "tombstone"):
        assert {site for (site,) in rows(out, f"SELECT site FROM {table}")} <= {"HALL", "LIB"}  # noqa: S608
    assert verify(out) == []
    assert [(folder / FILE).read_bytes() for folder in nameless] == before


def test_the_refusal_names_a_command_that_merges_them(nameless: list[Path], out: Path) -> None:
    with pytest.raises(
        UserInputError, match=r"participant \d is in .*hall and in .*library; nothing was merged"
    ) as refusal:
        merge(nameless, out)
    program, *arguments = shlex.split(str(refusal.value).rpartition(": ")[2])
    assert program == "recollect"
    done = CliRunner().invoke(recollect, arguments, catch_exceptions=False)
    assert (done.exit_code, done.stdout) == (0, f"{out} holds 7 sessions of 2 folders.\n")
    assert rows(out, "SELECT DISTINCT site FROM participant ORDER BY 1") == [("KIOSK1",), ("KIOSK2",)]


def test_the_refusal_names_only_those_anew_who_clash(nameless: list[Path], girona: Path, out: Path) -> None:
    with pytest.raises(UserInputError, match=r"participant \S+ is in ") as refusal:
        merge([girona, *nameless], out)
    assert "girona=" not in str(refusal.value)
    done = CliRunner().invoke(recollect, shlex.split(str(refusal.value).rpartition(": ")[2])[1:])
    assert done.exit_code == 0
    assert rows(out, "SELECT DISTINCT site FROM participant ORDER BY 1") == [("GI",), ("KIOSK1",), ("KIOSK2",)]


def test_two_merged_folders_that_clash_cannot_be_named_anew(
    milan: Path, girona: Path, out: Path, tmp_path: Path, provenance: Provenance
) -> None:
    merge([milan, girona], tmp_path / "first")
    for seed, site in enumerate(("MI", "GI"), 5):
        a_day(tmp_path / site, provenance, site, seed=seed)
    merge([tmp_path / "MI", tmp_path / "GI"], tmp_path / "second")
    with pytest.raises(UserInputError, match="Kiosks whose data will be merged need a --site each"):
        merge([tmp_path / "first", tmp_path / "second"], out)


def test_a_copy_is_not_merged_under_another_site(nameless: list[Path], out: Path, tmp_path: Path) -> None:
    library = nameless[1]
    shutil.copytree(library, tmp_path / "copy")
    for sites in ([], [(library, "LIB"), (tmp_path / "copy", "COPY")]):
        with pytest.raises(UserInputError, match=r"Does one of them hold a copy of the other's data\?$"):
            merge([library, tmp_path / "copy"], out, sites=sites)


def test_a_copy_from_before_a_withdrawal_does_not_bring_anybody_back(
    out: Path, tmp_path: Path, provenance: Provenance
) -> None:
    kiosk, copy = tmp_path / "kiosk", tmp_path / "copy"
    with Recorder(kiosk) as recorder:
        person = recorder.begin(replace(provenance, kind=SessionKind.STUDY), COMPLETED)
    shutil.copytree(kiosk, copy)
    withdraw(kiosk, person.code)
    for sites in ([], [(copy, "COPY")]):
        with pytest.raises(UserInputError, match=r"participant .*1 withdrew in .*kiosk, but is still in .*copy"):
            merge([copy, kiosk], out, sites=sites)
    assert not out.exists()


@pytest.mark.parametrize(
    ("site", "sentence"),
    [
        ("elsewhere=ROME", r"elsewhere is not one of the folders to merge"),
        ("milan=", r"the name of the site is missing"),
        ("milan=rome", r"a site is named by .*, not 'rome'"),
    ],
)
def test_a_site_that_cannot_be_given_is_refused(milan: Path, out: Path, site: str, sentence: str) -> None:
    folder, _, name = site.partition("=")
    with pytest.raises(UserInputError, match=sentence):
        merge([milan], out, sites=[(milan.parent / folder, name)])
    assert not out.exists()


def test_a_folder_gets_one_site_and_one_with_several_gets_none(
    milan: Path, girona: Path, out: Path, tmp_path: Path
) -> None:
    with pytest.raises(UserInputError, match=r"--site names the folder .*milan twice"):
        merge([milan, girona], out, sites=[(milan, "ROME"), (milan, "PISA")])
    merge([milan, girona], tmp_path / "both")
    with pytest.raises(UserInputError, match=r"both holds the data of several sites \(GI, MI\)"):
        merge([tmp_path / "both"], out, sites=[(tmp_path / "both", "ROME")])


def test_a_site_without_a_folder_is_refused_at_the_command_line(milan: Path, out: Path) -> None:
    done = CliRunner().invoke(recollect, ["merge", str(milan), "--out", str(out), "--site", "ROME"])
    assert done.exit_code == 2
    assert "'ROME' must be a folder and its site, such as A=ROME" in done.output


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
        with pytest.raises(StorageError, match=r"out could not be written: database or disk is full"):
            merge([milan, girona], out)
    assert sorted(milan.parent.iterdir()) == there
    assert merge([milan, girona], out) == 7


def test_merging_sessions_of_two_studies_names_both(tmp_path: Path, provenance: Provenance, out: Path) -> None:
    for site, sha256 in (("MI", "a" * 64), ("GI", "b" * 64)):
        plan = replace(provenance.plan, study_sha256=sha256)
        a_day(tmp_path / site, replace(provenance, plan=plan), site, seed=ord(site[0]))
    said = CliRunner().invoke(recollect, ["merge", str(tmp_path / "MI"), str(tmp_path / "GI"), "--out", str(out)])
    assert said.exit_code == 0
    assert "caution: they are of studies that differ" in said.stdout
    title = provenance.plan.settings.title
    assert f"  {'a' * 12} {title!r}: 3 sessions in {tmp_path / 'MI'}\n" in said.stdout
    assert f"  {'b' * 12} {title!r}: 3 sessions in {tmp_path / 'GI'}\n" in said.stdout


def test_merging_sessions_of_one_study_says_nothing_of_studies(milan: Path, girona: Path, out: Path) -> None:
    said = CliRunner().invoke(recollect, ["merge", str(milan), str(girona), "--out", str(out)])
    assert said.exit_code == 0
    assert "studies" not in said.stdout


def test_what_verify_calls_wrong_is_not_merged(milan: Path, girona: Path, out: Path) -> None:
    with closing(sqlite3.connect(girona / FILE)) as connection, connection:
        (text,) = connection.execute("SELECT sql FROM sqlite_master WHERE name = 'session_is_never_updated'").fetchone()
        connection.execute("DROP TRIGGER session_is_never_updated")
        connection.execute("UPDATE session SET seed = seed + 1 WHERE id = 1")
        connection.execute(text)
    with pytest.raises(UserInputError, match="is not as it was written: session 1, event 1"):
        merge([milan, girona], out)
    assert not out.exists()
