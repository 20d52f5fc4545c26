"""Which embodiment helps now, and which one takes over when a robot fails."""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping
from typing import Protocol

from kiosk.config import RobotConfig as RobotSettings
from kiosk.experiment.events import FallbackReason
from kiosk.experiment.outcomes import EmbodimentName
from kiosk.robots.adapter import AsyncRobotAdapter
from kiosk.robots.embodiment import Embodiment, Health, MutableSpeech, SpeechListener

_log = logging.getLogger(__name__)


class TimerHandle(Protocol):
    """A wait that is under way."""

    def cancel(self) -> None:
        """Forget it."""
        ...


After = Callable[[int, Callable[[], None]], TimerHandle]
"""Calls back once, on the interface's thread, in so many milliseconds."""


class EmbodimentSelector:
    """The embodiments of one kiosk, and which of them helps now; what they report passes through here."""

    def __init__(self, listener: SpeechListener, after: After, settings: RobotSettings) -> None:
        """Say nothing until there is a body: ``set_avatar`` brings the avatar, ``attach_robot`` the robot."""
        self.on_own_voice: Callable[[str], None] = lambda _: None
        """Called with the reason why the robot does not play the clips that it was to play."""
        self.on_other_voice: Callable[[str], None] = lambda _: None
        """Called with what is wrong with the robot's voice."""
        self._listener = listener
        self._after = after
        self._settings = settings
        self._avatar: Embodiment | None = None
        self._robot: AsyncRobotAdapter | None = None
        self._current: Embodiment | None = None
        self._mouth: MutableSpeech | None = None
        self._muted = self._muted_by_visitor = False
        self._prefers_avatar = False
        self._in_session = False
        self._unsettled = False
        self._pause = settings.backoff_initial_ms
        self._wait: TimerHandle | None = None
        self._due = False

    @property
    def current(self) -> Embodiment | None:
        """The body that helps now."""
        return self._mouth

    @property
    def is_muted(self) -> bool:
        """Whether the experimenter lets no sentence be heard."""
        return self._muted

    @property
    def is_silent(self) -> bool:
        """Whether no sentence is heard, because the experimenter or the visitor wants it so."""
        return self._muted or self._muted_by_visitor

    @property
    def prefers_avatar(self) -> bool:
        """Whether the avatar helps even when the robot is well."""
        return self._prefers_avatar

    @property
    def has_robot(self) -> bool:
        """Whether there is a robot to choose, well or not."""
        return self._robot is not None

    @property
    def health(self) -> Mapping[EmbodimentName, Health]:
        """How every body is, in words for the experimenter."""
        return {body.name: body.health for body in (self._robot, self._avatar) if body is not None}

    @property
    def intended(self) -> EmbodimentName:
        """The body that is meant to help: the robot, if the kiosk has one."""
        return self._robot.name if self._robot is not None else EmbodimentName.AVATAR

    @property
    def fallback(self) -> tuple[FallbackReason, str] | None:
        """Why the robot does not help now, with what its driver says; None if it does, or there is none."""
        if self._robot is None or self._current is self._robot:
            return None
        if self._prefers_avatar:
            return FallbackReason.CHOSEN, ""
        return (FallbackReason.SOUGHT if self._unsettled else FallbackReason.FAILED), self._robot.health.message

    @property
    def robot_spoken_by(self) -> Mapping[str, str]:
        """What speaks the robot's sentence under way, if it is a clip of the voice pack."""
        return {} if self._robot is None else self._robot.spoken_by

    @property
    def settled(self) -> bool:
        """Whether the robot, if there is one, has been looked for."""
        return not self._unsettled

    @property
    def busy(self) -> bool:
        """Whether a robot is at something that takes its own time."""
        return self._robot is not None and self._robot.busy

    def set_avatar(self, avatar: Embodiment) -> None:
        """Have this body help whenever no robot does."""
        self._avatar = avatar
        self._enter(avatar)

    def attach_robot(self, robot: AsyncRobotAdapter) -> None:
        """Look for this robot, and have it help as soon as it is found and no session is under way."""
        self._robot = robot
        self._unsettled = True
        robot.connect()

    def prefer(self, name: EmbodimentName) -> None:
        """Have the avatar help, or the robot whenever it is well, from the next session on."""
        self._prefers_avatar = name == EmbodimentName.AVATAR
        if not self._in_session:
            self._choose()

    def mute(self) -> None:
        """Let no sentence be heard; one that is being said breaks off."""
        self._muted = True
        self._apply_mute()

    def unmute(self) -> None:
        """Let sentences be heard again, unless the visitor wants silence."""
        self._muted = False
        self._apply_mute()

    def set_sound(self, *, on: bool) -> None:
        """Let the visitor hear sentences or not; it holds to the end of the session."""
        self._muted_by_visitor = not on
        self._apply_mute()

    def set_language(self, language: str) -> None:
        """Speak this language from the next sentence on."""
        for body in (self._avatar, self._robot):
            if body is not None:
                body.set_language(language)

    def _apply_mute(self) -> None:
        if self._mouth is None or self._mouth.muted is self.is_silent:
            return
        if self.is_silent:
            self._mouth.mute()
        else:
            self._mouth.unmute()

    def begin_session(self, language: str) -> None:
        """Begin a session in this language: the body stays as it is, unless the robot is lost."""
        self._in_session = True
        self.set_language(language)

    def end_session(self) -> None:
        """No session is under way: nothing of the last one is kept, and the robot may be taken back."""
        kept = self._in_session and self._robot is not None and self._current is self._robot
        self._in_session = False
        self.set_sound(on=True)
        if kept:
            self._pause = self._settings.backoff_initial_ms
        if self._current is not None:
            self._current.reset()
        self._choose()
        if self._due:
            self._see_to_robot()

    def switch_to(self, to: EmbodimentName) -> None:
        """Have the body of this name help from now on, if there is one."""
        self._enter(next((body for body in (self._avatar, self._robot) if body is not None and body.name == to), None))

    def close(self) -> None:
        """Let go of the robot; the avatar belongs to the caller that made it."""
        self._stop_waiting()
        if self._robot is not None:
            self._robot.close()

    def speech_started(self, utterance: int) -> None:
        """Pass on that the body began to say a sentence."""
        self._listener.speech_started(utterance)

    def speech_finished(self, utterance: int) -> None:
        """Pass on that the body has said a sentence."""
        if self._mouth is not None:
            self._mouth.said(utterance)
        self._listener.speech_finished(utterance)

    def speech_failed(self, utterance: int, why: str) -> None:
        """Pass on that the body will not say a sentence."""
        if self._mouth is not None:
            self._mouth.said(utterance)
        self._listener.speech_failed(utterance, why)

    def robot_found(self) -> None:
        """Use the robot that was found, or wait for the end of the session to do so."""
        self._unsettled = False
        if not self._in_session:
            self._choose()
        self._wait_for_robot(self._settings.health_check_ms)

    def robot_uses_own_voice(self, why: str) -> None:
        """Pass on that the robot speaks with its own voice, though it was to play clips."""
        _log.warning("the robot speaks with its own voice: %s", why)
        self.on_own_voice(why)

    def robot_has_other_voice(self, why: str) -> None:
        """Pass on that the robot speaks with a voice that is not meant."""
        _log.warning("the robot has another voice than it should: %s", why)
        self.on_other_voice(why)

    def robot_lost(self, why: str) -> None:
        """Record the loss in the session that the robot was helping in, or change to the avatar."""
        _log.info("%s", why)
        self._unsettled = False
        if self._in_session and self._current is self._robot:
            self._listener.robot_lost(why)
        elif not self._in_session:
            self._choose()
        self._wait_for_robot(self._pause)
        self._pause = min(2 * self._pause, self._settings.backoff_max_ms)

    def _choose(self) -> None:
        well = self._robot is not None and self._robot.health.is_ok
        self._enter(self._robot if well and not self._prefers_avatar else self._avatar)

    def _enter(self, body: Embodiment | None) -> None:
        before, self._current = self._current, body
        if body is before:
            return
        if before is not None:
            before.deactivate()
        if body is not None:
            self._lend_mouth(body)
            body.activate()

    def _lend_mouth(self, body: Embodiment) -> None:
        """Give the one mouth to a body: whether it is shut outlasts a change of body."""
        if self._mouth is None:
            self._mouth = MutableSpeech(body, self._listener)
            self._apply_mute()
        self._mouth.embodiment = body

    def _wait_for_robot(self, ms: int) -> None:
        """Look at the robot after so long; during a session, as soon as it is over."""
        self._stop_waiting()
        self._wait = self._after(ms, self._see_to_robot)

    def _see_to_robot(self) -> None:
        """See whether the robot is still well, or back."""
        self._wait = None
        self._due = self._in_session
        if self._robot is None or self._in_session:
            return
        if self._robot.health.is_ok:
            self._robot.health_check()
            self._wait_for_robot(self._settings.health_check_ms)
        else:
            self._robot.connect()

    def _stop_waiting(self) -> None:
        wait, self._wait = self._wait, None
        if wait is not None:
            wait.cancel()
