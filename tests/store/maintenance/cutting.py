"""A program that withdraws participants and is killed at a step: a test has every step tried.

It reads orders, one a line, and forks for each, which saves loading everything anew. A step is a statement that SQLite
is to run, a file that is opened, renamed or removed, or unused bytes of the database that are zeroed. ``page`` has the
system end it instead when it writes that page of the database, or a later one, as a checkpoint does.
"""

from __future__ import annotations

import json
import os
import resource
import signal
import sys
from contextlib import suppress
from pathlib import Path
from typing import Any

from kiosk.store import codes, connecting, remnants
from kiosk.store.withdrawal import withdraw
from tests.store.visitors import CHEAP

PAGE = 4096
_FILE_EVENTS = {"open", "os.rename", "os.remove", "sqlite3.connect"}


class Steps:
    """Counts the steps, and ends the program before one of them."""

    def __init__(self, last: int | None) -> None:
        """``last`` is the step that is never taken; without one all are."""
        self._last = last
        self.taken = 0

    def take(self) -> None:
        """One more."""
        self.taken += 1
        if self.taken == self._last:
            os.kill(os.getpid(), signal.SIGKILL)


def cut(folder: str, code: str, step: int | None, page: int | None) -> None:
    """Withdraw, up to a step or a page."""
    steps = Steps(step)
    execute, zero = connecting.Connection.execute, remnants.Pages.zero

    def counted(self: connecting.Connection, sql: str, parameters: Any = (), /) -> Any:
        steps.take()
        if page is not None and sql.startswith("PRAGMA wal_checkpoint"):
            # Only from here on: the log itself is longer than the database.
            signal.signal(signal.SIGXFSZ, signal.SIG_DFL)
            resource.setrlimit(resource.RLIMIT_FSIZE, ((page - 1) * PAGE, resource.RLIM_INFINITY))
        done = execute(self, sql, parameters)
        resource.setrlimit(resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
        return done

    def zeroed(self: remnants.Pages, number: int, page: bytes, begin: int, end: int) -> bool:
        if any(page[begin:end]):
            steps.take()
        return zero(self, number, page, begin, end)

    remnants.Pages.zero = zeroed  # type: ignore[method-assign]
    connecting.Connection.execute = counted  # type: ignore[method-assign]  # that is where the steps are
    sys.addaudithook(lambda event, _: steps.take() if event in _FILE_EVENTS else None)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    withdraw(Path(folder), code)


def main() -> None:
    """Fork for every order, and say whether it came to its end."""
    # As in the process that gave the codes.
    codes._COST = CHEAP
    for line in sys.stdin:
        order = json.loads(line)
        child = os.fork()
        if child == 0:
            with suppress(BaseException):
                cut(**order)
                os._exit(0)
            os._exit(1)
        _, status = os.waitpid(child, 0)
        sys.stdout.write(json.dumps(-os.WTERMSIG(status) if os.WIFSIGNALED(status) else os.WEXITSTATUS(status)) + "\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
