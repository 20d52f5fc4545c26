"""A page in a real browser, over Chromium's own protocol: its console, its requests, its accessibility tree."""

from __future__ import annotations

import json
import shutil
import subprocess
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from itertools import count
from pathlib import Path
from typing import Any

import pytest
from websockets.sync.client import ClientConnection, connect

from tests.patience import serving

PATIENCE_S = 120


class Browser:
    """One page of a browser; ``events`` are all that it told since it was opened."""

    def __init__(self, socket: ClientConnection) -> None:
        self._socket, self._numbers = socket, count(1)
        self._session = ""
        self.events: list[Mapping[str, Any]] = []
        target = self.ask("Target.createTarget", url="about:blank")["targetId"]
        self._session = self.ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network", "Accessibility"):
            self.ask(f"{domain}.enable")

    def ask(self, method: str, **parameters: Any) -> Any:
        """Call a method and wait for its answer."""
        number = next(self._numbers)
        words = {"id": number, "method": method, "params": parameters}
        self._socket.send(json.dumps(words | ({"sessionId": self._session} if self._session else {})))
        while True:
            told = self._hear()
            if told.get("id") == number:
                assert "error" not in told, told
                return told["result"]

    def _hear(self) -> Mapping[str, Any]:
        told: Mapping[str, Any] = json.loads(self._socket.recv(PATIENCE_S))
        if "method" in told:
            self.events.append(told)
        return told

    def open(self, page: Path) -> None:
        """Load a page, and wait until it is there."""
        loaded = len(self.named("Page.loadEventFired"))
        self.ask("Page.navigate", url=page.as_uri())
        while len(self.named("Page.loadEventFired")) == loaded:
            self._hear()

    def value(self, expression: str) -> Any:
        """Return what an expression comes to in the page."""
        return self.ask("Runtime.evaluate", expression=expression, returnByValue=True)["result"].get("value")

    def named(self, method: str) -> list[Mapping[str, Any]]:
        """Return the events of a kind."""
        return [each["params"] for each in self.events if each["method"] == method]

    def accessible(self) -> list[tuple[str, str]]:
        """Role and name of everything that a screen reader meets."""
        nodes = self.ask("Accessibility.getFullAXTree")["nodes"]
        return [
            (node["role"]["value"], node.get("name", {}).get("value", "")) for node in nodes if not node.get("ignored")
        ]


@contextmanager
def opened_browser(folder: Path) -> Iterator[Browser]:
    """Chromium with a profile in ``folder``; the test is skipped where there is none."""
    program = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if program is None:
        pytest.skip("Chromium is not installed")
    words = ["--headless=new", "--no-sandbox", "--disable-gpu", "--remote-debugging-port=0"]
    command = [program, *words, f"--user-data-dir={folder}", "about:blank"]
    with serving(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as started:
        place = folder / "DevToolsActivePort"
        deadline = time.monotonic() + PATIENCE_S
        while not (place.exists() and len(place.read_text().splitlines()) > 1):
            assert started.poll() is None, "Chromium ended"
            assert time.monotonic() < deadline, "Chromium did not open its port"
            time.sleep(0.05)
        port, path = place.read_text().splitlines()[:2]
        with connect(f"ws://127.0.0.1:{port}{path}", max_size=None, proxy=None) as socket:
            browser = Browser(socket)
            yield browser
            browser.ask("Page.close")
        started.terminate()
        started.wait(PATIENCE_S)
