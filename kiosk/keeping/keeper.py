"""The keeper: one kiosk after another, and underneath them a calm window that is seen while none is up.

A kiosk that dies, that shows nothing in time, that falls silent or that takes too much memory is ended with all that
belongs to it and started again: at once, or after a pause that grows while one after another dies young. The keeper
ends with the kiosk when somebody left it, and when the first one refuses what it was given; a refusal later on, of a
disk that is gone say, is met with patience, for a visitor may stand there.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import Enum

from kiosk import why
from kiosk.keeping.child import Child
from kiosk.keeping.notice import BEAT_WITHIN, Notice, Notifier
from kiosk.keeping.watch import Patience, Watch

LEFT, REFUSED = 0, 2
"""Exit codes of the kiosk: somebody left it; it cannot use what it was given."""

US_PER_S = 1_000_000
BEAT_S = 1.0
"""How often the keeper tells whoever watches it that it is alive."""


class What(Enum):
    """What the keeper tells."""

    STARTED = "started"
    READY = "ready"
    SHOWS = "shows"
    DIED = "died"
    HUNG = "hung"
    SWELLED = "swelled"
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
        self._beats_at = 0.0
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
            self._above.close()
            if self._calm is not None:
                self._calm.close()

    def _run_once(self) -> int | None:
        """Start the kiosk and see it to its end; the exit code, or nothing if it is to be started again."""
        self._starts += 1
        self._happened(What.STARTED)
        try:
            kiosk = Child(self._kiosk, {BEAT_WITHIN: str(int(self._patience.silence * US_PER_S))})
        except OSError as error:
            self._lose(What.DIED, f"it could not be started: {why(error)}", young=True)
            return None
        watch = Watch(kiosk, self._patience)
        taken = 0
        try:
            taken = self._see_to_its_end(kiosk, watch)
        finally:
            hung = not (kiosk.dead() or self._asked_to_end)
            code = kiosk.close()
        if self._asked_to_end:
            return LEFT
        if hung and taken > self._patience.memory_mib:
            self._lose(What.SWELLED, f"{taken} MiB of memory", young=watch.up_s() < self._patience.young)
            return None
        return self._judge(code, watch, hung=hung)

    def _see_to_its_end(self, kiosk: Child, watch: Watch) -> int:
        """Returns how much memory it took when it was looked at last, in MiB."""
        taken = 0
        while not (self._asked_to_end or watch.over() or taken > self._patience.memory_mib):
            self._pass_on(watch.hear())
            taken = kiosk.memory_mib()
        while last_words := watch.hear(0):
            self._pass_on(last_words)
        if self._asked_to_end:
            self._happened(What.TOLD_TO_END)
            _await_end(kiosk, self._patience.end)
        return taken

    def _pass_on(self, notice: Notice) -> None:
        """Tell what the kiosk told, and that the keeper itself is alive."""
        self._beat()
        if "READY" in notice:
            self._was_up = True
            away = None if self._lost_at is None else round(time.monotonic() - self._lost_at, 2)
            self._happened(What.READY, away_s=away)
            self._above.tell(READY=1)
        if "STATUS" in notice:
            self._happened(What.SHOWS, notice["STATUS"])
            self._above.tell(STATUS=notice["STATUS"])

    def _beat(self) -> None:
        now = time.monotonic()
        if now >= self._beats_at:
            self._beats_at = now + BEAT_S
            self._above.tell(WATCHDOG=1)
            if self._calm is not None:
                # Nobody waits for what it tells, but a pipe must not fill up.
                self._calm.hear(0)

    def _judge(self, code: int, watch: Watch, *, hung: bool) -> int | None:
        if not hung and code == LEFT:
            self._happened(What.LEFT)
            return LEFT
        if not hung and code == REFUSED and not self._was_up:
            self._happened(What.REFUSED)
            return REFUSED
        young = watch.up_s() < self._patience.young
        if hung:
            self._lose(What.HUNG, "no sign of life" if watch.up else "no first frame", young=young)
        else:
            self._lose(What.DIED, f"signal {-code}" if code < 0 else f"exit code {code}", young=young)
        return None

    def _lose(self, what: What, how: str, *, young: bool) -> None:
        self._lost_at = time.monotonic()
        self._died_young = self._died_young + 1 if young else 0
        self._happened(what, how)

    def _wait(self) -> None:
        """Pause before the next start, alive to whoever watches the keeper."""
        pause = self._patience.pause(self._died_young)
        if pause:
            self._happened(What.PAUSE, away_s=pause)
        until = time.monotonic() + pause
        while time.monotonic() < until and not self._asked_to_end:
            self._beat()
            time.sleep(self._patience.tick)

    def _show_calm_window(self) -> None:
        """See that the calm window is there before the kiosk comes above it."""
        if self._calm is not None and not self._calm.dead():
            return
        if self._calm is not None:
            self._calm.close()
            self._calm = None
        try:
            self._calm = Child(self._meanwhile, {})
        except OSError:
            self._happened(What.NO_MEANWHILE)
            return
        watch = Watch(self._calm, self._patience)
        until = time.monotonic() + self._patience.meanwhile
        while not (watch.up or watch.over() or time.monotonic() > until or self._asked_to_end):
            watch.hear()
        if not watch.up:
            self._happened(What.NO_MEANWHILE)

    def _happened(self, what: What, detail: str = "", away_s: float | None = None) -> None:
        self._tell(Happening(round(time.monotonic() - self._began, 2), what, self._starts, detail, away_s))


def _await_end(child: Child, within_s: float) -> None:
    child.ask_to_end()
    until = time.monotonic() + within_s
    while not child.dead() and time.monotonic() < until:
        child.hear(0.1)
