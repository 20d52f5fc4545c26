"""The fixed texts of the screens, from the language's catalogue."""

from __future__ import annotations

from PySide6.QtCore import QObject
from PySide6.QtQml import QQmlPropertyMap

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


def words(catalogue: Catalogue, parent: QObject) -> QQmlPropertyMap:
    """The fixed texts, by the names of their messages."""
    texts = QQmlPropertyMap(parent)
    for message in FIXED:
        texts.insert(message, catalogue.text(message))
    return texts
