"""The same decision process as a Gymnasium environment, so that others can train their own agents on it.

It plays by the rules of ``vectorised_game`` and is the only module that needs ``gymnasium`` (the optional extra "gym").
"""

from __future__ import annotations

from operator import index
from typing import Any

import gymnasium as gym
import numpy as np
from numpy.typing import NDArray

from kiosk import UserInputError
from kiosk.assistance.mentaliser import TargetRule
from kiosk.assistance.policy import Gate
from kiosk.errors import one_of
from kiosk.training.learning import THE_GATE
from kiosk.training.rewards import PURSE, REWARDS, Reward, reward_flip, reward_of
from kiosk.training.simulated_players import MemoryPlayer, SimulatedPlayer
from kiosk.training.simulation import lay, playing, start, take
from kiosk.training.vectorised_game import (
    CARDS,
    COLUMNS,
    COUNT,
    FIRST,
    FLIPS,
    FOUND,
    MATE,
    NO_HELP,
    PAIRS,
    PAIRS_FOUND,
    RANDOM,
    ROWS,
    STATES,
    USUAL,
    floats,
    gate_plan,
    is_open,
    new_game,
    state,
)

ENVIRONMENT = "recollect/Assistance-v0"
"""The name under which ``gymnasium.make`` finds it once this module is imported."""
SEEDS = 1 << 62
NO_ACTION = -1


