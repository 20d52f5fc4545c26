"""What a body is: something that says a sentence and shows a mood, and may fail at any moment.

A body answers only by what it reports to its listener, never by making anybody wait; its failure is a report too.
"""

from __future__ import annotations

from typing import Protocol

from kiosk.study.commands import Mood


class Listener(Protocol):
    """Hears what becomes of an utterance: started, then finished or failed; or failed at once."""

    def speech_started(self, utterance: int) -> None:
        """The first sound is out."""
        ...

    def speech_finished(self, utterance: int) -> None:
        """The last sound is out."""
        ...

    def speech_failed(self, utterance: int, why: str) -> None:
        """No further sound will come; ``why`` is for the experimenter."""
        ...


class Body(Protocol):
    """Something that helps with voice and face."""

    @property
    def name(self) -> str:
        """What the records call it."""
        ...

    def say(self, utterance: int, sentence: str) -> None:
        """Begin to say a sentence; returns at once, the listener hears the rest."""
        ...

    def stop(self) -> None:
        """Be silent; nothing more is reported of the sentence."""
        ...

    def express(self, mood: Mood) -> None:
        """Show a mood."""
        ...
