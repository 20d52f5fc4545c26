"""Furhat's Realtime API: the same robot over a WebSocket, and the same failures."""

from __future__ import annotations

import threading
from collections.abc import Iterator

import pytest

from kiosk.config import RobotConfig as RobotSettings
from kiosk.experiment.effects import Mood
from kiosk.robots.driver import FailureKind, RobotError, Utterance
from kiosk.robots.embodiment import BoardPoint
from kiosk.robots.furhat_realtime import FurhatRealtime
from tests.robots.realtime_fake import Mode, RealtimeFake

DEADLINE_MS = 250


@pytest.fixture
def fake() -> Iterator[RealtimeFake]:
    """Provide a robot."""
    with RealtimeFake() as robot:
        yield robot


@pytest.fixture
def robots() -> Iterator[list[FurhatRealtime]]:
    """Clients that are closed when the test is over."""
    made: list[FurhatRealtime] = []
    yield made
    for robot in made:
        robot.close()


def connected(fake: RealtimeFake, robots: list[FurhatRealtime], **settings: object) -> FurhatRealtime:
    """Return a client with short deadlines, connected."""
    deadlines = dict.fromkeys(("connect_deadline_ms", "answer_deadline_ms", "speech_deadline_min_ms"), DEADLINE_MS)
    given = {"host": "127.0.0.1", "port": fake.port, "speech_deadline_ms_per_char": 1, **deadlines, **settings}
    robots.append(FurhatRealtime(RobotSettings.model_validate(given), "it"))
    robots[-1].connect()
    return robots[-1]


@pytest.mark.parametrize("mode", [Mode.WELL, Mode.NAMELESS], ids=lambda mode: mode.name.lower())
def test_a_sentence_starts_and_ends(fake: RealtimeFake, robots: list[FurhatRealtime], mode: Mode) -> None:
    fake.mode = mode
    started = threading.Event()
    connected(fake, robots).say(Utterance("Prova la riga 2", started.set))
    assert started.is_set()
    assert fake.sentences == ["Prova la riga 2"]


def test_it_asks_only_for_what_the_robot_takes(fake: RealtimeFake, robots: list[FurhatRealtime]) -> None:
    robot = connected(fake, robots)
    for mood in Mood:
        robot.express(mood)
    robot.look_at(None)
    robot.look_at(BoardPoint(0.5, 0.5))
    robot.stop_speech()
    robot.health_check()
    assert fake.refusals == []
    assert fake.asked("request.voice.config")[0]["language"] == "it-IT"


def test_with_a_key_it_signs_in(robots: list[FurhatRealtime]) -> None:
    with RealtimeFake(key="open") as fake:
        connected(fake, robots, key="open")
        with pytest.raises(RobotError, match="the key opens nothing"):
            connected(fake, robots, key="wrong")


@pytest.mark.parametrize(
    ("mode", "fault"),
    [
        (Mode.HANG, FailureKind.SLOW),
        (Mode.DROP, FailureKind.DROPPED),
        (Mode.GARBAGE, FailureKind.SLOW),
        (Mode.ERROR, FailureKind.ERROR),
        (Mode.FAILED, FailureKind.DECLINED),
    ],
    ids=lambda value: value.name.lower(),
)
def test_a_failure_says_what_went_wrong(
    fake: RealtimeFake, robots: list[FurhatRealtime], mode: Mode, fault: FailureKind
) -> None:
    robot = connected(fake, robots)
    fake.mode = mode
    with pytest.raises(RobotError) as failed:
        robot.say(Utterance("Ciao", lambda: None))
    assert failed.value.kind is fault
    assert len(fake.sentences) == 1


def test_a_robot_that_is_not_there_cannot_be_reached(robots: list[FurhatRealtime]) -> None:
    with RealtimeFake() as gone:
        pass
    with pytest.raises(RobotError) as failed:
        connected(gone, robots)
    assert failed.value.kind is FailureKind.UNREACHABLE


def test_what_was_dropped_stays_lost_until_it_is_connected_again(
    fake: RealtimeFake, robots: list[FurhatRealtime]
) -> None:
    robot = connected(fake, robots)
    fake.mode = Mode.DROP
    for _ in range(2):
        with pytest.raises(RobotError):
            robot.health_check()
    fake.mode = Mode.WELL
    robot.connect()
    robot.health_check()


def test_a_sentence_that_is_cut_is_waited_for_no_longer(fake: RealtimeFake, robots: list[FurhatRealtime]) -> None:
    robot = connected(fake, robots, speech_deadline_min_ms=60_000)
    fake.mode = Mode.HANG
    under_way = Utterance("Ciao", lambda: None)

    def cut() -> None:
        fake.wait_until(lambda: fake.sentences)
        under_way.cancel()

    threading.Thread(target=cut, daemon=True).start()
    with pytest.raises(RobotError) as failed:
        robot.say(under_way)
    assert failed.value.kind is FailureKind.CUT
