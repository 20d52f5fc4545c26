"""Whatever comes from outside, in whatever order: typed refusals and nothing else, and no promise broken."""

from __future__ import annotations

from typing import Any

from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, precondition, rule

from kiosk.assistant.gate import NO_GATE, Gate
from kiosk.game import Position
from kiosk.settings import Game
from kiosk.study import commands as do
from kiosk.study import events as happened
from kiosk.study.commands import Command, Record, Wait
from kiosk.study.condition import Condition
from kiosk.study.events import Stage, Status, Timer, WorldEvent
from kiosk.study.session import Session
from kiosk.study.stages import UnexpectedEvent
from tests.samples import mixed, plan
from tests.study.driver import View, notes, with_memory

TIMES = st.integers(0, 10**6)
ANYTHING = st.one_of(
    st.builds(happened.StartTapped, at_ms=TIMES),
    st.builds(happened.ContinueTapped, at_ms=TIMES),
    st.builds(happened.CardTapped, at_ms=TIMES, position=st.builds(Position, st.integers(), st.integers())),
    st.builds(happened.CardTapped, at_ms=TIMES, position=st.builds(Position, st.integers(-1, 3), st.integers(-1, 3))),
    st.builds(happened.AnswerGiven, at_ms=TIMES, item=st.text(max_size=3), value=st.integers()),
    st.builds(
        happened.AnswerGiven,
        at_ms=TIMES,
        item=st.sampled_from(["enjoyed", "helped", "understood"]),
        value=st.integers(-1, 7),
    ),
    st.builds(happened.StillHereTapped, at_ms=TIMES),
    st.builds(happened.TimerEnded, at_ms=TIMES, timer=st.sampled_from(Timer)),
    st.builds(happened.SpeechStarted, at_ms=TIMES, utterance=st.integers()),
    st.builds(happened.SpeechFinished, at_ms=TIMES, utterance=st.integers(-1, 40)),
    st.builds(happened.RobotLost, at_ms=TIMES, why=st.text(max_size=3)),
    st.builds(happened.SpeechFailed, at_ms=TIMES, utterance=st.integers(-1, 40), why=st.text(max_size=3)),
)
"""Sense and nonsense, but not the end of the program: that comes seldom enough as a rule of its own."""

OPENS = {
    Wait.SPEAKING: {Timer.READING, Timer.SPEECH_DEADLINE},
    Wait.TURNING_BACK: {Timer.TURN_BACK},
}
"""The waits that see to it that the board is not held for ever."""


