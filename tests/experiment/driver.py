"""Drives a session without a window: a clock that only moves when told to, timers that obey, and a body that speaks.

``Driver`` sends events, keeps the timers that the session asked for, and answers for the body, as a runner would;
``driven_to`` brings a willing visitor to any stage.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from enum import Enum
from random import Random
from typing import Self, TypeVar

from kiosk.config import Game
from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.effects import Effect, Outcome
from kiosk.experiment.events import Event, InputDevice, SessionEvent, Timer, WorldEvent
from kiosk.experiment.items import Answer, Integer, Multiple, Rating, Response, Single, TextPage
from kiosk.experiment.outcomes import EmbodimentName, Stage
from kiosk.experiment.questionnaire import Item
from kiosk.experiment.session import Session
from kiosk.experiment.session_config import SessionConfig
from kiosk.game import Position
from tests.experiment.view import View
from tests.samples import whole

ONE_TAP = 700
"""How long the visitor thinks before a tap, in ms."""

SPEECH_LAG = 40
SPEECH_TIME = 2000
"""How long the body takes to begin a sentence and to say it, in ms."""

_Some = TypeVar("_Some", bound=SessionEvent)


class Voice(Enum):
    """How the embodiment answers when it has to speak."""

    SPEAKS = "says it to the end"
    FAILS = "says at once that it cannot"
    BREAKS_OFF = "begins, then fails"
    IS_SILENT = "never answers"


@dataclass(frozen=True)
class Step:
    """One event and what it led to."""

    event: WorldEvent
    outcome: Outcome


@dataclass
class _Due:
    at_ms: int
    number: int
    send: Callable[[int], WorldEvent]
    timer: Timer | None = None


class Driver:
    """One session with its clock, its timers and its body; every step is kept."""

    def __init__(self, plan: SessionConfig, seed: int = 1, voice: Voice = Voice.SPEAKS) -> None:
        self.session = Session(plan, seed)
        self.plan = plan
        self.voice = voice
        self.view = View()
        self.now = 0
        self.steps: list[Step] = []
        self._due: list[_Due] = []
        self._numbers = 0

    # What happened

    @property
    def stage(self) -> Stage:
        """The session's stage."""
        return self.session.stage

    @property
    def events(self) -> list[Event]:
        """Everything as it would be recorded: each world event, then what the session concluded from it."""
        return [event for step in self.steps for event in (step.event, *step.outcome.events)]

    @property
    def world(self) -> list[WorldEvent]:
        """What came from outside."""
        return [step.event for step in self.steps]

    @property
    def effects(self) -> list[Effect]:
        """Every effect so far."""
        return [effect for step in self.steps for effect in step.outcome.effects]

    def noted(self, kind: type[_Some]) -> list[_Some]:
        """Every conclusion of one kind."""
        return [event for event in self.events if isinstance(event, kind)]

    @property
    def running(self) -> dict[Timer, int]:
        """The timers that run, and when each will end."""
        return {due.timer: due.at_ms for due in self._due if due.timer is not None}

    # Making things happen

    def send(self, event: WorldEvent) -> Outcome:
        """Hand the session an event as it is and obey what it says; a refusal passes through and leaves no step."""
        outcome = self.session.handle(event)
        self.steps.append(Step(event, outcome))
        self.view.hear(event)
        self.view.follow(outcome)
        for effect in outcome.effects:
            self._obey(effect)
        return outcome

    def start(self) -> Outcome:
        """Begin the session."""
        return self.send(happened.SessionStarted(at_ms=self.now))

    def go_on(self) -> Outcome:
        """Tap on to what comes next, after a moment."""
        self.spend(ONE_TAP)
        return self.send(happened.ContinuePressed(at_ms=self.now))

    def tap(self, position: Position, device: InputDevice | None = None) -> Outcome:
        """Tap a card at once."""
        return self.send(happened.CardSelected(at_ms=self.now, position=position, device=device))

    def tick(self, *purposes: str, ticked: bool = True) -> None:
        """Set, or take away, the ticks of these purposes of the consent."""
        for purpose in purposes:
            self.send(happened.ConsentPurposeToggled(at_ms=self.now, purpose=purpose, ticked=ticked))

    def agree(self) -> Outcome:
        """Agree to what is ticked, after a moment."""
        self.spend(ONE_TAP)
        return self.send(happened.ConsentSubmitted(at_ms=self.now))

    def decline(self) -> Outcome:
        """Play without being recorded."""
        return self.send(happened.ConsentDeclined(at_ms=self.now))

    def say_age(self, *, adult: bool = True) -> Outcome:
        """Say whether one is old enough."""
        return self.send(happened.AgeConfirmed(at_ms=self.now, adult=adult))

    def skip(self) -> Outcome:
        """Leave the practice."""
        return self.send(happened.PracticeSkipped(at_ms=self.now))

    def answer(self, value: Response | None, item: str | None = None) -> Outcome:
        """Answer the first item that is shown, or another one."""
        shown = self.view.page.items[0].id if self.view.page else ""
        return self.send(happened.ResponseGiven(at_ms=self.now, item=shown if item is None else item, value=value))

    def pause(self) -> Outcome:
        """Stop the session for a while, as the experimenter."""
        return self.send(happened.PauseRequested(at_ms=self.now))

    def end_pause(self) -> Outcome:
        """Let it go on, as the experimenter."""
        return self.send(happened.PauseEnded(at_ms=self.now))

    def repeat(self) -> Outcome:
        """Have the last sentence said again, as the experimenter."""
        return self.send(happened.RepeatRequested(at_ms=self.now))

    def end(self, reason: str = "the fair is closing") -> Outcome:
        """End the session, as the experimenter."""
        return self.send(happened.AbortRequested(at_ms=self.now, reason=reason))

    def wait(self) -> Outcome:
        """Let the clock go on to the next thing that is due, a timer's end or the body's answer, and let it happen."""
        due = min(self._due, key=lambda due: (due.at_ms, due.number))
        self._due.remove(due)
        self.now = max(self.now, due.at_ms)
        return self.send(due.send(self.now))

    def spend(self, ms: int) -> None:
        """Let so much time go by, with all that is due in it."""
        until = self.now + ms
        while self._due and min(due.at_ms for due in self._due) <= until:
            self.wait()
        self.now = until

    def wait_until_open(self) -> None:
        """Let time go by until cards can be tapped, or the stage is over."""
        here = self.stage
        while self.stage is here and (self.view.held is not None or not self.view.closed):
            self.wait()

    def be_away(self) -> None:
        """Do nothing any more, until the session is given up; the stage may end by itself first."""
        while self.stage is not Stage.OVER:
            self.wait()

    # Whole stretches

    def to_the_game(self) -> None:
        """Begin the session and go on to the game."""
        self.to(Stage.GAME)

    def to(self, stage: Stage) -> None:
        """Go on to this stage, doing what is asked for; a practice is not asked for."""
        while self.stage is not stage:
            self.do_what_is_asked()

    def do_what_is_asked(self) -> None:
        """Go through the stage that the session is in."""
        match self.stage:
            case Stage.ATTRACT:
                self.start()
            case Stage.CONSENT:
                self.tick(*(purpose.id for purpose in self.plan.information.consent.purposes))
                self.agree()
            case Stage.AGE:
                self.say_age()
            case Stage.ABOUT_YOU | Stage.QUESTIONS:
                self.questions()
            case Stage.PRACTICE:
                self.skip()
            case Stage.GAME:
                self.play(with_memory(1))
            case _:
                self.go_on()

    def flip(self, position: Position) -> Outcome:
        """Wait until it is possible, think, and flip a card."""
        self.wait_until_open()
        self.spend(ONE_TAP)
        return self.tap(position)

    def play(self, choose: Callable[[View], Position]) -> None:
        """Play the game, or the practice, to its end, flip by flip."""
        here = self.stage
        self.wait_until_open()
        while self.stage is here:
            self.spend(ONE_TAP)
            self.tap(choose(self.view))
            self.wait_until_open()

    def questions(self, values: Sequence[Answer] = ()) -> None:
        """Answer all questions of this stage, with these values or any that will do, page by page."""
        here, left = self.stage, list(values)
        while self.stage is here:
            for item in self.view.page.items if self.view.page else ():
                if not isinstance(item, TextPage) and item.id not in self.view.hidden:
                    self.answer(left.pop(0) if left else some_answer(item), item.id)
            self.go_on()

    def whole_session(self, choose: Callable[[View], Position]) -> None:
        """From the first tap to the end."""
        self.to_the_game()
        self.play(choose)
        self.to(Stage.OVER)

    @classmethod
    def resumed(
        cls, plan: SessionConfig, seed: int, past: Iterable[WorldEvent], body: EmbodimentName = EmbodimentName.AVATAR
    ) -> Self:
        """Return a session that was cut off after these events, in a program that has just started."""
        driver = cls(plan, seed)
        for event in past:
            driver.now = event.at_ms
            driver.send(event)
        driver._due.clear()
        driver.view = View()
        driver.send(happened.SessionResumed(at_ms=driver.now, embodiment=body))
        return driver

    # Timers and the body

    def _obey(self, command: Effect) -> None:
        match command:
            case do.StartTimer(timer=timer, after_ms=after_ms):
                self._stop(timer)
                self._plan(after_ms, lambda now: happened.TimerExpired(at_ms=now, timer=timer), timer)
            case do.StopTimer(timer=timer):
                self._stop(timer)
            case do.Speak(utterance=utterance):
                self._speak(utterance)

    def _stop(self, timer: Timer) -> None:
        self._due = [due for due in self._due if due.timer is not timer]

    def _speak(self, utterance: int) -> None:
        def failed(now: int) -> WorldEvent:
            return happened.SpeechFailed(at_ms=now, utterance=utterance, why="no sound")

        if self.voice in (Voice.SPEAKS, Voice.BREAKS_OFF):
            self._plan(SPEECH_LAG, lambda now: happened.SpeechStarted(at_ms=now, utterance=utterance))
        if self.voice is Voice.SPEAKS:
            self._plan(SPEECH_TIME, lambda now: happened.SpeechFinished(at_ms=now, utterance=utterance))
        elif self.voice is Voice.BREAKS_OFF:
            self._plan(SPEECH_TIME, failed)
        elif self.voice is Voice.FAILS:
            self._plan(0, failed)

    def _plan(self, after_ms: int, send: Callable[[int], WorldEvent], timer: Timer | None = None) -> None:
        self._numbers += 1
        self._due.append(_Due(self.now + after_ms, self._numbers, send, timer))


