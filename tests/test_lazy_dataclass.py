"""Dataclasses whose methods are written later do what the standard ones do."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Callable
from dataclasses import FrozenInstanceError, asdict, field, fields, replace
from dataclasses import dataclass as standard
from inspect import signature
from typing import Any

import pytest

from kiosk.lazy_dataclass import dataclass as lazy
from kiosk.lazy_dataclass import with_values


def _classes(dataclass: Callable[..., Any]) -> list[Any]:
    @dataclass(frozen=True)
    class Place:
        """A frozen one."""

        x: int
        y: int = 2
        marks: list[int] = field(default_factory=list, compare=False)

    @dataclass(frozen=True, kw_only=True)
    class Checked(Place):
        """One below it, which looks at its values."""

        name: str

        def __post_init__(self) -> None:
            """Refuse no name."""
            if not self.name:
                raise ValueError("no name")

    @dataclass(frozen=True, slots=True)
    class Slots:
        """A frozen one with slots."""

        x: int
        y: int = field(default=3, repr=False)

    @dataclass
    class Open:
        """One that can be changed."""

        x: int
        y: int = field(init=False, default=5)

    @dataclass(frozen=True)
    class Own:
        """One with methods of its own."""

        x: int

        def __repr__(self) -> str:
            return "own"

        def __eq__(self, other: object) -> bool:
            return True

        def __hash__(self) -> int:
            return 7

    return [Place, Checked, Slots, Open, Own]


NAMED = {"Checked": {"name": "a"}}
LAZY, STANDARD = _classes(lazy), _classes(standard)


def _of(kind: Any, **other: Any) -> Any:
    return kind(x=1, **NAMED.get(kind.__name__, {}), **other)


@pytest.mark.parametrize(("mine", "theirs"), list(zip(LAZY, STANDARD, strict=True)), ids=lambda kind: kind.__name__)
def test_a_lazy_dataclass_is_like_the_standard_one(mine: Any, theirs: Any) -> None:
    first, second = _of(mine), _of(theirs)
    assert repr(first) == repr(second)
    assert signature(mine) == signature(theirs)
    assert mine.__match_args__ == theirs.__match_args__
    assert [each.name for each in fields(mine)] == [each.name for each in fields(theirs)]
    assert asdict(first) == asdict(second)
    assert (mine.__hash__ is None) == (theirs.__hash__ is None)
    if mine.__hash__ is not None:
        assert hash(first) == hash(second)
    assert first == _of(mine)
    assert first == copy.copy(first)
    assert (first == replace(first, x=9)) == (second == replace(second, x=9))
    assert (first == second) == (second == first)


def test_a_frozen_one_cannot_be_changed() -> None:
    for kind in LAZY:
        made = _of(kind)
        if kind.__name__ == "Open":
            made.x = 2
            assert made == replace(made)
            continue
        with pytest.raises(FrozenInstanceError, match="cannot assign to field 'x'"):
            made.x = 2
        with pytest.raises(FrozenInstanceError, match="cannot delete field 'x'"):
            del made.x


def test_a_missing_value_is_told_by_its_name() -> None:
    for mine, theirs in zip(LAZY, STANDARD, strict=True):
        with pytest.raises(TypeError) as told:
            mine()
        with pytest.raises(TypeError) as expected:
            theirs()
        assert str(told.value).rpartition(".")[2] == str(expected.value).rpartition(".")[2]


def test_a_check_after_the_start_is_made() -> None:
    with pytest.raises(ValueError, match="no name"):
        LAZY[1](1, name="")


def test_a_default_that_is_made_is_made_for_each() -> None:
    assert _of(LAZY[0]).marks is not _of(LAZY[0]).marks


@lazy(frozen=True, slots=True)
class Sent:
    """A class at the top of a module, so that it can be sent to another process."""

    x: int


def test_one_with_slots_can_be_sent_to_another_process() -> None:
    assert pickle.loads(pickle.dumps(Sent(4))) == Sent(4)  # noqa: S301 - its own


def test_other_values_are_given_as_the_standard_function_gives_them() -> None:
    one = LAZY[0](1, marks=[7])
    other = with_values(one, y=9)
    assert vars(other) == vars(replace(one, y=9))
    assert (type(other), other.y, one.y) == (type(one), 9, 2)
