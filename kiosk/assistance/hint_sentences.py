"""The sentences of hints and remarks: what is said in each condition, in one of its wordings."""

from __future__ import annotations

from itertools import product
from random import Random
from typing import Protocol

from kiosk.assistance.mentaliser import Hint
from kiosk.assistance.policy import ENCOURAGEMENT, PRAISE, ActionSpec
from kiosk.assistance.wording import CARD, Catalogue


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


class Sentences(Protocol):
    """What is said with hints and remarks."""

    @property
    def speaks(self) -> bool:
        """Whether hints are said; without words, the helper looks toward the place."""
        ...

    def sentence(self, hint: Hint) -> str:
        """Return the sentence for one hint."""
        ...

    def all_wordings(self, hint: Hint) -> tuple[str, ...]:
        """All the sentences that there are for one hint."""
        ...

    def advice(self, hint: Hint, sentence: str) -> str:
        """Return the part of a hint's sentence that says where."""
        ...

    def remark(self, action: ActionSpec) -> str:
        """Return the sentence for an action without a place."""
        ...

    def all_remarks(self, action: ActionSpec) -> tuple[str, ...]:
        """All the sentences that there are for an action without a place."""
        ...


class PlainSentences:
    """Says where, and gives no reason."""

    speaks = True
    """Whether hints are said; without words, the helper looks toward the place."""

    def __init__(self, wording: Wording) -> None:
        """Speak with this wording."""
        self._wording = wording

    def sentence(self, hint: Hint) -> str:
        """Return what is said with a hint; it names no more of the place than the action gives away."""
        return self._wording.say(pointing(hint), **place(hint))

    def all_wordings(self, hint: Hint) -> tuple[str, ...]:
        """Return all that could be said with a hint."""
        return self._wording.catalogue.wordings(pointing(hint), **place(hint))

    def advice(self, hint: Hint, sentence: str) -> str:  # noqa: ARG002 - it is all advice
        """Return the part of a hint's sentence that says where."""
        return sentence

    def remark(self, action: ActionSpec) -> str:
        """Return what is said by an action without a place."""
        return self._wording.say(action.message)

    def all_remarks(self, action: ActionSpec) -> tuple[str, ...]:
        """All that could be said by an action without a place."""
        return self._wording.catalogue.wordings(action.message)


class ReasonedSentences(PlainSentences):
    """Says first what this player's history gives as the reason, then where."""

    def sentence(self, hint: Hint) -> str:
        """Return what is said with a hint: the reason, then the place."""
        card = self._wording.catalogue.card(hint.name)
        return f"{self._wording.say(reasoning(hint), **card)} {super().sentence(hint)}"

    def all_wordings(self, hint: Hint) -> tuple[str, ...]:
        """All that could be said with a hint: every reason with every place."""
        catalogue = self._wording.catalogue
        reasons = catalogue.wordings(reasoning(hint), **catalogue.card(hint.name))
        return tuple(f"{reason} {where}" for reason, where in product(reasons, super().all_wordings(hint)))

    def advice(self, hint: Hint, sentence: str) -> str:
        """Return the part of a hint's sentence that says where: its end."""
        return max((where for where in super().all_wordings(hint) if sentence.endswith(where)), key=len, default="")


class ReminderSentences(PlainSentences):
    """Says what this player's history holds of the pair, and not where its cards lie."""

    def sentence(self, hint: Hint) -> str:
        """Return what is said with a hint; it names no place."""
        return self._wording.say(reminding(hint), **self._wording.catalogue.card(hint.name))

    def all_wordings(self, hint: Hint) -> tuple[str, ...]:
        """Return all that could be said with a hint."""
        catalogue = self._wording.catalogue
        return catalogue.wordings(reminding(hint), **catalogue.card(hint.name))

    def advice(self, hint: Hint, sentence: str) -> str:  # noqa: ARG002 - no part of it is advice
        """Return the empty text: a reminder names no place."""
        return ""


class NoSentences(PlainSentences):
    """Says nothing with a hint, which is a look; remarks are said."""

    speaks = False

    def sentence(self, hint: Hint) -> str:  # noqa: ARG002 - a look has no words
        """Return the empty text."""
        return ""

    def all_wordings(self, hint: Hint) -> tuple[str, ...]:  # noqa: ARG002 - as above
        """Return nothing, as nothing could be said."""
        return ()


def reminding(hint: Hint) -> str:
    """Return the message that reminds of a hint's pair."""
    return f"remind-{hint.card.value}-{hint.target.reason.value}"


def reasoning(hint: Hint) -> str:
    """Return the message that gives a hint's reason."""
    return f"reason-{hint.card.value}-{hint.target.reason.value}"


def pointing(hint: Hint) -> str:
    """Return the message that says where a hint points."""
    return f"{hint.action.message}-{hint.card.value}-{hint.action.precision.value}"


def place(hint: Hint) -> dict[str, str | int]:
    """Return the rows and columns that a hint gives away, counted from 1 as people do."""
    given = {"row": hint.row, "column": hint.column}
    return {name: number + 1 for name, number in given.items() if number is not None}


_PLACES = {"column": frozenset({"column"}), "row": frozenset({"row"}), "card": frozenset({"row", "column"})}


def given_with(message: str) -> frozenset[str] | None:
    """List the variables that a message of a hint gets; None for other messages.

    ``card`` stands for all of its forms.
    """
    if message.startswith(("reason-", "remind-")):
        return frozenset({CARD})
    if message in {comment.message for comment in (PRAISE, ENCOURAGEMENT)}:
        return frozenset()
    if message.startswith("point-"):
        return _PLACES.get(message.rpartition("-")[2])
    return None
