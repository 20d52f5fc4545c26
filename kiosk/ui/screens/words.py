"""The fixed texts of the screens, from the language's catalogue."""

from __future__ import annotations

from kiosk.assistant.wording import Catalogue

FIXED = (
    "attract-title",
    "attract-line",
    "attract-start",
    "introduction-title",
    "introduction-turn",
    "introduction-match",
    "introduction-help",
    "introduction-continue",
    "result-title",
    "result-pairs-label",
    "result-moves-label",
    "result-time-label",
    "result-continue",
    "questions-lowest",
    "questions-highest",
    "questions-next",
    "questions-skip",
    "questions-finish",
    "still-there-title",
    "still-there-line",
    "still-there-yes",
    "pause-title",
    "pause-line",
)
"""Every message that QML shows as it stands; those with variables are filled in by the screens' objects."""


def words(catalogue: Catalogue) -> dict[str, str]:
    """The fixed texts, by the names of their messages."""
    return {message: catalogue.text(message) for message in FIXED}
