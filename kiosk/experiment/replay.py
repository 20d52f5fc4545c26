"""Replay a stored session through the state machine, and rebuild the moment of any decision."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from random import Random

from kiosk import UserInputError
from kiosk.assistance.assistant import Decision, Explanation, Policy, decide, explain_decision, game_after
from kiosk.assistance.mentaliser import Mentaliser, Target, TargetRule
from kiosk.assistance.policy import Action, State
from kiosk.assistance.wording import Catalogue, Wording
from kiosk.experiment.condition import Condition, help_in
from kiosk.experiment.effects import Outcome
from kiosk.experiment.events import Event, Stage, WorldEvent
from kiosk.experiment.session import Session
from kiosk.experiment.session_config import SessionConfig
from kiosk.experiment.transitions import InvalidTransition
from kiosk.game import Board, Concentration, Position


@dataclass(frozen=True)
class ReplayStep:
    """One event from outside, what it led to, and the stage that the session was in afterwards.

    ``seq`` is the event's number in the record, from 1; ``agrees``: what was concluded then is what is concluded now.
    """

    seq: int
    event: WorldEvent
    outcome: Outcome
    stage: Stage
    agrees: bool


def replay_events(plan: SessionConfig, seed: int, events: Sequence[Event]) -> tuple[ReplayStep, ...]:
    """The steps of a session from its events, numbered from 1; it ends where the program of today refuses an event."""
    session = Session(plan, seed)
    steps: list[ReplayStep] = []
    for index, event in enumerate(events):
        if not isinstance(event, WorldEvent):
            continue
        try:
            outcome = session.handle(event)
        except InvalidTransition:
            break
        recorded = tuple(events[index + 1 : index + 1 + len(outcome.events)])
        steps.append(ReplayStep(index + 1, event, outcome, session.stage, agrees=outcome.events == recorded))
    return tuple(steps)


def first_difference(steps: Iterable[ReplayStep], events: Sequence[Event]) -> int | None:
    """The number of the first event that today comes out otherwise than it was recorded; None if all agree."""
    steps = tuple(steps)
    differing = next((step.seq for step in steps if not step.agrees), None)
    if differing is not None:
        return differing
    reached = {step.seq for step in steps}
    world = (number for number, event in enumerate(events, 1) if isinstance(event, WorldEvent))
    return next((number for number in world if number not in reached), None)


@dataclass(frozen=True)
class DecisionContext:
    """The board, the flips so far, the last action, and what the help follows.

    ``override`` takes the place of the action that gate and table come to. ``target`` is the card that was pointed
    at, where that is known; otherwise ``seed`` chooses among those that the rule allows.
    """

    board: Board
    flips: tuple[Position, ...]
    last: Action
    condition: Condition
    rule: TargetRule
    policy: Policy
    catalogue: Catalogue
    override: Action | None = None
    target: Position | None = None
    seed: int = 0

    def explained(self) -> Explanation:
        """The decision of this moment, laid open; raises BadInput if there can be no such moment."""
        game, chance = game_after(self.board, self.flips), Random(self.seed)
        given = help_in(self.condition, self.rule, Wording(self.catalogue, chance), chance)
        if given is None:
            return explain_decision(game, self._undecided(game), None, None)
        point = partial(self._point, given.mentaliser)
        decision = decide(game, self.last, self.policy, point, self.override)
        return explain_decision(game, decision, given.mentaliser, given.sentences, overridden=self.override is not None)

    def _point(self, mentaliser: Mentaliser, game: Concentration) -> Target:
        return mentaliser.target(game) if self.target is None else mentaliser.pointing_at(self.target, game)

    def _undecided(self, game: Concentration) -> Decision:
        """What gate and table hold where nobody asks them."""
        if self.override not in (None, Action.NO_HELP):
            raise UserInputError(
                f"in the condition {self.condition.value} nobody helps, so there is no action to explain"
            )
        state = State.of(game, self.last)
        return Decision(state, self.policy.gate.decide(game), self.policy.row(state), Action.NO_HELP, None)
