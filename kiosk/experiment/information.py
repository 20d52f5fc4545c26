"""What a study tells its visitors about itself and their consent, in one file per language.

These are the texts that an ethics board approves, so they stand apart from all others and go by a version.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Literal, Self

from pydantic import Field, field_validator, model_validator

from kiosk import UserInputError
from kiosk.config import ConfigModel, code_of
from kiosk.experiment.items import Name, Text, refuse_twice

PUBLISHING = "share"
"""The purpose of the consent that stands for publishing; where it is offered, it has to be ticked."""

POINTER = "pointer"
"""The purpose of the consent that stands for recording the way of the pointer."""

RETURNING = "return"
"""The purpose of the consent that stands for linking what a visitor does at several visits."""

Paragraphs = Annotated[tuple[Text, ...], Field(min_length=1, max_length=8, strict=False)]


Sign = Literal[
    "helper",
    "person",
    "cards",
    "clock",
    "questions",
    "no_name",
    "delete",
    "play",
    "lock",
    "compare",
    "seen",
    "chance",
    "letter",
    "camera",
]
"""A drawing beside a line."""


class Page(ConfigModel):
    """A title and a few paragraphs.

    ``points`` say the most important in a few short lines. The consent page shows them first, and all paragraphs once
    the visitor asks for more. ``signs`` are drawings, one for each point, or for each paragraph where there are no
    points.
    """

    title: Text
    paragraphs: Paragraphs
    points: Annotated[tuple[Text, ...], Field(max_length=4, strict=False)] = ()
    signs: Annotated[tuple[Sign, ...], Field(max_length=8, strict=False)] = ()

    @model_validator(mode="after")
    def _draw_one_sign_for_each_line(self) -> Self:
        lines, what = (self.points, "points") if self.points else (self.paragraphs, "paragraphs")
        if self.signs and len(self.signs) != len(lines):
            raise ValueError(f"there are {len(self.signs)} signs for {len(lines)} {what}; each needs one")
        return self

    @property
    def lines(self) -> tuple[tuple[str, str], ...]:
        """What the page says first, line by line, each with the name of its drawing, which may be empty."""
        lines = self.points or self.paragraphs
        return tuple(zip(lines, self.signs or ("",) * len(lines), strict=True))

    @property
    def characters(self) -> int:
        """How much there is to read."""
        return len(self.title) + sum(map(len, (*self.points, *self.paragraphs)))


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
        """The hash of all of it, stored with every consent; what a page leaves out does not count."""
        pages = {"about": self.about, "consent": self.consent, "debrief": self.debrief}
        absent = {name: {key for key in ("points", "signs") if not getattr(page, key)} for name, page in pages.items()}
        return hashlib.sha256(self.model_dump_json(exclude=absent).encode()).hexdigest()

    @classmethod
    def of(cls, folder: Path, language: str) -> Self:
        """Return the sheet of a language; raises UserInputError if there is none."""
        file = next((each for each in sorted(folder.glob("*.toml")) if code_of(each.stem) == language), None)
        if file is None:
            raise UserInputError(f"there is no information sheet for the language {language!r} in {folder}")
        return cls.read(file)


def check_alike(sheets: Mapping[str, Information], folder: Path) -> None:
    """Raise UserInputError unless every language has the same version and asks for the same."""
    for what, says in (("versions", _version), ("purposes", _purposes), ("points", _points), ("signs", _signs)):
        said = {language: says(sheet) for language, sheet in sheets.items()}
        if len(set(said.values())) > 1:
            each = "; ".join(f"{language}: {words}" for language, words in said.items())
            raise UserInputError(f"the information sheets in {folder} have different {what}: {each}")


def _version(sheet: Information) -> str:
    return sheet.version


def _points(sheet: Information) -> str:
    return ", ".join(str(len(page.points)) for page in (sheet.about, sheet.consent, sheet.debrief))


def _signs(sheet: Information) -> str:
    return ", ".join(sign for page in (sheet.about, sheet.consent, sheet.debrief) for sign in page.signs) or "none"


def _purposes(sheet: Information) -> str:
    return ", ".join(f"{purpose.id}{'' if purpose.required else ' (optional)'}" for purpose in sheet.consent.purposes)
