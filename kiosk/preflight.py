"""Preflight checks: what a check returns, and how several of them run at once."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from enum import Enum
from typing import Self


class Severity(Enum):
    """How serious a result is."""

    OK = "ok"
    WARNING = "warning"
    """A session can be held, but not as it should be."""
    ERROR = "error"
    """No session can be held."""


@dataclass(frozen=True)
class CheckResult:
    """What a check found out about one thing.

    ``remedy`` says what to do, and is empty only where all is well.
    """

    name: str
    severity: Severity
    message: str
    remedy: str = ""

    @classmethod
    def ok(cls, name: str, message: str) -> Self:
        """Report that all is well."""
        return cls(name, Severity.OK, message)

    @classmethod
    def warning(cls, name: str, message: str, remedy: str) -> Self:
        """Report something that is not as it should be, though sessions can be held."""
        return cls(name, Severity.WARNING, message, remedy)

    @classmethod
    def error(cls, name: str, message: str, remedy: str) -> Self:
        """Report something without which no session can be held."""
        return cls(name, Severity.ERROR, message, remedy)

    @property
    def is_ok(self) -> bool:
        """Whether nothing has to be done."""
        return self.severity is Severity.OK


@dataclass(frozen=True)
class Check:
    """One look at one thing; ``look`` may block, and the caller waits at most ``within_s`` seconds."""

    what: str
    look: Callable[[], Iterable[CheckResult]]
    within_s: float = 5.0
    late: Severity = Severity.WARNING
    """How a thing is that does not answer in time."""
