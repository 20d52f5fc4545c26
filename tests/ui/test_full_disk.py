"""A disk that is full, in whatever stage: the visitor sees an error screen, the log tells of it, nothing is torn."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Iterator
from contextlib import closing
from itertools import count

import pytest
from PySide6.QtGui import QGuiApplication

from kiosk.config import Settings
from kiosk.experiment import events as happened
from kiosk.experiment.outcomes import Stage, Status
from kiosk.experiment.transitions import BEFORE_DECIDING
from kiosk.store.database import FILE
from kiosk.store.queries import open_repository
from tests.ui.conftest import Booth, shared_booth
from tests.ui.small_disk import SmallDisk
from tests.ui.visiting import PAIR, go_on_to_the_end, go_to

SMALL = Settings.model_validate({"languages": ["en"], "questionnaires": ["trust"], **PAIR})
KEPT = [stage for stage in Stage if stage not in {*BEFORE_DECIDING, Stage.ATTRACT, Stage.OVER}]


@pytest.fixture(scope="module")
def disk() -> SmallDisk:
    """Return the disk under the booth."""
    return SmallDisk()


@pytest.fixture(scope="module")
def booth(qapp: QGuiApplication, disk: SmallDisk, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Booth]:  # noqa: ARG001 - Qt is to be there
    """Provide a booth on a disk that can be full; each test leaves it at the start screen, as a day does."""
    with shared_booth(SMALL, tmp_path_factory.mktemp("data"), opened=disk.open) as opened:
        yield opened


def write_until(booth: Booth, over: Callable[[], bool]) -> None:
    """Let things happen that are written, as they can in any stage, until the disk takes no more."""
    for _ in count():
        if over():
            return
        runner = booth.app.runner
        for kind in (happened.PauseRequested, happened.PauseEnded):
            runner.dispatch(kind(at_ms=runner.now_ms()))


def fill_in(booth: Booth, disk: SmallDisk, stage: Stage) -> None:
    """Bring a visitor to this stage, let the disk fill up there, and wait until it has room and the kiosk is free."""
    go_to(booth.app, stage)
    disk.fill()
    write_until(booth, lambda: booth.screen == "pause")
    disk.empty()
    booth.wait_until(lambda: booth.screen == "attract")


def stored_of(booth: Booth, last: int) -> list[Status | None]:
    """Return how the last sessions ended, once none of them lacks a record."""
    with open_repository(booth.data) as stored:
        sessions = stored.sessions()[-last:]
        for session in sessions:
            records = stored.records(session.id)
            assert [record["seq"] for record in records] == [*range(1, len(records) + 1)]
    return [session.status for session in sessions]


# The visitor of the next stage comes through all stages before it, after the failure in the last one.
@pytest.mark.parametrize("stage", KEPT, ids=lambda stage: stage.value)
def test_a_full_disk_in_any_stage_is_calm_for_the_visitor_and_told_in_the_log(
    booth: Booth, disk: SmallDisk, stage: Stage, caplog: pytest.LogCaptureFixture
) -> None:
    fill_in(booth, disk, stage)
    [told] = caplog.messages
    assert "disk full" in told
    with closing(sqlite3.connect(booth.data / FILE)) as database:
        assert database.execute("PRAGMA integrity_check").fetchall() == [("ok",)]
    # How the last one ended is written once there is another.
    *before, last = stored_of(booth, last=2)
    assert set(before) <= {Status.INTERRUPTED}
    assert last is None
    caplog.clear()


def test_the_visitor_after_a_full_disk_comes_to_the_end(
    booth: Booth, disk: SmallDisk, caplog: pytest.LogCaptureFixture
) -> None:
    fill_in(booth, disk, Stage.GAME)
    booth.click("start-en")
    go_on_to_the_end(booth.app)
    assert stored_of(booth, last=2) == [Status.INTERRUPTED, Status.COMPLETED]
    caplog.clear()


def test_a_disk_that_is_full_before_anything_is_kept_stops_nobody_who_does_not_take_part(
    booth: Booth, disk: SmallDisk, caplog: pytest.LogCaptureFixture
) -> None:
    with open_repository(booth.data) as stored:
        before = stored.sessions()
    go_to(booth.app, Stage.CONSENT)
    disk.fill()
    booth.click("agree")
    assert booth.screen == "pause"
    assert "disk full" in caplog.text
    disk.empty()
    booth.wait_until(lambda: booth.screen == "attract")
    with open_repository(booth.data) as stored:
        assert stored.sessions() == before
    caplog.clear()
