"""Visitors who lack a kind of cone can distinguish any two cards, and see every mark."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
from PySide6.QtGui import QColor

from tests.ui.colour_vision import MATRICES, Picture, Vision, apart, colour, decks, distance, empty_card, marks, seen
from tests.ui.looking import colours

LEAST_APART = 15.0
"""The least mean distance of two cards: more than six times what can just be noticed, all over them."""
LEAST_MARK = 15.0
EDGE_CONTRAST = 3.0
"""WCAG 2.2, 1.4.11: what is needed to understand what is shown."""

pytestmark = pytest.mark.usefixtures("qapp")


def relative_luminance(picture: Picture) -> float:
    """Return the luminance of one colour, 0 to 1."""
    linear = np.where(picture <= 0.04045, picture / 12.92, ((picture + 0.055) / 1.055) ** 2.4)
    return float((linear @ np.array([0.2126, 0.7152, 0.0722])).mean())


@pytest.mark.parametrize("vision", Vision, ids=lambda vision: vision.name.lower())
@pytest.mark.parametrize("deck", sorted(decks()))
def test_any_two_cards_of_a_deck_are_told_apart(deck: str, vision: Vision) -> None:
    cards = decks()[deck]
    empty = seen(empty_card(cards), vision)
    as_seen = {name: seen(card, vision) for name, card in cards.items()}
    alike = {
        (one, other): found
        for one, other in combinations(as_seen, 2)
        if (found := apart(as_seen[one], as_seen[other], empty)).colour < LEAST_APART
    }
    assert alike == {}


@pytest.mark.parametrize("vision", Vision, ids=lambda vision: vision.name.lower())
@pytest.mark.parametrize("palette", ["normal", "high"])
def test_a_mark_stands_out_from_the_paper(palette: str, vision: Vision) -> None:
    theme = colours(palette)
    paper, fill, edge = (seen(colour(theme[name]), vision) for name in ("paper", "amber", "deepAmber"))
    assert float(distance(fill, paper).mean()) >= LEAST_MARK
    darker, lighter = sorted((relative_luminance(edge), relative_luminance(paper)))
    assert (lighter + 0.05) / (darker + 0.05) >= EDGE_CONTRAST


@pytest.mark.parametrize("vision", Vision, ids=lambda vision: vision.name.lower())
@pytest.mark.parametrize("palette", ["normal", "high"])
def test_a_found_pair_stands_out_from_the_paper_and_is_not_taken_for_a_hint(palette: str, vision: Vision) -> None:
    theme = colours(palette)
    paper, frame, hint = (seen(colour(theme[name]), vision) for name in ("paper", "leaf", "amber"))
    darker, lighter = sorted((relative_luminance(frame), relative_luminance(paper)))
    assert (lighter + 0.05) / (darker + 0.05) >= EDGE_CONTRAST
    assert float(distance(frame, hint).mean()) >= LEAST_MARK


@pytest.mark.parametrize("vision", Vision, ids=lambda vision: vision.name.lower())
def test_a_marked_card_is_told_from_one_that_is_not(vision: Vision) -> None:
    pictures = [seen(picture, vision) for picture in marks()]
    for plain, marked in (pictures[:2], pictures[2:]):
        around = distance(plain, marked)
        assert float(around[around > 0].mean()) >= LEAST_MARK


def test_cards_that_differ_only_in_red_and_green_would_be_found() -> None:
    empty = colour(QColor("white"))
    red, green = colour(QColor("#B0603A")), colour(QColor("#7F7A2F"))
    assert apart(red, green, empty).colour > LEAST_APART
    as_seen = [seen(picture, Vision.DEUTAN) for picture in (red, green, empty)]
    assert apart(*as_seen).colour < LEAST_APART


@pytest.mark.parametrize("vision", Vision, ids=lambda vision: vision.name.lower())
def test_nobody_sees_a_tint_in_grey(vision: Vision) -> None:
    assert np.allclose(MATRICES[vision].sum(axis=1), 1, atol=1e-4)
