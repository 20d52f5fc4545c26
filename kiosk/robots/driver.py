"""What a robot's driver is: calls that may block, its capabilities, voices and failures."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from enum import Enum
from threading import Lock
from types import MappingProxyType
from typing import ClassVar

from kiosk.config import ConfigModel
from kiosk.config import RobotConfig as RobotSettings
from kiosk.experiment.effects import Mood
from kiosk.experiment.typed_input import can_be_kept
from kiosk.language_codes import distance
from kiosk.lazy_dataclass import dataclass
from kiosk.robots.embodiment import BoardPoint

LONGEST_TEXT = 999
"""Characters that a robot takes in one request unless its driver says otherwise."""


_DIRECTIONS = frozenset("\u061c\u200e\u200f\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069")
"""Characters that say from which side a text is written: they are for the eye alone. Joiners change words, and stay."""


class FailureKind(Enum):
    """How a robot can fail, in words that go after its name."""

    UNREACHABLE = "cannot be reached"
    SLOW = "did not answer in time"
    DROPPED = "broke off the connection"
    ERROR = "answered with an error"
    DECLINED = "said that it did not do it"
    GARBAGE = "gave an answer that cannot be understood"
    NO_VOICE = "has no voice of the language"
    CUT = "was told to stop"


class RobotError(Exception):
    """The robot did not do what it was asked to; the message is for the experimenter."""

    def __init__(self, fault: FailureKind, doing: str, detail: str = "") -> None:
        """``doing`` is what was asked; ``detail`` is what the robot said to it."""
        super().__init__(f"the robot {fault.value} ({doing}{': ' if detail else ''}{detail[:200]})")
        self.kind = fault


@dataclass(frozen=True)
class RobotVoice:
    """A voice that a robot offers; ``language`` is a code such as en-US, or empty."""

    name: str
    language: str


@dataclass(frozen=True)
class Capabilities:
    """What a robot turned out to have."""

    voices: tuple[RobotVoice, ...]
    gestures: tuple[str, ...]
    voice: RobotVoice | None
    """The voice that it was given."""


class Utterance:
    """A sentence under way, which any thread may cut off."""

    def __init__(self, sentence: str, started: Callable[[], None], longest: int = LONGEST_TEXT) -> None:
        """Call ``started`` once, on any thread, when the robot begins or is asked to.

        No more than ``longest`` characters are said.
        """
        self.sentence = sentence
        self.text = speakable(sentence, longest)
        self.started = started
        self._lock = Lock()
        self._cut = False
        self._end: Callable[[], None] | None = None

    @property
    def is_cancelled(self) -> bool:
        """Whether its end is not waited for any more."""
        return self._cut

    def cancel(self) -> None:
        """Wait for it no longer; the call that waits raises RobotError."""
        with self._lock:
            self._cut = True
            if self._end is not None:
                self._end()

    def on_cancel(self, end: Callable[[], None]) -> None:
        """Have ``end`` called when it is cut, at once if it was cut before; ``end`` may not wait."""
        with self._lock:
            self._end = end
            if self._cut:
                end()


class Capability(Enum):
    """What a driver can have its robot do besides speaking; it is asked for nothing else."""

    GESTURES = "gestures"
    GAZE = "gaze"
    CLIPS = "clips"
    """It plays a sound that it fetches."""


@dataclass(frozen=True)
class SpokenClip:
    """The sound of a sentence as a WAV file, and what spoke it: engine, engine_version, voice and pack."""

    wav: bytes
    duration_ms: int
    spoken_by: Mapping[str, str]


ClipSource = Callable[[str, str], SpokenClip | None]
"""Returns the clip that says a text in a language; None if there is none."""


class RobotDriver(ABC):
    """A robot that can be reached, or not; the base class of every driver.

    Its methods run on threads of their own and may block, up to the deadlines of the settings. They raise RobotError
    for whatever the robot did not do.
    """

    name: ClassVar[str]
    """What study files and records call it: the name that it is registered by."""
    default_port: ClassVar[int | None] = None
    """The port where the study file names none."""
    options: ClassVar[type[ConfigModel]] = ConfigModel
    """The model of its own table in the study file, ``[robot.options]``."""
    capabilities: ClassVar[frozenset[Capability]] = frozenset()
    longest_text: ClassVar[int] = LONGEST_TEXT
    """Characters that it takes in one request; a longer sentence ends at the last word within."""
    clips: ClipSource | None = None
    """Where the clips come from that a driver with CLIPS has the robot play; None: it speaks with its own voice."""
    spoken_by: Mapping[str, str] = MappingProxyType({})
    """What speaks the sentence under way, if it is a clip."""
    on_own_voice: Callable[[str], None] = staticmethod(lambda _: None)
    """Called, on any thread, with the reason why the robot speaks with its own voice where it was to play a clip."""

    on_other_voice: Callable[[str], None] = staticmethod(lambda _: None)
    """Called, on any thread, with what is wrong with the voice that the robot has."""

    def __init__(self, settings: RobotSettings, language: str) -> None:
        """Nothing is sent yet; ``language`` is what it is to speak, as a code such as 'en' or 'pt-BR'."""
        self.settings = settings
        self.language = language

    @property
    def port(self) -> int | None:
        """The port that the study file names, or the driver's own."""
        return self.settings.port or self.default_port

    @abstractmethod
    def connect(self) -> Capabilities:
        """Look for it and get it ready to speak the study's language; needed again after every failure."""

    @abstractmethod
    def say(self, saying: Utterance) -> None:
        """Say a sentence to its end, in place of any other. Never tried twice."""

    def set_language(self, language: str) -> None:
        """Speak this language from now on; where nothing is connected, once it is."""
        self.language = language

    def stop_speech(self) -> None:  # noqa: B027 - a robot may have no way to be stopped
        """Ask it to be silent; whether it obeys is its own affair."""

    def express(self, mood: Mood) -> None:  # noqa: B027 - never asked without the capability
        """Show a mood, as far as it can; asked only of a driver with GESTURES."""

    def look_at(self, place: BoardPoint | None) -> None:  # noqa: B027 - never asked without the capability
        """Look at a place on the board, or at the visitor; asked only of a driver with GAZE."""

    def health_check(self) -> None:  # noqa: B027 - a robot may have no way to be asked
        """See whether it still answers."""

    def close(self) -> None:  # noqa: B027 - nothing may be open
        """Let go of whatever is open; may be called from any thread and twice."""


