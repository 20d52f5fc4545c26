"""Look for what a study file names, and keep where it came from and what is wrong with it."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TypeVar

from kiosk import UserInputError
from kiosk.assistance.policy import NONE
from kiosk.config import Located, Settings, is_path, shipped_names
from kiosk.experiment.session_config import Source
from kiosk.files import open_to_read

_WORDS = {
    "sentences": "language",
    "consent": "folder of information sheets",
    "questionnaires": "questionnaire",
    "scales": "folder of pictures",
    "cards": "deck",
    "policies": "policy",
}
"""What people call what goes by a name."""


def located(settings: Settings, kind: str, name: str) -> Located:
    """Find something of this kind; raises UserInputError with the names that there are."""
    found = settings.locate(kind, name)
    if found is None:
        raise UserInputError(_nothing(settings, kind, name))
    return found


def _nothing(settings: Settings, kind: str, name: str) -> str:
    what = _WORDS[kind]
    if is_path(name):
        return f"there is no {what} at {settings.beside(name)}; a name with / or an ending is a path"
    shipped = sorted({*shipped_names(kind), *((NONE,) if kind == "policies" else ())})
    beside = f", and nothing at {settings.beside(name)}" if name else ""
    return f"there is no {what} {name!r} (shipped are {', '.join(shipped)}){beside}"


Read = TypeVar("Read")


class Findings:
    """What was found of a study: where things came from in ``sources``, and what is wrong in ``faults``."""

    def __init__(self, settings: Settings) -> None:
        """Begin with nothing found."""
        self.settings = settings
        self.faults: list[str] = []
        self.sources: list[Source] = []

    def at(self, key: str, read: Callable[[], Read]) -> Read | None:
        """Return what is read, or None if the study file is to blame, at this key."""
        try:
            return read()
        except UserInputError as error:
            self.blame(key, *error.sentences)
        except ValueError as error:
            self.blame(key, str(error))
        return None

    def into(self, read: Callable[[], Read]) -> Read | None:
        """Return what is read, or None if a file is to blame that its own sentence names."""
        try:
            return read()
        except UserInputError as error:
            self.faults += error.sentences
            return None

    def blame(self, key: str, *sentences: str) -> None:
        """Note what is wrong with what stands at this key."""
        line = self.settings.line_of(*key.split("."))
        where = "" if line is None else f" (line {line})"
        self.faults += (f"{self.settings.name}: {key}: {each.removeprefix(f'{key}: ')}{where}" for each in sentences)

    def came(self, key: str, name: str, place: Located, sha256: str, version: str | None = None) -> None:
        """Keep in mind where something came from."""
        self.sources.append(Source(key, name, place.path, place.is_shipped, sha256, version, place.unused))

    def drawn(self, key: str, name: str, place: Located, files: Iterable[Path]) -> None:
        """Keep in mind where pictures came from."""
        there = tuple(files)
        sha256 = hash_of_files(there)
        source = Source(key, name, place.path, place.is_shipped, sha256, unused=place.unused, pictures=there)
        self.sources.append(source)


def hash_of_files(files: Iterable[Path]) -> str:
    """Return the hash over files that belong together, by their names and what is in them."""
    return hash_of((file.name, digest(file)) for file in files)


def digest(file: Path) -> str:
    """Return the hash of a file; an empty text if it cannot be read."""
    try:
        with open_to_read(file) as opened:
            return hashlib.file_digest(opened, "sha256").hexdigest()
    except OSError:
        # That it cannot be read is said elsewhere.
        return ""


def hash_of(named: Iterable[tuple[str, str]]) -> str:
    """Return the hash over texts, each with its name."""
    return hashlib.sha256(json.dumps(sorted(named), ensure_ascii=False).encode()).hexdigest()
