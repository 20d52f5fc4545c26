"""What other programs make of names and labels: which two are one for them, and which become numbers or dates.

File systems, SPSS and SQL do not tell capitals apart. Spreadsheets, pandas and R take texts for numbers, dates, truths,
missing values or formulas, each by rules of its own; what any of them misreads is misread here.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Iterator
from typing import Final

_RESERVED = re.compile(r"(con|prn|aux|nul|com\d|lpt\d)(\..*)?", re.DOTALL)
"""What Windows keeps for devices, with or without an ending."""

FORMULA: Final = "a formula"
NUMBER: Final = "a number or a date"
TRUTH: Final = "true or false"
MISSING: Final = "a missing value"

_FORMULA_SIGNS = frozenset("=+-@")
_MINUS = "\N{MINUS SIGN}"
_QUOTE = '"'
_PLAINER = str.maketrans({_MINUS: "-", "\N{RIGHT SINGLE QUOTATION MARK}": "'"})

_TRUTHS = frozenset(
    word
    for local in ("true", "false", "wahr", "falsch", "vrai", "faux", "vero", "falso", "verdadero", "verdadeiro")
    for word in (local, local.upper(), local.capitalize())
) | {"T", "F"}
"""pandas reads those of English in three spellings, R also their initials, a spreadsheet those of its own language."""

_MISSINGS = frozenset(
    ("NA", "N/A", "n/a", "NaN", "nan", "NULL", "null", "None", "<NA>", "#NA", "#N/A", "#N/A N/A", "1.#IND", "1.#QNAN")
)
"""pandas' own list, which contains those of R and of BIDS."""

_WITHOUT_LETTERS = re.compile(r"(?=\D*\d)[\s\d.,:;/'_%()$€£¥+\-年月日時分秒]+")
"""Numbers, money, shares, dates and times in the spellings of all countries; some are none, which does no harm."""

_EXPONENT = re.compile(r"(\d+[.,]?\d*|[.,]\d+)[ED][+\-]?\d+|0X[\dA-F.]+(P[+\-]?\d+)?", re.IGNORECASE)
_ENDLESS = re.compile(r"inf|infinity", re.IGNORECASE)
_PLAIN = re.compile(r"0|[1-9][0-9]{0,14}")
"""A whole number that comes out of every program as it went in; one of more digits is rounded by spreadsheets."""

_WORD = re.compile(r"[^\W\d_]+")
_HALF_OF_THE_DAY = re.compile(r"\d{1,2}(:\d{1,2}){0,2}(\s+[AP]M?|[AP]M)", re.IGNORECASE)
_VERSION = re.compile(r"(?=(.*\.)?0(\..*)?$)\d{1,2}(\.\d{1,2}){2,}")
"""Three numbers or more, one of them 0, are no date: no day and no month is 0. They are versions, as of programs."""

_SHORTEST_MONTH = 3
_MONTHS = tuple(
    """
    january february march april may june july august september october november december
    januar februar marz maerz mai juni juli oktober dezember
    gennaio febbraio marzo aprile maggio giugno luglio agosto settembre ottobre novembre dicembre
    enero abril mayo junio julio septiembre setiembre octubre noviembre diciembre
    janvier fevrier mars avril juin juillet aout septembre octobre decembre
    janeiro fevereiro marco maio junho julho setembro outubro dezembro
    januari februari maart mei augustus
    """.split()  # noqa: SIM905 - a list of seven languages is read more easily in lines
)
"""The months as spreadsheets of several languages read them, without accents; three letters are enough for each."""


def fold_name(name: str) -> str:
    """Return what other programs tell a name by.

    Capitals, the encoding of accents, ``-`` or ``_`` and a last dot do not count.
    """
    folded = unicodedata.normalize("NFC", unicodedata.normalize("NFKC", name).casefold())
    return folded.replace("-", "_").rstrip(". ")


def is_reserved(name: str) -> bool:
    """Return whether Windows gives a file of this name to a device."""
    return bool(_RESERVED.fullmatch(fold_name(name)))


def alike(names: Iterable[str]) -> Iterator[tuple[str, str]]:
    """Find names that are written in two ways but are one for other programs.

    Each comes with the first of its kind.
    """
    first: dict[str, str] = {}
    for name in names:
        other = first.setdefault(fold_name(name), name)
        if other != name:
            yield other, name


def read_as(text: str) -> str | None:
    """Return what a spreadsheet, pandas or R mistakes a text for; None if it stays that text.

    Plain whole numbers stay what they are, for they come out as they went in; a label that must be no number at all
    needs a letter besides.
    """
    if _begins_a_formula(text):
        return FORMULA
    plain = unicodedata.normalize("NFKC", text).translate(_PLAINER).strip()
    if plain in _MISSINGS or (text and not plain):
        return MISSING
    if plain in _TRUTHS:
        return TRUTH
    if _PLAIN.fullmatch(text) or _VERSION.fullmatch(text):
        return None
    numbers = (_WITHOUT_LETTERS, _EXPONENT, _ENDLESS, _HALF_OF_THE_DAY)
    return NUMBER if any(kind.fullmatch(plain) for kind in numbers) or _names_a_month(plain) else None


def _begins_a_formula(text: str) -> bool:
    """Whether a cell begins as formulas do, also in full-width signs, or behind what programs drop at its beginning."""
    for character in text:
        # A tab or a line's end makes some programs begin a new cell; others take a quote and all that is blank away.
        if character in "\t\r\n":
            return True
        if unicodedata.category(character)[0] not in "CZ" and character != _QUOTE:
            return character == _MINUS or unicodedata.normalize("NFKC", character)[:1] in _FORMULA_SIGNS
    return False


def _names_a_month(text: str) -> bool:
    """Whether a text is digits and the name of a month, and nothing else."""
    words = _WORD.findall(text)
    if len(words) != 1 or not _WITHOUT_LETTERS.fullmatch(text.replace(words[0], " ")):
        return False
    decomposed = unicodedata.normalize("NFD", words[0].casefold())
    word = "".join(letter for letter in decomposed if not unicodedata.combining(letter))
    return len(word) >= _SHORTEST_MONTH and any(month.startswith(word) for month in _MONTHS)
