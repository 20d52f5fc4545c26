"""A robot as a body: whatever it does, its methods return at once, and what becomes of it lands as a report.

Two lanes, because a call that speaks lasts as long as the speech: one speaks, the other does all the rest. Everything
in here runs on the interface's thread, but for what goes through ``_post``.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Protocol

from kiosk.robot.body import Health, Listener, Place
from kiosk.robot.device import Found, Robot, RobotFailed, Saying
from kiosk.robot.lane import Job, Lane
from kiosk.study.commands import Mood
from kiosk.study.events import BodyName

Land = Callable[[Job], None]
"""Has a job done on the interface's thread, soon; may be called from any thread."""


class Reports(Listener, Protocol):
    """A listener that hears of the robot's coming as well."""

    def robot_found(self) -> None:
        """The robot can be counted on from now on."""
        ...


class RobotBody:
    """One robot, found or lost; lost until ``look_for`` has found it."""

    def __init__(self, robot: Robot, reports: Reports, land: Land, look_every_ms: int) -> None:
        """While it speaks, see every ``look_every_ms`` whether it still answers."""
        self._robot = robot
        self._reports = reports
        self._land = land
        self._saying: Saying | None = None
        self._health = Health(well=False, words="the robot has not been looked for yet")
        self._sought = False
        self._under_way = 0
        self._voice = Lane("robot-voice", lambda: None, look_every_ms / 1000)
        self._motion = Lane("robot-motion", self._look_while_speaking, look_every_ms / 1000)

    @property
    def name(self) -> BodyName:
        """What the records call it."""
        return self._robot.name

    @property
    def health(self) -> Health:
        """Whether it was found, and what it was or did last."""
        return self._health

    @property
    def busy(self) -> bool:
        """Whether anything that was asked of it is not over."""
        return self._under_way > 0

    def look_for(self) -> None:
        """Look for it, and get it ready to speak; ``robot_found`` or ``robot_lost`` follows."""
        self._sought = True
        self._post(self._motion, "look for", lambda: self._land(partial(self._found, self._robot.connect())))

    def probe(self) -> None:
        """See whether it is still well; ``robot_lost`` follows if not."""
        self._post(self._motion, "probe", self._robot.probe)

    def speak(self, language: str) -> None:
        """Speak this language; a robot without a voice for it is lost to the sitting."""
        # Before its first sentence, on whose lane it goes; but after a search, which gives it a voice as well.
        lane = self._voice if self._health.well else self._motion
        self._post(lane, "speak", partial(self._robot.speak, language))

    def say(self, utterance: int, sentence: str) -> None:
        """Begin to say a sentence, in place of any other."""
        self._drop_sentence()
        saying = Saying(sentence, lambda: self._land(lambda: self._started(saying, utterance)))
        self._saying = saying
        self._post(self._voice, "say", partial(self._say, saying, utterance), saying)
        self.attend(None)

    def stop(self) -> None:
        """Be silent."""
        if self._drop_sentence():
            self._post(self._motion, "hush", self._robot.hush)

    def express(self, mood: Mood) -> None:
        """Show a mood."""
        self._post(self._motion, "express", partial(self._robot.express, mood))

    def attend(self, place: Place | None) -> None:
        """Look at a place on the board, or at the visitor."""
        self._post(self._motion, "attend", partial(self._robot.attend, place))

    def appear(self) -> None:
        """Look at the visitor."""
        self.attend(None)

    def withdraw(self) -> None:
        """Be silent; a robot that is lost does not hear it anyway."""
        self._drop_sentence()

    def rest(self) -> None:
        """Keep nothing of the last visitor: no sentence is left, and gestures end by themselves."""
        self.stop()

    def close(self) -> None:
        """Let go of the robot and of both threads."""
        self._drop_sentence()
        self._robot.close()
        for lane in (self._voice, self._motion):
            lane.close()

    def _say(self, saying: Saying, utterance: int) -> None:
        if not saying.is_cut:
            self._robot.say(saying)
            self._land(partial(self._finished, saying, utterance))

    def _look_while_speaking(self) -> None:
        saying = self._saying
        if saying is not None:
            self._guarded(self._robot.probe, saying)

    def _post(self, lane: Lane, key: str, job: Job, saying: Saying | None = None) -> None:
        """Have a lane do something that may fail; ``saying`` is the sentence that it is about."""
        self._under_way += 1

        def do() -> None:
            self._guarded(job, saying)
            self._land(self._over)

        if lane.post(key, do):
            self._over()

    def _guarded(self, job: Job, saying: Saying | None) -> None:
        """Do it, and let its failure land; a fault of ours lands as what it is."""
        try:
            job()
        except RobotFailed as failure:
            if saying is None or not saying.is_cut:
                self._land(partial(self._lost, str(failure)))
        except Exception as fault:  # noqa: BLE001 - it is raised where faults are seen
            self._land(partial(_raise, fault))

    def _over(self) -> None:
        self._under_way -= 1

    def _drop_sentence(self) -> bool:
        """Wait for the sentence no longer; returns whether there was one."""
        saying, self._saying = self._saying, None
        if saying is not None:
            saying.cut()
        return saying is not None

    def _started(self, saying: Saying, utterance: int) -> None:
        if saying is self._saying:
            self._reports.speech_started(utterance)

    def _finished(self, saying: Saying, utterance: int) -> None:
        if saying is self._saying:
            self._saying = None
            self._reports.speech_finished(utterance)

    def _found(self, found: Found) -> None:
        self._sought = False
        voice = f" and speaks as {found.voice.name}" if found.voice else ""
        self._health = Health(well=True, words=f"the robot is there{voice}")
        self._reports.robot_found()

    def _lost(self, why: str) -> None:
        """The first failure counts; what fails after it was asked of a robot that was lost already."""
        if not self._health.well and not self._sought:
            return
        self._sought = False
        self._health = Health(well=False, words=why)
        self._drop_sentence()
        self._under_way -= self._voice.clear() + self._motion.clear()
        self._reports.robot_lost(why)


def _raise(fault: Exception) -> None:
    raise fault
