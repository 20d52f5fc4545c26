"""A file is written whole or not at all, and is on the disk when that is said."""

from __future__ import annotations

import errno
import os
import stat
from pathlib import Path

import pytest

from kiosk import StorageError, UserInputError
from kiosk.cli.status import read_status
from kiosk.config import Settings
from kiosk.experiment import booth_status
from kiosk.files import make_folder, parse_json, replace_file, sync_folder, sync_tree, write_file
from kiosk.store import chain, copies, tombstones
from kiosk.study.csv_import import text_of_table
from kiosk.study.decks import picture_faults


def test_a_file_is_replaced_whole(tmp_path: Path) -> None:
    file = tmp_path / "page.html"
    write_file(file, "old")
    write_file(file, "new")
    assert file.read_text("utf-8") == "new"
    assert list(tmp_path.iterdir()) == [file]


def test_a_full_disk_leaves_the_old_file_and_nothing_else(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(_: int) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    file = tmp_path / "page.html"
    write_file(file, "old")
    monkeypatch.setattr("os.fsync", full)
    with pytest.raises(StorageError, match=r"page\.html cannot be written: disk full"):
        write_file(file, "new")
    assert file.read_text("utf-8") == "old"
    assert list(tmp_path.iterdir()) == [file]


@pytest.mark.skipif(os.name != "posix", reason="a folder of Windows holds no pipes")
def test_a_pipe_in_place_of_a_file_is_refused_and_not_waited_for(tmp_path: Path) -> None:
    pipe = tmp_path / "study.toml"
    os.mkfifo(pipe)
    with pytest.raises(UserInputError, match="cannot be read: it is a pipe and no file"):
        Settings.read(pipe)
    with pytest.raises(UserInputError, match="cannot be read: it is a pipe and no file"):
        text_of_table("the table", pipe)
    assert list(picture_faults(pipe)) == [f"the picture {pipe} cannot be read: it is a pipe and no file"]


@pytest.mark.skipif(os.name != "posix", reason="a folder of Windows holds no pipes")
def test_a_pipe_in_place_of_a_file_beside_the_database_is_not_waited_for(tmp_path: Path) -> None:
    for name in (booth_status.FILE, chain.FILE, copies.FILE, tombstones.FILE):
        os.mkfifo(tmp_path / name)
    with pytest.raises(UserInputError, match=r"status\.json cannot be read: .*it is a pipe and no file"):
        read_status(tmp_path)
    assert chain.read_heads(tmp_path) == []
    assert tombstones.read_tombstones(tmp_path) == frozenset()
    copies.note_copy(tmp_path, copies.CopyKind.BACKUP, tmp_path / "copy.db")
    assert copies.known_copies(tmp_path) == []


@pytest.mark.parametrize("text", ["{", "[" * 100_000, '{"a":' * 100_000, b"\xff"])
def test_whatever_is_no_json_is_a_value_error(text: str | bytes) -> None:
    with pytest.raises(ValueError, match=r".+"):
        parse_json(text)


def test_a_private_file_is_for_its_owner_alone(tmp_path: Path) -> None:
    replace_file(tmp_path / "status.json", "{}", 0o600, durable=False)
    assert (tmp_path / "status.json").stat().st_mode & 0o077 == 0


@pytest.fixture
def synced(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Return the numbers of the files and folders that are on the disk, as they come there."""
    if os.name != "posix":
        pytest.skip("folders cannot be told to be on the disk")
    numbers: list[int] = []
    monkeypatch.setattr("os.fsync", lambda descriptor: numbers.append(os.fstat(descriptor).st_ino))
    return numbers


def test_the_new_name_of_a_file_is_on_the_disk_after_the_file(tmp_path: Path, synced: list[int]) -> None:
    write_file(tmp_path / "page.html", "new")
    assert synced == [(tmp_path / "page.html").stat().st_ino, tmp_path.stat().st_ino]


def test_a_file_that_need_not_last_is_not_waited_for(tmp_path: Path, synced: list[int]) -> None:
    replace_file(tmp_path / "status.json", "{}", durable=False)
    assert synced == []


def test_a_new_folder_has_the_names_of_all_above_it_on_the_disk(tmp_path: Path, synced: list[int]) -> None:
    make_folder(tmp_path / "far" / "away")
    assert set(synced) == {tmp_path.stat().st_ino, (tmp_path / "far").stat().st_ino}
    make_folder(tmp_path / "far" / "away")
    assert len(synced) == 2


@pytest.mark.skipif(os.name != "posix", reason="modes are those of POSIX")
def test_a_new_folder_and_those_made_above_it_are_open_to_their_owner_alone(tmp_path: Path) -> None:
    (tmp_path / "there").mkdir(mode=0o755)
    make_folder(tmp_path / "there" / "far" / "away")
    modes = [stat.S_IMODE(path.stat().st_mode) for path in sorted((tmp_path / "there").rglob("*"))]
    assert modes == [0o700, 0o700]
    assert stat.S_IMODE((tmp_path / "there").stat().st_mode) == 0o755


def test_all_of_a_tree_is_on_the_disk(tmp_path: Path, synced: list[int]) -> None:
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "file").touch()
    (tmp_path / "file").touch(mode=0o400)
    sync_tree(tmp_path)
    assert set(synced) == {path.stat().st_ino for path in (tmp_path, *tmp_path.rglob("*"))}


@pytest.mark.parametrize("number", [errno.EACCES, errno.EINVAL])
def test_a_folder_that_cannot_be_told_to_be_on_the_disk_is_no_failure(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, number: int
) -> None:
    def refuse(_: int) -> None:
        raise OSError(number, os.strerror(number))

    monkeypatch.setattr("os.fsync", refuse)
    sync_folder(tmp_path)
