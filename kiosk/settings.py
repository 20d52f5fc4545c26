"""The study file: every setting declared once, typed, with a sentence and its unit.

It stands below the rooms: they may know its types and are handed their part of it. None reads a file.
"""

from __future__ import annotations

import hashlib
import tomllib
from pathlib import Path
from typing import Annotated, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, NonNegativeInt, PositiveFloat, PositiveInt, ValidationError

from kiosk import BadInput


class _Section(BaseModel):
    """A part of the study file: unchangeable once read, and a key that does not exist is refused."""

    model_config = ConfigDict(frozen=True, extra="forbid")


class Timing(_Section):
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


class Game(_Section):
    """The board."""

    rows: Annotated[PositiveInt, Field(description="Rows of the board.")] = 4
    columns: Annotated[PositiveInt, Field(description="Columns of the board.")] = 6
    deck: Annotated[str, Field(description="The folder of assets/cards that holds the pictures.")] = "animals"


class Assistance(_Section):
    """Who helps, and how."""

    condition: Annotated[str, Field(description="Which help the next visitor gets: tom, notom, or another cell.")] = (
        "tom"
    )
    policy: Annotated[str, Field(description="The frozen Q-table: a name in policies/, or a path.")] = "default"
    target_rule: Annotated[
        Literal["most_flipped", "most_recent"], Field(description="Where a mentalised hint for a first card points.")
    ] = "most_flipped"


class Voice(_Section):
    """The avatar's voice."""

    enabled: Annotated[bool, Field(description="Whether sentences are spoken as well as shown.")] = True
    rate: Annotated[int, Field(ge=80, le=300, description="How fast it speaks, in words per minute.")] = 150
    volume: Annotated[float, Field(ge=0, le=1, description="How loud it speaks, 0 to 1.")] = 0.9


class Screen(_Section):
    """The window."""

    text_size: Annotated[PositiveFloat, Field(le=2, description="All texts, as a factor of their usual size.")] = 1.0
    motion: Annotated[bool, Field(description="Whether cards turn and screens fade; off for reduced motion.")] = True


class Settings(_Section):
    """Everything that one study may set."""

    language: Annotated[str, Field(description="The folder of assets/sentences.")] = "en"
    questionnaire: Annotated[str, Field(description="The file of assets/questionnaires, without its ending.")] = (
        "closing"
    )
    game: Game = Game()
    assistance: Assistance = Assistance()
    timing: Timing = Timing()
    voice: Voice = Voice()
    screen: Screen = Screen()

    @classmethod
    def read(cls, path: Path) -> Self:
        """Read a study file (TOML); raises BadInput with a sentence that names the key."""
        try:
            return cls.model_validate(tomllib.loads(path.read_text("utf-8")))
        except OSError as error:
            raise BadInput(f"the study file {path} cannot be read: {error.strerror}") from error
        except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
            raise BadInput(f"the study file {path} is not TOML: {error}") from error
        except ValidationError as error:
            first = error.errors()[0]
            key = ".".join(str(part) for part in first["loc"])
            raise BadInput(f"the study file {path}: {key}: {first['msg']}, but it is {first['input']!r}") from error

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
