"""Where characters begin, as people see them: a family of emoji or a letter with its accents is one character."""

from __future__ import annotations

from PySide6.QtCore import QTextBoundaryFinder


def before(text: str, place: int) -> int:
    """Return where the character begins that ends at ``place``; both count UTF-16 units, as Qt does."""
    finder = QTextBoundaryFinder(QTextBoundaryFinder.BoundaryType.Grapheme, text)
    finder.setPosition(place)
    return max(0, finder.toPreviousBoundary())


def fitting(text: str, place: int, longest: int) -> int:
    """Return where what stands before ``place`` has to end, so that the text has at most ``longest`` code points."""
    head = _units(text)[: 2 * place].decode("utf-16-le", "surrogatepass")
    kept = head[: max(0, len(head) - max(0, len(text) - longest))]
    return len(_units(kept)) // 2


def without_last(text: str) -> str:
    """Return the text without its last character."""
    units = _units(text)
    return units[: 2 * before(text, len(units) // 2)].decode("utf-16-le", "surrogatepass")


def _units(text: str) -> bytes:
    return text.encode("utf-16-le", "surrogatepass")