def driven_to(stage: Stage, plan: SessionConfig | None = None, seed: int = 5, voice: Voice = Voice.SPEAKS) -> Driver:
    """Return a session that has just reached this stage, of all stages unless the plan has others.

    The game is small.
    """
    driver = Driver(plan or whole(game=Game(rows=2, columns=3)), seed, voice)
    driver.to(stage)
    return driver


def some_answer(item: Item) -> Answer:
    """Return an answer that an item accepts."""
    if isinstance(item, Multiple):
        return item.ids[:1]
    if isinstance(item, Single):
        return item.ids[0]
    if isinstance(item, Integer):
        return item.lowest
    if isinstance(item, Rating):
        return item.ends[0]
    return "a word"


def at_random(seed: int) -> Callable[[View], Position]:
    """Return a visitor without a memory: any closed card."""
    rng = Random(seed)
    return lambda view: rng.choice(view.closed)


def with_memory(seed: int) -> Callable[[View], Position]:
    """Return a visitor who forgets nothing: a known pair or mate if there is one, else any card not yet seen."""
    rng = Random(seed)
    seen: dict[Position, str] = {}

    def choose(view: View) -> Position:
        seen.update(view.up)
        open_now = [card for position, card in view.up.items() if position not in view.found]
        known = [seen[position] for position in view.closed if position in seen]
        wanted = open_now or [card for card in known if known.count(card) == 2]
        mates = [position for position in view.closed if wanted and seen.get(position) == wanted[0]]
        return mates[0] if mates else rng.choice([place for place in view.closed if place not in seen] or view.closed)

    return choose


def forgetful(seed: int) -> Callable[[View], Position]:
    """Return a visitor who remembers at half of the flips, so that a game has hints of every kind and is soon over."""
    rng, remembers, guesses = Random(seed), with_memory(seed), at_random(seed)

    def choose(view: View) -> Position:
        remembered, guessed = remembers(view), guesses(view)
        return remembered if rng.random() < 0.5 else guessed

    return choose


def replay(plan: SessionConfig, seed: int, world: Iterable[WorldEvent]) -> list[Outcome]:
    """Return the outcomes of a new session that is handed the same events."""
    session = Session(plan, seed)
    return [session.handle(event) for event in world]
