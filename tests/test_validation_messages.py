"""Faults that pydantic finds become plain sentences, in the words of the file."""

from __future__ import annotations

from typing import Annotated, Any, Literal

import pytest
from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from kiosk.errors import toml_error_message, validation_messages


class Round(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True)
    kind: Literal["round"]
    radius: Annotated[int, Field(ge=1, le=9)]


class Square(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True)
    kind: Literal["square"]
    side: float = 1.0


class Drawing(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True)
    title: Annotated[str, Field(min_length=1)]
    shapes: Annotated[list[Annotated[Round | Square, Field(discriminator="kind")]], Field(max_length=3)] = []
    frame: Square | None = None

    @model_validator(mode="after")
    def _be_worth_seeing(self) -> Drawing:
        if self.title == "nothing" and not self.shapes:
            raise ValueError("there is nothing to see")
        return self


def said(given: Any) -> tuple[str, ...]:
    """Return what is said of this."""
    with pytest.raises(ValidationError) as found:
        Drawing.model_validate(given)
    return validation_messages(found.value, given, Drawing)


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({}, "the key 'title' is missing"),
        ({"title": ""}, "title must not be empty"),
        ({"title": 1}, "title must be text in quotes, but it is 1"),
        ({"title": "a" * 99, "shape": 1}, "there is no key 'shape'; did you mean 'shapes'?"),
        ({"title": "a", "colour": 1}, "there is no key 'colour'; there are title, shapes, frame"),
        ({"title": "a", "shapes": [{}]}, "shape 1: the key 'kind' is missing"),
        (
            {"title": "a", "shapes": [{"kind": "oval"}]},
            "shape 1: kind must be one of 'round', 'square', but it is 'oval'",
        ),
        ({"title": "a", "shapes": [{"kind": "round", "id": "o"}]}, "shape 1 (o): the key 'radius' is missing"),
        (
            {"title": "a", "shapes": [{"kind": "round", "radius": 0}]},
            "shape 1: radius must be from 1 to 9, but it is 0",
        ),
        (
            {"title": "a", "shapes": [{"kind": "square", "sid": 1}]},
            "shape 1: there is no key 'sid'; did you mean 'side'?",
        ),
        ({"title": "a", "shapes": [{"kind": "square"}] * 4}, "shapes must have at most 3 entries, but it has 4"),
        ({"title": "a", "shapes": [5]}, "shape 1 must be a table with keys of its own, but it is 5"),
        ({"title": "a", "frame": {"kind": "square", "side": "x"}}, "frame.side must be a number, but it is 'x'"),
        ({"title": "nothing"}, "there is nothing to see"),
    ],
)
def test_a_fault_is_told_with_its_place(given: dict[str, Any], sentence: str) -> None:
    assert sentence in said(given)


def test_a_fault_in_what_a_kind_shares_is_told_once_and_there() -> None:
    given = {"title": "a", "round": {"radius": 10}, "shapes": [{"kind": "round"}, {"kind": "round"}]}
    merged = {"title": "a", "shapes": [{"kind": "round", "radius": 10}] * 2}
    with pytest.raises(ValidationError) as found:
        Drawing.model_validate(merged)
    assert validation_messages(found.value, given, Drawing) == ("round.radius must be from 1 to 9, but it is 10",)


def test_a_long_value_is_cut_short() -> None:
    (sentence,) = said({"title": list(range(1000))})
    assert sentence == "title must be text in quotes, but it is [0, 1, 2, 3, 4, 5, ...]"


@pytest.mark.parametrize(
    ("error", "meant"),
    [
        ("Cannot overwrite a value (at line 2, column 9)", "a key is there twice (at line 2, column 9)"),
        (
            "Cannot declare ('game',) twice (at line 2, column 6)",
            "the section [game] is there twice; put all of its keys under one of them (at line 2, column 6)",
        ),
        (
            "Cannot declare ('robot', 'options') twice (at line 9, column 15)",
            "the section [robot.options] is there twice; put all of its keys under one of them (at line 9, column 15)",
        ),
        ("Expected ']' (at end of document)", "Expected ']' (at end of document)"),
    ],
)
def test_a_text_that_is_no_toml_is_told_in_words(error: str, meant: str) -> None:
    assert toml_error_message(ValueError(error)) == meant
