"""Whatever comes from outside, in whatever order: typed refusals and nothing else, and no promise broken."""

from __future__ import annotations

from typing import Any

from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, precondition, rule

from kiosk.assistance.policy import NO_GATE, Gate
from kiosk.config import STAGES, Game, Practice, Timing
from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.condition import CONDITIONS, Condition
from kiosk.experiment.effects import BoardWait, Outcome
from kiosk.experiment.events import Timer, WorldEvent
from kiosk.experiment.items import TextPage
from kiosk.experiment.outcomes import EmbodimentName, RecordingState, Stage, Status
from kiosk.experiment.session import Session
from kiosk.experiment.transitions import BEFORE_DECIDING, InvalidTransition
from kiosk.game import Position
from tests.experiment.driver import some_answer, with_memory
from tests.experiment.view import View
from tests.samples import ABOUT_YOU, CLOSING, INFORMATION, SHORT, mixed, plan

TIMES = st.integers(0, 10**6)
ITEMS = [item.id for item in (*ABOUT_YOU.items, *CLOSING.items)]
PURPOSES = [purpose.id for purpose in INFORMATION.consent.purposes]
ANSWERS = st.one_of(
    st.none(),
    st.integers(),
    st.integers(-1, 7),
    st.text(max_size=3),
    st.lists(st.sampled_from(["en", "it", "xx"]), max_size=3).map(tuple),
)
ANYTHING = st.one_of(
    st.builds(happened.SessionStarted, at_ms=TIMES),
    st.builds(happened.ContinuePressed, at_ms=TIMES),
    st.builds(
        happened.ConsentPurposeToggled, at_ms=TIMES, purpose=st.sampled_from([*PURPOSES, ""]), ticked=st.booleans()
    ),
    st.builds(happened.ConsentSubmitted, at_ms=TIMES),
    st.builds(happened.BackPressed, at_ms=TIMES),
    st.builds(happened.RepeatPressed, at_ms=TIMES),
    st.builds(happened.LanguageSelected, at_ms=TIMES, language=st.sampled_from(["en", "it", "xx"])),
    st.builds(happened.TextSizeSelected, at_ms=TIMES, size=st.sampled_from(happened.TextSize)),
    st.builds(happened.SoundSelected, at_ms=TIMES, on=st.booleans()),
    st.builds(happened.PracticeSkipped, at_ms=TIMES),
    st.builds(happened.CardSelected, at_ms=TIMES, position=st.builds(Position, st.integers(), st.integers())),
    st.builds(happened.CardSelected, at_ms=TIMES, position=st.builds(Position, st.integers(-1, 3), st.integers(-1, 3))),
    st.builds(happened.ResponseGiven, at_ms=TIMES, item=st.text(max_size=3), value=ANSWERS),
    st.builds(happened.ResponseGiven, at_ms=TIMES, item=st.sampled_from(ITEMS), value=ANSWERS),
    st.builds(happened.PresenceConfirmed, at_ms=TIMES),
    st.builds(happened.TypingActivity, at_ms=TIMES),
    st.builds(happened.UserActivity, at_ms=TIMES, ago_ms=st.integers()),
    st.builds(happened.TimerExpired, at_ms=TIMES, timer=st.sampled_from(Timer)),
    st.builds(happened.SpeechStarted, at_ms=TIMES, utterance=st.integers()),
    st.builds(happened.SpeechFinished, at_ms=TIMES, utterance=st.integers(-1, 40)),
    st.builds(happened.RobotDisconnected, at_ms=TIMES, why=st.text(max_size=3)),
    st.builds(happened.SpeechFailed, at_ms=TIMES, utterance=st.integers(-1, 40), why=st.text(max_size=3)),
    st.builds(happened.RepeatRequested, at_ms=TIMES),
    st.builds(happened.PauseRequested, at_ms=TIMES),
    st.builds(happened.PauseEnded, at_ms=TIMES),
    st.builds(happened.NextParticipantRequested, at_ms=TIMES),
    st.builds(happened.MuteChanged, at_ms=TIMES, muted=st.booleans()),
    st.builds(
        happened.SessionResumed,
        at_ms=TIMES,
        embodiment=st.sampled_from([EmbodimentName.AVATAR, EmbodimentName.robot("any")]),
    ),
)
"""Sense and nonsense, but not what ends a session, nor what decides against a record: that comes by its own rules."""

OPENS = {
    BoardWait.SPEAKING: {Timer.READING, Timer.SPEECH_DEADLINE, Timer.HOLD},
    BoardWait.TURNING_BACK: {Timer.TURN_BACK},
}
"""The waits that see to it that the board is not held for ever."""

