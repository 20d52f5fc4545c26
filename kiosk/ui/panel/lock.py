"""Whether a PIN is the right one: checked off the interface's thread, recorded, and slower after every wrong one."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any, Protocol

from kiosk.study.booth.notes import Note
from kiosk.study.booth.pin import Wrong, matches
from kiosk.ui.work import Work

Write = Callable[[Note, Mapping[str, Any]], bool]
"""Writes down what happened at the booth; whether the disk took it."""


class Told(Protocol):
    """Is told whether a PIN was the right one."""

    def __call__(self, *, right: bool) -> None:
        """It was, or it was not."""
        ...


class Lock:
    """One booth's lock; without a PIN it is open."""

    def __init__(self, line: str, wrong: Wrong, now_ms: Callable[[], int], work: Work, write: Write) -> None:
        """``line`` is the PIN as the study file keeps it, ``wrong`` what the records tell of the last wrong ones."""
        self._line = line
        self._wrong = wrong
        self._now_ms = now_ms
        self._work = work
        self._write = write

    @property
    def has_pin(self) -> bool:
        """Whether anything is asked for at all."""
        return bool(self._line)

    @property
    def left_ms(self) -> int:
        """How long nobody may try again, in ms."""
        return self._wrong.left_ms(self._now_ms())

    def check(self, pin: str, told: Told) -> None:
        """Tell, soon, whether this is the PIN; while nobody may try, it is not even looked at."""
        if self.left_ms:
            told(right=False)
            return
        self._work(partial(matches, pin, self._line), partial(self._checked, told))

    def _checked(self, told: Told, right: bool) -> None:  # noqa: FBT001 - it is what was found out
        if right:
            self._wrong = Wrong()
            self._write(Note.PIN_ACCEPTED, {})
        else:
            self._wrong = Wrong(self._wrong.times + 1, self._now_ms())
            self._write(Note.PIN_REFUSED, {"in_a_row": self._wrong.times, "wait_ms": self._wrong.wait_ms})
        told(right=right)
