"""A kiosk with a PIN, a visitor who can be brought to any stage, and the experimenter's hand."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from functools import cache
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from kiosk.config import Settings
from kiosk.experiment.events import WorldEvent
from kiosk.experiment.experimenter import SALT_BYTES, Action, hash_pin
from kiosk.experiment.outcomes import Stage
from kiosk.experiment.session_config import StudyConfig
from kiosk.robots.driver import RobotDriver
from kiosk.store.database import open_for_reading
from kiosk.study.loader import read_study
from kiosk.ui.app import App
from kiosk.ui.experimenter.view_model import AuthorisationStep, CardScreen, NoteScreen, PanelScreen
from tests.ui.conftest import Booth
from tests.ui.headless import HALF, headless
from tests.ui.visiting import PAIR, go_to, wait_until

PIN = "258013"
LINE = hash_pin(PIN, bytes(SALT_BYTES), cost=10)


class Desk(Booth):
    """A booth with the experimenter at it."""

    close: Callable[[], None]
    """Leaves it."""

    @property
    def card(self) -> CardScreen:
        """The card that asks."""
        return self.app.screens.experimenter.parts[0]

    @property
    def note(self) -> NoteScreen:
        """The note at the edge."""
        return self.app.screens.experimenter.parts[1]

    @property
    def panel(self) -> PanelScreen:
        """The panel."""
        return self.app.screens.experimenter.parts[2]

    @property
    def noted(self) -> str:
        """What the note says."""
        return str(self.note.property("text"))

    @property
    def stage(self) -> Stage:
        """The stage that the booth is in."""
        return self.app.experimenter.actions.stage

    @property
    def notes(self) -> list[tuple[str, dict[str, Any]]]:
        """Everything that was written down of the booth."""
        connection = open_for_reading(self.data)
        rows = connection.execute("SELECT type, payload FROM audit_event ORDER BY id").fetchall()
        connection.close()
        return [(kind, json.loads(body)) for kind, body in rows]

    def shortcut(self, action: Action) -> None:
        """Press the shortcut of an action."""
        sequence = QKeySequence(getattr(self.app.assigner.study.settings.shortcuts, action.value))
        pressed = sequence[0]  # type: ignore[index]  # the stubs do not know that it can
        QTest.keyClick(self.app.window, pressed.key(), pressed.keyboardModifiers())

    def type(self, text: str) -> None:
        """Type on the keyboard, wherever it is."""
        for character in text:
            QTest.keyClick(self.app.window, character)  # type: ignore[call-overload]  # nor that this takes characters

    def enter(self) -> None:
        """Press Enter, at once."""
        QTest.keyClick(self.app.window, Qt.Key.Key_Return)

    def unlock(self) -> None:
        """Give the PIN, if it is asked for."""
        if self.card.asks_for is AuthorisationStep.PIN:
            self.type(PIN)
            self.enter()

    def do(self, action: Action, reason: str = "1") -> None:
        """Press a shortcut, and answer whatever is asked."""
        self.shortcut(action)
        self.unlock()
        if self.card.asks_for is AuthorisationStep.REASON:
            self.type(reason)

    def open_panel(self) -> None:
        """Open the panel, and let it look around."""
        self.do(Action.PANEL)
        assert self.panel.is_open

    def wait_for_note_to_go(self) -> None:
        """Let time pass until nothing is at the screen's edge."""
        self.wait_until(lambda: not self.noted and not self.note.property("dots"))

    def wait_until(self, condition: Callable[[], bool]) -> None:
        """Let time pass, and what comes from other threads land, until something is so."""
        wait_until(self.app, condition)

    def go_to(self, stage: Stage) -> None:
        """Bring a visitor to this stage; over is the error screen."""
        if stage is Stage.OVER:
            self.app.runner.pause()
        go_to(self.app, stage)


class Witness:
    """Writes down what happened in the session."""

    def __init__(self, app: App) -> None:
        self.events: list[WorldEvent] = []
        self.stage = app.experimenter.actions.stage
        """The stage in which it began to look."""
        app.runner.on_event = lambda event, _outcome, _stage: self.events.append(event)

    def saw(self, kind: type[WorldEvent]) -> bool:
        """Whether something of this kind happened."""
        return any(isinstance(event, kind) for event in self.events)


@cache
def _read(sections: str) -> StudyConfig:
    """Return the study of these sections, read once for all tests that have the same."""
    return read_study(Settings.model_validate_json(sections))


MakeDesk = Callable[..., Desk]


@pytest.fixture
def make_assigner(qtbot: QtBot, tmp_path: Path) -> Iterator[MakeDesk]:
    """Build a booth with a PIN; ``sections`` are those of its study file. All are taken down at the end."""
    with ExitStack() as built:

        def make(device: RobotDriver | None = None, data: Path | None = None, **sections: object) -> Desk:
            folder = data or Path(mkdtemp(dir=tmp_path))
            given = {"experimenter": {"pin_hash": LINE}, "randomisation": {"target_n": {}}, **PAIR, **sections}
            stack = built.enter_context(ExitStack())
            condition = None if "randomisation" in sections else "tom"
            study = _read(json.dumps(given))
            app = stack.enter_context(headless(study, folder, condition=condition, mode=HALF, robot=device))
            qtbot.waitUntil(lambda: app.window.isExposed() and app.window.isActive())
            assigner = Desk(app, folder)
            assigner.close = stack.close
            return assigner

        yield make


@pytest.fixture
def assigner(make_assigner: MakeDesk) -> Desk:
    """Return a booth with all stages and a PIN."""
    return make_assigner()
