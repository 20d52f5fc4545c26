"""Letters that no font here can draw are found before a visitor sees empty boxes."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from fontTools.fontBuilder import FontBuilder
from fontTools.pens.ttGlyphPen import TTGlyphPen
from PySide6.QtGui import QGuiApplication

from kiosk import UserInputError, program
from kiosk.config import ASSETS, Settings
from kiosk.study.loader import read_study
from kiosk.ui.fonts import FAMILY, Missing, missing_characters, package_of, use_fonts

COMMAND = program("_display", "fonts")
FORM = """
id = "form"
version = "1"
note = "n"
[[items]]
id = "a"
kind = "page"
text.en = "{}"
"""


@pytest.fixture
def no_system_fonts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Leave nothing but the fonts that the program loads itself."""
    file = tmp_path / "fonts.conf"
    file.write_text('<?xml version="1.0"?><fontconfig></fontconfig>', "utf-8")
    monkeypatch.setenv("FONTCONFIG_FILE", str(file))


def found(folder: Path, text: str, look: str = "") -> list[Missing]:
    """Return what is missing for a study whose only special text is this."""
    (folder / "form.toml").write_text(FORM.format(text), "utf-8")
    (folder / "study.toml").write_text(
        f'languages = ["en"]\nquestionnaires = ["./form.toml"]\n[look]\n{look}\n', "utf-8"
    )
    return missing_characters(COMMAND, read_study(Settings.read(folder / "study.toml")))


def font(file: Path, characters: str, joined: str = "") -> None:
    """Make a font of squares for these characters, and of another one for the sequence ``joined``."""
    names = [".notdef", *(f"c{ord(each)}" for each in characters)]
    pen = TTGlyphPen(None)
    pen.moveTo((0, 0))
    for point in ((0, 500), (500, 500), (500, 0)):
        pen.lineTo(point)
    pen.closePath()
    glyph = pen.glyph()
    builder = FontBuilder(1000, isTTF=True)
    builder.setupGlyphOrder(names)
    builder.setupCharacterMap({ord(each): f"c{ord(each)}" for each in characters})
    builder.setupGlyf(dict.fromkeys(names, glyph))
    builder.setupHorizontalMetrics(dict.fromkeys(names, (600, 0)))
    builder.setupHorizontalHeader(ascent=800, descent=-200)
    builder.setupNameTable({"familyName": "Lab Squares", "styleName": "Regular"})
    builder.setupOS2(sTypoAscender=800, usWinAscent=800, usWinDescent=200)
    builder.setupPost()
    if joined:
        pieces = " ".join(f"c{ord(each)}" for each in joined)
        builder.addOpenTypeFeatures(f"feature ccmp {{ sub {pieces} by c{ord(joined[0])}; }} ccmp;")
    builder.save(str(file))


@pytest.mark.usefixtures("no_system_fonts")
def test_letters_without_a_font_are_named_with_the_package_that_has_them(tmp_path: Path) -> None:
    (missing,) = found(tmp_path, "hi 한국 สวัสดี 👨‍👩‍👧")
    assert missing.language == "en"
    assert set(missing.characters) >= {"한", "국", "ส", "👨"}
    assert missing.where == "form, item a"
    assert {"fonts-noto-cjk", "fonts-noto-core", "fonts-noto-color-emoji"} <= set(missing.package.split())


@pytest.mark.usefixtures("no_system_fonts")
def test_a_font_of_the_study_brings_the_letters(tmp_path: Path) -> None:
    font(tmp_path / "lab.ttf", "한국")
    assert found(tmp_path, "한국", 'fonts = ["./lab.ttf"]') == []


@pytest.mark.usefixtures("no_system_fonts")
def test_a_joined_emoji_that_falls_into_its_parts_is_named(tmp_path: Path) -> None:
    family = "\N{MAN}\N{ZERO WIDTH JOINER}\N{WOMAN}"
    look = 'fonts = ["./lab.ttf"]'
    font(tmp_path / "lab.ttf", family)
    (missing,) = found(tmp_path, f"We are a family {family}.", look)
    assert missing.characters == (family,)
    assert "parts" in str(missing)
    assert missing.package == "fonts-noto-color-emoji"
    assert found(tmp_path, "\N{MAN} and \N{WOMAN}", look) == []
    font(tmp_path / "lab.ttf", family, joined=family)
    assert found(tmp_path, f"We are a family {family}.", look) == []


@pytest.mark.usefixtures("no_system_fonts")
def test_the_shipped_texts_need_no_other_font() -> None:
    assert missing_characters(COMMAND, read_study(Settings())) == []


def test_qt_keeps_the_letters_that_it_has_drawn_when_a_further_window_is_opened(qapp: QGuiApplication) -> None:
    use_fonts()
    forgotten: list[None] = []
    listening = qapp.fontDatabaseChanged.connect(lambda: forgotten.append(None))
    use_fonts()
    qapp.fontDatabaseChanged.disconnect(listening)
    assert forgotten == []
    assert QGuiApplication.font().family() == FAMILY


def test_a_font_that_is_not_there_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UserInputError, match=r"look\.fonts: there is no font .*lab\.ttf"):
        found(tmp_path, "x", 'fonts = ["./lab.ttf"]')
    shutil.copy(ASSETS / "icon.svg", tmp_path / "lab.svg")
    with pytest.raises(UserInputError, match=r"look\.fonts"):
        found(tmp_path, "x", 'fonts = ["./lab.svg"]')


@pytest.mark.parametrize(
    ("character", "package"),
    [
        *(("한", "fonts-noto-cjk"), ("漢", "fonts-noto-cjk"), ("ア", "fonts-noto-cjk")),
        *(("ह", "fonts-noto-core"), ("ก", "fonts-noto-core"), ("ع", "fonts-noto-core")),
        ("🙂", "fonts-noto-color-emoji"),
    ],
)
def test_a_character_has_a_package(character: str, package: str) -> None:
    assert package_of(character) == package
