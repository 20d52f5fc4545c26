"""A table that learns within a session: from the frozen one, by small steps, behind the gate, for this player only."""

from __future__ import annotations

from itertools import product
from pathlib import Path
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kiosk.assistance.adaptation import LearningAssistant, LearningTable, UpcomingFlip
from kiosk.assistance.assistant import Assistant, Decision
from kiosk.assistance.mentaliser import Mentaliser, TargetRule
from kiosk.assistance.policy import ACTIONS, NO_GATE, STATES, ActionSpec, Gate, Phase, QTable, State
from kiosk.game import Board, Concentration
from kiosk.training.rewards import RewardFlip, retrieved
from tests.samples import ANIMALS, always, mixed

STEP = 0.01


def mentaliser(seed: int = 0) -> Mentaliser:
    """Who points, which does not matter here."""
    return Mentaliser(TargetRule.MOST_FLIPPED, Random(seed))


def play(assistant: Assistant, seed: int, skill: float = 0.4) -> list[Decision]:
    """Play a game to its end, finding a mate now and then; the decisions."""
    rng = Random(seed)
    game, decisions = Concentration(Board.deal(4, 6, ANIMALS, rng)), []
    while not game.over:
        decisions.append(assistant.decide(game))
        knows = game.first_card is not None and rng.random() < skill
        game.flip(game.board.mate(game.first_card) if knows and game.first_card else rng.choice(game.closed))
        game.turn_back()
    if isinstance(assistant, LearningAssistant):
        assistant.finish(game)
    return decisions


def changes(before: QTable, after: QTable) -> dict[tuple[State, ActionSpec], float]:
    """By how much which values moved."""
    return {
        (state, action): after.row(state)[action] - before.row(state)[action]
        for state, action in product(STATES, ACTIONS)
        if after.row(state)[action] != before.row(state)[action]
    }


@given(st.floats(-10, 10), st.floats(0, 1), st.sampled_from(STATES), st.sampled_from(ACTIONS))
def test_a_value_moves_towards_the_sample_by_no_more_than_a_step(
    sample: float, step: float, state: State, action: ActionSpec
) -> None:
    frozen = mixed()
    table = LearningTable(frozen, step)
    table.learn(state, action, sample)
    before, after = frozen.row(state)[action], table.row(state)[action]
    assert abs(after - before) <= step + 1e-12
    assert abs(sample - after) <= abs(sample - before)
    assert set(changes(frozen, table.frozen())) <= {(state, action)}


def test_a_step_below_nothing_is_refused() -> None:
    with pytest.raises(ValueError, match="must be 0 or more, not -1"):
        LearningTable(mixed(), -1)


def test_with_no_step_at_all_it_is_the_frozen_assistant() -> None:
    for seed in range(5):
        frozen = mixed(seed, Gate())
        adaptive = LearningAssistant(frozen, mentaliser(), step=0)
        assert play(adaptive, seed) == play(Assistant(frozen, mentaliser()), seed)
        assert adaptive.table.frozen().sha256 == frozen.sha256


def test_a_session_changes_the_table_and_its_hash_and_leaves_the_frozen_one_alone(tmp_path: Path) -> None:
    file = tmp_path / "policy.json"
    file.write_text(mixed(1, Gate()).to_json(), "utf-8")
    content = file.read_bytes()
    frozen = QTable.load(file)
    adaptive = LearningAssistant(frozen, mentaliser(), STEP)
    play(adaptive, 3)
    assert adaptive.table.frozen().sha256 != frozen.sha256
    assert frozen == QTable.load(file)
    assert file.read_bytes() == content


def test_the_same_flips_give_the_same_table_whoever_points_where() -> None:
    tables = []
    for seed in (0, 99):
        adaptive = LearningAssistant(mixed(2, Gate()), mentaliser(seed), STEP)
        play(adaptive, 8)
        tables.append(adaptive.table.frozen())
    assert tables[0] == tables[1]


def test_nothing_is_learnt_behind_a_closed_gate() -> None:
    adaptive = LearningAssistant(always(ActionSpec.SUG_ROW, Gate(opening=10_000)), mentaliser(), STEP)
    play(adaptive, 1)
    assert adaptive.table.frozen().sha256 == always(ActionSpec.SUG_ROW, Gate(opening=10_000)).sha256


@pytest.mark.parametrize("gate", [Gate(), NO_GATE])
def test_only_what_was_decided_behind_an_open_gate_is_learnt_and_in_steps(gate: Gate) -> None:
    for seed in range(5):
        frozen = mixed(seed, gate)
        adaptive = LearningAssistant(frozen, mentaliser(), STEP)
        decided = [(d.state, d.action) for d in play(adaptive, seed) if d.gate_decision.is_open]
        moved = changes(frozen, adaptive.table.frozen())
        assert set(moved) <= set(decided)
        assert all(abs(by) <= STEP * decided.count(entry) + 1e-5 for entry, by in moved.items())


def test_matches_without_help_speak_for_not_helping() -> None:
    """All values are 0; only matches pay, so what was done on the way to them is worth more afterwards."""
    nothing = QTable.freeze("nothing", NO_GATE, [[0.0] * len(ACTIONS)] * len(STATES), {})
    adaptive = LearningAssistant(nothing, mentaliser(), step=1)
    play(adaptive, 4, skill=1)
    moved = changes(nothing, adaptive.table.frozen())
    assert {action for _, action in moved} == {ActionSpec.NO_HELP}
    assert all(by > 0 for by in moved.values())


def test_the_last_match_of_a_game_is_learnt_from_too() -> None:
    frozen = QTable.freeze("nothing", NO_GATE, [[0.0] * len(ACTIONS)] * len(STATES), {})
    adaptive = LearningAssistant(frozen, mentaliser(), step=1)
    game = Concentration(Board(1, 2, ("owl", "owl")))
    adaptive.decide(game)
    game.flip(game.closed[0])
    second = adaptive.decide(game)
    game.flip(game.closed[0])
    adaptive.finish(game)
    assert adaptive.table.row(second.state)[ActionSpec.NO_HELP] == pytest.approx(0.1)


def test_help_that_gives_the_card_away_is_worth_nothing() -> None:
    assert UpcomingFlip(ActionSpec.NO_HELP, ActionSpec.SUG_CARD, 6, Phase.END).value(matched=True) == 0
    assert UpcomingFlip(ActionSpec.NO_HELP, ActionSpec.NO_HELP, 6, Phase.END).value(matched=True) == 1
    assert UpcomingFlip(ActionSpec.NO_HELP, ActionSpec.NO_HELP, 6, Phase.END).value(matched=False) == 0


@pytest.mark.parametrize(("before", "action"), list(product(ACTIONS, ACTIONS)))
def test_a_match_is_worth_what_it_is_in_training(before: ActionSpec, action: ActionSpec) -> None:
    for nf, phase in product((2, 3, 5, 12), Phase):
        now = UpcomingFlip(before, action, nf, phase).value(matched=True)
        then = retrieved(RewardFlip(second=1, before=int(before), action=int(action), nf=nf, g=3 - phase, early=0))
        assert now == pytest.approx(then)
