"""What a person sees who lacks a kind of cone, and how far apart two pictures are for them.

``python -m tests.ui.colour_vision docs/figures/colour-vision.png`` draws every deck and every mark as they see them.

The matrices are those for severity 1.0 of Machado, Oliveira and Fernandes, "A Physiologically-based Model for
Simulation of Color Vision Deficiency", IEEE Transactions on Visualization and Computer Graphics 15 (6), 2009; they
act on linear RGB. Differences are CIE 1976 distances in CIELAB (D65), where about 2.3 can just be noticed.
"""

from __future__ import annotations

import os
import sys
from dataclasses import dataclass
from enum import Enum
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QFont, QFontDatabase, QGuiApplication, QImage, QPainter, QPen
from PySide6.QtSvg import QSvgRenderer

from kiosk import UserInputError
from kiosk.config import ASSETS
from tests.ui.looking import colours

Picture = NDArray[np.float64]
"""Rows x columns x (red, green, blue), sRGB from 0 to 1."""

SIDE = 120
STEP = SIDE + 6
LABEL = 170
CARD = 0.91
"""How much of its place on the board a card takes."""
EDGE = 5
JUST_NOTICED = 2.3
FRAME = 0.12
"""How much of a card's width its edge takes."""
WHITE_D65 = np.array([0.95047, 1.0, 1.08883])
TO_XYZ = np.array(
    [[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.072175], [0.0193339, 0.119192, 0.9503041]]
)


class Vision(Enum):
    """Who looks."""

    USUAL = "usual"
    PROTAN = "protan: no red cones"
    DEUTAN = "deutan: no green cones"
    TRITAN = "tritan: no blue cones"


MATRICES = {
    Vision.USUAL: np.eye(3),
    Vision.PROTAN: np.array(
        [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]]
    ),
    Vision.DEUTAN: np.array(
        [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]]
    ),
    Vision.TRITAN: np.array(
        [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]]
    ),
}


def seen(picture: Picture, vision: Vision) -> Picture:
    """Return a picture as such a person sees it."""
    return _gamma(np.clip(_linear(picture) @ MATRICES[vision].T, 0, 1))


def lab(picture: Picture) -> Picture:
    """Return a picture in CIELAB."""
    relative = _linear(picture) @ TO_XYZ.T / WHITE_D65
    root = np.where(relative > (6 / 29) ** 3, np.cbrt(relative), relative / (3 * (6 / 29) ** 2) + 4 / 29)
    x, y, z = np.moveaxis(root, -1, 0)
    return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], axis=-1)


def distance(one: Picture, other: Picture) -> NDArray[np.float64]:
    """How far apart two pictures are at each place."""
    return np.asarray(np.linalg.norm(lab(one) - lab(other), axis=-1))


@dataclass(frozen=True)
class Apart:
    """How two cards can be told apart."""

    colour: float
    """The mean distance over all that either picture covers; where only one does, from it to the empty card."""
    overlap: float
    """The share of that place which both cover: 1 for the same silhouette."""


def apart(one: Picture, other: Picture, empty: Picture) -> Apart:
    """How far two cards are apart; ``empty`` is a card without a picture. All three as such a person sees them."""
    covers = [distance(card, empty) > JUST_NOTICED for card in (one, other)]
    either, both = covers[0] | covers[1], covers[0] & covers[1]
    return Apart(float(distance(one, other)[either].mean()), float(both.sum() / either.sum()))


def decks() -> dict[str, dict[str, Picture]]:
    """Every card of every deck."""
    folders = sorted(folder for folder in (ASSETS / "cards").iterdir() if folder.is_dir())
    return {folder.name: {file.stem: draw(file) for file in sorted(folder.glob("*.svg"))} for folder in folders}


def empty_card(cards: dict[str, Picture]) -> Picture:
    """Return a card without a picture: the frame that all have in common, and within it the colour of its corner."""
    empty = np.median(np.stack(list(cards.values())), axis=0)
    frame = round(FRAME * SIDE)
    empty[frame:-frame, frame:-frame] = empty[frame, frame]
    return np.asarray(empty)


