"""The cards of a deck: the pictures in its folder, and the table that names them in every language."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path

from kiosk import UserInputError
from kiosk.assistance.wording import CARD, Catalogue, card_message
from kiosk.config import PICTURES, Game, Practice, Settings, code_of, files_in, pictures_in, read_text
from kiosk.files import open_to_read
from kiosk.language_codes import is_right
from kiosk.lazy_dataclass import dataclass

_OTHER_PICTURES = frozenset((".svgz", ".gif", ".bmp", ".tif", ".tiff", ".heic", ".heif", ".avif", ".psd", ".ico"))
"""The endings of pictures that would be left out without a word."""

MOST_PICTURE_BYTES = 20 * 1024 * 1024
"""A photo from a telephone has 2 to 12 MB."""

MOST_PICTURES = 500
"""A board of 24 cards needs 12; each picture of a deck is read and drawn when the study is checked."""

MOST_DECK_BYTES = 250 * 1024 * 1024
"""What all pictures of a deck may have together."""

NAMES = "names.csv"
"""The table of names in the folder of a deck."""

_FORM = re.compile(r"[a-z][a-z0-9_-]*")
_KEYS = ("card", "file", "picture")
"""What the first column of the table may be called."""


def boards(settings: Settings) -> Iterator[tuple[str, Game | Practice]]:
    """Yield the boards that visitors see, by their section of the study file."""
    yield "game", settings.game
    if "practice" in settings.stages:
        yield "practice", settings.practice


def deck_faults(folder: Path) -> Iterator[str]:
    """Yield a sentence for every file of a deck that looks like a picture and cannot be one."""
    taken = pictures_in(folder)
    if len(taken) > MOST_PICTURES:
        yield f"the deck {folder} has {len(taken):,} pictures; keep the ones that you need, at most {MOST_PICTURES}"
        return
    total = sum(map(_size, taken.values()))
    if total > MOST_DECK_BYTES:
        yield f"the pictures in {folder} have {_mb(total):,} MB together; save them smaller, at most {_MOST_DECK_MB} MB"
    for file in files_in(folder):
        ending = file.suffix.lower()
        if ending in _OTHER_PICTURES:
            yield f"the picture {file} is no PNG, JPEG, WebP or SVG file; save it as one of these"
        elif ending in PICTURES:
            first = taken[file.stem]
            if first != file:
                yield f"the pictures {first.name} and {file.name} in {folder} are one card; rename one of them"
            yield from picture_faults(file)


def picture_faults(file: Path) -> Iterator[str]:
    """Yield what can be said against a picture without drawing it: its size, its first bytes, scripts in an SVG."""
    try:
        size = file.stat().st_size
        with open_to_read(file) as opened:
            begin = opened.read(_HEAD_BYTES)
    except OSError as error:
        yield f"the picture {file} cannot be read: {error.strerror}"
        return
    if not size:
        yield f"the picture {file} is empty"
    elif size > MOST_PICTURE_BYTES:
        yield f"the picture {file} has {size / 1024 / 1024:.0f} MB; save it smaller, at most {_MOST_MB} MB"
    elif file.suffix.lower() == ".svg":
        fault = _svg_fault(file)
        if fault:
            yield f"the picture {file} {fault}"
    else:
        kind = _kind(begin)
        named = _BY_ENDING[file.suffix.lower()]
        if kind != named:
            what = f"is a {kind} file; call it {file.stem}{_ENDINGS[kind]}" if kind else f"is no {named} file"
            yield f"the picture {file} {what}"


def _size(file: Path) -> int:
    try:
        return file.stat().st_size
    except OSError:
        # That it cannot be read is said elsewhere.
        return 0


def _mb(size: int) -> int:
    return size // 1024 // 1024


_HEAD_BYTES = 512
_MOST_MB = _mb(MOST_PICTURE_BYTES)
_MOST_DECK_MB = _mb(MOST_DECK_BYTES)
_ENDINGS = {"PNG": ".png", "JPEG": ".jpg", "WebP": ".webp", "SVG": ".svg"}
_BY_ENDING = {".png": "PNG", ".jpg": "JPEG", ".jpeg": "JPEG", ".webp": "WebP"}


def _kind(begin: bytes) -> str | None:
    """Tell the format of a picture by its first bytes."""
    if begin.startswith(b"\x89PNG\r\n\x1a\n"):
        return "PNG"
    if begin.startswith(b"\xff\xd8\xff"):
        return "JPEG"
    if begin.startswith(b"RIFF") and begin[8:12] == b"WEBP":
        return "WebP"
    return "SVG" if b"<svg" in begin else None


class _Refused(Exception):
    """What an SVG file has that no picture of a card may have."""


_FOREIGN = frozenset(("script", "foreignobject", "iframe", "audio", "video", "animate", "set", "animatetransform"))
"""Elements that do something, or that would show nothing on a card."""

_MOST_DEEP = 200


def _svg_fault(file: Path) -> str | None:
    """Say why an SVG file is not to be drawn; None if it may be."""
    try:
        return _SvgReader().fault(read_text("it", file))
    except UserInputError as error:
        return f"cannot be used: {error}"


class _SvgReader:
    """Reads an SVG file element by element, and stops at the first thing that no card may have."""

    def __init__(self) -> None:
        self._depth = 0
        from xml.parsers import expat  # noqa: PLC0415 - for a study's own cards

        self._parser = expat.ParserCreate()
        self._parser.EntityDeclHandler = self._entity
        self._parser.StartElementHandler = self._begin
        self._parser.EndElementHandler = self._end
        self._parser.ProcessingInstructionHandler = self._instruction
        self._parser.CharacterDataHandler = self._text

    def fault(self, text: str) -> str | None:
        """Return what is wrong with a file of this text, with its line; None if nothing is."""
        from xml.parsers import expat  # noqa: PLC0415 - as above

        try:
            self._parser.Parse(text, True)  # noqa: FBT003 - expat takes it by its place
        except _Refused as refused:
            return f"{refused} (line {self._parser.CurrentLineNumber})"
        except expat.ExpatError as error:
            return f"is no SVG: {expat.ErrorString(error.code)} (line {error.lineno})"
        return None

    def _entity(self, name: str, *_: object) -> None:
        raise _Refused(f"declares the entity {name!r}; save it as plain SVG")

    def _begin(self, name: str, attributes: Mapping[str, str]) -> None:
        self._depth += 1
        local = name.rpartition(":")[2].lower()
        if self._depth == 1 and local != "svg":
            raise _Refused(f"is no SVG: it begins with <{name}>")
        if self._depth > _MOST_DEEP:
            raise _Refused(f"has more than {_MOST_DEEP} groups in one another; simplify it")
        if local in _FOREIGN:
            raise _Refused(f"has <{name}> in it, which a card cannot show; remove it")
        for key, value in attributes.items():
            _check_attribute(name, key, value)

    def _end(self, _: str) -> None:
        self._depth -= 1

    def _instruction(self, target: str, _: str) -> None:
        if target.lower() == "xml-stylesheet":
            raise _Refused(_STYLED_ELSEWHERE)

    def _text(self, data: str) -> None:
        if "@import" in data.lower():
            raise _Refused(_STYLED_ELSEWHERE)


_STYLED_ELSEWHERE = "takes its style from another file; save it as plain SVG"


def _check_attribute(element: str, key: str, value: str) -> None:
    local = key.rpartition(":")[2].lower()
    if local.startswith("on"):
        raise _Refused(f"has a script in {key} of <{element}>; remove it")
    plain = "".join(value.split()).lower()
    if local == "href" and not plain.startswith(("#", "data:image/")) and element.rpartition(":")[2] != "a":
        raise _Refused(f"takes {value[:_SHOWN]!r} from elsewhere in {key} of <{element}>; put it into the file")
    if re.search(r"url\(['\"]?(?!#|['\"]|data:image/)", plain):
        raise _Refused(f"takes something from elsewhere in {key} of <{element}>; put it into the file")


_SHOWN = 60


# Names

Forms = Mapping[str, Mapping[str, str]]
"""What cards are called in a language: by card and form."""


@dataclass(frozen=True)
class CardNames:
    """The names of a deck's cards in one language: by card, its forms; the form ``""`` is the name itself."""

    file: Path
    forms: Forms

    def to_ftl(self) -> str:
        """Return them as messages, which every language of Recollect is written in."""
        return "".join(_message(card, forms) for card, forms in sorted(self.forms.items()) if forms.get(""))


