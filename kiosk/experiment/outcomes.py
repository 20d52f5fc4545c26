"""What a session is, how it came to its condition, who helped, how far it got and how it ended.

The database holds these words. The module loads little, so that a list of sessions is there at once.
"""

from __future__ import annotations

from enum import Enum, IntEnum
from typing import ClassVar

from kiosk.lazy_dataclass import dataclass

CARDS_IN_A_MOVE = 2


class SessionKind(IntEnum):
    """The kinds of sessions. Each numbers its own people, follows its own list of places and is counted by itself.

    The numbers stand in the database, in the columns ``simulated``. ``False`` and ``True`` mean the first two.
    """

    STUDY = 0
    """A participant, at a kiosk that only the PIN leaves."""
    SIMULATED = 1
    """A program, in a rehearsal."""
    TRIAL = 2
    """A person at a kiosk without a PIN."""


class AllocationSource(Enum):
    """How a session came to its condition."""

    LIST = "list"
    """It took the first free slot of the list."""
    OVERRIDE = "override"
    """The experimenter chose; it takes no slot."""
    BEYOND = "beyond"
    """The list is used up."""
    RETURNING = "returning"
    """The participant was here before, and earlier visits decide; it takes no slot."""


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


class Stage(Enum):
    """A part of the session."""

    ATTRACT = "attract"
    ABOUT = "about"
    AGE = "age"
    CONSENT = "consent"
    ABOUT_YOU = "about_you"
    INTRODUCTION = "introduction"
    PRACTICE = "practice"
    GAME = "game"
    RESULT = "result"
    QUESTIONS = "questions"
    DEBRIEF = "debrief"
    THANKS = "thanks"
    OVER = "over"


class Status(Enum):
    """How a session ended."""

    COMPLETED = "completed"
    ABANDONED = "abandoned"
    STOPPED = "stopped"
    """The experimenter ended it, with a reason."""
    WITHDRAWN = "withdrawn"
    """The visitor stopped it."""
    INTERRUPTED = "interrupted"


class NotRecordedReason(Enum):
    """Why nothing of a session is kept but that it was."""

    DECLINED = "declined"
    UNDER_AGE = "under_age"
    LEFT = "left"
    """The visitor left before they had decided."""


class RecordingState(Enum):
    """Whether the session is written down."""

    UNDECIDED = "undecided"
    """What happens is held back until the visitor has decided."""
    KEPT = "kept"
    FORGOTTEN = "forgotten"


class Disposition(Enum):
    """What became of a session, as far as the allocation list goes; every session has exactly one."""

    CONSUMED = "consumed"
    """Its game was completed, so its slot is consumed."""
    DROPPED_OUT = "dropped_out"
    """It had a slot, which was given out again."""
    UNDER_WAY = "under_way"
    """It has a slot, and its game may still be completed."""
    OVERRIDDEN = "overridden"
    BEYOND = "beyond"
    RETURNING = "returning"
    """Its participant was here before, and took no slot."""
    UNLISTED = "unlisted"
    """No allocation list was followed."""
