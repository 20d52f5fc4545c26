"""The study file: every setting declared once, typed, with a sentence and its unit.

It stands below the rooms: they may know its types and are handed their part of it. None reads a file.
"""

from __future__ import annotations

import hashlib
import tomllib
from pathlib import Path
from typing import Annotated, ClassVar, Literal, Self

from pydantic import (
    BaseModel,
    ConfigDict,
    Field,
    NonNegativeInt,
    PositiveFloat,
    PositiveInt,
    ValidationError,
    field_validator,
)

from kiosk import BadInput


class Declared(BaseModel):
    """Something that is declared in a TOML file, in whole or in part.

    It is unchangeable once read; a key that does not exist is refused, and so is a value that would have to be bent.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)

    file_kind: ClassVar[str] = "file"
    """What such a file is called in a refusal."""

    @classmethod
    def read(cls, path: Path) -> Self:
        """Read a file; raises BadInput with one sentence that names the file, and the key if it is about one."""
        try:
            return cls.model_validate(tomllib.loads(path.read_text("utf-8")))
        except OSError as error:
            raise BadInput(f"the {cls.file_kind} {path} cannot be read: {error.strerror}") from error
        except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
            raise BadInput(f"the {cls.file_kind} {path} is not TOML: {error}") from error
        except ValidationError as error:
            first = error.errors()[0]
            key = ".".join(str(part) for part in first["loc"])
            raise BadInput(
                f"the {cls.file_kind} {path}: {key}: {first['msg']}, but it is {first['input']!r}"
            ) from error


class Timing(Declared):
    """When things happen in a sitting; all times in milliseconds."""

    turn_back: Annotated[PositiveInt, Field(description="How long two unmatched cards stay open.")] = 1200
    mark_delay: Annotated[
        NonNegativeInt, Field(description="From the start of a spoken hint to its mark; never later than its end.")
    ] = 3500
    mark_delay_silent: Annotated[
        NonNegativeInt, Field(description="The same for a hint that is only shown as text.")
    ] = 600
    reading: Annotated[PositiveInt, Field(description="Time to read a sentence without voice, per character.")] = 55
    reading_least: Annotated[PositiveInt, Field(description="The least time to read any sentence.")] = 1500
    speech_deadline: Annotated[
        PositiveInt, Field(description="The longest that a spoken sentence may hold up the game, per character.")
    ] = 130
    speech_deadline_least: Annotated[PositiveInt, Field(description="The same, whatever its length.")] = 4000
    mood: Annotated[PositiveInt, Field(description="How long the assistant looks happy, confused or sad.")] = 2500
    finish: Annotated[PositiveInt, Field(description="From the last pair to the result.")] = 1800
    idle: Annotated[PositiveInt, Field(description="Without a tap, until the visitor is asked: still there?")] = 45_000
    idle_game: Annotated[PositiveInt, Field(description="The same during the game.")] = 120_000
    still_there: Annotated[PositiveInt, Field(description="From that question to the end of the sitting.")] = 20_000

    def reading_time(self, sentence: str) -> int:
        """How long a sentence is shown for reading, in ms."""
        return max(self.reading_least, self.reading * len(sentence))

    def speech_time(self, sentence: str) -> int:
        """How long a spoken sentence may hold up the game, in ms."""
        return max(self.speech_deadline_least, self.speech_deadline * len(sentence))


class Game(Declared):
    """The board."""

    rows: Annotated[PositiveInt, Field(description="Rows of the board.")] = 4
    columns: Annotated[PositiveInt, Field(description="Columns of the board.")] = 6
    deck: Annotated[str, Field(description="The folder of assets/cards that holds the pictures.")] = "animals"


class Assistance(Declared):
    """Who helps, and how."""

    condition: Annotated[str, Field(description="Which help the next visitor gets: tom, notom, or another cell.")] = (
        "tom"
    )
    policy: Annotated[str, Field(description="The frozen Q-table: a name in policies/, or a path.")] = "default"
    target_rule: Annotated[
        Literal["most_flipped", "most_recent"], Field(description="Where a mentalised hint for a first card points.")
    ] = "most_flipped"
    step: Annotated[
        float,
        Field(
            ge=0,
            le=1,
            description="How far one flip may move a value of the table within a sitting; 0 keeps it frozen.",
        ),
    ] = 0.0


class Voice(Declared):
    """The avatar's voice."""

    enabled: Annotated[bool, Field(description="Whether sentences are spoken as well as shown.")] = True
    rate: Annotated[int, Field(ge=80, le=300, description="How fast it speaks, in words per minute.")] = 150
    volume: Annotated[float, Field(ge=0, le=1, description="How loud it speaks, 0 to 1.")] = 0.9
    sounds: Annotated[
        bool, Field(description="Whether cards are heard: quiet sounds, never while somebody speaks.")
    ] = True


