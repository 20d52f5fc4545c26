"""What looks like one character is deleted as one, and never by half."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kiosk.ui.input import before, fitting, without_last


@pytest.mark.parametrize(
    "last", ["é", "e\N{COMBINING ACUTE ACCENT}", "😀", "\N{WOMAN}\N{ZERO WIDTH JOINER}\N{GIRL}", "🇮🇹"]
)
def test_what_looks_like_one_character_goes_at_once(last: str) -> None:
    assert without_last(f"so {last}") == "so "


@given(st.text(st.characters(exclude_categories=["Cs"])))
def test_a_character_that_goes_leaves_no_half_behind(text: str) -> None:
    left = without_last(text)
    assert text.startswith(left)
    assert len(left) < max(1, len(text))
    assert before(text, 0) == 0


@given(st.text(st.characters(exclude_categories=["Cs"])), st.integers(0, 30), st.data())
def test_what_is_too_much_goes_from_before_the_place_and_no_character_is_halved(
    text: str, longest: int, data: st.DataObject
) -> None:
    head = data.draw(st.integers(0, len(text)).map(lambda end: text[:end]))
    place = len(head.encode("utf-16-le")) // 2
    kept = head.encode("utf-16-le")[: 2 * fitting(text, place, longest)].decode("utf-16-le")
    assert head.startswith(kept)
    assert len(head) - len(kept) == min(len(head), max(0, len(text) - longest))
