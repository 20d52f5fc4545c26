"""Texts of a study in all its languages: how far each is translated, and how translated ones are put in."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass, field
from enum import Enum
from functools import lru_cache
from pathlib import Path
from textwrap import dedent, indent
from typing import Any

import tomlkit
from fluent.syntax import FluentParser, FluentSerializer
from fluent.syntax.ast import Attribute, EntryType, Identifier, Message, Pattern, Resource, Term, VariableReference
from fluent.syntax.serializer import serialize_pattern
from fluent.syntax.visitor import Visitor

from kiosk import UserInputError
from kiosk.config import ASSETS, Settings, code_of, read_text
from kiosk.files import write_file
from kiosk.language_codes import is_right, standard
from kiosk.study.decks import NAMES, read_names, with_names

CARD = "card"
LONG = 4
"""Words; a text of fewer may well be the same in two languages."""


class State(Enum):
    """How far a text is translated."""

    DONE = "done"
    MISSING = "missing"
    UNCHANGED = "unchanged"
    """It is the same as in the source language, and too long for that to be chance."""
    WRONG_VARIABLES = "wrong variables"


@dataclass(frozen=True)
class Unit:
    """One text: where it stands, and how it reads in the source language and in another one."""

    key: str
    source: str
    target: str
    note: str = ""
    is_fluent: bool = False
    """Whether ``{ $name }`` in it stands for something that is filled in."""

    @property
    def state(self) -> State:
        """How far it is translated."""
        if not self.target:
            return State.MISSING
        if self.is_fluent and not _same_variables(self.source, self.target):
            return State.WRONG_VARIABLES
        return State.UNCHANGED if is_untranslated(self.source, self.target) else State.DONE

    @property
    def part(self) -> str:
        """The file that it stands in."""
        return self.key.partition("#")[0]


def is_untranslated(source: str, target: str) -> bool:
    """Whether a text is the same in both languages, and too long for that to be chance."""
    return source.strip() == target.strip() and len(_words(source)) >= LONG


def _words(text: str) -> list[str]:
    """Return the words of a text; what stands in braces is filled in."""
    return re.findall(r"[^\W\d_]{2,}", re.sub(r"\{[^{}]*\}", " ", text))


def _same_variables(source: str, target: str) -> bool:
    """Whether both ask for the same; any form of a card stands for the card."""
    return _stems(source) == _stems(target)


@lru_cache(maxsize=4096)
def _stems(text: str) -> frozenset[str]:
    names = _Variables.of(text)
    return frozenset(CARD if name.startswith(f"{CARD}-") else name for name in names)


class _Variables(Visitor):
    """Collects the variables of a text."""

    def __init__(self) -> None:
        self.names: set[str] = set()

    @classmethod
    def of(cls, text: str) -> set[str]:
        """Return the variables of a text in Fluent's syntax."""
        found = cls()
        found.visit(_entry(text))
        return found.names

    def visit_VariableReference(self, node: VariableReference) -> None:  # noqa: N802 - fluent.syntax's name
        self.names.add(node.id.name)


def _entry(text: str) -> EntryType:
    return FluentParser().parse_entry(f"x =\n{indent(text, '    ')}\n")


@dataclass
class _Part:
    """A file of the source language, and the one of the other language that goes with it."""

    name: str
    source: Path
    target: Path
    """Where it lies, or would lie."""
    note: str = ""

    @property
    def is_shipped(self) -> bool:
        """Whether the file comes with Recollect, so that it cannot be changed."""
        return self.target.is_relative_to(ASSETS)

    @property
    def why_left(self) -> str:
        """Why texts of this file were not written."""
        if self.is_shipped:
            return f"{self.target.parent} comes with Recollect; copy what you need beside the study file"
        return "it is written once every text of it is translated"

    def units(self, language: str) -> Iterator[Unit]:
        """Yield every text."""
        raise NotImplementedError

    def changed(self, language: str, texts: Mapping[str, str]) -> tuple[Path, str] | None:
        """Return the file with these texts by their keys; None if nothing is to be written. Raises UserInputError."""
        raise NotImplementedError


