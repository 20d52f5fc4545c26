"""A withdrawal that is cut off, wherever that is, is known to be unfinished and is finished afterwards."""

from __future__ import annotations

import json
import os
import shutil
import sqlite3
import struct
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import closing
from dataclasses import replace
from itertools import count
from pathlib import Path

import pytest

from kiosk import StorageError, UserInputError
from kiosk.experiment.outcomes import SessionKind
from kiosk.preflight import Severity
from kiosk.store import withdrawal as withdraw_module
from kiosk.store.chain import FILE as HEADS
from kiosk.store.checks import database_check
from kiosk.store.codes import session_with_code
from kiosk.store.database import FILE, open_for_reading, open_for_writing
from kiosk.store.drives import carry
from kiosk.store.maintenance import FOLDER, back_up, list_backups
from kiosk.store.merge import merge
from kiosk.store.recorder import Provenance, Recorder
from kiosk.store.tombstones import FILE as TOMBSTONES
from kiosk.store.tombstones import add_tombstones, read_tombstones
from kiosk.store.verify import Verification, verify
from kiosk.store.withdrawal import check_none_is_back, find_withdrawal, finish_at_rest, withdraw
from tests.patience import limited, serving
from tests.samples import plan
from tests.store.visitors import COMPLETED, rows, saying

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="it forks, and looks at modes of files")

ANSWER = "a quite unmistakable answer"
OTHERS = "the answer of another person"
ROOT = Path(__file__).parents[3]
PAGE = 4096
LEAF = 13
KILLED, CUT_AT_A_PAGE = -9, -25

Cut = Callable[..., int]


@pytest.fixture(scope="module")
def pristine(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str]:
    """Return a folder as a killed kiosk leaves it, and a visitor's code.

    It has copies, one of them unfinished.
    """
    place = tmp_path_factory.mktemp("pristine")
    folder, left = place / "data", place / "left"
    person = Provenance(plan(), 4, "avatar", "abc123", kind=SessionKind.STUDY)
    with Recorder(folder) as recorder:
        recorder.begin(person, saying(OTHERS))
        code = recorder.begin(replace(person, seed=5), saying(ANSWER)[:-1]).code
        recorder.append(saying(ANSWER * 500)[2:])
        back_up(folder, folder / FOLDER)
        copy = back_up(folder, folder / FOLDER)
        shutil.copy(copy, f"{copy}.unfinished")
        recorder.begin(replace(person, seed=6), saying(OTHERS))
        shutil.copytree(folder, left)
    assert (left / f"{FILE}-wal").stat().st_size > 0
    return left, code


@pytest.fixture
def data(pristine: tuple[Path, str], tmp_path: Path) -> Path:
    """Return a copy of that folder."""
    return Path(shutil.copytree(pristine[0], tmp_path / "data"))


@pytest.fixture
def code(pristine: tuple[Path, str]) -> str:
    """Return the code of the one who withdraws."""
    return pristine[1]


