"""What is being said in a sitting, so that it can be said again, or by another body."""

from __future__ import annotations

from collections.abc import Iterable

from kiosk.study import commands as do
from kiosk.study import events as happened
from kiosk.study.commands import Command, Script
from kiosk.study.events import BodyName, WorldEvent
from kiosk.study.scenes.scene import Speaker


class Talk:
    """Keeps the sentence in the bubble, and whether it has been said to its end."""

    def __init__(self, speaker: Speaker) -> None:
        """Sentences that are said again get their numbers from the speaker."""
        self._speaker = speaker
        self._robot_lost = False
        self._said: do.Speak | None = None
        self._unsaid: do.Speak | None = None

    def accepts(self, event: WorldEvent) -> bool:
        """Whether this event can happen now."""
        match event:
            case happened.RobotLost():
                return not self._robot_lost
            case happened.RepeatAsked():
                return self._said is not None and self._unsaid is None
        return True

    def react(self, event: WorldEvent, script: Script) -> None:
        """Say something again, have the avatar say what the robot did not, or note that it was said."""
        match event:
            case happened.RobotLost(why=why):
                self._go_on_without_robot(why, script)
            case happened.RepeatAsked() if self._said is not None:
                self._speaker.repeat(self._said, script)
            case happened.SittingResumed():
                self._robot_lost = False
            case happened.SpeechFinished(utterance=utterance) | happened.SpeechFailed(utterance=utterance):
                if self._unsaid is not None and self._unsaid.utterance == utterance:
                    self._unsaid = None

    def keep_track(self, commands: Iterable[Command]) -> None:
        """Remember what these commands have said, or silenced."""
        for command in commands:
            match command:
                case do.Speak():
                    self._said = self._unsaid = command
                case do.StopSpeaking():
                    self._unsaid = None
                case do.ClearBubble():
                    self._said = None

    def _go_on_without_robot(self, why: str, script: Script) -> None:
        """Have the avatar help; it says at once what the robot had not said to its end."""
        self._robot_lost = True
        script.note(happened.BodyChanged(at_ms=script.at_ms, body=BodyName.AVATAR, why=why))
        script.do(do.ChangeBody(BodyName.AVATAR))
        if self._unsaid is not None:
            script.do(self._unsaid)