class _Sentences(_Part):
    """A file of sentences, in Fluent."""

    def units(self, language: str) -> Iterator[Unit]:  # noqa: ARG002 - the file is of one language
        """Yield the texts of every message, wordings one by one."""
        theirs = dict(resource_patterns(_resource(self.target))) if self.target.is_file() else {}
        whole = {name.partition(".")[0] for name in theirs}
        for name, pattern, note in _noted(_resource(self.source)):
            message, _, wording = name.partition(".")
            # A language may have fewer wordings, and other forms of its cards.
            if wording and name not in theirs and message in whole:
                continue
            found = theirs.get(name)
            yield Unit(
                f"{self.name}#{name}",
                pattern_text(pattern),
                pattern_text(found) if found else "",
                note or self.note,
                is_fluent=True,
            )

    def changed(self, language: str, texts: Mapping[str, str]) -> tuple[Path, str] | None:  # noqa: ARG002 - as above
        """Return the file with these messages, in the order of the source."""
        patterns = {name: self._pattern(name, text) for name, text in texts.items()}
        if not patterns:
            return None
        resource = FluentParser().parse(_read(self.target)) if self.target.is_file() else Resource([])
        there = {_name(entry): entry for entry in resource.body if isinstance(entry, Message | Term)}
        for entry in _resource(self.source).body:
            if not isinstance(entry, Message | Term):
                continue
            own = {name: patterns[name] for name, _ in entry_patterns(entry) if name in patterns}
            if own:
                _fill(resource, there, deepcopy(entry), own)
        return self.target, FluentSerializer().serialize(resource)

    def _pattern(self, name: str, text: str) -> Pattern:
        entry = _entry(text)
        if not isinstance(entry, Message) or entry.value is None or entry.attributes:
            raise UserInputError(f"{self.name}#{name}: {text[:60]!r} is not well-formed; mind the braces")
        return entry.value


def _fill(
    resource: Resource, there: dict[str, Message | Term], model: Message | Term, own: Mapping[str, Pattern]
) -> None:
    """Put the texts of one message into a resource."""
    name = _name(model)
    entry = there.get(name)
    if entry is None:
        model.attributes = [each for each in model.attributes if f"{name}.{each.id.name}" in own]
        if model.value is not None and name not in own:
            return
        entry = there[name] = model
        resource.body.append(entry)
    for key, pattern in own.items():
        wording = key.partition(".")[2]
        if not wording:
            entry.value = pattern
            continue
        old = next((each for each in entry.attributes if each.id.name == wording), None)
        if old is None:
            entry.attributes.append(Attribute(Identifier(wording), pattern))
        else:
            old.value = pattern


def _resource(file: Path) -> Resource:
    """Return what a file says; it is shared, and not to be changed."""
    return _parsed(_read(file))


def _read(file: Path) -> str:
    return read_text(f"the file {file}", file)


@lru_cache(maxsize=64)
def _parsed(text: str) -> Resource:
    """Parse a file; the same ones are looked at for every list of texts, and parsing them takes longest."""
    return FluentParser().parse(text)


def _name(entry: Message | Term) -> str:
    return entry.id.name if isinstance(entry, Message) else f"-{entry.id.name}"


def entry_patterns(entry: Message | Term) -> Iterator[tuple[str, Pattern]]:
    """Yield the text of a message and of its attributes, by their names."""
    name = _name(entry)
    if entry.value is not None:
        yield name, entry.value
    yield from ((f"{name}.{each.id.name}", each.value) for each in entry.attributes)


def resource_patterns(resource: Resource) -> Iterator[tuple[str, Pattern]]:
    """Yield the texts of all messages, by their names."""
    for entry in resource.body:
        if isinstance(entry, Message | Term):
            yield from entry_patterns(entry)


def _noted(resource: Resource) -> Iterator[tuple[str, Pattern, str]]:
    """Yield every text with the comment above its message."""
    for entry in resource.body:
        if isinstance(entry, Message | Term):
            note = entry.comment.content if entry.comment and entry.comment.content else ""
            yield from ((name, pattern, note) for name, pattern in entry_patterns(entry))


def pattern_text(pattern: Pattern) -> str:
    """Return a text as it stands in its file, without the indent of its lines."""
    return dedent(serialize_pattern(pattern).lstrip("\n")).strip()


class _Names(_Part):
    """The table of a deck's names, with a column for each language; forms such as ``it.il`` are not translated."""

    source_language = ""

    def units(self, language: str) -> Iterator[Unit]:
        """Yield the name of every card that has one in the source language."""
        names = read_names(self.source.parent)
        ours, theirs = (names[code].forms if code in names else {} for code in (self.source_language, language))
        for card, forms in ours.items():
            if "" in forms:
                yield Unit(f"{self.name}#{card}", forms[""], theirs.get(card, {}).get("", ""), self.note)

    def changed(self, language: str, texts: Mapping[str, str]) -> tuple[Path, str] | None:
        """Return the table with these names."""
        return (self.source, with_names(self.source.parent, language, texts)) if texts else None


