"""A rehearsal: a simulated visitor goes through a whole sitting at the real window, with real mouse events.

It looks only at what the screens show and acts only with its hand, so whatever stops a visitor stops it too.
"""

from __future__ import annotations

import traceback
from collections import deque
from collections.abc import Callable
from pathlib import Path
from random import Random

from PySide6.QtQuick import QQuickWindow

from kiosk.study import commands as do
from kiosk.study.commands import Command
from kiosk.study.declared.questionnaire import Item
from kiosk.study.events import Stage, WorldEvent
from kiosk.ui.app import App
from kiosk.ui.rehearsing.filling import Errand, Filling
from kiosk.ui.rehearsing.hand import Aside, Hand, Stuck
from kiosk.ui.rehearsing.pulse import Pulse
from kiosk.ui.rehearsing.shots import Shots
from kiosk.ui.rehearsing.visitor import Character, Manner, View, Visitor

LONGEST_MS = 2 * 60 * 60 * 1000
"""A sitting that takes longer than two hours has got stuck."""

_DECIDING = ("attract", "consent", "age")
"""Where even the hasty look at what they tap."""

_LINGERING = frozenset({Stage.CONSENT, Stage.ABOUT_YOU, Stage.PRACTICE, Stage.GAME, Stage.QUESTIONS})
"""Stages that whoever leaves them leaves in the middle."""


_USUAL = Character()

MakeHand = Callable[[QQuickWindow, Aside], Hand]
"""Gives a visitor the hand to work a window with."""


class Rehearsal:
    """One sitting of one simulated visitor."""

    def __init__(
        self,
        app: App,
        seed: int,
        shots: Shots | None = None,
        visitor: Character = _USUAL,
        hand: MakeHand = Hand,
    ) -> None:
        """Go through it on this kiosk; the same seed does the same things.

        ``shots`` takes pictures on the way; ``hand`` reaches what a visitor wants in another way than with a mouse.
        """
        self.pulse = Pulse()
        self._app = app
        self._manner = visitor.manner
        self._leaves_in = visitor.leaves_in if visitor.manner is Manner.LEAVES else None
        self._language = visitor.language or app.screens.resting.language
        chance = Random(f"{seed}/visitor")
        self._chance = chance
        self._visitor = Visitor(chance)
        self._hand = hand(app.window, self.pulse.aside)
        self._filling = Filling(self._hand, chance, hasty=visitor.manner is Manner.HASTY)
        self._page: object = None
        self._errands: deque[Errand] = deque()
        self._shots = shots
        self._stage = Stage.ATTRACT
        self._acts = 0
        self._practises: bool | None = None
        self._began = self._over = False
        self._begun_ms = app.clock.now_ms()
        self._stuck: Stuck | None = None
        app.conductor.witness = self._watch
        app.on_fault = self._fail

    def run(self) -> None:
        """Go through the sitting to its end; raises Stuck if it has none."""
        if self._shots is not None:
            self._shots.take("attract")
        self._think()
        self.pulse.start()
        if self._stuck is None:
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
            self._check_time()
            if not self._is_gone():
                self._do_what_comes_next()
        except Stuck as stuck:
            self._give_up(stuck)
            return
        self._think()

    def _fail(self, fault: BaseException) -> None:
        """A fault ends the rehearsal: whoever acts next may be the one that it came from."""
        where = traceback.extract_tb(fault.__traceback__)[-1:]
        at = "".join(f" ({Path(frame.filename).name}, line {frame.lineno})" for frame in where)
        self._give_up(Stuck(f"there was a fault in Recollect, {type(fault).__name__}: {fault}{at}"))

    def _give_up(self, stuck: Stuck) -> None:
        if self._stuck is None:
            self._stuck = Stuck(f"{stuck}, on the screen {self._app.screens.kiosk.shown}")
        self._app.quit()

    def _check_time(self) -> None:
        if self._app.clock.now_ms() > self._begun_ms + LONGEST_MS:
            raise Stuck("the sitting has taken two hours")

    def _is_gone(self) -> bool:
        patience = 1 if self._stage in _LINGERING else 0
        return self._stage is self._leaves_in and self._acts >= patience

    def _do_what_comes_next(self) -> None:
        kiosk = self._app.screens.kiosk
        if kiosk.shown == "pause":
            raise Stuck("the disk did not take what happened")
        if not kiosk.takes_input:
            return
        self._acts += 1
        if kiosk.covered:
            self._answer_the_cover()
        elif self._manner is Manner.HASTY and kiosk.shown not in _DECIDING and self._visitor.tosses():
            self._hand.tap_anywhere(self._chance)
        else:
            self._go_on(kiosk.shown)

    def _answer_the_cover(self) -> None:
        if self._hand.sees("still-here"):
            self._click("still-here")

    def _go_on(self, shown: str) -> None:
        match shown:
            case "attract" if not self._began and self._app.bodies.settled:
                self._began = True
                self._click(f"start-{self._language}")
            case "about" | "introduction" | "result" | "debrief":
                self._click("continue")
            case "thanks" if self._visitor.tosses():
                self._click("continue")
            case "consent":
                self._decide()
            case "age":
                self._click("age-no" if self._manner is Manner.UNDER_AGE else "age-yes")
            case "form":
                self._fill_in()
            case "practice" | "game":
                self._play(shown)

    def _decide(self) -> None:
        """Agree, once all that has to be is ticked; the hasty try it before."""
        consent = self._app.screens.consent
        if self._manner is Manner.DECLINES:
            self._click("decline")
        elif self._manner is Manner.HASTY and self._page is not consent:
            self._page = consent
            self._click("agree")
        elif consent.needed:
            self._click(f"purpose-{min(consent.needed)}")
        else:
            self._click("agree")

    def _fill_in(self) -> None:
        items = self._app.screens.form.shown
        if items is not self._page:
            self._page = items
            self._errands = deque(self._filling.errands(self._wanted()))
        if self._errands:
            self._errands.popleft()()
        else:
            self._click("continue")

    def _wanted(self) -> tuple[Item, ...]:
        """The items that this visitor answers."""
        items = self._app.screens.form.shown
        if self._manner is not Manner.HASTY:
            return items
        return tuple(item for item in items if getattr(item, "required", False))

    def _will_practise(self) -> bool:
        if self._practises is None:
            likes = self._leaves_in is Stage.PRACTICE or self._visitor.tosses()
            self._practises = self._manner is not Manner.HASTY and likes
        return self._practises

    def _play(self, shown: str) -> None:
        board = self._app.screens.board
        if shown == "practice" and not self._will_practise():
            self._click("skip")
        elif board.accepts_taps and board.closed:
            row, column = board.marked
            first = next(iter(board.unmatched.values()), None)
            position = self._visitor.choose(View(board.closed, first, row, column))
            self._click(f"card-{board.location(position)}")

    def _watch(self, _: WorldEvent, commands: tuple[Command, ...], stage: Stage) -> None:
        if stage is not self._stage:
            self._stage, self._acts = stage, 0
        if any(isinstance(command, do.ShowBoard) for command in commands):
            self._visitor.sit_down()
        self._visitor.see(self._app.screens.board.unmatched)
        if self._shots is not None:
            with self.pulse.aside():
                self._shots.watch(commands, stage)
        if stage is Stage.OVER:
            self._over = True
            self._app.quit()

    def _click(self, name: str) -> None:
        """Click on the item of this name, or click it twice if in a hurry."""
        act = self._hand.double_click if self._manner is Manner.HASTY else self._hand.click
        act(name)
