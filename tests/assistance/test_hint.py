"""A hint names its reason truly, and gives away no more than its action allows."""

from __future__ import annotations

import pytest

from kiosk.assistance.mentaliser import Hint, HintReason, Target
from kiosk.assistance.policy import ActionSpec, FlipInMove
from kiosk.game import Position

FIRST, SECOND = FlipInMove
OFTEN = (2, 3, 17)


@pytest.mark.parametrize(
    ("card", "others", "targets", "reason"),
    [
        (FIRST, (0,), (0,), HintReason.NOTHING_KNOWN),
        (FIRST, (1,), (0,), HintReason.ONE_SEEN_ONCE),
        (FIRST, (1,), (1,), HintReason.BOTH_SEEN_ONCE),
        (FIRST, OFTEN, (0,), HintReason.OFTEN_AND_NEVER),
        (FIRST, OFTEN, (1,), HintReason.OFTEN_AND_ONCE),
        (FIRST, OFTEN, OFTEN, HintReason.BOTH_OFTEN),
        (SECOND, (1,), (0,), HintReason.FIRST_SIGHT),
        (SECOND, (1,), (1,), HintReason.BOTH_SEEN_ONCE),
        (SECOND, OFTEN, (0,), HintReason.OFTEN_AND_NEVER),
        (SECOND, OFTEN, (1,), HintReason.OFTEN_AND_ONCE),
        (SECOND, (1,), OFTEN, HintReason.OPEN_ONCE_MATE_OFTEN),
        (SECOND, OFTEN, OFTEN, HintReason.BOTH_OFTEN),
    ],
)
def test_the_reason_is_the_table_s(
    card: FlipInMove, others: tuple[int, ...], targets: tuple[int, ...], reason: HintReason
) -> None:
    for other in others:
        for target in targets:
            assert HintReason.of(card, other, target) is reason, (other, target)


@pytest.mark.parametrize(
    ("other", "target", "reason"),
    [
        (0, 1, HintReason.ONE_SEEN_ONCE),
        (0, 2, HintReason.OFTEN_AND_NEVER),
        (0, 5, HintReason.OFTEN_AND_NEVER),
        (1, 2, HintReason.OFTEN_AND_ONCE),
        (1, 5, HintReason.OFTEN_AND_ONCE),
        (3, 2, HintReason.BOTH_OFTEN),
    ],
)
def test_on_a_first_card_it_does_not_matter_which_of_the_two_is_pointed_at(
    other: int, target: int, reason: HintReason
) -> None:
    assert HintReason.of(FIRST, other, target) is reason
    assert HintReason.of(FIRST, target, other) is reason


def hint(action: ActionSpec) -> Hint:
    """Return a hint at row 2, column 5, counted from 0."""
    target = Target(Position(2, 5), Position(0, 0), 0, 0, HintReason.NOTHING_KNOWN, ())
    return Hint(action, FIRST, target, "owl")


@pytest.mark.parametrize(
    ("action", "row", "column"),
    [
        (ActionSpec.NO_HELP, None, None),
        (ActionSpec.SUG_COL, None, 5),
        (ActionSpec.SUG_ROW, 2, None),
        (ActionSpec.SUG_CARD, 2, 5),
    ],
)
def test_a_hint_gives_away_only_what_its_action_allows(action: ActionSpec, row: int | None, column: int | None) -> None:
    assert (hint(action).row, hint(action).column) == (row, column)


@pytest.mark.parametrize(
    ("action", "flipped", "followed"),
    [
        (ActionSpec.SUG_CARD, (2, 5), True),
        (ActionSpec.SUG_CARD, (2, 4), False),
        (ActionSpec.SUG_CARD, (1, 5), False),
        (ActionSpec.SUG_ROW, (2, 0), True),
        (ActionSpec.SUG_ROW, (1, 5), False),
        (ActionSpec.SUG_COL, (0, 5), True),
        (ActionSpec.SUG_COL, (2, 4), False),
    ],
)
def test_a_hint_is_followed_by_a_flip_where_it_pointed(
    action: ActionSpec, flipped: tuple[int, int], *, followed: bool
) -> None:
    assert hint(action).followed_by(Position(*flipped)) is followed
