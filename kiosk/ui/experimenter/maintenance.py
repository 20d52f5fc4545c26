"""Upkeep of a booth between sessions: copies of its database, and a look at the disk space.

Both are slow work, done elsewhere; what comes of them is written down and shown, and never stops a session.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from functools import partial
from math import ceil
from pathlib import Path
from typing import Protocol

from kiosk import StorageError, UserInputError
from kiosk.experiment.experimenter import AuditEvent
from kiosk.lazy_dataclass import dataclass
from kiosk.store.copies import Backup, backups_of
from kiosk.store.maintenance import FOLDER, FreeSpace, SpaceLevel, back_up, free_space
from kiosk.ui.event_loop import Clock, Executor
from kiosk.ui.experimenter.authorisation import Write
from kiosk.units import MS_PER_MINUTE, MS_PER_SECOND

MINUTES_PER_HOUR = 60
BEAT_MS = 60_000
"""How often the disk is looked at, and whether a copy is due."""


_log = logging.getLogger(__name__)


@dataclass(frozen=True)
class BackupOutcome:
    """What became of the last copy: when, in ms since 1970, and where, or why not."""

    at_ms: int
    file: Path | None
    why: str = ""


@dataclass(frozen=True)
class MaintenanceTasks:
    """How copies are made, and the disk is looked at; another one stands in for it in tests."""

    copy: Callable[[], Path]
    """Raises UserInputError or StorageError."""
    last_copy: Callable[[], Backup | None]
    """The newest copy, in the data folder or carried elsewhere."""
    free_space: Callable[[], FreeSpace]
    """Raises UserInputError."""

    @classmethod
    def of(cls, folder: Path, keep: int, every_minutes: int) -> MaintenanceTasks:
        """Take care of a data folder, copy it every so many minutes, and keep so many copies."""
        into = folder / FOLDER
        return cls(
            partial(back_up, folder, into, keep),
            lambda: next(reversed(backups_of(folder)), None),
            partial(free_space, folder, min(keep, ceil(MINUTES_PER_HOUR / every_minutes))),
        )


class Shut(Protocol):
    """Closes the kiosk to new sessions, or opens it again."""

    def __call__(self, *, shut: bool) -> None:
        """From now on."""
        ...


class MaintenanceScheduler:
    """Copies the database when a copy is due, and watches the disk space."""

    def __init__(  # noqa: PLR0913, PLR0917 - whom it has to do with
        self,
        care: MaintenanceTasks,
        every_minutes: int,
        clock: Clock,
        now_ms: Callable[[], int],
        work: Executor,
        write: Write,
        resting: Callable[[], bool],
        shut: Shut,
    ) -> None:
        """``resting`` tells whether no session is under way; ``shut`` closes the kiosk to new ones, or opens it."""
        self._care = care
        self._every_ms = every_minutes * MS_PER_MINUTE
        self._clock = clock
        self._now_ms = now_ms
        self._work = work
        self._write = write
        self._resting = resting
        self._shut = shut
        self._copied_at = clock.now_ms()
        self._wished = self._busy = False
        self.last_backup: BackupOutcome | None = None
        """What became of the last copy; None before the first."""
        self.free_space: FreeSpace | None = None
        """The room that is left; None before the first look, or if it cannot be found out."""
        self.changed: Callable[[], None] = lambda: None

    @property
    def busy(self) -> bool:
        """Whether a copy is being made."""
        return self._busy

    @property
    def waits(self) -> bool:
        """Whether a copy is to be made as soon as the session is over."""
        return self._wished

    def begin(self) -> None:
        """See how things are, and go on seeing to them."""
        self._work(self._care.last_copy, self._found_first_copy)
        self.check_due()
        self._clock.after(BEAT_MS, self._beat)

    def check_due(self) -> None:
        """Look at the disk now, and make a copy if one is due."""
        self._work(self._look_at_room, self._found_room)
        if self._clock.now_ms() - self._copied_at >= self._every_ms:
            self._wished = True
        self.on_idle()

    def back_up(self) -> None:
        """Make a copy now, or as soon as no session is under way."""
        self._wished = True
        self.on_idle()
        self.changed()

    def on_idle(self) -> None:
        """Make the copy that has waited for the end of a session."""
        if self._wished and not self._busy and self._resting():
            self._wished, self._busy = False, True
            self._copied_at = self._clock.now_ms()
            self._work(self._copy, self._have_copied)

    def _beat(self) -> None:
        # A command may have made one, such as 'recollect backup --to stick'.
        self._work(self._care.last_copy, self._found_copy)
        self.check_due()
        self._clock.after(BEAT_MS, self._beat)

    def _copy(self) -> BackupOutcome:
        try:
            return BackupOutcome(self._now_ms(), self._care.copy())
        except (UserInputError, StorageError) as failure:
            return BackupOutcome(self._now_ms(), None, str(failure))

    def _have_copied(self, copied: BackupOutcome) -> None:
        self._busy = False
        self.last_backup = copied
        if copied.file is not None:
            self._write(AuditEvent.BACKUP_MADE, {"file": copied.file.name})
        else:
            _log.error("%s", copied.why)
            self._write(AuditEvent.BACKUP_FAILED, {"why": copied.why})
        self.changed()

    def _found_first_copy(self, found: Backup | None) -> None:
        if found is not None and self.last_backup is None:
            self._copied_at -= max(0, self._now_ms() - _ms(found))
        self._found_copy(found)

    def _found_copy(self, found: Backup | None) -> None:
        if found is not None and self._is_news(found):
            self.last_backup = BackupOutcome(_ms(found), found.file)
            self.changed()

    def _is_news(self, found: Backup) -> bool:
        before = self.last_backup
        if before is None:
            return True
        # A failure of the kiosk's own copies stays until one succeeds.
        return before.file not in {None, found.file} and before.at_ms < _ms(found)

    def _look_at_room(self) -> FreeSpace | None:
        try:
            return self._care.free_space()
        except UserInputError as failure:
            _log.error("%s", failure)
            return None

    def _found_room(self, found: FreeSpace | None) -> None:
        before, self.free_space = self.free_space, found
        level = found.level if found else SpaceLevel.ENOUGH
        if level is not (before.level if before else SpaceLevel.ENOUGH):
            free_mib = found.free_mib if found else None
            _log.log(
                logging.INFO if level is SpaceLevel.ENOUGH else logging.WARNING,
                "the disk has %s MiB left%s",
                free_mib,
                "; no session can begin" if level is SpaceLevel.REFUSE else "",
            )
            self._write(AuditEvent.DISK_SPACE_CHANGED, {"level": level.value, "free_mib": free_mib})
            self._shut(shut=level is SpaceLevel.REFUSE)
        self.changed()


def _ms(copy: Backup) -> int:
    return int(copy.at.timestamp() * MS_PER_SECOND)
