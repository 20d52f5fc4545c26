"""A condition is two switches, and one place says which."""

from __future__ import annotations

from random import Random

import pytest

from kiosk import UserInputError
from kiosk.assistance.mentaliser import Mentaliser, TargetRule
from kiosk.assistance.policy import ActionSpec, FlipInMove
from kiosk.assistance.wording import PlainSentences, ReasonedSentences, Wording
from kiosk.experiment.condition import Condition, Help, help_in
from kiosk.experiment.events import HintGiven
from kiosk.game import Concentration, Position
from tests.experiment.driver import Driver, at_random
from tests.samples import ENGLISH, always, board_of, plan

MENTALISED = {Condition.TOM, Condition.MENTALISED_UNEXPLAINED}
EXPLAINED = {Condition.TOM, Condition.RANDOM_EXPLAINED}
HELPED = [condition for condition in Condition if condition is not Condition.NO_ASSISTANCE]


def given_in(condition: Condition, rule: TargetRule = TargetRule.MOST_FLIPPED) -> Help:
    """Return the help in a condition in which somebody helps."""
    given = help_in(condition, rule, Wording(ENGLISH, Random(1)), Random(2))
    assert given is not None
    return given


def test_the_conditions_are_the_four_cells_and_no_assistance() -> None:
    assert [condition.value for condition in Condition] == [
        "tom",
        "notom",
        "mentalised_unexplained",
        "random_explained",
        "no_assistance",
    ]


def test_without_assistance_nobody_helps() -> None:
    assert help_in(Condition.NO_ASSISTANCE, TargetRule.MOST_FLIPPED, Wording(ENGLISH, Random(1)), Random(2)) is None


@pytest.mark.parametrize("rule", [TargetRule.MOST_FLIPPED, TargetRule.MOST_RECENT])
@pytest.mark.parametrize("condition", HELPED)
def test_the_first_switch_chooses_the_target(condition: Condition, rule: TargetRule) -> None:
    game = Concentration(board_of("abc", "cab"))
    for row, column in ((0, 0), (0, 1), (0, 0), (0, 2)):
        game.flip(Position(row, column))
        game.turn_back()
    followed = rule if condition in MENTALISED else TargetRule.RANDOM
    expected = Mentaliser(followed, Random(0)).candidates(game)
    assert given_in(condition, rule).mentaliser.candidates(game) == expected


@pytest.mark.parametrize("condition", HELPED)
def test_the_second_switch_gives_or_withholds_the_reason(condition: Condition) -> None:
    kind = ReasonedSentences if condition in EXPLAINED else PlainSentences
    assert type(given_in(condition).sentences) is kind


@pytest.mark.parametrize("condition", HELPED)
def test_a_condition_shows_in_what_is_said(condition: Condition) -> None:
    driver = Driver(plan(condition, always(ActionSpec.SUG_CARD)))
    driver.to_the_game()
    driver.flip(Position(0, 0))
    for hint in driver.noted(HintGiven):
        where = ENGLISH.wordings(
            f"point-{hint.card.value}-card", row=hint.target.row + 1, column=hint.target.column + 1
        )
        assert (hint.sentence not in where) is (condition in EXPLAINED)
        assert hint.sentence.endswith(where)


@pytest.mark.parametrize("condition", Condition)
def test_a_condition_is_found_by_its_name(condition: Condition) -> None:
    assert Condition.from_name(condition.value) is condition


@pytest.mark.parametrize("name", ["", "ToM", "TOM", "both"])
def test_another_name_is_refused_with_all_that_there_are(name: str) -> None:
    with pytest.raises(
        UserInputError, match=f"there is no condition '{name}'; there are tom, notom, mentalised_unexpl"
    ):
        Condition.from_name(name)


@pytest.mark.parametrize("seed", range(5))
def test_every_condition_plays_the_same_board_on_the_same_seed(seed: int) -> None:
    dealt = set()
    for condition in Condition:
        driver = Driver(plan(condition), seed)
        driver.to_the_game()
        driver.play(at_random(seed))
        dealt.add(tuple(sorted(driver.view.up.items())))
    assert len(dealt) == 1


def test_the_two_conditions_differ_on_first_cards_and_agree_on_second_ones() -> None:
    """Both hint at every flip; the visitor flips the same cards whatever is said."""
    targets = {}
    for condition in (Condition.TOM, Condition.NOTOM):
        driver = Driver(plan(condition, always(ActionSpec.SUG_CARD)), 4)
        driver.to_the_game()
        driver.play(at_random(4))
        targets[condition] = driver.noted(HintGiven)
    tom, notom = targets.values()
    assert len(tom) == len(notom) > 40
    assert all(
        one.target == other.target for one, other in zip(tom, notom, strict=True) if one.card is FlipInMove.SECOND
    )
    assert any(
        one.target != other.target for one, other in zip(tom, notom, strict=True) if one.card is FlipInMove.FIRST
    )
