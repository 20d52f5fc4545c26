"""Sentences, from one catalogue per language that a translator edits without code (Project Fluent).

A message with several wordings gives them as attributes. Code names a message and its variables; which wording is
taken is chance's choice, but never the one that was taken last. The message of a card has one value, its name, and
gives as attributes whatever else a language needs to speak of it: with an article, in the plural, its gender.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product
from pathlib import Path
from random import Random

from fluent.runtime import FluentBundle, FluentResource
from fluent.runtime.resolver import Pattern
from fluent.syntax.ast import EntryType, Junk, Message

from kiosk import BadInput
from kiosk.assistant.hint import Hint
from kiosk.assistant.mdp import Action

CARD = "card"
"""The variable that is a card's name, and what the messages of cards begin with."""


class Catalogue:
    """All messages of one language: the ``*.ftl`` files of one folder, kept as text in ``sources`` by file name."""

    def __init__(self, folder: Path, sources: Mapping[str, str] | None = None) -> None:
        """Read the folder, or take ``sources`` for what once stood in it.

        Raises BadInput if there are no messages, or a file cannot be read or is not well-formed.
        """
        self.language = folder.name
        self.sources = dict(_read(folder) if sources is None else sources)
        # The marks that isolate a variable's writing direction are for mixed scripts; a voice would stumble on them.
        self._bundle = FluentBundle([self.language], use_isolating=False)
        self._forms: set[str] = set()
        self._names: set[str] = set()
        for name, source in sorted(self.sources.items()):
            resource = FluentResource(source)
            for entry in resource.body:
                self._check(entry, folder / name)
            self._bundle.add_resource(resource)

    def _check(self, entry: EntryType, file: Path) -> None:
        """Refuse what is no message, and what Fluent would pass over in silence."""
        if isinstance(entry, Junk):
            raise BadInput(f"{file} is not well-formed near: {str(entry.content).strip().splitlines()[0]}")
        if not isinstance(entry, Message):
            return
        if entry.id.name in self._names:
            raise BadInput(f"{file}: the message {entry.id.name} stands twice")
        self._names.add(entry.id.name)
        if entry.id.name.startswith(f"{CARD}-"):
            self._forms |= {attribute.id.name for attribute in entry.attributes}

    def text(self, message: str, **variables: str | int) -> str:
        """The message with its variables filled in; an unknown message or variable is our mistake and raises."""
        pattern = self._bundle.get_message(message).value
        if pattern is None:
            raise KeyError(f"{self.language}: the message {message} has several wordings and no single one")
        return self._format(message, pattern, variables)

    def wordings(self, message: str, **variables: str | int) -> tuple[str, ...]:
        """Every wording of a message that has several."""
        attributes = self._bundle.get_message(message).attributes
        return tuple(self._format(message, attributes[name], variables) for name in sorted(attributes))

    def card(self, name: str) -> dict[str, str]:
        """What a sentence may say of a card: ``$card``, its name, and ``$card-<form>`` for every form there is.

        A card that the catalogue does not know goes by its file's name in every form; sentences about a deck that
        nobody has translated yet are clumsy, but nobody is left without help.
        """
        message = f"{CARD}-{name}"
        if message not in self:
            return dict.fromkeys((CARD, *(f"{CARD}-{form}" for form in sorted(self._forms))), name)
        attributes = self._bundle.get_message(message).attributes
        forms = {f"{CARD}-{form}": self._format(message, pattern, {}) for form, pattern in attributes.items()}
        return {CARD: self.text(message), **forms}

    @property
    def messages(self) -> frozenset[str]:
        """The names of all messages."""
        return frozenset(self._names)

    def __contains__(self, message: str) -> bool:
        """Whether there is such a message."""
        return self._bundle.has_message(message)

    def _format(self, message: str, pattern: Pattern, variables: dict[str, str | int]) -> str:
        text, errors = self._bundle.format_pattern(pattern, variables)
        if errors:
            raise KeyError(f"{self.language}: the message {message} cannot be filled in: {errors[0]}")
        return str(text)


def _read(folder: Path) -> dict[str, str]:
    files = sorted(folder.glob("*.ftl"))
    if not files:
        raise BadInput(f"there are no sentences for the language {folder.name!r} in {folder}")
    try:
        return {file.name: file.read_text("utf-8") for file in files}
    except OSError as error:
        raise BadInput(f"the sentences in {folder} cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise BadInput(f"the sentences in {folder} are not UTF-8: {error}") from error


class Wording:
    """Chooses among the wordings of a message, never the same one twice running.

    Every message has its own stream of chance, drawn from ``rng`` once: a condition that also gives reasons says the
    rest in the same words, at the same seed, as one that does not.
    """

    def __init__(self, catalogue: Catalogue, rng: Random) -> None:
        """Speak from one language's catalogue."""
        self.catalogue = catalogue
        self._seed = rng.getrandbits(64)
        self._chance: dict[str, Random] = {}
        self._last: dict[str, int] = {}

    def say(self, message: str, **variables: str | int) -> str:
        """One wording of the message."""
        wordings = self.catalogue.wordings(message, **variables)
        fresh = [index for index in range(len(wordings)) if index != self._last.get(message)] or [0]
        chance = self._chance.setdefault(message, Random(f"{self._seed}/{message}"))
        self._last[message] = chance.choice(fresh)
        return wordings[self._last[message]]


class PlainSentences:
    """Says where, and gives no reason."""

    def __init__(self, wording: Wording) -> None:
        """Speak with this wording."""
        self._wording = wording

    def sentence(self, hint: Hint) -> str:
        """What is said with a hint; it names no more of the place than the action gives away."""
        return self._wording.say(pointing(hint), **place(hint))

    def every(self, hint: Hint) -> tuple[str, ...]:
        """All that could be said with a hint."""
        return self._wording.catalogue.wordings(pointing(hint), **place(hint))


class ReasonedSentences(PlainSentences):
    """Says first what this player's history gives as the reason, then where."""

    def sentence(self, hint: Hint) -> str:
        """What is said with a hint: the reason, then the place."""
        card = self._wording.catalogue.card(hint.name)
        return f"{self._wording.say(reasoning(hint), **card)} {super().sentence(hint)}"

    def every(self, hint: Hint) -> tuple[str, ...]:
        """All that could be said with a hint: every reason with every place."""
        catalogue = self._wording.catalogue
        reasons = catalogue.wordings(reasoning(hint), **catalogue.card(hint.name))
        return tuple(f"{reason} {where}" for reason, where in product(reasons, super().every(hint)))


def reasoning(hint: Hint) -> str:
    """The message that gives a hint's reason."""
    return f"reason-{hint.card.value}-{hint.target.reason.value}"


def pointing(hint: Hint) -> str:
    """The message that says where a hint points."""
    return f"point-{hint.card.value}-{_PRECISION[hint.action]}"


def place(hint: Hint) -> dict[str, str | int]:
    """The rows and columns that a hint gives away, counted from 1 as people do."""
    given = {"row": hint.row, "column": hint.column}
    return {name: number + 1 for name, number in given.items() if number is not None}


_PRECISION = {Action.SUG_COL: "column", Action.SUG_ROW: "row", Action.SUG_CARD: "card"}
