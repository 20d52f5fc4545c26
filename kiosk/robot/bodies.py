"""Which body helps: the robot as long as it can, else the avatar; or the avatar because the experimenter wants it so.

A robot that fails is not used again in the same sitting. Between sittings it is looked for with growing pauses, and
taken back only there; a preference, too, holds from the next sitting on.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping
from typing import Protocol

from kiosk.robot.body import Body, Health, Listener
from kiosk.robot.quiet import Mouth
from kiosk.robot.robot_body import RobotBody
from kiosk.settings import Robot as RobotSettings
from kiosk.study.events import BodyName

_log = logging.getLogger(__name__)


class Wait(Protocol):
    """A wait that is under way."""

    def cancel(self) -> None:
        """Forget it."""
        ...


After = Callable[[int, Callable[[], None]], Wait]
"""Calls back once, on the interface's thread, in so many milliseconds."""


class Bodies:
    """The bodies of one kiosk, and which of them helps now; what they report passes through here."""

    def __init__(self, listener: Listener, after: After, settings: RobotSettings) -> None:
        """Without a body nothing is said; ``take`` brings the avatar, ``take_robot`` the robot."""
        self._listener = listener
        self._after = after
        self._settings = settings
        self._avatar: Body | None = None
        self._robot: RobotBody | None = None
        self._current: Body | None = None
        self._mouth: Mouth | None = None
        self._prefers_avatar = False
        self._in_sitting = False
        self._unsettled = False
        self._pause = settings.retry_first
        self._wait: Wait | None = None
        self._due = False

    @property
    def current(self) -> Body | None:
        """The body that helps now."""
        return self._mouth

    @property
    def is_quiet(self) -> bool:
        """Whether no sentence is heard."""
        return self._mouth is not None and self._mouth.shut

    @property
    def prefers_avatar(self) -> bool:
        """Whether the avatar helps even when the robot is well."""
        return self._prefers_avatar

    @property
    def has_robot(self) -> bool:
        """Whether there is a robot to choose, well or not."""
        return self._robot is not None

    @property
    def health(self) -> Mapping[BodyName, Health]:
        """How every body is, in words for the experimenter."""
        return {body.name: body.health for body in (self._robot, self._avatar) if body is not None}

    @property
    def settled(self) -> bool:
        """Whether the robot, if there is one, has been looked for."""
        return not self._unsettled

    @property
    def busy(self) -> bool:
        """Whether a robot is at something that takes its own time."""
        return self._robot is not None and self._robot.busy

    def take(self, avatar: Body) -> None:
        """Have this body help whenever no robot does."""
        self._avatar = avatar
        self._enter(avatar)

    def take_robot(self, robot: RobotBody) -> None:
        """Look for this robot, and have it help as soon as it is found and no sitting is under way."""
        self._robot = robot
        self._unsettled = True
        robot.look_for()

    def prefer(self, name: BodyName) -> None:
        """Have the avatar help, or the robot whenever it is well, from the next sitting on."""
        self._prefers_avatar = name is BodyName.AVATAR
        if not self._in_sitting:
            self._choose()

    def be_quiet(self) -> None:
        """Let no sentence be heard; one that is being said breaks off."""
        if self._mouth is not None:
            self._mouth.shut_up()

    def be_heard(self) -> None:
        """Let sentences be heard again."""
        if self._mouth is not None:
            self._mouth.open()

    def begin(self, language: str) -> None:
        """A sitting begins in this language: the body stays as it is, unless the robot is lost."""
        self._in_sitting = True
        for body in (self._avatar, self._robot):
            if body is not None:
                body.speak(language)

    def rest(self) -> None:
        """No sitting is under way: nothing of the last one is kept, and the robot may be taken back."""
        kept = self._in_sitting and self._robot is not None and self._current is self._robot
        self._in_sitting = False
        if kept:
            self._pause = self._settings.retry_first
        if self._current is not None:
            self._current.rest()
        self._choose()
        if self._due:
            self._see_to_robot()

    def change(self, to: BodyName) -> None:
        """Have the body of this name help from now on, if there is one."""
        self._enter(next((body for body in (self._avatar, self._robot) if body is not None and body.name is to), None))

    def close(self) -> None:
        """Let go of the robot; the avatar is let go of by whoever made it."""
        self._stop_waiting()
        if self._robot is not None:
            self._robot.close()

    def speech_started(self, utterance: int) -> None:
        """The body began to say a sentence."""
        self._listener.speech_started(utterance)

    def speech_finished(self, utterance: int) -> None:
        """The body has said a sentence."""
        if self._mouth is not None:
            self._mouth.said(utterance)
        self._listener.speech_finished(utterance)

    def speech_failed(self, utterance: int, why: str) -> None:
        """The body will not say a sentence."""
        if self._mouth is not None:
            self._mouth.said(utterance)
        self._listener.speech_failed(utterance, why)

    def robot_found(self) -> None:
        """The robot can be counted on."""
        self._unsettled = False
        if not self._in_sitting:
            self._choose()
        self._wait_for_robot(self._settings.probe_every)

    def robot_lost(self, why: str) -> None:
        """The robot cannot be counted on; if it was helping somebody, that is an event of their sitting."""
        _log.info("%s", why)
        self._unsettled = False
        if self._in_sitting and self._current is self._robot:
            self._listener.robot_lost(why)
        elif not self._in_sitting:
            self._choose()
        self._wait_for_robot(self._pause)
        self._pause = min(2 * self._pause, self._settings.retry_longest)

    def _choose(self) -> None:
        well = self._robot is not None and self._robot.health.well
        self._enter(self._robot if well and not self._prefers_avatar else self._avatar)

    def _enter(self, body: Body | None) -> None:
        before, self._current = self._current, body
        if body is before:
            return
        if before is not None:
            before.withdraw()
        if body is not None:
            self._lend_mouth(body)
            body.appear()

    def _lend_mouth(self, body: Body) -> None:
        """One mouth for whoever helps: whether it is shut outlasts a change of body."""
        if self._mouth is None:
            self._mouth = Mouth(body, self._listener)
        self._mouth.body = body

    def _wait_for_robot(self, ms: int) -> None:
        """After so long see to it; if somebody is playing then, as soon as they are gone."""
        self._stop_waiting()
        self._wait = self._after(ms, self._see_to_robot)

    def _see_to_robot(self) -> None:
        """See whether the robot is still well, or back."""
        self._wait = None
        self._due = self._in_sitting
        if self._robot is None or self._in_sitting:
            return
        if self._robot.health.well:
            self._robot.probe()
            self._wait_for_robot(self._settings.probe_every)
        else:
            self._robot.look_for()

    def _stop_waiting(self) -> None:
        wait, self._wait = self._wait, None
        if wait is not None:
            wait.cancel()
