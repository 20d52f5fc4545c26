"""Checks of the arguments that callers hand to the training layer; each raises UserInputError in words."""

from __future__ import annotations

from enum import Enum
from numbers import Integral, Real
from typing import TypeVar

from kiosk import UserInputError

Member = TypeVar("Member", bound=Enum)


def check_between(name: str, value: object, low: float, high: float) -> None:
    """Refuse everything that is not a number from ``low`` to ``high``, such as NaN or a text."""
    # Python takes booleans for the numbers 0 and 1; as an argument one is a mistake of the caller's.
    number = isinstance(value, Real) and not isinstance(value, bool)
    if not number or not low <= float(value) <= high:  # type: ignore[arg-type]  # a number has a float
        shown = f"{value:g}" if number else repr(value)
        raise UserInputError(f"{name} must be a number from {low:g} to {high:g}, not {shown}")


def whole(name: str, value: object) -> int:
    """Return a whole number of any type as Python's own; refuse everything else, such as 2.0 and True."""
    if isinstance(value, Integral) and not isinstance(value, bool):
        return int(value)
    raise UserInputError(f"{name} must be a whole number, not {value!r}")


def one_of(name: str, value: object, kind: type[Member]) -> Member:
    """Return a member of ``kind``; refuse everything else, also the text that stands for a member in a file."""
    if isinstance(value, kind):
        return value
    raise UserInputError(f"{name} must be one of {', '.join(map(str, kind))}, not {value!r}")
