"""A folder is there as a whole or not at all."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from kiosk import UserInputError
from kiosk.store.connecting import UNFINISHED, atomic_directory


def test_it_takes_its_place_when_all_is_in_it(tmp_path: Path) -> None:
    out = tmp_path / "far" / "out"
    with atomic_directory(out) as made:
        (made / "file").write_text("words", "utf-8")
        assert not out.exists()
    assert [path.name for path in out.parent.rglob("*")] == ["out", "file"]


@pytest.mark.skipif(os.name != "posix", reason="folders cannot be told to be on the disk")
def test_all_of_it_is_on_the_disk_before_it_takes_its_place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    synced: list[tuple[int, bool]] = []
    out = tmp_path / "out"
    monkeypatch.setattr("os.fsync", lambda each: synced.append((os.fstat(each).st_ino, out.exists())))
    with atomic_directory(out) as made:
        (made / "file").touch()
    here = {path.stat().st_ino for path in (out, out / "file")}
    assert here <= {number for number, in_place in synced if not in_place}
    assert synced[-1] == (tmp_path.stat().st_ino, True)


def test_it_is_gone_if_anything_goes_wrong(tmp_path: Path) -> None:
    with pytest.raises(ZeroDivisionError), atomic_directory(tmp_path / "out") as made:
        (made / "file").write_text(str(1 // 0), "utf-8")
    assert list(tmp_path.iterdir()) == []


def test_what_was_cut_off_is_told_of_and_not_removed(tmp_path: Path) -> None:
    left = tmp_path / f"out{UNFINISHED}"
    left.mkdir()
    (left / "file").write_text("somebody's words", "utf-8")
    with pytest.raises(UserInputError, match="was left unfinished"), atomic_directory(tmp_path / "out"):
        pass
    assert (left / "file").exists()


def test_a_folder_that_cannot_be_made_is_refused(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("mine", "utf-8")
    with pytest.raises(UserInputError, match="cannot be used"), atomic_directory(tmp_path / "file" / "out"):
        pass
