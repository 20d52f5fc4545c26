"""Carry out the effects of a session: screens, speech, timers and sounds."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from enum import Enum
from functools import partial, singledispatchmethod
from pathlib import Path

from kiosk.config import ASSETS
from kiosk.experiment import effects as do
from kiosk.experiment.effects import BoardWait, Effect
from kiosk.experiment.events import EmbodimentName, Timer
from kiosk.experiment.session_config import SessionConfig
from kiosk.robots.embodiment import Embodiment, EmbodimentSelector
from kiosk.ui.event_loop import Clock, TimerWait
from kiosk.ui.screens.registry import ScreenSet


class SoundEffect(Enum):
    """A sound, by the name of its file; what comes first here goes before the others."""

    END = "end"
    MATCH = "match"
    MISS = "miss"
    FLIP = "flip"

    @property
    def file(self) -> Path:
        """Where it is; packaging/make_sounds.py made it."""
        return ASSETS / "sounds" / f"{self.value}.wav"


def sound_for(commands: Iterable[Effect]) -> SoundEffect | None:
    """The sound for what these commands show; none if they begin a sentence, which is never made to wait."""
    heard: set[SoundEffect] = set()
    for command in commands:
        match command:
            case do.Speak():
                return None
            case do.StartTimer(timer=Timer.FINISH):
                heard.add(SoundEffect.END)
            case do.MarkMatched():
                heard.add(SoundEffect.MATCH)
            case do.LockBoard(wait=BoardWait.TURNING_BACK):
                heard.add(SoundEffect.MISS)
            case do.RevealCard():
                heard.add(SoundEffect.FLIP)
    return next((sound for sound in SoundEffect if sound in heard), None)


SETTLE_MS = 400
"""How long a new screen takes no input; the slowest double click that desktops accept by default."""


class Renderer:
    """Shows, speaks and waits as it is told."""

    def __init__(self, screens: ScreenSet, clock: Clock, wait_ended: Callable[[Timer], None]) -> None:
        """``wait_ended`` is called when a wait is over that was not stopped."""
        self.embodiments: EmbodimentSelector | None = None
        self.screens = screens
        self._clock = clock
        self._wait_ended = wait_ended
        self._waits: dict[Timer, TimerWait] = {}
        self._settling: TimerWait | None = None
        screens.kiosk.unsettled.connect(self._let_settle)

    def begin(self, plan: SessionConfig) -> None:
        """A session begins: everything speaks its language, and tells its contact."""
        self.screens.set_language(plan.catalogue)
        self.screens.debrief.give_contact(plan.settings.consent.contact)
        if self.embodiments is not None:
            self.embodiments.begin_session(plan.language)

    def reset(self, screen: str) -> None:
        """Leave nothing of a session: no wait, no sound, and no screen that remembers; then show this one."""
        for timer in Timer:
            self._stop_wait(timer)
        if self.embodiments is not None:
            self.embodiments.end_session()
        self.screens.clear()
        self.screens.kiosk.show(screen)

    @singledispatchmethod
    def perform(self, command: Effect) -> None:
        """Carry out one command; one that nobody knows how to carry out is our mistake and raises."""
        raise NotImplementedError(f"nobody carries out {type(command).__name__}")

    @perform.register
    def _(self, command: do.EmitEvent) -> None:
        """It is on the disk already."""

    @perform.register
    def _(self, command: do.StartRecording) -> None:
        """The record's matter."""

    @perform.register
    def _(self, command: do.DiscardRecording) -> None:
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
    def _(self, command: do.RevealCard) -> None:
        self.screens.board.reveal(command.position, command.card)

    @perform.register
    def _(self, command: do.HideCards) -> None:
        self.screens.board.hide(command.positions)

    @perform.register
    def _(self, command: do.MarkMatched) -> None:
        self.screens.board.mark_matched(command.positions)

    @perform.register
    def _(self, command: do.ShowProgress) -> None:
        self.screens.board.show_progress(command.pairs_found, command.moves)

    @perform.register
    def _(self, command: do.LockBoard) -> None:
        self.screens.board.lock(command.wait)

    @perform.register
    def _(self, command: do.UnlockBoard) -> None:
        self.screens.board.lock(None)

    @perform.register
    def _(self, command: do.HighlightHint) -> None:
        self.screens.board.highlight(command.row, command.column)
        if self._body is not None:
            self._body.look_at(self.screens.board.place(command.row, command.column))

    @perform.register
    def _(self, command: do.ClearHighlight) -> None:
        self.screens.board.clear_highlight()
        if self._body is not None:
            self._body.look_at(None)

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
    def _(self, command: do.SwitchEmbodiment) -> None:
        if self.embodiments is not None:
            self.embodiments.switch_to(command.body)

    @perform.register
    def _(self, command: do.ClearBubble) -> None:
        self.screens.avatar.say("")

    @perform.register
    def _(self, command: do.SetExpression) -> None:
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
    def _(self, command: do.ShowValidationErrors) -> None:
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
    def _(self, command: do.EndSession) -> None:
        """The runner gets ready for the next visitor; there is nothing to carry out before."""

    @property
    def body_name(self) -> EmbodimentName | None:
        """The name of the body that helps now."""
        return None if self._body is None else self._body.name

    @property
    def _body(self) -> Embodiment | None:
        """The body that helps now."""
        return None if self.embodiments is None else self.embodiments.current

    def _let_settle(self) -> None:
        """Take no input for a moment: the second half of a double click belongs to what was shown before."""
        if self._settling is not None:
            self._settling.cancel()
        self._settling = self._clock.after(SETTLE_MS, self.screens.kiosk.end_input_guard)

    def _stop_wait(self, timer: Timer) -> None:
        wait = self._waits.pop(timer, None)
        if wait is not None:
            wait.cancel()

    def _end_wait(self, timer: Timer) -> None:
        del self._waits[timer]
        self._wait_ended(timer)