@pytest.fixture(scope="module")
def cut() -> Iterator[Cut]:
    """Withdraw up to a step or a page; returns the exit code, or the signal that ended it."""
    with serving(
        [sys.executable, "-m", "tests.store.maintenance.cutting"],
        cwd=ROOT,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as program:

        def order(folder: Path, code: str, *, step: int | None = None, page: int | None = None) -> int:
            with limited(program):
                asked = {"folder": str(folder), "code": code, "step": step, "page": page}
                program.stdin.write(json.dumps(asked) + "\n")
                program.stdin.flush()
                return int(program.stdout.readline())

        yield order


def holding(folder: Path, *what: str) -> list[str]:
    """Every file of a folder, and of those within, in which any of these words stand."""
    files = [file for file in folder.rglob("*") if file.is_file()]
    return sorted(file.name for file in files if any(words.encode() in file.read_bytes() for words in what))


def unfinished(folder: Path) -> bool:
    """Whether ``verify`` says that a withdrawal is not finished."""
    return Verification.FINISHED in {flaw.check for flaw in verify(folder)}


def is_there(folder: Path, code: str) -> bool:
    """Whether the participant is."""
    with closing(open_for_reading(folder)) as connection:
        return session_with_code(connection, code) is not None


def check_finished(folder: Path, code: str) -> None:
    """Hold that nothing is left of the participant, and everything of the others."""
    assert verify(folder) == []
    assert len(read_tombstones(folder)) == len(read_tombstones(folder / FOLDER)) == 1
    assert holding(folder, ANSWER, code) == []
    assert [path.name for path in folder.rglob("*.unfinished*")] == []
    assert rows(folder, "SELECT session FROM tombstone") == [(2,)]
    assert rows(folder, "SELECT count(*) FROM unfinished_withdrawal") == [(0,)]
    (copy,) = list_backups(folder / FOLDER)
    with closing(sqlite3.connect(copy)) as connection:
        assert connection.execute("SELECT session FROM tombstone").fetchall() == [(2,)]
        assert connection.execute("SELECT count(*) FROM unfinished_withdrawal").fetchall() == [(0,)]
    assert set(holding(folder, OTHERS)) == {FILE, copy.name}
    with pytest.raises(UserInputError, match="has been withdrawn from"):
        find_withdrawal(folder, code)


def go_on(folder: Path, code: str, number: int) -> None:
    """Finish it: by the next start of the kiosk or, every other time, by the same command."""
    if number % 2 or not unfinished(folder):
        assert withdraw(folder, code).session == 2
    else:
        Recorder(folder).__exit__(None, None, None)


def check_cut_off(folder: Path, code: str, number: int) -> bool:
    """Hold a folder after a cut to what may be, finish it, and say whether it was found unfinished."""
    found = unfinished(folder)
    if is_there(folder, code):
        assert {flaw.check for flaw in verify(folder)} <= {Verification.FINISHED, Verification.COPIES}
        assert find_withdrawal(folder, code).events == 5
    elif not found:
        assert holding(folder, ANSWER, code) == []
        check_finished(folder, code)
        return False
    go_on(folder, code, number)
    check_finished(folder, code)
    return found


def test_a_withdrawal_is_finished_wherever_it_was_cut_off(pristine: tuple[Path, str], tmp_path: Path, cut: Cut) -> None:
    found, folder = 0, pristine[0]
    # Neighbours are much alike, and each takes a tenth of a second.
    for step in count(1, 5):
        folder = Path(shutil.copytree(pristine[0], tmp_path / str(step)))
        if cut(folder, pristine[1], step=step) != KILLED:
            break
        found += check_cut_off(folder, pristine[1], step // 5)
        shutil.rmtree(folder)
    check_finished(folder, pristine[1])
    assert found > 6
    assert step > 100


def test_a_withdrawal_is_finished_that_was_cut_off_in_the_middle_of_a_checkpoint(
    pristine: tuple[Path, str], tmp_path: Path, cut: Cut
) -> None:
    found = 0
    for page in range(2, (pristine[0] / FILE).stat().st_size // PAGE, 3):
        folder = Path(shutil.copytree(pristine[0], tmp_path / str(page)))
        if cut(folder, pristine[1], page=page) == CUT_AT_A_PAGE:
            found += check_cut_off(folder, pristine[1], page // 3)
    assert found > 2


def test_a_withdrawal_that_is_cut_off_twice_is_finished(data: Path, code: str, cut: Cut) -> None:
    step = next(step for step in count(1, 5) if cut(data, code, step=step) == KILLED and not is_there(data, code))
    assert cut(data, code, step=step) == KILLED
    assert unfinished(data)
    assert withdraw(data, code).cut_off
    check_finished(data, code)


@pytest.fixture
def cut_off(data: Path, code: str, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a folder whose copies could not be replaced."""

    def full(*_: object, **__: object) -> Path:
        raise StorageError("disk full")

    with monkeypatch.context() as patched:
        patched.setattr(withdraw_module, "back_up", full)
        with pytest.raises(StorageError, match="give the same command again, or open the kiosk, to finish it"):
            withdraw(data, code)
    return data


def test_an_unfinished_withdrawal_is_told_by_verify_and_by_check(cut_off: Path) -> None:
    flaw, *copies = verify(cut_off)
    assert (flaw.check, flaw.where) == (Verification.FINISHED, "session 2")
    assert [copy.check for copy in copies] == [Verification.COPIES] * 2
    (found,) = database_check(cut_off, busy=False)
    assert (found.severity, "a withdrawal was cut off" in found.message) == (Severity.WARNING, True)


def leave_between_rows(folder: Path, words: str) -> None:
    """Write words where no row stands, as SQLite leaves what stood on a page before its rows were moved."""
    with closing(sqlite3.connect(folder / FILE)) as connection:
        connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    content = bytearray((folder / FILE).read_bytes())
    for page in range(PAGE, len(content), PAGE):
        kind, _, rows_there, end = struct.unpack_from(">BHHH", content, page)
        begin = 8 + 2 * rows_there
        if kind == LEAF and end - begin > len(words):
            content[page + begin : page + begin + len(words)] = words.encode()
    (folder / FILE).write_bytes(content)
    assert holding(folder, words)[-1] == FILE


def test_a_withdrawal_clears_what_stands_between_the_rows(data: Path, code: str) -> None:
    leave_between_rows(data, ANSWER)
    withdraw(data, code)
    check_finished(data, code)


def test_a_start_that_finishes_a_withdrawal_clears_what_stands_between_the_rows(cut_off: Path, code: str) -> None:
    leave_between_rows(cut_off, ANSWER)
    Recorder(cut_off).__exit__(None, None, None)
    check_finished(cut_off, code)


def test_only_the_same_code_finishes_a_withdrawal_by_name(cut_off: Path, code: str) -> None:
    with pytest.raises(UserInputError, match=r"no participant in .* has this code"):
        withdraw(cut_off, "7KQ2M-XR4T4")
    gone = withdraw(cut_off, code.lower())
    assert (gone.session, gone.participant, gone.cut_off, gone.started_at) == (2, "2", True, None)
    check_finished(cut_off, code)


def test_a_withdrawal_that_cannot_be_finished_keeps_no_kiosk_shut(
    cut_off: Path, code: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object, **__: object) -> Path:
        raise StorageError("disk full")

    with monkeypatch.context() as patched:
        patched.setattr(withdraw_module, "back_up", full)
        with Recorder(cut_off) as recorder:
            recorder.begin(Provenance(plan(), 9, "avatar", "abc123", kind=SessionKind.SIMULATED), COMPLETED)
    assert unfinished(cut_off)
    Recorder(cut_off).__exit__(None, None, None)
    check_finished(cut_off, code)


def test_a_reader_does_not_let_a_withdrawal_pass_for_finished(
    cut_off: Path, code: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(withdraw_module, "READER_WAIT_MS", 1)
    with closing(open_for_reading(cut_off)) as reader:
        reader.execute("BEGIN")
        reader.execute("SELECT count(*) FROM event").fetchone()
        Recorder(cut_off).__exit__(None, None, None)
        assert unfinished(cut_off)
    Recorder(cut_off).__exit__(None, None, None)
    check_finished(cut_off, code)


def test_two_withdrawals_that_were_cut_off_are_finished_together(cut_off: Path, code: str) -> None:
    withdraw(cut_off, 3)
    assert verify(cut_off) == []
    assert holding(cut_off, ANSWER, code) == []


# Copies that are put back


def put_back(data: Path, code: str) -> Path:
    """Return the folder after a withdrawal and the return of an older database in its place."""
    older = (data.parent / "older.db", data.parent / "older.heads")
    with closing(open_for_writing(data)) as connection:
        connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    shutil.copy(data / FILE, older[0])
    withdraw(data, code)
    shutil.copy(older[0], data / FILE)
    shutil.copy(older[0], data / FOLDER / "recollect-20200101T000000.000000Z.db")
    return data


def test_an_older_copy_that_is_put_back_is_told_and_not_exported(data: Path, code: str) -> None:
    put_back(data, code)
    told = {(flaw.check, flaw.where) for flaw in verify(data)}
    copy = (Verification.COPIES, "recollect-20200101T000000.000000Z.db")
    assert told == {(Verification.FINISHED, "session 2"), copy}
    with pytest.raises(UserInputError, match=r"still holds people who withdrew \(session 2\)"):
        check_none_is_back(data)


@pytest.mark.parametrize("by", ["the kiosk", "verify", "withdraw"])
def test_an_older_copy_that_is_put_back_brings_nobody_back(data: Path, code: str, by: str) -> None:
    put_back(data, code)
    match by:
        case "the kiosk":
            Recorder(data).__exit__(None, None, None)
        case "verify":
            assert finish_at_rest(data) == 1
            assert finish_at_rest(data) == 0
        case _:
            withdraw(data, code)
    check_finished(data, code)
    check_none_is_back(data)


def test_a_merge_refuses_a_folder_that_somebody_is_back_in(data: Path, code: str, tmp_path: Path) -> None:
    put_back(data, code)
    with pytest.raises(UserInputError, match=r"participant 2 withdrew in .*data, but is still in .*data"):
        merge([data], tmp_path / "all")


def test_the_list_goes_with_merged_folders_and_carried_copies(data: Path, code: str, tmp_path: Path) -> None:
    withdraw(data, code)
    merge([data], tmp_path / "all")
    carry(data, tmp_path / "stick", 1)
    back_up(data, tmp_path / "elsewhere")
    (gone,) = read_tombstones(data)
    for place in ("all", "stick", "elsewhere"):
        assert read_tombstones(tmp_path / place) == {gone}
        assert (tmp_path / place / TOMBSTONES).stat().st_mode & 0o777 == 0o600


def test_a_line_that_is_damaged_hides_no_other(tmp_path: Path) -> None:
    one, other = b"1" * 32, b"2" * 32
    add_tombstones(tmp_path, [one])
    with (tmp_path / TOMBSTONES).open("a", encoding="ascii") as file:
        file.write("31" * 32 + " 00000000\n" + "31" * 20)
    add_tombstones(tmp_path, [other])
    assert read_tombstones(tmp_path) == {one, other}


# Modes


def modes(folder: Path) -> dict[str, int]:
    """Return the modes of all files that hold data."""
    return {path.name: path.stat().st_mode & 0o777 for path in folder.rglob("recollect*.db*")}


def test_only_the_owner_may_read_the_database_its_logs_and_its_copies(data: Path, code: str) -> None:
    for path in data.rglob("recollect*.db*"):
        path.chmod(0o644)
    with Recorder(data) as recorder:
        recorder.begin(Provenance(plan(), 9, "avatar", "abc123", kind=SessionKind.SIMULATED), COMPLETED)
        assert {name: mode for name, mode in modes(data).items() if name.startswith(f"{FILE}")} == dict.fromkeys(
            (FILE, f"{FILE}-wal", f"{FILE}-shm"), 0o600
        )
    withdraw(data, code)
    back_up(data, data / FOLDER)
    assert set(modes(data).values()) == {0o600}
    assert len(modes(data)) == 3


@pytest.mark.parametrize("mask", [0, 0o077, 0o377])
def test_a_new_database_is_the_owners_whatever_the_umask(tmp_path: Path, mask: int) -> None:
    folder, before = tmp_path / "new", os.umask(0o077)
    try:
        folder.mkdir()
        os.umask(mask)
        with Recorder(folder) as recorder:
            recorder.begin(Provenance(plan(), 9, "avatar", "abc123", kind=SessionKind.SIMULATED), COMPLETED)
            assert set(modes(folder).values()) == {0o600}
            assert (folder / HEADS).stat().st_mode & 0o777 == 0o600
    finally:
        os.umask(before)


def test_a_folder_that_others_can_read_is_mended_at_the_next_start(data: Path) -> None:
    (data / "recollect.log").write_text("a line\n", encoding="utf-8")
    link = data / "recollect-elsewhere"
    outside = data.parent / "outside"
    outside.write_text("", encoding="utf-8")
    link.symlink_to(outside)
    files = [file for file in data.rglob("recollect*") if file.is_file() and not file.is_symlink()]
    for file in (*files, outside):
        file.chmod(0o664)
    Recorder(data).__exit__(None, None, None)
    assert {file.name for file in files if file.exists() and file.stat().st_mode & 0o777 != 0o600} == set()
    assert outside.stat().st_mode & 0o777 == 0o664
