"""Where that lies what a study file calls by name: what is shipped goes before a path from the file's own folder."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from kiosk import BadInput
from kiosk.assistant.qtable import NONE
from kiosk.settings import ASSETS, POLICIES, Settings, policy_path

_WORDS = {
    "sentences": "language",
    "consent": "folder of information sheets",
    "questionnaires": "questionnaire",
    "scales": "folder of pictures",
    "cards": "deck",
}
"""What people call what lies in a folder of assets."""


def folder(settings: Settings, kind: str, name: str) -> Path:
    """A folder of this kind of assets; raises BadInput with the names that there are."""
    for path in _places(settings, kind, name):
        if path.is_dir():
            return path
    raise _nothing(settings, _WORDS[kind], name, (path.name for path in (ASSETS / kind).iterdir() if path.is_dir()))


def toml(settings: Settings, kind: str, name: str) -> Path:
    """A TOML file of this kind of assets; raises BadInput with the names that there are."""
    for path in (*_places(settings, kind, f"{name}.toml"), *_places(settings, kind, name)):
        if path.is_file():
            return path
    raise _nothing(settings, _WORDS[kind], name, (path.stem for path in (ASSETS / kind).glob("*.toml")))


def policy(settings: Settings, name: str) -> Path:
    """The file of a policy; raises BadInput with the names that there are."""
    for path in (policy_path(name), settings.beside(name)):
        if path.is_file():
            return path
    raise _nothing(settings, "policy", name, (*(path.stem for path in POLICIES.glob("*.json")), NONE))


def _places(settings: Settings, kind: str, name: str) -> tuple[Path, ...]:
    """Where it may lie; an empty name is nowhere, and neither is one that no file can have."""
    try:
        return (settings.find(kind, name),) if name else ()
    except (OSError, ValueError):
        return ()


def _nothing(settings: Settings, what: str, name: str, shipped: Iterable[str]) -> BadInput:
    beside = f", and nothing at {settings.beside(name)}" if name else ""
    return BadInput(f"there is no {what} {name!r} (shipped are {', '.join(sorted(shipped))}){beside}")
