"""Sentences, from one catalogue per language that a translator edits without code (Project Fluent).

A message with several wordings gives them as attributes. Code names a message and its variables; which wording is
taken is chance's choice, but never the one that was taken last.
"""

from __future__ import annotations

from pathlib import Path
from random import Random

from fluent.runtime import FluentBundle, FluentResource
from fluent.runtime.resolver import Pattern
from fluent.syntax.ast import Junk

from kiosk import BadInput
from kiosk.assistant.hint import Hint
from kiosk.assistant.mdp import Action


class Catalogue:
    """All messages of one language: the ``*.ftl`` files of one folder, kept as text in ``sources`` by file name."""

    def __init__(self, folder: Path) -> None:
        """Read the folder; raises BadInput if it holds no messages, or one of its files is not well-formed."""
        self.language = folder.name
        # The marks that isolate a variable's writing direction are for mixed scripts; a voice would stumble on them.
        self._bundle = FluentBundle([self.language], use_isolating=False)
        files = sorted(folder.glob("*.ftl"))
        if not files:
            raise BadInput(f"there are no sentences for the language {self.language!r} in {folder}")
        self.sources = {file.name: file.read_text("utf-8") for file in files}
        for file in files:
            resource = FluentResource(self.sources[file.name])
            for entry in resource.body:
                if isinstance(entry, Junk):
                    raise BadInput(f"{file} is not well-formed near: {str(entry.content).strip().splitlines()[0]}")
            self._bundle.add_resource(resource)

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

    def __contains__(self, message: str) -> bool:
        """Whether there is such a message."""
        return self._bundle.has_message(message)

    def _format(self, message: str, pattern: Pattern, variables: dict[str, str | int]) -> str:
        text, errors = self._bundle.format_pattern(pattern, variables)
        if errors:
            raise KeyError(f"{self.language}: the message {message} cannot be filled in: {errors[0]}")
        return str(text)


class Wording:
    """Chooses among the wordings of a message, by ``rng``, never the same one twice running."""

    def __init__(self, catalogue: Catalogue, rng: Random) -> None:
        """Speak from one language's catalogue."""
        self.catalogue = catalogue
        self._rng = rng
        self._last: dict[str, int] = {}

    def say(self, message: str, **variables: str | int) -> str:
        """One wording of the message."""
        wordings = self.catalogue.wordings(message, **variables)
        fresh = [index for index in range(len(wordings)) if index != self._last.get(message)] or [0]
        self._last[message] = self._rng.choice(fresh)
        return wordings[self._last[message]]


class PlainSentences:
    """Says where, and gives no reason."""

    def __init__(self, wording: Wording) -> None:
        """Speak with this wording."""
        self._wording = wording

    def sentence(self, hint: Hint) -> str:
        """What is said with a hint; it names no more of the place than the action gives away."""
        return self._wording.say(pointing(hint), **place(hint))


class ReasonedSentences(PlainSentences):
    """Says first what this player's history gives as the reason, then where."""

    def sentence(self, hint: Hint) -> str:
        """What is said with a hint: the reason, then the place."""
        card = self._wording.catalogue.text(f"card-{hint.name}")
        return f"{self._wording.say(reasoning(hint), card=card)} {super().sentence(hint)}"


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
