"""What a look at one thing found, in words for the experimenter: whether it is well, and what to do if it is not.

It stands below the rooms: each looks at its own devices, and whoever shows what they found shows the same words.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from enum import Enum
from typing import Self


class State(Enum):
    """How a thing is."""

    GOOD = "good"
    WARNING = "warning"
    """A sitting can be held, but not as it should be."""
    BAD = "bad"
    """No sitting can be held."""


@dataclass(frozen=True)
class Finding:
    """How one thing is; ``remedy`` is what to do, and empty only of what is good."""

    what: str
    state: State
    words: str
    remedy: str = ""

    @classmethod
    def good(cls, what: str, words: str) -> Self:
        """All is well."""
        return cls(what, State.GOOD, words)

    @classmethod
    def warning(cls, what: str, words: str, remedy: str) -> Self:
        """Something is not as it should be."""
        return cls(what, State.WARNING, words, remedy)

    @classmethod
    def bad(cls, what: str, words: str, remedy: str) -> Self:
        """Nobody can sit down until this is mended."""
        return cls(what, State.BAD, words, remedy)

    @property
    def well(self) -> bool:
        """Whether nothing has to be done."""
        return self.state is State.GOOD


@dataclass(frozen=True)
class Probe:
    """One look at one thing; ``look`` may block, and whoever calls it waits ``within_s`` seconds and no longer."""

    what: str
    look: Callable[[], Iterable[Finding]]
    within_s: float = 5.0
    late: State = State.WARNING
    """How a thing is that does not answer in time."""