class AnySitting(RuleBasedStateMachine):
    """A sitting, what is seen of it, and a twin that is told only what the sitting accepted."""

    def __init__(self) -> None:
        super().__init__()
        self.view = View()
        self.running: set[Timer] = set()
        self.now = 0
        self.found = 0

    @initialize(
        condition=st.sampled_from(Condition),
        seed=st.integers(0, 10**6),
        gate=st.sampled_from([NO_GATE, Gate(2, 2, 4)]),
        shape=st.sampled_from([(2, 2), (3, 4)]),
        stage=st.sampled_from(list(Stage)[:-1]),
    )
    def prepare(self, condition: Condition, seed: int, gate: Gate, shape: tuple[int, int], stage: Stage) -> None:
        board = Game(rows=shape[0], columns=shape[1])
        self.session, self.twin = (Session(plan(condition, mixed(seed, gate), game=board), seed) for _ in range(2))
        self.hurry_to(stage)

    def hurry_to(self, stage: Stage) -> None:
        """Come to this stage by a visitor who does nothing but what is asked for."""
        visitor = with_memory(1)
        while self.session.stage is not stage:
            opening = self.running & {*OPENS[Wait.SPEAKING], *OPENS[Wait.TURNING_BACK], Timer.FINISH}
            if self.session.stage is Stage.ATTRACT:
                self.start()
            elif self.session.stage is not Stage.GAME:
                self.go_on()
            elif opening:
                self.send(happened.TimerEnded(at_ms=self.now, timer=opening.pop()))
            else:
                self.send(happened.CardTapped(at_ms=self.now, position=visitor(self.view)))

    def send(self, event: WorldEvent) -> None:
        """Hand over one event; only what is accepted reaches the twin, which must then answer the same."""
        stage, measures = self.session.stage, self.session.measures
        try:
            commands = self.session.handle(event)
        except UnexpectedEvent:
            assert (self.session.stage, self.session.measures) == (stage, measures)
            return
        assert stage is not Stage.OVER
        assert self.twin.handle(event) == commands
        self.look_at(event, commands)

    def look_at(self, event: WorldEvent, commands: tuple[Command, ...]) -> None:
        kinds = [isinstance(command, Record) for command in commands]
        assert kinds == sorted(kinds, reverse=True)
        if isinstance(event, happened.TimerEnded):
            self.running.discard(event.timer)
        for command in commands:
            if isinstance(command, do.StartTimer):
                self.running.add(command.timer)
                assert command.after_ms >= 0
            elif isinstance(command, do.StopTimer):
                self.running.discard(command.timer)
            elif isinstance(command, do.OpenBoard) and self.view.bubble:
                assert self.view.mark is not None
            self.view.obey([command])
        if isinstance(event, happened.CardTapped):
            turned = [note for note in notes(commands) if isinstance(note, happened.CardFlipped)]
            ignored = [note for note in notes(commands) if isinstance(note, happened.TapIgnored)]
            assert len(turned) + len(ignored) == 1

    # Sense

    @precondition(lambda self: self.session.stage is Stage.ATTRACT)
    @rule()
    def start(self) -> None:
        self.send(happened.StartTapped(at_ms=self.now))

    @rule()
    def go_on(self) -> None:
        self.send(happened.ContinueTapped(at_ms=self.now))

    @precondition(lambda self: self.session.stage is Stage.GAME and self.view.closed and self.view.held is None)
    @rule(data=st.data())
    def flip(self, data: Any) -> None:
        flips = self.session.measures.flips
        self.send(happened.CardTapped(at_ms=self.now, position=data.draw(st.sampled_from(self.view.closed))))
        assert self.session.measures.flips == flips + 1

    @precondition(lambda self: self.session.stage is Stage.GAME and self.view.closed and self.view.held is None)
    @rule(data=st.data())
    def follow_the_mark(self, data: Any) -> None:
        row, column = self.view.mark or (None, None)
        marked = [p for p in self.view.closed if row in (None, p.row) and column in (None, p.column)]
        self.send(happened.CardTapped(at_ms=self.now, position=data.draw(st.sampled_from(marked))))

    @precondition(lambda self: self.running)
    @rule(data=st.data())
    def wait(self, data: Any) -> None:
        timer = data.draw(st.sampled_from(sorted(self.running, key=lambda timer: timer.value)))
        self.send(happened.TimerEnded(at_ms=self.now, timer=timer))

    @precondition(lambda self: self.running - {Timer.IDLE, Timer.STILL_THERE})
    @rule(data=st.data())
    def wait_for_the_game(self, data: Any) -> None:
        running = self.running - {Timer.IDLE, Timer.STILL_THERE}
        timer = data.draw(st.sampled_from(sorted(running, key=lambda timer: timer.value)))
        self.send(happened.TimerEnded(at_ms=self.now, timer=timer))

    @precondition(lambda self: self.view.speaking is not None)
    @rule(how=st.sampled_from(["started", "finished", "failed"]))
    def speak(self, how: str) -> None:
        utterance = self.view.speaking or 0
        events: dict[str, WorldEvent] = {
            "started": happened.SpeechStarted(at_ms=self.now, utterance=utterance),
            "finished": happened.SpeechFinished(at_ms=self.now, utterance=utterance),
            "failed": happened.SpeechFailed(at_ms=self.now, utterance=utterance, why="no sound"),
        }
        self.send(events[how])

    @precondition(lambda self: self.view.question is not None)
    @rule(value=st.integers(1, 5))
    def answer(self, value: int) -> None:
        assert self.view.question is not None
        self.send(happened.AnswerGiven(at_ms=self.now, item=self.view.question.item, value=value))

    # Nonsense

    @rule(event=ANYTHING)
    def anything(self, event: WorldEvent) -> None:
        self.send(event)

    @precondition(lambda self: self.session.measures.flips > 6)
    @rule()
    def close_the_kiosk(self) -> None:
        self.send(happened.KioskClosed(at_ms=self.now))

    # Promises

    @invariant()
    def the_board_is_not_held_for_ever(self) -> None:
        if self.session.stage is Stage.GAME and self.view.held is not None:
            assert self.running & OPENS[self.view.held]

    @invariant()
    def a_finished_game_goes_on(self) -> None:
        if self.session.stage is Stage.GAME and self.session.measures.pairs * 2 == self.view.rows * self.view.columns:
            assert Timer.FINISH in self.running

    @invariant()
    def somebody_is_waited_for(self) -> None:
        if self.session.stage not in (Stage.ATTRACT, Stage.OVER):
            assert self.running & {Timer.IDLE, Timer.STILL_THERE}
            assert self.view.still_there is (Timer.STILL_THERE in self.running)

    @invariant()
    def found_pairs_stay_found(self) -> None:
        assert len(self.view.found) >= self.found
        self.found = len(self.view.found)
        assert self.found == 2 * self.session.measures.pairs
        assert self.view.found <= set(self.view.up)
        assert len(set(self.view.up) - self.view.found) <= 2

    @invariant()
    def a_mark_goes_with_its_sentence(self) -> None:
        if self.view.mark is not None and self.session.stage is Stage.GAME:
            assert self.view.bubble

    @invariant()
    def what_is_over_is_over(self) -> None:
        over = self.session.stage is Stage.OVER
        assert over is (self.view.ended is not None)
        if over:
            assert not self.running
            assert isinstance(self.view.ended, Status)
            for event in (happened.StartTapped(at_ms=1), happened.KioskClosed(at_ms=1)):
                self.send(event)
            assert self.session.stage is Stage.OVER


TestAnySitting = AnySitting.TestCase
TestAnySitting.settings = settings(max_examples=200, stateful_step_count=50, deadline=None, report_multiple_bugs=False)
