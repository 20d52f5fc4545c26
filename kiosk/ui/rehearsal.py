"""Rehearse a session without a person."""

from __future__ import annotations

import traceback
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from random import Random
from time import monotonic

from PySide6.QtCore import QObject, Qt, QTimer
from PySide6.QtQuick import QQuickWindow

from kiosk.experiment import effects as do
from kiosk.experiment.effects import Outcome
from kiosk.experiment.events import WorldEvent
from kiosk.experiment.information import PUBLISHING, RETURNING
from kiosk.experiment.outcomes import Stage
from kiosk.experiment.questionnaire import Item
from kiosk.store.codes import ALPHABET
from kiosk.ui.app import App
from kiosk.ui.screenshots import Screenshots
from kiosk.ui.simulated_visitor import (
    Aside,
    BehaviourKind,
    BehaviourProfile,
    BoardView,
    Errand,
    FormFiller,
    SimulatedParticipant,
    UiDriver,
    UiTimeout,
)
from kiosk.units import MS_PER_SECOND

EVERY_MS = 5


class LatencyMonitor(QObject):
    """A timer that wishes to be called every EVERY_MS, and keeps how late it was called at the worst."""

    def __init__(self) -> None:
        super().__init__()
        self.longest_ms = 0.0
        """The longest time between two beats, in ms; a free loop reaches EVERY_MS and a little more."""
        self._last: float | None = None
        self._timer = QTimer(self)
        self._timer.setTimerType(Qt.TimerType.PreciseTimer)
        self._timer.setInterval(EVERY_MS)
        self._timer.timeout.connect(self._beat)

    def start(self) -> None:
        """Count from the first beat on: what is done before the loop runs is not the loop's."""
        self._last = None
        self._timer.start()

    def stop(self) -> None:
        """Count no more."""
        self._timer.stop()

    @contextmanager
    def aside(self) -> Iterator[None]:
        """Leave out what happens meanwhile, which is not the interface's doing."""
        begun = monotonic()
        yield
        if self._last is not None:
            self._last += monotonic() - begun

    def _beat(self) -> None:
        now = monotonic()
        if self._last is not None:
            self.longest_ms = max(self.longest_ms, (now - self._last) * MS_PER_SECOND)
        self._last = now


LONGEST_MS = 2 * 60 * 60 * 1000
"""A session that takes longer than two hours has got stuck."""

_DECIDING = ("attract", "consent", "age")
"""Where even the hasty look at what they tap."""

_LINGERING = frozenset({Stage.CONSENT, Stage.ABOUT_YOU, Stage.PRACTICE, Stage.GAME, Stage.QUESTIONS})
"""Stages that a visitor who leaves them leaves in the middle."""


_USUAL = BehaviourProfile()

MakeHand = Callable[[QQuickWindow, Aside], UiDriver]
"""Gives a visitor the hand to work a window with."""


