"""Guard a kiosk that no supervisor keeps: end it when it stands still or takes too much memory."""

from __future__ import annotations

import gc
import os
import select
import signal
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

from kiosk.sd_notify import BEAT_WITHIN, PIPE, SOCKET

BEAT = 0
"""What the pipe carries for a beat; every other byte is the number of a signal."""

MIB = 2**20
_ENDINGS = (signal.SIGINT, signal.SIGTERM)
_READ_BYTES = 4096


@dataclass(frozen=True)
class Limits:
    """What a process may take; times are in seconds."""

    start: float = 30.0
    """Until the first beat."""
    silence: float = 10.0
    """From one beat to the next; closing has no beats, and takes less."""
    end: float = 10.0
    """From being asked to end to the end."""
    stuck: float = 3.0
    """The same for a process that does not even take notice."""
    memory_mib: int = 1024
    """What it may take beyond what it held when the guard began; a kiosk takes 160 MiB in all."""
    tick: float = 0.25


# psutil is loaded where it is used, and by a kiosk in its guard alone, so that the first picture need not wait for it.
# ruff: noqa: PLC0415


def memory_mib(process: int) -> int:
    """How much memory a process takes; 0 if it is gone."""
    import psutil

    try:
        return int(psutil.Process(process).memory_info().rss) // MIB
    except psutil.Error:
        return 0


def _held_mib() -> int | None:
    """How much memory this process takes; None where Linux does not tell.

    Asked before the guard begins: on a busy machine, much of what is to be watched may be taken until it does.
    """
    try:
        return int(Path("/proc/self/statm").read_text("ascii").split()[1]) * os.sysconf("SC_PAGE_SIZE") // MIB
    except OSError:
        return None


def _processor_s(process: int) -> float:
    """How much time on a processor a process has had; 0 if it is gone."""
    import psutil

    try:
        times = psutil.Process(process).cpu_times()
    except psutil.Error:
        return 0.0
    return float(times.user + times.system)


def _is_ready(process: int) -> bool:
    """Whether a process works, or would if it had a processor.

    On a busy machine, silence is no fault of its own.
    """
    import psutil

    try:
        return psutil.Process(process).status() == psutil.STATUS_RUNNING
    except psutil.Error:
        return False


@contextmanager
def guarded(limits: Limits = Limits(), environment: Mapping[str, str] = os.environ) -> Iterator[Callable[[], None]]:
    """Guard this process for as long as this lasts; gives what the event loop calls as its beat.

    Where a supervisor waits for beats already, and on Windows, which cannot fork, the beat does nothing.
    """
    supervised = BEAT_WITHIN in environment and {SOCKET, PIPE} & environment.keys()
    if sys.platform == "win32" or supervised:
        yield lambda: None
        return
    reader, writer = os.pipe()
    guarded_process, held_mib = os.getpid(), _held_mib()
    guard = os.fork()
    if guard == 0:
        _guard(guarded_process, reader, writer, limits, held_mib)
    os.close(reader)
    os.set_blocking(writer, False)
    before = signal.set_wakeup_fd(writer, warn_on_full_buffer=False)
    try:
        yield lambda: _beat(writer)
    finally:
        signal.set_wakeup_fd(before)
        os.close(writer)
        _end(guard)


def _end(guard: int) -> None:
    """End the guard, which would do so by itself unless it is stuck, and could not be waited for then."""
    with suppress(ChildProcessError):
        if os.waitpid(guard, os.WNOHANG) == (0, 0):
            os.kill(guard, signal.SIGKILL)
            os.waitpid(guard, 0)


def _beat(writer: int) -> None:
    # A pipe that is full, or has no reader, is no reason to stop.
    with suppress(OSError):
        os.write(writer, bytes([BEAT]))


def _guard(process: int, reader: int, writer: int, limits: Limits, held_mib: int | None) -> NoReturn:
    """Be the guard; nothing of the process that it was forked from is used, or cleared away."""
    try:
        gc.disable()
        os.close(writer)
        for ending in _ENDINGS:
            # The keys of a terminal reach this process as well.
            signal.signal(ending, signal.SIG_IGN)
        nothing = os.open(os.devnull, os.O_RDWR)
        os.dup2(nothing, 0)
        os.dup2(nothing, 1)
        fault = _watch(process, reader, limits, held_mib)
        if fault and os.getppid() == process:
            with suppress(OSError):
                os.write(2, f"recollect: {fault}, so it was ended\n".encode())
            os.kill(process, signal.SIGKILL)
    finally:
        os._exit(0)


def _watch(process: int, reader: int, limits: Limits, held_mib: int | None) -> str:
    """Read the pipe to its end; returns what is wrong, or nothing if the process has ended by itself."""
    watch = _Watch(limits)
    last, used = time.monotonic(), _processor_s(process)
    before_mib = memory_mib(process) if held_mib is None else held_mib
    while (told := _read(reader, limits.tick)) != b"":
        now = time.monotonic()
        # Where everything stood still for a while, the guard too, silence is no fault of the process's.
        passed, had = min(now - last, 2 * limits.tick), _processor_s(process)
        silent = min(passed, had - used) if _is_ready(process) else passed
        fault = watch.look(passed, told or b"", memory_mib(process) - before_mib, silent)
        last, used = now, had
        if fault:
            return fault
    return ""


class _Watch:
    """What the guard knows of the process."""

    def __init__(self, limits: Limits) -> None:
        self._limits = limits
        self._silent_s = self._asked_s = 0.0
        self._beats = self._asked = self._answered = False

    def look(self, passed_s: float, told: bytes, taken_mib: int, silent_s: float | None = None) -> str:
        """Take in what was told after so much time; returns what is wrong, if anything is.

        ``silent_s`` is how much of the time counts as silence, if not all of it.
        """
        self._silent_s += passed_s if silent_s is None else silent_s
        self._asked_s += passed_s
        for byte in told:
            self._hear(byte)
        limits = self._limits
        if self._asked and self._asked_s >= (limits.end if self._answered else limits.stuck):
            return "it was asked to end and did not"
        if self._silent_s >= (limits.silence if self._beats else limits.start):
            return f"the interface stood still for {self._silent_s:.0f} s"
        if taken_mib > limits.memory_mib:
            return f"it took {taken_mib} MiB of memory and may take {limits.memory_mib}"
        return ""

    def _hear(self, byte: int) -> None:
        if byte == BEAT:
            self._beats, self._silent_s, self._answered = True, 0.0, self._asked
        elif byte in _ENDINGS and not self._asked:
            self._asked, self._asked_s = True, 0.0


def _read(reader: int, within_s: float) -> bytes | None:
    """Return what comes within this time; None if nothing does, and no bytes at the end."""
    ready, _, _ = select.select([reader], [], [], within_s)
    return os.read(reader, _READ_BYTES) if ready else None
