"""A moment of a stored sitting, found again from what was recorded, and held against it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace

from kiosk import BadInput
from kiosk.assistant.adaptation import table_before
from kiosk.assistant.assistant import Decision
from kiosk.assistant.explain import Explanation
from kiosk.assistant.mdp import Action
from kiosk.assistant.mentaliser import TargetRule
from kiosk.game import Board, Concentration, Position
from kiosk.store.reading import Archive
from kiosk.study.after.measures import of_the_game
from kiosk.study.after.moment import Moment
from kiosk.study.condition import Condition
from kiosk.study.events import AssistanceDecided, BoardDealt, CardFlipped, Event, HintGiven


def explained(archive: Archive, number: int, flip: int) -> Explanation:
    """The decision before a flip (from 1) of a stored sitting, laid open.

    Raises BadInput if there was none, or if it comes out otherwise today than it was recorded.
    """
    game = _Recorded.of(of_the_game(archive.events(number)), f"sitting {number}")
    explanation = _moment(archive, number, game, flip).explained()
    if not game.agrees(flip, explanation):
        raise BadInput(f"flip {flip} of {game.where} comes out otherwise today than it was decided then")
    hint = game.hints.get(flip)
    return replace(explanation, said=hint.sentence if hint else None)


def _moment(archive: Archive, number: int, game: _Recorded, flip: int) -> Moment:
    plan = archive.plan(number)
    game.check_reached(flip, helped=plan.condition is not Condition.NO_ASSISTANCE)
    before, hint = game.decisions.get(flip - 1), game.hints.get(flip)
    flips = tuple(game.flips[: flip - 1])
    return Moment(
        board=game.board,
        flips=flips,
        last=before.action if before else Action.NO_HELP,
        condition=plan.condition,
        rule=TargetRule(plan.settings.assistance.target_rule),
        policy=table_before(plan.policy, plan.settings.assistance.step, Concentration(game.board), flips),
        catalogue=plan.catalogue,
        target=hint.target if hint else None,
    )


@dataclass
class _Recorded:
    """What was recorded of the sitting's game: a board, its flips, and by flip number the decisions and hints."""

    where: str
    board: Board
    flips: list[Position] = field(default_factory=list)
    decisions: dict[int, AssistanceDecided] = field(default_factory=dict)
    hints: dict[int, HintGiven] = field(default_factory=dict)

    @classmethod
    def of(cls, events: Iterable[Event], where: str) -> _Recorded:
        """The game among the events of its stage; raises BadInput if none was dealt."""
        game = None
        for event in events:
            if isinstance(event, BoardDealt):
                game = cls(where, Board(event.rows, event.columns, event.cards))
            elif game is not None:
                game.take(event)
        if game is None:
            raise BadInput(f"in {where} no game was dealt, so there is nothing to explain")
        return game

    def take(self, event: Event) -> None:
        """Add what one event tells of the game."""
        match event:
            case CardFlipped(position=position):
                self.flips.append(position)
            case AssistanceDecided(flip=flip):
                self.decisions[flip] = event
            case HintGiven(flip=flip):
                self.hints[flip] = event

    def check_reached(self, flip: int, *, helped: bool) -> None:
        """Raise BadInput if nothing was decided before this flip, or, where nobody helps, it never came."""
        if flip in self.decisions or (not helped and flip <= len(self.flips)):
            return
        raise BadInput(f"{self.where} has {len(self.flips)} flips; nothing was decided about a flip {flip}")

    def agrees(self, flip: int, explanation: Explanation) -> bool:
        """Whether the explanation is what was recorded, in all that was recorded of it."""
        return self._same_decision(flip, explanation.decision) and self._same_hint(flip, explanation)

    def _same_decision(self, flip: int, today: Decision) -> bool:
        stored, state = self.decisions.get(flip), today.state
        return stored is None or (stored.game, stored.last, stored.outcome, stored.gate, stored.action) == (
            *(state.game, state.last, state.outcome),
            *(today.verdict, today.action),
        )

    def _same_hint(self, flip: int, explanation: Explanation) -> bool:
        stored, today = self.hints.get(flip), explanation.decision.hint
        if stored is None or today is None:
            return stored is None and today is None
        return (stored.seen, stored.mate_seen, stored.reason, stored.row, stored.column) == (
            *(today.target.seen, today.target.mate_seen, today.target.reason),
            *(today.row, today.column),
        ) and (stored.target in explanation.candidates and stored.sentence in explanation.sentences)