class AssistanceEnv(gym.Env[int, int]):
    """A robot helps a simulated player through a game of Concentration with 24 cards.

    ## Description
    Before every flip of the player the agent chooses how much to help; then the player flips one card, following the
    hint or not. The player is part of the environment, as is the choice of the card that a hint points to.

    ## Action space
    ``Discrete(4)``: 0 no help, 1 point to the column, 2 to the row, 3 to the card. Any type of whole number will do.
    Everything else raises ``gymnasium.error.InvalidAction``, whether or not the gate is open; so do booleans.

    ## Observation space
    ``Discrete(48)``: ``(phase * 4 + last) * 4 + outcome``, where
    - ``phase``: 0 beginning (0-3 pairs found), 1 middle (4-7), 2 end (8-11);
    - ``last``: the action at the previous flip (0 at the start);
    - ``outcome``: 0 and 1 before a first card, 2 and 3 before a second; even if the last completed move matched
      (or there is none yet), odd if it did not.

    ## Starting state
    0: twelve pairs, shuffled, all closed.

    ## Rewards
    ``reward``: ``Reward.RETRIEVAL`` (the default), ``PAPER`` or ``RELEASED``, paid for each flip;
    see docs/explanation/learning.md.

    ## Episode end
    Terminated when the twelfth pair is found; truncated when a game is given up after 5,000 flips. After that, and
    before the first ``reset``, ``step`` raises ``gymnasium.error.ResetNeeded``.

    ## Information
    ``gate_open``: whether a hint may be considered at the coming flip; ``action_mask``: int8 of shape (4,), 1 for the
    actions that have an effect. While the gate is shut every action counts as "no help"; ``assistance`` is the action
    that was taken in this step. ``flips`` and ``pairs_found`` count.

    ## Arguments
    ``player`` (a memory player with d from .10 to .45), ``reward``, ``target`` (most flipped), ``gate`` (6, 4, 10),
    ``render_mode`` (None or "ansi": the board as text, with found pairs as letters, cards seen before as "o", the open
    card in brackets).
    """

    metadata: dict[str, Any] = {"render_modes": ["ansi"], "render_fps": 1}  # noqa: RUF012 - as Gymnasium declares it

    def __init__(
        self,
        *,
        player: SimulatedPlayer | None = None,
        reward: Reward = Reward.RETRIEVAL,
        target: TargetRule = TargetRule.MOST_FLIPPED,
        gate: Gate = THE_GATE,
        render_mode: str | None = None,
    ) -> None:
        """Seat the player; ``reset`` deals."""
        if render_mode not in (None, *self.metadata["render_modes"]):
            raise UserInputError(f"render_mode must be None or 'ansi', not {render_mode!r}")
        self.action_space = gym.spaces.Discrete(USUAL)  # type: ignore[assignment]  # its values are numpy's numbers
        self.observation_space = gym.spaces.Discrete(STATES)  # type: ignore[assignment]  # as above
        self.render_mode = render_mode
        self._table = lay(player or MemoryPlayer((0.1, 0.45)), gate_plan(gate, one_of("target", target, TargetRule)), 0)
        self._reward = REWARDS.index(one_of("reward", reward, Reward))
        self._purse = floats([PURSE])
        self._dealt = False
        self._over = False

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[int, dict[str, Any]]:
        """Deal a new game; with a ``seed`` all that follows is fixed by it."""
        super().reset(seed=seed, options=options)
        self._table.game[RANDOM] = new_game(int(self.np_random.integers(SEEDS)))[RANDOM]
        start(self._table)
        self._purse[0] = PURSE
        self._dealt, self._over = True, False
        return self._observation(), self._facts(NO_HELP)

    def step(self, action: int) -> tuple[int, float, bool, bool, dict[str, Any]]:
        """Help, let the player flip a card, and pay.

        Raises InvalidAction for what is not in the action space, and ResetNeeded where no game is under way.
        """
        asked = _action(action)
        self._check_under_way()
        game = self._table.game
        taken = asked if is_open(game, self._table.plan) else NO_HELP
        seen = reward_flip(game, taken)
        paid = reward_of(self._reward, seen, take(self._table, taken), self._purse)
        over = bool(game[PAIRS_FOUND] == PAIRS)
        given_up = not over and not playing(game)
        self._over = over or given_up
        return self._observation(), float(paid), over, given_up, self._facts(taken)

    def render(self) -> str | None:
        """Return the board as text, or None without a render mode; raises ResetNeeded before the first game."""
        if self.render_mode != "ansi":
            return None
        self._check_dealt()
        rows = (range(row * COLUMNS, (row + 1) * COLUMNS) for row in range(ROWS))
        return "\n".join("".join(self._sign(place) for place in row) for row in rows)

    def _check_dealt(self) -> None:
        if not self._dealt:
            raise gym.error.ResetNeeded("no game has been dealt yet: call reset() first")

    def _check_under_way(self) -> None:
        self._check_dealt()
        if self._over:
            raise gym.error.ResetNeeded("the game is over: call reset() to deal a new one before the next step()")

    def _sign(self, place: int) -> str:
        game = self._table.game
        letters = {pair: chr(ord("A") + n) for n, pair in enumerate(p for p in range(CARDS) if p < game[MATE + p])}
        letter = letters[min(place, int(game[MATE + place]))]
        if place == game[FIRST]:
            return f"[{letter}]"
        return f" {letter} " if game[FOUND + place] else " o " if game[COUNT + place] else " . "

    def _observation(self) -> int:
        return int(state(self._table.game))

    def _facts(self, taken: int) -> dict[str, Any]:
        game = self._table.game
        opened = bool(is_open(game, self._table.plan))
        mask: NDArray[np.int8] = np.array([1, opened, opened, opened], dtype=np.int8)
        counts = {"flips": int(game[FLIPS]), "pairs_found": int(game[PAIRS_FOUND])}
        return {"gate_open": opened, "action_mask": mask, "assistance": taken, **counts}


def _action(action: object) -> int:
    """Return the action as a plain number; raise InvalidAction for everything that is not one."""
    try:
        # index() takes whole numbers of every type and refuses 2.0 and "2"; a boolean is a mistake of the caller's.
        number = NO_ACTION if isinstance(action, bool) else index(action)  # type: ignore[arg-type]
    except TypeError:
        number = NO_ACTION
    if not 0 <= number < USUAL:
        raise gym.error.InvalidAction(f"the action must be a whole number from 0 to {USUAL - 1}, not {action!r}")
    return number


gym.register(ENVIRONMENT, entry_point="kiosk.training.environment:AssistanceEnv")
