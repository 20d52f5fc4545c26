"""Keeps the screen lit and the machine awake as long as the kiosk is open.

Law: every way is asked for, none is waited for, and each that fails costs one line in the log and no more.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable
from functools import partial
from typing import Protocol

from kiosk.robot.body import Health

_log = logging.getLogger(__name__)


class Way(Protocol):
    """One way to hold off the screen saver or sleep."""

    @property
    def name(self) -> str:
        """Who holds it off, in words for the experimenter."""
        ...

    def ask(self, told: Callable[[str | None], None]) -> None:
        """Ask for it; ``told`` is called with None when it is granted, or with why it is not. Never blocks."""
        ...

    def release(self) -> None:
        """Take back what was asked for."""
        ...


class Awake:
    """Everything that holds off the screen saver and sleep."""

    def __init__(self, ways: Iterable[Way]) -> None:
        """Ask every way at once."""
        self._ways = tuple(ways)
        self._granted: list[str] = []
        self._refused: list[str] = []
        for way in self._ways:
            way.ask(partial(self._told, way.name))

    @property
    def health(self) -> Health:
        """Whether the screen stays lit, and thanks to whom."""
        if self._granted:
            return Health(well=True, words=f"screen saver and sleep are held off by {', '.join(self._granted)}")
        why = "; ".join(self._refused) or "nobody has answered yet"
        return Health(well=False, words=f"screen saver and sleep are not held off: {why}")

    def release(self) -> None:
        """Let the screen go dark when it would."""
        for way in self._ways:
            way.release()

    def _told(self, name: str, why: str | None) -> None:
        if why is None:
            self._granted.append(name)
            return
        self._refused.append(f"{name}: {why}")
        _log.warning("screen saver and sleep are not held off by %s: %s", name, why)
