"""The columns of the measures: every one that kiosk/study/after/measures.py knows."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields

from kiosk.store.dataset.column import Cell, Column, Kind, Variable
from kiosk.store.dataset.tables.person import Person
from kiosk.study.after.measures import Measures


def _measured(name: str, description: str, kind: Kind = Kind.WHOLE, unit: str = "", empty: str = "") -> Variable:
    return Variable(name, description, kind, unit, empty=empty)


_PER_HINT = "no hint was given"
_PER_FIRST = "no hint was given for a first card"

MEASURED = {
    variable.name: variable
    for variable in (
        _measured("flips", "How many cards were turned up in the game; not to be compared with moves."),
        _measured("moves", "How many moves of two flips were completed in the game."),
        _measured("pairs", "How many pairs were found in the game."),
        _measured("hints", "How many hints were given in the game."),
        _measured(
            "completion_ms",
            "From the first flip of the game to its last match, less pauses; 0 without a match.",
            unit="ms",
        ),
        _measured(
            "completion_without_speech_ms",
            "The same on the clock that stands still from a hint until the board opens again.",
            unit="ms",
        ),
        _measured(
            "assistance_per_flip",
            "The sum of the hints' levels (none 0, column 0.5, row 1, card 2) by the number of flips.",
            Kind.NUMBER,
            empty="no card was turned up",
        ),
        _measured(
            "followed_rate",
            "The share of hints that were followed by a flip of the hinted card, or in the hinted row or column.",
            Kind.NUMBER,
            empty=_PER_HINT,
        ),
        _measured("first_followed_rate", "The same for hints for a first card.", Kind.NUMBER, empty=_PER_FIRST),
        _measured(
            "first_led_to_match_rate",
            "The share of hints for a first card that were followed and whose move ended in a match.",
            Kind.NUMBER,
            empty=_PER_FIRST,
        ),
    )
}
"""What each measure of kiosk.study.after.measures is called here, and what it says."""

_RENAMED = {
    "followed": "followed_rate",
    "first_followed": "first_followed_rate",
    "first_led_to_match": "first_led_to_match_rate",
}
"""A share of hints is not called like the truth about one of them."""


def _value_of(name: str) -> Callable[[Person], Cell]:
    def value(row: Person) -> Cell:
        measured: int | float | None = getattr(row.measures, name)
        return measured

    return value


MEASURES: tuple[Column[Person], ...] = (
    *(Column(MEASURED[_RENAMED.get(field.name, field.name)], _value_of(field.name)) for field in fields(Measures)),
    Column(
        Variable("per_match_ms", "completion_ms by the number of pairs.", Kind.NUMBER, "ms", empty="no pair was found"),
        lambda row: row.measures.per_match_ms,
    ),
)