def _message(card: str, forms: Mapping[str, str]) -> str:
    lines = [f"{card_message(card)} = {_literal(forms[''])}"]
    lines += (f"    .{form} = {_literal(text)}" for form, text in forms.items() if form and text)
    return "\n".join((*lines, ""))


def _literal(text: str) -> str:
    """Return a text that Fluent takes as it stands, whatever is in it."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'{{ "{escaped}" }}'


def read_names(folder: Path) -> dict[str, CardNames]:
    """Read the table of names of a deck, by language; empty without one.

    Its first column is the card: the name of the file, with or without its ending. Every other column is a language,
    such as ``en``, or a form that the sentences of a language need, such as ``it.il``. Raises UserInputError with a
    sentence for everything that is wrong, with its row.
    """
    file = folder / NAMES
    if not file.exists():
        return {}
    name = f"the names {file}"
    rows = _rows(name, file)
    header, *body = rows or [(1, [])]
    faults: list[str] = []
    columns = dict(_columns(header[1], faults))
    cards = pictures_in(folder)
    found: dict[str, dict[str, dict[str, str]]] = {language: {} for language, _ in columns.values()}
    for number, card, cells in _named(body, cards, faults):
        for at, (language, form) in columns.items():
            text = " ".join(cells[at].split()) if at < len(cells) else ""
            if len(text) > _LONGEST:
                faults.append(f"row {number}: a name has at most {_LONGEST} characters, but this has {len(text)}")
            elif text:
                found[language].setdefault(card, {})[form] = text
    if faults:
        raise UserInputError(*(f"{name}: {fault}" for fault in faults))
    return {language: CardNames(file, forms) for language, forms in found.items()}


def _named(
    rows: Iterable[tuple[int, list[str]]], cards: Mapping[str, Path], faults: list[str]
) -> Iterator[tuple[int, str, list[str]]]:
    """Yield the rows with their cards; a row without one, or with one that was there, is a fault."""
    seen: dict[str, int] = {}
    for number, cells in rows:
        card = _card(cells[0].strip(), cards)
        if card is None:
            faults.append(f"row {number}: {_no_card(cells[0].strip(), cards)}")
        elif card in seen:
            faults.append(f"row {number}: the card {card!r} stands in row {seen[card]}, too")
        else:
            seen[card] = number
            yield number, card, cells


_LONGEST = 60
"""A name that is longer makes sentences that no visitor reads."""


def _rows(name: str, file: Path) -> list[tuple[int, list[str]]]:
    """Return the rows that are not empty, with their numbers."""
    return _delimited(name, file)[0]


def _delimited(name: str, file: Path) -> tuple[list[tuple[int, list[str]]], str]:
    """Return the rows that are not empty, with their numbers, and the delimiter: a comma, a semicolon or a tab."""
    from kiosk.study.csv_import import text_of_table  # noqa: PLC0415 - few decks have a table of names

    text, first = text_of_table(name, file).replace("\r\n", "\n"), 1
    if text.lower().startswith("sep="):
        text, first = text.partition("\n")[2], 2
    header = next((line for line in text.splitlines() if line.strip()), "")
    delimiter = max(",;\t", key=header.count)
    try:
        cells = list(csv.reader(io.StringIO(text), delimiter=delimiter, strict=True))
    except csv.Error as error:
        raise UserInputError(f"{name} is no table: {error}") from error
    rows = [(number, row) for number, row in enumerate(cells, first) if any(cell.strip() for cell in row)]
    return rows, delimiter


def _columns(header: Sequence[str], faults: list[str]) -> Iterator[tuple[int, tuple[str, str]]]:
    """Yield the language and the form of every column but the first, by its place."""
    first = header[0].strip().lower() if header else ""
    if first not in _KEYS:
        faults.append(f"row 1: the first column must be 'card', but it is {first!r}")
    taken: set[tuple[str, str]] = set()
    for at, title in enumerate(header[1:], 1):
        language, _, form = title.strip().partition(".")
        if not title.strip():
            continue
        if not is_right(language) or (form and not _FORM.fullmatch(form)):
            faults.append(f"row 1: {title.strip()!r} is no language, such as 'en', and no form of one, such as 'it.il'")
        elif (code_of(language), form) in taken:
            faults.append(f"row 1: the column {title.strip()!r} stands twice")
        else:
            taken.add((code_of(language), form))
            yield at, (code_of(language), form)


def _card(name: str, cards: Mapping[str, Path]) -> str | None:
    if name in cards:
        return name
    return next((card for card, file in cards.items() if name.lower() in {file.name.lower(), card.lower()}), None)


def _no_card(name: str, cards: Iterable[str]) -> str:
    from difflib import get_close_matches  # noqa: PLC0415 - only a mistake needs it

    close = get_close_matches(name, list(cards), n=1)
    meant = f"; did you mean {close[0]!r}?" if close else ""
    return f"there is no picture {name!r} in the folder{meant}" if name else "the name of the card is missing"


def with_names(folder: Path, language: str, names: Mapping[str, str]) -> str:
    """Return the table of names of a deck, with these names of cards put in for a language.

    Raises UserInputError if the table cannot be read.
    """
    file = folder / NAMES
    numbered, delimiter = _delimited(f"the names {file}", file)
    (_, header), *body = numbered
    titles = [title.strip() for title in header]
    there = (n for n, title in enumerate(titles) if n and is_right(title) and code_of(title) == language)
    at = next(there, len(titles))
    cards = pictures_in(folder)
    rows = [header if at < len(titles) else [*header, language]]
    for _, cells in body:
        padded = [*cells, *[""] * (at + 1 - len(cells))]
        padded[at] = names.get(_card(cells[0].strip(), cards) or "", padded[at])
        rows.append(padded)
    out = io.StringIO()
    csv.writer(out, delimiter=delimiter, lineterminator="\n").writerows(rows)
    return out.getvalue()


def names_table(cards: Iterable[str], languages: Mapping[str, Sequence[str]], known: Mapping[str, Forms]) -> str:
    """Return a table of names to fill in, as CSV.

    It has a row for each card, and a column for each language and form.

    ``languages`` holds the forms of each language, and ``known`` the names there are: by language, card and form.
    """
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    columns = [(language, form) for language, forms in languages.items() for form in ("", *forms)]
    writer.writerow(["card", *(f"{language}.{form}" if form else language for language, form in columns)])
    for card in cards:
        cells = (known.get(language, {}).get(card, {}).get(form, "") for language, form in columns)
        writer.writerow([card, *cells])
    return out.getvalue()


def names_in(catalogue: Catalogue, cards: Iterable[str]) -> Forms:
    """Return what a language calls cards, as far as it has names for them."""
    named = [card for card in cards if catalogue.names(card)]
    told = {card: catalogue.forms_of(card) for card in named}
    return {
        card: {"": told[card][CARD]} | {form: told[card][f"{CARD}-{form}"] for form in catalogue.own_forms(card)}
        for card in named
    }
