"""The 48 states are distinct, have names, and are read off a game as in the paper."""

from __future__ import annotations

from itertools import product

import pytest

from kiosk.assistance.policy import ACTIONS, STATES, ActionSpec, FlipInMove, MoveOutcome, Phase, State
from kiosk.game import Concentration, Position
from tests.samples import board_of


def test_there_are_forty_eight_states_and_every_combination_is_one() -> None:
    assert len(STATES) == 48
    assert set(STATES) == {State(*parts) for parts in product(Phase, ACTIONS, MoveOutcome)}


def test_a_state_and_its_index_say_the_same() -> None:
    assert [state.index for state in STATES] == list(range(48))
    assert [State.at(index) for index in range(48)] == list(STATES)


def test_a_state_s_label_names_phase_assistance_and_outcome() -> None:
    assert STATES[0].label == "beginning/no_help/f_correct"
    assert State(Phase.MIDDLE, ActionSpec.SUG_ROW, MoveOutcome.S_WRONG).label == "middle/sug_row/s_wrong"
    assert STATES[47].label == "end/sug_card/s_wrong"
    assert len({state.label for state in STATES}) == 48


def test_the_order_of_states_and_actions_is_fixed_for_ever() -> None:
    """Policy files and stored events name them; a Q-table's rows and columns are counted in this order."""
    assert [action.label for action in ACTIONS] == ["no_help", "sug_col", "sug_row", "sug_card"]
    assert [phase.name for phase in Phase] == ["BEGINNING", "MIDDLE", "END"]
    assert [outcome.name for outcome in MoveOutcome] == ["F_CORRECT", "F_WRONG", "S_CORRECT", "S_WRONG"]
    assert [state.label for state in STATES[:6]] == [
        "beginning/no_help/f_correct",
        "beginning/no_help/f_wrong",
        "beginning/no_help/s_correct",
        "beginning/no_help/s_wrong",
        "beginning/sug_col/f_correct",
        "beginning/sug_col/f_wrong",
    ]
    assert STATES[16].label == "middle/no_help/f_correct"


def test_an_action_s_level_is_the_paper_s_measure_of_assistance() -> None:
    assert {action.label: action.level for action in ACTIONS} == {
        "no_help": 0.0,
        "sug_col": 0.5,
        "sug_row": 1.0,
        "sug_card": 2.0,
    }


@pytest.mark.parametrize(
    ("found", "phase"),
    [(0, "BEGINNING"), (3, "BEGINNING"), (4, "MIDDLE"), (7, "MIDDLE"), (8, "END"), (11, "END"), (12, "END")],
)
def test_a_game_of_twelve_pairs_has_three_phases_of_four(found: int, phase: str) -> None:
    assert Phase.of(found, 12) is Phase[phase]


@pytest.mark.parametrize(
    ("pairs", "phases"),
    [(1, "BE"), (2, "BME"), (3, "BMEE"), (4, "BBMEE"), (6, "BBMMEEE"), (10, "BBBBMMMEEEE")],
)
def test_other_boards_are_cut_in_thirds_too(pairs: int, phases: str) -> None:
    """A phase begins with the first pair that reaches its third of them."""
    assert "".join(Phase.of(found, pairs).name[0] for found in range(pairs + 1)) == phases


@pytest.mark.parametrize(
    ("card", "matched", "outcome"),
    [
        (FlipInMove.FIRST, None, MoveOutcome.F_CORRECT),
        (FlipInMove.FIRST, True, MoveOutcome.F_CORRECT),
        (FlipInMove.FIRST, False, MoveOutcome.F_WRONG),
        (FlipInMove.SECOND, None, MoveOutcome.S_CORRECT),
        (FlipInMove.SECOND, True, MoveOutcome.S_CORRECT),
        (FlipInMove.SECOND, False, MoveOutcome.S_WRONG),
    ],
)
def test_an_outcome_joins_the_coming_card_to_the_last_completed_move(
    card: FlipInMove, outcome: MoveOutcome, *, matched: bool | None
) -> None:
    assert MoveOutcome.of(card, last_move_matched=matched) is outcome


def test_a_state_is_read_off_a_game() -> None:
    game = Concentration(board_of("abc", "cab"))
    outcomes = [State.of(game, ActionSpec.NO_HELP).outcome.name]
    for row, column in ((0, 0), (0, 1), (0, 0), (1, 1), (0, 1)):
        game.flip(Position(row, column))
        game.turn_back()
        outcomes.append(State.of(game, ActionSpec.NO_HELP).outcome.name)
    assert outcomes == ["F_CORRECT", "S_CORRECT", "F_WRONG", "S_WRONG", "F_CORRECT", "S_CORRECT"]
    assert State.of(game, ActionSpec.SUG_ROW) == State(Phase.MIDDLE, ActionSpec.SUG_ROW, MoveOutcome.S_CORRECT)


def test_the_coming_card_is_the_second_only_while_one_card_lies_open() -> None:
    game = Concentration(board_of("ab", "ba"))
    assert FlipInMove.coming(game) is FlipInMove.FIRST
    game.flip(Position(0, 0))
    assert FlipInMove.coming(game) is FlipInMove.SECOND
    game.flip(Position(0, 1))
    assert FlipInMove.coming(game) is FlipInMove.FIRST
