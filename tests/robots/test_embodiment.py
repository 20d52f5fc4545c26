"""The robot helps while it can and the avatar when it cannot; no visitor waits for a robot."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from threading import Event

import pytest

from kiosk.config import RobotConfig as RobotSettings
from kiosk.experiment.effects import Mood
from kiosk.experiment.outcomes import EmbodimentName
from kiosk.robots.adapter import AsyncRobotAdapter
from kiosk.robots.driver import FailureKind, RobotError, Utterance
from kiosk.robots.selector import EmbodimentSelector
from tests.robots.recording import BodyFake, Interface, Reports, RobotFake, Waits

GONE = RobotError(FailureKind.UNREACHABLE, "saying hello")
A_MOMENT_S = 0.2
"""Long enough for a sentence that does not wait to come too early."""

SETTINGS = RobotSettings(kind="furhat", backoff_initial_ms=1000, backoff_max_ms=8000, health_check_ms=5000)


@dataclass
class Stage:
    """A robot, an avatar, and who decides between them."""

    robot: RobotFake = field(default_factory=RobotFake)
    avatar: BodyFake = field(default_factory=BodyFake)
    reports: Reports = field(default_factory=Reports)
    waits: Waits = field(default_factory=Waits)
    interface: Interface = field(default_factory=Interface)

    def __post_init__(self) -> None:
        self.embodiments = EmbodimentSelector(self.reports, self.waits.after, SETTINGS)
        self.embodiments.set_avatar(self.avatar)
        self.body = AsyncRobotAdapter(self.robot, self.embodiments, self.interface.land, look_every_ms=60_000)

    def begin_to_look(self) -> None:
        """Look for the robot, and see what comes of it."""
        self.embodiments.attach_robot(self.body)
        self.settle()

    def settle(self) -> None:
        """Let everything that was asked of the robot come to its end."""
        self.interface.settle(self.body)

    def helps(self, name: EmbodimentName) -> bool:
        """Whether this body helps now."""
        return self.embodiments.current is not None and self.embodiments.current.name == name


@pytest.fixture
def stage() -> Iterator[Stage]:
    """Provide a robot and an avatar; the robot was not looked for yet."""
    built = Stage()
    yield built
    built.embodiments.close()


@pytest.fixture
def robot_helps(stage: Stage) -> Stage:
    """Return the same, in a session that began with the robot."""
    stage.begin_to_look()
    stage.embodiments.begin_session("en")
    return stage


def test_until_the_robot_is_found_the_avatar_helps(stage: Stage) -> None:
    stage.embodiments.attach_robot(stage.body)
    assert stage.helps(EmbodimentName.AVATAR)
    assert not stage.embodiments.settled
    stage.settle()
    assert stage.helps(EmbodimentName.robot("furhat"))
    assert stage.embodiments.settled
    assert ("withdraw",) in stage.avatar.did
    assert stage.body.health.message == "the robot is there and speaks as Amy"


def test_the_experimenter_is_told_how_every_body_is(stage: Stage) -> None:
    stage.begin_to_look()
    assert {name: health.message for name, health in stage.embodiments.health.items()} == {
        EmbodimentName.robot("furhat"): "the robot is there and speaks as Amy",
        EmbodimentName.AVATAR: "it is a fake",
    }


def test_a_robot_that_is_not_there_leaves_it_to_the_avatar(stage: Stage) -> None:
    stage.robot.failure = GONE
    stage.begin_to_look()
    assert stage.helps(EmbodimentName.AVATAR)
    assert stage.embodiments.settled
    assert stage.reports.heard == []
    assert "cannot be reached" in stage.body.health.message


def test_a_sentence_is_reported_from_its_start_to_its_end(robot_helps: Stage) -> None:
    robot_helps.body.say(3, "Hello")
    robot_helps.settle()
    assert robot_helps.reports.heard == [("started", 3), ("finished", 3)]
    assert "say Hello" in robot_helps.robot.did


def test_a_robot_that_fails_is_reported_once_and_not_used_again_in_the_session(robot_helps: Stage) -> None:
    stage = robot_helps
    stage.robot.failure = GONE
    stage.body.say(3, "Hello")
    stage.body.express(Mood.HAPPY)
    stage.settle()
    assert stage.reports.kinds.count("lost") == 1
    stage.embodiments.switch_to(EmbodimentName.AVATAR)
    assert stage.helps(EmbodimentName.AVATAR)
    stage.robot.failure = None
    asked = list(stage.robot.did)
    stage.waits.spend(100_000)
    assert stage.robot.did == asked


@pytest.mark.parametrize("fails", ["express", "look_at", "stop"])
def test_it_is_lost_by_whatever_fails_not_by_speech_alone(robot_helps: Stage, fails: str) -> None:
    stage = robot_helps
    if fails == "stop":
        stage.body.say(1, "Hello")
    stage.robot.failure = GONE
    {"express": lambda: stage.body.express(Mood.SAD), "look_at": lambda: stage.body.look_at(None)}.get(
        fails, stage.body.stop
    )()
    stage.settle()
    assert stage.reports.kinds.count("lost") == 1


def test_between_sessions_it_is_looked_for_with_growing_pauses_and_taken_back(robot_helps: Stage) -> None:
    stage = robot_helps
    stage.robot.failure = GONE
    stage.body.express(Mood.SAD)
    stage.settle()
    stage.embodiments.switch_to(EmbodimentName.AVATAR)
    stage.embodiments.end_session()
    pauses = []
    for _ in range(5):
        (pause,) = stage.waits.pending
        pauses.append(pause)
        stage.waits.spend(pause)
        stage.settle()
    assert pauses == [1000, 2000, 4000, 8000, 8000]
    assert stage.helps(EmbodimentName.AVATAR)
    stage.robot.failure = None
    stage.waits.spend(8000)
    stage.settle()
    assert stage.helps(EmbodimentName.robot("furhat"))


def test_what_came_due_during_a_session_is_done_right_after_it(robot_helps: Stage) -> None:
    stage = robot_helps
    stage.robot.failure = GONE
    stage.body.express(Mood.SAD)
    stage.settle()
    stage.embodiments.switch_to(EmbodimentName.AVATAR)
    stage.robot.failure = None
    stage.waits.spend(60_000)
    assert stage.robot.did.count("connect") == 1
    stage.embodiments.end_session()
    stage.settle()
    assert stage.robot.did.count("connect") == 2
    assert stage.helps(EmbodimentName.robot("furhat"))


def test_a_robot_that_comes_back_during_a_session_waits_for_its_end(stage: Stage) -> None:
    stage.embodiments.attach_robot(stage.body)
    stage.embodiments.begin_session("en")
    stage.settle()
    assert stage.helps(EmbodimentName.AVATAR)
    stage.embodiments.end_session()
    assert stage.helps(EmbodimentName.robot("furhat"))


def test_between_sessions_a_robot_that_is_well_is_seen_to(stage: Stage) -> None:
    stage.begin_to_look()
    stage.waits.spend(5000)
    stage.settle()
    assert stage.robot.did[-1] == "probe"
    stage.robot.failure = GONE
    stage.waits.spend(5000)
    stage.settle()
    assert stage.helps(EmbodimentName.AVATAR)
    assert stage.reports.heard == []


def test_a_sentence_that_was_stopped_is_not_reported(robot_helps: Stage) -> None:
    robot_helps.body.say(1, "Hello")
    robot_helps.body.stop()
    robot_helps.settle()
    assert robot_helps.reports.heard == []


def test_the_first_sentence_waits_for_its_language() -> None:
    class SlowToLearn(RobotFake):
        said = Event()

        def set_language(self, language: str) -> None:
            self.said.wait(A_MOMENT_S)
            super().set_language(language)

        def say(self, saying: Utterance) -> None:
            self.said.set()
            super().say(saying)

    stage = Stage(SlowToLearn())
    stage.begin_to_look()
    stage.embodiments.begin_session("it")
    stage.body.say(1, "Ciao")
    stage.settle()
    assert stage.robot.did.index("speak it") < stage.robot.did.index("say Ciao")
    stage.embodiments.close()


def test_a_new_sentence_takes_the_place_of_the_one_under_way(robot_helps: Stage) -> None:
    robot_helps.body.say(1, "Hello")
    robot_helps.body.say(2, "Hello again")
    robot_helps.settle()
    assert robot_helps.reports.heard == [("started", 2), ("finished", 2)]


def test_a_fault_of_ours_is_raised_where_faults_are_seen(robot_helps: Stage) -> None:
    robot_helps.robot.failure = ZeroDivisionError("ours")
    robot_helps.body.express(Mood.HAPPY)
    with pytest.raises(ZeroDivisionError, match="ours"):
        robot_helps.settle()


def test_nothing_is_asked_of_a_closed_robot(stage: Stage) -> None:
    stage.begin_to_look()
    stage.embodiments.close()
    assert stage.robot.did[-1] == "close"
