"""Send service notices in the words of systemd's sd_notify: READY, WATCHDOG, STATUS, STOPPING.

A notice is lines of ``NAME=value``. It goes to the Unix datagram socket that NOTIFY_SOCKET names, systemd's or the
supervisor's own; on Windows, which has none, it goes to a pipe whose handle is in PIPE. It never waits and never
fails.
"""

from __future__ import annotations

import os
import queue
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Protocol

SOCKET, PIPE, BEAT_WITHIN = "NOTIFY_SOCKET", "RECOLLECT_NOTIFY_PIPE", "WATCHDOG_USEC"
"""In the environment: where notices go, and within how many microseconds the next WATCHDOG=1 is expected."""

NOTICE_BYTES = 4096

Notice = dict[str, str]


class Notifier:
    """The sending end; it sends nothing where no supervisor listens."""

    def __init__(self, environment: Mapping[str, str]) -> None:
        """Send to the socket or pipe that this environment names."""
        self._socket: socket.socket | None = None
        self._pipe: int | None = None
        if SOCKET in environment:
            self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
            self._socket.settimeout(0)
            # An @ stands for the 0 with which the name of an abstract socket begins.
            self._address = environment[SOCKET].replace("@", "\0", 1)
        elif PIPE in environment:
            self._pipe = _writer(int(environment[PIPE]))

    def tell(self, **notice: object) -> bool:
        """Send one notice, and return whether there is a receiver; one that is full does not get it."""
        lines = "\n".join(f"{name}={_one_line(value)}" for name, value in notice.items()).encode()[:NOTICE_BYTES]
        try:
            if self._socket is not None:
                self._socket.sendto(lines, self._address)
            elif self._pipe is not None:
                os.write(self._pipe, lines + b"\n")
            else:
                return False
        except BlockingIOError:
            return True
        except OSError:
            return False
        return True

    def close(self) -> None:
        """Tell nothing more."""
        if self._socket is not None:
            self._socket.close()
        elif self._pipe is not None:
            os.close(self._pipe)
        self._socket = self._pipe = None


class Presence:
    """Whether those who heard a program are still there, by what became of its signs of life."""

    def __init__(self, patience: int) -> None:
        """They are lost after so many signs in a row that were not heard."""
        self._patience = patience
        self._was_heard = False
        self._unheard = 0

    def lost(self, *, heard: bool) -> bool:
        """Take in what became of the latest sign; those who never heard any cannot be lost."""
        self._was_heard = self._was_heard or heard
        self._unheard = 0 if heard else self._unheard + 1
        return self._was_heard and self._unheard >= self._patience


def _one_line(value: object) -> str:
    return " ".join(str(value).split())


def _writer(handle: int) -> int:
    """Return the file descriptor of a pipe that was inherited."""
    if sys.platform == "win32":
        import msvcrt  # noqa: PLC0415 - there is none elsewhere

        return msvcrt.open_osfhandle(handle, os.O_WRONLY)
    return handle


class NotifyListener(Protocol):
    """The hearing end, made anew for every start of a program."""

    environment: dict[str, str]
    """What the program must find in its environment."""
    inherited: tuple[int, ...]
    """The file descriptors that it must inherit."""

    def hear(self, within_s: float) -> Notice:
        """Return the next notice; empty if none came within this time."""

    def close(self) -> None:
        """Hear nothing more."""


class NotifySocketListener:
    """A Unix datagram socket in a folder of one's own."""

    inherited: tuple[int, ...] = ()

    def __init__(self, folder: Path) -> None:
        """Listen in this folder."""
        self._path = folder / "notice"
        self._path.unlink(missing_ok=True)
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self._socket.bind(str(self._path))
        self.environment = {SOCKET: str(self._path)}

    def hear(self, within_s: float) -> Notice:
        """Return the next notice; empty if none came within this time."""
        self._socket.settimeout(within_s)
        try:
            return parse_notification(self._socket.recv(NOTICE_BYTES))
        except (TimeoutError, BlockingIOError):
            return {}

    def close(self) -> None:
        """Hear nothing more."""
        self._socket.close()
        self._path.unlink(missing_ok=True)


