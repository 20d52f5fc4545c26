"""A mouth that can be shut, whosever it is: what would be said is left to be read, and everything else goes on."""

from __future__ import annotations

from kiosk.robot.body import Body, Health, Listener, Place
from kiosk.study.commands import Mood
from kiosk.study.events import BodyName

WHY = "voice and sounds are silent"


class Mouth:
    """Stands before the body that helps, and lets no sentence through while it is shut."""

    def __init__(self, body: Body, listener: Listener) -> None:
        """``listener`` hears of every sentence that it will not be heard."""
        self.body = body
        self._listener = listener
        self._shut = False
        self._saying: int | None = None

    @property
    def shut(self) -> bool:
        """Whether no sentence is heard."""
        return self._shut

    def shut_up(self) -> None:
        """Let nothing be heard from now on; a sentence that is being said breaks off."""
        self._shut = True
        broken_off, self._saying = self._saying, None
        if broken_off is not None:
            self.body.stop()
            self._listener.speech_failed(broken_off, WHY)

    def open(self) -> None:
        """Let sentences be heard again, from the next one on."""
        self._shut = False

    def said(self, utterance: int) -> None:
        """It is not being said any more."""
        if self._saying == utterance:
            self._saying = None

    @property
    def name(self) -> BodyName:
        """What the records call the body."""
        return self.body.name

    @property
    def health(self) -> Health:
        """How the body is."""
        return self.body.health

    def speak(self, language: str) -> None:
        """Speak this language."""
        self.body.speak(language)

    def say(self, utterance: int, sentence: str) -> None:
        """Begin to say a sentence, or report at once that it will not be heard."""
        if self._shut:
            self._listener.speech_failed(utterance, WHY)
            return
        self._saying = utterance
        self.body.say(utterance, sentence)

    def stop(self) -> None:
        """Be silent."""
        self._saying = None
        self.body.stop()

    def express(self, mood: Mood) -> None:
        """Show a mood."""
        self.body.express(mood)

    def attend(self, place: Place | None) -> None:
        """Look at a place on the board, or at the visitor."""
        self.body.attend(place)

    def appear(self) -> None:
        """Be the one who helps."""
        self.body.appear()

    def withdraw(self) -> None:
        """Leave it to another body."""
        self._saying = None
        self.body.withdraw()

    def rest(self) -> None:
        """Keep nothing of the last visitor."""
        self._saying = None
        self.body.rest()
