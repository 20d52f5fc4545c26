"""Publish the booth's status to an MQTT broker, and watch the booths that do.

A booth dials out and only publishes: it subscribes to nothing, so that nothing from outside can change it.
"""

from __future__ import annotations

import ipaddress
import json
import logging
import re
import socket
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass, replace
from datetime import datetime
from hmac import compare_digest
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from ssl import SSLError
from typing import TYPE_CHECKING, Any

from kiosk import UserInputError, why
from kiosk.config import ASSETS, Remote, read_broker
from kiosk.experiment.booth_status import CLOSED, BoothStatus

if TYPE_CHECKING:
    from types import ModuleType

    from paho.mqtt.client import Client, MQTTMessage, MQTTMessageInfo

LOST = b"lost"
"""What the broker publishes in a booth's place when the connection breaks: the last will."""

KEEPALIVE_S = 5
"""How often the connection is tried; after half as long again without an answer the broker gives it up."""

BACKOFF_S = (1, 30)
"""The first and the longest pause before the broker is tried again; each is twice the last."""

QUEUED = 8
"""How many messages may wait for a slow network; a status that finds no room is left out, as the next comes soon."""

CLOSING_S = 1.0

HUNG_S = 12.0
"""A booth publishes every five seconds; after so long without a word, but with a connection, it hangs."""

MOST_BOOTHS = 500
LONGEST = 65_536
"""Bytes of a message that is looked at."""

_NAME = re.compile(r"[\w.-]{1,64}")

_log = logging.getLogger(__name__)


def booth_name(settings: Remote, site: str) -> str:
    """Return what the booth is called: its name in the study file, or its site, or that of the machine."""
    return re.sub(r"[^\w.-]", "-", settings.booth or site or socket.gethostname())[:64]


class StatusPublisher:
    """One booth's connection to the broker, on a thread of its own; nothing here waits for the network."""

    def __init__(self, settings: Remote, booth: str, beside: Callable[[str], Path]) -> None:
        """Begin to dial; ``beside`` finds the files that the study file names. Raises UserInputError for bad ones."""
        self._topic = f"{settings.topic}/{booth}"
        self._broker = settings.mqtt
        self._last: bytes | None = None
        self._waiting: deque[MQTTMessageInfo] = deque()
        self._gone = threading.Event()
        self._closing = False
        self._trouble = "no connection yet"
        self._client = connect(settings, beside)
        self._client.will_set(self._topic, LOST, qos=1, retain=True)
        self._client.on_connect = self._connected
        self._client.on_disconnect = self._disconnected
        dial(self._client, settings)

    @property
    def trouble(self) -> str:
        """Why the broker cannot be reached; empty while it is."""
        return self._trouble

    def publish(self, status: BoothStatus) -> None:
        """Publish this status, or the next one if the network is slow."""
        self._last = status.to_json().encode()
        while self._waiting and self._waiting[0].is_published():
            self._waiting.popleft()
        if self._client.is_connected() and len(self._waiting) < QUEUED:
            self._waiting.append(self._client.publish(self._topic, self._last, qos=0, retain=True))

    def close(self) -> None:
        """Say goodbye, if the broker is there; a second is the longest that this takes."""
        there = self._client.is_connected()
        self._closing = True
        # An orderly goodbye makes no last will.
        self._client.disconnect()
        if there:
            self._gone.wait(CLOSING_S)

    def _connected(self, client: Client, _data: object, _flags: object, reason: Any, _properties: object) -> None:
        if reason.is_failure:
            self._tell(str(reason))
            return
        _log.info("the status is published to %s as %s", self._broker, self._topic)
        self._trouble = ""
        # What waited for the old connection is out of date.
        self._waiting.clear()
        if self._last is not None:
            client.publish(self._topic, self._last, qos=0, retain=True)

    def _disconnected(self, _client: Client, _data: object, _flags: object, reason: Any, _properties: object) -> None:
        self._gone.set()
        if not self._closing:
            self._tell(_lost(reason))

    def _tell(self, trouble: str) -> None:
        if trouble != self._trouble:
            _log.warning("the status is not published to %s: %s", self._broker, trouble)
        self._trouble = trouble


