"""Texts that stand in a declared file in every language of the study, side by side."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated

from pydantic import BeforeValidator, Field

from kiosk.language_codes import standard

Text = Annotated[str, Field(min_length=1)]


def _by_language(given: object) -> object:
    if isinstance(given, str):
        raise ValueError(f"{given!r} stands in no language; write {{ en = {given!r} }}")
    if not isinstance(given, Mapping) or not all(isinstance(code, str) for code in given):
        return given
    spelt = {code: standard(code) for code in given}
    if len(set(spelt.values())) < len(spelt):
        raise ValueError(f"one language stands twice in {', '.join(spelt)}")
    return {spelt[code]: text for code, text in given.items()}


Words = Annotated[dict[str, Text], Field(min_length=1), BeforeValidator(_by_language)]
"""One text in several languages, by their codes."""


def in_language(words: Mapping[str, str], language: str) -> str:
    """The text in this language, or in the first one there is."""
    return words.get(language) or next(iter(words.values()))
