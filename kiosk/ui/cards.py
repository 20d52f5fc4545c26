"""A study's own cards: drawn once, in the frame of the shipped ones, by a process with a deadline."""

from __future__ import annotations

import hashlib
import json
import logging
import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, replace
from math import fsum
from pathlib import Path

from platformdirs import user_cache_path
from PySide6.QtCore import QBuffer, QByteArray, QIODevice, QRect, QRectF, QSize, Qt, QUrl
from PySide6.QtGui import (
    QColor,
    QFont,
    QFontDatabase,
    QGuiApplication,
    QImage,
    QImageReader,
    QPainter,
    QPainterPath,
    QPen,
)

from kiosk import UserInputError, program
from kiosk.config import ASSETS, Settings, luminance, pictures_in
from kiosk.files import replace_file, write_file
from kiosk.lazy_dataclass import dataclass
from kiosk.ui.checks import DRAWN_S, CannotDraw, answers

_log = logging.getLogger(__name__)

SIDE = 512
"""Pixels of a drawn card; the largest card on a screen of 1920 x 1080 has 300."""

MOST_MEGAPIXELS = 32
"""A larger picture takes seconds to read; a phone's photo usually has 12."""

LEAST_SIDE = 240
"""Pixels; a smaller picture is blurred on the board."""

FONTS = ("NotoSans-Regular.ttf", "NotoSans-Bold.ttf")

_VERSION = 1
"""Changes with every change of the frame, so that no older drawing is used."""

_UNIT = SIDE / 240
_CARD = QRectF(6 * _UNIT, 6 * _UNIT, 228 * _UNIT, 228 * _UNIT)
_RADIUS = 26 * _UNIT
_PAPER, _EDGE, _INK = "#FFFBF2", "#E4D9C3", "#22313F"
"""The frame of the shipped cards, on their board of 240 units."""

_MARGIN = 20 * _UNIT
"""Around a picture with a transparent background, which is not cropped."""

LOW_CONTRAST = 1.6
"""Between the dark and the light parts of a picture, by the formula of WCAG; the palest shipped card has 4.5."""

ALIKE, ALIKE_IN_GREY = 0.07, 0.04
"""How far two pictures are from each other, 0 to 1; shipped cards are 0.17 and 0.13 apart or more."""

_GRID = 16


@dataclass(frozen=True)
class CardDrawing:
    """A picture of a card and what came of drawing it; ``width`` and ``height`` are the file's own, in pixels."""

    file: Path
    drawn: Path | None
    fault: str = ""
    width: int = 0
    height: int = 0
    contrast: float = 0.0
    signature: str = ""
    """The drawn picture in 16 x 16 colours, as hexadecimal numbers."""


def cache_folder() -> Path:
    """Return the folder of drawn cards, which may be deleted at any time."""
    return user_cache_path("recollect", appauthor=False) / "cards"


def draw_cards(
    files: Iterable[Path], folder: Path | None = None, command: Sequence[str] = (), within_s: float = DRAWN_S
) -> dict[Path, CardDrawing]:
    """Draw pictures into the frame of a card, each once, and return what came of each.

    What was drawn before is taken from ``folder``. A picture that is not done within ``within_s`` seconds, or that ends
    the process, has a fault. Raises CannotDraw if nothing can be drawn on this machine.
    """
    folder = cache_folder() if folder is None else folder
    places = {file: _place(file, folder) for file in files}
    found = {file: noted for file, place in places.items() if place and (noted := _read(file, place))}
    jobs = [file for file, place in places.items() if place and file not in found]
    done: dict[Path, CardDrawing] = {}
    if jobs:
        _make(folder)
        told = [json.dumps([str(file), str(places[file])]) for file in jobs]
        for at, said, why in answers(command or program("_display", "cards"), told, within_s):
            done[jobs[at]] = _answer(jobs[at], said, why)
    unreadable = (CardDrawing(file, None, "the file cannot be read") for file, place in places.items() if not place)
    return {each.file: each for each in (*found.values(), *done.values(), *unreadable)}


def _place(file: Path, folder: Path) -> Path | None:
    """Return where the drawing of a picture lies, by what is in the file."""
    try:
        digest = hashlib.sha256(file.read_bytes()).hexdigest()
    except OSError:
        return None
    return folder / f"{digest[:32]}-{file.suffix[1:].lower()}-{_VERSION}.png"


def _read(file: Path, place: Path) -> CardDrawing | None:
    """Return what was noted of a picture that was drawn before."""
    try:
        noted = json.loads(place.with_suffix(".json").read_text("utf-8"))
        return replace(CardDrawing(**noted), file=file, drawn=place) if place.is_file() else None
    except (OSError, ValueError, TypeError):
        return None