def connect(settings: Remote, beside: Callable[[str], Path]) -> Client:
    """Return a client that knows how to reach the broker, but does not try yet.

    Raises UserInputError if paho-mqtt is missing, or a file that the settings name cannot be used.
    """
    paho = _paho()
    host, _, tls = read_broker(settings.mqtt)
    client: Client = paho.Client(paho.CallbackAPIVersion.VERSION2, reconnect_on_failure=True)
    client.reconnect_delay_set(*BACKOFF_S)
    client.connect_timeout = KEEPALIVE_S
    client.max_queued_messages_set(QUEUED)
    if settings.user or settings.password_file:
        if not tls and not _is_here(host):
            raise UserInputError("remote: a password is sent over TLS alone; write the broker as mqtts://...")
        client.username_pw_set(settings.user, _password(settings, beside))
    if tls:
        named = {key: beside(name) for key in ("ca", "certificate", "key") if (name := getattr(settings, key))}
        for key, file in named.items():
            if not file.is_file():
                raise UserInputError(f"remote.{key}: there is no file {file}")
        files = {key: str(file) for key, file in named.items()}
        try:
            client.tls_set(files.get("ca"), files.get("certificate"), files.get("key"))
        except (OSError, SSLError, ValueError) as error:
            raise UserInputError(f"remote: the certificates cannot be used: {error}") from error
    return client


def dial(client: Client, settings: Remote) -> None:
    """Connect, and again whenever the connection is lost, on the client's own thread."""
    host, port, _ = read_broker(settings.mqtt)
    client.connect_async(host, port, keepalive=KEEPALIVE_S)
    client.loop_start()


def _lost(reason: Any) -> str:
    """Say in words why a connection ended; paho has none for one that broke."""
    return "the connection was lost" if str(reason) == "Unspecified error" else str(reason)


def _paho() -> ModuleType:
    try:
        from paho.mqtt import client  # noqa: PLC0415 - an extra
    except ImportError as error:
        raise UserInputError("MQTT needs paho-mqtt: pip install 'recollect[remote]'") from error
    return client


def _password(settings: Remote, beside: Callable[[str], Path]) -> str | None:
    if not settings.password_file:
        return None
    file = beside(settings.password_file)
    try:
        return file.read_text("utf-8").strip()
    except (OSError, ValueError) as error:
        reason = why(error) if isinstance(error, OSError) else "it is no text"
        raise UserInputError(f"remote.password_file: {file} cannot be read: {reason}") from error


def _is_here(host: str) -> bool:
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"


_ALARMS = {
    "robot_lost": "the robot is lost",
    "voice_lost": "no sentence is heard",
    "disk_low": "the disk has not enough room for another hour",
    "early_exits": "three sessions in a row ended early",
    "restarted": "the kiosk failed and was started again",
    "clock_changed": "the clock was changed",
    "backup_old": "the last copy is older than a day",
    "no_visitor": "no visitor for a long time",
}
"""The alarms in words; a newer booth may have others."""


