"""A copy is whole, is checked, and blocks no one; however it fails, the older copies stay."""

from __future__ import annotations

import os
import signal
import sqlite3
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

from kiosk import StorageError, UserInputError
from kiosk.experiment import events as happened
from kiosk.experiment.events import Event
from kiosk.store import maintenance
from kiosk.store.database import FILE
from kiosk.store.maintenance import FOLDER, back_up, list_backups
from kiosk.store.queries import open_repository
from kiosk.store.recorder import Provenance, Recorder
from kiosk.store.tombstones import FILE as LIST
from tests.patience import PATIENCE_S, Program, limited
from tests.store.visitors import BEGUN, COMPLETED
from tests.store.writer import GONE


@pytest.fixture
def into(folder: Path) -> Path:
    """Where the copies go."""
    return folder / FOLDER


def events_in(copy: Path) -> list[int]:
    """Return the numbers of the events of a copy, which is whole."""
    with closing(sqlite3.connect(f"{copy.as_uri()}?mode=ro&immutable=1", uri=True)) as connection:
        assert connection.execute("PRAGMA integrity_check").fetchall() == [("ok",)]
        assert connection.execute("PRAGMA foreign_key_check").fetchall() == []
        return [seq for (seq,) in connection.execute("SELECT seq FROM event ORDER BY session, seq")]


def many(size: int) -> list[Event]:
    """Events that need a good deal of room."""
    return [happened.SpeechFailed(at_ms=number, utterance=number, why="x" * 1000) for number in range(size)]


def test_a_copy_is_the_database_as_it_was(folder: Path, into: Path, provenance: Provenance, tmp_path: Path) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, COMPLETED)
        recorder.begin(provenance, BEGUN)
    copy = back_up(folder, into)
    assert events_in(copy) == [1, 2, 3, 1]
    restored = tmp_path / "restored"
    restored.mkdir()
    copy.rename(restored / FILE)
    with open_repository(folder) as before, open_repository(restored) as after:
        assert after.sessions() == before.sessions()


def test_a_copy_is_one_file_for_its_owner_alone(folder: Path, into: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, COMPLETED)
        copy = back_up(folder, into)
    assert {file.name for file in into.iterdir()} == {copy.name, "backup.lock", LIST}
    assert copy.stat().st_mode & 0o077 == 0
    assert into.stat().st_mode & 0o077 == 0


def test_a_recorder_writes_on_between_two_steps_of_a_copy(folder: Path, into: Path, provenance: Provenance) -> None:
    """What it writes meanwhile is not in the copy, and does not make the copy start anew."""
    with Recorder(folder) as recorder:
        recorder.begin(provenance, [*BEGUN, *many(1000)])
        done: list[int] = []

        def write(pages: int, _of: int) -> None:
            done.append(pages)
            assert len(done) < 1000, "the copy begins anew with every write"
            recorder.append(many(3))

        copy = back_up(folder, into, tell=write)
    assert len(done) > 4
    assert done == sorted(set(done))
    assert events_in(copy) == list(range(1, 1002))
    with open_repository(folder) as stored:
        assert len(stored.events(1)) == 1001 + 3 * len(done)


