"""Draw how likely each card is remembered, in a film and in the window of a replay."""

from __future__ import annotations

from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QColor, QGuiApplication, QPainter

from kiosk.experiment.memory_replay import BoardMemory
from kiosk.game import Board
from kiosk.lazy_dataclass import dataclass

INK, PAPER, FAINT, AMBER = (QColor(name) for name in ("#1F2A33", "#FFFFFF", "#B9C4CC", "#F2B84B"))
MARGIN, LINE = 20, 32
_CELL_HEIGHT, _CELL_WIDTH, _WIDTH = 36, 48, 320
"""How high a card is at most, how wide it is, and how wide the drawing is at least."""


@dataclass(frozen=True)
class Style:
    """How a text of the captions is written."""

    size: int = 22
    bold: bool = False
    middle: bool = False


_SMALL, _CELL = Style(16), Style(16, middle=True)


def write(painter: QPainter, text: str, room: QRect, ink: QColor, style: Style | None = None) -> None:
    """Write a text into a rectangle, on several lines if it is long."""
    style = style or Style()
    font = QGuiApplication.font()
    font.setPixelSize(style.size)
    font.setBold(style.bold)
    painter.setFont(font)
    painter.setPen(ink)
    place = Qt.AlignmentFlag.AlignCenter if style.middle else Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop
    painter.drawText(room, place | Qt.TextFlag.TextWordWrap, text)


def memory_width(board: Board) -> int:
    """Return how wide the drawing of this board is."""
    return max(_CELL_WIDTH * board.columns, _WIDTH)


def draw_memory(painter: QPainter, memory: BoardMemory, title: str, room: QRect) -> None:
    """Draw the board with the chance that each card is recalled (%), below a title."""
    left, top, board = room.left(), room.top(), memory.board
    side = min(_CELL_HEIGHT, (room.height() - LINE) // board.rows)
    write(painter, title, QRect(left, top, room.width(), LINE), FAINT, _SMALL)
    for location, chance in enumerate(memory.chances):
        place = board.position(location)
        cell = QRect(left + place.column * _CELL_WIDTH, top + LINE + place.row * side, _CELL_WIDTH - 2, side - 2)
        shade = QColor(AMBER)
        shade.setAlphaF(0.1 + 0.9 * chance)
        painter.fillRect(cell, shade)
        if chance > 0:
            ink = INK if chance > 0.5 else PAPER  # noqa: PLR2004 - readable on light and on dark
            write(painter, f"{100 * chance:.0f}", cell, ink, _CELL)
