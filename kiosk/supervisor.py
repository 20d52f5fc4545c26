"""Start the kiosk, listen for its heartbeat, and start it again when it dies or hangs."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import Protocol

from kiosk import why
from kiosk.guard import memory_mib
from kiosk.sd_notify import BEAT_WITHIN, Notice, Notifier, Presence, notify_listener


@dataclass(frozen=True)
class Timeouts:
    """How long the supervisor waits for what; all in seconds."""

    silence: float = 5.0
    """For the next beat, until the kiosk hangs."""
    start: float = 30.0
    """For the first frame."""
    end: float = 5.0
    """For a kiosk that was asked to end."""
    splash: float = 5.0
    """For the calm window."""
    young: float = 10.0
    """A kiosk that dies sooner after its first frame died at once."""
    longest_pause: float = 30.0
    memory_mib: int = 1024
    """What a kiosk may take; it usually takes 160."""
    tick: float = 0.1
    """How often it is seen whether the kiosk is still there."""

    def pause(self, died_young: int) -> float:
        """Before the next start, when so many in a row have died young."""
        return 0.0 if died_young <= 1 else min(2.0 ** (died_young - 2), self.longest_pause)


class NotificationSource(Protocol):
    """A program that tells."""

    def hear(self, within_s: float) -> Notice:
        """Return what it tells next; empty if it tells nothing within this time."""

    def dead(self) -> bool:
        """Whether it has ended."""


class Watchdog:
    """Whether one program is up, and since when it has been silent."""

    def __init__(
        self, child: NotificationSource, patience: Timeouts, clock: Callable[[], float] = time.monotonic
    ) -> None:
        """Watch it from its start on."""
        self._child = child
        self._patience = patience
        self._clock = clock
        self._up_at: float | None = None
        self._left_s = patience.start
        self._looked_at = self._sign_at = clock()

    @property
    def sign_at(self) -> float:
        """When it last gave a sign of life, by the watch's clock; when it was started if it gave none."""
        return self._sign_at

    @property
    def up(self) -> bool:
        """Whether its first frame was drawn."""
        return self._up_at is not None

    def up_s(self) -> float:
        """For how long its first frame has been there; 0 without one."""
        return 0.0 if self._up_at is None else self._clock() - self._up_at

    def hear(self, within_s: float | None = None) -> Notice:
        """Return what it tells next, within a tick unless told otherwise; empty if that is nothing."""
        notice = self._child.hear(self._patience.tick if within_s is None else within_s)
        now = self._clock()
        # Where everything stood still for a while, the supervisor too, silence is no fault of the kiosk's.
        self._left_s -= min(now - self._looked_at, 2 * self._patience.tick)
        self._looked_at = now
        if "READY" in notice and self._up_at is None:
            self._up_at = now
        if self.up and {"READY", "WATCHDOG"} & notice.keys():
            self._left_s = self._patience.silence
            self._sign_at = now
        return notice

    def over(self) -> bool:
        """Whether it is dead, or might as well be."""
        return self._child.dead() or self._left_s <= 0


_POSIX = sys.platform != "win32"
_ERRORS = 2
"""Standard error, to which a program's own output goes as well: the standard output is the supervisor's."""