def test_a_worker_thread_copies_while_the_recorder_writes(folder: Path, into: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder, ThreadPoolExecutor(1) as worker:
        recorder.begin(provenance, [*BEGUN, *many(300)])
        copying = worker.submit(lambda: [back_up(folder, into) for _ in range(3)])
        written = 301
        while not copying.done():
            recorder.append(many(2))
            written += 2
        copies = copying.result(PATIENCE_S)
    sizes = []
    for copy in copies:
        numbers = events_in(copy)
        assert numbers == list(range(1, len(numbers) + 1))
        assert len(numbers) % 2 == 1
        sizes.append(len(numbers))
    assert sizes == sorted(sizes)
    assert sizes[0] >= 301
    assert sizes[-1] <= written


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs a system that can fork")
def test_a_process_that_writes_is_copied_as_it_goes(folder: Path, into: Path, writer: Program) -> None:
    acknowledged, copies = [], []
    with limited(writer):
        writer.stdin.write(f"{folder}\n")
        writer.stdin.flush()
        process = int(writer.stdout.readline())
        for _ in range(4):
            acknowledged += [int(writer.stdout.readline()) for _ in range(40)]
            copies.append((acknowledged[-1], events_in(back_up(folder, into))))
        os.kill(process, signal.SIGKILL)
        acknowledged += [int(line) for line in iter(writer.stdout.readline, f"{GONE}\n")]
    for before, numbers in copies:
        assert numbers == list(range(1, len(numbers) + 1))
        assert before <= len(numbers) <= acknowledged[-1] + 2


def test_only_the_newest_copies_are_kept(folder: Path, into: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, BEGUN)
        copies = [back_up(folder, into, keep=3) for _ in range(5)]
    assert list_backups(into) == copies[-3:]
    assert back_up(folder, into, keep=1) == list_backups(into)[0]


def test_two_kiosks_that_share_a_folder_remove_only_their_own_copies(
    folder: Path, into: Path, provenance: Provenance, tmp_path: Path
) -> None:
    kept = []
    for data in (folder, tmp_path / "other booth"):
        with Recorder(data) as recorder:
            recorder.begin(provenance, BEGUN)
        kept += [back_up(data, into, keep=2) for _ in range(4)][-2:]
    damaged = into / "recollect-20200101T000000.000000Z.db"
    damaged.write_text("no database")
    kept[0].unlink()
    kept = [damaged, kept[1], *kept[2:], back_up(folder, into, keep=2)]
    assert list_backups(into) == kept


def test_the_copy_just_made_is_kept_whatever_the_clock_says(folder: Path, into: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, BEGUN)
    into.mkdir()
    for year in (2990, 2991):
        (into / f"recollect-{year}0101T000000.000000Z.db").touch()
    copy = back_up(folder, into, keep=1)
    assert copy in list_backups(into)


def test_other_files_beside_the_copies_are_left_alone(folder: Path, into: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, BEGUN)
    into.mkdir()
    (into / "notes.txt").write_text("ours")
    (into / FILE).write_text("somebody's")
    for _ in range(3):
        back_up(folder, into, keep=1)
    assert (into / "notes.txt").read_text() == "ours"
    assert (into / FILE).read_text() == "somebody's"


def test_what_a_copy_that_was_cut_off_left_is_cleared(folder: Path, into: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, BEGUN)
    into.mkdir()
    left = into / "recollect-20260101T000000.000000Z.db.unfinished"
    for name in (left, left.with_name(f"{left.name}-journal")):
        name.touch()
    copy = back_up(folder, into)
    assert {file.name for file in into.iterdir()} == {copy.name, "backup.lock", LIST}


# Refused, or failed


def test_where_there_is_nothing_to_copy_no_folder_is_made(folder: Path, into: Path) -> None:
    with pytest.raises(UserInputError, match="there is no database in"):
        back_up(folder, into)
    assert not folder.exists()


def test_at_least_one_copy_is_kept(folder: Path, into: Path) -> None:
    with pytest.raises(UserInputError, match="at least 1 copy must be kept, not 0"):
        back_up(folder, into, keep=0)


def test_a_place_that_cannot_be_used_is_refused_in_words(folder: Path, provenance: Provenance, tmp_path: Path) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, BEGUN)
    (tmp_path / "file").touch()
    for into in (tmp_path / "file", tmp_path / "file" / "below"):
        with pytest.raises(UserInputError, match=r"copies cannot be kept in .*: "):
            back_up(folder, into)


def test_two_copies_at_a_time_are_refused(folder: Path, into: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, [*BEGUN, *many(300)])
    refused: list[str] = []

    def another(_pages: int, _of: int) -> None:
        with pytest.raises(UserInputError) as refusal:
            back_up(folder, into)
        refused.append(str(refusal.value))

    back_up(folder, into, tell=another)
    assert set(refused) == {f"another copy is just being made in {into}"}
    assert len(list_backups(into)) == 1


def test_a_copy_that_the_disk_does_not_take_leaves_the_older_ones(
    folder: Path, into: Path, provenance: Provenance, monkeypatch: pytest.MonkeyPatch
) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, [*BEGUN, *many(300)])
    copy = back_up(folder, into, keep=1)

    def full(_descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patched:
        patched.setattr(os, "fsync", full)
        with pytest.raises(StorageError, match=r"the copy in .* could not be written: disk full"):
            back_up(folder, into, keep=1)
    assert {file.name for file in into.iterdir()} == {copy.name, "backup.lock", LIST}
    assert len(events_in(copy)) == 301


def test_a_copy_that_is_not_whole_is_not_kept(
    folder: Path, into: Path, provenance: Provenance, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A database that is damaged, but can be opened, is copied with its damage: that is noticed."""
    with Recorder(folder) as recorder:
        recorder.begin(provenance, [*BEGUN, *many(300)])
    older = back_up(folder, into)
    damaged = bytearray((folder / FILE).read_bytes())
    damaged[-4096:] = b"\xff" * 4096
    (folder / FILE).write_bytes(damaged)
    with pytest.raises(StorageError, match=r"the copy of .* is not whole: |could not be written: "):
        back_up(folder, into)
    assert list_backups(into) == [older]
    monkeypatch.undo()


def test_steps_are_small(folder: Path, into: Path, provenance: Provenance) -> None:
    steps: list[Any] = []
    with Recorder(folder) as recorder:
        recorder.begin(provenance, [*BEGUN, *many(1000)])
        back_up(folder, into, tell=lambda done, of: steps.append((done, of)))
    pages = [done for done, _ in steps]
    assert max(after - before for before, after in pairwise(pages)) <= maintenance.STEP_PAGES
    assert steps[-1][0] == steps[-1][1]
