"""The players and the learner a second time, game by game on the real modules: slow, plain, and written apart.

Nothing of ``kiosk.training`` is used here, so that the kernel can be held against it, for its numbers and its speed.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass
from random import Random
from typing import Protocol

from kiosk.assistance.assistant import Assistant
from kiosk.assistance.mentaliser import Hint, Mentaliser, TargetRule
from kiosk.assistance.policy import ACTIONS, ActionSpec, FlipInMove, Gate, QTable, State
from kiosk.game import Board, Concentration, Position

NAMES = tuple("abcdefghijkl")


class Person(Protocol):
    """A player who chooses the next card."""

    def choose(self, game: Concentration, hint: Hint | None) -> Position: ...


@dataclass
class ByChance:
    """Draws names; once it may have seen the mate, a coin may give a sure match."""

    threshold: float
    rng: Random

    def choose(self, game: Concentration, hint: Hint | None) -> Position:
        first = game.first_card
        if first is not None and self._sure(game) and (hint is None or hint.action is not ActionSpec.SUG_CARD):
            return game.board.mate(first)
        if hint is not None:
            return self.rng.choice([place for place in game.closed if hint.followed_by(place)])
        name = self.rng.choice(sorted({game.board.card(place) for place in game.board if place not in game.found}))
        return self.rng.choice([place for place in game.closed if game.board.card(place) == name])

    def _sure(self, game: Concentration) -> bool:
        left = game.board.pairs - game.pairs_found
        seen = 1 - (1 - 1 / (2 * left - 1)) ** game.flips_since_match
        return seen > self.threshold and self.rng.random() < 1 / 2


class WithMemory:
    """Remembers with (1 - d)^age; takes a pair it recalls, and else a card of which it recalls nothing."""

    def __init__(self, forgetting: float, rng: Random) -> None:
        self._keeps, self._rng = 1 - forgetting, rng
        self._recalled: set[Position] = set()

    def choose(self, game: Concentration, hint: Hint | None) -> Position:
        if game.first_card is None:
            seen = [place for place in game.closed if game.history.count(place)]
            ages = {place: game.flips - game.history.last(place) for place in seen}
            self._recalled = {place for place, age in ages.items() if self._rng.random() < self._keeps**age}
        if hint is not None and hint.action is ActionSpec.SUG_CARD:
            return hint.target.position
        pointed = [place for place in game.closed if hint is None or hint.followed_by(place)]
        known = [place for place in pointed if self._completes(game, place)]
        if known:
            return known[0]
        return self._rng.choice([place for place in pointed if place not in self._recalled] or pointed)

    def _completes(self, game: Concentration, place: Position) -> bool:
        mate = game.board.mate(place)
        return place in self._recalled and (
            mate == game.first_card or (game.first_card is None and mate in self._recalled)
        )


@dataclass
class Played:
    """One game, counted."""

    flips: int = 0
    levels: float = 0.0
    first_card_hints: int = 0


def play(policy: QTable, person: Person, rule: TargetRule, rng: Random) -> Played:
    """One game under a policy."""
    game, assistant, played = deal(rng), Assistant(policy, Mentaliser(rule, rng)), Played()
    while not game.over:
        hint = assistant.decide(game).hint
        if hint is not None:
            played.levels += hint.action.level
            played.first_card_hints += hint.card is FlipInMove.FIRST
        game.flip(person.choose(game, hint))
        game.turn_back()
    played.flips = game.flips
    return played


def deal(rng: Random) -> Concentration:
    """Return a new game on the study's board."""
    return Concentration(Board.deal(4, 6, NAMES, rng))


Values = dict[State, list[float]]


def learn(episodes: int, rng: Random) -> Values:
    """Q-learning with the reward "retrieval", by the book; the mean of the values over the last half."""
    q: Values = defaultdict(lambda: [0.0] * len(ACTIONS))
    visits: dict[tuple[State, ActionSpec], int] = defaultdict(int)
    mean: Values = defaultdict(lambda: [0.0] * len(ACTIONS))
    for episode in range(episodes):
        for state, action, gained, discount, after in episode_of(q, max(0.1, 1 / (1 + 0.01 * episode)), rng):
            visits[state, action] += 1
            sample = gained + (discount * max(q[after]) if after is not None else 0)
            q[state][action] += visits[state, action] ** -0.6 * (sample - q[state][action])
        done = episode - episodes // 2 + 1
        for state in q if done > 0 else ():
            mean[state] = [m + (v - m) / done for m, v in zip(mean[state], q[state], strict=True)]
    return mean


def episode_of(
    q: Values, epsilon: float, rng: Random
) -> Iterable[tuple[State, ActionSpec, float, float, State | None]]:
    """Yield the decisions of one game: state, action, what was paid until the next one, its discount, and its state."""
    game, gate, mentaliser = deal(rng), Gate(), Mentaliser(TargetRule.MOST_FLIPPED, rng)
    person = WithMemory(rng.uniform(0.10, 0.45), rng)
    last, pending, gained, discount = ActionSpec.NO_HELP, None, 0.0, 1.0
    while not game.over:
        state, action = State.of(game, last), ActionSpec.NO_HELP
        if gate.decide(game).is_open:
            if pending is not None:
                yield *pending, gained, discount, state
            action = ACTIONS[q[state].index(max(q[state]))]
            action = rng.choice(list(ACTIONS)) if rng.random() < epsilon else action
            pending, gained, discount = (state, action), 0.0, 1.0
        gained += discount * _flip(game, person, mentaliser, last, action)
        discount *= 0.8
        last = action
    if pending is not None:
        yield *pending, gained, discount, None


def _flip(game: Concentration, person: Person, mentaliser: Mentaliser, before: ActionSpec, action: ActionSpec) -> float:
    card, hint = FlipInMove.coming(game), None
    g, nf = (3, 2, 1)[State.of(game, before).game], game.flips_since_match + 1
    if action is not ActionSpec.NO_HELP:
        target = mentaliser.target(game)
        hint = Hint(action, card, target, game.board.card(target.position))
    matched = game.flip(person.choose(game, hint)).matched
    game.turn_back()
    hints = (before is not ActionSpec.NO_HELP) + (action is not ActionSpec.NO_HELP)
    if card is FlipInMove.FIRST or not matched or action is ActionSpec.SUG_CARD:
        return 0.0
    return (1.0, 1 - (5 - g) / (2 * nf), 0.0)[hints]
