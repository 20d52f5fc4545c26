"""The loop ends when the system asks it to, whenever that is."""

from __future__ import annotations

import signal
import weakref
from collections.abc import Iterator
from functools import partial

import pytest
from PySide6.QtCore import QEvent, QObject
from PySide6.QtGui import QGuiApplication

from kiosk.ui.event_loop import EventLoop, VirtualClock, WallClock
from kiosk.ui.rehearsed_day import rehearse_day
from kiosk.ui.simulated_visitor import BehaviourProfile
from tests.ui.conftest import MakeBooth


@pytest.fixture
def clock() -> VirtualClock:
    return VirtualClock()


@pytest.fixture
def loop(clock: VirtualClock, qapp: QGuiApplication) -> Iterator[EventLoop]:
    loop = EventLoop(clock, QObject(qapp), lambda *_: None)
    yield loop
    loop.close()


@pytest.mark.parametrize("ending", [signal.SIGINT, signal.SIGTERM])
def test_whoever_asks_for_the_end_before_it_runs_is_heard(loop: EventLoop, ending: signal.Signals) -> None:
    signal.raise_signal(ending)
    loop.run()
    assert loop.stop_requested


def test_it_runs_again_after_it_was_left_from_within(loop: EventLoop, clock: VirtualClock) -> None:
    left: list[int] = []
    for number in (1, 2):
        clock.after(0, partial(left.append, number))
        clock.after(0, loop.quit)
        loop.run()
    assert left == [1, 2]
    assert not loop.stop_requested


def test_nobody_comes_any_more_once_the_system_asked_for_the_end(make_booth: MakeBooth) -> None:
    booth = make_booth()
    booth.app.clock.after(0, partial(signal.raise_signal, signal.SIGTERM))
    assert list(rehearse_day(booth.app, 1, [BehaviourProfile()] * 3, booth.data)) == []


class Counts:
    """Counts the waits that are over."""

    def __init__(self) -> None:
        self.over = 0

    def tell(self) -> None:
        """One more."""
        self.over += 1


def test_a_wait_leaves_nothing_behind_when_it_is_over_or_cancelled(qapp: QGuiApplication) -> None:
    owner, counts = QObject(qapp), Counts()
    clock = WallClock(owner)
    for _ in range(20):
        # Nobody keeps these waits.
        clock.after(0, counts.tell)
        clock.after(60_000, counts.tell).cancel()
    for _ in range(5000):
        qapp.processEvents()
        qapp.sendPostedEvents(None, QEvent.Type.DeferredDelete)
        if counts.over == 20 and not owner.children():
            break
    assert counts.over == 20
    assert owner.children() == []
    assert weakref.getweakrefs(counts) == []
    owner.deleteLater()
