"""What the study file gives as chords can be heard: beyond what the file refuses by itself."""

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
        ("Ctrl+Shift", "has no key"),
        ("Ctrl+Strg", "has no key"),
        ("Ctrl+Ctrl+P", "names a key twice"),
        ("F25", "has no key"),
        ("Ctrl+V", "means something else"),
        ("Ctrl+Shift+z", "means something else"),
        ("Alt+F4", "means something else"),
    ],
)
def test_a_chord_that_could_never_be_heard_is_refused_in_one_sentence(chord: str, why: str) -> None:
    with pytest.raises(BadInput, match=why) as refusal:
        chords(Keys(panel=chord))
    assert str(refusal.value).startswith("panel: ")
