"""A session that was cut off may go on from the start of the stage it was in; never in the middle of a game."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from kiosk import UserInputError
from kiosk.config import Settings
from kiosk.experiment import events as happened
from kiosk.experiment.events import Event
from kiosk.experiment.outcomes import Stage, Status
from kiosk.experiment.replay import first_difference, replay_events
from kiosk.experiment.transitions import BEFORE_DECIDING, InvalidTransition
from kiosk.store.queries import open_repository
from kiosk.store.recorder import Recorder
from kiosk.store.snapshot import InterruptedSession, read_interrupted_session
from kiosk.store.verify import verify
from kiosk.ui.app import App
from kiosk.ui.rehearsal import Rehearsal
from tests.ui.headless import HALF, headless

SMALL = Settings.model_validate(
    {
        "game": {"rows": 2, "columns": 2},
        "practice": {"rows": 2, "columns": 2},
        "languages": ["it"],
        "questionnaires": ["trust"],
    }
)
RESUMABLE = [stage for stage in Stage if stage not in {*BEFORE_DECIDING, Stage.ATTRACT, Stage.GAME, Stage.OVER}]


class Until(Rehearsal):
    """A visitor who is there until a stage, or, where ``joins`` is set, from wherever the session is."""

    def __init__(self, app: App, stage: Stage | None, *, joins: bool = False) -> None:
        super().__init__(app, 1)
        self._until = stage
        self._began = joins

    def _do_what_comes_next(self) -> None:
        if self._app.runner.stage is self._until:
            self._app.quit()
        else:
            super()._do_what_comes_next()


def cut_off(data: Path, stage: Stage, qtbot: QtBot, *, crash: bool) -> None:
    """Leave a session behind in this stage: by a crash, or by closing the kiosk."""
    with headless(SMALL, data, mode=HALF) as app:
        qtbot.waitUntil(app.window.isExposed)
        Until(app, stage).run()
        assert app.runner.stage is stage
        if crash:
            # What a killed process leaves: no word of the end.
            app.runner._session = None
    with Recorder(data):
        pass


def read(data: Path) -> InterruptedSession:
    """Return the first session, as the kiosk reads it."""
    found = read_interrupted_session(data, 1)
    assert isinstance(found, InterruptedSession)
    return found


@pytest.mark.parametrize("crash", [True, False], ids=["killed", "closed"])
@pytest.mark.parametrize("stage", RESUMABLE, ids=lambda stage: stage.value)
def test_a_session_goes_on_from_the_start_of_its_stage_to_its_end(
    stage: Stage, tmp_path: Path, qtbot: QtBot, *, crash: bool
) -> None:
    cut_off(tmp_path, stage, qtbot, crash=crash)
    cut = read(tmp_path)
    with headless(SMALL, tmp_path, mode=HALF) as app:
        qtbot.waitUntil(app.window.isExposed)
        app.runner.resume(cut.session, cut.number, cut.past)
        assert app.runner.stage is stage
        Until(app, None, joins=True).run()
    with open_repository(tmp_path) as stored:
        events: list[Event] = stored.story(1)
        plan, seed = stored.plan(1), stored.seed(1)
        [session] = stored.sessions()
    assert session.status is Status.COMPLETED
    assert session.pairs == 2
    resumed = next(i for i, event in enumerate(events) if isinstance(event, happened.SessionResumed))
    assert events[resumed + 1] == happened.StageEntered(at_ms=events[resumed].at_ms, stage=stage)
    assert all(one.at_ms <= other.at_ms for one, other in pairwise(events))
    assert first_difference(replay_events(plan, seed, events), events) is None
    assert verify(tmp_path) == []


def test_a_game_is_not_gone_on_with(tmp_path: Path, qtbot: QtBot) -> None:
    cut_off(tmp_path, Stage.GAME, qtbot, crash=True)
    cut = read(tmp_path)
    with headless(SMALL, tmp_path, mode=HALF) as app:
        qtbot.waitUntil(app.window.isExposed)
        with pytest.raises(InvalidTransition):
            app.runner.resume(cut.session, cut.number, cut.past)
        assert app.runner.stage is Stage.ATTRACT
        Rehearsal(app, 2).run()


def test_a_session_that_came_to_its_end_is_not_gone_on_with(tmp_path: Path, qtbot: QtBot) -> None:
    with headless(SMALL, tmp_path, mode=HALF) as app:
        qtbot.waitUntil(app.window.isExposed)
        Rehearsal(app, 1).run()
        cut = read(tmp_path)
        with pytest.raises((InvalidTransition, UserInputError)):
            app.runner.resume(cut.session, cut.number, cut.past)
        assert app.runner.stage is Stage.ATTRACT
