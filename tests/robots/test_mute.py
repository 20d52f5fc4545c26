"""The experimenter decides who helps next and whether anything is heard; a sentence that is not heard is reported."""

from __future__ import annotations

from functools import partial

from kiosk.config import RobotConfig as RobotSettings
from kiosk.experiment.effects import Mood
from kiosk.experiment.outcomes import EmbodimentName
from kiosk.robots.adapter import AsyncRobotAdapter
from kiosk.robots.embodiment import WHY
from kiosk.robots.selector import EmbodimentSelector
from tests.robots.recording import BodyFake, Interface, Reports, RobotFake, Waits

SETTINGS = RobotSettings(kind="furhat")


class Place:
    """An avatar, and a robot that is well."""

    def __init__(self) -> None:
        self.avatar, self.robot, self.reports, self.interface = BodyFake(), RobotFake(), Reports(), Interface()
        self.embodiments = EmbodimentSelector(self.reports, Waits().after, SETTINGS)
        self.embodiments.set_avatar(self.avatar)

    def find_robot(self) -> AsyncRobotAdapter:
        """Look for the robot, and find it."""
        body = AsyncRobotAdapter(self.robot, self.embodiments, self.interface.land, look_every_ms=60_000)
        self.embodiments.attach_robot(body)
        self.interface.settle(body)
        return body

    @property
    def helper(self) -> EmbodimentName:
        """Who helps now."""
        assert self.embodiments.current is not None
        return self.embodiments.current.name

    def say(self, utterance: int, sentence: str) -> None:
        """Have a sentence said by the embodiment that helps."""
        assert self.embodiments.current is not None
        self.embodiments.current.say(utterance, sentence)


def test_the_avatar_helps_from_the_next_session_on_when_the_experimenter_prefers_it() -> None:
    place = Place()
    place.find_robot()
    place.embodiments.begin_session("en")
    helped = []
    prefer = partial(partial, place.embodiments.prefer)
    for do in (prefer(EmbodimentName.AVATAR), place.embodiments.end_session, prefer(EmbodimentName.robot("furhat"))):
        do()
        helped.append(place.helper)
    assert helped == [EmbodimentName.robot("furhat"), EmbodimentName.AVATAR, EmbodimentName.robot("furhat")]
    place.embodiments.close()


def test_a_robot_that_is_found_again_does_not_help_whoever_prefers_the_avatar() -> None:
    place = Place()
    place.embodiments.prefer(EmbodimentName.AVATAR)
    place.find_robot()
    assert place.helper == EmbodimentName.AVATAR
    place.embodiments.close()


def test_a_quiet_body_says_nothing_reports_that_and_still_shows_its_moods() -> None:
    place = Place()
    place.embodiments.mute()
    place.say(1, "Hello")
    assert place.embodiments.current is not None
    place.embodiments.current.express(Mood.HAPPY)
    assert place.reports.heard == [("failed", 1, WHY)]
    assert ("say", 1, "Hello") not in place.avatar.did
    assert ("express", Mood.HAPPY) in place.avatar.did
    place.embodiments.unmute()
    place.say(2, "Hello again")
    assert ("say", 2, "Hello again") in place.avatar.did


def test_a_sentence_that_is_being_said_breaks_off_and_one_that_was_said_does_not() -> None:
    place = Place()
    place.say(1, "Hello")
    place.embodiments.speech_finished(1)
    place.embodiments.mute()
    assert place.reports.kinds == ["finished"]
    place.embodiments.unmute()
    place.say(2, "Hello again")
    place.embodiments.mute()
    assert place.reports.heard[-1] == ("failed", 2, WHY)
    assert ("stop",) in place.avatar.did


def test_it_stays_quiet_when_another_body_takes_over() -> None:
    place = Place()
    place.embodiments.mute()
    body = place.find_robot()
    place.say(1, "Hello")
    place.interface.settle(body)
    assert place.helper == EmbodimentName.robot("furhat")
    assert place.reports.heard == [("failed", 1, WHY)]
    assert "say Hello" not in place.robot.did
    place.embodiments.close()
