"""Load fonts, find characters that no font here can draw, and name the package that has them."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import unicodedata
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import IO, TYPE_CHECKING

from kiosk.config import ASSETS
from kiosk.experiment.session_config import StudyConfig
from kiosk.lazy_dataclass import dataclass

if TYPE_CHECKING:
    from PySide6.QtGui import QTextLayout

# Qt is loaded where it is needed: commands that only ask another process do not pay for it.
# ruff: noqa: PLC0415

SHIPPED_FONTS = ("NotoSans-Regular.ttf", "NotoSans-Bold.ttf")
FAMILY = "Noto Sans"

_SHIPPED_LETTERS = 0x0530
"""The shipped font has all letters before this: Latin, Greek and Cyrillic."""
_SHIPPED_RANGES = ((0x1E00, 0x1FFF), (0x2000, 0x206F), (0x20A0, 0x20BF), (0x2212, 0x2212))

_PACKAGES = {
    "fonts-noto-cjk": ("CJK", "HANGUL", "HIRAGANA", "KATAKANA", "BOPOMOFO", "IDEOGRAPHIC", "FULLWIDTH", "HALFWIDTH"),
    "fonts-noto-core": (
        *("ARABIC", "HEBREW", "DEVANAGARI", "THAI", "BENGALI", "GURMUKHI", "GUJARATI", "ORIYA", "TAMIL", "TELUGU"),
        *("KANNADA", "MALAYALAM", "SINHALA", "LAO", "TIBETAN", "MYANMAR", "GEORGIAN", "ARMENIAN", "ETHIOPIC"),
        *("KHMER", "MONGOLIAN", "SYRIAC", "THAANA", "CHEROKEE", "LATIN", "GREEK", "CYRILLIC", "EXTENDED", "VEDIC"),
    ),
}
"""Debian's packages of fonts, by the first words of the names of their characters."""
_EMOJI_FROM = 0x1F000
_EMOJI = "fonts-noto-color-emoji"
_REST = "fonts-noto-core, fonts-noto-extra or fonts-unifont"

_UNDRAWN_CATEGORIES = frozenset(("Cc", "Cf", "Zl", "Zp", "Zs"))
"""Characters that are never seen."""

_HAS_FONTS = "hasShippedFonts"
"""The property of an application whose shipped fonts are loaded."""

WITHIN_S = 60


def use_fonts(own: Sequence[Path] = ()) -> None:
    """Load the shipped fonts and a study's own, and write everything in them; other letters are the system's.

    For a further window the shipped ones are not loaded again: Qt would forget every letter that it has drawn.
    """
    from PySide6.QtGui import QFont, QFontDatabase, QGuiApplication

    application = QGuiApplication.instance()
    if application is None or not application.property(_HAS_FONTS):
        for name in SHIPPED_FONTS:
            QFontDatabase.addApplicationFont(str(ASSETS / "fonts" / name))
        if application is not None:
            application.setProperty(_HAS_FONTS, True)  # noqa: FBT003 - Qt's own
    families = [FAMILY]
    for file in own:
        families += QFontDatabase.applicationFontFamilies(QFontDatabase.addApplicationFont(str(file.absolute())))
    font = QFont()
    font.setFamilies(list(dict.fromkeys(families)))
    if font.families() != QGuiApplication.font().families():
        QGuiApplication.setFont(font)


@dataclass(frozen=True)
class Missing:
    """Hold what no font here can draw of a language, and one place where it stands."""

    language: str
    characters: tuple[str, ...]
    where: str
    in_parts: bool = False
    """Whether they are emoji of several characters, each of which can be drawn, but not as one picture."""

    @property
    def package(self) -> str:
        """The Debian packages that have them."""
        return " ".join(dict.fromkeys(map(package_of, self.characters)))

    def __str__(self) -> str:
        """Return what is wrong, in a sentence."""
        shown = " ".join(self.characters[:_SHOWN]) + (" ..." if len(self.characters) > _SHOWN else "")
        if self.in_parts:
            fault = f"the parts of joined emoji would stand side by side: {shown}"
            return f"in {self.language!r}, {fault} (as in {self.where})"
        count = "1 character has" if len(self.characters) == 1 else f"{len(self.characters)} characters have"
        return f"in {self.language!r}, {count} no font here and would be empty boxes: {shown} (as in {self.where})"

    @property
    def remedy(self) -> str:
        """What to do about it."""
        other = "write others" if self.in_parts else "name a font that has them in look.fonts"
        return f"install {self.package}, or {other}"


_SHOWN = 12


def package_of(character: str) -> str:
    """Return the Debian package whose fonts have a character or a joined emoji."""
    if len(character) > 1 or (ord(character) >= _EMOJI_FROM and unicodedata.category(character) in {"So", "Sk", "Cn"}):
        return _EMOJI
    names = unicodedata.name(character, "").replace("-", " ").split()
    first = names[0] if names else ""
    return next((package for package, scripts in _PACKAGES.items() if first in scripts), _REST)


