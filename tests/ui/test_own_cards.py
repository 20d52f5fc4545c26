"""A study's own pictures become cards: turned, cropped and framed as the shipped ones, and shown on the board."""

from __future__ import annotations

import struct
from pathlib import Path

import pytest
from PySide6.QtCore import QRect, QUrl
from PySide6.QtGui import QColor, QImage, QPainter

from kiosk.config import ASSETS, Settings
from kiosk.ui.cards import (
    MOST_MEGAPIXELS,
    SIDE,
    CardDrawing,
    CardPictures,
    card_warnings,
    draw_card,
    draw_cards,
    draw_sheet,
)
from tests.study.test_decks import SVG

ANIMALS = ASSETS / "cards" / "animals"


def picture(width: int, height: int, *parts: tuple[str, int, int, int, int], background: str = "#204060") -> QImage:
    """Return a picture with coloured rectangles on it."""
    image = QImage(width, height, QImage.Format.Format_RGB32)
    image.fill(QColor(background))
    painter = QPainter(image)
    for colour, *place in parts:
        painter.fillRect(QRect(*place), QColor(colour))
    painter.end()
    return image


def turned(jpeg: Path, orientation: int) -> None:
    """Write into a photo how the telephone was held."""
    tiff = b"MM\0*\0\0\0\x08\0\x01" + struct.pack(">HHIHH", 0x0112, 3, 1, orientation, 0) + b"\0\0\0\0"
    exif = b"Exif\0\0" + tiff
    content = jpeg.read_bytes()
    jpeg.write_bytes(content[:2] + b"\xff\xe1" + struct.pack(">H", len(exif) + 2) + exif + content[2:])


def drawn(file: Path) -> CardDrawing:
    """Draw one picture in this process, as the process does that draws them all."""
    import json  # noqa: PLC0415

    told = json.loads(draw_card(json.dumps([str(file), str(file.with_name(f"{file.stem}-drawn.png"))])))
    return CardDrawing(**told | {"file": file, "drawn": told["drawn"] and Path(told["drawn"])})


@pytest.fixture(autouse=True)
def _application(qapp: object) -> object:
    """Draw with Qt."""
    return qapp


def colour(card: QImage, across: float, down: float) -> str:
    """Return the colour at a place of a card."""
    return card.pixelColor(round(across * (SIDE - 1)), round(down * (SIDE - 1))).name()


