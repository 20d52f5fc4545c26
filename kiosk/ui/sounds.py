"""The short sounds of the game: at most one for what happened at one moment, and none while somebody speaks."""

from __future__ import annotations

from collections.abc import Iterable
from enum import Enum
from pathlib import Path

from kiosk.settings import ASSETS
from kiosk.study import commands as do
from kiosk.study.commands import Command, Wait
from kiosk.study.events import Timer


class Effect(Enum):
    """A sound, by the name of its file; what comes first here goes before the others."""

    END = "end"
    MATCH = "match"
    MISS = "miss"
    FLIP = "flip"

    @property
    def file(self) -> Path:
        """Where it is; packaging/make_sounds.py made it."""
        return ASSETS / "sounds" / f"{self.value}.wav"


def effect(commands: Iterable[Command]) -> Effect | None:
    """The sound for what these commands show; none if they begin a sentence, which is never made to wait."""
    heard: set[Effect] = set()
    for command in commands:
        match command:
            case do.Speak():
                return None
            case do.StartTimer(timer=Timer.FINISH):
                heard.add(Effect.END)
            case do.ShowPair():
                heard.add(Effect.MATCH)
            case do.HoldBoard(wait=Wait.TURNING_BACK):
                heard.add(Effect.MISS)
            case do.TurnUp():
                heard.add(Effect.FLIP)
    return next((sound for sound in Effect if sound in heard), None)
