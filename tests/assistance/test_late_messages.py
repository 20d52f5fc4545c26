"""Messages that are parsed when they are first said: the same as if the whole file were parsed."""

from __future__ import annotations

import re
from itertools import product
from pathlib import Path

import pytest
from fluent.runtime import FluentResource
from fluent.syntax.ast import Junk, Message, Term

from kiosk.assistance.fluent_messages import LateBundle, parsed
from kiosk.assistance.late_messages import LateMessages, attributes_in, split
from kiosk.places import ASSETS

SHIPPED = sorted((ASSETS / "sentences").glob("*/*.ftl"))


@pytest.mark.parametrize("file", SHIPPED, ids=lambda file: f"{file.parent.name}-{file.stem}")
def test_a_shipped_file_is_split_into_what_the_parser_finds_in_it(file: Path) -> None:
    source = file.read_text("utf-8")
    entries = FluentResource(source).body
    assert not [entry for entry in entries if isinstance(entry, Junk)]
    whole = [entry for entry in entries if isinstance(entry, Message | Term)]
    names = [entry.id.name if isinstance(entry, Message) else f"-{entry.id.name}" for entry in whole]
    assert [name for name, _ in split(source)] == names
    for entry, (_, text) in zip(whole, split(source), strict=True):
        alone, *_ = parsed(text).body
        assert alone.equals(entry, ["span", "comment"])
        assert attributes_in(text) == {attribute.id.name for attribute in entry.attributes}


TEXTS = (
    *("x", "x  ", " x y ", "# x", "[x] y", "*x", ".x", "-x = y", '"x"', "", "x }", "x\ty\t", "\tx", "ü\u00a0"),
    *("{ $x }", "{$x}  ", " { $x } y", "x {$x-y}{ $Z_1 } .", "{ x }", "{ -x }", "{ $ x }", "{ $x", "{ $x.y }"),
)


@pytest.mark.parametrize(
    "after", ["", "\n", "\n\n# Why\n#\n", "\n  goes on\n", "\n    .loud = HI\n", "\n ", "\r\n", "\n}\n"]
)
def test_a_plain_message_is_what_the_parser_makes_of_it(after: str) -> None:
    for text in TEXTS:
        source = f"name = {text}{after}"
        mine, *_ = parsed(source).body
        theirs, *_ = FluentResource(source).body
        assert mine.equals(theirs, ["span", "comment", "annotations"]), text


@pytest.mark.parametrize(
    "after", ["", "\n", "\n\n# Why\n", "\n      further in\n", "\n  less far\n", "\n    .loud = HI\n"]
)
@pytest.mark.parametrize("between", ["", "\n"])
def test_a_plain_message_of_lines_is_what_the_parser_makes_of_it(between: str, after: str) -> None:
    for one, other in product(TEXTS, TEXTS):
        source = f"name =\n    {one}\n{between}    {other}{after}"
        mine, *_ = parsed(source).body
        theirs, *_ = FluentResource(source).body
        assert mine.equals(theirs, ["span", "comment", "annotations"]), source


def test_lines_below_their_name_need_no_parser() -> None:
    messages = LateMessages("en", dict(split("rule =\n    Turn two cards.\n    Remember { $what }.\n")))
    assert messages.plain("rule", {"what": "where each is"}) == "Turn two cards.\nRemember where each is."


LATE = """
-brand = Recollect
greeting = Welcome to { -brand }
    .loud = WELCOME
count = { $n ->
    [one] one pair
   *[other] { $n } pairs
}
"""


def said(bundle: LateBundle, message: str, **variables: int) -> str:
    """Return a message without faults."""
    pattern = bundle.get_message(message).value
    assert pattern is not None
    text, errors = bundle.format_pattern(pattern, variables)
    assert errors == []
    return str(text)


def test_messages_are_said_with_the_terms_they_name() -> None:
    bundle = LateBundle(["en"], dict(split(LATE)))
    assert said(bundle, "greeting") == "Welcome to Recollect"
    assert said(bundle, "count", n=1) == "one pair"
    assert set(bundle.get_message("greeting").attributes) == {"loud"}


def test_a_parsed_message_replaces_one_that_was_not_said_yet() -> None:
    bundle = LateBundle(["en"], dict(split(LATE)))
    bundle.add_resource(FluentResource("-brand = Our game\n"), allow_overrides=True)
    assert said(bundle, "greeting") == "Welcome to Our game"


def test_a_message_that_is_broken_has_no_text() -> None:
    bundle = LateBundle(["en"], dict(split("greeting = { $name\n")))
    assert bundle.has_message("greeting")
    assert bundle.get_message("greeting").value is None
    assert not bundle.has_message("farewell")


@pytest.mark.parametrize("file", SHIPPED, ids=lambda file: f"{file.parent.name}-{file.stem}")
def test_a_plain_message_is_said_as_fluent_says_it(file: Path) -> None:
    written = dict(split(file.read_text("utf-8")))
    messages, bundle = LateMessages("en", written), LateBundle(["en"], dict(written))
    for name, text in written.items():
        given = dict.fromkeys(re.findall(r"\$([\w-]+)", text), "a word")
        plain = messages.plain(name, given)
        if plain is not None:
            pattern = bundle.get_message(name).value
            assert pattern is not None
            assert (plain, []) == bundle.format_pattern(pattern, given)


@pytest.mark.parametrize("given", [{}, {"x": 3}, {"x": "a" * 2501}, {"y": "a"}])
def test_a_variable_that_is_no_short_text_is_left_to_fluent(given: dict[str, str | int]) -> None:
    messages = LateMessages("en", {"name": "name = It is { $x }.\n"})
    assert messages.plain("name", {"x": "here"}) == "It is here."
    assert messages.plain("name", given) is None


def test_wordings_are_counted_before_and_after_they_are_parsed() -> None:
    messages = LateMessages("en", dict(split(LATE)))
    assert messages.wordings_of("greeting") == 1
    assert messages.bundle.get_message("greeting").value is not None
    assert messages.wordings_of("greeting") == 1
    assert "greeting" in messages
    assert "farewell" not in messages
