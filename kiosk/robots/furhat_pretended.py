"""A Furhat without a robot: a server on this machine that takes requests and speaks in silence.

It takes what the Remote API takes and refuses all else, so that a lab can try a study, the panel and the loss of a
robot before the robot is there. Only this machine reaches it.
"""

from __future__ import annotations

import json
import select
import threading
from collections.abc import Callable
from contextlib import suppress
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from time import monotonic
from types import TracebackType
from typing import Any, ClassVar, Self
from urllib.parse import parse_qsl, urlsplit

import requests

from kiosk.robots.furhat_rules import GESTURES, VOICES, Refused, Request, check

PATIENCE_S = 10
"""How long it waits for a request to be complete, and for a sound that it is to play."""

CHARACTER_MS = 65.0
"""How long a robot speaks for each character, about."""

TICK_S = 0.01


class Handler(BaseHTTPRequestHandler):
    """One connection."""

    robot: ClassVar[PretendedFurhat]
    timeout = PATIENCE_S

    def do_GET(self) -> None:
        """Answer a question."""
        self._handle("GET")

    def do_POST(self) -> None:
        """Do what is asked."""
        self._handle("POST")

    def log_message(self, *_: Any) -> None:
        """Say nothing on standard error."""

    def _handle(self, verb: str) -> None:
        url = urlsplit(self.path)
        pairs = parse_qsl(url.query, keep_blank_values=True)
        content = self.rfile.read(int(self.headers.get("Content-Length") or 0))
        request = Request(monotonic(), verb, url.path, dict(pairs), json.loads(content) if content else None)
        with suppress(OSError):
            self.take(request)

    def take(self, request: Request) -> None:
        """Answer a request as the robot does."""
        self.robot.note(request)
        self.well(request)

    def well(self, request: Request) -> None:
        """Do what is asked, or refuse it with a status."""
        try:
            answer = self.robot.answer(request, self.gone)
        except Refused as refusal:
            self.send(refusal.code, json.dumps({"success": False, "message": str(refusal)}))
            return
        self.send(200, '"hello world"' if request.path == "/furhat" else json.dumps(answer))

    def gone(self, seconds: float) -> bool:
        """Wait a little; return whether the one who asked closed the connection meanwhile."""
        readable, _, _ = select.select([self.connection], [], [], seconds)
        return bool(readable) and not self.connection.recv(1)

    def send(self, code: int, text: str, kind: str = "application/json") -> None:
        """Send an answer."""
        content = text.encode()
        self.send_response(code)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(content)))
        self.end_headers()
        self.wfile.write(content)


class PretendedFurhat:
    """One robot, on a port of the loopback; it serves from the beginning until it is closed."""

    handler: ClassVar[type[Handler]] = Handler

    def __init__(
        self,
        *,
        port: int = 0,
        character_ms: float = CHARACTER_MS,
        voices: dict[str, str] | None = None,
        heard: Callable[[Request], None] = lambda _: None,
    ) -> None:
        """Take any port for 0; ``heard`` is called with each request, on the thread that answers it.

        ``character_ms`` is how long it speaks for each character. Raises OSError if the port is taken.
        """
        self.voices = VOICES if voices is None else voices
        self.gestures = dict(GESTURES)
        self.character_ms = character_ms
        self.refusals: list[str] = []
        self.voice: str | None = None
        self.fetches = True
        """Whether it fetches the sounds that it is to play; one that cannot says that it played them."""
        self.played: list[bytes] = []
        """The sounds that it fetched."""
        self.port = port
        self._heard = heard
        self._changed = threading.Condition()
        self._speaking = 0
        self._closing = threading.Event()
        self._server: ThreadingHTTPServer | None = None
        self.listen()

    def __enter__(self) -> Self:
        """Return itself."""
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        """Stop serving."""
        self.close()

    def close(self) -> None:
        """Let every request that hangs end, and listen no longer."""
        self._closing.set()
        self.stop_listening()

    @property
    def closing(self) -> bool:
        """Whether every request has to end."""
        return self._closing.is_set()

    def note(self, request: Request) -> None:
        """Tell that a request came."""
        self._heard(request)

    def answer(self, request: Request, gone: Callable[[float], bool]) -> Any:
        """Do what is asked and return what the robot says to it.

        ``gone`` waits, and says whether the one who asked has left. Raises Refused.
        """
        try:
            check(request)
        except Refused as refusal:
            self.refusals.append(f"{request.verb} {request.path}: {refusal}")
            raise
        match request.path:
            case "/furhat/gestures":
                return [{"name": name, "duration": duration} for name, duration in self.gestures.items()]
            case "/furhat/voices":
                return [{"name": name, "language": language} for name, language in self.voices.items()]
            case "/furhat/users":
                return [{"id": "1", "rotation": {"x": 0, "y": 0, "z": 0}, "location": {"x": 0, "y": 0, "z": 1}}]
            case "/furhat/voice":
                self.voice = request.parameters["name"]
            case "/furhat/say":
                self._say(request, gone)
        return {"success": True, "message": ""}

    def _say(self, request: Request, gone: Callable[[float], bool]) -> None:
        with self._changed:
            self._speaking += 1
            mine = self._speaking
        if "url" in request.parameters and self.fetches:
            with suppress(requests.RequestException):
                self.played.append(requests.get(request.parameters["url"], timeout=PATIENCE_S).content)
        if request.parameters.get("blocking") != "true":
            return
        over = monotonic() + len(request.parameters.get("text", "")) * self.character_ms / 1000
        # Another sentence ends this one, as abort does.
        while monotonic() < over and self._speaking == mine:
            if gone(min(TICK_S, max(0.0, over - monotonic()))):
                return

    def listen(self) -> None:
        """Begin to serve, unless it does already or is closed."""
        if self._server is not None or self._closing.is_set():
            return
        mine = type("Mine", (self.handler,), {"robot": self})

        class Server(ThreadingHTTPServer):
            allow_reuse_address = True
            daemon_threads = True

            def handle_error(self, *_: Any) -> None:
                """Say nothing: the client has gone."""

        self._server = Server(("127.0.0.1", self.port), mine)
        self.port = self._server.server_port
        threading.Thread(target=self._server.serve_forever, args=(TICK_S,), daemon=True).start()

    def stop_listening(self) -> None:
        """Refuse connections from now on."""
        server, self._server = self._server, None
        if server is not None:
            server.shutdown()
            server.server_close()
