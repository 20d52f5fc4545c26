"""What a study tells its visitors about itself and their consent, in one file per language.

These are the texts that an ethics board approves, so they stand apart from all others and go by a version.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Self

from pydantic import Field, field_validator

from kiosk import UserInputError
from kiosk.config import ConfigModel, code_of
from kiosk.experiment.items import Name, Text, refuse_twice

PUBLISHING = "share"
"""The purpose of the consent that stands for publishing; where it is offered, it has to be ticked."""

POINTER = "pointer"
"""The purpose of the consent that stands for recording the way of the pointer."""

Paragraphs = Annotated[tuple[Text, ...], Field(min_length=1, max_length=8, strict=False)]


class Page(ConfigModel):
    """A title and a few paragraphs."""

    title: Text
    paragraphs: Paragraphs

    @property
    def characters(self) -> int:
        """How much there is to read."""
        return len(self.title) + sum(map(len, self.paragraphs))


class Purpose(ConfigModel):
    """Something that a visitor may agree to by a tick; without a required one there is no consent."""

    id: Name
    text: Text
    required: bool = True


class ConsentPage(Page):
    """What is agreed to."""

    purposes: Annotated[tuple[Purpose, ...], Field(min_length=1, max_length=5, strict=False)]

    @field_validator("purposes")
    @classmethod
    def _name_every_purpose_once(cls, purposes: tuple[Purpose, ...]) -> tuple[Purpose, ...]:
        refuse_twice("purpose", (purpose.id for purpose in purposes))
        return purposes

    @property
    def characters(self) -> int:
        """How much there is to read, with the purposes."""
        return super().characters + sum(len(purpose.text) for purpose in self.purposes)

    @property
    def required(self) -> frozenset[str]:
        """The purposes without which there is no consent."""
        return frozenset(purpose.id for purpose in self.purposes if purpose.required)


class Information(ConfigModel):
    """All of it, in one language; the same ``version`` says the same in every language."""

    file_kind = "information sheet"

    version: Text
    about: Page
    consent: ConsentPage
    debrief: Page

    @property
    def sha256(self) -> str:
        """The hash of all of it, stored with every consent."""
        return hashlib.sha256(self.model_dump_json().encode()).hexdigest()

    @classmethod
    def of(cls, folder: Path, language: str) -> Self:
        """Return the sheet of a language; raises UserInputError if there is none."""
        file = next((each for each in sorted(folder.glob("*.toml")) if code_of(each.stem) == language), None)
        if file is None:
            raise UserInputError(f"there is no information sheet for the language {language!r} in {folder}")
        return cls.read(file)


def check_alike(sheets: Mapping[str, Information], folder: Path) -> None:
    """Raise UserInputError unless every language has the same version and asks for the same."""
    for what, says in (("versions", _version), ("purposes", _purposes)):
        said = {language: says(sheet) for language, sheet in sheets.items()}
        if len(set(said.values())) > 1:
            each = "; ".join(f"{language}: {words}" for language, words in said.items())
            raise UserInputError(f"the information sheets in {folder} have different {what}: {each}")


def _version(sheet: Information) -> str:
    return sheet.version


def _purposes(sheet: Information) -> str:
    return ", ".join(f"{purpose.id}{'' if purpose.required else ' (optional)'}" for purpose in sheet.consent.purposes)
