"""What the study file gives as shortcuts can be heard: beyond what the file refuses by itself."""

from __future__ import annotations

import pytest

from kiosk import UserInputError
from kiosk.config import Keys
from kiosk.experiment.experimenter import Action, shortcuts


def test_the_shortcuts_that_come_with_the_program_can_all_be_used() -> None:
    assert set(shortcuts(Keys())) == {Action(name) for name in Keys.model_fields}


def test_an_empty_shortcut_switches_a_key_off() -> None:
    assert Action.EMBODIMENT not in shortcuts(Keys(embodiment="", mute=""))


@pytest.mark.parametrize("shortcut", ["F9", "Shift+F9", "Ctrl+Alt+7", "Meta+Space", "Alt+PgDown", "Ctrl+Shift+Alt+P"])
def test_a_shortcut_is_modifiers_and_a_key_or_a_function_key(shortcut: str) -> None:
    assert shortcuts(Keys(panel=shortcut))[Action.PANEL] == shortcut


@pytest.mark.parametrize(
    ("shortcut", "why"),
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
def test_a_shortcut_that_could_never_be_heard_is_refused_in_one_sentence(shortcut: str, why: str) -> None:
    with pytest.raises(UserInputError, match=why) as refusal:
        shortcuts(Keys(panel=shortcut))
    assert str(refusal.value).startswith("panel: ")
