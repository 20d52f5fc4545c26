"""Questionnaires as data: which items there are and what may be answered. Their wording is in the catalogues."""

from __future__ import annotations

from collections import Counter
from typing import Annotated

from pydantic import Field, field_validator

from kiosk.settings import Declared


class Item(Declared):
    """One question, answered on a scale from 1 to ``points``."""

    id: str
    points: Annotated[int, Field(ge=2, le=11)]


class Questionnaire(Declared):
    """Items in their order; ``version`` changes whenever one of them does."""

    file_kind = "questionnaire"

    id: str
    version: str
    items: Annotated[tuple[Item, ...], Field(min_length=1, strict=False)]

    @field_validator("items")
    @classmethod
    def _name_every_item_once(cls, items: tuple[Item, ...]) -> tuple[Item, ...]:
        twice = [name for name, count in Counter(item.id for item in items).items() if count > 1]
        if twice:
            raise ValueError(f"the item {twice[0]!r} stands twice")
        return items
