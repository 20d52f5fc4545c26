"""Where the board lies for a robot: from a place on the screen to metres along the robot's own axes."""

from __future__ import annotations

from kiosk.robot.body import Place
from kiosk.settings import Robot as RobotSettings

MIDDLE = 0.5


def location(place: Place, settings: RobotSettings) -> tuple[float, float, float]:
    """A place on the board as x, y, z in metres, by the axes that the study file names."""
    sideways, up, forward = settings.board_middle
    width, height = settings.board_size
    seen = (sideways + (place.across - MIDDLE) * width, up + (MIDDLE - place.down) * height, forward)
    by_axis = {
        axis[-1]: -metres if axis[0] == "-" else metres
        for axis, metres in zip(settings.axes.split(), seen, strict=True)
    }
    return by_axis.get("x", 0.0), by_axis.get("y", 0.0), by_axis.get("z", 0.0)
