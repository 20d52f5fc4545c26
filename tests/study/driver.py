"""Drives a sitting without a window: a clock that only moves when told to, timers that obey, and a body that speaks.

``View`` is what a visitor would see of the commands so far; ``Driver`` sends events, keeps the timers that the session
asked for, and answers for the body, as a conductor would.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from enum import Enum
from random import Random
from typing import TypeVar

from kiosk.game import Position
from kiosk.study import commands as do
from kiosk.study import events as happened
from kiosk.study.commands import Command, Mood, Record, Wait
from kiosk.study.events import Event, SessionEvent, Stage, Status, Timer, WorldEvent
from kiosk.study.plan import Plan
from kiosk.study.session import Session

ONE_TAP = 700
"""How long the visitor thinks before a tap, in ms."""

SPEECH_LAG = 40
SPEECH_TIME = 2000
"""How long the body takes to begin a sentence and to say it, in ms."""

_Some = TypeVar("_Some", bound=SessionEvent)


class Voice(Enum):
    """How the body answers when it is told to speak."""

    SPEAKS = "says it to the end"
    FAILS = "says at once that it cannot"
    BREAKS_OFF = "begins, then fails"
    IS_SILENT = "never answers"


@dataclass
class View:
    """What there is to see after the commands so far."""

    screen: str = "attract"
    rows: int = 0
    columns: int = 0
    up: dict[Position, str] = field(default_factory=dict)
    found: set[Position] = field(default_factory=set)
    held: Wait | None = None
    mark: tuple[int | None, int | None] | None = None
    bubble: str | None = None
    speaking: int | None = None
    mood: Mood = Mood.IDLE
    progress: tuple[int, int] = (0, 0)
    result: do.ShowResult | None = None
    question: do.ShowQuestion | None = None
    answer: int | None = None
    still_there: bool = False
    ended: Status | None = None

    @property
    def closed(self) -> list[Position]:
        """Every closed card, row by row."""
        places = (Position(row, column) for row in range(self.rows) for column in range(self.columns))
        return [place for place in places if place not in self.up]

    def obey(self, commands: Iterable[Command]) -> None:
        """Show what these commands say."""
        for command in commands:
            self._obey(command)

    def _obey(self, command: Command) -> None:  # noqa: C901, PLR0912 - one case per command
        match command:
            case do.ShowIntroduction():
                self.screen = "introduction"
            case do.ShowBoard(rows=rows, columns=columns):
                self.screen, self.rows, self.columns = "board", rows, columns
            case do.TurnUp(position=position, card=card):
                self.up[position] = card
            case do.TurnBack(positions=positions):
                for position in positions:
                    del self.up[position]
            case do.ShowPair(positions=positions):
                self.found |= set(positions)
            case do.ShowProgress(pairs_found=pairs_found, moves=moves):
                self.progress = (pairs_found, moves)
            case do.HoldBoard(wait=wait):
                self.held = wait
            case do.OpenBoard():
                self.held = None
            case do.ShowMark(row=row, column=column):
                self.mark = (row, column)
            case do.ClearMark():
                self.mark = None
            case do.Speak(utterance=utterance, sentence=sentence):
                self.bubble, self.speaking = sentence, utterance
            case do.StopSpeaking():
                self.speaking = None
            case do.ClearBubble():
                self.bubble = None
            case do.Express(mood=mood):
                self.mood = mood
            case do.ShowResult():
                self.screen, self.result = "result", command
            case do.ShowQuestion():
                self.screen, self.question, self.answer = "question", command, None
            case do.ShowAnswer(value=value):
                self.answer = value
            case do.AskStillThere():
                self.still_there = True
            case do.HideStillThere():
                self.still_there = False
            case do.EndSitting(status=status):
                self.ended = status


@dataclass(frozen=True)
class Step:
    """One event and what it led to."""

    event: WorldEvent
    commands: tuple[Command, ...]


@dataclass
class _Due:
    at_ms: int
    number: int
    send: Callable[[int], WorldEvent]
    timer: Timer | None = None


class Driver:
    """One sitting with its clock, its timers and its body; every step is kept."""

    def __init__(self, plan: Plan, seed: int = 1, voice: Voice = Voice.SPEAKS) -> None:
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
        return [event for step in self.steps for event in (step.event, *notes(step.commands))]

    @property
    def world(self) -> list[WorldEvent]:
        """What came from outside."""
        return [step.event for step in self.steps]

    @property
    def commands(self) -> list[Command]:
        """Every command so far."""
        return [command for step in self.steps for command in step.commands]

    def noted(self, kind: type[_Some]) -> list[_Some]:
        """Every conclusion of one kind."""
        return [event for event in self.events if isinstance(event, kind)]

    @property
    def running(self) -> dict[Timer, int]:
        """The timers that run, and when each will end."""
        return {due.timer: due.at_ms for due in self._due if due.timer is not None}

    # Making things happen

    def send(self, event: WorldEvent) -> tuple[Command, ...]:
        """Hand the session an event as it is and obey what it says; a refusal passes through and leaves no step."""
        commands = self.session.handle(event)
        self.steps.append(Step(event, commands))
        self.view.obey(commands)
        for command in commands:
            self._obey(command)
        return commands

    def start(self) -> tuple[Command, ...]:
        """Begin the sitting."""
        return self.send(happened.StartTapped(at_ms=self.now))

    def go_on(self) -> tuple[Command, ...]:
        """Tap on to what comes next, after a moment."""
        self.spend(ONE_TAP)
        return self.send(happened.ContinueTapped(at_ms=self.now))

    def tap(self, position: Position) -> tuple[Command, ...]:
        """Tap a card at once."""
        return self.send(happened.CardTapped(at_ms=self.now, position=position))

    def answer(self, value: int, item: str | None = None) -> tuple[Command, ...]:
        """Answer the question that is shown, or another one."""
        shown = self.view.question.item if self.view.question else ""
        return self.send(happened.AnswerGiven(at_ms=self.now, item=shown if item is None else item, value=value))

    def wait(self) -> tuple[Command, ...]:
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
        """Let time go by until cards can be tapped, or the game is over."""
        while self.stage is Stage.GAME and (self.view.held is not None or not self.view.closed):
            self.wait()

    # Whole stretches

    def to_the_game(self) -> None:
        """Begin the sitting and go on to the game."""
        self.start()
        self.go_on()

    def flip(self, position: Position) -> tuple[Command, ...]:
        """Wait until it is possible, think, and flip a card."""
        self.wait_until_open()
        self.spend(ONE_TAP)
        return self.tap(position)

    def play(self, choose: Callable[[View], Position]) -> None:
        """Play the game to its end, flip by flip."""
        self.wait_until_open()
        while self.stage is Stage.GAME:
            self.spend(ONE_TAP)
            self.tap(choose(self.view))
            self.wait_until_open()

    def questions(self, values: Sequence[int] | None = None) -> None:
        """Answer all questions and end the sitting."""
        values = values or [1] * len(self.plan.questionnaire.items)
        for value in values:
            self.answer(value)
            self.go_on()

    def whole_sitting(self, choose: Callable[[View], Position]) -> None:
        """From the first tap to the end."""
        self.to_the_game()
        self.play(choose)
        self.go_on()
        self.questions()

    # Timers and the body

    def _obey(self, command: Command) -> None:
        match command:
            case do.StartTimer(timer=timer, after_ms=after_ms):
                self._stop(timer)
                self._plan(after_ms, lambda now: happened.TimerEnded(at_ms=now, timer=timer), timer)
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


def notes(commands: Iterable[Command]) -> list[SessionEvent]:
    """What these commands tell to write down."""
    return [command.event for command in commands if isinstance(command, Record)]


def at_random(seed: int) -> Callable[[View], Position]:
    """A visitor without a memory: any closed card."""
    rng = Random(seed)
    return lambda view: rng.choice(view.closed)


def with_memory(seed: int) -> Callable[[View], Position]:
    """A visitor who forgets nothing: a known pair or mate if there is one, else any card not yet seen."""
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


def replay(plan: Plan, seed: int, world: Iterable[WorldEvent]) -> list[tuple[Command, ...]]:
    """The commands of a new session that is handed the same events."""
    session = Session(plan, seed)
    return [session.handle(event) for event in world]
