"""What people type is kept as it is, but for control characters; every number that is allowed can be entered."""

from __future__ import annotations

import re
import unicodedata

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from kiosk.experiment.items import ShortText
from kiosk.experiment.typed_input import NumberInput, can_be_kept

REMARK = ShortText(id="remark", kind="text", text={"en": "remark?"}, longest=500)

TYPED = {
    "no-break space": "a\N{NO-BREAK SPACE}b",
    "ideographic space": "mot\N{IDEOGRAPHIC SPACE}mot",
    "joined emoji": "\N{WOMAN}\N{ZERO WIDTH JOINER}\N{GIRL}",
    "zero-width non-joiner": "می\N{ZERO WIDTH NON-JOINER}خواهم",
    "soft hyphen": "zu\N{SOFT HYPHEN}sammen",
    "narrow no-break space": "12\N{NARROW NO-BREAK SPACE}%",
    "marks of direction": "\N{RIGHT-TO-LEFT MARK}שלום\N{RIGHT-TO-LEFT ISOLATE}a\N{POP DIRECTIONAL ISOLATE}",
    "combining accent": "e\N{COMBINING ACUTE ACCENT}",
    "private use": "\ue000",
    "spaces around": "  well \N{NO-BREAK SPACE}",
}


@pytest.mark.parametrize("text", TYPED.values(), ids=TYPED.keys())
def test_invisible_characters_are_part_of_an_answer(text: str) -> None:
    assert REMARK.accepts(text)


@pytest.mark.parametrize("text", ["a\nb", "a\tb", "\x07", "a\x00", "\x7f", "a\x85b", "half \ud83d"])
def test_control_characters_and_halves_of_characters_are_no_part_of_an_answer(text: str) -> None:
    assert not REMARK.accepts(text)


@given(st.characters())
def test_nothing_but_control_characters_and_halves_is_refused(character: str) -> None:
    assert can_be_kept(character) is (unicodedata.category(character) not in {"Cc", "Cs"})


ENDS = st.integers(-(10**12), 10**12)


@st.composite
def fields(draw: st.DrawFn) -> NumberInput:
    """Return a field for whole numbers between two ends."""
    return NumberInput(*sorted(draw(st.lists(ENDS, min_size=2, max_size=2, unique=True))))


def fits(field: NumberInput, text: str) -> bool:
    """Whether a text may stand in the field; Python's own expressions know no classes of Unicode."""
    return re.search(field.pattern.replace(r"\p{Nd}", r"\d"), text) is not None


@given(fields(), st.data())
@example(NumberInput(-10, 5), None)
@example(NumberInput(-20, -10), None)
@example(NumberInput(-1000, 1), None)
def test_every_number_that_is_allowed_can_be_typed_key_by_key(field: NumberInput, data: st.DataObject | None) -> None:
    number = data.draw(st.integers(field.lowest, field.highest)) if data else field.lowest
    typed = str(number)
    assert all(fits(field, typed[:end]) for end in range(len(typed) + 1))
    assert field.read(typed) == number
    assert len(typed) <= len(field.longest)


@given(fields(), st.data())
def test_a_number_s_minus_sign_can_be_put_there_first_or_last(field: NumberInput, data: st.DataObject) -> None:
    number = data.draw(st.integers(field.lowest, field.highest))
    text = field.negate(str(abs(number))) if number < 0 else str(number)
    assert field.read(text) == number
    assert field.negate(field.negate(text)) == text


@given(fields(), st.text(max_size=20), st.sampled_from([-1, 1]))
def test_a_step_from_anything_leads_to_a_number_that_is_allowed(field: NumberInput, text: str, by: int) -> None:
    assert field.lowest <= field.step(text, by) <= field.highest


@given(fields(), st.data())
def test_steps_go_one_by_one_and_stop_at_the_ends(field: NumberInput, data: st.DataObject) -> None:
    number = data.draw(st.integers(field.lowest, field.highest))
    assert field.step(str(number), 1) == min(field.highest, number + 1)
    assert field.step(str(number), -1) == max(field.lowest, number - 1)


@pytest.mark.parametrize("text", ["", "-", "\N{MINUS SIGN}", "x"])
def test_from_no_number_up_begins_at_the_lowest_and_down_at_the_highest(text: str) -> None:
    field = NumberInput(-10, 5)
    assert (field.step(text, 1), field.step(text, -1)) == (-10, 5)


@given(fields(), st.text(st.characters(categories=["Nd"]), min_size=1, max_size=13))
def test_digits_of_every_script_are_digits(field: NumberInput, digits: str) -> None:
    assert (field.read(digits) is not None) is (len(digits) <= field.digits)


@pytest.mark.parametrize(
    ("text", "number"),
    [
        ("-3", -3),
        ("\N{MINUS SIGN}3", -3),
        ("\N{FULLWIDTH HYPHEN-MINUS}٣", -3),
        ("-\N{DEVANAGARI DIGIT ZERO}", 0),
        ("٣", 3),
        ("--3", None),
    ],
)
def test_signs_and_digits_of_other_keyboards_are_read(text: str, number: int | None) -> None:
    assert NumberInput(-10, 5).read(text) == number


@pytest.mark.parametrize("text", ["-3", "- 3", "9" * 5000, "1.5", "1e1", ""])
def test_what_is_no_number_of_the_field_is_not_read(text: str) -> None:
    assert NumberInput(0, 120).read(text) is None
