"""What every scene can do, and the voice that all of them share."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar

from kiosk.assistant.wording import Wording
from kiosk.study import commands as do
from kiosk.study import events as happened
from kiosk.study.commands import Mood, Script
from kiosk.study.events import WorldEvent


class Scene:
    """One stage; by default it shows nothing and takes whatever the table of stages lets through."""

    mood: ClassVar[Mood] = Mood.IDLE
    """The assistant's face as the stage begins, whatever it showed before."""

    @property
    def characters(self) -> int:
        """How much there is to read on its longest page, in characters."""
        return 0

    def enter(self, script: Script) -> None:
        """Begin, or begin anew."""

    def accepts(self, event: WorldEvent) -> bool:  # noqa: ARG002 - most scenes take whatever comes
        """Whether this event makes sense now."""
        return True

    def react(self, event: WorldEvent, script: Script) -> None:
        """What an event leads to within the scene."""


class Speaker:
    """Says what stands in the catalogue; every sentence of a sitting has a number of its own."""

    def __init__(self, wording: Wording, numbers: Iterator[int]) -> None:
        """Speak in these words; ``numbers`` go on through the whole sitting."""
        self._wording = wording
        self._numbers = numbers

    def say(self, message: str, script: Script, **variables: str | int) -> None:
        """Have one wording of the message said."""
        sentence, number = self._wording.say(message, **variables), next(self._numbers)
        script.note(happened.SentenceRequested(at_ms=script.at_ms, utterance=number, sentence=sentence))
        script.do(do.Speak(number, sentence))

    def repeat(self, said: do.Speak, script: Script) -> None:
        """Have a sentence said once more."""
        number = next(self._numbers)
        script.note(happened.SentenceRepeated(at_ms=script.at_ms, of=said.utterance, utterance=number))
        script.do(do.Speak(number, said.sentence))