class Rehearsal:
    """One session of one simulated visitor."""

    def __init__(
        self,
        app: App,
        seed: int,
        shots: Screenshots | None = None,
        visitor: BehaviourProfile = _USUAL,
        hand: MakeHand = UiDriver,
    ) -> None:
        """Go through it on this kiosk; the same seed does the same things.

        ``shots`` takes pictures on the way; ``hand`` reaches what a visitor wants in another way than with a mouse.
        """
        self.pulse = LatencyMonitor()
        self._app = app
        self._manner = visitor.manner
        self._leaves_in = visitor.leaves_in if visitor.manner is BehaviourKind.LEAVES else None
        self._also = [PUBLISHING] + [RETURNING] * visitor.links
        """What they still agree to, where it is up to them."""
        self._code = [each for each in visitor.code.upper() if each in ALPHABET]
        """What they still have to type of their code."""
        self.code = ""
        """What the visitor can come back with, once they saw it."""
        self._language = visitor.language or app.screens.resting.language
        chance = Random(f"{seed}/visitor")
        self._chance = chance
        self._visitor = SimulatedParticipant(chance, visitor.memory)
        self._hand = hand(app.window, self.pulse.aside)
        self._filling = FormFiller(self._hand, chance, hasty=visitor.manner is BehaviourKind.HASTY)
        self._page: object = None
        self._errands: deque[tuple[str, Errand]] = deque()
        self._begun: set[str] = set()
        """The items of the page that were begun; an item that was hidden and comes again is answered again."""
        self._shots = shots
        self._stage = Stage.ATTRACT
        self._acts = 0
        self._practises: bool | None = None
        self._began = self._over = False
        self._begun_ms = app.clock.now_ms()
        self._stuck: UiTimeout | None = None
        app.runner.on_event = self._watch
        app.on_fault = self._fail

    def run(self) -> None:
        """Go through the session to its end; raises UiTimeout if it has none."""
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
        except UiTimeout as stuck:
            self._give_up(stuck)
            return
        self._think()

    def _fail(self, fault: BaseException) -> None:
        """End the rehearsal at a fault: the next actor may be the one that it came from."""
        where = traceback.extract_tb(fault.__traceback__)[-1:]
        at = "".join(f" ({Path(frame.filename).name}, line {frame.lineno})" for frame in where)
        self._give_up(UiTimeout(f"there was a fault in Recollect, {type(fault).__name__}: {fault}{at}"))

    def _give_up(self, stuck: UiTimeout) -> None:
        if self._stuck is None:
            self._stuck = UiTimeout(f"{stuck}, on the screen {self._app.screens.kiosk.shown}")
        self._app.quit()

    def _check_time(self) -> None:
        if self._app.clock.now_ms() > self._begun_ms + LONGEST_MS:
            raise UiTimeout("the session has taken two hours")

    def _is_gone(self) -> bool:
        patience = 1 if self._stage in _LINGERING else 0
        return self._stage is self._leaves_in and self._acts >= patience

    def _do_what_comes_next(self) -> None:
        kiosk = self._app.screens.kiosk
        if kiosk.shown == "pause":
            raise UiTimeout("the disk did not take what happened")
        if not kiosk.takes_input:
            return
        self._acts += 1
        if kiosk.covered:
            self._answer_the_cover()
        elif self._is_restless() and self._visitor.tosses():
            self._hand.tap_anywhere(self._chance)
        else:
            self._go_on(kiosk.shown)

    def _is_restless(self) -> bool:
        """Whether the visitor may tap anywhere now; beside the keys on the screen, that would take them away."""
        may = self._manner is BehaviourKind.HASTY and self._app.screens.kiosk.shown not in _DECIDING
        return may and not self._hand.is_visible("key-done")

    def _answer_the_cover(self) -> None:
        if self._hand.is_visible("still-here"):
            self._click("still-here")
        elif self._hand.is_visible("return-on"):
            self._click("return-on")
        elif self._hand.is_visible("return-go"):
            self._click(f"code-{self._code.pop(0)}" if self._code else "return-go")

    def _go_on(self, shown: str) -> None:
        match shown:
            case "attract" if not self._began and self._app.embodiments.settled:
                self._began = True
                self._click(f"start-{self._language}")
            case "about" | "introduction" | "result" | "debrief":
                self._click(self._way_on)
            case "thanks" if self._visitor.tosses():
                self._click("continue")
            case "consent":
                self._decide()
            case "age":
                self._click("age-no" if self._manner is BehaviourKind.UNDER_AGE else "age-yes")
            case "form":
                self._fill_in()
            case "practice" | "game":
                self._play(shown)

    @property
    def _way_on(self) -> str:
        """The button that a visitor goes on with, who types a code first if they have one."""
        return "return-offer" if self._code and self._hand.is_visible("return-offer") else "continue"

    def _decide(self) -> None:
        """Agree, once all that has to be is ticked; the hasty try it before."""
        consent = self._app.screens.consent
        if self._manner is BehaviourKind.DECLINES:
            self._click("decline")
        elif self._manner is BehaviourKind.HASTY and self._page is not consent:
            self._page = consent
            self._click("agree")
        elif consent.needed:
            self._click(f"purpose-{min(consent.needed)}")
        elif self._also and self._manner is not BehaviourKind.HASTY:
            purpose = self._also.pop(0)
            if self._hand.is_visible(f"purpose-{purpose}") and purpose not in consent.ticked_purposes:
                self._click(f"purpose-{purpose}")
        else:
            if self._shots is not None and consent.ticked_purposes:
                with self.pulse.aside():
                    self._shots.take("ticked")
            self._click("agree")

    def _fill_in(self) -> None:
        form = self._app.screens.form
        if form.page_items is not self._page:
            self._page = form.page_items
            self._errands.clear()
            self._begun.clear()
        shown = {item.id for item in form.shown}
        self._begun &= shown
        self._errands = deque(errand for errand in self._errands if errand[0] in shown)
        fresh = tuple(item for item in self._wanted() if item.id not in self._begun)
        if fresh:
            conditional = any(item.relevant for item in form.page_items)
            self._errands.extend(self._filling.errands(fresh, more=conditional))
            self._begun |= {item.id for item in fresh}
        if self._errands:
            _, errand = self._errands.popleft()
            errand()
        else:
            self._click("continue")

    def _wanted(self) -> tuple[Item, ...]:
        """Return the items that this visitor answers."""
        items = self._app.screens.form.shown
        if self._manner is not BehaviourKind.HASTY:
            return items
        return tuple(item for item in items if getattr(item, "required", False) is True)

    def _will_practise(self) -> bool:
        if self._practises is None:
            likes = self._leaves_in is Stage.PRACTICE or self._visitor.tosses()
            self._practises = self._manner is not BehaviourKind.HASTY and likes
        return self._practises

    def _play(self, shown: str) -> None:
        board = self._app.screens.board
        if shown == "practice" and not board.property("practice"):
            # The board is cleared for the game a moment before the game's screen comes.
            return
        if shown == "practice" and not self._will_practise():
            self._click("skip")
        elif board.accepts_taps and board.closed:
            marked, nowhere = board.highlighted, (None, None)
            row, column = board.looked_at if marked == nowhere else marked
            first = next(iter(board.unmatched.values()), None)
            position = self._visitor.choose(BoardView(board.closed, first, row, column))
            self._click(f"card-{board.location(position)}")

    def _watch(self, _: WorldEvent, outcome: Outcome, stage: Stage) -> None:
        if stage is not self._stage:
            self._stage, self._acts = stage, 0
        if any(isinstance(effect, do.ShowBoard) for effect in outcome.effects):
            self._visitor.sit_down()
        self._visitor.see(self._app.screens.board.unmatched)
        if self._shots is not None:
            with self.pulse.aside():
                self._shots.watch(outcome.effects, stage)
                if stage is Stage.GAME and _found_a_pair(outcome) and not self._app.screens.board.closed:
                    self._shots.take("last-pair")
        self.code = self._app.screens.debrief.shown_code or self.code
        if stage is Stage.OVER:
            self._over = True
            self._app.quit()

    def _click(self, name: str) -> None:
        """Click on the item of this name, or click it twice if in a hurry."""
        act = self._hand.double_click if self._manner is BehaviourKind.HASTY else self._hand.click
        act(name)


