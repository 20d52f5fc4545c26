"""The experimenter decides who helps next and whether anything is heard; a sentence that is not heard is reported."""

from __future__ import annotations

from functools import partial

from kiosk.robot.bodies import Bodies
from kiosk.robot.quiet import WHY
from kiosk.robot.robot_body import RobotBody
from kiosk.settings import Robot as RobotSettings
from kiosk.study.commands import Mood
from kiosk.study.events import BodyName
from tests.robot.recording import BodyFake, Interface, Reports, RobotFake, Waits

SETTINGS = RobotSettings(kind="furhat")


class Place:
    """An avatar, and a robot that is well."""

    def __init__(self) -> None:
        self.avatar, self.robot, self.reports, self.interface = BodyFake(), RobotFake(), Reports(), Interface()
        self.bodies = Bodies(self.reports, Waits().after, SETTINGS)
        self.bodies.take(self.avatar)

    def find_robot(self) -> RobotBody:
        """Look for the robot, and find it."""
        body = RobotBody(self.robot, self.bodies, self.interface.land, look_every_ms=60_000)
        self.bodies.take_robot(body)
        self.interface.settle(body)
        return body

    @property
    def helper(self) -> BodyName:
        """Who helps now."""
        assert self.bodies.current is not None
        return self.bodies.current.name

    def say(self, utterance: int, sentence: str) -> None:
        """Have a sentence said by whoever helps."""
        assert self.bodies.current is not None
        self.bodies.current.say(utterance, sentence)


def test_the_avatar_helps_from_the_next_sitting_on_when_the_experimenter_prefers_it() -> None:
    place = Place()
    place.find_robot()
    place.bodies.begin("en")
    helped = []
    prefer = partial(partial, place.bodies.prefer)
    for do in (prefer(BodyName.AVATAR), place.bodies.rest, prefer(BodyName.FURHAT)):
        do()
        helped.append(place.helper)
    assert helped == [BodyName.FURHAT, BodyName.AVATAR, BodyName.FURHAT]
    place.bodies.close()


def test_a_robot_that_is_found_again_does_not_help_whoever_prefers_the_avatar() -> None:
    place = Place()
    place.bodies.prefer(BodyName.AVATAR)
    place.find_robot()
    assert place.helper is BodyName.AVATAR
    place.bodies.close()


def test_a_quiet_body_says_nothing_reports_that_and_still_shows_its_moods() -> None:
    place = Place()
    place.bodies.be_quiet()
    place.say(1, "Hello")
    assert place.bodies.current is not None
    place.bodies.current.express(Mood.HAPPY)
    assert place.reports.heard == [("failed", 1, WHY)]
    assert ("say", 1, "Hello") not in place.avatar.did
    assert ("express", Mood.HAPPY) in place.avatar.did
    place.bodies.be_heard()
    place.say(2, "Hello again")
    assert ("say", 2, "Hello again") in place.avatar.did


def test_a_sentence_that_is_being_said_breaks_off_and_one_that_was_said_does_not() -> None:
    place = Place()
    place.say(1, "Hello")
    place.bodies.speech_finished(1)
    place.bodies.be_quiet()
    assert place.reports.kinds == ["finished"]
    place.bodies.be_heard()
    place.say(2, "Hello again")
    place.bodies.be_quiet()
    assert place.reports.heard[-1] == ("failed", 2, WHY)
    assert ("stop",) in place.avatar.did


def test_it_stays_quiet_when_another_body_takes_over() -> None:
    place = Place()
    place.bodies.be_quiet()
    body = place.find_robot()
    place.say(1, "Hello")
    place.interface.settle(body)
    assert place.helper is BodyName.FURHAT
    assert place.reports.heard == [("failed", 1, WHY)]
    assert "say Hello" not in place.robot.did
    place.bodies.close()