class ProcessGroup:
    """A program that was started, and what it tells."""

    def __init__(self, command: Sequence[str], environment: dict[str, str]) -> None:
        """Start it with these additions to the environment; raises OSError if it cannot be started."""
        self._folder = Path(tempfile.mkdtemp(prefix="recollect-keep-"))
        self._listener = notify_listener(self._folder)
        temporary = dict.fromkeys(("TMPDIR", "TEMP", "TMP"), str(self._folder))
        own = os.environ | temporary | self._listener.environment | environment
        try:
            self.process = _start(command, own, self._listener.inherited)
        except OSError:
            self._clear()
            raise

    def hear(self, within_s: float) -> Notice:
        """Return what it tells next; empty if it tells nothing within this time."""
        return self._listener.hear(within_s)

    def dead(self) -> bool:
        """Whether it has ended; what it started may still run."""
        if _POSIX and self.process.returncode is None:
            # Left unreaped until ``close``, so that the number of its group is not given to another.
            return os.waitid(os.P_PID, self.process.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is not None
        return self.process.poll() is not None

    def memory_mib(self) -> int:
        """How much memory it takes, without what it started in turn; 0 once it is gone."""
        return memory_mib(self.process.pid)

    def ask_to_end(self) -> None:
        """Ask it to end by itself."""
        if sys.platform == "win32":
            self.process.terminate()
        elif not self.dead():
            os.kill(self.process.pid, signal.SIGTERM)

    def close(self) -> int:
        """End whatever of it still runs, clear away what it left, and return its exit code; negative for a signal."""
        self._kill_all()
        code = self.process.wait()
        self._clear()
        return code

    def _clear(self) -> None:
        self._listener.close()
        shutil.rmtree(self._folder, ignore_errors=True)

    def _kill_all(self) -> None:
        if sys.platform == "win32":
            subprocess.run(  # noqa: S603
                ["taskkill", "/T", "/F", "/PID", str(self.process.pid)],  # noqa: S607 - a program of the system
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                check=False,
            )
        else:
            with suppress(ProcessLookupError):
                os.killpg(self.process.pid, signal.SIGKILL)


def _start(
    command: Sequence[str], environment: Mapping[str, str], inherited: tuple[int, ...]
) -> subprocess.Popen[bytes]:
    """Start a program without input, in a group of its own."""
    if sys.platform == "win32":
        import msvcrt  # noqa: PLC0415 - there is none elsewhere

        handles = [msvcrt.get_osfhandle(descriptor) for descriptor in inherited]
        return subprocess.Popen(  # noqa: S603
            command,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=_ERRORS,
            startupinfo=subprocess.STARTUPINFO(lpAttributeList={"handle_list": handles}),
            creationflags=subprocess.CREATE_NEW_PROCESS_GROUP,
        )
    return subprocess.Popen(  # noqa: S603
        command,
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=_ERRORS,
        pass_fds=inherited,
        start_new_session=True,
    )


LEFT, REFUSED = 0, 2
"""Exit codes of the kiosk: it was left; it cannot use what it was given."""

US_PER_S = 1_000_000
BEAT_S = 1.0
"""How often the supervisor sends a sign of life to its own watcher."""
UNHEARD_SIGNS = 5
"""A watcher that was there and does not get so many in a row is gone."""


class SupervisorEventKind(Enum):
    """What the supervisor tells."""

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
class SupervisorEvent:
    """Something that the supervisor tells."""

    at_s: float
    """Since the supervisor began."""
    what: SupervisorEventKind
    start: int
    """Which start of the kiosk it is about, from 1."""
    detail: str = ""
    """The screen that is shown, or how the kiosk ended."""
    away_s: float | None = None
    """For READY: since the last sign of life of the kiosk before; for HUNG: how long none came.

    For PAUSE: how long it lasts.
    """


class Supervisor:
    """Keeps one kiosk up."""

    def __init__(
        self,
        kiosk: Sequence[str],
        splash: Sequence[str],
        tell: Callable[[SupervisorEvent], None],
        patience: Timeouts | None = None,
    ) -> None:
        """Keep up the kiosk that this command starts, above the calm window that the other command starts."""
        self._kiosk = kiosk
        self._splash = splash
        self._tell = tell
        self._patience = patience or Timeouts()
        self._began = time.monotonic()
        self._calm: ProcessGroup | None = None
        self._above = Notifier(os.environ)
        self._watcher = Presence(UNHEARD_SIGNS)
        self._beats_at = 0.0
        self._lost_at: float | None = None
        self._starts = self._died_young = 0
        self._was_up = self._asked_to_end = False

    def end(self) -> None:
        """Ask for the end; safe in a signal handler."""
        self._asked_to_end = True

    def run(self) -> int:
        """Keep the kiosk up until it is left; returns the exit code of the supervisor."""
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
        """Start the kiosk and wait for its end; return the exit code.

        None means that it is to be started again.
        """
        self._starts += 1
        self._happened(SupervisorEventKind.STARTED)
        try:
            kiosk = ProcessGroup(self._kiosk, {BEAT_WITHIN: str(int(self._patience.silence * US_PER_S))})
        except OSError as error:
            self._lose(SupervisorEventKind.DIED, f"it could not be started: {why(error)}", young=True)
            return None
        watch = Watchdog(kiosk, self._patience)
        taken = 0
        try:
            taken = self._see_to_its_end(kiosk, watch)
        finally:
            hung = not (kiosk.dead() or self._asked_to_end)
            code = kiosk.close()
        if self._asked_to_end:
            return LEFT
        if hung and taken > self._patience.memory_mib:
            self._lose(SupervisorEventKind.SWELLED, f"{taken} MiB of memory", young=watch.up_s() < self._patience.young)
            return None
        return self._judge(code, watch, hung=hung)

    def _see_to_its_end(self, kiosk: ProcessGroup, watch: Watchdog) -> int:
        """Wait for its end, and return its memory at the last look, in MiB."""
        taken = 0
        while not (self._asked_to_end or watch.over() or taken > self._patience.memory_mib):
            self._pass_on(watch.hear())
            taken = kiosk.memory_mib()
        while last_words := watch.hear(0):
            self._pass_on(last_words)
        if self._asked_to_end:
            self._happened(SupervisorEventKind.TOLD_TO_END)
            _await_end(kiosk, self._patience.end)
        return taken

    def _pass_on(self, notice: Notice) -> None:
        """Tell what the kiosk told, and that the supervisor itself is alive."""
        self._beat()
        if "READY" in notice:
            self._was_up = True
            away = None if self._lost_at is None else round(time.monotonic() - self._lost_at, 2)
            self._lost_at = None
            self._happened(SupervisorEventKind.READY, away_s=away)
            self._above.tell(READY=1)
        if "STATUS" in notice:
            self._happened(SupervisorEventKind.SHOWS, notice["STATUS"])
            self._above.tell(STATUS=notice["STATUS"])

    def _beat(self) -> None:
        now = time.monotonic()
        if now >= self._beats_at:
            self._beats_at = now + BEAT_S
            if self._watcher.lost(heard=self._above.tell(WATCHDOG=1)):
                # What watched it will be started again, and starts another supervisor for the same data.
                self.end()
            if self._calm is not None:
                # Its notices are not needed any more, but a pipe must not fill up.
                self._calm.hear(0)

    def _judge(self, code: int, watch: Watchdog, *, hung: bool) -> int | None:
        if not hung and code == LEFT:
            self._happened(SupervisorEventKind.LEFT)
            return LEFT
        if not hung and code == REFUSED and not self._was_up:
            self._happened(SupervisorEventKind.REFUSED)
            return REFUSED
        young = watch.up_s() < self._patience.young
        if hung:
            how = "no sign of life" if watch.up else "no first frame"
            self._lose(SupervisorEventKind.HUNG, how, young=young, silent_since=watch.sign_at)
        else:
            self._lose(SupervisorEventKind.DIED, f"signal {-code}" if code < 0 else f"exit code {code}", young=young)
        return None

    def _lose(self, what: SupervisorEventKind, how: str, *, young: bool, silent_since: float | None = None) -> None:
        now = time.monotonic()
        if self._lost_at is None:
            # A visitor waits from the last sign of life on: the time until a hang was noticed counts,
            # and so does every start since that did not come up.
            self._lost_at = now if silent_since is None else silent_since
        self._died_young = self._died_young + 1 if young else 0
        self._happened(what, how, None if silent_since is None else round(now - silent_since, 2))

    def _wait(self) -> None:
        """Pause before the next start, and go on sending signs of life."""
        pause = self._patience.pause(self._died_young)
        if pause:
            self._happened(SupervisorEventKind.PAUSE, away_s=pause)
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
            self._calm = ProcessGroup(self._splash, {})
        except OSError:
            self._happened(SupervisorEventKind.NO_MEANWHILE)
            return
        watch = Watchdog(self._calm, self._patience)
        until = time.monotonic() + self._patience.splash
        while not (watch.up or watch.over() or time.monotonic() > until or self._asked_to_end):
            watch.hear()
        if not watch.up:
            self._happened(SupervisorEventKind.NO_MEANWHILE)

    def _happened(self, what: SupervisorEventKind, detail: str = "", away_s: float | None = None) -> None:
        self._tell(SupervisorEvent(round(time.monotonic() - self._began, 2), what, self._starts, detail, away_s))


def _await_end(child: ProcessGroup, within_s: float) -> None:
    child.ask_to_end()
    until = time.monotonic() + within_s
    while not child.dead() and time.monotonic() < until:
        child.hear(0.1)
