"""The rows of the keys on the screen, for every language."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Sequence
from functools import cache

from kiosk.config import ASSETS
from kiosk.lazy_dataclass import dataclass

DIGITS = "1234567890"
SIGNS = ("@#&%+=/\\|~^", "()[]{}<>", ".,;:!?¿¡…'\"", "“”„«»-_·*", "€£$¥§°¢")
LATIN = ("qwertyuiop", "asdfghjkl", "zxcvbnm")
ACCENTS = ("àáâãäåāăąæ", "çćčďđðèéêëēęě", "ğìíîïīįıłľñńň", "òóôõöøőœřŕśšşșß", "ťţțùúûüūůűųýÿžźżþ")


@dataclass(frozen=True)
class KeyRows:
    """Three layers of keys: the language's letters, the letters of others, and signs."""

    letters: tuple[str, ...]
    accents: tuple[str, ...]
    signs: tuple[str, ...] = SIGNS

    def missing(self, texts: Iterable[str]) -> tuple[str, ...]:
        """Return the letters of these texts that no key types, in small letters, in their order."""
        keys = set("".join((*self.letters, *self.accents, *self.signs)))
        used = {letter for text in texts for letter in text.lower() if letter.isalpha()}
        return tuple(sorted(used - keys))


def key_rows(language: str, own: Sequence[str] = ()) -> KeyRows:
    """Return the keys of a language; ``own`` rows, if it brings any, take the place of the shipped ones."""
    shipped = _shipped()
    rows = tuple(own) or shipped.get(language) or shipped.get(language.partition("-")[0]) or shipped["en"]
    latin = any(letter in "abcdefghijklmnopqrstuvwxyz" for row in rows for letter in row)
    return KeyRows((DIGITS, *rows), ACCENTS if latin else (*LATIN, *ACCENTS[:3]))


def capital(letter: str, language: str) -> str:
    """Return a letter as the key types it in capitals.

    One that has no capital of its own stays as it is.
    """
    if language == "tr" and letter == "i":
        return "İ"
    upper = letter.upper()
    return upper if len(upper) == 1 else letter


@cache
def _shipped() -> dict[str, tuple[str, ...]]:
    read = tomllib.loads((ASSETS / "keyboards.toml").read_text("utf-8"))
    return {language: tuple(rows) for language, rows in read.items()}
