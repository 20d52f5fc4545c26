"""Both layers together: one decision before every flip, and its explanation."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable
from dataclasses import asdict
from random import Random
from typing import Any, Protocol

from kiosk import UserInputError
from kiosk.assistance.comments import Comment
from kiosk.assistance.hesitation import Wait
from kiosk.assistance.hint_sentences import Sentences
from kiosk.assistance.memory_model import MemoryEstimate, MemoryModel, MemoryTiming
from kiosk.assistance.mentaliser import Hint, Mentaliser, Target
from kiosk.assistance.policy import ACTIONS, ActionSpec, Gate, GateDecision, State
from kiosk.config import AssistanceConfig
from kiosk.game import Board, Concentration, IllegalFlip, Position
from kiosk.lazy_dataclass import dataclass


class Policy(Protocol):
    """What an assistant asks how much to help: a table, frozen or not, and the gate before it."""

    @property
    def gate(self) -> Gate:
        """When the table is asked at all."""
        ...

    @property
    def actions(self) -> tuple[ActionSpec, ...]:
        """What it chooses among; the first is no help."""
        ...

    def row(self, state: State) -> tuple[float, ...]:
        """Return the values of a state, one for each action."""
        ...

    def action(self, state: State) -> ActionSpec:
        """Return the action to take in a state."""
        ...


@dataclass(frozen=True, slots=True)
class Decision:
    """What was decided before a flip, and from what.

    It holds the state, the gate, the row of the table, the action, and the hint if any.

    An action that needs no target is a remark: something is said, and there is no hint.
    """

    state: State
    gate_decision: GateDecision
    q: tuple[float, ...]
    action: ActionSpec
    hint: Hint | None
    actions: tuple[ActionSpec, ...] = ACTIONS
    """The actions that the values in ``q`` are of."""
    memory: MemoryEstimate | None = None
    """What the model of the player's memory held, where there is one."""
    by_memory: ActionSpec | None = None
    """What the timing by that model comes to; None where the table is asked."""
    probability: float = 1.0
    """The chance of this action, before chance decided."""
    flips: int = 0
    """How many flips had been made."""

    @property
    def greedy(self) -> ActionSpec:
        """Return what the gate and the table, or the model of memory, come to; none at a shut gate.

        Of a table it is the action with the highest value, the lowest of equals.
        """
        if not self.gate_decision.is_open:
            return ActionSpec.NO_HELP
        return self.by_memory or self.actions[self.q.index(max(self.q))]

    @property
    def is_randomised(self) -> bool:
        """Whether chance could have decided otherwise."""
        return self.probability < 1

    @property
    def is_remark(self) -> bool:
        """Whether something is said that points nowhere."""
        return self.hint is None and self.action is not ActionSpec.NO_HELP


@dataclass(frozen=True, slots=True)
class Situation:
    """What is decided from: the game, the help with the flip before, and the player's memory where it is modelled."""

    game: Concentration
    last: ActionSpec
    memory: MemoryEstimate | None = None