class InspectableRobot(RobotDriver):
    """A robot that tells what it has without being changed; so it may be asked while it helps."""

    @abstractmethod
    def resolve(self) -> None:
        """Look its name up; raises RobotError."""

    @abstractmethod
    def voices(self) -> tuple[RobotVoice, ...]:
        """Return the voices that it offers; raises RobotError."""

    @abstractmethod
    def gestures(self) -> tuple[str, ...]:
        """Return the names of the gestures that it offers; raises RobotError."""

    @abstractmethod
    def users(self) -> int:
        """How many people it sees; raises RobotError."""


def chosen_voice(voices: tuple[RobotVoice, ...], language: str, wished: str = "") -> RobotVoice:
    """Return the wished voice, or else one nearest to the language.

    Raises RobotError without one.
    """
    if wished:
        matching = [(0, voice) for voice in voices if voice.name == wished]
    else:
        far = ((distance(language, voice.language), voice) for voice in voices)
        matching = [(each, voice) for each, voice in far if each is not None]
    if matching:
        return min(matching, key=lambda each: each[0])[1]
    offered = ", ".join(sorted({voice.language for voice in voices})) or "none"
    raise RobotError(FailureKind.NO_VOICE, wished or language, f"it has {offered}")


def mismatch(voice: RobotVoice, language: str) -> str:
    """Say that a voice is made for another language; empty if it is not, or if it does not tell."""
    if not voice.language or distance(language, voice.language) is not None:
        return ""
    return f"{voice.name} is a voice of {voice.language}, not of {language}"


def speakable(sentence: str, longest: int = LONGEST_TEXT) -> str:
    """Return a sentence as a robot takes it: not too long, without markup, control and direction characters."""
    shown = (character for character in sentence if character not in _DIRECTIONS)
    plain = "".join(" " if character in "<>&" or not can_be_kept(character) else character for character in shown)
    text = " ".join(plain.split())
    return text if len(text) <= longest else text[:longest].rsplit(" ", 1)[0]
