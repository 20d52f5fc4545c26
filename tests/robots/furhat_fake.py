"""A strict Furhat without a robot: a server on the loopback that speaks in silence, and fails in whatever way is asked.

``python -m tests.robots.furhat_fake --port 54321 --mode hang --after 8`` runs one in a process of its own.
"""

from __future__ import annotations

import argparse
import json
import select
import sys
import threading
from collections.abc import Callable
from contextlib import suppress
from enum import Enum
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from random import Random
from time import monotonic
from types import TracebackType
from typing import Any, Self
from urllib.parse import parse_qsl, urlsplit

import requests

from tests.robots.furhat_rules import GESTURES, VOICES, Refused, Request, check

PATIENCE_S = 10
"""How long a test waits for something to happen before it fails."""

_TICK_S = 0.01


class Mode(Enum):
    """How it answers."""

    WELL = "well"
    REFUSE = "refuse"
    HANG = "hang"
    SLOW = "slow"
    TRICKLE = "trickle"
    CLIENT_ERROR = "4xx with a status"
    BARE_CLIENT_ERROR = "4xx without a body"
    SERVER_ERROR = "5xx"
    UNSUCCESSFUL = "success false"
    GARBAGE = "garbage"
    PAGE = "a page for people"
    DROP = "dropped half way"
    RESET = "dropped before the answer"
    FLAP = "now this, now that"


FAULTS = tuple(mode for mode in Mode if mode not in {Mode.WELL, Mode.FLAP})


class FurhatFake:
    """One robot, on a port of the loopback."""

    def __init__(
        self,
        *,
        port: int = 0,
        character_ms: float = 0.0,
        slow_ms: int = 60_000,
        seed: int = 0,
        voices: dict[str, str] | None = None,
    ) -> None:
        """``character_ms`` is how long it speaks per character; ``slow_ms`` how long it is slow when it is slow."""
        self.voices = VOICES if voices is None else voices
        self.gestures = dict(GESTURES)
        self.character_ms = character_ms
        self.slow_ms = slow_ms
        self.requests: list[Request] = []
        self.refusals: list[str] = []
        self.voice: str | None = None
        self.fetches = True
        """Whether it fetches the sounds that it is to play; one that cannot says that it played them."""
        self.played: list[bytes] = []
        """The sounds that it fetched."""
        self._rng = Random(seed)
        self._mode = Mode.WELL
        self._armed: tuple[Mode, str, int] | None = None
        self._changed = threading.Condition()
        self._speaking = 0
        self._closing = threading.Event()
        self._server: ThreadingHTTPServer | None = None
        self.port = port
        self._listen()

    def __enter__(self) -> Self:
        """Itself."""
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        """Stop serving."""
        self.close()

    # What a test says

    @property
    def mode(self) -> Mode:
        """How it answers now."""
        return self._mode

    @mode.setter
    def mode(self, mode: Mode) -> None:
        with self._changed:
            self._mode = mode
            self._changed.notify_all()
        self._armed = None
        if mode is Mode.REFUSE:
            self._stop_listening()
        else:
            self._listen()

    def arm(self, mode: Mode, *, path: str = "/furhat", after: int = 0) -> None:
        """Fall into a mode for good when, after so many more requests whose path begins so, another one comes."""
        self._armed = (mode, path, after)

    def restart(self) -> None:
        """Forget what a robot forgets when it is switched off."""
        self.voice = None
        self.mode = Mode.WELL

    def close(self) -> None:
        """Let every request that hangs end, and listen no longer."""
        self._closing.set()
        self._stop_listening()

    # What a test asks

    @property
    def sentences(self) -> list[str]:
        """What it was asked to say."""
        said = (request.parameters.get("text") for request in self.asked("/furhat/say"))
        return [text for text in said if text is not None]

    def asked(self, path: str) -> list[Request]:
        """Every request to a path."""
        return [request for request in list(self.requests) if request.path == path]

    def wait_until(self, holds: Callable[[], object]) -> None:
        """Wait for something that a request or its end may bring about; fails if it never comes."""
        with self._changed:
            if not self._changed.wait_for(holds, PATIENCE_S):
                raise AssertionError("what was waited for never came")

    @property
    def closing(self) -> bool:
        """Whether every request has to end."""
        return self._closing.is_set()

    # How it answers

    def take(self, request: Request) -> Mode:
        """Note a request; returns how to answer it."""
        with self._changed:
            self.requests.append(request)
            self._changed.notify_all()
        if self._armed is not None and request.path.startswith(self._armed[1]):
            mode, path, after = self._armed
            self._armed = (mode, path, after - 1) if after else None
            if not after:
                self.mode = mode
        return self._rng.choice([*FAULTS[1:], *[Mode.WELL] * 300]) if self._mode is Mode.FLAP else self._mode

    def answer(self, request: Request, gone: Callable[[float], bool]) -> Any:
        """Do what is asked; ``gone`` waits, and says whether the one who asked has left. Raises Refused."""
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
            if gone(min(_TICK_S, max(0.0, over - monotonic()))):
                return

    def hang(self, gone: Callable[[float], bool], seconds: float = float("inf")) -> None:
        """Do nothing until the one who asked is gone, the robot is closed, or the time is over."""
        until = monotonic() + seconds
        while not self.closing and monotonic() < until:
            if gone(_TICK_S):
                return

    def _listen(self) -> None:
        if self._server is not None or self._closing.is_set():
            return
        fake = self

        class Handler(_Handler):
            robot = fake

        class Server(ThreadingHTTPServer):
            allow_reuse_address = True
            daemon_threads = True

            def handle_error(self, *_: Any) -> None:
                """Say nothing: the client has gone, as the test wants."""

        self._server = Server(("127.0.0.1", self.port), Handler)
        self.port = self._server.server_port
        threading.Thread(target=self._server.serve_forever, args=(_TICK_S,), daemon=True).start()

    def _stop_listening(self) -> None:
        server, self._server = self._server, None
        if server is not None:
            server.shutdown()
            server.server_close()


