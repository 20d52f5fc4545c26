"""Preflight checks: what a check returns, and how several of them run at once."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from enum import Enum
from typing import Self


class Severity(Enum):
    """How a thing is."""

    GOOD = "good"
    WARNING = "warning"
    """A session can be held, but not as it should be."""
    BAD = "bad"
    """No session can be held."""


@dataclass(frozen=True)
class CheckResult:
    """How one thing is; ``remedy`` is what to do, and empty only of what is good."""

    what: str
    state: Severity
    words: str
    remedy: str = ""

    @classmethod
    def good(cls, what: str, words: str) -> Self:
        """All is well."""
        return cls(what, Severity.GOOD, words)

    @classmethod
    def warning(cls, what: str, words: str, remedy: str) -> Self:
        """Something is not as it should be."""
        return cls(what, Severity.WARNING, words, remedy)

    @classmethod
    def bad(cls, what: str, words: str, remedy: str) -> Self:
        """Nobody can sit down until this is mended."""
        return cls(what, Severity.BAD, words, remedy)

    @property
    def well(self) -> bool:
        """Whether nothing has to be done."""
        return self.state is Severity.GOOD


@dataclass(frozen=True)
class Check:
    """One look at one thing; ``look`` may block, and whoever calls it waits ``within_s`` seconds and no longer."""

    what: str
    look: Callable[[], Iterable[CheckResult]]
    within_s: float = 5.0
    late: Severity = Severity.WARNING
    """How a thing is that does not answer in time."""
