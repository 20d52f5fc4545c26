"""The assistant on the screen: a face, a bubble and a voice, and so a body like any other.

Its mouth follows the loudness of the sound.
"""

from __future__ import annotations

from PySide6.QtCore import Property, QObject, QTimer, Signal
from PySide6.QtQml import QmlElement

from kiosk.robot.body import Listener
from kiosk.robot.speech import LOUDNESS_MS
from kiosk.study.commands import Mood
from kiosk.ui.voice import Voice

QML_IMPORT_NAME = "Recollect"
QML_IMPORT_MAJOR_VERSION = 1


@QmlElement
class AvatarScreen(QObject):
    """What the avatar looks like at this moment."""

    changed = Signal()
    spoke = Signal()
    """The mouth moved; apart from ``changed``, because it happens 25 times a second."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._mood = Mood.IDLE
        self._bubble = ""
        self._gaze = (0.0, 0.0)
        self._blinking = False
        self._mouth = 0.0

    def express(self, mood: Mood) -> None:
        """Show a mood."""
        self._mood = mood
        self.changed.emit()

    def say(self, sentence: str) -> None:
        """Show a sentence in the bubble; an empty one takes the bubble away."""
        self._bubble = sentence
        self.changed.emit()

    def look(self, x: float, y: float) -> None:
        """Look left or right and up or down, each from -1 to 1; (0, 0) is at the visitor."""
        self._gaze = (x, y)
        self.changed.emit()

    def blink(self, *, shut: bool) -> None:
        """Shut the lids, or open them."""
        self._blinking = shut
        self.changed.emit()

    def open_mouth(self, how_far: float) -> None:
        """Open the mouth, from 0 to 1."""
        self._mouth = how_far
        self.spoke.emit()

    @Property(str, notify=changed)
    def mood(self) -> str:
        """The name of the mood."""
        return self._mood.value

    @Property(str, notify=changed)
    def bubble(self) -> str:
        """The sentence in the bubble; empty for no bubble."""
        return self._bubble

    @Property(float, notify=changed)
    def gazeX(self) -> float:  # noqa: N802 - QML's convention
        """How far it looks to the right."""
        return self._gaze[0]

    @Property(float, notify=changed)
    def gazeY(self) -> float:  # noqa: N802 - QML's convention
        """How far it looks down."""
        return self._gaze[1]

    @Property(bool, notify=changed)
    def blinking(self) -> bool:
        """Whether the lids are shut."""
        return self._blinking

    @Property(float, notify=spoke)
    def mouth(self) -> float:
        """How far the mouth is open."""
        return self._mouth


class AvatarBody(QObject):
    """The avatar as a body: says a sentence with its voice, and moves its mouth to it."""

    name = "avatar"

    def __init__(self, face: AvatarScreen, voice: Voice, listener: Listener, parent: QObject | None = None) -> None:
        """Speak with this voice and this face, and report to ``listener``."""
        super().__init__(parent)
        self._face = face
        self._voice = voice
        self._listener = listener
        self._loudness: list[float] = []
        self._mouth = QTimer(self)
        self._mouth.setInterval(LOUDNESS_MS)
        self._mouth.timeout.connect(self._move_mouth)
        voice.started.connect(self._started)
        voice.finished.connect(self._finished)
        voice.failed.connect(self._failed)

    def say(self, utterance: int, sentence: str) -> None:
        """Begin to say a sentence."""
        self._rest()
        self._voice.say(utterance, sentence)

    def stop(self) -> None:
        """Be silent."""
        self._rest()
        self._voice.stop()

    def express(self, mood: Mood) -> None:
        """Show a mood."""
        self._face.express(mood)

    def _started(self, utterance: int, loudness: list[float]) -> None:
        self._loudness = loudness[::-1]
        self._mouth.start()
        self._listener.speech_started(utterance)

    def _finished(self, utterance: int) -> None:
        self._rest()
        self._listener.speech_finished(utterance)

    def _failed(self, utterance: int, why: str) -> None:
        self._rest()
        self._listener.speech_failed(utterance, why)

    def _move_mouth(self) -> None:
        self._face.open_mouth(self._loudness.pop() if self._loudness else 0.0)

    def _rest(self) -> None:
        self._mouth.stop()
        self._face.open_mouth(0.0)