class _Handler(BaseHTTPRequestHandler):
    """One request."""

    robot: FurhatFake
    timeout = PATIENCE_S

    def do_GET(self) -> None:
        self._handle("GET")

    def do_POST(self) -> None:
        self._handle("POST")

    def log_message(self, *_: Any) -> None:
        """Say nothing."""

    def _handle(self, verb: str) -> None:
        url = urlsplit(self.path)
        pairs = parse_qsl(url.query, keep_blank_values=True)
        content = self.rfile.read(int(self.headers.get("Content-Length") or 0))
        request = Request(monotonic(), verb, url.path, dict(pairs), json.loads(content) if content else None)
        mode = self.robot.take(request)
        with suppress(OSError):
            _FAILINGS.get(mode, _Handler.well)(self, request)

    def well(self, request: Request) -> None:
        try:
            answer = self.robot.answer(request, self.gone)
        except Refused as refusal:
            self.send(refusal.code, json.dumps({"success": False, "message": str(refusal)}))
            return
        self.send(200, '"hello world"' if request.path == "/furhat" else json.dumps(answer))

    def hang(self, _: Request) -> None:
        self.robot.hang(self.gone)

    def slow(self, request: Request) -> None:
        self.robot.hang(self.gone, self.robot.slow_ms / 1000)
        self.well(request)

    def trickle(self, _: Request) -> None:
        self.wfile.write(b"HTTP/1.1 200 OK\r\nContent-Length: 1000000\r\n\r\n")
        while not self.gone(_TICK_S) and not self.robot.closing:
            self.wfile.write(b" ")

    def drop(self, _: Request) -> None:
        self.wfile.write(
            b'HTTP/1.1 200 OK\r\nContent-Type: application/json\r\nContent-Length: 31\r\n\r\n{"success": true, "mes'
        )

    def gone(self, seconds: float) -> bool:
        """Wait a little; whether the one who asked closed the connection meanwhile."""
        readable, _, _ = select.select([self.connection], [], [], seconds)
        return bool(readable) and not self.connection.recv(1)

    def send(self, code: int, text: str, kind: str = "application/json") -> None:
        content = text.encode()
        self.send_response(code)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(content)))
        self.end_headers()
        self.wfile.write(content)


_FAILINGS: dict[Mode, Callable[[_Handler, Request], None]] = {
    Mode.REFUSE: lambda _handler, _request: None,
    Mode.RESET: lambda _handler, _request: None,
    Mode.HANG: _Handler.hang,
    Mode.SLOW: _Handler.slow,
    Mode.TRICKLE: _Handler.trickle,
    Mode.CLIENT_ERROR: lambda handler, _: handler.send(400, '{"success": false, "message": "no"}'),
    Mode.BARE_CLIENT_ERROR: lambda handler, _: handler.send(404, ""),
    Mode.SERVER_ERROR: lambda handler, _: handler.send(500, "Internal Server Error", "text/plain"),
    Mode.UNSUCCESSFUL: lambda handler, _: handler.send(200, '{"success": false, "message": "no"}'),
    Mode.GARBAGE: lambda handler, _: handler.send(200, '{"success": tru\x00\x01', "application/json"),
    Mode.PAGE: lambda handler, _: handler.send(200, "<!doctype html><title>Router</title>", "text/html"),
    Mode.DROP: _Handler.drop,
}


def main() -> None:
    """Serve until standard input ends; the port is the first line of the output, a mode each line of the input."""
    parser = argparse.ArgumentParser(description="A Furhat without a robot.")
    parser.add_argument("--port", type=int, default=0)
    parser.add_argument("--mode", choices=[mode.name.lower() for mode in Mode], default="well")
    parser.add_argument("--after", type=int, default=0, help="requests that it answers well first")
    parser.add_argument("--path", default="/furhat", help="count only requests whose path begins so")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--character-ms", type=float, default=0.0, help="how long it speaks per character")
    chosen = parser.parse_args()
    with FurhatFake(port=chosen.port, character_ms=chosen.character_ms, seed=chosen.seed) as fake:
        fake.arm(Mode[chosen.mode.upper()], path=chosen.path, after=chosen.after)
        print(fake.port, flush=True)  # noqa: T201 - it is a program
        for line in sys.stdin:
            fake.mode = Mode[line.strip().upper()]


if __name__ == "__main__":
    with suppress(KeyboardInterrupt):
        main()
