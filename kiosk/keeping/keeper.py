"""The keeper: one kiosk after another, and underneath them a calm window that is seen while none is up.

A kiosk that dies, that shows nothing in time, or that falls silent is ended with all that belongs to it and started
again: at once, or after a pause that grows while one after another dies young. The keeper ends with the kiosk when
somebody left it, and when the first one refuses what it was given; a refusal later on, of a disk that is gone say, is
met with patience, for a visitor may stand there.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import Enum

from kiosk.keeping.child import Child
from kiosk.keeping.notice import BEAT_WITHIN, Notice, Notifier

LEFT, REFUSED = 0, 2
"""Exit codes of the kiosk: somebody left it; it cannot use what it was given."""

US_PER_S = 1_000_000


@dataclass(frozen=True)
class Patience:
    """How long the keeper waits for what; all in seconds."""

    silence: float = 5.0
    """For the next beat, until the kiosk hangs."""
    start: float = 30.0
    """For the first frame."""
    end: float = 5.0
    """For a kiosk that was asked to end."""
    meanwhile: float = 5.0
    """For the calm window."""
    young: float = 10.0
    """A kiosk that dies sooner after its first frame died at once."""
    longest_pause: float = 30.0
    tick: float = 0.1
    """How often it is seen whether the kiosk is still there."""

    def pause(self, died_young: int) -> float:
        """Before the next start, when so many in a row have died young."""
        return 0.0 if died_young <= 1 else min(2.0 ** (died_young - 2), self.longest_pause)


class What(Enum):
    """What the keeper tells."""

    STARTED = "started"
    READY = "ready"
    SHOWS = "shows"
    DIED = "died"
    HUNG = "hung"
    PAUSE = "pause"
    LEFT = "left"
    REFUSED = "refused"
    TOLD_TO_END = "told to end"
    NO_MEANWHILE = "no calm window"


@dataclass(frozen=True)
class Happening:
    """Something that the keeper tells."""

    at_s: float
    """Since the keeper began."""
    what: What
    start: int
    """Which start of the kiosk it is about, from 1."""
    detail: str = ""
    """The screen that is shown, or how the kiosk ended."""
    away_s: float | None = None
    """For READY: since the kiosk before was seen to be dead or to hang; for PAUSE: how long it lasts."""


class Keeper:
    """Keeps one kiosk up."""

    def __init__(
        self,
        kiosk: Sequence[str],
        meanwhile: Sequence[str],
        tell: Callable[[Happening], None],
        patience: Patience | None = None,
    ) -> None:
        """Keep up the kiosk that this command starts, above the calm window that the other command starts."""
        self._kiosk = kiosk
        self._meanwhile = meanwhile
        self._tell = tell
        self._patience = patience or Patience()
        self._began = time.monotonic()
        self._calm: Child | None = None
        self._above = Notifier(os.environ)
        self._lost_at: float | None = None
        self._starts = self._died_young = 0
        self._was_up = self._asked_to_end = False

    def end(self) -> None:
        """Ask for the end; safe in a signal handler."""
        self._asked_to_end = True

    def run(self) -> int:
        """Keep the kiosk up until it is left; returns the exit code for whoever started the keeper."""
        try:
            while True:
                self._show_calm_window()
                code = self._run_once()
                if code is not None:
                    return code
                self._wait()
                if self._asked_to_end:
                    return LEFT
        finally:
            self._above.tell(STOPPING=1)
            if self._calm is not None:
                self._calm.close()

    def _run_once(self) -> int | None:
        """Start the kiosk and see it to its end; the exit code, or nothing if it is to be started again."""
        self._starts += 1
        self._happened(What.STARTED)
        kiosk = Child(self._kiosk, {BEAT_WITHIN: str(int(self._patience.silence * US_PER_S))})
        watch = _Watch(kiosk, self._patience)
        try:
            while not (self._asked_to_end or watch.over()):
                self._hear(watch)
            if self._asked_to_end:
                self._happened(What.TOLD_TO_END)
                _await_end(kiosk, self._patience.end)
        finally:
            hung = not (kiosk.dead() or self._asked_to_end)
            code = kiosk.close()
        return LEFT if self._asked_to_end else self._judge(code, watch, hung=hung)

    def _hear(self, watch: _Watch) -> None:
        notice = watch.hear()
        self._above.tell(WATCHDOG=1)
        if self._calm is not None:
            self._calm.hear(0)
        if "READY" in notice:
            self._was_up = True
            away = None if self._lost_at is None else round(time.monotonic() - self._lost_at, 2)
            self._happened(What.READY, away_s=away)
            self._above.tell(READY=1)
        if "STATUS" in notice:
            self._happened(What.SHOWS, notice["STATUS"])
            self._above.tell(STATUS=notice["STATUS"])

    def _judge(self, code: int, watch: _Watch, *, hung: bool) -> int | None:
        if not hung and code == LEFT:
            self._happened(What.LEFT)
            return LEFT
        if not hung and code == REFUSED and not self._was_up:
            self._happened(What.REFUSED)
            return REFUSED
        self._lost_at = time.monotonic()
        self._died_young = self._died_young + 1 if watch.up_s() < self._patience.young else 0
        if hung:
            self._happened(What.HUNG, "no sign of life" if watch.up_s() else "no first frame")
        else:
            self._happened(What.DIED, f"signal {-code}" if code < 0 else f"exit code {code}")
        return None

    def _wait(self) -> None:
        """Pause before the next start, alive to whoever watches the keeper."""
        pause = self._patience.pause(self._died_young)
        if pause:
            self._happened(What.PAUSE, away_s=pause)
        until = time.monotonic() + pause
        while time.monotonic() < until and not self._asked_to_end:
            self._above.tell(WATCHDOG=1)
            time.sleep(self._patience.tick)

    def _show_calm_window(self) -> None:
        """See that the calm window is there before the kiosk comes above it."""
        if self._calm is not None and not self._calm.dead():
            return
        if self._calm is not None:
            self._calm.close()
        self._calm = Child(self._meanwhile, {})
        watch = _Watch(self._calm, self._patience)
        until = time.monotonic() + self._patience.meanwhile
        while not (watch.up or watch.over() or time.monotonic() > until or self._asked_to_end):
            watch.hear()
        if not watch.up:
            self._happened(What.NO_MEANWHILE)

    def _happened(self, what: What, detail: str = "", away_s: float | None = None) -> None:
        self._tell(Happening(round(time.monotonic() - self._began, 2), what, self._starts, detail, away_s))


class _Watch:
    """Whether one program is up, and since when it has been silent."""

    def __init__(self, child: Child, patience: Patience) -> None:
        self._child = child
        self._patience = patience
        self._up_at: float | None = None
        self._left_s = patience.start
        self._looked_at = time.monotonic()

    @property
    def up(self) -> bool:
        """Whether its first frame was drawn."""
        return self._up_at is not None

    def up_s(self) -> float:
        """For how long its first frame has been there; 0 without one."""
        return 0.0 if self._up_at is None else time.monotonic() - self._up_at

    def hear(self) -> Notice:
        """What it tells within a tick."""
        notice = self._child.hear(self._patience.tick)
        now = time.monotonic()
        # Where everything stood still for a while, the keeper too, nobody is to blame for having been silent.
        self._left_s -= min(now - self._looked_at, 2 * self._patience.tick)
        self._looked_at = now
        if "READY" in notice and self._up_at is None:
            self._up_at = now
        if self.up and {"READY", "WATCHDOG"} & notice.keys():
            self._left_s = self._patience.silence
        return notice

    def over(self) -> bool:
        """Whether it is dead, or might as well be."""
        return self._child.dead() or self._left_s <= 0


def _await_end(child: Child, within_s: float) -> None:
    child.ask_to_end()
    until = time.monotonic() + within_s
    while not child.dead() and time.monotonic() < until:
        child.hear(0.1)
