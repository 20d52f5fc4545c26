"""Furhat over its Realtime API (WebSocket): requests go out, and each waiting call gets its answer.

The maker does not say how errors look: any answer that speaks of an error, to a request of ours, is one.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from itertools import count
from queue import Empty, SimpleQueue
from threading import Lock, Thread
from time import monotonic
from types import MappingProxyType
from typing import Any, ClassVar

from websockets.exceptions import WebSocketException
from websockets.sync.client import ClientConnection, connect

from kiosk.config import RobotConfig as RobotSettings
from kiosk.experiment.effects import Mood
from kiosk.files import parse_json
from kiosk.language_codes import with_region
from kiosk.robots.driver import Capabilities, Capability, FailureKind, RobotDriver, RobotError, Utterance
from kiosk.robots.embodiment import BoardPoint
from kiosk.robots.furhat import WISHES, to_robot_location
from kiosk.robots.http_client import NameLookup
from kiosk.units import MS_PER_SECOND

PATH = "/v1/events"

_CLOSE_S = 0.2
_CUT: Mapping[str, Any] = MappingProxyType({"type": "cut"})
_DROPPED: Mapping[str, Any] = MappingProxyType({"type": "dropped"})


class _Waiter:
    """One wait for the answers to a request; answers without a number are known by how they begin."""

    def __init__(self, number: str, family: str) -> None:
        self.number = number
        self._family = family
        self._answers: SimpleQueue[Mapping[str, Any]] = SimpleQueue()

    def is_meant(self, message: Mapping[str, Any]) -> bool:
        """Whether a message answers the request."""
        number = message.get("request_id")
        return number == self.number or (number is None and str(message.get("type")).startswith(self._family))

    def hand(self, message: Mapping[str, Any]) -> None:
        """Give it a message; from any thread."""
        self._answers.put(message)

    def next(self, until: float, doing: str) -> Mapping[str, Any]:
        """Return the next answer, before ``until`` on the monotonic clock; raises RobotError."""
        try:
            message = self._answers.get(timeout=max(0.0, until - monotonic()))
        except Empty:
            raise RobotError(FailureKind.SLOW, doing) from None
        if message is _CUT:
            raise RobotError(FailureKind.CUT, doing)
        if message is _DROPPED:
            raise RobotError(FailureKind.DROPPED, doing)
        if "error" in str(message.get("type")) or message.get("error"):
            raise RobotError(FailureKind.ERROR, doing, json.dumps(dict(message)))
        return message


class FurhatRealtime(RobotDriver):
    """A Furhat that serves the Realtime API; it has to be switched on in the robot's own pages."""

    name: ClassVar[str] = "furhat-realtime"
    default_port: ClassVar[int] = 9000
    capabilities: ClassVar[frozenset[Capability]] = frozenset({Capability.GESTURES, Capability.GAZE})

    def __init__(self, settings: RobotSettings, language: str) -> None:
        """Nothing is sent yet; ``language`` is what it is to speak, as a code such as 'en' or 'pt-BR'."""
        super().__init__(settings, language)
        self._settings = settings
        self._language = language
        self._port = settings.port or self.default_port
        self._name = NameLookup(settings.host, self._port)
        self._numbers = count(1)
        self._socket: ClientConnection | None = None
        self._opened = ExitStack()
        self._waiters: list[_Waiter] = []
        self._lock = Lock()

    def connect(self) -> Capabilities:
        """Open the connection anew, sign in if there is a key, and set the voice; raises RobotError."""
        self.close()
        self._open()
        if self._settings.key:
            self._sign_in()
        self._choose_voice()
        self._see_to_voice()
        return Capabilities((), (), None)

    def set_language(self, language: str) -> None:
        """Have it choose a voice of another language; raises RobotError."""
        if language == self._language:
            return
        self._language = language
        if self._socket is not None:
            self._choose_voice()
            self._see_to_voice()

    def health_check(self) -> None:
        """See whether it answers; raises RobotError."""
        self._current_voice()

    def say(self, saying: Utterance) -> None:
        """Say a sentence to its end, in place of any other; raises RobotError."""
        until = monotonic() + self._settings.speech_time(saying.text) / MS_PER_SECOND
        with self._waiting("response.speak") as waiter:
            saying.on_cancel(lambda: waiter.hand(_CUT))
            self._send("request.speak.text", waiter.number, text=saying.text, abort=True)
            while (message := waiter.next(until, "request.speak.text")).get("type") != "response.speak.end":
                if message.get("type") == "response.speak.start":
                    saying.started()
        if message.get("failed") is True or message.get("aborted") is True:
            raise RobotError(FailureKind.DECLINED, "request.speak.text", json.dumps(dict(message)))

    def stop_speech(self) -> None:
        """Ask it to be silent; raises RobotError."""
        self._send("request.speak.stop")

    def express(self, mood: Mood) -> None:
        """Make the gesture for a mood, if there is one; raises RobotError."""
        if self._settings.gestures and WISHES[mood]:
            self._send("request.gesture.start", name=WISHES[mood][0], intensity=1.0, monitor=False)

    def look_at(self, place: BoardPoint | None) -> None:
        """Look at a place on the board, or at the closest person; raises RobotError."""
        if not self._settings.gaze:
            return
        if place is None:
            self._send("request.attend.user", user_id="closest")
        else:
            x, y, z = to_robot_location(place, self._settings)
            self._send("request.attend.location", x=x, y=y, z=z)

    def close(self) -> None:
        """Close the connection, and end every wait."""
        with self._lock:
            self._socket = None
            opened, self._opened = self._opened, ExitStack()
        opened.close()

    def _choose_voice(self) -> None:
        voice = {"name": self._settings.voice} if self._settings.voice else {}
        self._send("request.voice.config", language=with_region(self._language), **voice)

    def _current_voice(self) -> str:
        return str(self._ask("request.voice.status", "response.voice").get("voice_id") or "")

    def _see_to_voice(self) -> None:
        """Report a voice that is not the one of the study file."""
        # What the robot calls it may hold more than its name.
        wished, current = self._settings.voice, self._current_voice()
        if wished and current and wished.casefold() not in current.casefold():
            self.on_other_voice(f"it speaks as {current}, not as {wished}")

    def _sign_in(self) -> None:
        if self._ask("request.auth", "response.auth", key=self._settings.key).get("access") is not True:
            raise RobotError(FailureKind.DECLINED, "request.auth", "the key opens nothing")

    def _open(self) -> None:
        host = self._name.resolve()
        url = f"ws://{f'[{host}]' if ':' in host else host}:{self._port}{PATH}"
        doing = f"opening {url}"
        opened = ExitStack()
        try:
            connecting = connect(
                url,
                open_timeout=self._settings.connect_deadline_ms / MS_PER_SECOND,
                close_timeout=_CLOSE_S,
                ping_interval=None,
                compression=None,
                proxy=None,
            )
            socket = opened.enter_context(connecting)
        except TimeoutError as error:
            raise RobotError(FailureKind.SLOW, doing) from error
        except WebSocketException as error:
            raise RobotError(FailureKind.GARBAGE, doing, str(error)) from error
        except (OSError, ValueError, EOFError) as error:
            raise RobotError(FailureKind.UNREACHABLE, doing, str(error)) from error
        with self._lock:
            self._socket, self._opened = socket, opened
        Thread(target=self._listen, args=(socket,), name="robot-ears", daemon=True).start()

    def _listen(self, socket: ClientConnection) -> None:
        """Hand every message to the wait that it answers, until the connection is gone."""
        with suppress(WebSocketException):
            for text in socket:
                self._hand(_message(text))
        self._hand_to_all(_DROPPED)
        with self._lock:
            if self._socket is socket:
                self._socket = None

    def _hand(self, message: Mapping[str, Any]) -> None:
        with self._lock:
            waiter = next((waiter for waiter in self._waiters if waiter.is_meant(message)), None)
        if waiter is not None:
            waiter.hand(message)

    def _hand_to_all(self, message: Mapping[str, Any]) -> None:
        with self._lock:
            waiters = list(self._waiters)
        for waiter in waiters:
            waiter.hand(message)

    @contextmanager
    def _waiting(self, family: str) -> Iterator[_Waiter]:
        waiter = _Waiter(f"recollect-{next(self._numbers)}", family)
        with self._lock:
            self._waiters.append(waiter)
        try:
            yield waiter
        finally:
            with self._lock:
                self._waiters.remove(waiter)

    def _ask(self, kind: str, family: str, **what: Any) -> Mapping[str, Any]:
        """Send a request and wait for its answer."""
        until = monotonic() + self._settings.answer_deadline_ms / MS_PER_SECOND
        with self._waiting(family) as waiter:
            self._send(kind, waiter.number, **what)
            return waiter.next(until, kind)

    def _send(self, kind: str, number: str | None = None, **what: Any) -> None:
        with self._lock:
            socket = self._socket
        request = {"type": kind, "request_id": number or f"recollect-{next(self._numbers)}", **what}
        try:
            if socket is None:
                raise ConnectionError("it was closed")
            socket.send(json.dumps(request))
        except (WebSocketException, OSError) as error:
            raise RobotError(FailureKind.DROPPED, kind, str(error)) from error


def _message(text: str | bytes) -> Mapping[str, Any]:
    """Return what came, or something that answers no request if it is no message."""
    try:
        message = parse_json(text)
    except ValueError:
        return {}
    return message if isinstance(message, dict) else {}
