"""Whether a PIN is the right one: checked off the interface's thread, recorded, and slower after every wrong one."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any, Protocol

from kiosk.study.booth.notes import Note
from kiosk.study.booth.pin import Wrong, matches
from kiosk.ui.work import Work

Write = Callable[[Note, Mapping[str, Any]], object]
"""Writes down what happened at the booth, whether the disk takes it or not."""


class Told(Protocol):
    """Is told whether a PIN was the right one."""

    def __call__(self, *, right: bool) -> None:
        """It was, or it was not."""
        ...


class Lock:
    """One booth's lock; without a PIN it is open.

    An attempt counts from the moment it is taken, and there is one at a time: whatever is typed while one is checked,
    or while nobody may try, is refused without being looked at. So no burst gets more tries than the waits allow.
    """

    def __init__(self, line: str, wrong: Wrong, now_ms: Callable[[], int], work: Work, write: Write) -> None:
        """``line`` is the PIN as the study file keeps it, ``wrong`` what the records tell of the last wrong ones."""
        self._line = line
        self._wrong = wrong
        self._now_ms = now_ms
        self._work = work
        self._write = write
        self._checks = False

    @property
    def has_pin(self) -> bool:
        """Whether anything is asked for at all."""
        return bool(self._line)

    @property
    def checks(self) -> bool:
        """Whether an attempt is being checked, so that nobody else may try."""
        return self._checks

    @property
    def left_ms(self) -> int:
        """How long nobody may try again after a wrong PIN, in ms; 0 while it is not known yet."""
        return 0 if self._checks else self._wrong.left_ms(self._now_ms())

    def check(self, pin: str, told: Told) -> None:
        """Tell, soon, whether this is the PIN; while nobody may try, it is not even looked at."""
        if self._checks or self.left_ms:
            told(right=False)
            return
        self._checks = True
        self._wrong = Wrong(self._wrong.times + 1, self._now_ms())
        self._work(partial(self._try, pin), partial(self._checked, told))

    def _try(self, pin: str) -> bool | Exception:
        try:
            return matches(pin, self._line)
        except Exception as fault:  # noqa: BLE001 - it is raised below, once the lock can be tried again
            return fault

    def _checked(self, told: Told, found: bool | Exception) -> None:  # noqa: FBT001 - it is what was found out
        self._checks = False
        if found is True:
            self._wrong = Wrong()
            self._write(Note.PIN_ACCEPTED, {})
        else:
            # The wait is as long as it is said to be, however long the check took.
            self._wrong = Wrong(self._wrong.times, self._now_ms())
            self._write(Note.PIN_REFUSED, {"in_a_row": self._wrong.times, "wait_ms": self._wrong.wait_ms})
        told(right=found is True)
        if isinstance(found, Exception):
            raise found
