"""Before every flip the two layers decide, and what they decided from can be seen."""

from __future__ import annotations

from random import Random

import pytest

from kiosk.assistance.assistant import Assistant
from kiosk.assistance.mentaliser import Mentaliser, TargetRule
from kiosk.assistance.policy import ACTIONS, ActionSpec, FlipInMove, Gate, GateDecision, State
from kiosk.game import Board, Concentration
from tests.samples import ANIMALS, always, mixed, policy_that


@pytest.fixture
def game() -> Concentration:
    """Return a game on the study's board."""
    return Concentration(Board.deal(4, 6, ANIMALS, Random(1)))


def mentaliser() -> Mentaliser:
    """One that points to the paper's target."""
    return Mentaliser(TargetRule.MOST_FLIPPED, Random(2))


def flip_any(game: Concentration) -> None:
    """Make one flip, as a player without a memory would."""
    game.flip(game.closed[0])
    game.turn_back()


def test_a_closed_gate_means_no_help_whatever_the_table_says(game: Concentration) -> None:
    decision = Assistant(always(ActionSpec.SUG_CARD, Gate()), mentaliser()).decide(game)
    assert (decision.gate_decision, decision.action, decision.hint) == (GateDecision.OPENING, ActionSpec.NO_HELP, None)
    assert decision.q == (0.0, 0.0, 0.0, 1.0)


def test_an_open_gate_asks_the_table(game: Concentration) -> None:
    policy = mixed()
    decision = Assistant(policy, mentaliser()).decide(game)
    assert decision.gate_decision is GateDecision.OPEN
    assert decision.action is policy.action(decision.state)
    assert decision.q == policy.row(decision.state)


@pytest.mark.parametrize("action", [ActionSpec.SUG_COL, ActionSpec.SUG_ROW, ActionSpec.SUG_CARD])
def test_help_comes_as_a_hint_that_points_to_the_mentaliser_s_target(game: Concentration, action: ActionSpec) -> None:
    flip_any(game)
    hint = Assistant(always(action), mentaliser()).decide(game).hint
    assert hint is not None
    assert (hint.action, hint.card) == (action, FlipInMove.SECOND)
    assert hint.target == mentaliser().target(game)
    assert hint.name == game.board.card(hint.target.position)


def test_a_hint_before_a_first_card_says_so(game: Concentration) -> None:
    hint = Assistant(always(ActionSpec.SUG_ROW), mentaliser()).decide(game).hint
    assert hint is not None
    assert hint.card is FlipInMove.FIRST


def test_no_help_draws_nothing_from_chance(game: Concentration) -> None:
    chance = Random(2)
    Assistant(always(ActionSpec.NO_HELP), Mentaliser(TargetRule.RANDOM, chance)).decide(game)
    assert chance.getstate() == Random(2).getstate()


def test_the_state_holds_the_assistance_of_the_decision_before(game: Concentration) -> None:
    policy = policy_that(lambda state: ACTIONS[(int(state.last) + 1) % len(ACTIONS)])
    assistant = Assistant(policy, mentaliser())
    last = []
    for _ in range(6):
        last.append(assistant.decide(game).state.last)
        flip_any(game)
    assert last == [
        ActionSpec.NO_HELP,
        ActionSpec.SUG_COL,
        ActionSpec.SUG_ROW,
        ActionSpec.SUG_CARD,
        ActionSpec.NO_HELP,
        ActionSpec.SUG_COL,
    ]


def test_a_decision_that_the_gate_took_counts_as_no_help(game: Concentration) -> None:
    assistant = Assistant(always(ActionSpec.SUG_CARD, Gate(opening=0, first_patience=4)), mentaliser())
    decisions = []
    for _ in range(6):
        decisions.append(assistant.decide(game))
        flip_any(game)
    assert [decision.action.label for decision in decisions] == [
        *("no_help", "sug_card"),
        *("no_help", "sug_card"),
        *("sug_card", "sug_card"),
    ]
    assert [decision.state.last for decision in decisions[1:]] == [decision.action for decision in decisions[:-1]]


def test_the_state_is_that_of_the_game(game: Concentration) -> None:
    assistant = Assistant(always(ActionSpec.SUG_CARD), mentaliser())
    last = ActionSpec.NO_HELP
    for _ in range(10):
        decision = assistant.decide(game)
        assert decision.state == State.of(game, last)
        last = decision.action
        flip_any(game)


def test_two_assistants_do_not_share_what_they_remember(game: Concentration) -> None:
    policy = always(ActionSpec.SUG_CARD)
    Assistant(policy, mentaliser()).decide(game)
    assert Assistant(policy, mentaliser()).decide(game).state.last is ActionSpec.NO_HELP
