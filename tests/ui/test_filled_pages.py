"""A page is laid out while it is filled: to do that again as it is shown would hold up the frame it comes in."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from PySide6.QtQuick import QQuickItem

from kiosk.experiment.information import Page
from tests.ui.conftest import Booth

PAGE = Page(title="What we study", paragraphs=("There are two versions.\nOne of them looks at you.", "It is no test."))


def inside(item: QQuickItem) -> Iterator[QQuickItem]:
    """Every item in this one, seen or not."""
    for child in item.childItems():
        yield child
        yield from inside(child)


def sizes(page: QQuickItem) -> list[tuple[float, float]]:
    """Return how large everything on a page is."""
    return [(item.width(), item.height()) for item in (page, *inside(page))]


def page_of(booth: Booth, name: str) -> QQuickItem:
    """Return the page that is made of this view."""
    kind = f"{name.capitalize()}View"
    return next(
        item for item in inside(booth.app.window.contentItem()) if item.metaObject().className().startswith(kind)
    )


@pytest.mark.parametrize("name", ["debrief", "result"])
def test_a_filled_page_is_not_laid_out_anew_when_it_is_shown(resting_booth: Booth, name: str) -> None:
    screens = resting_booth.app.screens
    screens.kiosk.show(name)
    # The form without an onlooker takes all of the window, and the page that follows does not.
    screens.avatar.leave(away=True)
    screens.kiosk.show("form")
    screens.kiosk.expect(name)
    screens.result.show(12, 20, 200_000, 3)
    screens.debrief.show(PAGE)
    screens.debrief.give_code("ROME2345-7KQ2M-XR4T4")
    page = page_of(resting_booth, name)
    filled = sizes(page)
    screens.kiosk.show(name)
    assert sizes(page) == filled


def test_cards_that_are_not_seen_are_not_laid_out_anew_when_the_helper_comes_or_goes(resting_booth: Booth) -> None:
    screens = resting_booth.app.screens
    screens.board.deal(4, 6, 12, "animals")
    screens.kiosk.show("game")
    board = page_of(resting_booth, "board")
    seen = sizes(board)
    screens.kiosk.show("form")
    screens.avatar.appear(present=False)
    assert sizes(board) == seen
    screens.kiosk.expect("game")
    assert sizes(board) != seen