def test_a_photo_is_turned_upright_and_cropped_from_its_middle(tmp_path: Path) -> None:
    photo = tmp_path / "photo.jpg"
    # Held upright, the telephone writes what is at the top on the left.
    assert picture(400, 300, ("#ff0000", 0, 0, 150, 300)).save(str(photo), quality=95)
    turned(photo, 6)
    drawing = drawn(photo)
    assert drawing.drawn is not None
    card = QImage(str(drawing.drawn))
    assert (card.width(), card.height()) == (SIDE, SIDE)
    assert card.pixelColor(SIDE // 2, SIDE // 5).red() > 200
    assert card.pixelColor(SIDE // 2, SIDE * 4 // 5).red() < 80
    assert card.pixelColor(SIDE // 5, SIDE * 4 // 5).red() < 80


def test_own_pictures_stand_in_the_frame_of_the_shipped_ones(tmp_path: Path) -> None:
    picture(300, 300).save(str(tmp_path / "a.png"))
    own, shipped = QImage(str(drawn(tmp_path / "a.png").drawn)), QImage(str(ANIMALS / "owl.svg"))
    shipped = shipped.scaled(SIDE, SIDE)
    for place in ((0, 0), (0.01, 0.5), (0.03, 0.03), (0.97, 0.97)):
        assert own.pixelColor(*(round(each * (SIDE - 1)) for each in place)).alpha() == 0, place
        assert shipped.pixelColor(*(round(each * (SIDE - 1)) for each in place)).alpha() < 40, place
    assert colour(own, 0.0255, 0.5) == "#e4d9c3"
    assert colour(own, 0.5, 0.5) == "#204060"


def test_a_picture_without_background_is_shown_whole(tmp_path: Path) -> None:
    image = QImage(600, 200, QImage.Format.Format_ARGB32)
    image.fill(0)
    painter = QPainter(image)
    painter.fillRect(50, 50, 500, 100, QColor("#aa0000"))
    painter.end()
    image.save(str(tmp_path / "a.png"))
    card = QImage(str(drawn(tmp_path / "a.png").drawn))
    assert colour(card, 0.2, 0.5) == colour(card, 0.8, 0.5) == "#aa0000"
    assert colour(card, 0.5, 0.2) == "#fffbf2"


def test_a_shipped_card_looks_the_same_when_it_is_a_study_s_own(tmp_path: Path) -> None:
    (tmp_path / "owl.svg").write_bytes((ANIMALS / "owl.svg").read_bytes())
    own, shipped = QImage(str(drawn(tmp_path / "owl.svg").drawn)), QImage(SIDE, SIDE, QImage.Format.Format_ARGB32)
    shipped.fill(0)
    painter = QPainter(shipped)
    painter.drawImage(shipped.rect(), QImage(str(ANIMALS / "owl.svg")).scaled(SIDE, SIDE))
    painter.end()
    places = [(x / 20, y / 20) for x in range(3, 18) for y in range(3, 18)]
    far = [
        place for place in places if abs(QColor(colour(own, *place)).red() - QColor(colour(shipped, *place)).red()) > 60
    ]
    assert len(far) < 12


@pytest.mark.parametrize(
    ("name", "content", "why"),
    [
        ("a.png", b"\x89PNG\r\n\x1a\nbroken", ""),
        ("b.webp", b"RIFF\x10\0\0\0WEBPbroken", ""),
        ("c.svg", b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"/>', "it shows nothing"),
    ],
)
def test_a_picture_that_cannot_be_drawn_has_a_fault(name: str, content: bytes, why: str, tmp_path: Path) -> None:
    (tmp_path / name).write_bytes(content)
    drawing = drawn(tmp_path / name)
    assert drawing.fault
    assert why in drawing.fault
    assert drawing.drawn is None


def test_a_picture_of_too_many_pixels_is_refused_unread(tmp_path: Path) -> None:
    import zlib  # noqa: PLC0415

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = chunk(b"IHDR", struct.pack(">IIBBBBB", 8000, 5000, 8, 2, 0, 0, 0))
    (tmp_path / "large.png").write_bytes(b"\x89PNG\r\n\x1a\n" + head + chunk(b"IDAT", b"") + chunk(b"IEND", b""))
    said = drawn(tmp_path / "large.png").fault
    assert said == f"it has 40 megapixels, and must have at most {MOST_MEGAPIXELS}; save it smaller"


def test_what_is_small_pale_or_alike_is_cautioned(tmp_path: Path) -> None:
    tile = ("#f0d060", 40, 60, 200, 140)
    picture(300, 300, tile).save(str(tmp_path / "sun.png"))
    picture(300, 300, ("#ecd064", 44, 62, 200, 140)).save(str(tmp_path / "sun2.png"))
    picture(100, 90, ("#ffffff", 0, 0, 60, 60)).save(str(tmp_path / "small.png"))
    picture(300, 300, ("#e8e8e8", 0, 0, 150, 300), background="#f4f4f4").save(str(tmp_path / "pale.png"))
    picture(300, 300, ("#00a000", 150, 0, 150, 300), background="#b00000").save(str(tmp_path / "green.png"))
    picture(300, 300, ("#b00000", 150, 0, 150, 300), background="#00a000").save(str(tmp_path / "red.png"))
    files = {file.stem: drawn(file) for file in sorted(tmp_path.glob("*.png"))}
    said = list(card_warnings(files.values()))
    assert any("small.png has 100 x 90 pixels and looks blurred" in each for each in said)
    assert any("pale.png is pale: the contrast" in each for each in said)
    assert any("sun.png" in each and "sun2.png look alike" in each for each in said)
    assert len([each for each in said if "look alike" in each]) == 1
    shipped = [drawn(file) for file in _copies(ANIMALS, tmp_path)]
    assert list(card_warnings(shipped)) == []


def _copies(folder: Path, to: Path) -> list[Path]:
    for file in folder.glob("*.svg"):
        (to / file.name).write_bytes(file.read_bytes())
    return sorted(to.glob("*.svg"))


def test_pictures_that_differ_by_colour_alone_are_cautioned(tmp_path: Path) -> None:
    for name, mark in (("red", "#c23b22"), ("green", "#2e7d1e")):
        picture(300, 300, (mark, 60, 60, 180, 180), background="#f5f0e0").save(str(tmp_path / f"{name}.png"))
    (said,) = card_warnings([drawn(tmp_path / "red.png"), drawn(tmp_path / "green.png")])
    assert "differ by colour alone" in said


def test_they_are_drawn_once_in_a_process_and_shown_on_the_board(tmp_path: Path) -> None:
    deck = tmp_path / "toys"
    deck.mkdir()
    picture(300, 300, ("#ffffff", 0, 0, 60, 60)).save(str(deck / "photo.png"))
    (deck / "broken.svg").write_text("<svg/>", "utf-8")
    (deck / "round.svg").write_text(SVG.format(""), "utf-8")
    (tmp_path / "study.toml").write_text('[game]\ndeck = "./toys"\n', "utf-8")
    settings, cache = Settings.read(tmp_path / "study.toml"), tmp_path / "cache"
    shown = CardPictures(settings, cache)
    files = [Path(QUrl(address).toLocalFile()) for address in shown.deck("./toys")]
    assert [file.parent for file in files] == [cache] * 3
    assert all(not QImage(str(file)).isNull() for file in files)
    assert files[0].name.startswith("name-")
    assert Path(QUrl(shown.address("./toys", "gone")).toLocalFile()).is_file()
    assert Path(QUrl(shown.address("animals", "owl")).toLocalFile()) == ANIMALS / "owl.svg"
    # What is drawn is not drawn again: no process is started that could.
    again = draw_cards([deck / "photo.png", deck / "round.svg"], cache, ("no such command",))
    assert all(each.drawn for each in again.values())
    sheet = draw_sheet({each.file.stem: each for each in again.values()}, {"photo": ("the photo", "la foto")})
    assert (sheet.width(), sheet.height()) == (1200, 396)
