"""The experimenter's chords, by their deeds: beyond what the study file refuses by itself, none that cannot work."""

from __future__ import annotations

import re

from kiosk import BadInput
from kiosk.settings import Keys
from kiosk.study.booth.deeds import Deed

_NAMED = ("Space", "Tab", "Esc", "Return", "Ins", "Del", "Home", "End", "PgUp", "PgDown", "Pause", "Menu")
_KEY = re.compile(rf"[A-Za-z0-9]|F([1-9]|1[0-9]|2[0-4])|{'|'.join(_NAMED)}", re.ASCII)

_TAKEN = {
    *(frozenset({"Ctrl", key}) for key in (*"ACVXYZKUE", "Del", "Ins", "Home", "End")),
    *(frozenset({"Ctrl", "Shift", key}) for key in ("Z", "Home", "End")),
    *(frozenset({"Alt", key}) for key in ("F4", "Tab")),
    frozenset({"Ctrl", "Alt", "Del"}),
}
"""What a text field or the system keeps for itself."""


def chords(keys: Keys) -> dict[Deed, str]:
    """The chord of every deed that has one; raises BadInput, naming its key, for one that could never be heard."""
    found = {Deed(name): chord for name, chord in keys.model_dump().items() if chord}
    for deed, chord in found.items():
        _check(deed, chord)
    return found


def _check(deed: Deed, chord: str) -> None:
    *modifiers, key = chord.split("+")
    if not _KEY.fullmatch(key):
        raise BadInput(
            f"{deed.value}: {chord!r} has no key; it may be a letter, a digit, F1 to F24, or {', '.join(_NAMED)}"
        )
    if len(set(modifiers)) < len(modifiers):
        raise BadInput(f"{deed.value}: {chord!r} names a key twice")
    if frozenset((*modifiers, key.upper() if len(key) == 1 else key)) in _TAKEN:
        raise BadInput(f"{deed.value}: {chord!r} means something else to a text field or to the system")
