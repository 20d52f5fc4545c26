"""``recollect`` with a visitor inside who plays up to a stage, and a kiosk that breaks when asked to.

``python -m tests.ui.kept_kiosk STAGE MARKER`` and then recollect's own arguments: the kiosk that finds no MARKER makes
it and lets the visitor in; later ones are left alone. SIGUSR1 raises in the event loop, SIGUSR2 never gives it back.
"""

from __future__ import annotations

import signal
import sys
from pathlib import Path
from unittest.mock import patch

from PySide6.QtCore import QTimer

from kiosk.cli.main import main
from kiosk.ui.app import App
from kiosk.ui.rehearsal import Rehearsal

HASTE_MS = 100
"""How long the visitor thinks; nothing is measured here."""
STAGE, MARKER = sys.argv[1], Path(sys.argv[2])


class Guest(Rehearsal):
    """Plays until the stage comes, and then stands there."""

    def _think(self) -> None:
        # A fault may strike while a click is still at work.
        if self._app.runner.stage.value != STAGE and self._app.screens.kiosk.shown != "pause":
            self._app.clock.after(HASTE_MS, self._act)

    def _fail(self, fault: BaseException) -> None:
        """Stay: this kiosk is to mend itself."""


def fault() -> None:
    """Raise a fault of ours."""
    raise RuntimeError("a fault on purpose")


def fault_soon(*_: object) -> None:
    """Raise a fault in the event loop itself, not in whatever Python is at just now."""
    QTimer.singleShot(0, fault)


def endless(*_: object) -> None:
    """Loop without an end."""
    while True:
        pass


def run(app: App) -> None:
    """Run as ever, with the visitor inside if it is the first time."""
    signal.signal(signal.SIGUSR1, fault_soon)
    signal.signal(signal.SIGUSR2, endless)
    if not MARKER.exists():
        MARKER.touch()
        guest = Guest(app, 1)
        guest._think()
    plain_run(app)


def program(*arguments: str) -> tuple[str, ...]:
    """Return the command of another process of ours: this module again."""
    return (sys.executable, "-m", "tests.ui.kept_kiosk", STAGE, str(MARKER), *arguments)


if __name__ == "__main__":
    del sys.argv[1:3]
    plain_run = App.run
    with (
        patch("kiosk.ui.app.App.run", run),
        patch("kiosk.cli.run.program", program),
        patch("kiosk.ui.voice.program", program),
    ):
        main()
