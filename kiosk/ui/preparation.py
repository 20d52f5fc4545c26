"""What a start leaves out, done bit by bit once the start screen can be tapped.

Whatever needs one of these before its turn loads it itself, only a little later.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import partial
from importlib import import_module

from PySide6.QtCore import QObject, QTimer
from PySide6.QtQuick import QQuickWindow

from kiosk.assistance.wording import Catalogue
from kiosk.ui.screens.debrief import draw_first_code

MODULES = (
    *("attr", "cattrs", "kiosk.experiment.page_stages", "kiosk.experiment.questionnaire_stage"),
    *("kiosk.experiment.game_stage", "kiosk.experiment.practice_stage", "kiosk.experiment.session"),
    *("babel.dates", "fluent.runtime", "kiosk.assistance.fluent_messages", "http.client", "segno"),
)
"""What is loaded in turn; large ones are split, so that no picture waits long for one."""

_FORMED = "game-pairs"
"""A message with numbers, for which Fluent reads the rules of its language."""


class Preparation:
    """Takes one step whenever the event loop has nothing else to do."""

    def __init__(self, owner: QObject, steps: Iterable[Callable[[], object]]) -> None:
        """Begin at the loop's next turn; it ends with ``owner``."""
        self._steps = iter(steps)
        # A child of the owner, and kept, for Qt alone does not keep alive whom it calls back.
        self._timer = QTimer(owner)
        self._timer.timeout.connect(self._go_on)
        self._timer.start(0)

    @property
    def done(self) -> bool:
        """Whether every step was taken."""
        return not self._timer.isActive()

    def _go_on(self) -> None:
        step = next(self._steps, None)
        if step is None:
            self._timer.stop()
        else:
            step()


def steps_of(window: QQuickWindow, catalogues: Iterable[Catalogue]) -> Iterator[Callable[[], object]]:
    """Yield what a session needs and the start screen does not."""
    # The pages are then made in the time between frames.
    for pages in ("prepares", "preparesParts"):
        yield partial(window.setProperty, pages, True)  # noqa: FBT003 - Qt's own
    for name in MODULES:
        yield partial(import_module, name)
    for catalogue in catalogues:
        yield partial(catalogue.text, _FORMED, found=1, all=2)
    yield draw_first_code
