"""A disk that is full, in whatever stage: the visitor sees an error screen, the log tells of it, nothing is torn."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable
from contextlib import closing
from itertools import count

import pytest

from kiosk.config import Settings
from kiosk.experiment import events as happened
from kiosk.experiment.outcomes import Stage, Status
from kiosk.experiment.transitions import BEFORE_DECIDING
from kiosk.store.database import FILE
from kiosk.store.queries import open_repository
from kiosk.ui.rehearsal import Rehearsal
from kiosk.ui.window import RunMode
from tests.ui.conftest import Booth, MakeBooth
from tests.ui.headless import HALF
from tests.ui.small_disk import SmallDisk

SMALL = Settings.model_validate(
    {
        "game": {"rows": 2, "columns": 2},
        "practice": {"rows": 2, "columns": 2},
        "languages": ["en"],
        "questionnaires": ["trust"],
    }
)
KEPT = [stage for stage in Stage if stage not in {*BEFORE_DECIDING, Stage.ATTRACT, Stage.OVER}]


@pytest.fixture
def run_mode() -> RunMode:
    """Return a mode in which sessions are drawn faster: nothing here is about how they look."""
    return HALF


@pytest.fixture
def disk() -> SmallDisk:
    """Return the disk under the booth."""
    return SmallDisk()


@pytest.fixture
def booth(make_booth: MakeBooth, disk: SmallDisk) -> Booth:
    """Return a booth on a disk that can be full."""
    return make_booth(settings=SMALL, opened=disk.open)


def go_to(booth: Booth, stage: Stage) -> None:
    """Have a visitor come to this stage and no further."""

    class Visitor(Rehearsal):
        def _do_what_comes_next(self) -> None:
            if self._app.runner.stage is stage:
                self._app.quit()
            else:
                super()._do_what_comes_next()

    Visitor(booth.app, 1).run()
    assert booth.app.runner.stage is stage


def write_until(booth: Booth, over: Callable[[], bool]) -> None:
    """Let things happen that are written, as they can in any stage, until the disk takes no more."""
    for _ in count():
        if over():
            return
        runner = booth.app.runner
        for kind in (happened.PauseRequested, happened.PauseEnded):
            runner.dispatch(kind(at_ms=runner.now_ms()))


@pytest.mark.parametrize("stage", KEPT, ids=lambda stage: stage.value)
def test_a_full_disk_in_any_stage_is_calm_for_the_visitor_and_told_in_the_log(
    booth: Booth, disk: SmallDisk, stage: Stage, caplog: pytest.LogCaptureFixture
) -> None:
    go_to(booth, stage)
    disk.fill()
    write_until(booth, lambda: booth.screen == "pause")
    [told] = caplog.messages
    assert "disk full" in told
    with closing(sqlite3.connect(booth.data / FILE)) as database:
        assert database.execute("PRAGMA integrity_check").fetchall() == [("ok",)]
    disk.empty()
    booth.wait_until(lambda: booth.screen == "attract")
    booth.rehearse(seed=2)
    with open_repository(booth.data) as stored:
        assert [session.status for session in stored.sessions()] == [Status.INTERRUPTED, Status.COMPLETED]
        for session in (1, 2):
            assert [record["seq"] for record in stored.records(session)] == [
                *range(1, len(stored.records(session)) + 1)
            ]
    caplog.clear()


def test_a_disk_that_is_full_before_anything_is_kept_stops_nobody_who_does_not_take_part(
    booth: Booth, disk: SmallDisk, caplog: pytest.LogCaptureFixture
) -> None:
    go_to(booth, Stage.CONSENT)
    for purpose in ("take_part", "store"):
        booth.click(f"purpose-{purpose}")
    disk.fill()
    booth.click("agree")
    assert booth.screen == "pause"
    assert "disk full" in caplog.text
    disk.empty()
    booth.wait_until(lambda: booth.screen == "attract")
    with open_repository(booth.data) as stored:
        assert stored.sessions() == []
    caplog.clear()