class _Sheet(_Part):
    """An information sheet: a TOML file for each language."""

    def units(self, language: str) -> Iterator[Unit]:  # noqa: ARG002 - the file is of one language
        """Yield every title, paragraph and purpose."""
        theirs = dict(worded_strings(read_document(self.target))) if self.target.is_file() else {}
        for path, text in worded_strings(read_document(self.source)):
            yield Unit(f"{self.name}#{path}", text, theirs.get(path, ""), self.note)

    def changed(self, language: str, texts: Mapping[str, str]) -> tuple[Path, str] | None:  # noqa: ARG002 - as above
        """Return the sheet; a new one is written only whole, as visitors agree to it."""
        document = read_document(self.source)
        theirs = dict(worded_strings(read_document(self.target))) if self.target.is_file() else {}
        wanted = {path for path, _ in worded_strings(document)}
        given = {path: text for path, text in (theirs | dict(texts)).items() if path in wanted}
        if not texts or wanted - given.keys():
            return None
        for path, text in given.items():
            put_text(document, path.split("."), text)
        return self.target, tomlkit.dumps(document)


_NOT_WORDED = frozenset(("id", "version", "signs"))


def worded_strings(table: Any, before: str = "") -> Iterator[tuple[str, str]]:
    """Yield every worded string of a document, by its path."""
    entries = table.items() if isinstance(table, Mapping) else enumerate(table)
    for key, value in entries:
        path = f"{before}{key}"
        if key in _NOT_WORDED:
            continue
        if isinstance(value, str):
            yield path, str(value)
        elif isinstance(value, Mapping | list):
            yield from worded_strings(value, f"{path}.")


class _Questions(_Part):
    """A questionnaire: a TOML file with all languages; ``source_language`` is the one to translate from."""

    source_language = ""

    def units(self, language: str) -> Iterator[Unit]:
        """Yield every text in which there is a word in the source language."""
        for path, words in worded_tables(read_document(self.source), self.source_language):
            target = str(words.get(spelling_among(words, language), ""))
            yield Unit(
                f"{self.name}#{path}", str(words[spelling_among(words, self.source_language)]), target, self.note
            )

    def changed(self, language: str, texts: Mapping[str, str]) -> tuple[Path, str] | None:
        """Return the file with these texts added."""
        if not texts:
            return None
        document = read_document(self.source)
        for path, words in worded_tables(document, self.source_language):
            if path in texts:
                words[spelling_among(words, language)] = texts[path]
        return self.source, tomlkit.dumps(document)


def spelling_among(words: Mapping[str, Any], language: str) -> str:
    """Return how a language is spelt among these words; its own spelling if it is not there."""
    return next((code for code in words if is_right(code) and standard(code) == language), language)


def worded_tables(table: Any, language: str, before: str = "") -> Iterator[tuple[str, Any]]:
    """Yield every table of words that has this language, by its path; items and options go by their ids."""
    if isinstance(table, Mapping):
        if isinstance(table.get(spelling_among(table, language)), str):
            yield before.rstrip("."), table
            return
        named = [(key, value) for key, value in table.items() if isinstance(value, Mapping | list)]
    else:
        named = [(_id(each, n), each) for n, each in enumerate(table) if isinstance(each, Mapping | list)]
    for key, value in named:
        yield from worded_tables(value, language, f"{before}{key}.")


def _id(value: Any, number: int) -> str:
    return str(value.get("id", number)) if isinstance(value, Mapping) else str(number)


def put_text(document: Any, path: Sequence[str], text: str) -> None:
    """Put a text into a document at a path, which is there already."""
    *way, last = path
    place = document
    for step in way:
        place = place[int(step) if isinstance(place, list) else step]
    place[int(last) if isinstance(place, list) else last] = text


def read_document(file: Path) -> tomlkit.TOMLDocument:
    """Read a TOML file so that its comments and order are kept; raises UserInputError."""
    text = read_text(f"the file {file}", file)
    try:
        return tomlkit.parse(text)
    except (ValueError, RecursionError) as error:
        raise UserInputError(f"the file {file} is not TOML: {error}") from error


_NAME = "A card's name."


