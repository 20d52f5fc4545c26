"""Docstrings and pages name only what is there, also after a class or a method got another name."""

from __future__ import annotations

import builtins
import io
import re
import tokenize
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from tests.test_prose import CODE, PAGES, docstrings

NAME = re.compile(r"``([A-Za-z_][\w.]*)(?:\(\))?``")
"""A name in code, not an expression, a command with arguments or a value."""
RAISED = re.compile(r"\b[Rr]aises? ([A-Z]\w+)(?: (?:or|and) ([A-Z]\w+))?")
METHOD = re.compile(r"`([A-Z][a-z]\w*)\.([a-z_]\w*)(?:\([^`]*\))?`")
OTHERS = {"sha256sum", "pt_br", ""}
"""A program, a code as other programs write it, and what a last dot leaves."""


@cache
def words() -> frozenset[str]:
    """Return every name in the code, and every word in its texts; docstrings and comments are neither."""
    return frozenset(word for path in CODE for word in words_of(path))


def words_of(path: Path) -> Iterator[str]:
    """Yield the names and the words of one file."""
    for token in tokenize.generate_tokens(io.StringIO(path.read_text("utf-8")).readline):
        if token.type == tokenize.NAME:
            yield token.string
        elif token.type == tokenize.STRING and not token.string.startswith('"""'):
            yield from re.findall(r"\w+", token.string)


def unknown_names(doc: str) -> set[str]:
    """Find the names in a docstring that the code does not have: those in backticks, and of what is raised."""
    quoted = {part for name in NAME.findall(doc) for part in name.split(".")}
    raised = {name for names in RAISED.findall(doc) for name in names if name and not hasattr(builtins, name)}
    return (quoted | raised) - words() - OTHERS


@pytest.mark.parametrize(
    ("doc", "names"),
    [
        ("Raises UserInputError or KeyError; see ``kiosk.errors.toml_line()``.", set()),
        ("Raise RobotHasGone if ``there_is_no_such_name``.", {"RobotHasGone", "there_is_no_such_name"}),
        ("Raises KeyError and RobotHasGone.", {"RobotHasGone"}),
    ],
)
def test_a_name_that_is_nowhere_in_the_code_is_found(doc: str, names: set[str]) -> None:
    assert unknown_names(doc) == names


def test_docstrings_name_only_what_is_there() -> None:
    docs = {path: docstrings(path.read_text("utf-8")) for path in CODE}
    found = {path.name: unknown for path, all_ in docs.items() if (unknown := set().union(*map(unknown_names, all_)))}
    assert found == {}


def test_pages_name_only_methods_that_are_there() -> None:
    named = {page.name: METHOD.findall(page.read_text("utf-8")) for page in PAGES}
    assert sum(map(len, named.values())) > 0
    found = {page: [name for name in names if not words().issuperset(name)] for page, names in named.items()}
    assert {page: names for page, names in found.items() if names} == {}