def texts_of(study: StudyConfig) -> Iterator[tuple[str, str, str]]:
    """Yield every text that visitors can see, with its language and where it stands."""
    for plan in study.plans:
        language = plan.language
        for name, written in plan.catalogue.written.items():
            yield language, f"the message {name}", written.text
        sheet = plan.information
        for key in ("about", "consent", "debrief"):
            yield (
                language,
                f"the information sheet, {key}",
                json.dumps(getattr(sheet, key).model_dump(mode="json"), ensure_ascii=False),
            )
        for asked in (plan.about_you, *plan.questionnaires):
            yield language, f"{asked.id}, title", (asked.title or {}).get(language, "")
            for item in asked.items:
                for words in item.texts():
                    yield language, f"{asked.id}, item {item.id}", words.get(language, "")
        look = study.settings.look
        yield language, "look.name", f"{look.name} {study.settings.assistance.name} {study.settings.consent.contact}"


def _is_shipped(character: str) -> bool:
    code = ord(character)
    return code < _SHIPPED_LETTERS or any(first <= code <= last for first, last in _SHIPPED_RANGES)


def missing_characters(command: Sequence[str], study: StudyConfig) -> list[Missing]:
    """Return what no font here can draw, language by language; ``command`` starts the process that tries.

    Raises OSError or ValueError if the process does not answer.
    """
    texts = [each for each in texts_of(study) if not all(map(_is_shipped, each[2]))]
    if not texts:
        return []
    asked = {
        "fonts": [str(file.absolute()) for file in study.settings.own_fonts],
        "texts": [text for *_, text in texts],
    }
    done = subprocess.run(  # noqa: S603 - our own program
        command, input=json.dumps(asked), capture_output=True, encoding="utf-8", timeout=WITHIN_S, check=False
    )
    if done.returncode:
        raise OSError(done.stderr.strip().splitlines()[-1] if done.stderr.strip() else "it ended without a word")
    return list(_by_language(texts, json.loads(done.stdout)))


def _by_language(texts: Sequence[tuple[str, str, str]], found: Sequence[Sequence[str]]) -> Iterator[Missing]:
    characters: dict[tuple[str, bool], dict[str, str]] = {}
    for (language, where, _), missing in zip(texts, found, strict=True):
        for character in missing:
            characters.setdefault((language, len(character) > 1), {}).setdefault(character, where)
    for (language, in_parts), there in characters.items():
        yield Missing(language, tuple(there), next(iter(there.values())), in_parts)


def try_fonts(asked: IO[str], answer: IO[str]) -> None:
    """Answer which characters and joined emoji of each text cannot be drawn, in a process of its own."""
    from PySide6.QtGui import QGuiApplication

    if sys.platform == "linux":
        # It finds the same fonts as a window's, and needs no display.
        os.environ["QT_QPA_PLATFORM"] = "offscreen"
    told = json.loads(asked.read())
    application = QGuiApplication.instance() or QGuiApplication(["recollect"])
    use_fonts([Path(name) for name in told["fonts"]])
    known: dict[str, bool] = {}
    json.dump([list(_undrawn(text, known)) for text in told["texts"]], answer)
    del application


_EMOJI_PART = "[\u203c-\u3299\U0001f000-\U0001faff]\ufe0f?[\U0001f3fb-\U0001f3ff]?"
_JOINED_EMOJI = re.compile(
    rf"{_EMOJI_PART}(?:\u200d{_EMOJI_PART})+"  # families and professions
    "|[\u203c-\u3299\U0001f000-\U0001faff][\U0001f3fb-\U0001f3ff]"  # colours of skin
    "|[\U0001f1e6-\U0001f1ff]{2}"  # flags of countries
    "|\U0001f3f4[\U000e0020-\U000e007e]+\U000e007f"  # flags of regions
)
"""What Unicode's list of emoji sequences is made of (UTS #51, section 1.4)."""
_ONE_PICTURE = 1.5
"""A joined emoji is at most so many times as wide as its first character alone."""


def _undrawn(text: str, known: dict[str, bool]) -> Iterator[str]:
    """Yield, each once, the characters without a glyph and the joined emoji that are drawn in parts."""
    for character in dict.fromkeys(text):
        if unicodedata.category(character) in _UNDRAWN_CATEGORIES or _is_mark(character):
            continue
        if character not in known:
            known[character] = _has_glyph(character)
        if not known[character]:
            yield character
    for joined in dict.fromkeys(_JOINED_EMOJI.findall(text)):
        if joined not in known:
            known[joined] = not all(known.get(each, True) for each in joined) or _is_one_picture(joined)
        if not known[joined]:
            yield joined


def _is_mark(character: str) -> bool:
    """Whether it only changes another character, such as a variation selector."""
    return "VARIATION SELECTOR" in unicodedata.name(character, "")


def _has_glyph(character: str) -> bool:
    runs = _laid_out(character).glyphRuns()
    return bool(runs) and all(all(run.glyphIndexes()) for run in runs)


def _is_one_picture(joined: str) -> bool:
    # Some fonts draw one picture of several glyphs on top of each other, so the width tells.
    alone, together = (_laid_out(text).boundingRect().width() for text in (joined[0], joined))
    return together < _ONE_PICTURE * alone


def _laid_out(text: str) -> QTextLayout:
    from PySide6.QtGui import QTextLayout

    layout = QTextLayout(text)
    layout.beginLayout()
    layout.createLine()
    layout.endLayout()
    return layout
