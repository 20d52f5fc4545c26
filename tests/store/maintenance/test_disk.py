"""Whether there is room is said before the disk says it."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from kiosk import UserInputError
from kiosk.store.maintenance import REFUSE_MIB, WARN_MIB, FreeSpace, SpaceLevel, free_space
from kiosk.units import MIB


@pytest.mark.parametrize(
    ("free_mib", "level"),
    [
        (0, SpaceLevel.REFUSE),
        (REFUSE_MIB - 1, SpaceLevel.REFUSE),
        (REFUSE_MIB, SpaceLevel.WARN),
        (WARN_MIB - 1, SpaceLevel.WARN),
        (WARN_MIB, SpaceLevel.ENOUGH),
        (10 * WARN_MIB, SpaceLevel.ENOUGH),
    ],
)
def test_there_are_two_levels(free_mib: int, level: SpaceLevel) -> None:
    assert FreeSpace(free_mib).level is level


def test_the_room_is_that_of_the_folder_s_disk(tmp_path: Path) -> None:
    free = shutil.disk_usage(tmp_path).free / MIB
    assert free_space(tmp_path).free_mib == pytest.approx(free, rel=0.2)


def test_a_folder_that_is_not_there_yet_has_the_room_of_the_one_above(tmp_path: Path) -> None:
    assert free_space(tmp_path / "not" / "there").free_mib == pytest.approx(free_space(tmp_path).free_mib, rel=0.2)
    assert list(tmp_path.iterdir()) == []


def test_a_disk_that_does_not_answer_is_told_in_words(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(_: Path) -> None:
        raise OSError(5, "Input/output error")

    monkeypatch.setattr(shutil, "disk_usage", broken)
    with pytest.raises(UserInputError, match=r"the room that is left for .* cannot be told: Input/output error"):
        free_space(tmp_path)
