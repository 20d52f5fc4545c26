"""The Gymnasium environment is a good citizen of Gymnasium, and is the same decision process."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

import pytest

gymnasium: Any = pytest.importorskip("gymnasium")

import numpy as np  # noqa: E402 - after the import that may skip this file
from gymnasium.error import InvalidAction, ResetNeeded  # noqa: E402
from gymnasium.utils.env_checker import check_env  # noqa: E402 - after the import that may skip this file

from kiosk import UserInputError  # noqa: E402
from kiosk.assistance.mentaliser import TargetRule  # noqa: E402
from kiosk.assistance.policy import (  # noqa: E402
    ACTIONS,
    NO_GATE,
    STATES,
    ActionSpec,
    MoveOutcome,
    Phase,
    QTable,
)
from kiosk.training.environment import ENVIRONMENT, AssistanceEnv  # noqa: E402
from kiosk.training.rewards import Reward  # noqa: E402
from kiosk.training.simulated_players import LONGEST, NEVER, TEXT, MemoryPlayer  # noqa: E402
from kiosk.training.simulation import Spread, simulate_games  # noqa: E402
from kiosk.training.vectorised_game import PAIRS, Floats, Ints  # noqa: E402


@pytest.mark.parametrize("reward", Reward)
def test_gymnasium_s_own_check_finds_nothing(reward: Reward) -> None:
    check_env(gymnasium.make(ENVIRONMENT, reward=reward).unwrapped)


@dataclass(frozen=True)
class Stubborn:
    """A player of our own whose games do not end: one of the paper's text who forgets fast, with all flips counted."""

    name: ClassVar[str] = "stubborn"
    follow: float = 1.0

    def parameters(self) -> dict[str, Any]:
        return {"name": self.name}

    def numbers(self) -> tuple[Ints, Floats]:
        return [TEXT, 1, *[NEVER] * (PAIRS + 1)], [self.follow, 0.5, 0.5, *[0.0] * LONGEST]


def game(environment: AssistanceEnv, seed: int, action: int) -> list[tuple[int, float, bool, bool, dict[str, Any]]]:
    """All the steps of one game in which the same help is asked for before every flip."""
    environment.reset(seed=seed)
    steps = [environment.step(action)]
    while not steps[-1][2]:
        steps.append(environment.step(action))
    return steps


def test_a_seed_fixes_the_game_and_what_follows() -> None:
    first, again = (repr(game(AssistanceEnv(), seed, 1)) for seed in (3, 3))
    assert first == again != repr(game(AssistanceEnv(), 4, 1))


def test_behind_a_shut_gate_every_action_is_no_help_and_the_mask_says_so() -> None:
    environment = AssistanceEnv()
    _, facts = environment.reset(seed=1)
    for _ in range(6):
        assert (facts["gate_open"], facts["action_mask"].tolist()) == (False, [1, 0, 0, 0])
        _, _, _, _, facts = environment.step(int(ActionSpec.SUG_CARD))
        assert facts["assistance"] == int(ActionSpec.NO_HELP)


def test_without_a_gate_card_hints_end_a_game_in_24_flips_and_earn_nothing() -> None:
    steps = game(AssistanceEnv(gate=NO_GATE), 2, int(ActionSpec.SUG_CARD))
    assert len(steps) == steps[-1][4]["flips"] == 24
    assert sum(reward for _, reward, *_ in steps) == 0


def test_a_player_left_alone_earns_one_for_each_of_the_twelve_pairs() -> None:
    steps = game(AssistanceEnv(), 5, int(ActionSpec.NO_HELP))
    assert sum(reward for _, reward, *_ in steps) == 12
    assert steps[-1][4]["pairs_found"] == 12


def test_observations_are_the_rows_of_the_table() -> None:
    for observation, _, over, _, facts in game(AssistanceEnv(), 6, int(ActionSpec.SUG_ROW)):
        state = STATES[observation]
        assert state.game is Phase.of(facts["pairs_found"], 12)
        assert state.last is ACTIONS[facts["assistance"]]
        first = state.outcome in (MoveOutcome.F_CORRECT, MoveOutcome.F_WRONG)
        assert over or first == (facts["flips"] % 2 == 0)


def test_the_default_table_plays_here_as_in_the_simulation() -> None:
    table, player, games = QTable.named("default"), MemoryPlayer((0.2, 0.2)), 400
    environment = AssistanceEnv(player=player, target=TargetRule.RANDOM)
    flips: list[float] = []
    for number in range(games):
        observation, facts = environment.reset(seed=number)
        over = False
        while not over:
            observation, _, over, _, facts = environment.step(int(table.action(STATES[observation])))
        flips.append(float(facts["flips"]))
    here, there = Spread.of(flips), simulate_games(table, player, TargetRule.RANDOM, 1000, 1).flips
    # Four standard errors of the difference.
    assert abs(here.mean - there.mean) < 4 * (here.sd**2 / games + there.sd**2 / 1000) ** 0.5


