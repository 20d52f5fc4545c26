"""The name of who helps with voice and face, as the records and the experimenter's panel have it."""

from __future__ import annotations

from enum import Enum
from typing import ClassVar

from kiosk.lazy_dataclass import dataclass


class EmbodimentKind(Enum):
    """What helps with voice and face."""

    AVATAR = "avatar"
    ROBOT = "robot"


@dataclass(frozen=True)
class EmbodimentName:
    """Who helps with voice and face: the avatar, or a robot by the name of its driver.

    In the records it is the text ``avatar``, or ``robot:`` and the driver's name.
    """

    AVATAR: ClassVar[EmbodimentName]
    kind: EmbodimentKind
    driver: str = ""

    @classmethod
    def robot(cls, driver: str) -> EmbodimentName:
        """Return the robot of a driver."""
        return cls(EmbodimentKind.ROBOT, driver)

    @classmethod
    def from_text(cls, text: str) -> EmbodimentName:
        """Return the name that a record holds; raises ValueError for anything else."""
        kind, _, driver = text.partition(":")
        return cls(EmbodimentKind(kind), driver)

    def __post_init__(self) -> None:
        """Refuse an avatar with a driver, and a robot without one."""
        if bool(self.driver) != (self.kind is EmbodimentKind.ROBOT):
            raise ValueError(f"{self.kind.value!r} with the driver {self.driver!r} is no embodiment")

    def __str__(self) -> str:
        """As it stands in the records."""
        return f"{self.kind.value}:{self.driver}" if self.driver else self.kind.value


EmbodimentName.AVATAR = EmbodimentName(EmbodimentKind.AVATAR)
