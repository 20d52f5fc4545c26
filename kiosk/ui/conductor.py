"""Between the study and the world: events in, commands out; first recorded, then shown, then spoken.

It decides nothing. A failure of the disk, or a fault of ours, puts a calm screen in front of the visitor.
"""

from __future__ import annotations

import logging
from collections import deque
from collections.abc import Callable
from dataclasses import replace
from functools import partial

from kiosk.robot.bodies import Bodies
from kiosk.store.recorder import Provenance, Recorder, StoreFailed
from kiosk.study import commands as do
from kiosk.study import events as happened
from kiosk.study.commands import Command
from kiosk.study.events import Event, Stage, WorldEvent
from kiosk.study.session import Session
from kiosk.study.stages import UnexpectedEvent
from kiosk.ui.clock import Clock
from kiosk.ui.performer import Performer, Screens
from kiosk.ui.sounds import Effect, effect

PAUSE_MS = 15_000
"""How long the calm screen stays before the kiosk tries to go on."""

_log = logging.getLogger(__name__)

Witness = Callable[[WorldEvent, tuple[Command, ...], Stage], None]
"""Is told of every event once its commands were carried out, and of the stage that the sitting is in."""


class Conductor:
    """Runs one sitting after another; it is also the body's listener."""

    def __init__(
        self, screens: Screens, recorder: Recorder, clock: Clock, next_sitting: Callable[[], Provenance]
    ) -> None:
        """``next_sitting`` is asked once for each sitting what it is to follow."""
        self.witness: Witness | None = None
        self.play: Callable[[Effect], None] = lambda _: None
        self._recorder = recorder
        self._clock = clock
        self._next_sitting = next_sitting
        self._performer = Performer(screens, clock, lambda timer: self.tell(happened.TimerEnded, timer=timer))
        self._queue: deque[WorldEvent] = deque()
        self._working = False
        self._begun_at = 0
        self._listen(screens)
        self._prepare()

    def take(self, bodies: Bodies) -> None:
        """Let these bodies speak; bodies report to the conductor, so it is there before them."""
        self._performer.bodies = bodies

    def tell(self, kind: type[WorldEvent], **what: object) -> None:
        """Something happened just now."""
        if self._session.stage is Stage.ATTRACT:
            self._begun_at = self._clock.now_ms()
        self._queue.append(kind(at_ms=self._clock.now_ms() - self._begun_at, **what))
        # What happens while an event is at work, such as a voice that fails at once, waits for its turn.
        if not self._working:
            self._work()

    def speech_started(self, utterance: int) -> None:
        """The body began to say a sentence."""
        self.tell(happened.SpeechStarted, utterance=utterance)

    def speech_finished(self, utterance: int) -> None:
        """The body has said a sentence."""
        self.tell(happened.SpeechFinished, utterance=utterance)

    def speech_failed(self, utterance: int, why: str) -> None:
        """The body will not say a sentence, or not to its end."""
        self.tell(happened.SpeechFailed, utterance=utterance, why=why)

    def robot_lost(self, why: str) -> None:
        """The robot that was helping cannot be counted on any more."""
        self.tell(happened.RobotLost, why=why)

    def close(self) -> None:
        """End the sitting that is under way, if there is one, because the program is being closed."""
        if self._session.stage is not Stage.ATTRACT:
            self.tell(happened.KioskClosed)

    def pause(self) -> None:
        """Something failed that the visitor can do nothing about: drop the sitting behind a calm screen, then go on."""
        self._prepare("pause")
        self._clock.after(PAUSE_MS, self._prepare)

    def _listen(self, screens: Screens) -> None:
        screens.kiosk.confirmed.connect(partial(self.tell, happened.StillHereTapped))
        screens.attract.started.connect(partial(self.tell, happened.StartTapped))
        screens.board.tapped.connect(lambda position: self.tell(happened.CardTapped, position=position))
        screens.question.answered.connect(lambda item, value: self.tell(happened.AnswerGiven, item=item, value=value))
        for screen in (screens.introduction, screens.result, screens.question):
            screen.continued.connect(partial(self.tell, happened.ContinueTapped))

    def _prepare(self, screen: str = "attract") -> None:
        """Get ready for the next visitor, with nothing left of the last one, and show the screen of this name."""
        self._queue.clear()
        self._sitting = self._next_sitting()
        self._session = Session(self._sitting.plan, self._sitting.seed)
        self._performer.reset(screen)

    def _work(self) -> None:
        self._working = True
        try:
            while self._queue:
                self._handle(self._queue.popleft())
        finally:
            self._working = False

    def _handle(self, event: WorldEvent) -> None:
        first = self._session.stage is Stage.ATTRACT
        try:
            commands = self._session.handle(event)
        except UnexpectedEvent as refusal:
            _log.info("%s", refusal)
            return
        try:
            self._record(event, commands, first=first)
        except StoreFailed as failure:
            _log.error("%s", failure)
            self.pause()
            return
        for command in commands:
            self._performer.perform(command)
        sound = effect(commands)
        if sound is not None:
            self.play(sound)
        if self.witness is not None:
            self.witness(event, commands, self._session.stage)
        if self._session.stage is Stage.OVER:
            self._prepare()

    def _record(self, event: WorldEvent, commands: tuple[Command, ...], *, first: bool) -> None:
        events = (event, *(command.event for command in commands if isinstance(command, do.Record)))
        if first:
            self._begin(events)
        else:
            self._recorder.append(events)

    def _begin(self, events: tuple[Event, ...]) -> None:
        """Write the sitting with the body that it begins with, whichever was meant."""
        bodies = self._performer.bodies
        if bodies is not None and bodies.current is not None:
            self._sitting = replace(self._sitting, body=bodies.current.name.value)
        self._recorder.begin(self._sitting, events)
        if bodies is not None:
            bodies.begin()
