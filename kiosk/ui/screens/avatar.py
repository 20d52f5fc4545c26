"""The avatar on the screen: its face, and the body that speaks with it."""

from __future__ import annotations

from itertools import chain, repeat

from PySide6.QtCore import Property, QObject, QTimer, Signal
from PySide6.QtQml import QmlElement

from kiosk.config import Side
from kiosk.experiment.effects import Mood
from kiosk.experiment.outcomes import EmbodimentName
from kiosk.robots import LOUDNESS_MS
from kiosk.robots.embodiment import BoardPoint, Health, SpeechListener
from kiosk.ui.voice import Voice

QML_IMPORT_NAME = "Recollect"
QML_IMPORT_MAJOR_VERSION = 1

PATIENCE_MS = 200
"""When a sentence is not to be heard after this time, the face looks thoughtful; usually it is heard after 50 ms."""


@QmlElement
class AvatarScreen(QObject):
    """What the avatar looks like at this moment."""

    changed = Signal()
    """It came, went, or got a name; apart from the next five, because the whole layout follows."""
    moved = Signal()
    """It begins to come or go, or has done so: what follows it is laid out once, when it is there."""
    felt = Signal()
    """It shows another mood."""
    said = Signal()
    """Another sentence is in the bubble, or none."""
    looked = Signal()
    """The eyes moved."""
    spoke = Signal()
    """The mouth moved, which happens 25 times a second."""
    gestured = Signal(str)
    """It makes a small gesture, ``nod`` or ``wave``."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._present = True
        self._moves = False
        self._mood = Mood.IDLE
        self._bubble = self._advice = ""
        self._ponders = False
        self._gaze = (0.0, 0.0)
        self._glance = (0.0, 0.0)
        self._blinking = False
        self._mouth = 0.0
        self._mouth_shape = ""
        self._feeling: Mood | None = None
        self._away = False
        self._name = ""

    def call(self, name: str) -> None:
        """Give it a name, which stands above what it says; an empty one is not shown."""
        self._name = name
        self.changed.emit()

    def feel(self, mood: Mood | None) -> None:
        """Let its face follow the game while the session shows no mood; None: calm again."""
        if mood is not self._feeling:
            self._feeling = mood
            self.felt.emit()

    def leave(self, *, away: bool) -> None:
        """Turn its back while people rate it, or come back."""
        if away != self._away:
            self._away = away
            self.changed.emit()

    def gesture(self, name: str) -> None:
        """Make a small gesture, ``nod`` or ``wave``."""
        self.gestured.emit(name)

    def appear(self, *, present: bool) -> None:
        """Show the face, or leave the place to another body; the bubble stays."""
        self._moves = True
        self.moved.emit()
        self._present = present
        self.changed.emit()
        self._moves = False
        self.moved.emit()

    def express(self, mood: Mood) -> None:
        """Show a mood."""
        self._mood = mood
        self.felt.emit()

    def say(self, sentence: str, advice: str = "") -> None:
        """Show a sentence in the bubble, with its end that gives advice first; an empty one takes the bubble away."""
        self._bubble, self._advice = sentence, advice
        self.said.emit()

    def clear(self) -> None:
        """Say nothing, and look calmly at the next visitor."""
        self._bubble = self._advice = ""
        self._mood = Mood.IDLE
        self._ponders = self._away = False
        self._feeling = None
        self._gaze = self._glance = (0.0, 0.0)
        self._mouth = 0.0
        self.changed.emit()
        self.felt.emit()
        self.said.emit()
        self.looked.emit()
        self.spoke.emit()

    def look(self, x: float, y: float) -> None:
        """Look left or right and up or down, each from -1 to 1; (0, 0) is at the visitor."""
        self._gaze = (x, y)
        self.looked.emit()

    def glance(self, x: float, y: float) -> None:
        """Let the eyes wander a little, as far as they look at nothing in particular."""
        self._glance = (x, y)
        self.looked.emit()

    def ponder(self, *, ponders: bool) -> None:
        """Look thoughtful for as long as it takes to find words, unless another mood is shown."""
        self._ponders = ponders
        self.felt.emit()

    def blink(self, *, shut: bool) -> None:
        """Shut the lids, or open them."""
        self._blinking = shut
        self.looked.emit()

    def open_mouth(self, how_far: float, shape: str = "") -> None:
        """Open the mouth, from 0 to 1, in the shape of a sound: closed, round, open, wide or teeth."""
        self._mouth, self._mouth_shape = how_far, shape
        self.spoke.emit()

    @Property(bool, notify=changed)
    def present(self) -> bool:
        """Whether the face is shown."""
        return self._present

    @Property(bool, notify=moved)
    def moves(self) -> bool:
        """Whether it comes or goes at this moment."""
        return self._moves

    @Property(str, notify=felt)
    def mood(self) -> str:
        """Return the name of the mood."""
        mood = self._mood
        if mood is Mood.IDLE:
            mood = Mood.THINKING if self._ponders else self._feeling or Mood.IDLE
        return mood.value

    @Property(str, notify=changed)
    def name(self) -> str:
        """Its name; empty if it has none."""
        return self._name

    @Property(bool, notify=changed)
    def away(self) -> bool:
        """Whether its face is out of sight while people rate it."""
        return self._away

    @Property(str, notify=said)
    def bubble(self) -> str:
        """Return the sentence in the bubble; empty for no bubble."""
        return self._bubble

    @Property(str, notify=said)
    def advice(self) -> str:
        """Return the end of the sentence that says what to do; empty where there is none."""
        return self._advice

    @Property(float, notify=looked)
    def gazeX(self) -> float:  # noqa: N802 - QML's convention
        """How far it looks to the right."""
        return self._gaze[0] or self._glance[0]

    @Property(float, notify=looked)
    def gazeY(self) -> float:  # noqa: N802 - QML's convention
        """How far it looks down."""
        return self._gaze[1] if any(self._gaze) else self._glance[1]

    @Property(bool, notify=looked)
    def blinking(self) -> bool:
        """Whether the lids are shut."""
        return self._blinking

    @Property(float, notify=spoke)
    def mouth(self) -> float:
        """How far the mouth is open."""
        return self._mouth

    @Property(str, notify=spoke)
    def mouthShape(self) -> str:  # noqa: N802 - QML's convention
        """Return the shape of the sound that is spoken; empty where only its loudness is known."""
        return self._mouth_shape


class AvatarBody(QObject):
    """The avatar as a body: says a sentence with its voice, and moves its mouth to it."""

    name = EmbodimentName.AVATAR

    def __init__(
        self,
        face: AvatarScreen,
        voice: Voice,
        listener: SpeechListener,
        board: Side = "left",
        parent: QObject | None = None,
    ) -> None:
        """Speak with this voice and this face, report to ``listener``, and look for the board on this side."""
        super().__init__(parent)
        self._left = -1.0 if board == "left" else 0.5
        self._face = face
        self._voice = voice
        self._listener = listener
        self._steps: list[tuple[float, str]] = []
        self._mouth = QTimer(self)
        self._mouth.setInterval(LOUDNESS_MS)
        self._mouth.timeout.connect(self._move_mouth)
        self._searching = QTimer(self)
        self._searching.setSingleShot(True)
        self._searching.setInterval(PATIENCE_MS)
        self._searching.timeout.connect(lambda: self._face.ponder(ponders=True))
        voice.started.connect(self._started)
        voice.finished.connect(self._finished)
        voice.failed.connect(self._failed)

    def set_language(self, language: str) -> None:
        """Speak this language from the next sentence on."""
        self._voice.set_language(language)

    def say(self, utterance: int, sentence: str) -> None:
        """Begin to say a sentence."""
        self._rest()
        self._searching.start()
        self._voice.say(utterance, sentence)

    def stop(self) -> None:
        """Be silent."""
        self._rest()
        self._voice.stop()

    def express(self, mood: Mood) -> None:
        """Show a mood."""
        self._face.express(mood)

    @property
    def health(self) -> Health:
        """The avatar is always there; what it cannot say is read."""
        return Health(is_ok=True, message=f"the avatar is there; {self._voice.health.message}")

    def look_at(self, place: BoardPoint | None) -> None:
        """Look at a place on the board, or at the visitor."""
        self._face.look(*((0.0, 0.0) if place is None else (self._left + place.across * 0.5, place.down * 2 - 1)))

    def activate(self) -> None:
        """Show the face."""
        self._face.appear(present=True)

    def deactivate(self) -> None:
        """Leave the place to another body."""
        self.stop()
        self._face.appear(present=False)

    def reset(self) -> None:
        """Be silent, calm, and look straight ahead."""
        self.stop()
        self._voice.restore()
        self._face.express(Mood.IDLE)
        self._face.look(0, 0)

    def _started(self, utterance: int, loudness: list[float]) -> None:
        self._found_words()
        # An engine may know the loudness alone.
        shapes = chain(self._voice.shapes, repeat(""))
        self._steps = list(zip(loudness, shapes, strict=False))[::-1]
        self._mouth.start()
        self._listener.speech_started(utterance)

    def _finished(self, utterance: int) -> None:
        self._rest()
        self._listener.speech_finished(utterance)

    def _failed(self, utterance: int, why: str) -> None:
        self._rest()
        self._listener.speech_failed(utterance, why)

    def _move_mouth(self) -> None:
        self._face.open_mouth(*(self._steps.pop() if self._steps else (0.0, "")))

    def _found_words(self) -> None:
        self._searching.stop()
        self._face.ponder(ponders=False)

    def _rest(self) -> None:
        self._found_words()
        self._mouth.stop()
        self._face.open_mouth(0.0)
