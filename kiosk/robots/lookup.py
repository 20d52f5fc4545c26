"""Look up a name on the network without waiting longer than a deadline."""

from __future__ import annotations

import socket
from threading import Condition, Thread

from kiosk.robots.driver import FailureKind, RobotError

LOOKUP_S = 3.0
"""How long a driver waits for a name; a robot's own .local name takes up to a second."""


class NameLookup:
    """The address of one host.

    The system alone decides how long a look-up takes, so a thread waits for it. An address that comes after the
    deadline is used by the next call.
    """

    def __init__(self, host: str, port: int) -> None:
        """Nothing is looked up yet."""
        self._host = host
        self._port = port
        self._changed = Condition()
        self._under_way = False
        self._address = ""
        self._error = ""

    def resolve(self, within_s: float | None = None) -> str:
        """Return an IP address of the host; raises RobotError if there is none, or none in time."""
        doing = f"looking up {self._host}"
        within_s = LOOKUP_S if within_s is None else within_s
        with self._changed:
            if not self._under_way and not self._address:
                self._under_way, self._error = True, ""
                Thread(target=self._look, name="robot-name", daemon=True).start()
            if not self._changed.wait_for(lambda: not self._under_way, within_s):
                raise RobotError(FailureKind.UNREACHABLE, doing, f"no answer within {within_s:g} s")
            address, self._address = self._address, ""
            if not address:
                raise RobotError(FailureKind.UNREACHABLE, doing, self._error)
        return address

    def _look(self) -> None:
        address = error = ""
        try:
            address = str(socket.getaddrinfo(self._host, self._port, type=socket.SOCK_STREAM)[0][4][0])
        except (OSError, UnicodeError) as failure:
            error = str(failure)
        with self._changed:
            self._address, self._error, self._under_way = address, error, False
            self._changed.notify_all()
