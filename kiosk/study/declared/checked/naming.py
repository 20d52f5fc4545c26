"""Find what a study file calls by name: shipped, or by a path from the study file's own folder."""

from __future__ import annotations

from kiosk import BadInput
from kiosk.assistant.qtable import NONE
from kiosk.settings import Located, Settings, is_path, shipped_names

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
    """Find something of this kind; raises BadInput with the names that there are."""
    found = settings.locate(kind, name)
    if found is None:
        raise BadInput(_nothing(settings, kind, name))
    return found


def _nothing(settings: Settings, kind: str, name: str) -> str:
    what = _WORDS[kind]
    if is_path(name):
        return f"there is no {what} at {settings.beside(name)}; a name with / or an ending is a path"
    shipped = sorted({*shipped_names(kind), *((NONE,) if kind == "policies" else ())})
    beside = f", and nothing at {settings.beside(name)}" if name else ""
    return f"there is no {what} {name!r} (shipped are {', '.join(shipped)}){beside}"
