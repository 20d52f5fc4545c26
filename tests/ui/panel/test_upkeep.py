"""Between sittings the booth copies its database and looks at the disk; nobody begins where there is no room left."""

from __future__ import annotations

import logging
import os
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import Any, TypeVar

import pytest

from kiosk import BadInput, StoreFailed
from kiosk.store.care.backup import FOLDER
from kiosk.store.care.disk import Room
from kiosk.study import events as happened
from kiosk.study.booth.notes import Note
from kiosk.study.events import Stage
from kiosk.ui.clock import VirtualClock
from kiosk.ui.panel.upkeep import BEAT_MS, Care, Upkeep
from kiosk.ui.work import AtOnce, Work
from kiosk.units import MS_PER_MINUTE
from tests.ui.panel.conftest import Desk

EVERY = 10
"""Minutes between two copies."""

Result = TypeVar("Result")

PLENTY, LITTLE, NONE = Room(5000), Room(300), Room(10)


class Later:
    """Does at once what it is given, and lands it only when it is told to."""

    def __init__(self) -> None:
        self._landings: list[Callable[[], None]] = []

    def __call__(self, job: Callable[[], Result], then: Callable[[Result], None]) -> None:
        """Do ``job`` now."""
        self._landings.append(partial(then, job()))

    def land(self) -> None:
        """Land everything that was done."""
        landings, self._landings = self._landings, []
        for landing in landings:
            landing()


class Place:
    """A booth that is taken care of; the test says what becomes of copies, and how much room there is."""

    def __init__(self, last: Path | None = None, work: Work | None = None) -> None:
        self.clock = VirtualClock()
        self.room: Room | BadInput = PLENTY
        self.failure: Exception | None = None
        self.resting = True
        self.copies = 0
        self.notes: list[tuple[Note, Mapping[str, Any]]] = []
        self.shut: list[bool] = []
        care = Care(self.copy, lambda: last, self.look)
        self.upkeep = Upkeep(
            care,
            EVERY,
            self.clock,
            self.wall_ms,
            work or AtOnce(),
            self.write,
            lambda: self.resting,
            self.let_begin,
        )

    def wall_ms(self) -> int:
        """The wall's clock."""
        return 1_700_000_000_000 + self.clock.now_ms()

    def copy(self) -> Path:
        """Make a copy, or fail."""
        if self.failure is not None:
            raise self.failure
        self.copies += 1
        return Path(f"recollect-{self.copies}.db")

    def look(self) -> Room:
        """Look at the disk."""
        if isinstance(self.room, BadInput):
            raise self.room
        return self.room

    def write(self, note: Note, body: Mapping[str, Any]) -> bool:
        """Write down what happened."""
        self.notes.append((note, body))
        return True

    def wait(self, minutes: int) -> None:
        """Let so many minutes pass."""
        until = self.clock.now_ms() + minutes * BEAT_MS
        while self.clock.now_ms() < until:
            self.clock.jump()

    def let_begin(self, *, shut: bool) -> None:
        """Let nobody begin, or everybody again."""
        self.shut.append(shut)

    @property
    def kinds(self) -> list[Note]:
        """What was written down."""
        return [note for note, _ in self.notes]


def test_a_copy_is_made_as_often_as_the_study_wants_it() -> None:
    place = Place()
    place.upkeep.begin()
    place.wait(EVERY - 1)
    assert place.copies == 0
    place.wait(1)
    assert place.copies == 1
    place.wait(2 * EVERY)
    assert place.copies == 3
    assert place.notes[0] == (Note.BACKUP_MADE, {"file": "recollect-1.db"})


def test_a_copy_from_before_the_start_counts(tmp_path: Path) -> None:
    last = tmp_path / "recollect-0.db"
    last.touch()
    place = Place(last)
    place.upkeep.begin()
    assert place.upkeep.copied is not None
    assert place.upkeep.copied.file == last


