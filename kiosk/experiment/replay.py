"""Replay a stored session through the state machine, and rebuild the moment of any decision."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import partial
from random import Random

from kiosk import UserInputError
from kiosk.assistance.adaptation import table_before_flip
from kiosk.assistance.assistant import (
    BY_TABLE,
    Decision,
    DecisionRules,
    Explanation,
    Policy,
    Situation,
    explain_decision,
    game_after,
    memory_before_flip,
)
from kiosk.assistance.comments import Comment
from kiosk.assistance.hesitation import Wait
from kiosk.assistance.hint_sentences import Wording
from kiosk.assistance.memory_model import MemoryEstimate
from kiosk.assistance.mentaliser import Mentaliser, Target, TargetRule
from kiosk.assistance.policy import ENCOURAGEMENT, PRAISE, ActionSpec, MoveOutcome, State
from kiosk.assistance.wording import Catalogue
from kiosk.config import ConditionConfig
from kiosk.experiment.condition import Condition, help_in
from kiosk.experiment.dealt_boards import BoardRemark, DealtBoard
from kiosk.experiment.effects import Outcome
from kiosk.experiment.events import Event, HesitationNoticed, HintCue, HintGiven, RemarkTrigger, WorldEvent
from kiosk.experiment.outcomes import Stage
from kiosk.experiment.session import Session
from kiosk.experiment.session_config import SessionConfig
from kiosk.experiment.transitions import InvalidTransition
from kiosk.game import Board, Concentration, Position
from kiosk.lazy_dataclass import dataclass


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
    """Return the steps of a session from its events, numbered from 1.

    It ends where this version of the program refuses an event.
    """
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
    """Return the number of the first event that today comes out otherwise than it was recorded; None if all agree."""
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
    last: ActionSpec
    condition: Condition
    cell: ConditionConfig
    rule: TargetRule
    policy: Policy
    catalogue: Catalogue
    override: ActionSpec | None = None
    target: Position | None = None
    seed: int = 0
    rules: DecisionRules = BY_TABLE
    memory: MemoryEstimate | None = None
    drawn: ActionSpec | None = None
    """The action that was taken, where chance had a part in it."""
    hesitated: HesitationNoticed | None = None
    """Set where the help came because the player hesitated."""
    commented: Comment | None = None
    """Set where there was a comment on the move before."""

    @classmethod
    def before(cls, flip: int, game: DealtBoard, plan: SessionConfig) -> DecisionContext:
        """Rebuild the moment before a flip (from 1) of a game that was played; the flip need not have come."""
        hint = game.hints.get(flip)
        flips = tuple(each.event.position for number, each in game.flips.items() if number < flip)
        config, decision = plan.settings.assistance, game.decisions.get(flip)
        actions = {number: each.action for number, each in game.decisions.items()} if config.explore else None
        return cls(
            board=game.board,
            flips=flips,
            last=game.action(flip - 1),
            condition=plan.condition,
            cell=plan.cell,
            rule=TargetRule(config.target_rule),
            policy=table_before_flip(plan.policy, config.step, Concentration(game.board), flips, actions),
            catalogue=plan.catalogue,
            target=hint.given.target if hint else None,
            rules=DecisionRules.of(config),
            memory=memory_before_flip(config, game.board, flips, game.hints) if plan.cell.helps else None,
            drawn=decision.action if decision and config.explore else None,
            hesitated=game.hesitations.get(flip),
            commented=_comment(game.remarks.get(flip)),
        )

    def explained(self) -> Explanation:
        """Return the decision of this moment, laid open; raises UserInputError if there can be no such moment."""
        game, chance = game_after(self.board, self.flips), Random(self.seed)
        given = help_in(self.cell, self.rule, Wording(self.catalogue, chance), chance)
        if given is None:
            return self._commented(explain_decision(game, self._undecided(game), None, None))
        point = partial(self._point, given.mentaliser)
        taken = self.override or (self.hesitated.action if self.hesitated else self.drawn)
        decision = self.rules.decide(Situation(game, self.last, self.memory), self.policy, point, taken)
        overridden = self.override is not None
        explanation = explain_decision(game, decision, given.mentaliser, given.sentences, overridden=overridden)
        return self._commented(replace(explanation, rules=self.rules, hesitation=_hesitation(self.hesitated)))

    def _commented(self, explanation: Explanation) -> Explanation:
        """Return an explanation with the comment on the move before, if there was one."""
        if self.commented is None:
            return explanation
        sentences = self.catalogue.wordings(self.commented.action.message)
        return replace(explanation, comment=self.commented, sentences=sentences)

    def _point(self, mentaliser: Mentaliser, game: Concentration) -> Target:
        return mentaliser.target(game) if self.target is None else mentaliser.pointing_at(self.target, game)

    def _undecided(self, game: Concentration) -> Decision:
        """Return what gate and table hold in a condition without help."""
        if self.override not in (None, ActionSpec.NO_HELP):
            raise UserInputError(
                f"in the condition {self.condition.name} there is no help, so there is no action to explain"
            )
        state = State.of(game, self.last)
        verdict, row = self.policy.gate.decide(game), self.policy.row(state)
        return Decision(state, verdict, row, ActionSpec.NO_HELP, None, self.policy.actions)


def _hesitation(noticed: HesitationNoticed | None) -> Wait | None:
    return Wait(noticed.waited_ms, noticed.usual_ms, noticed.threshold_ms) if noticed else None


def _comment(remark: BoardRemark | None) -> Comment | None:
    if remark is None or remark.given.trigger is not RemarkTrigger.COMMENT:
        return None
    return Comment(remark.given.action, remark.given.probability)


def agrees_with_record(explanation: Explanation, game: DealtBoard, flip: int) -> bool:
    """Tell whether a decision comes out as it was recorded for this flip, in all that was recorded of it."""
    return (
        _is_same_decision(game, flip, explanation.decision)
        and _is_same_memory(game, flip, explanation.decision.memory)
        and _is_same_hint(game, flip, explanation)
        and _is_same_remark(game, flip, explanation)
    )


def _is_due(comment: Comment, explanation: Explanation) -> bool:
    """Tell whether a comment is on how the move before ended, and in place of a hint."""
    wanted = PRAISE if explanation.decision.state.outcome is MoveOutcome.F_CORRECT else ENCOURAGEMENT
    return comment.action is wanted and explanation.decision.action is ActionSpec.NO_HELP


def _is_same_decision(game: DealtBoard, flip: int, today: Decision) -> bool:
    stored, state = game.decisions.get(flip), today.state
    if stored is None:
        return True
    if (stored.game, stored.last, stored.outcome, stored.gate, stored.greedy) != (
        *(state.game, state.last, state.outcome),
        *(today.gate_decision, today.greedy),
    ):
        return False
    if flip in game.hesitations:
        # The decision was to give no help, before the player hesitated.
        return stored.action is ActionSpec.NO_HELP and today.action is game.hesitations[flip].action
    return stored.action is today.action and math.isclose(stored.probability, today.probability)


def _is_same_memory(game: DealtBoard, flip: int, today: MemoryEstimate | None) -> bool:
    """Compare within what the last digit of another machine may come to."""
    stored = game.memories.get(flip)
    if stored is None or today is None:
        return stored is None and today is None
    numbers = (
        *((stored.forgetting, today.forgetting), (stored.match_recalled, today.match_recalled)),
        *((stored.completes, today.completes), (stored.last_flip, today.last_flip)),
    )
    return (
        all(_is_close(one, other) for one, other in numbers)
        and len(stored.recall) == len(today.recall)
        and all(abs(one - other) <= 1 for one, other in zip(stored.recall, today.recall, strict=True))
    )


_LAST_DIGIT = 0.0002


def _is_close(one: float | None, other: float | None) -> bool:
    if one is None or other is None:
        return one is other
    return abs(one - other) <= _LAST_DIGIT


def _is_same_remark(game: DealtBoard, flip: int, explanation: Explanation) -> bool:
    stored = game.remarks.get(flip)
    if stored is None:
        return not explanation.decision.is_remark
    if explanation.comment is not None and not _is_due(explanation.comment, explanation):
        return False
    return stored.given.sentence in explanation.sentences


def _is_same_hint(game: DealtBoard, flip: int, explanation: Explanation) -> bool:
    hint, today = game.hints.get(flip), explanation.decision.hint
    if hint is None or today is None:
        return hint is None and today is None
    stored = hint.given
    return (stored.seen, stored.mate_seen, stored.reason, stored.row, stored.column) == (
        *(today.target.seen, today.target.mate_seen, today.target.reason),
        *(today.row, today.column),
    ) and (stored.target in explanation.candidates and _can_be_said(stored, explanation))


def _can_be_said(stored: HintGiven, explanation: Explanation) -> bool:
    if stored.cue is HintCue.GAZE:
        return not explanation.sentences
    return stored.sentence in explanation.sentences