@dataclass(frozen=True)
class SeenBooth:
    """What is known of a booth; ``heard_s`` is a time of the watcher's clock."""

    name: str
    status: BoothStatus | None = None
    heard_s: float = 0.0
    lost: bool = False

    def state(self, now_s: float) -> str:
        """Return well, trouble, hung, lost or closed; lost is unplugged or killed."""
        if self.lost or self.status is None:
            return "lost"
        if self.status.stage == CLOSED:
            return "closed"
        if now_s - self.heard_s > HUNG_S:
            return "hung"
        return "trouble" if self.troubles else "well"

    @property
    def troubles(self) -> list[str]:
        """Say in words what is not well: the alarms that hold, and the parts that fail."""
        if self.status is None:
            return []
        alarms = (_ALARMS.get(alarm.kind, alarm.kind.replace("_", " ")) for alarm in self.status.holding_alarms)
        return [*alarms, *(f"{part.name}: {part.message}" for part in self.status.failing)]

    def row(self, now_s: float, *, connected: bool) -> dict[str, Any]:
        """Return the booth as lists show it; without a connection to the broker nothing is known of now."""
        row = {
            "booth": self.name,
            "state": self.state(now_s) if connected else "unknown",
            "stage": "",
            "minutes": 0,
            "paused": False,
            "today": {},
            "trouble": self.troubles,
            "heard_s": round(now_s - self.heard_s),
        }
        if self.status is None:
            return row
        lasted = self.status.age_s(datetime.fromisoformat(self.status.stage_since))
        # Both times are the booth's, so that no clock has to agree with another.
        minutes = round((now_s - self.heard_s - lasted) // 60)
        now = {"stage": self.status.stage, "minutes": max(0, minutes), "paused": self.status.paused}
        return row | now | {"today": asdict(self.status.today)}


class BoothWatch:
    """Every booth that publishes to one broker, as it is heard of."""

    def __init__(
        self, settings: Remote, beside: Callable[[str], Path] = Path, now_s: Callable[[], float] = time.monotonic
    ) -> None:
        """Begin to dial; raises UserInputError as ``connect`` does."""
        self._topic = settings.topic
        self._now_s = now_s
        self._lock = threading.Lock()
        self._seen: dict[str, SeenBooth] = {}
        self._trouble = "no connection yet"
        self._client = connect(settings, beside)
        self._client.on_connect = self._connected
        self._client.on_disconnect = self._disconnected
        self._client.on_message = self._heard
        dial(self._client, settings)

    @property
    def trouble(self) -> str:
        """Why the broker cannot be reached; empty while it is."""
        return self._trouble

    @property
    def rows(self) -> list[dict[str, Any]]:
        """Return every booth as ``SeenBooth.row`` does, by its name."""
        now_s, connected = self._now_s(), not self._trouble
        with self._lock:
            seen = sorted(self._seen.values(), key=lambda booth: booth.name)
        return [booth.row(now_s, connected=connected) for booth in seen]

    def take(self, name: str, payload: bytes) -> None:
        """Take what a booth, or the broker in its place, has said; anything else is left alone."""
        with self._lock:
            known = name in self._seen
            if not _NAME.fullmatch(name) or len(payload) > LONGEST or not (known or len(self._seen) < MOST_BOOTHS):
                return
            before = self._seen.get(name, SeenBooth(name))
            if payload == LOST:
                self._seen[name] = replace(before, lost=True)
                return
            booth = SeenBooth(name, None, self._now_s())
            try:
                booth = replace(booth, status=BoothStatus.from_json(payload.decode()))
                # Whatever cannot be shown is no status.
                json.dumps(booth.row(self._now_s(), connected=True))
            except (AttributeError, TypeError, ValueError):
                return
            self._seen[name] = booth

    def close(self) -> None:
        """Listen no more."""
        self._client.disconnect()

    def _connected(self, client: Client, _data: object, _flags: object, reason: Any, _properties: object) -> None:
        self._trouble = str(reason) if reason.is_failure else ""
        if not self._trouble:
            client.subscribe(f"{self._topic}/+", qos=1)

    def _disconnected(self, _client: Client, _data: object, _flags: object, reason: Any, _properties: object) -> None:
        self._trouble = _lost(reason)

    def _heard(self, _client: Client, _data: object, message: MQTTMessage) -> None:
        self.take(message.topic.removeprefix(f"{self._topic}/"), bytes(message.payload))


@contextmanager
def served(watch: BoothWatch, host: str, port: int, token: str) -> Iterator[str]:
    """Serve a page of all booths to the local network, under an address with the token; gives the address.

    Raises UserInputError if the port is taken.
    """
    try:
        server = _LocalServer((host, port), _page_of(watch, token))
    except OSError as error:
        raise UserInputError(f"the page cannot be served at {host}:{port}: {why(error)}; try --port") from error
    thread = threading.Thread(target=server.serve_forever, daemon=True)
    thread.start()
    try:
        yield f"http://{own_address() if host == ANYWHERE else host}:{server.server_port}/{token}/"
    finally:
        server.shutdown()
        server.server_close()


ANYWHERE = "0.0.0.0"  # noqa: S104 - for phones on the local network, and with a token
_HEADERS = (
    ("Cache-Control", "no-store"),
    ("Referrer-Policy", "no-referrer"),
    ("X-Content-Type-Options", "nosniff"),
    (
        "Content-Security-Policy",
        "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; connect-src 'self'",
    ),
)


def _page_of(watch: BoothWatch, token: str) -> type[BaseHTTPRequestHandler]:
    """Return what answers requests: the page and the booths, to those who know the token, and nothing else."""

    def answers() -> dict[str, tuple[str, bytes]]:
        booths = json.dumps({"trouble": watch.trouble, "booths": watch.rows})
        return {
            f"/{token}/": ("text/html; charset=utf-8", (ASSETS / "watch.html").read_bytes()),
            f"/{token}/booths.json": ("application/json", booths.encode()),
        }

    class Page(BaseHTTPRequestHandler):
        timeout = 10

        def do_GET(self) -> None:
            found = next((given for path, given in answers().items() if _same(self.path, path)), None)
            if found is None:
                self.send_error(HTTPStatus.NOT_FOUND)
                return
            kind, body = found
            self.send_response(HTTPStatus.OK)
            for name, value in (("Content-Type", kind), ("Content-Length", str(len(body))), *_HEADERS):
                self.send_header(name, value)
            self.end_headers()
            self.wfile.write(body)

        def log_message(self, *_: object) -> None:
            """Log nothing: the address holds the token."""

    return Page


def _same(one: str, other: str) -> bool:
    # In the same time however much of the token is right.
    return compare_digest(one.encode(), other.encode())


class _LocalServer(ThreadingHTTPServer):
    daemon_threads = True
    # A second server at the same port would take part of its visitors.
    allow_reuse_port = False

    def verify_request(self, _request: object, client_address: Any) -> bool:
        """Answer machines of the local network alone."""
        return ipaddress.ip_address(client_address[0]).is_private


def own_address() -> str:
    """Return this machine's address on the local network; no packet is sent for it."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect(("192.0.2.1", 9))
        except OSError:
            return "127.0.0.1"
        return str(probe.getsockname()[0])