def _found_a_pair(outcome: Outcome) -> bool:
    return any(isinstance(effect, do.MarkMatched) for effect in outcome.effects)


PANEL_READ_MS = 3_000


class CoversRehearsal(Rehearsal):
    """A session up to the first pair of its game, for pictures of what may lie over a game."""

    def __init__(self, app: App, seed: int, shots: Screenshots, visitor: BehaviourProfile) -> None:
        """Take the pictures with ``shots``; the same seed does the same things."""
        super().__init__(app, seed, visitor=visitor)
        self._pictures = shots

    def _watch(self, event: WorldEvent, outcome: Outcome, stage: Stage) -> None:
        super()._watch(event, outcome, stage)
        if stage is Stage.GAME and _found_a_pair(outcome) and not self._over:
            self._over = True
            with self.pulse.aside():
                self._shoot()

    def _shoot(self) -> None:
        kiosk = self._app.screens.kiosk
        kiosk.ask("stop")
        self._pictures.take("stop")
        kiosk.ask("")
        kiosk.ask_still_there(asks=True, wait_ms=20_000)
        self._pictures.take("still-there")
        kiosk.ask_still_there(asks=False)
        kiosk.pause(paused=True)
        self._pictures.take("pause")
        kiosk.pause(paused=False)
        # The booth looks at its disk from time to time, which virtual time leaves out.
        self._app.experimenter.upkeep.check_due()
        # What the panel shows is read soon after it is opened.
        self._app.clock.after(0, self._app.experimenter.panel.toggle)
        self._app.clock.after(PANEL_READ_MS, self._end)

    def _end(self) -> None:
        with self.pulse.aside():
            self._pictures.take("panel")
        self._app.quit()
