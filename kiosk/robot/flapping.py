"""A robot that is not there: it says everything at once, and fails now and then, in every way. For rehearsals."""

from __future__ import annotations

from random import Random
from threading import Lock
from typing import ClassVar

from kiosk.robot.body import Place
from kiosk.robot.device import Fault, Found, RobotFailed, RobotVoice, Saying
from kiosk.study.commands import Mood
from kiosk.study.events import BodyName

FAILS = 0.02
"""How often a call fails while it is up: about every second sitting loses it."""

RETURNS = 0.5
"""How often it is found again when it is looked for."""


class FlappingRobot:
    """Goes and comes back as a seed says; which call comes first is left to the threads."""

    name: ClassVar[BodyName] = BodyName.FURHAT

    def __init__(self, seed: int) -> None:
        """Up, until it is asked for the first time."""
        self._chance = Random(f"{seed}/robot")
        self._lock = Lock()

    def connect(self) -> Found:
        """Be found, or not."""
        self._try("look for", 1 - RETURNS)
        voice = RobotVoice("a voice", "en-US")
        return Found((voice,), (), voice)

    def speak(self, language: str) -> None:
        """Speak any language."""
        self._try(f"speak {language}")

    def say(self, saying: Saying) -> None:
        """Say it all at once."""
        self._try("say")
        saying.started()

    def hush(self) -> None:
        """Be silent."""
        self._try("hush")

    def express(self, mood: Mood) -> None:
        """Show a mood to nobody."""
        self._try(f"look {mood.value}")

    def attend(self, place: Place | None) -> None:
        """Look somewhere."""
        self._try(f"attend {place}")

    def probe(self) -> None:
        """Still be there."""
        self._try("probe")

    def close(self) -> None:
        """Nothing is open."""

    def _try(self, doing: str, fails: float = FAILS) -> None:
        with self._lock:
            if self._chance.random() < fails:
                raise RobotFailed(self._chance.choice(list(Fault)), doing)
