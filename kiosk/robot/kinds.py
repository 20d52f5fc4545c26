"""Which robot a study file asks for. What a robot needs is loaded only when there is one: it takes half a second."""

from __future__ import annotations

from kiosk import BadInput
from kiosk.robot.device import Robot
from kiosk.settings import Robot as RobotSettings


def robot_of(settings: RobotSettings, language: str) -> Robot | None:
    """The robot of these settings, not yet looked for; None if the avatar is to be alone."""
    match settings.kind:
        case "none":
            return None
        case "furhat":
            from kiosk.robot.furhat.remote import Furhat  # noqa: PLC0415

            return Furhat(settings, language)
        case "furhat-realtime":
            return _realtime(settings, language)


def _realtime(settings: RobotSettings, language: str) -> Robot:
    try:
        from kiosk.robot.furhat.realtime import FurhatRealtime  # noqa: PLC0415
    except ModuleNotFoundError as error:
        raise BadInput("for furhat-realtime the package websockets is missing; install recollect[realtime]") from error
    return FurhatRealtime(settings, language)
