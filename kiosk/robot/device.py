"""A robot as its threads see it: every call blocks, at most until its deadline, and raises RobotFailed if it fails.

Nothing in here may be called from the interface's thread; kiosk/robot/robot_body.py stands between the two.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from threading import Lock
from typing import Protocol

from kiosk.robot.body import Place
from kiosk.study.commands import Mood
from kiosk.study.declared.typed_input import can_be_kept
from kiosk.study.events import BodyName

LONGEST_TEXT = 999
"""Characters that a Furhat is sure to take in one request."""


_DIRECTIONS = frozenset("\u061c\u200e\u200f\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069")
"""Characters that say from which side a text is written: they are for the eye alone. Joiners change words, and stay."""


class Fault(Enum):
    """How a robot can fail, in words that go after its name."""

    UNREACHABLE = "cannot be reached"
    SLOW = "did not answer in time"
    DROPPED = "broke off the connection"
    ERROR = "answered with an error"
    DECLINED = "said that it did not do it"
    GARBAGE = "answered what nobody understands"
    NO_VOICE = "has no voice of the language"
    CUT = "was told to stop"


class RobotFailed(Exception):
    """The robot did not do what it was asked to; the message is for the experimenter."""

    def __init__(self, fault: Fault, doing: str, detail: str = "") -> None:
        """``doing`` is what was asked; ``detail`` is what the robot said to it."""
        super().__init__(f"the robot {fault.value} ({doing}{': ' if detail else ''}{detail[:200]})")
        self.fault = fault


@dataclass(frozen=True)
class RobotVoice:
    """A voice that a robot offers; ``language`` is a code such as en-US, or empty."""

    name: str
    language: str


@dataclass(frozen=True)
class Found:
    """What a robot turned out to have."""

    voices: tuple[RobotVoice, ...]
    gestures: tuple[str, ...]
    voice: RobotVoice | None
    """The voice that it was given."""


class Saying:
    """A sentence under way, which any thread may cut off."""

    def __init__(self, sentence: str, started: Callable[[], None]) -> None:
        """``started`` is called once, on the robot's thread, when the robot has begun or was asked to begin."""
        self.text = speakable(sentence)
        self.started = started
        self._lock = Lock()
        self._cut = False
        self._end: Callable[[], None] | None = None

    @property
    def is_cut(self) -> bool:
        """Whether nobody waits for it any more."""
        return self._cut

    def cut(self) -> None:
        """Wait for it no longer; the call that waits raises RobotFailed."""
        with self._lock:
            self._cut = True
            if self._end is not None:
                self._end()

    def on_cut(self, end: Callable[[], None]) -> None:
        """Have ``end`` called when it is cut, at once if it was cut before; ``end`` may not wait."""
        with self._lock:
            self._end = end
            if self._cut:
                end()


class Robot(Protocol):
    """A robot that can be reached, or not."""

    @property
    def name(self) -> BodyName:
        """What the records call it."""
        ...

    def connect(self) -> Found:
        """Look for it and get it ready to speak the study's language; needed again after every failure."""
        ...

    def speak(self, language: str) -> None:
        """Speak this language from now on; where nothing is connected, once it is."""
        ...

    def say(self, saying: Saying) -> None:
        """Say a sentence to its end, in place of any other. Never tried twice."""
        ...

    def hush(self) -> None:
        """Ask it to be silent; whether it obeys is its own affair."""
        ...

    def express(self, mood: Mood) -> None:
        """Show a mood, as far as it can."""
        ...

    def attend(self, place: Place | None) -> None:
        """Look at a place on the board, or at the visitor."""
        ...

    def probe(self) -> None:
        """See whether it still answers."""
        ...

    def close(self) -> None:
        """Let go of whatever is open; may be called from any thread and twice."""
        ...


def speakable(sentence: str) -> str:
    """A sentence as any robot takes it: below 1,000 characters, without markup, control and direction characters."""
    shown = (character for character in sentence if character not in _DIRECTIONS)
    plain = "".join(" " if character in "<>&" or not can_be_kept(character) else character for character in shown)
    text = " ".join(plain.split())
    return text if len(text) <= LONGEST_TEXT else text[:LONGEST_TEXT].rsplit(" ", 1)[0]
