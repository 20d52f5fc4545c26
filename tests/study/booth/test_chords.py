"""What the study file gives as chords: each can be pressed, none by accident, and no two are the same."""

from __future__ import annotations

import pytest

from kiosk import BadInput
from kiosk.settings import Keys
from kiosk.study.booth.chords import chords
from kiosk.study.booth.deeds import Deed


def test_the_chords_that_come_with_the_program_can_all_be_used() -> None:
    assert set(chords(Keys())) == {Deed(name) for name in Keys.model_fields}


def test_an_empty_chord_switches_a_key_off() -> None:
    assert Deed.BODY not in chords(Keys(body="", quiet=""))


@pytest.mark.parametrize("chord", ["F9", "Shift+F9", "Ctrl+Alt+7", "Meta+Space", "Alt+PgDown", "Ctrl+Shift+Alt+P"])
def test_a_chord_is_modifiers_and_a_key_or_a_function_key(chord: str) -> None:
    assert chords(Keys(panel=chord))[Deed.PANEL] == chord


@pytest.mark.parametrize(
    ("chord", "why"),
    [
        ("P", "needs Ctrl, Alt or Meta"),
        ("Shift+P", "needs Ctrl, Alt or Meta"),
        ("Space", "needs Ctrl, Alt or Meta"),
        ("Ctrl+", "is no chord"),
        ("Ctrl+Shift", "is no chord"),
        ("Strg+P", "is no chord"),
        ("Ctrl+Ctrl+P", "is no chord"),
        ("ctrl+p", "is no chord"),
        ("Ctrl+X, Ctrl+P", "is no chord"),
        ("F25", "is no chord"),
        ("Ctrl+V", "means something else"),
        ("Alt+F4", "means something else"),
    ],
)
def test_what_can_be_no_chord_is_refused_in_one_sentence(chord: str, why: str) -> None:
    with pytest.raises(BadInput, match=why) as refusal:
        chords(Keys(panel=chord))
    assert str(refusal.value).startswith("keys.panel: ")


def test_a_chord_that_stands_twice_is_refused_however_it_is_spelt() -> None:
    with pytest.raises(BadInput, match=r"keys\.leave: .* is also that of keys\.end"):
        chords(Keys(end="Ctrl+Shift+E", leave="Shift+Ctrl+E"))
