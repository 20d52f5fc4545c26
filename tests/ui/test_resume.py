"""A session that was cut off may go on from the start of the stage it was in; never in the middle of a game."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import pytest
from PySide6.QtGui import QGuiApplication
from pytestqt.qtbot import QtBot

from kiosk import UserInputError
from kiosk.config import Settings
from kiosk.experiment import events as happened
from kiosk.experiment.events import Event, WorldEvent
from kiosk.experiment.outcomes import SessionKind, Stage, Status
from kiosk.experiment.replay import first_difference, replay_events
from kiosk.experiment.transitions import BEFORE_DECIDING, InvalidTransition
from kiosk.store.queries import open_repository
from kiosk.store.recorder import Provenance, Recorder
from kiosk.store.snapshot import InterruptedSession, read_interrupted_session
from kiosk.store.verify import verify
from kiosk.ui.app import App
from kiosk.ui.rehearsal import Rehearsal
from tests.ui.headless import HALF, headless, often
from tests.ui.visiting import PAIR, go_on_to_the_end, go_to

SMALL = often(Settings.model_validate({"languages": ["it"], "questionnaires": ["trust"], **PAIR}))
RESUMABLE = [stage for stage in Stage if stage not in {*BEFORE_DECIDING, Stage.ATTRACT, Stage.GAME, Stage.OVER}]


class Joining(Rehearsal):
    """A visitor who goes on from wherever the session is."""

    def __init__(self, app: App) -> None:
        super().__init__(app, 1)
        self._began = True


@dataclass(frozen=True)
class Played:
    """A session that was played to its end, and what it followed."""

    provenance: Provenance
    events: list[Event]

    def cut_off(self, data: Path, stage: Stage) -> None:
        """Leave behind what a process leaves that is killed in this stage: no word of the end."""
        entered = next(
            number
            for number, event in enumerate(self.events)
            if isinstance(event, happened.StageEntered) and event.stage is stage
        )
        # What follows from the event that led there was stored with it.
        end = next(
            number for number, event in enumerate(self.events) if number > entered and isinstance(event, WorldEvent)
        )
        with Recorder(data) as recorder:
            recorder.begin(self.provenance, self.events[:end])
        with Recorder(data):
            pass


@pytest.fixture(scope="module")
def played(qapp: QGuiApplication, tmp_path_factory: pytest.TempPathFactory) -> Played:  # noqa: ARG001 - Qt is there
    """Return a session that nothing cut off."""
    data = tmp_path_factory.mktemp("played")
    with headless(SMALL, data, mode=HALF) as app:
        Rehearsal(app, 1).run()
    with open_repository(data) as stored:
        followed = Provenance(
            stored.plan(1), stored.seed(1), stored.session(1).embodiment, "a test", kind=SessionKind.SIMULATED
        )
        return Played(followed, stored.story(1))


def read(data: Path) -> InterruptedSession:
    """Return the first session, as the kiosk reads it."""
    found = read_interrupted_session(data, 1)
    assert isinstance(found, InterruptedSession)
    return found


def resume(app: App, data: Path, stage: Stage) -> None:
    """Go on with the session that was cut off in this stage."""
    cut = read(data)
    app.runner.resume(cut.session, cut.number, cut.past)
    assert app.runner.stage is stage


def assert_whole(data: Path, resumed_in: Sequence[Stage]) -> None:
    """Assert that the session came to its end, with no gap where it went on in these stages."""
    with open_repository(data) as stored:
        events: list[Event] = stored.story(1)
        plan, seed = stored.plan(1), stored.seed(1)
        [session] = stored.sessions()
    assert session.status is Status.COMPLETED
    assert session.pairs == 1
    resumed = [number for number, event in enumerate(events) if isinstance(event, happened.SessionResumed)]
    assert [events[number + 1] for number in resumed] == [
        happened.StageEntered(at_ms=events[number].at_ms, stage=stage)
        for number, stage in zip(resumed, resumed_in, strict=True)
    ]
    assert all(one.at_ms <= other.at_ms for one, other in pairwise(events))
    assert first_difference(replay_events(plan, seed, events), events) is None
    assert verify(data) == []


@pytest.mark.parametrize("stage", RESUMABLE, ids=lambda stage: stage.value)
def test_a_session_that_was_killed_goes_on_from_the_start_of_its_stage_to_its_end(
    stage: Stage, played: Played, tmp_path: Path, qtbot: QtBot
) -> None:
    played.cut_off(tmp_path, stage)
    with headless(SMALL, tmp_path, mode=HALF) as app:
        qtbot.waitUntil(app.window.isExposed)
        resume(app, tmp_path, stage)
        Joining(app).run()
    assert_whole(tmp_path, [stage])


def test_a_session_goes_on_after_the_kiosk_was_closed_in_one_stage_after_the_other(
    tmp_path: Path, qtbot: QtBot
) -> None:
    closed_in: list[Stage] = []
    for stage in (*RESUMABLE, Stage.OVER):
        with headless(SMALL, tmp_path, mode=HALF) as app:
            qtbot.waitUntil(app.window.isExposed)
            if closed_in:
                resume(app, tmp_path, closed_in[-1])
            if stage is Stage.OVER:
                go_on_to_the_end(app)
            else:
                go_to(app, stage)
        with Recorder(tmp_path):
            pass
        closed_in.append(stage)
    assert_whole(tmp_path, RESUMABLE)


def test_a_game_is_not_gone_on_with(played: Played, tmp_path: Path, qtbot: QtBot) -> None:
    played.cut_off(tmp_path, Stage.GAME)
    cut = read(tmp_path)
    with headless(SMALL, tmp_path, mode=HALF) as app:
        qtbot.waitUntil(app.window.isExposed)
        with pytest.raises(InvalidTransition):
            app.runner.resume(cut.session, cut.number, cut.past)
        assert app.runner.stage is Stage.ATTRACT
        go_to(app, Stage.THANKS)
        go_on_to_the_end(app)


def test_a_session_that_came_to_its_end_is_not_gone_on_with(tmp_path: Path, qtbot: QtBot) -> None:
    with headless(SMALL, tmp_path, mode=HALF) as app:
        qtbot.waitUntil(app.window.isExposed)
        go_to(app, Stage.THANKS)
        go_on_to_the_end(app)
        cut = read(tmp_path)
        with pytest.raises((InvalidTransition, UserInputError)):
            app.runner.resume(cut.session, cut.number, cut.past)
        assert app.runner.stage is Stage.ATTRACT
