"""The kiosk as it is opened for visitors, with the board on its screen; it tells one JSON line for every tap.

Told by lines on its standard input to do so, it lets fingers touch its window: a virtual screen has none.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable, Sequence
from contextlib import closing
from pathlib import Path

from PySide6.QtCore import QPoint, QSocketNotifier
from PySide6.QtGui import QPointingDevice
from PySide6.QtTest import QTest
from Xlib import X
from Xlib.display import Display

from kiosk.cli.log import log_into
from kiosk.config import Settings
from kiosk.ui.app import App
from kiosk.ui.simulated_visitor import find_item, item_centre, lay_out
from kiosk.ui.window import RunMode
from tests.ui.headless import headless

CARDS = 24
STEPS = 8
HELD_MS = 900
BETWEEN_MS = 15


def tell(**what: object) -> None:
    """One line for the watching program."""
    sys.stdout.write(json.dumps(what) + "\n")
    sys.stdout.flush()


def show_board(app: App) -> None:
    """Show a closed board that takes taps, and tell where its cards are."""
    app.screens.board.deal(4, 6, 12, "animals")
    app.screens.kiosk.show("game")
    app.screens.kiosk.end_input_guard()
    app.screens.board.tapped.connect(lambda position: tell(tapped=app.screens.board.location(position)))
    lay_out(app.window)
    cards = [find_item(app.window.contentItem(), f"card-{number}") for number in range(CARDS)]
    ratio = app.window.devicePixelRatio()
    places = [item_centre(card) * ratio for card in cards if card is not None]
    _let_others_watch()
    tell(
        window=int(app.window.winId()),
        places=[(place.x(), place.y()) for place in places],
        display=os.environ["DISPLAY"],
        wayland=os.environ.get("WAYLAND_DISPLAY"),
    )


def _let_others_watch() -> None:
    """Let the watcher reach this server too: cage keeps it for the user who runs it, and refuses to be root's."""
    with closing(Display()) as display:
        display.set_access_control(X.DisableAccess)
        display.sync()


class Fingers:
    """Fingers on the window."""

    def __init__(self, app: App) -> None:
        """Add a touch screen that is not touched yet."""
        self._window = app.window
        self._device: QPointingDevice = QTest.createTouchDevice()

    def move(self, *paths: Sequence[tuple[float, float]], held_ms: int = 0) -> None:
        """Put a finger on the start of each path, all at once, move them along together, and take them off."""
        self._all([path[0] for path in paths], "press")
        if held_ms:
            QTest.qWait(held_ms)
        for step in range(1, STEPS + 1):
            part = step / STEPS
            self._all([_between(path[0], path[-1], part) for path in paths], "move")
            QTest.qWait(BETWEEN_MS)
        self._all([path[-1] for path in paths], "release")

    def _all(self, places: Sequence[tuple[float, float]], what: str) -> None:
        touch = QTest.touchEvent(self._window, self._device)
        for finger, (across, down) in enumerate(places):
            place = QPoint(int(across * (self._window.width() - 1)), int(down * (self._window.height() - 1)))
            getattr(touch, what)(finger, place, self._window)
        touch.commit()


def _between(one: tuple[float, float], other: tuple[float, float], part: float) -> tuple[float, float]:
    return (one[0] + (other[0] - one[0]) * part, one[1] + (other[1] - one[1]) * part)


TOUCHES: dict[str, Callable[[Fingers], None]] = {
    "long press": lambda fingers: fingers.move([(0.3, 0.5)], held_ms=HELD_MS),
    "swipe from the left": lambda fingers: fingers.move([(0.0, 0.5), (0.6, 0.5)]),
    "swipe from the right": lambda fingers: fingers.move([(1.0, 0.5), (0.4, 0.5)]),
    "swipe from above": lambda fingers: fingers.move([(0.5, 0.0), (0.5, 0.6)]),
    "swipe from below": lambda fingers: fingers.move([(0.5, 1.0), (0.5, 0.4)]),
    "two fingers": lambda fingers: fingers.move([(0.3, 0.3), (0.3, 0.8)], [(0.4, 0.3), (0.4, 0.8)]),
    "three fingers": lambda fingers: fingers.move(*([(x, 0.8), (x, 0.2)] for x in (0.2, 0.3, 0.4))),
    "pinch": lambda fingers: fingers.move([(0.1, 0.3), (0.3, 0.5)], [(0.6, 0.8), (0.4, 0.5)]),
}
"""Gestures that mean something to desktops, by name."""


def main(data: Path) -> None:
    """Open the kiosk until its standard input ends."""
    settings = Settings.model_validate({"voice": {"enabled": False, "sounds": False}})
    with headless(settings, data, mode=RunMode()) as app:
        log_into(data)
        fingers = Fingers(app)

        def obey() -> None:
            line = os.read(sys.stdin.fileno(), 4096).decode()
            if not line:
                app.quit()
            for gesture in line.splitlines():
                TOUCHES[gesture](fingers)
                tell(touched=gesture)

        commands = QSocketNotifier(sys.stdin.fileno(), QSocketNotifier.Type.Read)
        commands.activated.connect(obey)
        app.clock.after(1, lambda: show_board(app))
        app.run()


if __name__ == "__main__":
    main(Path(sys.argv[1]))
