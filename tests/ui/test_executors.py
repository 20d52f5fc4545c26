"""Slow work goes to a thread of its own; what comes of it, and what goes wrong, is seen on the interface's."""

from __future__ import annotations

import threading
from collections.abc import Iterator

import pytest
from pytestqt.exceptions import capture_exceptions
from pytestqt.qtbot import QtBot

from kiosk.ui.event_loop import InlineExecutor, MainThreadExecutor, ThreadExecutor


@pytest.fixture
def worker(qtbot: QtBot) -> Iterator[ThreadExecutor]:  # noqa: ARG001 - results land in Qt's loop
    """Provide a worker with its landing."""
    landing = MainThreadExecutor()
    built = ThreadExecutor(landing)
    yield built
    landing.close()
    built.close()


def test_a_job_is_done_elsewhere_and_its_result_comes_back_here(worker: ThreadExecutor, qtbot: QtBot) -> None:
    came: list[tuple[int, int]] = []
    worker(threading.get_ident, lambda elsewhere: came.append((elsewhere, threading.get_ident())))
    qtbot.waitUntil(lambda: bool(came))
    ((elsewhere, here),) = came
    assert here == threading.get_ident() != elsewhere


def test_jobs_are_done_one_after_another(worker: ThreadExecutor, qtbot: QtBot) -> None:
    came: list[int] = []
    for number in range(20):
        worker(lambda number=number: number, came.append)  # type: ignore[misc]
    qtbot.waitUntil(lambda: len(came) == 20)
    assert came == list(range(20))


def test_a_fault_in_a_job_is_raised_where_faults_are_seen_and_the_next_job_is_done(
    worker: ThreadExecutor, qtbot: QtBot
) -> None:
    came: list[str] = []
    with capture_exceptions() as faults:
        worker(lambda: 1 // 0, lambda _: came.append("never"))
        worker(lambda: "next", came.append)
        qtbot.waitUntil(lambda: bool(came))
    assert came == ["next"]
    assert [kind for kind, *_ in faults] == [ZeroDivisionError]


def test_where_time_is_virtual_a_job_takes_none() -> None:
    came: list[int] = []
    InlineExecutor()(lambda: 1, came.append)
    assert came == [1]
