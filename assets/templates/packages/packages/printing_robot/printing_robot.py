"""A robot that prints what it says, and takes its time to answer."""

import sys
from threading import Event
from typing import Annotated, ClassVar

from pydantic import Field

from kiosk.config import ConfigModel, RobotConfig
from kiosk.robots.driver import Capabilities, FailureKind, RobotDriver, RobotError, Utterance


class PrintingOptions(ConfigModel):
    """The table [robot.options] of a study file."""

    delay_ms: Annotated[int, Field(ge=0, le=60_000)] = 20


class PrintingRobot(RobotDriver):
    """Prints on the error stream, which a kiosk leaves alone."""

    name: ClassVar[str] = "printing"
    options: ClassVar[type[ConfigModel]] = PrintingOptions
    longest_text: ClassVar[int] = 500

    def __init__(self, settings: RobotConfig, language: str) -> None:
        super().__init__(settings, language)
        self._delay_s = PrintingOptions.model_validate(settings.options).delay_ms / 1000

    def connect(self) -> Capabilities:
        """Find the robot, which is always there.

        A robot on the network raises RobotError here when it does not answer.
        """
        return Capabilities(voices=(), gestures=(), voice=None)

    def say(self, saying: Utterance) -> None:
        cut = Event()
        saying.on_cancel(cut.set)
        saying.started()
        print(f"robot: {saying.text}", file=sys.stderr)
        if cut.wait(self._delay_s):
            raise RobotError(FailureKind.CUT, "say")