@dataclass(frozen=True, slots=True)
class DecisionRules:
    """What decides besides gate and table: timing by a model of memory, and exploration at random.

    With the probability ``explore``, the action is drawn among all of the table's, each as likely, where the gate is
    open.
    """

    timing: MemoryTiming | None = None
    explore: float = 0.0
    models_memory: bool = False

    @classmethod
    def of(cls, config: AssistanceConfig) -> DecisionRules:
        """Return the rules that a study file declares."""
        thresholds = (config.threshold_first, config.threshold_second, config.threshold_card)
        timing = MemoryTiming(*thresholds, config.threshold_flips) if config.timing == "model" else None
        return cls(timing, config.explore, config.models_memory)

    def probability(self, action: ActionSpec, greedy: ActionSpec, actions: tuple[ActionSpec, ...]) -> float:
        """Return the chance that an action is taken where the gate is open, and the rest comes to ``greedy``."""
        return self.explore / len(actions) * (action in actions) + (1 - self.explore) * (action is greedy)

    def draw(self, greedy: ActionSpec, actions: tuple[ActionSpec, ...], rng: Random) -> ActionSpec:
        """Return ``greedy``, or with the probability of exploring one of all actions."""
        return rng.choice(actions) if self.explore and rng.random() < self.explore else greedy

    def decide(
        self,
        situation: Situation,
        policy: Policy,
        point: Callable[[Concentration], Target],
        override: ActionSpec | None = None,
        rng: Random | None = None,
    ) -> Decision:
        """Decide about the coming flip; ``point`` is asked only for a hint.

        ``override`` is taken instead of the action that gate, table and chance come to. Rules that time help by memory
        need the memory of the situation; ``rng`` is asked only by rules that explore.
        """
        game, memory = situation.game, situation.memory
        state, verdict = State.of(game, situation.last), policy.gate.decide(game)
        by_memory = self.timing.action(memory, game.flips) if self.timing and memory else None
        q = policy.row(state) if by_memory is None else ()
        greedy, probability = ActionSpec.NO_HELP, 1.0
        if verdict.is_open:
            greedy = policy.action(state) if by_memory is None else by_memory
        action = greedy if override is None else override
        if verdict.is_open and self.explore:
            if override is None and rng is not None:
                action = self.draw(greedy, policy.actions, rng)
            probability = self.probability(action, greedy, policy.actions)
        hint = Hint.coming(action, point(game), game) if action.needs_target else None
        return Decision(state, verdict, q, action, hint, policy.actions, memory, by_memory, probability, game.flips)


BY_TABLE = DecisionRules()


class Assistant:
    """Decides the help for one game; it remembers its own last action, and at most what the player may remember."""

    def __init__(
        self, policy: Policy, mentaliser: Mentaliser, rules: DecisionRules = BY_TABLE, rng: Random | None = None
    ) -> None:
        """Take a table, whose gate it obeys, and a mentaliser, whose condition it does not know.

        ``rng`` is what ``rules`` explore with.
        """
        self._policy = policy
        self._mentaliser = mentaliser
        self._rules = rules
        self._memory: MemoryModel | None = None
        self._rng = rng
        self._last = ActionSpec.NO_HELP

    def decide(self, game: Concentration, override: ActionSpec | None = None) -> Decision:
        """Decide how much to help with the coming flip of ``game``, and where to point.

        The game must not be over. ``override`` is taken instead, where what was decided is known.
        """
        situation = Situation(game, self._last, self._estimate(game))
        decision = self._rules.decide(situation, self._policy, self._mentaliser.target, override, self._rng)
        self._last = decision.action
        return decision

    def offer(self, game: Concentration, action: ActionSpec) -> Hint:
        """Return a hint for the coming flip of ``game`` after all, though no help had been decided."""
        self._last = action
        return Hint.coming(action, self._mentaliser.target(game), game)

    def _estimate(self, game: Concentration) -> MemoryEstimate | None:
        """Return what the player may remember, where that is modelled."""
        if not self._rules.models_memory:
            return None
        if self._memory is None:
            self._memory = MemoryModel.of(game)
        self._memory.follow(game, hinted=self._last.needs_target)
        return self._memory.estimate()

    def finish(self, game: Concentration) -> str | None:  # noqa: ARG002 - for those that learn
        """Close a game that is over; return the sha256 of the table as it came out.

        It is None where nothing is ever learnt.
        """
        return None


