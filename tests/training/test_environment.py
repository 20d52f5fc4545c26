"""The Gymnasium environment is a good citizen of Gymnasium, and is the same decision process."""

from __future__ import annotations

from typing import Any

import pytest

gymnasium: Any = pytest.importorskip("gymnasium")

from gymnasium.utils.env_checker import check_env  # noqa: E402 - after the import that may skip this file

from kiosk.assistant.gate import NO_GATE  # noqa: E402
from kiosk.assistant.mdp import STATES, Action, Outcome, Phase  # noqa: E402
from kiosk.assistant.mentaliser import TargetRule  # noqa: E402
from kiosk.assistant.qtable import QTable  # noqa: E402
from kiosk.training.environment import ENVIRONMENT, Assistance  # noqa: E402
from kiosk.training.players import MemoryPlayer  # noqa: E402
from kiosk.training.rewards import Reward  # noqa: E402
from kiosk.training.simulation import Spread, simulate  # noqa: E402


@pytest.mark.parametrize("reward", Reward)
def test_gymnasium_s_own_check_finds_nothing(reward: Reward) -> None:
    check_env(gymnasium.make(ENVIRONMENT, reward=reward).unwrapped)


def game(environment: Assistance, seed: int, action: int) -> list[tuple[int, float, bool, bool, dict[str, Any]]]:
    """All the steps of one game in which the same help is asked for before every flip."""
    environment.reset(seed=seed)
    steps = [environment.step(action)]
    while not steps[-1][2]:
        steps.append(environment.step(action))
    return steps


def test_a_seed_fixes_the_game_and_what_follows() -> None:
    first, again = (repr(game(Assistance(), seed, 1)) for seed in (3, 3))
    assert first == again != repr(game(Assistance(), 4, 1))


def test_behind_a_shut_gate_every_action_is_no_help_and_the_mask_says_so() -> None:
    environment = Assistance()
    _, facts = environment.reset(seed=1)
    for _ in range(6):
        assert (facts["gate_open"], facts["action_mask"].tolist()) == (False, [1, 0, 0, 0])
        _, _, _, _, facts = environment.step(Action.SUG_CARD)
        assert facts["assistance"] == Action.NO_HELP


def test_without_a_gate_card_hints_end_a_game_in_24_flips_and_earn_nothing() -> None:
    steps = game(Assistance(gate=NO_GATE), 2, Action.SUG_CARD)
    assert len(steps) == steps[-1][4]["flips"] == 24
    assert sum(reward for _, reward, *_ in steps) == 0


def test_a_player_left_alone_earns_one_for_each_of_the_twelve_pairs() -> None:
    steps = game(Assistance(), 5, Action.NO_HELP)
    assert sum(reward for _, reward, *_ in steps) == 12
    assert steps[-1][4]["pairs_found"] == 12


def test_observations_are_the_rows_of_the_table() -> None:
    for observation, _, over, _, facts in game(Assistance(), 6, Action.SUG_ROW):
        state = STATES[observation]
        assert state.game is Phase.of(facts["pairs_found"], 12)
        assert state.last is Action(facts["assistance"])
        first = state.outcome in (Outcome.F_CORRECT, Outcome.F_WRONG)
        assert over or first == (facts["flips"] % 2 == 0)


def test_the_default_table_plays_here_as_in_the_simulation() -> None:
    table, player, games = QTable.named("default"), MemoryPlayer((0.2, 0.2)), 400
    environment = Assistance(player=player, target=TargetRule.RANDOM)
    flips: list[float] = []
    for number in range(games):
        observation, facts = environment.reset(seed=number)
        over = False
        while not over:
            observation, _, over, _, facts = environment.step(table.action(STATES[observation]))
        flips.append(float(facts["flips"]))
    here, there = Spread.of(flips), simulate(table, player, TargetRule.RANDOM, 1000, 1).flips
    # Four standard errors of the difference.
    assert abs(here.mean - there.mean) < 4 * (here.sd**2 / games + there.sd**2 / 1000) ** 0.5


def test_the_board_can_be_looked_at_as_text() -> None:
    environment = Assistance(render_mode="ansi")
    environment.reset(seed=1)
    assert environment.render() == "\n".join([" . " * 6] * 4)
    environment.step(0)
    drawn = environment.render()
    assert drawn is not None
    assert drawn.count("[") == 1
    assert Assistance().render() is None