BOARDS = {Stage.PRACTICE, Stage.GAME}
COURSES = (STAGES, SHORT, ("about", "age", "consent", "questions", "practice", "game", "about_you", "thanks"))


class AnySession(RuleBasedStateMachine):
    """A session, what is seen of it, and a twin that gets only what the session accepted."""

    def __init__(self) -> None:
        super().__init__()
        self.view = View()
        self.running: set[Timer] = set()
        self.now = 0
        self.found = 0
        self.closed_in: Stage | None = None

    @initialize(
        condition=st.sampled_from(CONDITIONS),
        seed=st.integers(0, 10**6),
        gate=st.sampled_from([NO_GATE, Gate(2, 2, 4)]),
        shape=st.sampled_from([(2, 2), (3, 4)]),
        course=st.sampled_from(COURSES),
        hints=st.booleans(),
        timing=st.builds(Timing, taps_wait=st.booleans(), tap_ends_sentence=st.booleans()),
        data=st.data(),
    )
    def prepare(  # noqa: PLR0913, PLR0917 - what differs between sessions
        self,
        condition: Condition,
        seed: int,
        gate: Gate,
        shape: tuple[int, int],
        course: tuple[str, ...],
        hints: bool,  # noqa: FBT001 - drawn, not passed
        timing: Timing,
        data: Any,
    ) -> None:
        board, practice = Game(rows=shape[0], columns=shape[1]), Practice(rows=2, columns=2, hints=hints)
        self.plan = plan(condition, mixed(seed, gate), course, game=board, practice=practice, timing=timing)
        self.session, self.twin = (Session(self.plan, seed) for _ in range(2))
        self.hurry_to(data.draw(st.sampled_from([Stage.ATTRACT, *self.plan.stage_order.stages])))

    def hurry_to(self, stage: Stage) -> None:
        """Come to this stage by a visitor who does nothing but what is asked for."""
        self.visitor = with_memory(1)
        while self.session.stage is not stage:
            self.do_what_is_asked()

    def do_what_is_asked(self) -> None:
        """Take one step further."""
        opening = self.running & {*OPENS[BoardWait.SPEAKING], *OPENS[BoardWait.TURNING_BACK], Timer.FINISH}
        match self.session.stage:
            case Stage.ATTRACT:
                self.start()
            case Stage.CONSENT if "store" not in self.view.ticks:
                self.send(happened.ConsentPurposeToggled(at_ms=self.now, purpose="store", ticked=True))
            case Stage.CONSENT:
                self.send(happened.ConsentSubmitted(at_ms=self.now))
            case Stage.AGE:
                self.say_age(adult=True)
            case Stage.PRACTICE | Stage.GAME if opening:
                self.send(happened.TimerExpired(at_ms=self.now, timer=opening.pop()))
            case Stage.PRACTICE | Stage.GAME:
                self.send(happened.CardSelected(at_ms=self.now, position=self.visitor(self.view)))
            case Stage.ABOUT_YOU | Stage.QUESTIONS:
                self.answer_all()
                self.go_on()
            case _:
                self.go_on()

    def answer_all(self) -> None:
        """Answer everything on the page."""
        for item in self.view.page.items if self.view.page else ():
            if not isinstance(item, TextPage):
                self.send(happened.ResponseGiven(at_ms=self.now, item=item.id, value=some_answer(item)))

    def send(self, event: WorldEvent) -> None:
        """Hand over one event; only what is accepted reaches the twin, which must then answer the same."""
        stage, measures, keeping = self.session.stage, self.session.measures, self.session.keeping
        try:
            outcome = self.session.handle(event)
        except InvalidTransition:
            assert (self.session.stage, self.session.measures, self.session.keeping) == (stage, measures, keeping)
            return
        assert stage is not Stage.OVER or isinstance(event, happened.SessionResumed)
        assert not (self.view.paused and event.by_visitor)
        assert self.twin.handle(event) == outcome
        self.closed_in = stage if isinstance(event, happened.ApplicationClosed) else None
        self.look_at(event, outcome)

    def look_at(self, event: WorldEvent, outcome: Outcome) -> None:
        assert all(concluded.at_ms == event.at_ms for concluded in outcome.events)
        self.view.hear(event)
        self.view.follow(Outcome(outcome.events, (), outcome.recording))
        if isinstance(event, happened.TimerExpired):
            self.running.discard(event.timer)
        for command in outcome.effects:
            if isinstance(command, do.StartTimer):
                self.running.add(command.timer)
                assert command.after_ms >= 0
            elif isinstance(command, do.StopTimer):
                self.running.discard(command.timer)
            elif isinstance(command, do.ShowBoard):
                self.found = 0
            elif isinstance(command, do.UnlockBoard) and self.view.bubble and self.view.screen == "board":
                # Where taps do not wait, the board is open before the mark comes.
                assert self.view.mark is not None or not self.plan.timing.taps_wait
            self.view.show([command])
        if isinstance(event, happened.CardSelected):
            turned = [note for note in outcome.events if isinstance(note, happened.CardFlipped)]
            ignored = [note for note in outcome.events if isinstance(note, happened.CardSelectionRejected)]
            assert len(turned) + len(ignored) == 1

    # Sense

    @precondition(lambda self: self.session.stage is Stage.ATTRACT)
    @rule()
    def start(self) -> None:
        self.send(happened.SessionStarted(at_ms=self.now))

    @rule()
    def go_on(self) -> None:
        self.send(happened.ContinuePressed(at_ms=self.now))

    @precondition(lambda self: self.can_flip(*BOARDS))
    @rule(data=st.data())
    def flip(self, data: Any) -> None:
        flips, up = self.session.measures.flips, len(self.view.up)
        self.send(happened.CardSelected(at_ms=self.now, position=data.draw(st.sampled_from(self.view.closed))))
        assert self.session.measures.flips == flips + (self.session.stage is Stage.GAME)
        assert len(self.view.up) == up + 1

    def can_flip(self, *stages: Stage) -> bool:
        """Whether a card can be flipped in one of these stages."""
        open_now = bool(self.view.closed) and self.view.held is None and not self.view.paused
        return self.session.stage in stages and open_now

    @precondition(lambda self: self.can_flip(Stage.GAME))
    @rule(data=st.data())
    def follow_the_mark(self, data: Any) -> None:
        row, column = self.view.mark or (None, None)
        marked = [p for p in self.view.closed if row in (None, p.row) and column in (None, p.column)]
        self.send(happened.CardSelected(at_ms=self.now, position=data.draw(st.sampled_from(marked))))

    @precondition(lambda self: self.running)
    @rule(data=st.data())
    def wait(self, data: Any) -> None:
        timer = data.draw(st.sampled_from(sorted(self.running, key=lambda timer: timer.value)))
        self.send(happened.TimerExpired(at_ms=self.now, timer=timer))

    @precondition(lambda self: self.running - {Timer.IDLE, Timer.STILL_THERE})
    @rule(data=st.data())
    def wait_for_the_game(self, data: Any) -> None:
        running = self.running - {Timer.IDLE, Timer.STILL_THERE}
        timer = data.draw(st.sampled_from(sorted(running, key=lambda timer: timer.value)))
        self.send(happened.TimerExpired(at_ms=self.now, timer=timer))

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

    @precondition(lambda self: self.session.stage in (Stage.ABOUT_YOU, Stage.QUESTIONS))
    @rule(data=st.data())
    def answer(self, data: Any) -> None:
        assert self.view.page is not None
        item = data.draw(st.sampled_from(self.view.page.items))
        value = data.draw(st.sampled_from([None, some_answer(item)]))
        self.send(happened.ResponseGiven(at_ms=self.now, item=item.id, value=value))

    @precondition(lambda self: not self.view.paused and self.session.stage is not Stage.OVER)
    @rule()
    def do_as_one_is_asked(self) -> None:
        self.do_what_is_asked()

    @precondition(lambda self: self.session.stage is Stage.CONSENT)
    @rule()
    def decline(self) -> None:
        self.send(happened.ConsentDeclined(at_ms=self.now))

    @precondition(lambda self: self.session.stage is Stage.AGE)
    @rule(adult=st.booleans())
    def say_age(self, *, adult: bool) -> None:
        self.send(happened.AgeConfirmed(at_ms=self.now, adult=adult))

    # The experimenter

    @rule()
    def pause(self) -> None:
        self.send(happened.PauseRequested(at_ms=self.now))

    @precondition(lambda self: self.view.paused)
    @rule()
    def end_the_pause(self) -> None:
        self.send(happened.PauseEnded(at_ms=self.now))
        assert not self.view.paused

    @precondition(lambda self: self.view.bubble)
    @rule()
    def say_it_again(self) -> None:
        sentence, speaking = self.view.bubble, self.view.speaking
        self.send(happened.RepeatRequested(at_ms=self.now))
        assert self.view.bubble == sentence
        assert (self.view.speaking == speaking) is (speaking is not None)
        assert self.view.speaking is not None

    @precondition(lambda self: self.session.keeping is RecordingState.KEPT)
    @rule(body=st.sampled_from([EmbodimentName.AVATAR, EmbodimentName.robot("any")]))
    def go_on_after_a_cut(self, body: EmbodimentName) -> None:
        before, stage = self.session.stage, self.closed_in or self.session.stage
        self.send(happened.SessionResumed(at_ms=self.now, embodiment=body))
        assert self.session.stage is (before if stage is Stage.GAME else stage)
        if stage not in (Stage.GAME, Stage.OVER):
            assert (self.view.paused, self.view.still_there) == (False, False)
        if stage in (Stage.ABOUT_YOU, Stage.QUESTIONS):
            assert self.view.page is not None
            assert (self.view.page.number, self.view.answers) == (1, {})

    @precondition(lambda self: self.session.measures.flips > 6)
    @rule()
    def end_the_session(self) -> None:
        self.send(happened.AbortRequested(at_ms=self.now, reason="a fire drill"))
        assert self.session.stage is Stage.OVER

    # Nonsense

    @rule(event=ANYTHING)
    def anything(self, event: WorldEvent) -> None:
        self.send(event)

    @precondition(lambda self: self.session.measures.flips > 6)
    @rule()
    def close_the_kiosk(self) -> None:
        self.send(happened.ApplicationClosed(at_ms=self.now))

    # Promises

    @invariant()
    def the_board_is_not_held_for_ever(self) -> None:
        if self.session.stage in BOARDS and self.view.held is not None:
            assert self.running & OPENS[self.view.held]

    @invariant()
    def a_finished_game_goes_on(self) -> None:
        if self.session.stage in BOARDS and len(self.view.found) == self.view.rows * self.view.columns:
            assert Timer.FINISH in self.running

    @invariant()
    def a_practice_and_thanks_end_by_themselves(self) -> None:
        assert (Timer.PRACTICE in self.running) is (self.session.stage is Stage.PRACTICE)
        assert (Timer.THANKS in self.running) is (self.session.stage is Stage.THANKS)

    @invariant()
    def somebody_is_waited_for(self) -> None:
        if self.session.stage not in (Stage.ATTRACT, Stage.OVER):
            assert bool(self.running & {Timer.IDLE, Timer.STILL_THERE}) is not self.view.paused
            assert self.view.still_there is (Timer.STILL_THERE in self.running)

    @invariant()
    def found_pairs_stay_found(self) -> None:
        assert len(self.view.found) >= self.found
        self.found = len(self.view.found)
        if self.session.stage is not Stage.PRACTICE and self.view.screen != "practice":
            assert self.found == 2 * self.session.measures.pairs
        assert self.view.found <= set(self.view.up)
        assert len(set(self.view.up) - self.view.found) <= 2

    @invariant()
    def it_is_kept_or_forgotten_once_and_never_both(self) -> None:
        stage, kept = self.session.stage, self.view.kept
        expected = {RecordingState.UNDECIDED: [], RecordingState.KEPT: [do.StartRecording]}
        assert [type(said) for said in kept] == expected.get(self.session.keeping, [do.DiscardRecording])
        assert (not kept) is (stage is Stage.ATTRACT or stage in BEFORE_DECIDING) or self.view.forgotten is not None

    @invariant()
    def nobody_whose_session_is_forgotten_is_asked_anything(self) -> None:
        if self.view.forgotten is not None:
            asking = {Stage.CONSENT, Stage.AGE, Stage.ABOUT_YOU, Stage.QUESTIONS, Stage.DEBRIEF}
            assert self.session.stage not in asking

    @invariant()
    def a_mark_goes_with_its_sentence(self) -> None:
        if self.view.mark is not None and self.session.stage is Stage.GAME:
            assert self.view.bubble

    @invariant()
    def what_is_over_is_over(self) -> None:
        over = self.session.stage is Stage.OVER
        assert over is (self.view.ended is not None)
        assert not (over and (self.view.paused or self.view.still_there or self.view.speaking or self.view.bubble))
        if over:
            assert not self.running
            assert isinstance(self.view.ended, Status)
            for event in (happened.SessionStarted(at_ms=1), happened.ApplicationClosed(at_ms=1)):
                self.send(event)
            assert self.session.stage is Stage.OVER


TestAnySession = AnySession.TestCase
TestAnySession.settings = settings(max_examples=120, stateful_step_count=50, deadline=None, report_multiple_bugs=False)
