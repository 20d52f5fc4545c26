"""The lock checks no PIN during a wait, and writes a result down before it shows it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import pytest

from kiosk.experiment.experimenter import SALT_BYTES, AuditEvent, hash_pin
from kiosk.ui.event_loop import InlineExecutor
from kiosk.ui.experimenter.authorisation import PinVerifier

LINE = hash_pin("258013", bytes(SALT_BYTES), cost=10)


class Door:
    """A lock, the time, and what it was heard to say."""

    def __init__(self, wrong: int = 0) -> None:
        self.now_ms = 1_000_000
        self.heard: list[object] = []
        self.lock = PinVerifier(LINE, wrong, lambda: self.now_ms, InlineExecutor(), self.write)

    def write(self, note: AuditEvent, _body: Mapping[str, Any]) -> bool:
        """Write down what happened; the disk does not take it."""
        self.heard.append(note)
        return False

    def tell(self, *, right: bool) -> None:
        """Hear whether it was the right one."""
        self.heard.append(right)

    def check(self, pin: str) -> list[object]:
        """Return what is heard when a PIN is tried."""
        self.heard.clear()
        self.lock.check_pin(pin, self.tell)
        return list(self.heard)


def test_a_right_and_a_wrong_pin_are_written_down_then_told_whatever_the_disk_says() -> None:
    door = Door()
    assert door.check("258013") == [AuditEvent.PIN_ATTEMPTED, AuditEvent.PIN_ACCEPTED, True]
    assert door.check("1111") == [AuditEvent.PIN_ATTEMPTED, AuditEvent.PIN_REFUSED, False]


def test_while_nobody_may_try_the_right_one_is_not_even_looked_at() -> None:
    door = Door()
    door.check("1111")
    assert door.check("258013") == [False]
    door.now_ms += door.lock.left_ms
    assert door.check("258013") == [AuditEvent.PIN_ATTEMPTED, AuditEvent.PIN_ACCEPTED, True]


def test_the_row_goes_on_from_the_records_and_the_wait_begins_anew() -> None:
    door = Door(wrong=4)
    assert door.lock.left_ms == 8000
    door.now_ms += 8000
    door.check("1111")
    assert door.lock.left_ms == 16_000


class Slow:
    """Work that is done when the test says so."""

    def __init__(self) -> None:
        self.jobs: list[Callable[[], None]] = []

    def __call__(self, job: Callable[[], Any], then: Callable[[Any], None]) -> None:
        """Keep it for later."""
        self.jobs.append(lambda: then(job()))

    def do(self) -> None:
        """Do what was kept."""
        jobs, self.jobs = self.jobs, []
        for job in jobs:
            job()


def test_of_a_burst_one_pin_is_checked_and_the_right_one_among_them_opens_nothing() -> None:
    slow = Slow()
    door = Door()
    door.lock = PinVerifier(LINE, 0, lambda: door.now_ms, slow, door.write)
    for pin in ("1111", *["258013"] * 39):
        door.lock.check_pin(pin, door.tell)
    assert len(slow.jobs) == 1
    slow.do()
    assert door.heard == [AuditEvent.PIN_ATTEMPTED, *[False] * 39, AuditEvent.PIN_REFUSED, False]
    assert door.check("258013") == [False]
    assert slow.jobs == []
    door.heard.clear()
    door.now_ms += door.lock.left_ms
    door.check("258013")
    slow.do()
    assert door.heard == [AuditEvent.PIN_ATTEMPTED, AuditEvent.PIN_ACCEPTED, True]


def test_the_wait_is_whole_however_long_the_check_took() -> None:
    slow = Slow()
    door = Door(4)
    door.lock = PinVerifier(LINE, 4, lambda: door.now_ms, slow, door.write)
    door.now_ms += door.lock.left_ms
    door.check("1111")
    door.now_ms += 10_000
    slow.do()
    assert door.lock.left_ms == 16_000


def test_a_check_that_fails_counts_as_a_wrong_pin_and_locks_nobody_out(monkeypatch: pytest.MonkeyPatch) -> None:
    door = Door()
    with monkeypatch.context() as patch:
        patch.setattr("kiosk.ui.experimenter.authorisation.pin_matches", lambda *_: 1 / 0)
        with pytest.raises(ZeroDivisionError):
            door.lock.check_pin("258013", door.tell)
    assert door.heard == [AuditEvent.PIN_ATTEMPTED, AuditEvent.PIN_REFUSED, False]
    door.now_ms += door.lock.left_ms
    assert door.check("258013") == [AuditEvent.PIN_ATTEMPTED, AuditEvent.PIN_ACCEPTED, True]
