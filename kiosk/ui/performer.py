"""Carries out the study's commands: each one is a word to a screen, to the body, or to the clock."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial, singledispatchmethod

from kiosk.robot.bodies import Bodies
from kiosk.robot.body import Body
from kiosk.study import commands as do
from kiosk.study.commands import Command
from kiosk.study.events import BodyName, Timer
from kiosk.study.plan import Plan
from kiosk.ui.clock import Clock, Wait
from kiosk.ui.screens.every import Screens

SETTLE_MS = 400
"""How long a new screen takes no input; the slowest double click that desktops accept by default."""


class Performer:
    """Shows, speaks and waits as it is told."""

    def __init__(self, screens: Screens, clock: Clock, wait_ended: Callable[[Timer], None]) -> None:
        """``wait_ended`` is called when a wait is over that was not stopped."""
        self.bodies: Bodies | None = None
        self.screens = screens
        self._clock = clock
        self._wait_ended = wait_ended
        self._waits: dict[Timer, Wait] = {}
        self._settling: Wait | None = None
        screens.kiosk.unsettled.connect(self._let_settle)

    def begin(self, plan: Plan) -> None:
        """A sitting begins: everything speaks its language, and tells its contact."""
        self.screens.speak(plan.catalogue)
        self.screens.debrief.give_contact(plan.settings.consent.contact)
        if self.bodies is not None:
            self.bodies.begin(plan.language)

    def reset(self, screen: str) -> None:
        """Leave nothing of a sitting: no wait, no sound, and no screen that remembers; then show this one."""
        for timer in Timer:
            self._stop_wait(timer)
        if self.bodies is not None:
            self.bodies.rest()
        self.screens.clear()
        self.screens.kiosk.show(screen)

    @singledispatchmethod
    def perform(self, command: Command) -> None:
        """Carry out one command; one that nobody knows how to carry out is our mistake and raises."""
        raise NotImplementedError(f"nobody carries out {type(command).__name__}")

    @perform.register
    def _(self, command: do.Record) -> None:
        """It is on the disk already."""

    @perform.register
    def _(self, command: do.KeepSitting) -> None:
        """The record's matter."""

    @perform.register
    def _(self, command: do.ForgetSitting) -> None:
        """The record's matter."""

    @perform.register
    def _(self, command: do.ShowAbout) -> None:
        self.screens.about.show(command.page)
        self.screens.kiosk.show("about")

    @perform.register
    def _(self, command: do.ShowConsent) -> None:
        self.screens.consent.show(command.page)
        self.screens.kiosk.show("consent")

    @perform.register
    def _(self, command: do.ShowTicks) -> None:
        self.screens.consent.show_ticks(command.purposes)

    @perform.register
    def _(self, command: do.ShowAgeQuestion) -> None:
        self.screens.age.ask(command.adult)
        self.screens.kiosk.show("age")

    @perform.register
    def _(self, command: do.ShowIntroduction) -> None:
        self.screens.introduction.show(helped=command.helped)
        self.screens.kiosk.show("introduction")

    @perform.register
    def _(self, command: do.ShowBoard) -> None:
        board, practice = self.screens.board, command.practice
        board.deal(command.rows, command.columns, command.pairs, command.deck, practice=practice)
        self.screens.kiosk.show("practice" if practice else "game")

    @perform.register
    def _(self, command: do.TurnUp) -> None:
        self.screens.board.turn_up(command.position, command.card)

    @perform.register
    def _(self, command: do.TurnBack) -> None:
        self.screens.board.turn_back(command.positions)

    @perform.register
    def _(self, command: do.ShowPair) -> None:
        self.screens.board.show_pair(command.positions)

    @perform.register
    def _(self, command: do.ShowProgress) -> None:
        self.screens.board.show_progress(command.pairs_found, command.moves)

    @perform.register
    def _(self, command: do.HoldBoard) -> None:
        self.screens.board.hold(command.wait)

    @perform.register
    def _(self, command: do.OpenBoard) -> None:
        self.screens.board.hold(None)

    @perform.register
    def _(self, command: do.ShowMark) -> None:
        self.screens.board.mark(command.row, command.column)
        if self._body is not None:
            self._body.attend(self.screens.board.place(command.row, command.column))

    @perform.register
    def _(self, command: do.ClearMark) -> None:
        self.screens.board.clear_mark()
        if self._body is not None:
            self._body.attend(None)

    @perform.register
    def _(self, command: do.Speak) -> None:
        self.screens.avatar.say(command.sentence)
        if self._body is not None:
            self._body.say(command.utterance, command.sentence)

    @perform.register
    def _(self, command: do.StopSpeaking) -> None:
        if self._body is not None:
            self._body.stop()

    @perform.register
    def _(self, command: do.ChangeBody) -> None:
        if self.bodies is not None:
            self.bodies.change(command.body)

    @perform.register
    def _(self, command: do.ClearBubble) -> None:
        self.screens.avatar.say("")

    @perform.register
    def _(self, command: do.Express) -> None:
        if self._body is not None:
            self._body.express(command.mood)

    @perform.register
    def _(self, command: do.ShowResult) -> None:
        self.screens.result.show(command.pairs, command.moves, command.time_ms)
        self.screens.kiosk.show("result")

    @perform.register
    def _(self, command: do.ShowItems) -> None:
        self.screens.form.show(command.items, command.number, command.of)
        self.screens.kiosk.show("form")

    @perform.register
    def _(self, command: do.ShowAnswer) -> None:
        self.screens.form.show_answer(command.item, command.value)

    @perform.register
    def _(self, command: do.ShowMissing) -> None:
        asking = self.screens.consent if self.screens.kiosk.shown == "consent" else self.screens.form
        asking.show_missing(command.names)

    @perform.register
    def _(self, command: do.ShowDebrief) -> None:
        self.screens.debrief.show(command.page)
        self.screens.kiosk.show("debrief")

    @perform.register
    def _(self, command: do.ShowThanks) -> None:
        self.screens.kiosk.show("thanks")

    @perform.register
    def _(self, command: do.ShowPause) -> None:
        self.screens.kiosk.pause(paused=True)

    @perform.register
    def _(self, command: do.HidePause) -> None:
        self.screens.kiosk.pause(paused=False)

    @perform.register
    def _(self, command: do.AskStillThere) -> None:
        self.screens.kiosk.ask_still_there(asks=True)

    @perform.register
    def _(self, command: do.HideStillThere) -> None:
        self.screens.kiosk.ask_still_there(asks=False)

    @perform.register
    def _(self, command: do.StartTimer) -> None:
        self._stop_wait(command.timer)
        self._waits[command.timer] = self._clock.after(command.after_ms, partial(self._end_wait, command.timer))

    @perform.register
    def _(self, command: do.StopTimer) -> None:
        self._stop_wait(command.timer)

    @perform.register
    def _(self, command: do.EndSitting) -> None:
        """The conductor gets ready for the next visitor; there is nothing to carry out before."""

    @property
    def body_name(self) -> BodyName | None:
        """The name of the body that helps now."""
        return None if self._body is None else self._body.name

    @property
    def _body(self) -> Body | None:
        """The body that helps now."""
        return None if self.bodies is None else self.bodies.current

    def _let_settle(self) -> None:
        """Take no input for a moment: the second half of a double click belongs to what was shown before."""
        if self._settling is not None:
            self._settling.cancel()
        self._settling = self._clock.after(SETTLE_MS, self.screens.kiosk.settle)

    def _stop_wait(self, timer: Timer) -> None:
        wait = self._waits.pop(timer, None)
        if wait is not None:
            wait.cancel()

    def _end_wait(self, timer: Timer) -> None:
        del self._waits[timer]
        self._wait_ended(timer)
