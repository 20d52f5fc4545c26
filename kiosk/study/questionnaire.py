"""Questionnaires as data: which items there are and what may be answered. Their wording is in the catalogues."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Annotated, Self

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from kiosk import BadInput


class Item(BaseModel):
    """One question, answered on a scale from 1 to ``points``."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    id: str
    points: Annotated[int, Field(ge=2, le=11)]


class Questionnaire(BaseModel):
    """Items in their order; ``version`` changes whenever one of them does."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    id: str
    version: str
    items: Annotated[tuple[Item, ...], Field(min_length=1)]

    @classmethod
    def read(cls, path: Path) -> Self:
        """Read a questionnaire file (TOML); raises BadInput with a sentence that names what is wrong in it."""
        try:
            return cls.model_validate(tomllib.loads(path.read_text("utf-8")))
        except OSError as error:
            raise BadInput(f"the questionnaire {path} cannot be read: {error.strerror}") from error
        except tomllib.TOMLDecodeError as error:
            raise BadInput(f"the questionnaire {path} is not TOML: {error}") from error
        except ValidationError as error:
            first = error.errors()[0]
            key = ".".join(str(part) for part in first["loc"])
            raise BadInput(f"the questionnaire {path}: {key}: {first['msg']}, but it is {first['input']!r}") from error
