"""The experimenter's chords as the study file spells them: what can be one, and that no two are the same."""

from __future__ import annotations

import re

from kiosk import BadInput
from kiosk.settings import Keys
from kiosk.study.booth.deeds import Deed

_MODIFIERS = ("Ctrl", "Shift", "Alt", "Meta")
_NAMED = ("Space", "Tab", "Esc", "Return", "Ins", "Del", "Home", "End", "PgUp", "PgDown", "Pause", "Menu")
_FUNCTION_KEY = re.compile(r"F([1-9]|1[0-9]|2[0-4])", re.ASCII)
_LETTER_OR_DIGIT = re.compile(r"[A-Z0-9]", re.ASCII)

_TAKEN = {
    *(frozenset({"Ctrl", key}) for key in "ACVXYZKUE"),
    *(frozenset({"Ctrl", key}) for key in ("Del", "Ins", "Home", "End")),
    frozenset({"Ctrl", "Shift", "Z"}),
    frozenset({"Ctrl", "Shift", "Home"}),
    frozenset({"Ctrl", "Shift", "End"}),
    frozenset({"Alt", "F4"}),
    frozenset({"Alt", "Tab"}),
    frozenset({"Ctrl", "Alt", "Del"}),
}
"""What a text field or the system keeps for itself."""


def chords(keys: Keys) -> dict[Deed, str]:
    """The chord of every deed that has one; raises BadInput, naming the key, for one that cannot be or stands twice."""
    found: dict[Deed, str] = {}
    pressed: dict[frozenset[str], str] = {}
    for name, chord in keys.model_dump().items():
        if not chord:
            continue
        parts = _parts(name, chord)
        if parts in pressed:
            raise BadInput(f"keys.{name}: the chord {chord!r} is also that of keys.{pressed[parts]}")
        pressed[parts] = name
        found[Deed(name)] = chord
    return found


def _parts(name: str, chord: str) -> frozenset[str]:
    *modifiers, key = chord.split("+")
    if not _is_key(key) or len(set(modifiers)) < len(modifiers) or set(modifiers) - set(_MODIFIERS):
        raise BadInput(f"keys.{name}: {chord!r} is no chord; one is written like 'Ctrl+Shift+P', 'Alt+Space' or 'F9'")
    if not set(modifiers) - {"Shift"} and not _FUNCTION_KEY.fullmatch(key):
        raise BadInput(f"keys.{name}: {chord!r} needs Ctrl, Alt or Meta, or a visitor would press it by accident")
    parts = frozenset((*modifiers, key))
    if parts in _TAKEN:
        raise BadInput(f"keys.{name}: {chord!r} means something else to a text field or to the system")
    return parts


def _is_key(key: str) -> bool:
    return bool(key in _NAMED or _FUNCTION_KEY.fullmatch(key) or _LETTER_OR_DIGIT.fullmatch(key))
