"""A robot without hardware for rehearsals: it says everything at once, and fails in every way."""

from __future__ import annotations

from random import Random
from threading import Event, Lock
from typing import ClassVar

from kiosk.experiment.effects import Mood
from kiosk.robots.driver import Capabilities, Capability, FailureKind, RobotDriver, RobotError, RobotVoice, Utterance
from kiosk.robots.embodiment import BoardPoint

FAILS = 0.015
"""How often a call fails before anything is done, while the robot is up."""

BREAKS_OFF = 0.03
"""How often a sentence is broken off after it began; with the calls, about every second session loses the robot."""

BREAKS_OFF_AFTER_S = 0.1
"""How long after its beginning; the robot takes no time for other sentences."""

RETURNS = 0.5
"""How often it is found again when it is looked for."""


class FlakyRobot(RobotDriver):
    """Goes and comes back as a seed says; which call comes first is left to the threads.

    Which sentences it breaks off follows from the seed and their order alone.
    """

    name: ClassVar[str] = "simulated"
    capabilities: ClassVar[frozenset[Capability]] = frozenset({Capability.GESTURES, Capability.GAZE})

    def __init__(self, seed: int, *, fails: float = FAILS, breaks_off: float = BREAKS_OFF) -> None:
        """Up, until it is asked for the first time; calls and sentences fail with these probabilities."""
        self._chance = Random(f"{seed}/robot")
        self._speech = Random(f"{seed}/robot/speech")
        self._fails = fails
        self._breaks_off = breaks_off
        self._lock = Lock()

    def connect(self) -> Capabilities:
        """Be found, or not."""
        self._try("look for", 1 - RETURNS)
        voice = RobotVoice("a voice", "en-US")
        return Capabilities((voice,), (), voice)

    def set_language(self, language: str) -> None:
        """Speak any language."""
        self._try(f"speak {language}")

    def say(self, saying: Utterance) -> None:
        """Say it all at once, or begin and break off; raises RobotError in mid-sentence."""
        breaks_off = self._speech.random() < self._breaks_off
        self._try("say")
        saying.started()
        if breaks_off:
            cut = Event()
            saying.on_cancel(cut.set)
            fault = FailureKind.CUT if cut.wait(BREAKS_OFF_AFTER_S) else FailureKind.DROPPED
            raise RobotError(fault, "say", "in mid-sentence")

    def stop_speech(self) -> None:
        """Be silent."""
        self._try("stop_speech")

    def express(self, mood: Mood) -> None:
        """Accept a mood that has no face to show it."""
        self._try(f"look {mood.value}")

    def look_at(self, place: BoardPoint | None) -> None:
        """Look somewhere."""
        self._try(f"attend {place}")

    def health_check(self) -> None:
        """Still be there."""
        self._try("probe")

    def close(self) -> None:
        """Nothing is open."""

    def _try(self, doing: str, fails: float | None = None) -> None:
        with self._lock:
            if self._chance.random() < (self._fails if fails is None else fails):
                raise RobotError(self._chance.choice(list(FailureKind)), doing)
