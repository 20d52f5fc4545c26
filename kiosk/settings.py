"""The study file: every setting declared once, typed, with a sentence and its unit.

It stands below the rooms: they may know its types and are handed their part of it. None reads a file.
"""

from __future__ import annotations

import hashlib
import re
import tomllib
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import (
    BaseModel,
    ConfigDict,
    Field,
    NonNegativeInt,
    PositiveFloat,
    PositiveInt,
    PrivateAttr,
    ValidationError,
    field_validator,
    model_validator,
)

from kiosk import BadInput
from kiosk.refusals import not_toml, refusals

STAGES = (
    "about",
    "consent",
    "age",
    "about_you",
    "introduction",
    "practice",
    "game",
    "result",
    "questions",
    "debrief",
    "thanks",
)
"""Every stage that a sitting can have between attract and its end, in the study's order."""


class Declared(BaseModel):
    """Something that is declared in a TOML file, in whole or in part.

    It is unchangeable once read; a key that does not exist is refused, and so is a value that would have to be bent.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)

    file_kind: ClassVar[str] = "file"
    """What such a file is called in a refusal."""

    @classmethod
    def read(cls, path: Path) -> Self:
        """Read a file; raises BadInput with a sentence for everything that is wrong, naming the file and the key."""
        name = f"the {cls.file_kind} {path}"
        given = _toml(name, path)
        try:
            return cls.model_validate(given)
        except ValidationError as error:
            raise BadInput(*(f"{name}: {sentence}" for sentence in refusals(error, given, cls))) from error


def _toml(name: str, path: Path) -> dict[str, Any]:
    try:
        # Some editors begin a file with a mark that is no text.
        return tomllib.loads(path.read_text("utf-8-sig"))
    except OSError as error:
        raise BadInput(f"{name} cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise BadInput(f"{name} is not UTF-8; save it with that encoding") from error
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise BadInput(f"{name} is not TOML: {not_toml(error)}") from error


@dataclass(frozen=True)
class Unit:
    """What a setting is measured in."""

    name: str


Milliseconds = Annotated[PositiveInt, Unit("ms")]


class Timing(Declared):
    """When things happen in a sitting; all times in milliseconds."""

    turn_back: Annotated[Milliseconds, Field(description="How long two unmatched cards stay open.")] = 1200
    mark_delay: Annotated[
        NonNegativeInt,
        Unit("ms"),
        Field(description="From the start of a spoken hint to its mark; never later than its end."),
    ] = 3500
    mark_delay_silent: Annotated[
        NonNegativeInt, Unit("ms"), Field(description="The same for a hint that is only shown as text.")
    ] = 600
    reading: Annotated[Milliseconds, Field(description="Time to read a sentence without voice, per character.")] = 55
    reading_least: Annotated[Milliseconds, Field(description="The least time to read any sentence.")] = 1500
    speech_deadline: Annotated[
        Milliseconds, Field(description="The longest that a spoken sentence may hold up the game, per character.")
    ] = 130
    speech_deadline_least: Annotated[Milliseconds, Field(description="The same, whatever its length.")] = 4000
    mood: Annotated[Milliseconds, Field(description="How long the assistant looks happy, confused or sad.")] = 2500
    finish: Annotated[Milliseconds, Field(description="From the last pair to the result.")] = 1800
    thanks: Annotated[Milliseconds, Field(description="How long the thanks stay, if nobody taps them away.")] = 12_000

    def reading_time(self, sentence: str) -> int:
        """How long a sentence is shown for reading, in ms."""
        return max(self.reading_least, self.reading * len(sentence))

    def speech_time(self, sentence: str) -> int:
        """How long a spoken sentence may hold up the game, in ms."""
        return max(self.speech_deadline_least, self.speech_deadline * len(sentence))


class Idle(Declared):
    """Ask the visitor of a stage "still there?" after so long without a tap, a key or a scroll.

    All times are in milliseconds. A text that takes longer to read, at the `reading` of `[timing]`, puts the question
    off until then.
    """

    about: Annotated[Milliseconds, Field(description="While the study is described.")] = 60_000
    consent: Annotated[Milliseconds, Field(description="While consent is asked for.")] = 90_000
    age: Annotated[Milliseconds, Field(description="While the age is asked for.")] = 45_000
    about_you: Annotated[Milliseconds, Field(description="During the questions about the visitor.")] = 60_000
    introduction: Annotated[Milliseconds, Field(description="During the introduction.")] = 45_000
    practice: Annotated[Milliseconds, Field(description="During the practice.")] = 60_000
    game: Annotated[Milliseconds, Field(description="During the game.")] = 120_000
    result: Annotated[Milliseconds, Field(description="While the result is shown.")] = 45_000
    questions: Annotated[Milliseconds, Field(description="During the questionnaires.")] = 60_000
    debrief: Annotated[Milliseconds, Field(description="While the study is explained.")] = 90_000
    thanks: Annotated[Milliseconds, Field(description="While thanks are shown.")] = 45_000
    still_there: Annotated[Milliseconds, Field(description="From that question to the end of the sitting.")] = 20_000
    pause: Annotated[
        Milliseconds, Field(description="The longest that the experimenter's pause lasts; then the sitting is over.")
    ] = 900_000

    def of(self, stage: str) -> int:
        """The time of the stage of this name, in ms."""
        after: int = getattr(self, stage)
        return after


class Practice(Declared):
    """The game before the game: nobody helps, nothing is measured, and it may be left at any time."""

    rows: Annotated[PositiveInt, Field(description="Rows of its board.")] = 3
    columns: Annotated[PositiveInt, Field(description="Columns of its board.")] = 4
    deck: Annotated[str, Field(description="Its pictures; not those of the game.")] = "fruit"
    longest: Annotated[Milliseconds, Field(description="The time after which it ends by itself.")] = 300_000


class Allocation(Declared):
    """Who gets which condition: permuted blocks, from a list that is fixed before the first visitor."""

    quotas: Annotated[
        dict[str, PositiveInt],
        Field(description="How many completed games each condition shall have, per site; empty: no allocation."),
    ] = {"tom": 28, "notom": 28}
    block: Annotated[
        PositiveInt, Field(description="How many visitors make a block, in which every condition has its share.")
    ] = 8
    seed: Annotated[
        NonNegativeInt | None,
        Field(description="From which the list is drawn; by default a secret one, drawn and stored once."),
    ] = None


class Consent(Declared):
    """What visitors are told, what they agree to, and how old they must be."""

    text: Annotated[str, Field(description="The folder of assets/consent, or a path: one file per language.")] = "study"
    adult: Annotated[
        PositiveInt, Unit("years"), Field(description="From this age on a visitor's sitting may be stored.")
    ] = 18
    contact: Annotated[
        str, Field(description="Whom to write to for withdrawing, best a mail address; shown with the code.")
    ] = ""


class Game(Declared):
    """The board."""

    rows: Annotated[PositiveInt, Field(description="Rows of the board.")] = 4
    columns: Annotated[PositiveInt, Field(description="Columns of the board.")] = 6
    deck: Annotated[str, Field(description="The folder of assets/cards that holds the pictures.")] = "animals"


class Assistance(Declared):
    """Who helps, and how."""

    condition: Annotated[
        str,
        Field(
            description="Which help visitors get where nothing is allocated: tom, notom, mentalised_unexplained, "
            "random_explained or no_assistance."
        ),
    ] = "tom"
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
    rate: Annotated[
        int, Unit("words per minute"), Field(ge=80, le=300, description="How fast it speaks; 110 is slow.")
    ] = 150
    volume: Annotated[float, Field(ge=0, le=1, description="How loud it speaks, 0 to 1.")] = 0.9
    sounds: Annotated[
        bool, Field(description="Whether cards are heard: quiet sounds, never while somebody speaks.")
    ] = True


Side = Literal["left", "right"]


class Screen(Declared):
    """The window."""

    number: Annotated[NonNegativeInt, Field(description="Which screen it covers; 0 is the primary one.")] = 0
    text_size: Annotated[PositiveFloat, Field(le=1.3, description="All texts, as a factor of their usual size.")] = 1.0
    motion: Annotated[bool, Field(description="Whether cards turn and screens fade; off for reduced motion.")] = True
    contrast: Annotated[
        Literal["normal", "high"], Field(description="Whether colours differ as usual, or as much as they can.")
    ] = "normal"
    board: Annotated[Side, Field(description="On which side of the assistant the board is, on a wide screen.")] = "left"


class Robot(Declared):
    """The robot that speaks in the avatar's place, if there is one; all times in milliseconds, all lengths in metres.

    ``board_middle`` and ``board_size`` are told as the robot sees them: sideways, up, and forward.
    """

    kind: Annotated[
        Literal["none", "furhat", "furhat-realtime"], Field(description="Which robot, or none: the avatar alone.")
    ] = "none"
    host: Annotated[str, Field(min_length=1, description="Its name or address on the network.")] = "localhost"
    port: Annotated[
        int | None, Field(ge=1, le=65535, description="Its port; by default 54321, or 9000 for furhat-realtime.")
    ] = None
    key: Annotated[
        str, Field(exclude=True, description="The key of the Realtime API, if it asks for one; never recorded.")
    ] = ""
    voice: Annotated[str, Field(description="Its voice by name; by default the first one of the language.")] = ""
    connect_deadline: Annotated[Milliseconds, Field(description="The longest that reaching it may take.")] = 1000
    answer_deadline: Annotated[Milliseconds, Field(description="The longest that any answer but speech may take.")] = (
        1500
    )
    speech_deadline: Annotated[
        Milliseconds, Field(description="The longest that it may take to say a sentence, per character.")
    ] = 110
    speech_deadline_least: Annotated[Milliseconds, Field(description="The same, whatever its length.")] = 3500
    look_every: Annotated[Milliseconds, Field(description="While it speaks, how often to see if it still answers.")] = (
        1000
    )
    probe_every: Annotated[Milliseconds, Field(description="Between sittings, how often to see if it is well.")] = (
        10_000
    )
    retry_first: Annotated[Milliseconds, Field(description="The first pause before a lost robot is tried again.")] = (
        2000
    )
    retry_longest: Annotated[Milliseconds, Field(description="The longest such pause; each is twice the last.")] = (
        120_000
    )
    gestures: Annotated[bool, Field(description="Whether it shows moods with its face.")] = True
    attend: Annotated[bool, Field(description="Whether it looks at the player, and at the hinted place.")] = True
    axes: Annotated[
        str,
        Field(
            description="Its axes for sideways (the visitor's right), up and forward, each with a minus if reversed."
        ),
    ] = "x y z"
    board_middle: Annotated[
        tuple[float, float, float],
        Unit("m"),
        Field(strict=False, description="Where the middle of the board is, seen from its eyes."),
    ] = (0.4, -0.2, 0.5)
    board_size: Annotated[
        tuple[PositiveFloat, PositiveFloat],
        Unit("m"),
        Field(strict=False, description="How wide and how high the board is on the screen."),
    ] = (0.4, 0.25)

    @field_validator("axes")
    @classmethod
    def _name_every_axis(cls, axes: str) -> str:
        if sorted(axis.removeprefix("-") for axis in axes.split(" ")) != ["x", "y", "z"]:
            raise ValueError(f"{axes!r} does not name x, y and z once each, such as 'x -z y'")
        return axes

    def speech_time(self, sentence: str) -> int:
        """How long it may take to say a sentence, in ms."""
        return max(self.speech_deadline_least, self.speech_deadline * len(sentence))


class Keys(Declared):
    """The experimenter's chords, in Qt's spelling; an empty one switches the key off."""

    panel: Annotated[str, Field(description="Opens and closes the panel.")] = "Ctrl+Shift+P"
    condition: Annotated[str, Field(description="Chooses the next visitor's condition, one after another.")] = (
        "Ctrl+Shift+C"
    )
    body: Annotated[str, Field(description="Lets the robot or the avatar help from the next sitting on.")] = (
        "Ctrl+Shift+B"
    )
    again: Annotated[str, Field(description="Says the last sentence again.")] = "Ctrl+Shift+A"
    quiet: Annotated[str, Field(description="Makes the voice and the sounds silent, or heard again.")] = "Ctrl+Shift+M"
    pause: Annotated[str, Field(description="Stops the sitting for a while, and lets it go on.")] = "Ctrl+Shift+Space"
    end: Annotated[str, Field(description="Ends the sitting, with a reason.")] = "Ctrl+Shift+E"
    next: Annotated[str, Field(description="Gets ready for the next visitor at once.")] = "Ctrl+Shift+N"
    leave: Annotated[str, Field(description="Leaves the kiosk.")] = "Ctrl+Shift+Q"

    @field_validator("*")
    @classmethod
    def _be_out_of_a_visitors_way(cls, chord: str) -> str:
        if chord and not re.fullmatch(
            r"(Shift\+)?F[1-9]\d?|(?=.*(Ctrl|Alt|Meta)\+)((Ctrl|Shift|Alt|Meta)\+)+[^+\s]+", chord
        ):
            raise ValueError(f"{chord!r} is no chord, such as 'Ctrl+Shift+P', and no function key")
        return chord

    @model_validator(mode="after")
    def _name_each_once(self) -> Self:
        chords: dict[frozenset[str], str] = {}
        for key, chord in self.model_dump().items():
            other = chords.setdefault(frozenset(chord.lower().split("+")), key) if chord else key
            if other != key:
                raise ValueError(f"{chord!r} stands for {other!r} and for {key!r}")
        return self


class Experimenter(Declared):
    """Who may change a running study."""

    pin: Annotated[
        str,
        Field(
            exclude=True,
            description="The PIN, salted and hashed, as 'recollect study pin' prints it; never recorded. Empty: none.",
        ),
    ] = ""
    backup_every: Annotated[
        PositiveInt,
        Unit("minutes"),
        Field(description="How long after the last one a backup is made, in minutes, between sittings."),
    ] = 60
    backups: Annotated[PositiveInt, Field(description="How many backups are kept.")] = 24

    @field_validator("pin")
    @classmethod
    def _hash_the_pin(cls, pin: str) -> str:
        # It is not repeated: it may be the PIN itself.
        if not re.fullmatch(r"(scrypt:[0-9a-f]{32}:[0-9a-f]{64})?", pin):
            raise ValueError("this is no hashed PIN, such as 'recollect study pin' prints")
        return pin


class Settings(Declared):
    """Everything that one study may set."""

    file_kind = "study file"

    title: Annotated[str, Field(min_length=1, description="What the study is called, in the data set.")] = (
        "A memory game with a helping robot"
    )
    languages: Annotated[
        tuple[str, ...],
        Field(min_length=1, strict=False, description="The languages to choose from; the first is shown at rest."),
    ] = ("en", "it", "es")
    stages: Annotated[
        tuple[str, ...], Field(min_length=1, strict=False, description="The stages of a sitting, in their order.")
    ] = STAGES
    about_you: Annotated[
        str, Field(description="The questionnaire about the visitor: a name in assets/questionnaires, or a path.")
    ] = "about-you"
    questionnaires: Annotated[
        tuple[str, ...],
        Field(min_length=1, strict=False, description="The questionnaires after the game: names, or paths."),
    ] = ("social-intelligence", "trust")
    game: Game = Game()
    practice: Practice = Practice()
    assistance: Assistance = Assistance()
    allocation: Allocation = Allocation()
    consent: Consent = Consent()
    timing: Timing = Timing()
    idle: Idle = Idle()
    voice: Voice = Voice()
    robot: Robot = Robot()
    screen: Screen = Screen()
    keys: Keys = Keys()
    experimenter: Experimenter = Experimenter()

    _file: Path | None = PrivateAttr(None)
    """The study file; what it names by a path lies in its folder. It is no setting, and is not recorded."""

    @classmethod
    def read(cls, path: Path) -> Self:
        """Read a study file; the paths in it start from its own folder."""
        settings = super().read(path)
        settings._file = path
        return settings

    @property
    def name(self) -> str:
        """What to call them in a refusal."""
        return f"the {self.file_kind} {self._file}" if self._file else "the study"

    @model_validator(mode="after")
    def _name_things_once(self) -> Self:
        for key, names in (
            ("languages", self.languages),
            ("stages", self.stages),
            ("questionnaires", (self.about_you, *self.questionnaires)),
        ):
            twice = [name for name, count in Counter(names).items() if count > 1]
            if twice:
                raise ValueError(f"{key}: {twice[0]!r} stands twice")
        return self

    @property
    def sha256(self) -> str:
        """The hash of every setting, given or default, so that a sitting's settings can be told apart later."""
        return hashlib.sha256(self.model_dump_json().encode()).hexdigest()

    def lying_with(self, other: Settings) -> Settings:
        """The same settings, whose paths start from the folder of another study file."""
        copied = self.model_copy()
        copied._file = other._file
        return copied

    def find(self, kind: str, name: str) -> Path:
        """What a study file calls by name: the shipped one in this folder of assets, or else a path from the file."""
        shipped = ASSETS / kind / name
        return shipped if shipped.exists() else self.beside(name)

    def beside(self, name: str) -> Path:
        """A path as the study file means it: from its own folder."""
        return self._file.parent / name if self._file else Path(name)


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
