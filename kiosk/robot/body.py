"""What a body is: something that says a sentence, shows a mood and looks somewhere, and may fail at any moment.

A body answers only by what it reports to its listener, never by making anybody wait; its failure is a report too.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from kiosk.study.commands import Mood
from kiosk.study.events import BodyName


@dataclass(frozen=True)
class Place:
    """A place on the board as the visitor sees it: from 0 (left, top) to 1 (right, bottom)."""

    across: float
    down: float


@dataclass(frozen=True)
class Health:
    """Whether a body can speak, and how it is, in words for the experimenter."""

    well: bool
    words: str


class Listener(Protocol):
    """Hears what becomes of an utterance, started, then finished or failed; and of the body itself."""

    def speech_started(self, utterance: int) -> None:
        """The first sound is out."""
        ...

    def speech_finished(self, utterance: int) -> None:
        """The last sound is out."""
        ...

    def speech_failed(self, utterance: int, why: str) -> None:
        """No further sound will come; ``why`` is for the experimenter."""
        ...

    def robot_lost(self, why: str) -> None:
        """The robot that was to speak cannot be counted on any more."""
        ...


class Body(Protocol):
    """Something that helps with voice and face. Every method returns at once."""

    @property
    def name(self) -> BodyName:
        """What the records call it."""
        ...

    @property
    def health(self) -> Health:
        """How it is."""
        ...

    def speak(self, language: str) -> None:
        """Speak this language, a code of two letters, from the next sentence on."""
        ...

    def say(self, utterance: int, sentence: str) -> None:
        """Begin to say a sentence, in place of any other; the listener hears the rest."""
        ...

    def stop(self) -> None:
        """Be silent; nothing more is reported of the sentence."""
        ...

    def express(self, mood: Mood) -> None:
        """Show a mood."""
        ...

    def attend(self, place: Place | None) -> None:
        """Look at a place on the board, or, with None, at the visitor."""
        ...

    def appear(self) -> None:
        """Be the one who helps, from now on."""
        ...

    def withdraw(self) -> None:
        """Leave it to another body."""
        ...

    def rest(self) -> None:
        """Nobody is here any more: keep nothing of the last visitor."""
        ...
