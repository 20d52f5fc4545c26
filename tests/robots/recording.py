"""Stand-ins for the packages around an embodiment: a listener that writes down, and an interface without Qt."""

from __future__ import annotations

import queue
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import ClassVar

from kiosk.experiment.effects import Mood
from kiosk.experiment.outcomes import EmbodimentName
from kiosk.robots.adapter import AsyncRobotAdapter
from kiosk.robots.driver import Capabilities, Capability, RobotDriver, RobotVoice, Utterance
from kiosk.robots.embodiment import BoardPoint, Health

PATIENCE_S = 10


@dataclass
class Reports:
    """Writes down what it hears."""

    heard: list[tuple[object, ...]] = field(default_factory=list)

    def speech_started(self, utterance: int) -> None:
        self.heard.append(("started", utterance))

    def speech_finished(self, utterance: int) -> None:
        self.heard.append(("finished", utterance))

    def speech_failed(self, utterance: int, why: str) -> None:
        self.heard.append(("failed", utterance, why))

    def robot_found(self) -> None:
        self.heard.append(("found",))

    def robot_uses_own_voice(self, why: str) -> None:
        self.heard.append(("own voice", why))

    def robot_has_other_voice(self, why: str) -> None:
        self.heard.append(("other voice", why))

    def robot_lost(self, why: str) -> None:
        self.heard.append(("lost", why))

    @property
    def kinds(self) -> list[object]:
        """What it heard, without the details."""
        return [report[0] for report in self.heard]


class Interface:
    """The interface's thread: what lands is done when the test lets it be done."""

    def __init__(self) -> None:
        self._landed: queue.SimpleQueue[Callable[[], None]] = queue.SimpleQueue()

    def land(self, job: Callable[[], None]) -> None:
        """Take a job from any thread."""
        self._landed.put(job)

    def until(self, holds: Callable[[], object]) -> None:
        """Do what lands until something is so; fails if it never is."""
        while not holds():
            try:
                self._landed.get(timeout=PATIENCE_S)()
            except queue.Empty:
                raise AssertionError("what was waited for never came") from None

    def settle(self, body: AsyncRobotAdapter) -> None:
        """Do what lands until the robot is at nothing any more."""
        self.until(lambda: not body.busy)


@dataclass
class BodyFake:
    """An embodiment that does what it is asked to and writes it down."""

    name: EmbodimentName = EmbodimentName.AVATAR
    health: Health = Health(is_ok=True, message="it is a fake")  # noqa: RUF009 - it is frozen
    did: list[tuple[object, ...]] = field(default_factory=list)

    def set_language(self, language: str) -> None:
        self.did.append(("speak", language))

    def say(self, utterance: int, sentence: str) -> None:
        self.did.append(("say", utterance, sentence))

    def stop(self) -> None:
        self.did.append(("stop",))

    def express(self, mood: Mood) -> None:
        self.did.append(("express", mood))

    def look_at(self, place: BoardPoint | None) -> None:
        self.did.append(("attend", place))

    def activate(self) -> None:
        self.did.append(("appear",))

    def deactivate(self) -> None:
        self.did.append(("withdraw",))

    def reset(self) -> None:
        self.did.append(("rest",))


@dataclass
class RobotFake(RobotDriver):
    """A robot that does at once what it is asked to, or raises what it was given to raise."""

    name: ClassVar[str] = "furhat"
    capabilities: ClassVar[frozenset[Capability]] = frozenset(Capability)
    failure: Exception | None = None
    did: list[str] = field(default_factory=list)

    def _do(self, what: str) -> None:
        self.did.append(what)
        if self.failure is not None:
            raise self.failure

    def connect(self) -> Capabilities:
        self._do("connect")
        return Capabilities((), (), RobotVoice("Amy", "en-GB"))

    def set_language(self, language: str) -> None:
        self._do(f"speak {language}")

    def say(self, saying: Utterance) -> None:
        saying.started()
        self._do(f"say {saying.text}")

    def stop_speech(self) -> None:
        self._do("stop_speech")

    def express(self, mood: Mood) -> None:
        self._do(f"express {mood.value}")

    def look_at(self, place: BoardPoint | None) -> None:
        self._do(f"attend {place}")

    def health_check(self) -> None:
        self._do("probe")

    def close(self) -> None:
        self.did.append("close")


@dataclass
class _Wait:
    at_ms: int
    call: Callable[[], None]
    cancelled: bool = False

    def cancel(self) -> None:
        self.cancelled = True


class Waits:
    """A clock that goes on only when told to."""

    def __init__(self) -> None:
        self.now = 0
        self._waits: list[_Wait] = []

    def after(self, ms: int, call: Callable[[], None]) -> _Wait:
        """Call back when so many milliseconds were spent."""
        wait = _Wait(self.now + ms, call)
        self._waits.append(wait)
        return wait

    @property
    def pending(self) -> list[int]:
        """How long it is to the end of each wait, in ms."""
        return sorted(wait.at_ms - self.now for wait in self._waits if not wait.cancelled)

    def spend(self, ms: int) -> None:
        """Let time pass."""
        until = self.now + ms
        while due := [wait for wait in self._waits if not wait.cancelled and wait.at_ms <= until]:
            first = min(due, key=lambda wait: wait.at_ms)
            self._waits.remove(first)
            self.now = first.at_ms
            first.call()
        self.now = until
