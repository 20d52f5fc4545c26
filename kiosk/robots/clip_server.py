"""A clip of the voice pack for a robot that plays what it fetches from an address."""

from __future__ import annotations

import secrets
import socket
import threading
from collections.abc import Callable
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from types import TracebackType
from typing import Any, ClassVar, Self

_TICK_S = 0.02
_DISCARD_PORT = 9
_PATIENCE_S = 5
"""A robot that takes longer to send its request, or to take the clip, has gone."""


def own_address(peer: str) -> str:
    """Return the address of this machine that a peer reaches it by; nothing is sent. Raises OSError."""
    family = socket.AF_INET6 if ":" in peer else socket.AF_INET
    with socket.socket(family, socket.SOCK_DGRAM) as way:
        way.connect((peer, _DISCARD_PORT))
        return str(way.getsockname()[0])


class ClipServer:
    """Serves one clip at one address to one peer, as long as it is entered.

    The address cannot be guessed. A connection from elsewhere is closed unanswered, and every other path is not found.
    """

    def __init__(self, wav: bytes, peer: str, port: int, fetched: Callable[[], None]) -> None:
        """Serve to ``peer``, an IP address; ``port`` 0 is any free one. ``fetched`` is called once, on any thread."""
        self._wav = wav
        self._peer = peer
        self._port = port
        self._fetched = fetched
        self._lock = threading.Lock()
        self._server: ThreadingHTTPServer | None = None
        self.is_fetched = False
        """Whether the peer has been sent the whole clip."""

    def __enter__(self) -> Self:
        """Listen on the address that the peer reaches; raises OSError."""
        self.path = f"/{secrets.token_urlsafe(16)}.wav"
        host = own_address(self._peer)
        self._server = _server_class(self._peer)((host, self._port), _handler_class(self))
        shown = f"[{host}]" if ":" in host else host
        self.url = f"http://{shown}:{self._server.server_address[1]}{self.path}"
        threading.Thread(target=self._server.serve_forever, args=(_TICK_S,), daemon=True).start()
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        """Listen no more."""
        if self._server is not None:
            self._server.shutdown()
            self._server.server_close()

    @property
    def wav(self) -> bytes:
        """The clip."""
        return self._wav

    def note_fetched(self) -> None:
        """Note that the peer has the clip."""
        with self._lock:
            is_first, self.is_fetched = not self.is_fetched, True
        if is_first:
            self._fetched()


def _server_class(peer: str) -> type[ThreadingHTTPServer]:
    class Server(ThreadingHTTPServer):
        address_family = socket.AF_INET6 if ":" in peer else socket.AF_INET
        daemon_threads = True
        block_on_close = False

        def verify_request(self, request: Any, client_address: Any) -> bool:  # noqa: ARG002 - the base's signature
            """Whether the connection is the robot's."""
            return bool(client_address[0] == peer)

        def handle_error(self, request: Any, client_address: Any) -> None:
            """Nothing: a robot that breaks off gets no clip, which is noticed where it was asked to say it."""

    return Server


def _handler_class(clips: ClipServer) -> type[BaseHTTPRequestHandler]:
    class Handler(BaseHTTPRequestHandler):
        timeout: ClassVar[int] = _PATIENCE_S

        def do_GET(self) -> None:
            """Send the clip."""
            if self._begin():
                self.wfile.write(clips.wav)
                clips.note_fetched()

        def do_HEAD(self) -> None:
            """Say how long the clip is."""
            self._begin()

        def log_message(self, format: str, *args: Any) -> None:  # noqa: A002 - the base's signature
            """Nothing is logged of a request."""

        def _begin(self) -> bool:
            if self.path != clips.path:
                self.send_error(HTTPStatus.NOT_FOUND)
                return False
            self.send_response(HTTPStatus.OK)
            self.send_header("Content-Type", "audio/wav")
            self.send_header("Content-Length", str(len(clips.wav)))
            self.end_headers()
            return True

    return Handler
