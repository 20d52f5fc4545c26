"""A rehearsal in which the robot fails at a chosen moment, and what must hold whatever the moment and the fault."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.effects import Outcome
from kiosk.experiment.events import Event, WorldEvent
from kiosk.experiment.outcomes import Stage, Status
from kiosk.experiment.projections import SpeechCounts, count_speech
from kiosk.experiment.session import Session
from kiosk.experiment.session_state import SessionState
from kiosk.store.listing import StoredSession
from kiosk.store.queries import SessionRepository
from kiosk.ui.app import App
from kiosk.ui.rehearsal import Rehearsal


class Moment(Enum):
    """When the robot fails: with the click that leads into a stage, or in the middle of the game."""

    INTRODUCTION = "introduction"
    GAME = "game"
    MIDDLE = "middle of the game"
    RESULT = "result"
    QUESTIONS = "questions"


class Sabotage(Rehearsal):
    """A session in which ``strike`` is called once: just before click number ``at`` or before a stage's first event."""

    def __init__(self, app: App, seed: int, strike: Callable[[], None], at: int | Moment) -> None:
        super().__init__(app, seed)
        self._strike: Callable[[], None] | None = strike
        self._at = at
        self._clicks = 0
        self.unseen: list[str] = []
        """Sentences that were to be said and did not stand in the bubble."""
        self._check = app.runner.on_event
        app.runner.on_event = self._look

    def run(self) -> None:
        """Go through the session to its end.

        A signal ends the loop at once: a session cut off by one would pass for one that the robot's fault has ended.
        """
        super().run()
        assert not self._app.stop_requested, "another program has asked this process to end"

    def _click(self, name: str) -> None:
        self._clicks += 1
        if self._strike is not None and self._is_time(name):
            strike, self._strike = self._strike, None
            strike()
        super()._click(name)

    def _is_time(self, name: str) -> bool:
        board, shown = self._app.screens.board, self._app.screens.kiosk.shown
        match self._at:
            case Moment.INTRODUCTION:
                return name.startswith("start-")
            case Moment.GAME:
                return shown == "introduction"
            case Moment.MIDDLE:
                return shown == "game" and len(board.closed) <= len(board.unmatched) + board.rowCount() // 2
            case Moment.RESULT:
                return shown == "game" and len(board.closed) == 1
            case Moment.QUESTIONS:
                return shown == "result"
        return self._clicks >= self._at

    def _look(self, event: WorldEvent, outcome: Outcome, stage: Stage) -> None:
        said = [command.sentence for command in outcome.effects if isinstance(command, do.Speak)]
        if said and self._app.screens.avatar.property("bubble") != said[-1]:
            self.unseen.append(said[-1])
        if self._check is not None:
            self._check(event, outcome, stage)


@dataclass(frozen=True)
class Result:
    """What became of a session."""

    session: StoredSession
    pairs: int
    """How many there were to be found."""
    events: list[Event]
    unseen: list[str]
    longest_gap_ms: float

    @property
    def utterances(self) -> SpeechCounts:
        """What became of its sentences."""
        return count_speech(SessionState.from_events(self.events))

    @property
    def embodiment_changes(self) -> int:
        """How often the body changed."""
        return len(SessionState.from_events(self.events).embodiment_changes)

    def faults(self) -> list[str]:
        """Whatever must not be; nothing, if all is well."""
        counted = self.utterances
        wrong = {
            "the session did not end": self.session.status is not Status.COMPLETED,
            "not all pairs were found": self.session.pairs != self.pairs,
            "it began with another body": not self.session.embodiment.startswith("robot:"),
            "a sentence was neither heard nor shown": bool(self.unseen),
            "a sentence is missing in the data": counted.requested != counted.finished + counted.shown_only,
            "the body changed more than once": self.embodiment_changes > 1,
        }
        return [what for what, holds in wrong.items() if holds]


def result_of(stored: SessionRepository, rehearsal: Sabotage) -> Result:
    """Return what became of the last session."""
    session = stored.sessions()[-1]
    game = stored.plan(session.id).settings.game
    pairs = game.rows * game.columns // 2
    return Result(session, pairs, stored.events(session.id), rehearsal.unseen, rehearsal.pulse.longest_ms)


def replayed(stored: SessionRepository, number: int) -> list[Event]:
    """Return the events of a stored session as they come out of its world events today."""
    session = Session(stored.plan(number), stored.seed(number))
    again: list[Event] = []
    for event in stored.events(number):
        if isinstance(event, WorldEvent):
            outcome = session.handle(event)
            again += [event, *outcome.events]
    return again


def after_loss(events: list[Event]) -> list[Event]:
    """Return what followed the loss of the robot."""
    lost = next(number for number, event in enumerate(events) if isinstance(event, happened.RobotDisconnected))
    return events[lost + 1 :]
