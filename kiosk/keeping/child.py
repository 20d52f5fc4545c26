"""One start of a program, with everything that it starts in turn: all of them end together, and leave nothing behind.

It is the leader of a process group of its own, and its temporary files go to a folder of its own.
"""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path

from kiosk.keeping.guard import memory_mib
from kiosk.keeping.notice import Notice, listener

_POSIX = sys.platform != "win32"
_ERRORS = 2
"""Standard error, to which a program's own output goes as well: the standard output is the keeper's."""


class Child:
    """A program that was started, and what it tells."""

    def __init__(self, command: Sequence[str], environment: dict[str, str]) -> None:
        """Start it with these additions to the environment; raises OSError if it cannot be started."""
        self._folder = Path(tempfile.mkdtemp(prefix="recollect-keep-"))
        self._listener = listener(self._folder)
        temporary = dict.fromkeys(("TMPDIR", "TEMP", "TMP"), str(self._folder))
        own = os.environ | temporary | self._listener.environment | environment
        try:
            self.process = _start(command, own, self._listener.inherited)
        except OSError:
            self._clear()
            raise

    def hear(self, within_s: float) -> Notice:
        """What it tells next; empty if it tells nothing within this time."""
        return self._listener.hear(within_s)

    def dead(self) -> bool:
        """Whether it has ended; what it started may still run."""
        if _POSIX and self.process.returncode is None:
            # Left unreaped until ``close``, so that nobody else can be given the number of its group.
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