def draw(file: Path) -> Picture:
    """Return a card's picture on the paper of the screen."""
    image = QImage(SIDE, SIDE, QImage.Format.Format_RGB32)
    image.fill(QColor("#FBF6EC"))
    painter = QPainter(image)
    QSvgRenderer(str(file)).render(painter, QRectF(0, 0, SIDE, SIDE))
    painter.end()
    return picture_of(image)


def picture_of(image: QImage) -> Picture:
    """Qt's picture as numbers."""
    image = image.convertToFormat(QImage.Format.Format_RGB888)
    rows = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), image.bytesPerLine())
    return rows[:, : 3 * image.width()].reshape(image.height(), image.width(), 3) / 255.0


def colour(value: QColor) -> Picture:
    """One colour as a picture of one place."""
    return np.array([[[value.redF(), value.greenF(), value.blueF()]]])


def image_of(picture: Picture) -> QImage:
    """Numbers as Qt's picture."""
    rows = np.ascontiguousarray(np.round(picture * 255).astype(np.uint8))
    height, width, _ = rows.shape
    return QImage(rows.tobytes(), width, height, 3 * width, QImage.Format.Format_RGB888).copy()


def _linear(picture: Picture) -> Picture:
    return np.where(picture <= 0.04045, picture / 12.92, ((picture + 0.055) / 1.055) ** 2.4)


def _gamma(picture: Picture) -> Picture:
    return np.where(picture <= 0.0031308, picture * 12.92, 1.055 * np.power(picture, 1 / 2.4) - 0.055)


def figure() -> QImage:
    """Every deck, and the marks of both palettes beside a closed card, for each vision in a row of its own."""
    rows = [row for deck in decks().values() for row in _rows(list(deck.values()))]
    rows += _rows(marks())
    wide, high = max(len(pictures) for _, pictures in rows), len(rows)
    image = QImage(LABEL + wide * STEP, high * STEP, QImage.Format.Format_RGB32)
    image.fill(Qt.GlobalColor.white)
    painter = QPainter(image)
    painter.setFont(QFont("Noto Sans", 10))
    for down, (vision, pictures) in enumerate(rows):
        where = QRectF(8, down * STEP, LABEL - 8, STEP)
        painter.drawText(where, Qt.AlignmentFlag.AlignVCenter | Qt.TextFlag.TextWordWrap, vision.value)
        for across, picture in enumerate(pictures):
            painter.drawImage(LABEL + across * STEP, down * STEP + (STEP - SIDE) // 2, image_of(seen(picture, vision)))
    painter.end()
    return image


def marks() -> list[Picture]:
    """Return a closed card as it lies on the board: unmarked, and marked, in the usual palette and in high contrast."""
    back = ASSETS / "cards" / "back.svg"
    themes = [colours(palette) for palette in ("normal", "high")]
    return [
        _card_on(theme["paper"], back, mark)
        for theme in themes
        for mark in (None, (theme["amber"], theme["deepAmber"]))
    ]


def _card_on(paper: QColor, file: Path, mark: tuple[QColor, QColor] | None) -> Picture:
    image = QImage(SIDE, SIDE, QImage.Format.Format_RGB32)
    image.fill(paper)
    painter = QPainter(image)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    if mark is not None:
        painter.setBrush(mark[0])
        painter.setPen(QPen(mark[1], EDGE))
        painter.drawRoundedRect(QRectF(EDGE, EDGE, SIDE - 2 * EDGE, SIDE - 2 * EDGE), 4 * EDGE, 4 * EDGE)
    inset = SIDE * (1 - CARD) / 2
    QSvgRenderer(str(file)).render(painter, QRectF(inset, inset, SIDE * CARD, SIDE * CARD))
    painter.end()
    return picture_of(image)


def _rows(pictures: list[Picture]) -> list[tuple[Vision, list[Picture]]]:
    return [(vision, pictures) for vision in Vision]


def main(file: Path) -> None:
    """Draw the figure into a file."""
    application = QGuiApplication(["colour vision"])
    QFontDatabase.addApplicationFont(str(ASSETS / "fonts" / "NotoSans-Regular.ttf"))
    if not figure().save(str(file)):
        raise UserInputError(f"the picture {file} cannot be written")
    del application


if __name__ == "__main__":
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    main(Path(sys.argv[1]))
