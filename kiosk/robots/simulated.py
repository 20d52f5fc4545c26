"""A robot that is not there: it says everything at once, and fails now and then, in every way. For rehearsals."""

from __future__ import annotations

from random import Random
from threading import Lock
from typing import ClassVar

from kiosk.experiment.effects import Mood
from kiosk.robots.embodiment import (
    BoardPoint,
    Capabilities,
    Capability,
    FailureKind,
    RobotDriver,
    RobotError,
    RobotVoice,
    Utterance,
)

FAILS = 0.02
"""How often a call fails while it is up: about every second session loses it."""

RETURNS = 0.5
"""How often it is found again when it is looked for."""


class FlakyRobot(RobotDriver):
    """Goes and comes back as a seed says; which call comes first is left to the threads."""

    name: ClassVar[str] = "simulated"
    capabilities: ClassVar[frozenset[Capability]] = frozenset(Capability)

    def __init__(self, seed: int) -> None:
        """Up, until it is asked for the first time."""
        self._chance = Random(f"{seed}/robot")
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
        """Say it all at once."""
        self._try("say")
        saying.started()

    def stop_speech(self) -> None:
        """Be silent."""
        self._try("stop_speech")

    def express(self, mood: Mood) -> None:
        """Show a mood to nobody."""
        self._try(f"look {mood.value}")

    def look_at(self, place: BoardPoint | None) -> None:
        """Look somewhere."""
        self._try(f"attend {place}")

    def health_check(self) -> None:
        """Still be there."""
        self._try("probe")

    def close(self) -> None:
        """Nothing is open."""

    def _try(self, doing: str, fails: float = FAILS) -> None:
        with self._lock:
            if self._chance.random() < fails:
                raise RobotError(self._chance.choice(list(FailureKind)), doing)
