"""What every declared thing is: read from a TOML file, checked, and unchangeable."""

from __future__ import annotations

import os
import re
import tomllib
from pathlib import Path
from typing import Annotated, Any, ClassVar, Self

from pydantic import (
    BaseModel,
    ConfigDict,
    Field,
    ValidationError,
)

from kiosk import UserInputError
from kiosk.errors import (
    code_point,
    control_character,
    control_characters,
    shortened,
    toml_error_message,
    validation_messages,
)
from kiosk.files import open_to_read
from kiosk.units import MS_PER_HOUR, MS_PER_MINUTE, Unit

MOST_CHARACTERS = 500
"""A title, an address or a path that is longer fits on no screen."""

MOST_IN_TEXT = 10_000
"""A text that visitors read, such as a page of instructions, is never longer."""


# Pydantic would look for plugins of its own in every installed package, which takes a moment at each start; one that
# is installed for something else must not change how a study is read, either.
os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")


class ConfigModel(BaseModel):
    """Something that is declared in a TOML file, in whole or in part.

    It is unchangeable once read; a key that does not exist is refused, and so is a value that would have to be bent.
    """

    model_config = ConfigDict(
        frozen=True, extra="forbid", strict=True, allow_inf_nan=False, str_max_length=MOST_CHARACTERS
    )

    file_kind: ClassVar[str] = "file"
    """What such a file is called in a refusal."""

    @classmethod
    def read(cls, path: Path) -> Self:
        """Read a file; raise UserInputError with a sentence for each fault, naming the file and the key."""
        name = f"the {cls.file_kind} {path}"
        text = read_text(name, path)
        given, text = parse_toml(name, text)
        unseen = [f"{name}: {sentence}" for sentence in control_characters(given, text)]
        if unseen:
            raise UserInputError(*unseen)
        try:
            return cls.model_validate(given)
        except ValidationError as error:
            raise UserInputError(
                *(f"{name}: {sentence}" for sentence in validation_messages(error, given, cls, text))
            ) from error


MOST_BYTES = 1024 * 1024
"""No file that a person writes for a study is longer; a longer one is a mistake, and slow to read."""

_MOST_DOTS = 1000

_MOST_DOTS_SQUARED = 5_000_000
"""A key with very many dots takes the reader of TOML hours, and so do many with hundreds: its time is their square."""

_LONG_NUMBER = re.compile(r"\d[\d_]{400,}")
"""Far beyond all bounds; Python refuses to read whole numbers of more than 4,300 digits."""


def read_content(name: str, path: Path) -> bytes:
    """Read a file of a study; raises UserInputError, in which the file is called ``name``."""
    try:
        with open_to_read(path) as file:
            content = file.read(MOST_BYTES + 1)
    except OSError as error:
        raise UserInputError(f"{name} cannot be read: {error.strerror}") from error
    if len(content) > MOST_BYTES:
        raise UserInputError(f"{name} is too long: it has more than {MOST_BYTES // 1024} KiB")
    return content


def read_text(name: str, path: Path) -> str:
    """Read a text file of a study; raises UserInputError, in which the file is called ``name``."""
    try:
        # Some editors begin a file with a mark that is no text, and some end lines in two characters.
        text = read_content(name, path).decode("utf-8-sig").replace("\r\n", "\n")
    except UnicodeDecodeError as error:
        raise UserInputError(f"{name} is not UTF-8; save it with that encoding") from error
    if unseen := control_character(text):
        line = text.count("\n", 0, unseen.start()) + 1
        raise UserInputError(f"{name}, line {line}, has the control character {code_point(unseen)}; take it out")
    return text


def parse_toml(name: str, text: str) -> tuple[dict[str, Any], str]:
    """Return what a text holds, and the text that it was read from, whose lines are the same.

    Raises UserInputError, in which the text is called ``name``.
    """
    dots = [line.count(".") for line in text.split("\n")]
    if max(dots) > _MOST_DOTS or sum(count**2 for count in dots) > _MOST_DOTS_SQUARED:
        raise UserInputError(f"{name} has too many dots to be read: line {dots.index(max(dots)) + 1} has {max(dots)}")
    try:
        try:
            return tomllib.loads(text), text
        except tomllib.TOMLDecodeError:
            raise
        except ValueError:
            # Cut short, the number is still too large wherever it stands, so the key that has it gets its sentence.
            text = _LONG_NUMBER.sub(shortened, text)
            return tomllib.loads(text), text
    except (ValueError, RecursionError) as error:
        raise UserInputError(f"{name} is not TOML: {toml_error_message(error)}") from error


Milliseconds = Annotated[int, Field(ge=1, le=MS_PER_HOUR), Unit("ms")]

Delay = Annotated[int, Field(ge=0, le=MS_PER_MINUTE), Unit("ms")]

PerCharacter = Annotated[int, Field(ge=1, le=10_000), Unit("ms")]
"""Times; none is so long that a visitor would take the kiosk for broken."""

Lines = Annotated[int, Field(ge=1, le=12)]
"""Rows or columns of a board."""

Metres = Annotated[float, Field(ge=-10, le=10), Unit("m")]

Size = Annotated[float, Field(ge=0.01, le=10), Unit("m")]

MOST_ENTRIES = 50
"""More languages or questionnaires than any visitor would bear."""

MOST_QUOTED = 40
