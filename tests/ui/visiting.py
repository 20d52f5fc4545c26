"""A visit in the real window without a hand: what a visitor does arrives as events, in half the time that clicks take.

For tests that only need a session in some stage. The board of the game is to have two cards, which are a pair.
"""

from __future__ import annotations

from collections.abc import Callable

import pytest
from PySide6.QtGui import QGuiApplication

from kiosk.experiment import events as happened
from kiosk.experiment.events import WorldEvent
from kiosk.experiment.outcomes import Stage
from kiosk.game import Position
from kiosk.ui.app import App
from kiosk.ui.event_loop import VirtualClock

PAIR = {"game": {"rows": 1, "columns": 2}, "practice": {"rows": 1, "columns": 2}}
"""Boards of which the first two cards are a pair."""


def go_to(app: App, stage: Stage) -> None:
    """Bring a visitor to this stage."""
    while _stage(app) is not stage:
        _go_on(app)


def go_on_to_the_end(app: App) -> None:
    """Let a visitor finish the session, until the start screen is shown again."""
    while _stage(app) not in {Stage.OVER, Stage.ATTRACT}:
        _go_on(app)
    wait_until(app, lambda: app.screens.kiosk.shown == "attract")


def wait_until(app: App, condition: Callable[[], bool]) -> None:
    """Let time pass, and what comes from other threads land, until something is so."""
    assert isinstance(app.clock, VirtualClock)
    for _ in range(10_000):
        QGuiApplication.processEvents()
        if condition():
            return
        app.clock.jump()
    pytest.fail(f"it never came; the stage is {_stage(app)}")


def _go_on(app: App) -> None:
    match _stage(app):
        case Stage.ATTRACT:
            app.runner.start(app.screens.resting.language)
        case Stage.CONSENT:
            for purpose in app.assigner.study.plans[0].information.consent.purposes:
                _happen(app, happened.ConsentPurposeToggled, purpose=purpose.id, ticked=True)
            _happen(app, happened.ConsentSubmitted)
        case Stage.AGE:
            _happen(app, happened.AgeConfirmed, adult=True)
        case Stage.PRACTICE:
            _happen(app, happened.PracticeSkipped)
        case Stage.GAME:
            for column in range(2):
                _happen(app, happened.CardSelected, position=Position(0, column))
            wait_until(app, lambda: _stage(app) is not Stage.GAME)
        case _:
            _happen(app, happened.ContinuePressed)


def _stage(app: App) -> Stage:
    """Return the stage of the visit; over while the error screen is up."""
    return app.experimenter.actions.stage


def _happen(app: App, kind: type[WorldEvent], **details: object) -> None:
    app.runner.dispatch(kind(at_ms=app.runner.now_ms(), **details))