class Screen(Declared):
    """The window."""

    text_size: Annotated[PositiveFloat, Field(le=1.3, description="All texts, as a factor of their usual size.")] = 1.0
    motion: Annotated[bool, Field(description="Whether cards turn and screens fade; off for reduced motion.")] = True


class Robot(Declared):
    """The robot that speaks in the avatar's place, if there is one; all times in milliseconds, all lengths in metres.

    ``board_middle`` and ``board_size`` are told as the robot sees them: sideways, up, and forward.
    """

    kind: Annotated[
        Literal["none", "furhat", "furhat-realtime"], Field(description="Which robot, or none: the avatar alone.")
    ] = "none"
    host: Annotated[str, Field(description="Its name or address on the network.")] = "localhost"
    port: Annotated[
        int | None, Field(ge=1, le=65535, description="Its port; by default 54321, or 9000 for furhat-realtime.")
    ] = None
    key: Annotated[
        str, Field(exclude=True, description="The key of the Realtime API, if it asks for one; never recorded.")
    ] = ""
    voice: Annotated[str, Field(description="Its voice by name; by default the first one of the language.")] = ""
    connect_deadline: Annotated[PositiveInt, Field(description="The longest that reaching it may take.")] = 1000
    answer_deadline: Annotated[PositiveInt, Field(description="The longest that any answer but speech may take.")] = (
        1500
    )
    speech_deadline: Annotated[
        PositiveInt, Field(description="The longest that it may take to say a sentence, per character.")
    ] = 110
    speech_deadline_least: Annotated[PositiveInt, Field(description="The same, whatever its length.")] = 3500
    look_every: Annotated[PositiveInt, Field(description="While it speaks, how often to see if it still answers.")] = (
        1000
    )
    probe_every: Annotated[PositiveInt, Field(description="Between sittings, how often to see if it is well.")] = 10_000
    retry_first: Annotated[PositiveInt, Field(description="The first pause before a lost robot is tried again.")] = 2000
    retry_longest: Annotated[PositiveInt, Field(description="The longest such pause; each is twice the last.")] = (
        120_000
    )
    gestures: Annotated[bool, Field(description="Whether it shows moods with its face.")] = True
    attend: Annotated[bool, Field(description="Whether it looks at the player, and at the hinted place.")] = True
    axes: Annotated[
        str,
        Field(
            pattern=r"^-?[xyz] -?[xyz] -?[xyz]$",
            description="Its axes for sideways (the visitor's right), up and forward, each with a minus if reversed.",
        ),
    ] = "x y z"
    board_middle: Annotated[
        tuple[float, float, float],
        Field(strict=False, description="Where the middle of the board is, seen from its eyes."),
    ] = (0.4, -0.2, 0.5)
    board_size: Annotated[
        tuple[PositiveFloat, PositiveFloat],
        Field(strict=False, description="How wide and how high the board is on the screen."),
    ] = (0.4, 0.25)

    @field_validator("axes")
    @classmethod
    def _name_every_axis(cls, axes: str) -> str:
        if {axis[-1] for axis in axes.split()} != {"x", "y", "z"}:
            raise ValueError("each of x, y and z must be named once")
        return axes

    def speech_time(self, sentence: str) -> int:
        """How long it may take to say a sentence, in ms."""
        return max(self.speech_deadline_least, self.speech_deadline * len(sentence))


class Settings(Declared):
    """Everything that one study may set."""

    file_kind = "study file"

    language: Annotated[str, Field(description="The folder of assets/sentences.")] = "en"
    questionnaire: Annotated[str, Field(description="The file of assets/questionnaires, without its ending.")] = (
        "closing"
    )
    game: Game = Game()
    assistance: Assistance = Assistance()
    timing: Timing = Timing()
    voice: Voice = Voice()
    robot: Robot = Robot()
    screen: Screen = Screen()

    @property
    def sha256(self) -> str:
        """The hash of every setting, given or default, so that a sitting's settings can be told apart later."""
        return hashlib.sha256(self.model_dump_json().encode()).hexdigest()


def _beside_or_inside(name: str) -> Path:
    """A folder that stands inside the installed package, or beside it in a checkout."""
    package = Path(__file__).parent
    return package / name if (package / name).is_dir() else package.parent / name


ASSETS = _beside_or_inside("assets")
POLICIES = _beside_or_inside("policies")


def policy_path(name: str) -> Path:
    """The file of a shipped policy by its name, or the path itself."""
    shipped = POLICIES / f"{name}.json"
    return shipped if shipped.is_file() else Path(name)
