"""Between sessions the booth copies its database and looks at the disk; no session begins without room on it."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any, TypeVar

import pytest
from click.testing import CliRunner

from kiosk import StorageError, UserInputError
from kiosk.cli.main import recollect
from kiosk.experiment import events as happened
from kiosk.experiment.experimenter import AuditEvent
from kiosk.experiment.outcomes import Stage
from kiosk.store.copies import Backup
from kiosk.store.maintenance import FOLDER, FreeSpace
from kiosk.ui.event_loop import InlineExecutor, VirtualClock
from kiosk.ui.experimenter.maintenance import BEAT_MS, BackupOutcome, MaintenanceScheduler, MaintenanceTasks
from kiosk.units import MS_PER_SECOND
from tests.ui.experimenter.conftest import Desk, MakeDesk

EVERY = 10
"""Minutes between two copies."""

Result = TypeVar("Result")

PLENTY, LITTLE, NONE = FreeSpace(5000), FreeSpace(300), FreeSpace(10)


class Place:
    """A booth that is taken care of; the test says what becomes of copies, and how much room there is."""

    def __init__(self, last: Backup | None = None) -> None:
        self.last = last
        self.clock = VirtualClock()
        self.room: FreeSpace | UserInputError = PLENTY
        self.failure: Exception | None = None
        self.resting = True
        self.copies = 0
        self.notes: list[tuple[AuditEvent, Mapping[str, Any]]] = []
        self.shut: list[bool] = []
        care = MaintenanceTasks(self.copy, lambda: self.last, self.look)
        self.upkeep = MaintenanceScheduler(
            care,
            EVERY,
            self.clock,
            self.wall_ms,
            InlineExecutor(),
            self.write,
            lambda: self.resting,
            self.let_begin,
        )

    def wall_ms(self) -> int:
        """Return the wall's clock."""
        return 1_700_000_000_000 + self.clock.now_ms()

    def copied(self, name: str, minutes_ago: int = 0) -> Backup:
        """Return a copy that was made some minutes ago."""
        at = datetime.fromtimestamp(self.wall_ms() / MS_PER_SECOND, UTC) - timedelta(minutes=minutes_ago)
        return Backup(Path(name), at)

    def copy(self) -> Path:
        """Make a copy, or fail."""
        if self.failure is not None:
            raise self.failure
        self.copies += 1
        return Path(f"recollect-{self.copies}.db")

    def look(self) -> FreeSpace:
        """Look at the disk."""
        if isinstance(self.room, UserInputError):
            raise self.room
        return self.room

    def write(self, note: AuditEvent, body: Mapping[str, Any]) -> bool:
        """Write down what happened."""
        self.notes.append((note, body))
        return True

    def wait(self, minutes: int) -> None:
        """Let so many minutes pass."""
        until = self.clock.now_ms() + minutes * BEAT_MS
        while self.clock.now_ms() < until:
            self.clock.jump()

    def let_begin(self, *, shut: bool) -> None:
        """Let no session begin, or all again."""
        self.shut.append(shut)

    @property
    def kinds(self) -> list[AuditEvent]:
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
    assert place.notes[0] == (AuditEvent.BACKUP_MADE, {"file": "recollect-1.db"})


def test_a_copy_from_before_the_start_counts() -> None:
    place = Place()
    place.last = place.copied("recollect-0.db")
    place.upkeep.begin()
    assert place.upkeep.last_backup == BackupOutcome(place.wall_ms(), Path("recollect-0.db"))


def test_an_old_copy_makes_the_next_one_due_at_once() -> None:
    place = Place()
    place.last = place.copied("recollect-0.db", 2 * EVERY)
    place.upkeep.begin()
    assert place.copies == 1


def test_a_copy_that_a_command_made_meanwhile_counts_and_puts_off_none_of_the_kiosks_own() -> None:
    place = Place()
    place.upkeep.begin()
    place.wait(EVERY - 2)
    place.last = place.copied("stick.db")
    made_ms = place.wall_ms()
    place.wait(1)
    assert place.upkeep.last_backup == BackupOutcome(made_ms, Path("stick.db"))
    place.wait(1)
    assert place.copies == 1
    # The older one does not take its place again.
    place.wait(1)
    assert place.upkeep.last_backup.file == Path("recollect-1.db")


