"""The messages of a language: read, replaced by a study's own, and said with what is filled in."""

from __future__ import annotations

import logging
import re
from collections.abc import Iterable, Iterator, Mapping
from functools import cache, lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

from kiosk import UserInputError
from kiosk.assistance.keyboards import KeyRows, key_rows
from kiosk.assistance.late_messages import LateMessages, attributes_in, split
from kiosk.config import ASSETS, read_text
from kiosk.language_codes import standard
from kiosk.lazy_dataclass import dataclass

if TYPE_CHECKING:
    from fluent.runtime.resolver import Pattern
    from fluent.syntax.ast import EntryType, Message, SyntaxNode, Term

# Fluent is imported where something is parsed, as the start screen says nothing that has to be.
# ruff: noqa: PLC0415

_log = logging.getLogger(__name__)

CARD = "card"
"""The variable that is a card's name, and what the messages of cards begin with."""

_SHIPPED = ASSETS / "sentences"

REPLACING = "~"
"""Sources whose names begin so replace messages of the others; they are read last."""


def card_message(card: str) -> str:
    """Return the message that names a card; what no message's name may have is written as its number."""
    return f"{CARD}-{re.sub('[^A-Za-z0-9_-]', lambda found: f'_{ord(found[0]):x}_', card)}"


@lru_cache(maxsize=16)
def _compiled(language: str, sources: tuple[tuple[str, str], ...], shipped: frozenset[str]) -> LateMessages:
    """Return the messages of these sources, by their names.

    Those of shipped sources are parsed when they are first said, if they have to be.
    """
    messages = LateMessages(
        language, dict(entry for name, source in sources if name in shipped for entry in split(source))
    )
    own = [(name, source) for name, source in sources if name not in shipped]
    if own:
        from kiosk.assistance.fluent_messages import parsed_file

        messages.add((parsed_file(source), name.startswith(REPLACING)) for name, source in own)
    return messages


FOR_EXPERIMENTERS = ("console-", "dossier-", "film-", "preview-")
"""Groups of messages that visitors never see; a language that has none of a group speaks English there."""


