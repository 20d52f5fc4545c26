"""The languages that come with the program."""

from __future__ import annotations

from kiosk import BadInput
from kiosk.assistant.wording import Catalogue
from kiosk.settings import ASSETS


def catalogue(language: str) -> Catalogue:
    """The catalogue of a language; raises BadInput with all the languages there are."""
    if language not in languages():
        raise BadInput(f"there is no language {language!r}; there are {', '.join(languages())}")
    return Catalogue(ASSETS / "sentences" / language)


def languages() -> tuple[str, ...]:
    """Every language that has a folder of sentences, English first, as everything else is measured against it."""
    names = sorted(folder.name for folder in (ASSETS / "sentences").iterdir() if folder.is_dir())
    return tuple(sorted(names, key=lambda name: name != "en"))