def test_the_board_can_be_looked_at_as_text() -> None:
    environment = AssistanceEnv(render_mode="ansi")
    environment.reset(seed=1)
    assert environment.render() == "\n".join([" . " * 6] * 4)
    environment.step(0)
    drawn = environment.render()
    assert drawn is not None
    assert drawn.count("[") == 1
    assert AssistanceEnv().render() is None


ACTIONS_OF_ANY_TYPE = (
    1,
    ActionSpec.SUG_COL,
    *(kind(1) for kind in (np.int8, np.uint8, np.int16, np.int32, np.int64, np.uint64)),
    np.array(1),
)
NO_ACTIONS: tuple[Any, ...] = (
    *(-1, 4, 7, 10**30, -(10**30), np.int64(-1), np.uint8(255), np.uint64(2**64 - 1)),
    *(2.5, 2.0, float("nan"), np.float32(1), np.array(1.0)),
    *(True, False, np.bool_(1), np.array([True])[0], np.array(1, dtype=bool)),
    *("x", "2", b"2", None, (), [1], np.array([1]), np.array([1, 2]), object()),
)


def before_the_gate_opens() -> AssistanceEnv:
    environment = AssistanceEnv()
    environment.reset(seed=1)
    return environment


def after_the_gate_opened() -> AssistanceEnv:
    environment = before_the_gate_opens()
    opened = False
    while not opened:
        *_, facts = environment.step(0)
        opened = facts["gate_open"]
    return environment


@pytest.mark.parametrize("at", [before_the_gate_opens, after_the_gate_opened])
def test_what_is_no_action_is_refused_in_words_whether_or_not_the_gate_is_open(at: Callable[[], AssistanceEnv]) -> None:
    environment, undisturbed = at(), at()
    for action in NO_ACTIONS:
        with pytest.raises(InvalidAction, match=r"^the action must be a whole number from 0 to 3, not "):
            environment.step(action)
    # The refusals leave the game as it was.
    assert repr(environment.step(0)) == repr(undisturbed.step(0))


@pytest.mark.parametrize("at", [before_the_gate_opens, after_the_gate_opened])
@pytest.mark.parametrize("action", ACTIONS_OF_ANY_TYPE, ids=lambda action: type(action).__name__)
def test_a_whole_number_of_any_type_is_an_action(at: Callable[[], AssistanceEnv], action: Any) -> None:
    plain = repr(at().step(1))
    assert repr(at().step(action)) == plain


def test_every_action_that_the_action_space_samples_is_taken() -> None:
    environment = before_the_gate_opens()
    environment.action_space.seed(1)
    for _ in range(20):
        environment.step(environment.action_space.sample())


def test_there_is_no_step_and_no_picture_before_the_first_reset() -> None:
    environment = AssistanceEnv(render_mode="ansi")
    for call in (lambda: environment.step(0), environment.render):
        with pytest.raises(ResetNeeded, match=r"^no game has been dealt yet: call reset\(\) first$"):
            call()


def test_there_is_no_step_after_the_last_pair_until_the_next_reset() -> None:
    environment = AssistanceEnv(gate=NO_GATE)
    game(environment, 2, int(ActionSpec.SUG_CARD))
    for _ in range(2):
        with pytest.raises(ResetNeeded, match=r"^the game is over: call reset\(\) to deal a new one"):
            environment.step(0)
    assert game(environment, 2, int(ActionSpec.SUG_CARD))[-1][4]["flips"] == 24


def test_there_is_no_step_after_a_game_that_was_given_up() -> None:
    environment = AssistanceEnv(player=Stubborn())
    environment.reset(seed=1)
    truncated = False
    while not truncated:
        _, _, over, truncated, _ = environment.step(0)
        assert not over
    with pytest.raises(ResetNeeded, match="the game is over"):
        environment.step(0)


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"render_mode": "human"}, "render_mode must be None or 'ansi', not 'human'"),
        ({"reward": "paper"}, "reward must be one of .*, not 'paper'"),
        ({"target": "random"}, "target must be one of .*, not 'random'"),
    ],
)
def test_arguments_that_are_none_are_refused_in_words(given: dict[str, Any], sentence: str) -> None:
    with pytest.raises(UserInputError, match=sentence):
        AssistanceEnv(**given)
