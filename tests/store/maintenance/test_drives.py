"""A copy on a stick is whole, is read back, is encrypted where asked, and has its name only when all that is so."""

from __future__ import annotations

import errno
import hashlib
import os
import sqlite3
from collections import namedtuple
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest

from kiosk import StorageError, UserInputError
from kiosk.store import drives
from kiosk.store.database import FILE, open_for_reading
from kiosk.store.drives import carried, carry, destination, recipients
from kiosk.store.recorder import Provenance, Recorder
from kiosk.store.tombstones import FILE as LIST
from tests.store.visitors import COMPLETED

Partition = namedtuple("Partition", "mountpoint opts")


@pytest.fixture
def stick(tmp_path: Path) -> Path:
    """Where a stick is mounted."""
    place = tmp_path / "media" / "LAB"
    place.mkdir(parents=True)
    return place


@pytest.fixture
def stored(folder: Path, provenance: Provenance) -> Path:
    """Return a data folder with a session."""
    with Recorder(folder) as recorder:
        recorder.begin(provenance, COMPLETED)
    return folder


def plug_in(monkeypatch: pytest.MonkeyPatch, *mounts: Path, opts: str = "rw,removable") -> None:
    """Have these mounted, and a disk that cannot be taken out."""
    partitions = [Partition(str(mount), opts) for mount in mounts]
    monkeypatch.setattr("psutil.disk_partitions", lambda: [Partition("/", "rw"), *partitions])


def events_in(file: Path) -> int:
    """Count the events of a copy that stands alone, as another program opens it."""
    with closing(sqlite3.connect(f"{file.as_uri()}?mode=ro", uri=True)) as connection:
        assert connection.execute("PRAGMA integrity_check").fetchone() == ("ok",)
        return int(connection.execute("SELECT count(*) FROM event").fetchone()[0])


def test_a_copy_is_the_database_while_a_kiosk_writes_and_stands_alone(
    folder: Path, stick: Path, provenance: Provenance
) -> None:
    with Recorder(folder) as recorder:
        recorder.begin(provenance, COMPLETED)
        copy = carry(folder, stick, keep=3)
    assert events_in(copy.file) == len(COMPLETED)
    assert copy.sha256 == hashlib.sha256(copy.file.read_bytes()).hexdigest()
    assert copy.bytes == copy.file.stat().st_size
    assert {file.name for file in stick.iterdir() if file.suffix != ".lock"} == {copy.file.name, LIST}
    if os.name == "posix":
        assert copy.file.stat().st_mode & 0o077 == 0
    (stick / FILE).write_bytes(copy.file.read_bytes())
    open_for_reading(stick).close()


def test_only_the_newest_copies_are_kept_encrypted_or_not(stored: Path, stick: Path) -> None:
    files = [carry(stored, stick, keep=2).file for _ in range(4)]
    assert carried(stick) == files[-2:]


def test_a_stick_is_found_by_its_name_or_as_the_only_one(
    monkeypatch: pytest.MonkeyPatch, stick: Path, tmp_path: Path
) -> None:
    monkeypatch.setattr("platform.node", lambda: "booth-2")
    plug_in(monkeypatch, stick)
    assert destination("stick") == destination("lab") == stick / "recollect-backups" / "booth-2"
    assert destination(str(tmp_path / "elsewhere")) == tmp_path / "elsewhere"
    other = stick.with_name("PHOTOS")
    plug_in(monkeypatch, stick, other)
    assert destination("PHOTOS").is_relative_to(other)
    with pytest.raises(UserInputError, match=r"several drives are plugged in, name one of them: 'LAB' .*'PHOTOS'"):
        destination("stick")


def test_a_stick_that_is_not_there_is_said_so_and_no_folder_takes_its_place(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    plug_in(monkeypatch)
    with pytest.raises(UserInputError, match="no stick is plugged in and mounted; drives that are there: none"):
        destination("stick")
    with pytest.raises(UserInputError, match="there is no drive 'LAB'"):
        destination("LAB")
    media = tmp_path / "media"
    media.mkdir()
    monkeypatch.setattr(drives, "_MOUNTED_UNDER", (media,))
    with pytest.raises(UserInputError, match=r"no drive is mounted at .*LAB"):
        destination(str(media / "LAB" / "copies"))
    assert list(media.iterdir()) == []


@pytest.mark.parametrize("when", ["written", "renamed"])
def test_a_stick_that_is_pulled_out_leaves_the_older_copies_and_no_half_one(
    stored: Path, stick: Path, monkeypatch: pytest.MonkeyPatch, when: str
) -> None:
    older = carry(stored, stick, keep=3).file

    def gone(*_: Any) -> Any:
        raise OSError(errno.EIO, "Input/output error")

    monkeypatch.setattr("os.fsync" if when == "written" else "pathlib.Path.replace", gone)
    with pytest.raises(StorageError, match="could not be written"):
        carry(stored, stick, keep=3)
    monkeypatch.undo()
    assert carried(stick) == [older]
    assert [file for file in stick.iterdir() if "unfinished" in file.name] == []


def test_a_drive_that_reads_back_something_else_is_refused(
    stored: Path, stick: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = Path.open

    def torn(self: Path, mode: str = "r", **options: Any) -> Any:
        if mode == "rb" and "unfinished" in self.name:
            with whole(self, "r+b") as file:
                file.seek(-1, os.SEEK_END)
                file.write(b"?")
        return whole(self, mode, **options)

    monkeypatch.setattr(Path, "open", torn)
    with pytest.raises(StorageError, match="did not keep the copy"):
        carry(stored, stick, keep=3)
    assert carried(stick) == []


def test_a_stick_without_room_is_refused_before_anything_is_written(
    stored: Path, stick: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    usage = namedtuple("usage", "free")
    monkeypatch.setattr("shutil.disk_usage", lambda _: usage(10))
    with pytest.raises(UserInputError, match="has 10 bytes left, and the copy takes"):
        carry(stored, stick, keep=3)
    assert carried(stick) == []


def test_an_encrypted_copy_is_read_with_the_labs_key_alone_and_nothing_else_reaches_the_stick(
    stored: Path, stick: Path, tmp_path: Path
) -> None:
    pyrage = pytest.importorskip("pyrage")
    lab, other = (pyrage.x25519.Identity.generate() for _ in range(2))
    listed = tmp_path / "lab.pub"
    listed.write_text(f"# the lab's\n{lab.to_public()}\n")
    copy = carry(stored, stick, 3, recipients([str(listed)]))
    assert (copy.encrypted, copy.file.suffix) == (True, ".age")
    content = copy.file.read_bytes()
    assert b"SQLite format 3" not in content
    with pytest.raises(pyrage.DecryptError):
        pyrage.decrypt(content, [other])
    opened = tmp_path / "opened.db"
    opened.write_bytes(pyrage.decrypt(content, [lab]))
    assert events_in(opened) == len(COMPLETED)


def test_a_key_that_is_none_or_the_secret_one_is_refused() -> None:
    pyrage = pytest.importorskip("pyrage")
    with pytest.raises(UserInputError, match="'age1nothing' is no public key"):
        recipients(["age1nothing"])
    with pytest.raises(UserInputError, match="secret key, which stays with the lab"):
        recipients([str(pyrage.x25519.Identity.generate())])
