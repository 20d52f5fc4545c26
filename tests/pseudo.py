"""An invented language, made from the English one: a fourth language is one folder, and this one proves it.

Every letter carries an accent, every text is about 40 % longer, and it runs from right to left. Variables, selectors
and the names of messages are left alone, so whatever shows up unaccented on a screen did not come from a catalogue.
"""

from __future__ import annotations

import math
from pathlib import Path

from fluent.syntax import FluentParser, FluentSerializer, ast
from fluent.syntax.visitor import Transformer

from kiosk.config import ASSETS

LANGUAGE = "qps"
"""Of the codes that are reserved for private use, so that no real language is meant."""
LONGER = 0.4
START, END = "\u200f\u202e", "\u202c"
"""A right-to-left mark, which gives the text its direction, and a right-to-left override up to its end."""

_ACCENTED = str.maketrans(
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz",
    "ÅƁÇÐÉƑĜĤÎĴĶĻṀÑÖÞǪŔŠŢÛṼŴẊÝŽåƀçðéƒĝĥîĵķļɱñöþǫŕšţûṽŵẋýž",
)


class _Pseudo(Transformer):
    """Rewrites every text and nothing else."""

    def visit_TextElement(self, node: ast.TextElement) -> ast.TextElement:  # noqa: N802 - fluent.syntax's name
        """Accent one text, and let its beginning follow once more, so that words keep the length that words have."""
        body = node.value.rstrip()
        more = body.lstrip()[: math.ceil(LONGER * len(body))].rstrip()
        node.value = f"{body} {more}".translate(_ACCENTED) + node.value[len(body) :] if body else node.value
        return node

    def visit_Message(self, node: ast.Message) -> ast.Message:  # noqa: N802 - fluent.syntax's name
        """Turn a message round, with the variables in it."""
        turned: ast.Message = self.generic_visit(node)
        _turn_round(turned.value)
        return turned

    def visit_Attribute(self, node: ast.Attribute) -> ast.Attribute:  # noqa: N802 - fluent.syntax's name
        """Turn one wording round."""
        turned: ast.Attribute = self.generic_visit(node)
        _turn_round(turned.value)
        return turned


def _turn_round(pattern: ast.Pattern | None) -> None:
    if pattern is not None:
        pattern.elements = [ast.TextElement(START), *pattern.elements, ast.TextElement(END)]


def text(source: str) -> str:
    """Return the content of an ``.ftl`` file in the pseudo-language."""
    resource: ast.Resource = _Pseudo().visit(FluentParser().parse(source))
    return FluentSerializer().serialize(resource)


def sentence(english: str) -> str:
    """One text that stands outside of the catalogues, in the pseudo-language."""
    more = english[: math.ceil(LONGER * len(english))].rstrip()
    return f"{START}{english} {more}{END}".translate(_ACCENTED)


def write(languages: Path, source: Path = ASSETS / "sentences" / "en") -> Path:
    """Write the pseudo-language's folder among other languages' folders; returns it."""
    folder = languages / LANGUAGE
    folder.mkdir(parents=True, exist_ok=True)
    for file in source.glob("*.ftl"):
        (folder / file.name).write_text(text(file.read_text("utf-8")), "utf-8")
    return folder
