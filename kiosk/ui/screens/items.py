"""What QML is given of an item to show it: plain values, in one language."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from PySide6.QtCore import QUrl

from kiosk.assistant.wording import Catalogue
from kiosk.study.declared.questionnaire import (
    Differential,
    Integer,
    Item,
    Likert,
    Multiple,
    Pictures,
    ShortText,
    Single,
    Slider,
)
from kiosk.study.declared.words import in_language


def described(item: Item, catalogue: Catalogue, scale: Callable[[str], Path]) -> dict[str, Any]:
    """An item as QML shows it; ``scale`` tells where the pictures of a scale are."""
    shown = {"id": item.id, "kind": item.kind, "text": in_language(item.text, catalogue.language)}
    return shown | _ends(item, catalogue.language) | _choice(item, catalogue, scale)


def _ends(item: Item, language: str) -> dict[str, Any]:
    """The words at the two ends of a rating."""
    match item:
        case Likert() | Pictures():
            return {"left": in_language(item.lowest, language), "right": in_language(item.highest, language)}
        case Differential() | Slider():
            return {"left": in_language(item.left, language), "right": in_language(item.right, language)}
    return {}


def _choice(item: Item, catalogue: Catalogue, scale: Callable[[str], Path]) -> dict[str, Any]:
    """What there is to choose from, or how much can be typed."""
    match item:
        case Likert() | Differential() | Pictures():
            return {"points": item.points, "pictures": _pictures(item, scale)}
        case Slider():
            return {"lowest": item.lowest, "highest": item.highest}
        case Integer():
            field = item.input
            words = catalogue.text("form-range", lowest=item.lowest, highest=item.highest)
            return {"range": words, "minus": field.has_minus, "widest": field.longest, "pattern": field.pattern}
        case Single() | Multiple():
            language = catalogue.language
            return {"options": [{"id": each.id, "text": in_language(each.text, language)} for each in item.options]}
        case ShortText():
            return {"longest": item.longest}
    return {}


def _pictures(item: Likert | Differential | Pictures, scale: Callable[[str], Path]) -> list[str]:
    """The addresses of the pictures, from the lowest point on; none where points are numbers."""
    if not isinstance(item, Pictures):
        return []
    folder = scale(item.pictures)
    return [QUrl.fromLocalFile(str(folder / f"{point}.svg")).toString() for point in range(1, item.points + 1)]
