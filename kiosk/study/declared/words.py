"""Texts that stand in a declared file in every language of the study, side by side."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated

from pydantic import BeforeValidator, Field

Text = Annotated[str, Field(min_length=1)]


def _by_language(given: object) -> object:
    if isinstance(given, str):
        raise ValueError(f"{given!r} stands in no language; write {{ en = {given!r} }}")
    return given


Words = Annotated[dict[str, Text], Field(min_length=1), BeforeValidator(_by_language)]
"""One text in several languages, by their codes."""


def in_language(words: Mapping[str, str], language: str) -> str:
    """The text in this language, or in the first one there is."""
    return words.get(language) or next(iter(words.values()))
