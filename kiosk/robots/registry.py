"""Which robot a study file asks for. What a robot needs is loaded only when there is one: it takes half a second."""

from __future__ import annotations

from kiosk import UserInputError
from kiosk.config import RobotConfig as RobotSettings
from kiosk.robots.embodiment import RobotDriver


def create_robot(settings: RobotSettings, language: str) -> RobotDriver | None:
    """The robot of these settings, not yet looked for; None if the avatar is to be alone."""
    match settings.kind:
        case "none":
            return None
        case "furhat":
            from kiosk.robots.furhat import Furhat  # noqa: PLC0415

            return Furhat(settings, language)
        case "furhat-realtime":
            return _realtime(settings, language)


def _realtime(settings: RobotSettings, language: str) -> RobotDriver:
    try:
        from kiosk.robots.furhat_realtime import FurhatRealtime  # noqa: PLC0415
    except ModuleNotFoundError as error:
        raise UserInputError(
            "for furhat-realtime the package websockets is missing; install recollect[realtime]"
        ) from error
    return FurhatRealtime(settings, language)