@dataclass
class Translation:
    """All texts of a study in one language, held against its first language."""

    settings: Settings
    language: str
    source_language: str = field(init=False)
    parts: list[_Part] = field(init=False)

    def __post_init__(self) -> None:
        """Find the files; raises UserInputError if the language is no code, or is the source."""
        if not is_right(self.language):
            raise UserInputError(f"{self.language!r} is no language code, such as 'de' or 'pt-BR'")
        self.language = standard(self.language)
        self.source_language = self.settings.language_codes[0]
        if self.language == self.source_language:
            raise UserInputError(f"{self.language!r} is the study's first language, from which others are translated")
        self.parts = [*self._sentences(), *self._decks(), *self._sheet(), *self._questions()]

    def units(self) -> list[Unit]:
        """Return every text; raises UserInputError if a file cannot be read."""
        return [unit for part in self.parts for unit in part.units(self.language)]

    def _folder(self) -> Path:
        """Return the folder of the language's sentences: the study's own, shipped, or one that is yet to be made."""
        name = next((each for each in self.settings.languages if code_of(each) == self.language), f"./{self.language}")
        found = self.settings.locate("sentences", name)
        return found.path if found else self.settings.beside(f"./{self.language}")

    def _sentences(self) -> Iterator[_Part]:
        source = self.settings.resolve_asset("sentences", self.settings.languages[0])
        folder = self._folder()
        # How a folder is cut into files does not matter; a message is looked for in all of them.
        where = {name: file for file in sorted(folder.glob("*.ftl")) for name, _ in resource_patterns(_resource(file))}
        for file in sorted(source.glob("*.ftl")):
            names = [name for name, _ in resource_patterns(_resource(file))]
            target = next((where[name] for name in names if name in where), folder / file.name)
            yield _Sentences(f"sentences/{file.name}", file, target)

    def _decks(self) -> Iterator[_Part]:
        decks = dict.fromkeys((self.settings.game.deck, self.settings.practice.deck))
        for deck in decks:
            place = self.settings.resolve_asset("cards", deck)
            own = {code_of(file.stem): file for file in sorted(place.glob("*.ftl"))}
            source = own.get(self.source_language)
            if source:
                target = own.get(self.language, place / f"{self.language}.ftl")
                yield _Sentences(f"cards/{place.name}", source, target, _NAME)
            table = place / NAMES
            if table.is_file():
                names = _Names(f"cards/{place.name}/{NAMES}", table, table, _NAME)
                names.source_language = self.source_language
                yield names

    def _sheet(self) -> Iterator[_Part]:
        place = self.settings.resolve_asset("consent", self.settings.consent.text)
        there = {code_of(file.stem): file for file in sorted(place.glob("*.toml"))}
        if self.source_language in there:
            target = there.get(self.language, place / f"{self.language}.toml")
            note = "What visitors are told and agree to; an ethics board approves it."
            yield _Sheet(f"information/{place.name}", there[self.source_language], target, note)

    def _questions(self) -> Iterator[_Part]:
        for name in (self.settings.about_you, *self.settings.questionnaires):
            file = self.settings.resolve_asset("questionnaires", name)
            if file.is_file():
                part = _Questions(f"questionnaires/{file.name}", file, file)
                part.source_language = self.source_language
                yield part

    def fill(self, texts: Mapping[str, str]) -> tuple[list[Path], list[str]]:
        """Write translated texts by their keys into the study's own files.

        Returns the files and a sentence for each that was left out. Raises UserInputError, with nothing written, for a
        key that does not exist, variables that differ and texts that are not well-formed.
        """
        known = {unit.key: unit for unit in self.units()}
        given = {key: text for key, text in texts.items() if text.strip() and text != _target(known.get(key))}
        faults = [fault for key, text in given.items() for fault in _unfit(key, text, known.get(key))]
        written: dict[Path, str] = {}
        left: list[str] = []
        for part in self.parts:
            own = {key.partition("#")[2]: text for key, text in given.items() if key.partition("#")[0] == part.name}
            try:
                file = part.changed(self.language, own) if not part.is_shipped else None
            except UserInputError as error:
                faults += error.sentences
                continue
            if file is not None:
                written[file[0]] = file[1]
            elif own:
                left.append(f"{part.name}: {part.why_left}")
        if faults:
            raise UserInputError(*faults)
        for path, content in written.items():
            path.parent.mkdir(parents=True, exist_ok=True)
            write_file(path, content)
        return [*written], left


def _unfit(key: str, text: str, unit: Unit | None) -> Iterator[str]:
    """Yield why a text cannot be put into a study."""
    if unit is None:
        yield f"there is no text {key!r} in this study"
    elif unit.is_fluent and not _same_variables(unit.source, text):
        wanted = ", ".join(f"${each}" for each in sorted(_stems(unit.source))) or "none"
        yield f"{key}: its variables must be {wanted}, as in {unit.source[:60]!r}"


def _target(unit: Unit | None) -> str:
    return unit.target if unit else ""
