"""A tap takes few steps to its pixel and to the mark of its hint, and the documentation lists them."""

from __future__ import annotations

import pytest
from pytestqt.qtbot import QtBot

from tests.ui.tap_walk import PAGE, Watch, section, walks

MOST_TO_ITS_PIXEL = 12
MOST_TO_ITS_MARK = 37


@pytest.fixture
def walked(qtbot: QtBot) -> tuple[Watch, Watch]:
    """Return the walk of one tap, to its pixel and to its mark."""
    del qtbot
    return walks()


def test_a_tap_takes_few_hops_and_the_walk_in_the_documentation_is_the_one_it_takes(
    walked: tuple[Watch, Watch],
) -> None:
    pixel, mark = walked
    walk = section(pixel, mark)
    assert 0 < pixel.hops <= MOST_TO_ITS_PIXEL, walk
    assert 0 < mark.hops <= MOST_TO_ITS_MARK, walk
    assert all(leg.hops for leg in mark.legs), walk
    assert f"<!-- walk -->\n{walk}<!-- /walk -->" in PAGE.read_text("utf-8")
