"""A Furhat without a robot that serves the Realtime API: strict about its requests, and able to fail."""

from __future__ import annotations

import json
import threading
from collections.abc import Callable
from contextlib import suppress
from enum import Enum
from socket import SHUT_RDWR
from time import monotonic
from types import TracebackType
from typing import Any, Self

from websockets.exceptions import WebSocketException
from websockets.sync.server import ServerConnection, serve

PATIENCE_S = 10

_FIELDS = {
    "request.auth": {"key"},
    "request.speak.text": {"text", "abort"},
    "request.speak.stop": set(),
    "request.gesture.start": {"name", "intensity", "duration", "monitor"},
    "request.attend.user": {"user_id"},
    "request.attend.location": {"x", "y", "z"},
    "request.attend.nobody": set(),
    "request.led.set": {"color"},
    "request.voice.status": set(),
    "request.voice.config": {"voice_id", "name", "language"},
}


class Mode(Enum):
    """How it answers."""

    WELL = "well"
    HANG = "hang"
    DROP = "drops the connection"
    GARBAGE = "answers nonsense"
    ERROR = "answers with an error"
    FAILED = "says that the speech failed"
    NAMELESS = "does not say which request it answers"


class RealtimeFake:
    """One robot, on a port of the loopback."""

    def __init__(self, *, key: str = "") -> None:
        self.mode = Mode.WELL
        self.requests: list[dict[str, Any]] = []
        self.refusals: list[str] = []
        self._key = key
        self._changed = threading.Condition()
        self._server = serve(self._serve, "127.0.0.1", 0, compression=None, close_timeout=0.1)
        self.port = int(self._server.socket.getsockname()[1])
        self._thread = threading.Thread(target=self._server.serve_forever, daemon=True)
        self._thread.start()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        # It waits for the threads of its connections.
        ending = threading.Thread(target=self._server.shutdown, daemon=True)
        ending.start()
        ending.join(PATIENCE_S)
        assert not ending.is_alive(), "a connection of the robot did not end"

    @property
    def sentences(self) -> list[str]:
        """What it was asked to say."""
        return [request["text"] for request in self.asked("request.speak.text")]

    def asked(self, kind: str) -> list[dict[str, Any]]:
        """Every request of a kind."""
        return [request for request in list(self.requests) if request["type"] == kind]

    def wait_until(self, holds: Callable[[], object]) -> None:
        """Wait for something that a request brings about; fails if it never comes."""
        with self._changed:
            if not self._changed.wait_for(holds, PATIENCE_S):
                raise AssertionError("what was waited for never came")

    def _serve(self, socket: ServerConnection) -> None:
        with suppress(WebSocketException):
            for text in socket:
                self._take(socket, json.loads(text))

    def _take(self, socket: ServerConnection, request: dict[str, Any]) -> None:
        given = set(request) - {"type", "request_id"}
        if request["type"] not in _FIELDS or not given <= _FIELDS[request["type"]]:
            self.refusals.append(json.dumps(request))
        with self._changed:
            self.requests.append(request | {"at": monotonic()})
            self._changed.notify_all()
        for answer in self._answers(request):
            number = {} if self.mode is Mode.NAMELESS else {"request_id": request.get("request_id")}
            socket.send(json.dumps(answer | number))
        if self.mode is Mode.DROP:
            socket.socket.shutdown(SHUT_RDWR)
        if self.mode is Mode.GARBAGE:
            socket.send("[1, 2")

    def _answers(self, request: dict[str, Any]) -> list[dict[str, Any]]:
        if self.mode in {Mode.HANG, Mode.DROP, Mode.GARBAGE}:
            return []
        if self.mode is Mode.ERROR:
            return [{"type": "response.error", "message": "no"}]
        match request["type"]:
            case "request.auth":
                return [{"type": "response.auth", "access": request["key"] == self._key, "scope": "all"}]
            case "request.voice.status":
                return [{"type": "response.voice.status", "voice_id": "Matthew"}]
            case "request.speak.text":
                ended = {"aborted": False, "failed": self.mode is Mode.FAILED}
                return [{"type": "response.speak.start"}, {"type": "response.speak.end", **ended}]
        return []