@dataclass(frozen=True)
class Explanation:
    """One decision with everything around it.

    ``candidates`` are all cards the target rule could choose before this flip; they do not depend on the action, so
    they are there when no help is given as well. They are empty without an assistant. ``said`` is the sentence that
    was said, where the moment is one that has been.
    """

    board: Board
    decision: Decision
    candidates: tuple[Position, ...]
    sentences: tuple[str, ...]
    overridden: bool = False
    spoken: str | None = None
    rules: DecisionRules = BY_TABLE
    hesitation: Wait | None = None
    """Set where no help was decided, and the hint came because the player hesitated."""
    comment: Comment | None = None
    """Set where no help was decided, and there was a comment on the move before."""

    def to_json(self) -> dict[str, Any]:
        """Return the explanation as JSON values: locations from 0 row by row, rows and columns from 1.

        Without a hint ``target``, ``counts`` and ``reason`` are null. ``overridden`` is there only when the action
        was not left to gate and table, ``said`` only when it is known, ``memory`` only where memory is modelled,
        ``timing`` only where it decides (``q`` is empty then), ``chance`` only where the action was drawn,
        ``hesitation`` only where the help came because the player hesitated, and ``comment`` only where there was one.
        """
        decision = self.decision
        return {
            "state": {part: getattr(decision.state, part).name.lower() for part in ("game", "last", "outcome")}
            | {"index": decision.state.index_in(decision.actions)},
            "gate": {"open": decision.gate_decision.is_open, "reason": decision.gate_decision.value},
            "q": dict(self.values),
            **self._memory(),
            "action": decision.action.label,
            **({"hesitation": asdict(self.hesitation)} if self.hesitation else self._chance()),
            **({"comment": self._comment(self.comment)} if self.comment else {}),
            **({"overridden": True} if self.overridden else {}),
            **self._pointing(decision.hint),
            "targets": [self.board.location(position) for position in self.candidates],
            "sentences": list(self.sentences),
            **({"said": self.spoken} if self.spoken else {}),
        }

    @property
    def values(self) -> tuple[tuple[str, float], ...]:
        """The values of the table by action; none where the table was not asked."""
        return tuple(zip((action.label for action in self.decision.actions), self.decision.q, strict=False))

    def _memory(self) -> dict[str, Any]:
        memory, timing, by_memory = self.decision.memory, self.rules.timing, self.decision.by_memory
        told: dict[str, Any] = {"memory": asdict(memory) | {"recall": list(memory.recall)}} if memory else {}
        if timing and by_memory:
            told["timing"] = asdict(timing) | {"action": by_memory.label}
        return told

    @staticmethod
    def _comment(comment: Comment) -> dict[str, Any]:
        return {"action": comment.action.label, "probability": comment.probability}

    def _chance(self) -> dict[str, Any]:
        decision = self.decision
        if not decision.is_randomised:
            return {}
        chance = {"explore": self.rules.explore, "probability": decision.probability}
        return {"chance": chance | {"greedy": decision.greedy.label}}

    def _pointing(self, hint: Hint | None) -> dict[str, Any]:
        if hint is None:
            return {"target": None, "counts": None, "reason": None}
        position = hint.target.position
        return {
            "target": {
                "location": self.board.location(position),
                "row": position.row + 1,
                "column": position.column + 1,
                "card": hint.name,
            },
            "counts": {"target": hint.target.seen, "other": hint.target.mate_seen},
            "reason": hint.target.reason.value,
        }


def explain_decision(
    game: Concentration,
    decision: Decision,
    mentaliser: Mentaliser | None,
    speaker: Sentences | None,
    *,
    overridden: bool = False,
) -> Explanation:
    """Lay open a decision about the coming flip of ``game``; without a mentaliser and a speaker there is no help."""
    candidates = mentaliser.candidates(game) if mentaliser else ()
    sentences: tuple[str, ...] = ()
    if speaker and decision.hint:
        sentences = speaker.all_wordings(decision.hint)
    elif speaker and decision.is_remark:
        sentences = speaker.all_remarks(decision.action)
    return Explanation(game.board, decision, candidates, sentences, overridden)


def game_after(board: Board, flips: Iterable[Position]) -> Concentration:
    """Return the game after these flips, ready for the next one: unmatched cards have turned back.

    Raises UserInputError, naming the flip by its number, if the rules do not allow it or nothing is left to flip.
    """
    game = Concentration(board)
    for number, position in enumerate(flips, 1):
        try:
            game.flip(position)
        except IllegalFlip as refusal:
            raise UserInputError(f"flip {number} (location {board.location(position)}): {refusal}") from refusal
        game.turn_back()
    if game.over:
        raise UserInputError(f"the game is finished after {game.flips} flips, so there is no next flip to help with")
    return game


def memory_before_flip(
    config: AssistanceConfig, board: Board, flips: Iterable[Position], hinted: Container[int]
) -> MemoryEstimate | None:
    """Return what is thought of the player's memory after ``flips``, where the study models it.

    ``hinted`` holds the numbers of the flips, from 1, that had a hint.
    """
    if not config.models_memory:
        return None
    game = Concentration(board)
    model = MemoryModel.of(game)
    for number, position in enumerate(flips, 1):
        model.flip(board.location(position), hinted=number in hinted)
    return model.estimate()
