"""The same decision process as a Gymnasium environment, so that others can train their own agents on it.

It plays by the rules of this room's kernel and is the only module that needs ``gymnasium`` (the optional extra "gym").
"""

from __future__ import annotations

from typing import Any

import gymnasium as gym
import numpy as np
from numpy.typing import NDArray

from kiosk.assistant.gate import Gate
from kiosk.assistant.mentaliser import TargetRule
from kiosk.training.kernel import (
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
    floats,
    is_open,
    new_game,
    plan,
    state,
)
from kiosk.training.learning import THE_GATE
from kiosk.training.players import MemoryPlayer, Player
from kiosk.training.rewards import PURSE, REWARDS, Reward, coming, pay
from kiosk.training.simulation import lay, playing, start, take

ENVIRONMENT = "recollect/Assistance-v0"
"""The name under which ``gymnasium.make`` finds it once this module is imported."""
SEEDS = 1 << 62


class Assistance(gym.Env[int, int]):
    """A robot helps a simulated player through a game of Concentration with 24 cards.

    ## Description
    Before every flip of the player the agent chooses how much to help; then the player flips one card, following the
    hint or not. The player is part of the environment, as is the choice of the card that a hint points to.

    ## Action space
    ``Discrete(4)``: 0 no help, 1 point to the column, 2 to the row, 3 to the card.

    ## Observation space
    ``Discrete(48)``: ``(phase * 4 + last) * 4 + outcome``, where
    - ``phase``: 0 beginning (0-3 pairs found), 1 middle (4-7), 2 end (8-11);
    - ``last``: the action at the previous flip (0 at the start);
    - ``outcome``: 0 and 1 before a first card, 2 and 3 before a second; even if the last completed move matched
      (or there is none yet), odd if it did not.

    ## Starting state
    0: twelve pairs, shuffled, all closed.

    ## Rewards
    ``reward``: ``Reward.RETRIEVAL`` (the default), ``PAPER`` or ``RELEASED``, paid for each flip; docs/learning.md.

    ## Episode end
    Terminated when the twelfth pair is found; truncated when a game is given up after 5,000 flips.

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
        player: Player | None = None,
        reward: Reward = Reward.RETRIEVAL,
        target: TargetRule = TargetRule.MOST_FLIPPED,
        gate: Gate = THE_GATE,
        render_mode: str | None = None,
    ) -> None:
        """Seat the player; ``reset`` deals."""
        self.action_space = gym.spaces.Discrete(4)  # type: ignore[assignment]  # its values are numpy's whole numbers
        self.observation_space = gym.spaces.Discrete(48)  # type: ignore[assignment]  # as above
        self.render_mode = render_mode
        self._table = lay(player or MemoryPlayer((0.1, 0.45)), plan(gate, target), 0)
        self._reward = REWARDS.index(reward)
        self._purse = floats([PURSE])

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[int, dict[str, Any]]:
        """Deal a new game; with a ``seed`` all that follows is fixed by it."""
        super().reset(seed=seed, options=options)
        self._table.game[RANDOM] = new_game(int(self.np_random.integers(SEEDS)))[RANDOM]
        start(self._table)
        self._purse[0] = PURSE
        return self._observation(), self._facts(NO_HELP)

    def step(self, action: int) -> tuple[int, float, bool, bool, dict[str, Any]]:
        """Help, let the player flip a card, and pay."""
        game = self._table.game
        taken = int(action) if is_open(game, self._table.plan) else NO_HELP
        seen = coming(game, taken)
        paid = pay(self._reward, seen, take(self._table, taken), self._purse)
        over = bool(game[PAIRS_FOUND] == PAIRS)
        given_up = not over and not playing(game)
        return self._observation(), float(paid), over, given_up, self._facts(taken)

    def render(self) -> str | None:
        """The board as text, or None without a render mode."""
        if self.render_mode != "ansi":
            return None
        rows = (range(row * COLUMNS, (row + 1) * COLUMNS) for row in range(ROWS))
        return "\n".join("".join(self._sign(place) for place in row) for row in rows)

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


gym.register(ENVIRONMENT, entry_point="kiosk.training.environment:Assistance")