class NotifyPipeListener:
    """A pipe that the program inherits, read by a thread: a pipe cannot be waited for everywhere."""

    def __init__(self) -> None:
        """Make the pipe."""
        self._reader, self._writer = os.pipe()
        self.inherited: tuple[int, ...] = (self._writer,)
        self.environment = {PIPE: str(_handle(self._writer))}
        self._heard: queue.SimpleQueue[Notice] = queue.SimpleQueue()
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self) -> None:
        with os.fdopen(self._reader, "rb") as lines:
            for line in lines:
                self._heard.put(parse_notification(line))

    def hear(self, within_s: float) -> Notice:
        """Return the next notice; empty if none came within this time."""
        try:
            return self._heard.get(timeout=within_s) if within_s else self._heard.get_nowait()
        except queue.Empty:
            return {}

    def close(self) -> None:
        """Hear nothing more: the thread ends with the last program that could tell anything."""
        os.close(self._writer)


def _handle(descriptor: int) -> int:
    """Return what a program that inherits a pipe knows it by."""
    if sys.platform == "win32":
        import msvcrt  # noqa: PLC0415 - there is none elsewhere

        handle = msvcrt.get_osfhandle(descriptor)
        os.set_handle_inheritable(handle, True)  # noqa: FBT003 - the system's signature
        return handle
    return descriptor


def notify_listener(folder: Path) -> NotifyListener:
    """Return the hearing end that this system has."""
    return NotifySocketListener(folder) if sys.platform != "win32" else NotifyPipeListener()


def parse_notification(notice: bytes) -> Notice:
    """Return a notice by its names; whatever is no line of one is left out."""
    lines = (line.partition("=") for line in notice.decode(errors="replace").splitlines())
    return {name: value for name, equals, value in lines if equals}


RELAY_TICK_S = 0.2
RELAY_PATIENCE = 2 / 3
"""The part of systemd's own patience after which a command that fell silent is ended."""
_US_PER_S = 1_000_000


def relay(command: Sequence[str], environment: Mapping[str, str] = os.environ) -> int:
    """Run a command, send its notices on as one's own, and return its exit code, negative for a signal.

    systemd drops notices from processes that a login session has taken out of their service, but not those of the
    service's main process. It does not end them either. So where it wants signs of life, a command that falls silent
    after its first one is ended here, with all that it has started. A request to end goes to all of the process group.
    """
    patience_s = int(environment.get(BEAT_WITHIN, 0)) / _US_PER_S * RELAY_PATIENCE or float("inf")
    above = Notifier(environment)
    with tempfile.TemporaryDirectory(prefix="recollect-relay-") as folder:
        listener = notify_listener(Path(folder))
        given = {**environment, **listener.environment}
        child = subprocess.Popen(command, env=given, pass_fds=listener.inherited)  # noqa: S603

        def pass_on(number: int, _frame: object) -> None:
            signal.signal(number, signal.SIG_IGN)
            if sys.platform != "win32" and os.getpgrp() == os.getpid():
                os.killpg(0, number)
            else:
                child.send_signal(number)

        before = {number: signal.signal(number, pass_on) for number in (signal.SIGINT, signal.SIGTERM)}
        try:
            silence = _Silence(patience_s)
            while child.poll() is None:
                if notice := listener.hear(RELAY_TICK_S):
                    above.tell(**notice)
                if silence.is_too_long(notice):
                    _kill_tree(child.pid)
            while last_words := listener.hear(0):
                above.tell(**last_words)
        finally:
            for number, handler in before.items():
                signal.signal(number, handler)
            listener.close()
            above.close()
    return child.returncode


class _Silence:
    """How long a command has given no sign of life, since its first one."""

    def __init__(self, patience_s: float) -> None:
        self._patience_s = patience_s
        self._silent_s: float | None = None
        self._looked_at = time.monotonic()

    def is_too_long(self, notice: Notice) -> bool:
        """Take in what was heard within a tick, and return whether the command is to be given up."""
        now = time.monotonic()
        if {"READY", "WATCHDOG"} & notice.keys():
            self._silent_s = 0.0
        elif self._silent_s is not None:
            # Time in which the whole machine stood still is no silence.
            self._silent_s += min(now - self._looked_at, 2 * RELAY_TICK_S)
        self._looked_at = now
        return self._silent_s is not None and self._silent_s > self._patience_s


def _kill_tree(root: int) -> None:
    """Kill a process and all that it has started, also what is in another group or session."""
    import psutil  # noqa: PLC0415 - the calm window, which tells notices as well, is to load fast

    with suppress(psutil.NoSuchProcess):
        process = psutil.Process(root)
        for each in (process, *process.children(recursive=True)):
            with suppress(psutil.NoSuchProcess):
                each.kill()
