"""The lock looks at no PIN while nobody may try, and what it finds out is written down before it is told."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from kiosk.study.booth.notes import Note
from kiosk.study.booth.pin import SALT_BYTES, Wrong, kept
from kiosk.ui.panel.lock import Lock
from kiosk.ui.work import AtOnce

LINE = kept("2580", bytes(SALT_BYTES))


class Door:
    """A lock, the time, and what it was heard to say."""

    def __init__(self, wrong: Wrong = Wrong()) -> None:  # noqa: B008 - it is frozen
        self.now_ms = 1_000_000
        self.heard: list[object] = []
        self.lock = Lock(LINE, wrong, lambda: self.now_ms, AtOnce(), self.write)

    def write(self, note: Note, _body: Mapping[str, Any]) -> bool:
        """Write down what happened; the disk does not take it."""
        self.heard.append(note)
        return False

    def tell(self, *, right: bool) -> None:
        """Hear whether it was the right one."""
        self.heard.append(right)

    def check(self, pin: str) -> list[object]:
        """What is heard when a PIN is tried."""
        self.heard.clear()
        self.lock.check(pin, self.tell)
        return list(self.heard)


def test_a_right_and_a_wrong_pin_are_written_down_then_told_whatever_the_disk_says() -> None:
    door = Door()
    assert door.check("2580") == [Note.PIN_ACCEPTED, True]
    assert door.check("1111") == [Note.PIN_REFUSED, False]


def test_while_nobody_may_try_the_right_one_is_not_even_looked_at() -> None:
    door = Door()
    door.check("1111")
    assert door.check("2580") == [False]
    door.now_ms += door.lock.left_ms
    assert door.check("2580") == [Note.PIN_ACCEPTED, True]


def test_the_row_goes_on_from_the_records() -> None:
    door = Door(Wrong(4, last_ms=999_000))
    assert door.lock.left_ms == 7000
    door.now_ms += 7000
    door.check("1111")
    assert door.lock.left_ms == 16_000
