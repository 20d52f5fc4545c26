"""A rehearsal: a simulated visitor plays a whole sitting through the real window, with real mouse events.

It looks only at what the screens show and acts only by clicking, so whatever stops a visitor stops it too.
"""

from __future__ import annotations

from random import Random

from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtQuick import QQuickItem, QQuickWindow
from PySide6.QtTest import QTest

from kiosk.study.commands import Command
from kiosk.study.events import Stage, WorldEvent
from kiosk.ui.app import App
from kiosk.ui.rehearsing.pulse import Pulse
from kiosk.ui.rehearsing.shots import Shots
from kiosk.ui.rehearsing.visitor import View, Visitor

LONGEST_MS = 2 * 60 * 60 * 1000
"""A sitting that takes longer than two hours has got stuck."""


class Stuck(Exception):
    """The visitor cannot go on; the message says where, and what was looked for."""


class Rehearsal:
    """One sitting of one simulated visitor."""

    def __init__(self, app: App, seed: int, shots: Shots | None = None) -> None:
        """Play on this kiosk; the same seed plays the same way. ``shots`` takes pictures on the way."""
        self.pulse = Pulse()
        self._app = app
        self._visitor = Visitor(Random(f"{seed}/visitor"))
        self._shots = shots
        self._began = self._over = False
        self._begun_ms = app.clock.now_ms()
        self._stuck: Stuck | None = None
        app.conductor.witness = self._watch

    def run(self) -> None:
        """Play the sitting to its end; raises Stuck if it has none."""
        self._photograph("attract")
        self._think()
        self.pulse.start()
        self._app.run()
        self.pulse.stop()
        if self._stuck is not None:
            raise self._stuck

    def _think(self) -> None:
        self._app.clock.after(self._visitor.think(), self._act)

    def _act(self) -> None:
        if self._over:
            return
        try:
            self._click_what_comes_next()
        except Stuck as stuck:
            self._stuck = stuck
            self._app.quit()
            return
        self._think()

    def _click_what_comes_next(self) -> None:
        if self._app.clock.now_ms() > self._begun_ms + LONGEST_MS:
            raise Stuck(f"after two hours the sitting is still at the screen {self._app.screens.kiosk.shown}")
        match self._app.screens.kiosk.shown:
            case "pause":
                raise Stuck("the kiosk shows its calm screen, because of a failure of the disk or a fault of ours")
            case _ if not self._app.screens.kiosk.takes_input:
                return
            case "attract" if not self._began and self._app.bodies.settled:
                self._began = True
                self._click("start")
            case "introduction" | "result":
                self._click("continue")
            case "questions":
                self._answer()
            case "game" if self._app.screens.board.accepts_taps:
                self._flip()

    def _flip(self) -> None:
        board = self._app.screens.board
        if board.closed:
            row, column = board.marked
            first = next(iter(board.unmatched.values()), None)
            position = self._visitor.choose(View(board.closed, first, row, column))
            self._click(f"card-{board.location(position)}")

    def _answer(self) -> None:
        question = self._app.screens.question
        if question.answer is None:
            self._click(f"answer-{self._visitor.answer(question.scale)}")
        else:
            self._click("continue")

    def _watch(self, _: WorldEvent, commands: tuple[Command, ...], stage: Stage) -> None:
        self._visitor.see(self._app.screens.board.unmatched)
        if self._shots is not None:
            with self.pulse.aside():
                self._shots.watch(commands)
        if stage is Stage.OVER:
            self._over = True
            self._app.quit()

    def _photograph(self, moment: str) -> None:
        if self._shots is not None:
            self._shots.take(moment)

    def _click(self, name: str) -> None:
        """Press and release the left button in the middle of the item of this name."""
        window = self._app.window
        if self._app.screens.kiosk.shown != "game" or find(window.contentItem(), name) is None:
            with self.pulse.aside():
                lay_out(window)
        item = find(window.contentItem(), name)
        if item is None:
            raise Stuck(f"there is no {name!r} on the screen {self._app.screens.kiosk.shown}")
        if not window.geometry().translated(-window.position()).contains(middle(item)):
            raise Stuck(f"{name!r} lies outside the window on the screen {self._app.screens.kiosk.shown}")
        QTest.mouseClick(window, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, middle(item))


def lay_out(window: QQuickWindow) -> None:
    """See that everything is where it belongs: Qt Quick places items only when it draws."""
    window.grabWindow()


def middle(item: QQuickItem) -> QPoint:
    """Where the middle of an item is in its window."""
    return item.mapToScene(QPointF(item.width() / 2, item.height() / 2)).toPoint()


def find(item: QQuickItem, name: str) -> QQuickItem | None:
    """The visible item of this object name; delegates are no children of their view for Qt's own search."""
    if not item.isVisible():
        return None
    if item.objectName() == name:
        return item
    return next((found for child in item.childItems() if (found := find(child, name)) is not None), None)