class Catalogue:
    """All messages of one language: the ``*.ftl`` files of one folder, kept as text in ``sources`` by file name."""

    def __init__(
        self,
        folder: Path,
        sources: Mapping[str, str] | None = None,
        files: Mapping[str, Path] | None = None,
        lines: Mapping[str, int] | None = None,
    ) -> None:
        """Read the folder, or take ``sources`` for what once stood in it; ``files`` names those that lie elsewhere.

        ``lines`` holds the lines in which messages stand that were written in a file of another form.

        Raises UserInputError if there are no messages, or a file cannot be read or is not well-formed.
        """
        try:
            self.language = standard(folder.name)
        except ValueError as error:
            raise UserInputError(f"the folder of sentences {folder}: {error}") from error
        self.folder = folder
        self.sources = dict(sources_in(folder) if sources is None else sources)
        self.written: dict[str, Written] = {}
        self._forms: set[str] = set()
        self._next: tuple[Catalogue, ...] = ()
        self._warned: set[str] = set()
        elsewhere = files or {}
        # What was recorded stands in no file, and is parsed as a whole like everything that a study brings along.
        is_shipped = folder.parent == _SHIPPED and (sources is None or files is not None)
        shipped = frozenset(self.sources.keys() - elsewhere.keys() if is_shipped else ())
        for name, source in sorted(self.sources.items()):
            file = elsewhere.get(name, folder / name)
            numbers = tuple(sorted((lines or {}).items()))
            self._take(_shipped(source, file) if name in shipped else _written(source, file, numbers), name)
        self._said = _compiled(self.language, tuple(sorted(self.sources.items())), shipped)

    def _take(self, entries: Iterable[Written], source: str) -> None:
        """Refuse what stands twice, which Fluent would pass over in silence."""
        before = frozenset[str]() if source.startswith(REPLACING) else frozenset(self.written)
        here: dict[str, Written] = {}
        for written in entries:
            if written.name in before or written.name in here:
                raise UserInputError(f"{written.file}: the message {written.name} stands twice")
            here[written.name] = written
            if written.name.startswith(f"{CARD}-"):
                self._forms |= written.attributes
        self.written |= here

    def followed_by(self, others: Iterable[Catalogue]) -> None:
        """Name the catalogues that speak where this one cannot, in turn; the shipped English one is always the last."""
        self._next = tuple(others)

    def text(self, message: str, **variables: str | int) -> str:
        """Return the message with its variables filled in, or that of the next language that can say it.

        A message or a variable that the shipped English one does not know either is our mistake and raises.
        """
        for catalogue in self._in_turn():
            said = catalogue._text(message, variables)
            if said is not None:
                return said
            if not message.startswith(FOR_EXPERIMENTERS):
                self._warn(message, f"the message {message!r} cannot be said in {catalogue.language!r}")
        raise KeyError(self._why_not(message, variables))

    def wordings(self, message: str, **variables: str | int) -> tuple[str, ...]:
        """Every wording of a message that has several, or those of the next language that has one."""
        for catalogue in self._in_turn():
            said = catalogue._wordings(message, variables)
            if said:
                return said
            self._warn(message, f"the message {message!r} cannot be said in {catalogue.language!r}")
        raise KeyError(self._why_not(message, variables))

    def card(self, name: str) -> dict[str, str]:
        """Return what a sentence may say of a card: ``$card``, its name, and ``$card-<form>`` for every form there is.

        A card that the catalogue does not know goes by its file's name in every form; sentences about a deck that
        has no translation yet are clumsy, but no visitor is left without help.
        """
        if not self.names(name):
            self._warn(
                card_message(name), f"the card {name!r} has no name in {self.language!r}; its file's name is said"
            )
        return self.forms_of(name)

    def names(self, card: str) -> bool:
        """Whether it has a name for a card."""
        return self._text(card_message(card), {}) is not None

    @property
    def forms(self) -> tuple[str, ...]:
        """The variables that stand for a card: its name, and every form that some card has."""
        return (CARD, *(f"{CARD}-{form}" for form in sorted(self._forms)))

    def own_forms(self, name: str) -> frozenset[str]:
        """Return the forms that a card has besides its name."""
        message = card_message(name)
        return frozenset(self._said.bundle.get_message(message).attributes) if message in self else frozenset()

    def forms_of(self, name: str) -> dict[str, str]:
        """Return all forms of a card.

        A form that it lacks is its name, and a name that it lacks is its file's.
        """
        message = card_message(name)
        called = self._text(message, {})
        if called is None:
            return dict.fromkeys(self.forms, name)
        attributes = self._said.bundle.get_message(message).attributes
        told = {f"{CARD}-{form}": self._format(pattern, {}) for form, pattern in attributes.items()}
        return dict.fromkeys(self.forms, called) | {form: text for form, text in told.items() if text is not None}

    @property
    def key_rows(self) -> KeyRows:
        """The keys on the screen: the rows of its message ``keyboard-rows``, or those shipped for its language."""
        own = self._text("keyboard-rows", {}) or ""
        return key_rows(self.language, own.split())

    @property
    def messages(self) -> frozenset[str]:
        """The names of all messages."""
        return frozenset(name for name in self.written if not name.startswith("-"))

    def lacking(self, needed: Iterable[str]) -> tuple[str, ...]:
        """Return those of the needed messages that it lacks, sorted.

        Names of cards may come from elsewhere, and a group for experimenters may be left out as a whole.
        """
        left_out = tuple(
            group for group in FOR_EXPERIMENTERS if not any(name.startswith(group) for name in self.written)
        )
        optional = (f"{CARD}-", *left_out)
        messages = self.messages
        return tuple(sorted(name for name in needed if name not in messages and not name.startswith(optional)))

    def wordings_of(self, message: str) -> int:
        """Count the wordings of a message in this catalogue.

        It is 0 for a message that is a single text, or that is not there.
        """
        return self._said.wordings_of(message) if message in self else 0

    def __contains__(self, message: str) -> bool:
        """Whether there is such a message."""
        return message in self._said

    def _in_turn(self) -> Iterator[Catalogue]:
        yield self
        yield from self._next
        yield _english()

    def _why_not(self, message: str, variables: Mapping[str, str | int]) -> str:
        why = self.fault(message, variables) if message in self else "there is no such message"
        return f"{self.language}: the message {message} cannot be filled in: {why or 'it is of another form'}"

    def _warn(self, message: str, words: str) -> None:
        """Log what is missing, once for each message."""
        if message not in self._warned:
            self._warned.add(message)
            _log.warning("%s", words)

    def _text(self, message: str, variables: Mapping[str, str | int]) -> str | None:
        """Return the message, or None if it cannot be said."""
        plain = self._said.plain(message, variables)
        if plain is not None:
            return plain
        pattern = self._said.bundle.get_message(message).value if message in self else None
        return None if pattern is None else self._format(pattern, variables)

    def _wordings(self, message: str, variables: Mapping[str, str | int]) -> tuple[str, ...]:
        """Return the wordings of a message that can be said."""
        attributes = self._said.bundle.get_message(message).attributes if message in self else {}
        formed = (self._format(attributes[name], variables) for name in sorted(attributes))
        said = tuple(text for text in formed if text is not None)
        if 0 < len(said) < len(attributes):
            self._warn(message, f"a wording of the message {message!r} cannot be said in {self.language!r}")
        return said

    def _format(self, pattern: Pattern, variables: Mapping[str, str | int]) -> str | None:
        try:
            text, errors = self._said.bundle.format_pattern(pattern, dict(variables))
        except Exception:  # noqa: BLE001 - whatever a library raises, the next language speaks
            return None
        return None if errors else str(text)

    def fault(self, message: str, variables: Mapping[str, str | int]) -> str | None:
        """Say why a message, or a wording of it, cannot be formed with these variables; None if it can."""
        formed = self._said.bundle.get_message(message)
        for pattern in (formed.value, *formed.attributes.values()):
            if pattern is None:
                continue
            try:
                _, errors = self._said.bundle.format_pattern(pattern, dict(variables))
            except Exception as error:  # noqa: BLE001 - any error is reported
                errors = [error]
            if errors:
                return str(errors[0]) or type(errors[0]).__name__
        return None


