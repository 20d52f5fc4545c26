"""Tabular Q-learning over whole games: a recipe goes in, a frozen table that tells how it was made comes out.

A decision is taken before a flip; what is paid until the next decision is discounted by gamma per flip, also over the
flips at which the gate was shut.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import Enum
from typing import Any, NamedTuple

from kiosk import UserInputError, __version__
from kiosk.assistance.mentaliser import TargetRule
from kiosk.assistance.policy import ACTIONS, ActionSpec, Gate, QTable, states_with
from kiosk.errors import check_between, one_of, whole
from kiosk.training.native import native_loop
from kiosk.training.rewards import PURSE, REWARDS, Reward, reward_flip, reward_of
from kiosk.training.simulated_players import ChancePlayer, MemoryPlayer, SimulatedPlayer
from kiosk.training.simulation import (
    BATCH,
    T_FLIPS,
    GameTable,
    Progress,
    greedy,
    lay,
    playing,
    refuse_endless,
    start,
    take,
)
from kiosk.training.vectorised_game import (
    ACTION_COUNT,
    LEAD_OF,
    NO_HELP,
    OUTCOMES,
    PHASES,
    Floats,
    Ints,
    below,
    compiled_rule,
    floats,
    gate_plan,
    ints,
    is_open,
    state,
    unit,
)


class Exploration(Enum):
    """How often the learner tries an action at random, in episode e of E (from 0)."""

    FLOORED = "floored"
    """max(.1, 1 / (1 + .01 e))."""
    PAPER = "paper"
    """From 1 down to .1 in a straight line (the paper gives the two ends)."""
    RELEASED = "released"
    """1 / (1 + .01 e)."""


class LearningRate(Enum):
    """The learning rate: how far a value moves towards a new sample, in episode e of E (from 0)."""

    VISITS = "visits"
    """N(s, a)^-.6, N counting the samples of this entry: it decreases, so that many samples are weighed together."""
    PAPER = "paper"
    """From .1 up to .95 in a straight line (the paper gives the two ends)."""
    RELEASED = "released"
    """.1 (1 + .001 e), at most .96."""
    CONSTANT = "constant"
    """.1."""


_FORMULAS: dict[Exploration | LearningRate, str] = {
    Exploration.FLOORED: "max(.1, 1 / (1 + .01 e)) in episode e from 0",
    Exploration.PAPER: "1 - .9 e / E in episode e of E from 0",
    Exploration.RELEASED: "1 / (1 + .01 e) in episode e from 0",
    LearningRate.VISITS: "N(s, a)^-.6",
    LearningRate.PAPER: ".1 + .85 e / E in episode e of E from 0",
    LearningRate.RELEASED: "min(.96, .1 (1 + .001 e)) in episode e from 0",
    LearningRate.CONSTANT: ".1",
}


class Averaging(Enum):
    """Which table is frozen."""

    LAST_HALF = "last_half"
    """The mean of the tables after each episode of the last half (Polyak, Ruppert)."""
    NONE = "none"
    """The table as it stands after the last episode."""


class Decisions(Enum):
    """Which flips are decisions that are learnt from."""

    WHERE_OPEN = "where_open"
    """Those at which the gate is open."""
    EVERY_FLIP = "every_flip"
    """All; where the gate is shut the decision is "no help"."""


FLOORED, LINEAR_EPSILON, HYPERBOLIC = range(3)
MOST_EPISODES = 1_000_000_000
"""More would take days; a number beyond what the kernel can count is a slip of the keyboard."""
EPSILONS = (Exploration.FLOORED, Exploration.PAPER, Exploration.RELEASED)
VISITS, LINEAR_ALPHA, RISING, CONSTANT = range(4)
ALPHAS = (LearningRate.VISITS, LearningRate.PAPER, LearningRate.RELEASED, LearningRate.CONSTANT)
FLOOR, DECAY = 0.1, 0.01
FIRST_ALPHA, LAST_ALPHA, TOP_ALPHA, ALPHA_RISE = 0.1, 0.95, 0.96, 0.001
POWER = -0.6
THE_GATE = Gate()
LONGEST_MEMORY = 1 << 18
"""Samples of one entry after which its decreasing learning rate stays as it is (at .0006)."""
DECISIONS_AN_EPISODE = 24
"""More samples of one entry than any episode gives on the average: the table of learning rates is no longer."""


CHOICES: dict[str, type[Enum]] = {
    "reward": Reward,
    "epsilon": Exploration,
    "alpha": LearningRate,
    "averaging": Averaging,
    "decisions": Decisions,
    "target": TargetRule,
}
"""The fields of a recipe that are one of a closed set."""


@dataclass(frozen=True, slots=True)
class Recipe:
    """All that fixes a table: the same recipe and the same version of the program give the same file."""

    reward: Reward
    player: SimulatedPlayer
    episodes: int
    seed: int
    epsilon: Exploration
    alpha: LearningRate
    averaging: Averaging
    decisions: Decisions
    target: TargetRule
    gate: Gate = THE_GATE
    gamma: float = 0.8
    actions: tuple[ActionSpec, ...] = ACTIONS

    def __post_init__(self) -> None:
        """Refuse impossible numbers, and texts in place of members, with UserInputError."""
        for name, kind in CHOICES.items():
            one_of(name, getattr(self, name), kind)
        # They go into a file, which takes Python's own numbers only.
        object.__setattr__(self, "episodes", whole("the number of episodes", self.episodes))
        object.__setattr__(self, "seed", whole("the seed", self.seed))
        if not 0 <= self.episodes <= MOST_EPISODES:
            raise UserInputError(f"the number of episodes must be 0 to {MOST_EPISODES:,}, not {self.episodes}")
        if self.seed < 0:
            raise UserInputError(f"the seed must be 0 or more, not {self.seed}")
        check_between("gamma", self.gamma, 0, 1)

    def training(self, command: str) -> dict[str, Any]:
        """Return what a policy file says about how it was made; no dates, machines or paths."""
        return {
            "command": command,
            "version": __version__,
            "reward": self.reward.value,
            "player": self.player.parameters(),
            "episodes": self.episodes,
            "seed": self.seed,
            "gamma": self.gamma,
            "epsilon": f"{self.epsilon.value}: {_FORMULAS[self.epsilon]}",
            "alpha": f"{self.alpha.value}: {_FORMULAS[self.alpha]}",
            "averaging": self.averaging.value,
            "decisions": self.decisions.value,
            "target": self.target.value,
        }


_RETRIEVAL = Recipe(
    reward=Reward.RETRIEVAL,
    player=MemoryPlayer((0.1, 0.45)),
    episodes=25_000,
    seed=1,
    epsilon=Exploration.FLOORED,
    alpha=LearningRate.VISITS,
    averaging=Averaging.LAST_HALF,
    decisions=Decisions.WHERE_OPEN,
    target=TargetRule.MOST_FLIPPED,
)
RECIPES: dict[Reward, Recipe] = {
    Reward.RETRIEVAL: _RETRIEVAL,
    Reward.PAPER: replace(
        _RETRIEVAL,
        reward=Reward.PAPER,
        player=ChancePlayer(),
        epsilon=Exploration.PAPER,
        alpha=LearningRate.PAPER,
        averaging=Averaging.NONE,
        target=TargetRule.RANDOM,
    ),
    Reward.RELEASED: replace(
        _RETRIEVAL,
        reward=Reward.RELEASED,
        player=ChancePlayer(),
        episodes=100_000,
        epsilon=Exploration.RELEASED,
        alpha=LearningRate.RELEASED,
        averaging=Averaging.NONE,
        decisions=Decisions.EVERY_FLIP,
        target=TargetRule.RANDOM,
    ),
}
"""What ``recollect train --reward R`` does unless told otherwise."""

# The lesson's whole numbers.
REWARD, DECISIONS, EPSILON, ALPHA, EPISODES = range(5)
DECIDED = 1


class LearnerState(NamedTuple):
    """What is learnt and how, as the rules read it.

    Values, mean and visits have an entry per state and action.
    """

    plan: Ints
    gamma: Floats
    rates: Floats
    purse: Floats
    q: Floats
    mean: Floats
    visits: Ints
    choices: Ints
    costs: Floats


@compiled_rule
def epsilon_at(lesson: Ints, episode: int) -> float:
    """Return the chance of a random action; see ``Exploration``."""
    if lesson[EPSILON] == LINEAR_EPSILON:
        return 1.0 - (1.0 - FLOOR) * episode / lesson[EPISODES]
    falling = 1.0 / (1.0 + DECAY * episode)
    return max(FLOOR, falling) if lesson[EPSILON] == FLOORED else falling


@compiled_rule
def alpha_at(lesson: LearnerState, episode: int, visits: int) -> float:
    """Return the learning rate; see ``LearningRate``."""
    if lesson.plan[ALPHA] == VISITS:
        return lesson.rates[min(visits, len(lesson.rates) - 1)]
    if lesson.plan[ALPHA] == LINEAR_ALPHA:
        return FIRST_ALPHA + (LAST_ALPHA - FIRST_ALPHA) * episode / lesson.plan[EPISODES]
    if lesson.plan[ALPHA] == RISING:
        return min(TOP_ALPHA, FIRST_ALPHA * (1.0 + ALPHA_RISE * episode))
    return FIRST_ALPHA


@compiled_rule
def update_value(lesson: LearnerState, episode: int, entry: int, sample: float) -> None:
    """Move one value towards a sample of what it should be."""
    lesson.visits[entry] += 1
    lesson.q[entry] += alpha_at(lesson, episode, lesson.visits[entry]) * (sample - lesson.q[entry])


@compiled_rule
def learn_episode(table: GameTable, lesson: LearnerState, episode: int) -> None:
    """One episode: a game with epsilon-greedy help, and a step of Q-learning after each decision."""
    game, gate = table.game, table.plan
    start(table)
    lesson.purse[0] = PURSE
    epsilon, actions = epsilon_at(lesson.plan, episode), game[ACTION_COUNT]
    entry, gained, discount = -1, 0.0, 1.0
    while playing(game):
        row, action = state(game), NO_HELP
        opened = is_open(game, gate)
        if opened:
            action = below(game, actions) if unit(game) < epsilon else greedy(lesson.q, row, actions)
            lesson.choices[row] += 1
        if opened or lesson.plan[DECISIONS] == DECIDED:
            if entry >= 0:
                best = lesson.q[row * actions + greedy(lesson.q, row, actions)]
                update_value(lesson, episode, entry, gained + discount * best)
            entry, gained, discount = row * actions + action, 0.0, 1.0
        seen = reward_flip(game, gate[LEAD_OF + action])
        worth = reward_of(lesson.plan[REWARD], seen, take(table, action), lesson.purse)
        gained += discount * (worth - lesson.costs[action])
        discount *= lesson.gamma[0]
    if entry >= 0:
        update_value(lesson, episode, entry, gained)


@native_loop
@compiled_rule
def learn_episodes(table: GameTable, lesson: LearnerState, first: int, stop: int) -> None:
    """Learn from the episodes from ``first`` up to ``stop``.

    In the last half the mean of the values goes along.
    """
    half = lesson.plan[EPISODES] // 2
    for episode in range(first, stop):
        learn_episode(table, lesson, episode)
        if episode >= half:
            for entry in range(len(lesson.mean)):
                lesson.mean[entry] += (lesson.q[entry] - lesson.mean[entry]) / (episode - half + 1)


class Learner:
    """A recipe at work: it can be stopped after any batch, and what it knows by then can be frozen."""

    def __init__(self, recipe: Recipe) -> None:
        """Know nothing yet: every value is 0."""
        self.recipe = recipe
        self.episodes = 0
        self._table = lay(recipe.player, gate_plan(recipe.gate, recipe.target, recipe.actions), recipe.seed)
        self._lesson = _lesson(recipe)

    def study(self, progress: Progress = lambda _: None, stopped: Callable[[], bool] = lambda: False) -> None:
        """Play the recipe's episodes that are still to come; raises UserInputError if a game does not end.

        ``stopped`` is asked between two batches, and never within one: what is known then is what the same recipe
        knows after as many episodes.
        """
        while self.episodes < self.recipe.episodes and not stopped():
            stop = min(self.episodes + BATCH, self.recipe.episodes)
            learn_episodes(self._table, self._lesson, self.episodes, stop)
            refuse_endless(int(self._table.tally[T_FLIPS]))
            self.episodes = stop
            progress(stop)

    def freeze(self, name: str, command: str) -> QTable:
        """Return the table as it stands; one that was stopped early says so in its ``training``."""
        averaged = self.recipe.averaging is Averaging.LAST_HALF and self.episodes > self.recipe.episodes // 2
        flat = [float(value) for value in (self._lesson.mean if averaged else self._lesson.q)]
        actions = self.recipe.actions
        values = [flat[row : row + len(actions)] for row in range(0, len(flat), len(actions))]
        training = self.recipe.training(command) | {"visits": self._visits()}
        if self.episodes < self.recipe.episodes:
            training["stopped_after"] = self.episodes
        return QTable.freeze(name, self.recipe.gate, values, training, actions)

    def _visits(self) -> dict[str, int]:
        return {
            at.label: int(n) for at, n in zip(states_with(self.recipe.actions), self._lesson.choices, strict=True) if n
        }


def _lesson(recipe: Recipe) -> LearnerState:
    numbers = [
        REWARDS.index(recipe.reward),
        DECIDED if recipe.decisions is Decisions.EVERY_FLIP else 0,
        EPSILONS.index(recipe.epsilon),
        ALPHAS.index(recipe.alpha),
        recipe.episodes,
    ]
    states = PHASES * len(recipe.actions) * OUTCOMES
    blank = [0.0] * (states * len(recipe.actions))
    return LearnerState(
        ints(numbers),
        floats([recipe.gamma]),
        floats(_rates(recipe)),
        floats([0.0]),
        floats(blank.copy()),
        floats(blank.copy()),
        ints([0] * (states * len(recipe.actions))),
        ints([0] * states),
        floats([float(action.cost) for action in recipe.actions]),
    )


def _rates(recipe: Recipe) -> list[float]:
    """Return the decreasing learning rate, worked out beforehand: a power may differ in its last bit when compiled."""
    longest = min(recipe.episodes * DECISIONS_AN_EPISODE, LONGEST_MEMORY) if recipe.alpha is LearningRate.VISITS else 0
    return [1.0] + [count**POWER for count in range(1, longest + 1)]