def _make(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise CannotDraw(f"{folder} cannot be made: {error.strerror}") from error


def _answer(file: Path, said: str | None, why: str) -> CardDrawing:
    if said is None:
        return CardDrawing(file, None, why)
    noted = json.loads(said)
    drawn = noted["drawn"]
    return CardDrawing(**noted | {"file": file, "drawn": drawn and Path(drawn)})


# In the process


def draw_card(job: str) -> str:
    """Draw one picture, and return what came of it as JSON.

    ``job`` is a JSON list of the picture's file and the file for its drawing.
    """
    file, place = map(Path, json.loads(job))
    drawing = _drawn(file, place)
    if drawing.drawn is not None:
        noted = json.dumps(asdict(drawing) | {"file": "", "drawn": None})
        replace_file(place.with_suffix(".json"), noted, durable=False)
    return json.dumps(asdict(drawing), default=str)


def _drawn(file: Path, place: Path) -> CardDrawing:
    reader = QImageReader(str(file))
    reader.setAutoTransform(True)
    is_svg = file.suffix.lower() == ".svg"
    if is_svg:
        reader.setFormat(b"svg")
    size = reader.size()
    drawing = CardDrawing(file, None, "", size.width(), size.height())
    megapixels = size.width() * size.height() / 1e6
    if not is_svg and megapixels > MOST_MEGAPIXELS:
        fault = f"it has {megapixels:.0f} megapixels, and must have at most {MOST_MEGAPIXELS}; save it smaller"
        return replace(drawing, fault=fault)
    _read_no_larger_than_needed(reader, size, is_svg=is_svg)
    image = reader.read()
    if image.isNull():
        return replace(drawing, fault=" ".join(reader.errorString().split()) or "it is no picture")
    if not _shows_something(image):
        return replace(drawing, fault="it shows nothing")
    card = framed(image, is_svg=is_svg)
    if not card.save(str(place)):
        return replace(drawing, fault=f"its drawing cannot be written to {place.parent}")
    return replace(drawing, drawn=place, contrast=_contrast(_pixels(card, _PIXELS)), signature=_signature(card))


def _read_no_larger_than_needed(reader: QImageReader, size: QSize, *, is_svg: bool) -> None:
    """Make a photo smaller while it is read, which takes a tenth of the time and of the memory."""
    if size.isEmpty():
        return
    how = Qt.AspectRatioMode.KeepAspectRatio if is_svg else Qt.AspectRatioMode.KeepAspectRatioByExpanding
    wanted = size.scaled(QSize(SIDE, SIDE), how)
    if is_svg or wanted.width() < size.width():
        reader.setScaledSize(wanted)


def _shows_something(image: QImage) -> bool:
    alpha = image.convertToFormat(QImage.Format.Format_Alpha8)
    return any(bytes(alpha.constBits()))


def framed(image: QImage | None, name: str = "", *, is_svg: bool = False) -> QImage:
    """Return a card with a picture on it, or with a name where there is no picture.

    A photo is cropped to a square from its middle. A picture with a transparent background is shown whole, and so is an
    SVG, which may draw a frame of its own.
    """
    card = QImage(SIDE, SIDE, QImage.Format.Format_ARGB32_Premultiplied)
    card.fill(Qt.GlobalColor.transparent)
    painter = QPainter(card)
    painter.setRenderHints(QPainter.RenderHint.Antialiasing | QPainter.RenderHint.SmoothPixmapTransform)
    outline = QPainterPath()
    outline.addRoundedRect(_CARD, _RADIUS, _RADIUS)
    painter.fillPath(outline, QColor(_PAPER))
    painter.setClipPath(outline)
    if image is not None:
        painter.drawImage(_target(image, is_svg=is_svg), image)
    else:
        _write(painter, name)
    painter.setClipping(False)
    painter.setPen(QPen(QColor(_EDGE), 3 * _UNIT))
    painter.drawPath(outline)
    painter.end()
    return card


def _target(image: QImage, *, is_svg: bool) -> QRectF:
    """Return where a picture is drawn; what is outside of the card is cut off."""
    size = image.size().toSizeF()
    if is_svg:
        room, how = QRectF(0, 0, SIDE, SIDE), Qt.AspectRatioMode.KeepAspectRatio
    elif _has_transparent_corners(image):
        room, how = _CARD.adjusted(_MARGIN, _MARGIN, -_MARGIN, -_MARGIN), Qt.AspectRatioMode.KeepAspectRatio
    else:
        room, how = _CARD, Qt.AspectRatioMode.KeepAspectRatioByExpanding
    size.scale(room.size(), how)
    target = QRectF(0, 0, size.width(), size.height())
    target.moveCenter(room.center())
    return target


def _has_transparent_corners(image: QImage) -> bool:
    right, bottom = image.width() - 1, image.height() - 1
    corners = ((0, 0), (right, 0), (0, bottom), (right, bottom))
    return image.hasAlphaChannel() and all(image.pixelColor(*corner).alpha() < 128 for corner in corners)  # noqa: PLR2004


def _write(painter: QPainter, name: str) -> None:
    font = QFont("Noto Sans")
    font.setPixelSize(round(40 * _UNIT))
    font.setBold(True)
    painter.setFont(font)
    painter.setPen(QColor(_INK))
    room = _CARD.adjusted(_MARGIN, _MARGIN, -_MARGIN, -_MARGIN)
    flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap | Qt.TextFlag.TextWrapAnywhere
    while font.pixelSize() > 12 and not room.contains(painter.boundingRect(room, flags, name)):  # noqa: PLR2004
        font.setPixelSize(font.pixelSize() - 4)
        painter.setFont(font)
    painter.drawText(room, flags, name)


# What can be said of the drawn cards

Colour = tuple[float, float, float]
"""Red, green and blue, each from 0 to 1."""

_PIXELS = 64
_GREY = (0.2126, 0.7152, 0.0722)
"""How light red, green and blue look, by ITU-R BT.709."""


def _pixels(card: QImage, side: int) -> list[Colour]:
    """Return the inside of a drawn card as so many rows of so many colours, one row after another."""
    inner = _CARD.adjusted(_MARGIN, _MARGIN, -_MARGIN, -_MARGIN).toRect()
    image = card.copy(inner).scaled(QSize(side, side), mode=Qt.TransformationMode.SmoothTransformation)
    colours = (image.pixelColor(x, y) for y in range(side) for x in range(side))
    return [(each.redF(), each.greenF(), each.blueF()) for each in colours]


def _contrast(pixels: Sequence[Colour]) -> float:
    """Return the contrast of the light to the dark parts, 1 to 21, by the formula of WCAG 2.2."""
    hex_colours = ("#" + "".join(f"{round(part * 255):02X}" for part in colour) for colour in pixels)
    light = sorted(luminance(colour) for colour in hex_colours)
    return round((light[len(light) * 95 // 100] + 0.05) / (light[len(light) * 5 // 100] + 0.05), 2)


def _signature(card: QImage) -> str:
    return bytes(round(part * 255) for colour in _pixels(card, _GRID) for part in colour).hex()


def distances(one: CardDrawing, other: CardDrawing) -> tuple[float, float]:
    """Return how far two drawn cards are from each other in colour and in grey, each 0 to 1."""
    a, b = bytes.fromhex(one.signature), bytes.fromhex(other.signature)
    colours = _mean([abs(x - y) for x, y in zip(a, b, strict=True)]) / 255
    greys = _mean([abs(_grey(a, at) - _grey(b, at)) for at in range(0, len(a), 3)]) / 255
    return colours, greys


def _mean(values: Sequence[float]) -> float:
    # As fmean does it, whose module takes a moment to load at every start.
    return fsum(values) / len(values)


def _grey(colours: bytes, at: int) -> float:
    return sum(colours[at + part] * share for part, share in enumerate(_GREY))


def card_warnings(drawings: Iterable[CardDrawing]) -> Iterator[str]:
    """Yield a sentence for everything that makes cards hard to see or to tell apart."""
    good = [each for each in drawings if each.drawn is not None]
    for each in good:
        if each.file.suffix.lower() != ".svg" and min(each.width, each.height) < LEAST_SIDE:
            size, least = f"{each.width} x {each.height} pixels", f"{LEAST_SIDE} x {LEAST_SIDE}"
            yield f"the picture {each.file} has {size} and looks blurred; use one of at least {least}"
        if each.contrast < LOW_CONTRAST:
            yield (
                f"the picture {each.file} is pale: the contrast of its light to its dark parts is "
                f"{each.contrast:.1f}:1, and should be {LOW_CONTRAST}:1 or more"
            )
    alike = list(_groups(good, 0, ALIKE))
    for group in alike:
        yield f"the pictures {_listed(group)} look alike; a visitor may take them for a pair"
    firsts = [each for each in good if not any(each in group[1:] for group in alike)]
    for group in _groups(firsts, 1, ALIKE_IN_GREY):
        yield f"the pictures {_listed(group)} differ by colour alone, which some people do not see"


def _groups(drawings: Sequence[CardDrawing], which: int, limit: float) -> Iterator[list[CardDrawing]]:
    """Return the pictures that are closer to each other than the limit, in colour (0) or in grey (1)."""
    groups: list[list[CardDrawing]] = []
    for each in drawings:
        near = next((group for group in groups if distances(group[0], each)[which] < limit), None)
        if near is None:
            groups.append([each])
        else:
            near.append(each)
    return (group for group in groups if len(group) > 1)


def _listed(group: Sequence[CardDrawing]) -> str:
    return f"{', '.join(str(each.file) for each in group[:-1])} and {group[-1].file}"


# For the screens


class CardPictures:
    """The addresses of the cards' pictures, by deck; the study's own are drawn when this is made."""

    def __init__(self, settings: Settings, folder: Path | None = None) -> None:
        """Draw the cards of the decks that these settings name; ``folder`` is for the drawings."""
        self._settings = settings
        self._folder = cache_folder() if folder is None else folder
        decks = dict.fromkeys((settings.game.deck, settings.practice.deck))
        self._decks = {deck: self._find(deck) for deck in decks}

    def address(self, deck: str, card: str) -> str:
        """Return the address of a card's picture; a card without one has a picture of its name."""
        if deck not in self._decks:
            self._decks[deck] = self._find(deck)
        return QUrl.fromLocalFile(str(self._decks[deck].get(card) or self._named(card))).toString()

    def deck(self, deck: str) -> list[str]:
        """Return the addresses of all cards of a deck, in alphabetical order."""
        return [self.address(deck, card) for card in pictures_in(self._settings.resolve_asset("cards", deck))]

    def _find(self, deck: str) -> dict[str, Path]:
        """Return the pictures of a deck that can be shown, by card; of an own deck these are drawings."""
        files = pictures_in(self._settings.resolve_asset("cards", deck))
        if self._settings.is_shipped("cards", deck):
            return files
        try:
            drawings = draw_cards(files.values(), self._folder)
        except CannotDraw as error:
            _log.warning("the cards of the deck %s cannot be drawn: %s", deck, error)
            return {}
        for card, file in files.items():
            if drawings[file].drawn is None:
                _log.warning("the card %s shows its name: %s cannot be drawn: %s", card, file, drawings[file].fault)
        return {card: drawn for card, file in files.items() if (drawn := drawings[file].drawn) is not None}

    def _named(self, card: str) -> Path:
        """Return a picture of a card's name, for want of another."""
        place = self._folder / f"name-{hashlib.sha256(card.encode()).hexdigest()[:32]}-{_VERSION}.png"
        if not place.is_file():
            try:
                self._folder.mkdir(parents=True, exist_ok=True)
            except OSError as error:
                _log.warning("%s cannot be made: %s", self._folder, error.strerror)
            framed(None, card).save(str(place))
        return place


# The preview sheet

_COLUMNS, _CELL, _LABEL = 4, 300, 96


def draw_sheet(drawings: Mapping[str, CardDrawing], names: Mapping[str, Sequence[str]]) -> QImage:
    """Return all cards of a deck on one sheet, in rows of four, each with its names below it."""
    rows = -(-len(drawings) // _COLUMNS)
    sheet = QImage(_COLUMNS * _CELL, max(rows, 1) * (_CELL + _LABEL), QImage.Format.Format_RGB32)
    sheet.fill(QColor("#FBF6EC"))
    painter = QPainter(sheet)
    painter.setRenderHints(QPainter.RenderHint.Antialiasing | QPainter.RenderHint.SmoothPixmapTransform)
    font = QFont("Noto Sans")
    font.setPixelSize(24)
    painter.setFont(font)
    painter.setPen(QColor(_INK))
    for at, (card, drawing) in enumerate(drawings.items()):
        x, y = at % _COLUMNS * _CELL, at // _COLUMNS * (_CELL + _LABEL)
        picture = framed(None, card) if drawing.drawn is None else QImage(str(drawing.drawn))
        painter.drawImage(QRect(x + 10, y + 10, _CELL - 20, _CELL - 20), picture)
        flags = Qt.AlignmentFlag.AlignHCenter | Qt.AlignmentFlag.AlignTop | Qt.TextFlag.TextWordWrap
        painter.drawText(QRect(x + 6, y + _CELL - 6, _CELL - 12, _LABEL), flags, ", ".join(names.get(card, ())) or card)
    painter.end()
    return sheet


def save_sheet(file: Path, drawings: Mapping[str, CardDrawing], names: Mapping[str, Sequence[str]]) -> None:
    """Write the sheet of a deck as a PNG file; raises UserInputError if it cannot be written."""
    if file.suffix.lower() != ".png":
        raise UserInputError(f"the sheet {file} must end in .png")
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
    there = QGuiApplication.instance() or QGuiApplication(["recollect"])
    for font in FONTS:
        QFontDatabase.addApplicationFont(str(ASSETS / "fonts" / font))
    data = QByteArray()
    buffer = QBuffer(data)
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    draw_sheet(drawings, names).save(buffer, "PNG")  # type: ignore[call-overload]  # its declaration says bytes
    write_file(file, bytes(data.data()))
    del there