@dataclass(frozen=True)
class Written:
    """A message or a term as it is written, and where; ``begins`` is its first line, counted from 1."""

    name: str
    """What it is called; a term has a ``-`` before its name."""
    file: Path
    source: str
    begins: int | None = None
    late: str | None = None
    """Its text, if it has not been parsed."""

    @property
    def entry(self) -> Message | Term:
        """The message as Fluent's parser gives it."""
        return _entries(self.source)[self.name]

    @property
    def attributes(self) -> frozenset[str]:
        """The names of its attributes."""
        if self.late is not None:
            return attributes_in(self.late)
        return frozenset(attribute.id.name for attribute in self.entry.attributes)

    @property
    def text(self) -> str:
        """The entry as it is written, without its comment."""
        start = self.entry.id.span.start if self.entry.id.span else 0
        return self.source[start : self.entry.span.end if self.entry.span else None].strip()

    def line(self, node: SyntaxNode) -> int:
        """Return the line in which a part of it begins, counted from 1."""
        if self.begins is not None:
            return self.begins
        return self.source.count("\n", 0, node.span.start if node.span else 0) + 1


@lru_cache(maxsize=64)
def _written(source: str, file: Path, lines: tuple[tuple[str, int], ...]) -> tuple[Written, ...]:
    """Return the messages and terms of a file; raises UserInputError for what is neither."""
    from kiosk.assistance.fluent_messages import parsed_file

    numbers = dict(lines)
    entries = (_entry(entry, file, source, numbers) for entry in parsed_file(source).body)
    return tuple(entry for entry in entries if entry is not None)


def _entry(entry: EntryType, file: Path, source: str, lines: Mapping[str, int]) -> Written | None:
    """Return a message or a term; None for a comment. Raises UserInputError for what is neither."""
    from fluent.syntax.ast import Junk, Message, Term

    if isinstance(entry, Junk):
        line = source.count("\n", 0, entry.span.start if entry.span else 0) + 1
        begin = str(entry.content).strip().splitlines()[0]
        line = lines.get(begin.partition("=")[0].strip(), line)
        raise UserInputError(f"{file}, line {line}, is not well-formed near: {begin}")
    if not isinstance(entry, Message | Term):
        return None
    return Written(_name(entry), file, source, lines.get(entry.id.name))


def _name(entry: Message | Term) -> str:
    from fluent.syntax.ast import Message

    return entry.id.name if isinstance(entry, Message) else f"-{entry.id.name}"


@lru_cache(maxsize=64)
def _entries(source: str) -> dict[str, Message | Term]:
    from fluent.syntax.ast import Message, Term

    from kiosk.assistance.fluent_messages import parsed_file

    return {_name(entry): entry for entry in parsed_file(source).body if isinstance(entry, Message | Term)}


@lru_cache(maxsize=64)
def _shipped(source: str, file: Path) -> tuple[Written, ...]:
    """Return the messages and terms of a file that comes with Recollect, without parsing them."""
    return tuple(Written(name, file, source, late=text) for name, text in split(source))


@cache
def _english() -> Catalogue:
    """Return the catalogue that can say everything."""
    return Catalogue(ASSETS / "sentences" / "en")


def sources_in(folder: Path) -> dict[str, str]:
    """Read the text of every file of sentences in a folder; raises UserInputError."""
    files = sorted(folder.glob("*.ftl"))
    if not files:
        raise UserInputError(f"there are no sentences for the language {folder.name!r} in {folder}")
    return {file.name: read_text(f"the file {file}", file) for file in files}