def test_an_old_copy_makes_the_next_one_due_at_once(tmp_path: Path) -> None:
    last = tmp_path / "recollect-0.db"
    last.touch()
    place = Place(last)
    long_ago = place.wall_ms() / 1000 - 2 * EVERY * MS_PER_MINUTE / 1000
    os.utime(last, (long_ago, long_ago))
    place.upkeep.begin()
    assert place.copies == 1


def test_a_copy_that_goes_away_while_it_is_looked_for_is_none(tmp_path: Path) -> None:
    place = Place(tmp_path / "recollect-0.db")
    place.upkeep.begin()
    assert place.upkeep.copied is None
    place.wait(EVERY)
    assert place.copies == 1


def test_a_copy_that_goes_away_once_it_was_looked_at_is_not_looked_at_again(tmp_path: Path) -> None:
    last = tmp_path / "recollect-0.db"
    last.touch()
    work = Later()
    place = Place(last, work)
    place.upkeep.begin()
    last.unlink()
    work.land()
    assert place.upkeep.copied is not None
    assert place.upkeep.copied.file == last


def test_no_copy_is_made_during_a_sitting_and_it_is_made_up_for_right_after() -> None:
    place = Place()
    place.upkeep.begin()
    place.resting = False
    place.wait(3 * EVERY)
    assert place.copies == 0
    assert place.upkeep.waits
    place.resting = True
    place.upkeep.rested()
    assert place.copies == 1
    place.upkeep.rested()
    assert place.copies == 1


@pytest.mark.parametrize("failure", [BadInput("no place"), StoreFailed("no room")])
def test_a_copy_that_fails_is_told_and_tried_again(failure: Exception, caplog: pytest.LogCaptureFixture) -> None:
    place = Place()
    place.failure = failure
    place.upkeep.back_up()
    assert place.notes == [(Note.BACKUP_FAILED, {"why": str(failure)})]
    assert place.upkeep.copied is not None
    assert place.upkeep.copied.file is None
    assert str(failure) in caplog.text
    place.failure = None
    place.upkeep.back_up()
    assert place.kinds == [Note.BACKUP_FAILED, Note.BACKUP_MADE]


def test_little_room_is_told_once_and_no_room_lets_nobody_begin_until_there_is_some(
    caplog: pytest.LogCaptureFixture,
) -> None:
    caplog.set_level(logging.INFO)
    place = Place()
    place.upkeep.begin()
    assert place.notes == []
    place.room = LITTLE
    place.wait(3)
    assert place.notes == [(Note.ROOM_CHANGED, {"level": "warn", "free_mib": 300})]
    assert not any(place.shut)
    place.room = NONE
    place.wait(1)
    assert place.shut[-1]
    assert "the disk has 10 MiB left; nobody can begin" in caplog.text
    place.room = PLENTY
    place.wait(1)
    assert not place.shut[-1]
    assert place.kinds == [Note.ROOM_CHANGED] * 3


def test_a_disk_that_nobody_can_look_at_stops_nobody(caplog: pytest.LogCaptureFixture) -> None:
    place = Place()
    place.room = BadInput("the room that is left cannot be told")
    place.upkeep.begin()
    assert place.upkeep.room is None
    assert not any(place.shut)
    assert "cannot be told" in caplog.text


def test_in_the_kiosk_no_room_ends_no_sitting_but_the_next_one_cannot_begin(desk: Desk) -> None:
    desk.go_to(Stage.PRACTICE)
    desk.app.conductor.shut(shut=True)
    assert desk.screen == "practice"
    desk.go_to(Stage.THANKS)
    desk.app.conductor.tell(happened.NextAsked)
    assert desk.screen == "pause"
    desk.app.conductor.start("en")
    assert desk.screen == "pause"
    desk.app.conductor.shut(shut=False)
    assert desk.stage is Stage.ATTRACT


def test_in_the_kiosk_a_copy_asked_for_in_the_panel_is_there(desk: Desk) -> None:
    desk.open_panel()
    desk.click("deed-backup")
    assert [path.suffix for path in (desk.data / FOLDER).glob("recollect-*")] == [".db"]
    assert desk.notes[-1][0] == "BackupMade"
