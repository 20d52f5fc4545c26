"""A robot that failed in one session helps again in the next, whatever its fault was, and wrong voices are told."""

from __future__ import annotations

import socket
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from threading import Event, get_ident
from typing import Any

import pytest

from kiosk.config import RobotConfig as RobotSettings
from kiosk.experiment.outcomes import EmbodimentName
from kiosk.robots.adapter import AsyncRobotAdapter
from kiosk.robots.driver import FailureKind, RobotDriver, RobotError
from kiosk.robots.furhat import Furhat
from kiosk.robots.furhat_realtime import FurhatRealtime
from kiosk.robots.http_client import NameLookup
from kiosk.robots.registry import robot_check
from kiosk.robots.selector import EmbodimentSelector
from tests.patience import PATIENCE_S
from tests.robots.furhat_fake import FAULTS, FurhatFake, Mode
from tests.robots.realtime_fake import Mode as RealtimeMode
from tests.robots.realtime_fake import RealtimeFake
from tests.robots.recording import BodyFake, Interface, Reports, Waits

FAULTY_MS, WELL_MS = 250, 10_000
REALTIME_FAULTS = [mode for mode in RealtimeMode if mode not in {RealtimeMode.WELL, RealtimeMode.NAMELESS}]


def settings(kind: str, port: int, **more: object) -> RobotSettings:
    """Return a robot that has little time to speak and much to be found."""
    given = {"kind": kind, "host": "127.0.0.1", "port": port, "gaze": False, "gestures": False}
    deadlines = {"speech_deadline_min_ms": FAULTY_MS, "speech_deadline_ms_per_char": 1}
    slow = {"connect_deadline_ms": WELL_MS, "answer_deadline_ms": WELL_MS, "backoff_initial_ms": 1000}
    return RobotSettings.model_validate({**given, **deadlines, **slow, **more})


@dataclass
class Booth:
    """A robot's driver, an avatar, and what chooses between them."""

    driver: RobotDriver
    reports: Reports = field(default_factory=Reports)
    waits: Waits = field(default_factory=Waits)
    interface: Interface = field(default_factory=Interface)

    def __post_init__(self) -> None:
        self.embodiments = EmbodimentSelector(self.reports, self.waits.after, self.driver.settings)
        self.embodiments.set_avatar(BodyFake())
        self.robot = AsyncRobotAdapter(self.driver, self.embodiments, self.interface.land, look_every_ms=60_000)
        self.embodiments.attach_robot(self.robot)

    @property
    def helps(self) -> EmbodimentName:
        assert self.embodiments.current is not None
        return self.embodiments.current.name

    def settle(self) -> None:
        self.interface.settle(self.robot)


@contextmanager
def booth(driver: RobotDriver) -> Iterator[Booth]:
    """Provide a booth that looks for its robot."""
    built = Booth(driver)
    try:
        yield built
    finally:
        built.embodiments.close()


@contextmanager
def furhat(mode: Mode) -> Iterator[tuple[RobotDriver, Callable[..., None]]]:
    with FurhatFake() as fake:

        def turn(*, well: bool) -> None:
            fake.mode = Mode.WELL if well else mode

        yield Furhat(settings("furhat", fake.port), "en"), turn


@contextmanager
def realtime(mode: RealtimeMode) -> Iterator[tuple[RobotDriver, Callable[..., None]]]:
    with RealtimeFake() as fake:

        def turn(*, well: bool) -> None:
            fake.mode = RealtimeMode.WELL if well else mode

        yield FurhatRealtime(settings("furhat-realtime", fake.port), "en"), turn


EVERY_FAULT = [(furhat, mode) for mode in FAULTS] + [(realtime, mode) for mode in REALTIME_FAULTS]