def test_a_copy_that_a_command_made_does_not_hide_that_the_kiosks_own_fail() -> None:
    place = Place()
    place.failure = StorageError("no room")
    place.upkeep.begin()
    place.wait(EVERY)
    place.last = place.copied("stick.db")
    place.wait(2)
    assert place.upkeep.last_backup is not None
    assert place.upkeep.last_backup.why == "no room"


def test_no_copy_is_made_during_a_session_and_it_is_made_up_for_right_after() -> None:
    place = Place()
    place.upkeep.begin()
    place.resting = False
    place.wait(3 * EVERY)
    assert place.copies == 0
    assert place.upkeep.waits
    place.resting = True
    place.upkeep.on_idle()
    assert place.copies == 1
    place.upkeep.on_idle()
    assert place.copies == 1


@pytest.mark.parametrize("failure", [UserInputError("no place"), StorageError("no room")])
def test_a_copy_that_fails_is_told_and_tried_again(failure: Exception, caplog: pytest.LogCaptureFixture) -> None:
    place = Place()
    place.failure = failure
    place.upkeep.back_up()
    assert place.notes == [(AuditEvent.BACKUP_FAILED, {"why": str(failure)})]
    assert place.upkeep.last_backup is not None
    assert place.upkeep.last_backup.file is None
    assert str(failure) in caplog.text
    place.failure = None
    place.upkeep.back_up()
    assert place.kinds == [AuditEvent.BACKUP_FAILED, AuditEvent.BACKUP_MADE]


def test_little_room_is_told_once_and_no_room_lets_nobody_begin_until_there_is_some(
    caplog: pytest.LogCaptureFixture,
) -> None:
    caplog.set_level(logging.INFO)
    place = Place()
    place.upkeep.begin()
    assert place.notes == []
    place.room = LITTLE
    place.wait(3)
    assert place.notes == [(AuditEvent.DISK_SPACE_CHANGED, {"level": "warn", "free_mib": 300})]
    assert not any(place.shut)
    place.room = NONE
    place.wait(1)
    assert place.shut[-1]
    assert "the disk has 10 MiB left; no session can begin" in caplog.text
    place.room = PLENTY
    place.wait(1)
    assert not place.shut[-1]
    assert place.kinds == [AuditEvent.DISK_SPACE_CHANGED] * 3


def test_a_disk_that_nobody_can_look_at_stops_nobody(caplog: pytest.LogCaptureFixture) -> None:
    place = Place()
    place.room = UserInputError("the room that is left cannot be told")
    place.upkeep.begin()
    assert place.upkeep.free_space is None
    assert not any(place.shut)
    assert "cannot be told" in caplog.text


def test_in_the_kiosk_no_room_ends_no_session_but_the_next_one_cannot_begin(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(stages=["practice", "game", "thanks"])
    assigner.go_to(Stage.PRACTICE)
    assigner.app.runner.set_closed(shut=True)
    assert assigner.screen == "practice"
    assigner.go_to(Stage.THANKS)
    assigner.app.runner.dispatch(happened.NextParticipantRequested(at_ms=assigner.app.runner.now_ms()))
    assert assigner.screen == "pause"
    assigner.app.runner.start("en")
    assert assigner.screen == "pause"
    assigner.app.runner.set_closed(shut=False)
    assert assigner.stage is Stage.ATTRACT


def test_in_the_kiosk_a_copy_that_was_carried_away_counts(assigner: Desk, tmp_path: Path) -> None:
    stick = tmp_path / "stick"
    assert CliRunner().invoke(recollect, ["backup", "--data", str(assigner.data), "--to", str(stick)]).exit_code == 0
    care = MaintenanceTasks.of(assigner.data, 1, EVERY)
    found = care.last_copy()
    assert found is not None
    assert found.file.parent == stick


def test_in_the_kiosk_a_copy_asked_for_in_the_panel_is_there(assigner: Desk) -> None:
    assigner.open_panel()
    assigner.click("action-backup")
    assert [path.suffix for path in (assigner.data / FOLDER).glob("recollect-*")] == [".db"]
    assert assigner.notes[-1][0] == "BackupMade"
