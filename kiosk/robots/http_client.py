"""Look a robot's name up and ask it over HTTP, within deadlines that nothing can exceed, and say what failed."""

from __future__ import annotations

import socket
from collections.abc import Callable, Mapping
from contextlib import closing
from http.client import HTTPException, IncompleteRead, RemoteDisconnected
from threading import Condition, Thread
from time import monotonic
from typing import Any

import requests
from requests.adapters import HTTPAdapter
from urllib3 import exceptions as below
from urllib3.connection import HTTPConnection
from urllib3.connectionpool import HTTPConnectionPool

from kiosk.robots.driver import FailureKind, RobotError
from kiosk.units import MS_PER_SECOND

LARGEST = 1_000_000
"""Bytes; more than this is no answer of a robot."""

_CHUNK = 65_536

LOOKUP_S = 3.0
"""How long a driver waits for a name; a robot's own .local name takes up to a second."""


class Call:
    """One request under way: its deadline, and the socket by which it can be cut."""

    def __init__(self, within_s: float, sent: Callable[[], None] | None = None) -> None:
        """``within_s`` seconds from now it must be over; ``sent`` is called when the request is out."""
        self.until = monotonic() + within_s
        self.sent = sent
        self.was_cancelled = False
        self.socket: _Socket | None = None

    @property
    def left_s(self) -> float:
        """The seconds that are left; 0 or less when there are none."""
        return self.until - monotonic()

    def check(self) -> None:
        """Raise TimeoutError if no time is left, or the call was cut."""
        if self.left_s <= 0 or self.was_cancelled:
            raise TimeoutError("the call is over")

    def cancel(self) -> None:
        """End it, from whatever thread."""
        self.was_cancelled = True
        if self.socket is not None:
            self.socket.end()


class _Socket(socket.socket):
    """A socket that waits for every single byte only as long as the whole call may last."""

    call: Call

    def recv_into(self, *args: Any, **options: Any) -> int:
        """As any socket does, within what is left of the call's time."""
        self.call.check()
        self.settimeout(max(self.call.left_s, 0.001))
        return super().recv_into(*args, **options)

    def end(self) -> None:
        """Wake the thread that waits for this socket."""
        try:
            self.shutdown(socket.SHUT_RDWR)
        except OSError:
            # It is closed already, or was never connected: no thread waits for it.
            return


class _Connection(HTTPConnection):
    """A connection that belongs to one call."""

    call: Call

    def _new_conn(self) -> socket.socket:
        plain = super()._new_conn()
        timed = _Socket(fileno=plain.detach())
        timed.call = self.call
        timed.settimeout(max(self.call.left_s, 0.001))
        self.call.socket = timed
        if self.call.was_cancelled:
            # It was cut before there was a socket to end.
            timed.end()
        return timed

    def getresponse(self) -> Any:
        """Wait for the answer; by now the request is out."""
        if self.call.sent is not None:
            self.call.sent()
        return super().getresponse()


class _Pool(HTTPConnectionPool):
    ConnectionCls = _Connection
    call: Call

    def _new_conn(self) -> Any:
        connection = super()._new_conn()
        if isinstance(connection, _Connection):
            connection.call = self.call
        return connection


class _Adapter(HTTPAdapter):
    """Gives one call a connection of its own."""

    def __init__(self, call: Call, host: str, port: int) -> None:
        super().__init__(max_retries=0)
        self._pool = _Pool(host, port)
        self._pool.call = call

    def get_connection_with_tls_context(self, *_: Any, **__: Any) -> HTTPConnectionPool:
        """Return the connection of this call, wherever the request says it goes."""
        return self._pool

    def close(self) -> None:
        """Close the connection."""
        self._pool.close()
        super().close()


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


class HttpClient:
    """A host and port that requests go to."""

    def __init__(self, host: str, port: int, connect_ms: int) -> None:
        """Take a host and port without looking a name up; connecting may take ``connect_ms``."""
        self._name = NameLookup(host, port)
        self._port = port
        self._connect_s = connect_ms / MS_PER_SECOND
        self._address = host

    @property
    def address(self) -> str:
        """The IP address that the name was found to have."""
        return self._address

    def resolve(self) -> None:
        """Look the name up, once for all calls that follow; raises RobotError."""
        self._address = self._name.resolve()

    def request(
        self,
        call: Call,
        verb: str,
        path: str,
        parameters: Mapping[str, str] | None = None,
        body: Mapping[str, Any] | None = None,
    ) -> tuple[int, bytes]:
        """Send one request and return the code and content of its answer; raises RobotError."""
        host = f"[{self._address}]" if ":" in self._address else self._address
        url = f"http://{host}:{self._port}{path}"
        headers = {"Connection": "close", "Accept": "application/json"}
        adapter = _Adapter(call, self._address, self._port)
        try:
            prepared = requests.Request(
                verb, url, headers, params=parameters, json=dict(body) if body else None
            ).prepare()
            timeout = (min(self._connect_s, max(call.left_s, 0.001)), max(call.left_s, 0.001))
            with closing(adapter), adapter.send(prepared, stream=True, timeout=timeout) as answer:
                return answer.status_code, _content(answer)
        except (requests.RequestException, below.HTTPError, OSError) as error:
            raise RobotError(_fault(error, call), f"{verb} {path}", _innermost(error)) from error


def _content(answer: requests.Response) -> bytes:
    content = b""
    for piece in answer.iter_content(_CHUNK):
        content += piece
        if len(content) > LARGEST:
            raise requests.exceptions.ContentDecodingError("the answer has no end")
    return content


def _fault(error: BaseException, call: Call) -> FailureKind:
    """Return the kind of a failure; one that took up the whole time is slow, whatever it is called."""
    causes = tuple(_causes(error))
    if call.was_cancelled:
        return FailureKind.CUT
    if call.socket is None:
        return FailureKind.UNREACHABLE
    if call.left_s <= 0 or any(isinstance(cause, TimeoutError | requests.Timeout) for cause in causes):
        return FailureKind.SLOW
    if isinstance(error, requests.exceptions.ContentDecodingError) or any(_is_no_http(cause) for cause in causes):
        return FailureKind.GARBAGE
    return FailureKind.DROPPED


def _is_no_http(cause: BaseException) -> bool:
    return isinstance(cause, HTTPException) and not isinstance(cause, RemoteDisconnected | IncompleteRead)


def _causes(error: BaseException) -> list[BaseException]:
    """Return an error and every error within it or before it."""
    found: list[BaseException] = []
    waiting: list[object] = [error]
    while waiting:
        cause = waiting.pop()
        if isinstance(cause, BaseException) and cause not in found:
            found.append(cause)
            waiting += [*cause.args, cause.__cause__, cause.__context__, getattr(cause, "reason", None)]
    return found


def _innermost(error: BaseException) -> str:
    return str(_causes(error)[-1] if isinstance(error, requests.ConnectionError) else error)
