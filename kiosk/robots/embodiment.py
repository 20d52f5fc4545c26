"""What an embodiment is: who speaks and looks at the player, what it reports, and one that can be muted."""

from __future__ import annotations

from typing import Protocol

from kiosk.experiment.effects import Mood
from kiosk.experiment.outcomes import EmbodimentName
from kiosk.lazy_dataclass import dataclass


@dataclass(frozen=True)
class BoardPoint:
    """A place on the board as the visitor sees it: from 0 (left, top) to 1 (right, bottom)."""

    across: float
    down: float


ASIDE = BoardPoint(4.0, 0.5)
"""Beside the screen and beside the visitor: where a body looks that is being rated."""


@dataclass(frozen=True)
class Health:
    """Whether a body can speak, and how it is, in words for the experimenter."""

    is_ok: bool
    message: str
    is_used: bool = True
    """False for what is switched off on purpose."""


class SpeechListener(Protocol):
    """Hears what becomes of an utterance, started, then finished or failed; and of the body itself."""

    def speech_started(self, utterance: int) -> None:
        """Report that the first sound is out."""
        ...

    def speech_finished(self, utterance: int) -> None:
        """Report that the last sound is out."""
        ...

    def speech_failed(self, utterance: int, why: str) -> None:
        """No further sound will come; ``why`` is for the experimenter."""
        ...

    def robot_lost(self, why: str) -> None:
        """Report that the robot that was to speak cannot be counted on any more."""
        ...


class Embodiment(Protocol):
    """Something that helps with voice and face. Every method returns at once."""

    @property
    def name(self) -> EmbodimentName:
        """What the records call it."""
        ...

    @property
    def health(self) -> Health:
        """How it is."""
        ...

    def set_language(self, language: str) -> None:
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

    def look_at(self, place: BoardPoint | None) -> None:
        """Look at a place on the board, or, with None, at the visitor."""
        ...

    def activate(self) -> None:
        """Be the one who helps, from now on."""
        ...

    def deactivate(self) -> None:
        """Leave it to another body."""
        ...

    def reset(self) -> None:
        """Come to rest after a session: keep nothing of the last visitor."""
        ...


class RobotListener(SpeechListener, Protocol):
    """A listener that hears of the robot's coming as well."""

    def robot_found(self) -> None:
        """Report that the robot can be counted on from now on."""
        ...

    def robot_uses_own_voice(self, why: str) -> None:
        """Report that the robot could not play the clips of the voice pack, and speaks with its own voice."""
        ...

    def robot_has_other_voice(self, why: str) -> None:
        """Report that the robot's voice is not of the language, or not the one of the study file."""
        ...


WHY = "voice and sounds are silent"


class MutableSpeech:
    """Stands before the body that helps, and lets no sentence through while it is shut."""

    def __init__(self, body: Embodiment, listener: SpeechListener) -> None:
        """Report every sentence that will not be heard to ``listener``."""
        self.embodiment = body
        self._listener = listener
        self._shut = False
        self._saying: int | None = None

    @property
    def muted(self) -> bool:
        """Whether no sentence is heard."""
        return self._shut

    def mute(self) -> None:
        """Let nothing be heard from now on; a sentence that is being said breaks off."""
        self._shut = True
        broken_off, self._saying = self._saying, None
        if broken_off is not None:
            self.embodiment.stop()
            self._listener.speech_failed(broken_off, WHY)

    def unmute(self) -> None:
        """Let sentences be heard again, from the next one on."""
        self._shut = False

    def said(self, utterance: int) -> None:
        """Forget a sentence that is not being said any more."""
        if self._saying == utterance:
            self._saying = None

    @property
    def name(self) -> EmbodimentName:
        """What the records call the body."""
        return self.embodiment.name

    @property
    def health(self) -> Health:
        """How the body is."""
        return self.embodiment.health

    def set_language(self, language: str) -> None:
        """Speak this language."""
        self.embodiment.set_language(language)

    def say(self, utterance: int, sentence: str) -> None:
        """Begin to say a sentence, or report at once that it will not be heard."""
        if self._shut:
            self._listener.speech_failed(utterance, WHY)
            return
        self._saying = utterance
        self.embodiment.say(utterance, sentence)

    def stop(self) -> None:
        """Be silent."""
        self._saying = None
        self.embodiment.stop()

    def express(self, mood: Mood) -> None:
        """Show a mood."""
        self.embodiment.express(mood)

    def look_at(self, place: BoardPoint | None) -> None:
        """Look at a place on the board, or at the visitor."""
        self.embodiment.look_at(place)

    def activate(self) -> None:
        """Be the one who helps."""
        self.embodiment.activate()

    def deactivate(self) -> None:
        """Leave it to another body."""
        self._saying = None
        self.embodiment.deactivate()

    def reset(self) -> None:
        """Keep nothing of the last visitor."""
        self._saying = None
        self.embodiment.reset()
