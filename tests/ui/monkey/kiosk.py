"""``recollect`` with fingers: ``python -m tests.ui.monkey.kiosk FOLDER`` and then recollect's own arguments.

A virtual screen has no touch device, so the monkey sends what its fingers do as datagrams to FOLDER/fingers, and the
kiosk makes Qt's own touch events of them. In return it sends to FOLDER/answers every event that the session has
handled, by its name, and the stage that followed.
"""

from __future__ import annotations

import json
import socket
import sys
from contextlib import suppress
from pathlib import Path
from unittest.mock import patch

from PySide6.QtCore import QPoint, QSocketNotifier
from PySide6.QtTest import QTest

from kiosk.cli.main import main
from kiosk.experiment.effects import Outcome
from kiosk.experiment.events import AgeConfirmed, Event
from kiosk.experiment.outcomes import Stage
from kiosk.ui.app import App

FINGERS, ANSWERS = "fingers", "answers"
UNDER_AGE = "AgeConfirmed: too young"
LONGEST = 4096


class Reached:
    """What lets the monkey's fingers in, and tells it what came of anything."""

    def __init__(self, app: App, folder: Path) -> None:
        """Listen until the process ends."""
        self._app = app
        self._glass = QTest.createTouchDevice()
        self._down: dict[int, QPoint] = {}
        self._told = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM | socket.SOCK_NONBLOCK)
        self._told_at = str(folder / ANSWERS)
        (folder / FINGERS).unlink(missing_ok=True)
        self._felt = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM | socket.SOCK_NONBLOCK)
        self._felt.bind(str(folder / FINGERS))
        self._notifier = QSocketNotifier(self._felt.fileno(), QSocketNotifier.Type.Read)
        self._notifier.activated.connect(self._feel)
        app.runner.on_event = self._tell

    def _tell(self, event: Event, _outcome: Outcome, stage: Stage) -> None:
        name = UNDER_AGE if isinstance(event, AgeConfirmed) and not event.adult else type(event).__name__
        # The monkey may be gone, or behind.
        with suppress(OSError):
            self._told.sendto(f"{name} {stage.value}".encode(), self._told_at)

    def _feel(self) -> None:
        with suppress(BlockingIOError):
            while True:
                for what, finger, across, down in json.loads(self._felt.recv(LONGEST)):
                    self._move(what, finger, QPoint(across, down))

    def _move(self, what: str, finger: int, place: QPoint) -> None:
        if (what == "press") is (finger in self._down):
            return
        touch = QTest.touchEvent(self._app.window, self._glass, autoCommit=False)
        for other in self._down.keys() - {finger}:
            touch.stationary(other)
        getattr(touch, what)(finger, place, self._app.window)
        if what == "release":
            del self._down[finger]
        else:
            self._down[finger] = place
        touch.commit(processEvents=False)


def run(app: App) -> None:
    """Run as ever, within the monkey's reach."""
    reached.append(Reached(app, FOLDER))
    plain_run(app)


def program(*arguments: str) -> tuple[str, ...]:
    """Return the command of another process of ours: this module again."""
    return (sys.executable, "-m", "tests.ui.monkey.kiosk", str(FOLDER), *arguments)


if __name__ == "__main__":
    FOLDER = Path(sys.argv.pop(1))
    reached: list[Reached] = []
    plain_run = App.run
    with (
        patch("kiosk.ui.app.App.run", run),
        patch("kiosk.cli.run.program", program),
        patch("kiosk.ui.voice.program", program),
    ):
        main()
