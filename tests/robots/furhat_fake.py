"""A strict Furhat without a robot: a server on the loopback that speaks in silence, and fails in whatever way is asked.

``python -m tests.robots.furhat_fake --port 54321 --mode hang --after 8`` runs one in a process of its own.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from contextlib import suppress
from enum import Enum
from random import Random
from time import monotonic

from kiosk.robots.furhat_pretended import PATIENCE_S, TICK_S, Handler, PretendedFurhat
from kiosk.robots.furhat_rules import Request


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


class _Handler(Handler):
    """One request, answered in the robot's mode."""

    def take(self, request: Request) -> None:
        _FAILINGS.get(self._fake.mode_for(request), Handler.well)(self, request)

    @property
    def _fake(self) -> FurhatFake:
        assert isinstance(self.robot, FurhatFake)
        return self.robot

    def hang(self, _: Request) -> None:
        self._fake.hang(self.gone)

    def slow(self, request: Request) -> None:
        self._fake.hang(self.gone, self._fake.slow_ms / 1000)
        self.well(request)

    def trickle(self, _: Request) -> None:
        self.wfile.write(b"HTTP/1.1 200 OK\r\nContent-Length: 1000000\r\n\r\n")
        while not self.gone(TICK_S) and not self.robot.closing:
            self.wfile.write(b" ")

    def drop(self, _: Request) -> None:
        self.wfile.write(
            b'HTTP/1.1 200 OK\r\nContent-Type: application/json\r\nContent-Length: 31\r\n\r\n{"success": true, "mes'
        )


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


class FurhatFake(PretendedFurhat):
    """The robot that the program can pretend, with faults."""

    handler = _Handler

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
        self.slow_ms = slow_ms
        self.requests: list[Request] = []
        self._rng = Random(seed)
        self._mode = Mode.WELL
        self._armed: tuple[Mode, str, int] | None = None
        super().__init__(port=port, character_ms=character_ms, voices=voices)

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
            self.stop_listening()
        else:
            self.listen()

    def arm(self, mode: Mode, *, path: str = "/furhat", after: int = 0) -> None:
        """Fall into a mode for good when, after so many more requests whose path begins so, another one comes."""
        self._armed = (mode, path, after)

    def restart(self) -> None:
        """Forget what a robot forgets when it is switched off."""
        self.voice = None
        self.mode = Mode.WELL

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

    # How it answers

    def mode_for(self, request: Request) -> Mode:
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

    def hang(self, gone: Callable[[float], bool], seconds: float = float("inf")) -> None:
        """Do nothing until the one who asked is gone, the robot is closed, or the time is over."""
        until = monotonic() + seconds
        while not self.closing and monotonic() < until:
            if gone(TICK_S):
                return


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