@pytest.mark.parametrize(("robot", "fault"), EVERY_FAULT, ids=lambda each: getattr(each, "name", "") or each.__name__)
def test_a_robot_that_failed_in_one_session_helps_in_the_next(robot: Any, fault: Any) -> None:
    with ExitStack() as stack:
        driver, turn = stack.enter_context(robot(fault))
        here = stack.enter_context(booth(driver))
        here.settle()
        here.embodiments.begin_session("en")
        assert here.helps == here.robot.name
        turn(well=False)
        here.robot.say(1, "Hello")
        here.settle()
        assert here.reports.kinds.count("lost") == 1
        assert ("finished", 1) not in here.reports.heard
        here.embodiments.switch_to(EmbodimentName.AVATAR)
        turn(well=True)
        here.waits.spend(60_000)
        assert here.helps == EmbodimentName.AVATAR
        here.embodiments.end_session()
        here.settle()
        here.embodiments.begin_session("en")
        assert here.helps == here.robot.name
        here.robot.say(2, "Hi")
        here.settle()
        assert here.reports.heard[-2:] == [("started", 2), ("finished", 2)]


ASKED: list[str] = []
"""The slow names that were looked up."""


@pytest.fixture
def slow_names(monkeypatch: pytest.MonkeyPatch) -> Iterator[Event]:
    """Have no name found before the event is set; only the interface's thread may not ask for one."""
    known, ask, interface = Event(), socket.getaddrinfo, get_ident()
    ASKED.clear()

    def slow(host: Any, *rest: Any, **options: Any) -> Any:
        if host == "robot.test":
            assert get_ident() != interface
            ASKED.append(host)
            known.wait(PATIENCE_S)
            host = "127.0.0.1"
        return ask(host, *rest, **options)

    monkeypatch.setattr(socket, "getaddrinfo", slow)
    yield known
    known.set()


@pytest.mark.parametrize("kind", [Furhat, FurhatRealtime])
def test_while_a_name_is_looked_up_the_avatar_helps_and_then_the_robot(
    kind: type[RobotDriver], slow_names: Event, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("kiosk.robots.http_client.LOOKUP_S", 0.05)
    with ExitStack() as stack:
        fake: FurhatFake | RealtimeFake = FurhatFake() if kind is Furhat else RealtimeFake()
        stack.enter_context(fake)
        here = stack.enter_context(booth(kind(settings(kind.name, fake.port, host="robot.test"), "en")))
        here.embodiments.begin_session("en")
        assert here.helps == EmbodimentName.AVATAR
        here.settle()
        assert "looking up robot.test: no answer within 0.05 s" in here.robot.health.message
        slow_names.set()
        here.embodiments.end_session()
        here.waits.spend(1000)
        here.settle()
        assert here.helps == here.robot.name


def test_one_thread_looks_a_name_up_however_often_it_is_asked_for(slow_names: Event) -> None:
    name = NameLookup("robot.test", 80)
    for _ in range(3):
        with pytest.raises(RobotError, match="cannot be reached") as failed:
            name.resolve(0)
        assert failed.value.kind is FailureKind.UNREACHABLE
    slow_names.set()
    assert name.resolve(10) == "127.0.0.1"
    assert ASKED == ["robot.test"]


def test_a_voice_of_another_language_is_told_of_and_recorded() -> None:
    with FurhatFake() as fake:
        chosen = settings("furhat", fake.port, voice="Amy")
        with booth(Furhat(chosen, "en")) as here:
            noted: list[str] = []
            here.embodiments.on_other_voice = noted.append
            here.settle()
            assert (here.robot.health.message, noted) == ("the robot is there and speaks as Amy", [])
            here.embodiments.begin_session("it")
            here.settle()
            assert noted == ["Amy is a voice of en-GB, not of it"]
            assert here.robot.health.message == f"the robot is there and speaks as Amy, but {noted[0]}"
        found = {result.name: result for result in robot_check(chosen, ("en", "it"), busy=False)}
    assert found["robot: en"].message == "Amy (en-GB)"
    assert found["robot: it"].message == noted[0]
    assert "robot.voice" in found["robot: it"].remedy


def test_a_robot_that_keeps_another_voice_than_the_study_asks_for_is_told_of() -> None:
    with (
        RealtimeFake() as fake,
        booth(FurhatRealtime(settings("furhat-realtime", fake.port, voice="Amy"), "en")) as here,
    ):
        noted: list[str] = []
        here.embodiments.on_other_voice = noted.append
        here.settle()
        assert noted == ["it speaks as Matthew, not as Amy"]
        assert here.helps == here.robot.name
