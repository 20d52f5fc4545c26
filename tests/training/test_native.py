"""The long loops in C: what can be written as C, and where the library comes from."""

from __future__ import annotations

import ctypes
from array import array
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from kiosk.training import ahead, native
from kiosk.training.c_source import NotARule, c_source

Ints = list[int]
needs_a_compiler = pytest.mark.skipif(native.COMPILER is None, reason="there is no C compiler")


@pytest.fixture(autouse=True)
def forgotten() -> Iterator[None]:
    """Look for the library anew in each test, and after it."""
    native.library.cache_clear()
    yield
    native.library.cache_clear()


def put(numbers: Ints, value: int) -> int:
    numbers[0] = value
    return numbers[0]


def rounded(numbers: Ints, by: int) -> int:
    for at in range(len(numbers)):
        numbers[at] = numbers[at] // by * 1000 + numbers[at] % by
    return len(numbers)


def swapped(numbers: Ints) -> None:
    numbers[0], numbers[1] = numbers[1], numbers[0]
    for last in range(len(numbers) - 1, 1, -1):
        numbers[last] = max(numbers[last], last) if numbers[last] != 3 else min(numbers[last], -1)


def shares(one: int, other: int) -> float:
    return one / other + 0.1 * 3


def in_an_order_that_counts(numbers: Ints) -> int:
    return put(numbers, 1) + numbers[0]


def of_either_kind(numbers: Ints) -> float:
    return 1.0 if numbers[0] > 0 else 0


def first_or_second(numbers: Ints) -> int:
    return numbers[0] or numbers[1]


def between(numbers: Ints) -> bool:
    return 0 < numbers[0] < 5


def listed(numbers: Ints) -> int:
    return len([number for number in numbers])  # noqa: C416 - what is refused here


def of_two_kinds(numbers: Ints) -> float:
    value: float = numbers[0]
    if value > 1:
        value = 0.5
    return value


@pytest.mark.parametrize(
    "rule", [in_an_order_that_counts, of_either_kind, first_or_second, between, listed, of_two_kinds]
)
def test_what_might_mean_something_else_in_c_is_refused(rule: Callable[..., Any]) -> None:
    with pytest.raises(NotARule, match=rule.__name__):
        c_source([rule])


@needs_a_compiler
def test_numbers_mean_the_same_in_c(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(native, "_loops", [rounded, swapped, shares])
    native.compile_library(str(native.COMPILER), tmp_path / "rules.so")
    found = ctypes.CDLL(str(tmp_path / "rules.so"))
    for rule, more in ((rounded, (7,)), (rounded, (-7,)), (swapped, ())):
        here = [-15, -14, -1, 0, 3, 13, 1 << 40]
        there = array("q", here)
        back = native.entry_of(found, rule)(*native.flattened((there, *more)))
        assert back == rule(here, *more)
        assert list(there) == here
    assert native.entry_of(found, shares)(1, 3) == shares(1, 3)


@needs_a_compiler
def test_the_library_is_kept_for_the_next_time(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    kept = tmp_path / "cache" / "rules.so"
    monkeypatch.setattr(native, "places", lambda: [tmp_path / "rules.so", kept])
    assert native.library() is not None
    assert list(kept.parent.iterdir()) == [kept]
    monkeypatch.setattr(native, "COMPILER", None)
    native.library.cache_clear()
    assert native.library() is not None


@needs_a_compiler
def test_the_library_of_a_build_is_made_in_the_place_that_is_named(tmp_path: Path) -> None:
    made = tmp_path / "work" / native.SHIPPED.name
    assert ahead.main([str(made)]) == 0
    assert hasattr(ctypes.CDLL(str(made)), "learn_episodes")


@pytest.mark.parametrize("compiler", [None, "/bin/false", "/nowhere/cc"])
def test_without_a_compiler_that_works_there_is_no_library(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, compiler: str | None
) -> None:
    monkeypatch.setattr(native, "places", lambda: [tmp_path / "rules.so"])
    monkeypatch.setattr(native, "COMPILER", compiler)
    assert native.library() is None
