"""Messages by their text alone: a plain one is said as it stands, and any other is left to Fluent.

Fluent parses in Python, and all of a language takes a tenth of a second. The files that come with Recollect are
well-formed, which the tests hold, so they need not be parsed before the kiosk opens. The start screen says only plain
messages, so Fluent itself is loaded later, too.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING

from kiosk.language_codes import babel_codes

if TYPE_CHECKING:
    from fluent.runtime import FluentBundle
    from fluent.syntax.ast import Resource

_BEGINS = re.compile(r"^(-?[a-zA-Z][a-zA-Z0-9_-]*) *=", re.MULTILINE)
_ATTRIBUTE = re.compile(r"^ +\.([a-zA-Z][a-zA-Z0-9_-]*) *=", re.MULTILINE)
_VARIABLE = r"\{ *\$([a-zA-Z][a-zA-Z0-9_-]*) *\}"
_WORDS = rf"(?:[^{{}}\n\r]|{_VARIABLE})+"
_COMMENTS = r"(?:\n(?:#[^\n\r]*)?)*"
_PLAIN = re.compile(rf"([a-zA-Z][a-zA-Z0-9_-]*) *= *(?=[^ \n\r])({_WORDS}){_COMMENTS}")
"""A message of one line with nothing but text and variables, and the comments behind it: four fifths of all."""
_PLAIN_LINES = re.compile(rf"([a-zA-Z][a-zA-Z0-9_-]*) *=((?:\n    (?=[^ .\[*\n\r]){_WORDS})+){_COMMENTS}")
"""A message of such lines below its name; Fluent takes away what all of them are set in by."""
_MOST_CHARACTERS = 2500
"""Fluent refuses a longer variable."""


@lru_cache(maxsize=64)
def split(source: str) -> tuple[tuple[str, str], ...]:
    """Return the name and the text of every message and term of a well-formed file.

    A term's name begins with ``-``.
    """
    found = list(_BEGINS.finditer(source))
    ends = [*(each.start() for each in found[1:]), len(source)]
    return tuple((each[1], source[each.start() : end]) for each, end in zip(found, ends, strict=True))


def attributes_in(text: str) -> frozenset[str]:
    """Return the names of the attributes of a message that ``split`` gave."""
    return frozenset(_ATTRIBUTE.findall(text))


@lru_cache(maxsize=1024)
def plain_parts(text: str) -> tuple[str, tuple[str, ...]] | None:
    """Return a plain message's name, and its texts and names of variables in turn; None for any other message."""
    if (plain := _PLAIN.fullmatch(text)) is not None:
        return plain[1], tuple(re.split(_VARIABLE, plain[2].rstrip(" ")))
    if (lines := _PLAIN_LINES.fullmatch(text)) is not None:
        words = lines[2].removeprefix("\n    ").replace("\n    ", "\n")
        return lines[1], tuple(re.split(_VARIABLE, words.rstrip(" ")))
    return None


class LateMessages:
    """The messages of a language; ``late`` are those that are not parsed yet, by their names."""

    def __init__(self, language: str, late: Mapping[str, str]) -> None:
        """Know the messages and terms in ``late``; what is added later replaces them."""
        self._language = language
        self._late = dict(late)

    @cached_property
    def bundle(self) -> FluentBundle:
        """All messages, as Fluent forms them."""
        from kiosk.assistance.fluent_messages import LateBundle  # noqa: PLC0415 - the start screen does without

        return LateBundle(babel_codes(self._language), self._late)

    def add(self, resources: Iterable[tuple[Resource, bool]]) -> None:
        """Add what is parsed; True with it lets it replace what was added before."""
        for resource, overrides in resources:
            self.bundle.add_resource(resource, allow_overrides=overrides)

    def __contains__(self, message: str) -> bool:
        """Whether there is such a message."""
        return message in self._late or ("bundle" in vars(self) and self.bundle.has_message(message))

    def wordings_of(self, message: str) -> int:
        """Count the attributes of a message that is there."""
        if message in self._late:
            return len(attributes_in(self._late[message]))
        return len(self.bundle.get_message(message).attributes)

    def plain(self, message: str, variables: Mapping[str, str | int]) -> str | None:
        """Fill in a plain message whose variables are all short texts; None where that is Fluent's to do."""
        found = plain_parts(self._late[message]) if message in self._late else None
        if found is None:
            return None
        parts = list(found[1])
        for place in range(1, len(parts), 2):
            value = variables.get(parts[place])
            if not isinstance(value, str) or len(value) > _MOST_CHARACTERS:
                return None
            parts[place] = value
        return "".join(parts)
