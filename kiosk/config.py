"""The typed settings of a study file; every name carries its unit."""

from __future__ import annotations

import hashlib
import re
import tomllib
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import time
from ipaddress import IPv6Address
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
    PrivateAttr,
    ValidationError,
    field_validator,
    model_validator,
)

from kiosk import UserInputError
from kiosk.errors import (
    code_point,
    control_character,
    control_characters,
    shortened,
    toml_error_message,
    toml_line,
    validation_messages,
)
from kiosk.extensions import ExtensionGroup, registered_names
from kiosk.language_codes import is_right, standard
from kiosk.units import MS_PER_HOUR, MS_PER_MINUTE, Unit

STAGES = (
    "about",
    "age",
    "consent",
    "about_you",
    "introduction",
    "practice",
    "game",
    "result",
    "questions",
    "debrief",
    "thanks",
)
"""Every stage that a session can have between attract and its end, in the study's order."""


MOST_CHARACTERS = 500
"""A title, an address or a path that is longer fits on no screen."""

MOST_IN_TEXT = 10_000
"""A text that visitors read, such as a page of instructions, is never longer."""


class ConfigModel(BaseModel):
    """Something that is declared in a TOML file, in whole or in part.

    It is unchangeable once read; a key that does not exist is refused, and so is a value that would have to be bent.
    """

    model_config = ConfigDict(
        frozen=True, extra="forbid", strict=True, allow_inf_nan=False, str_max_length=MOST_CHARACTERS
    )

    file_kind: ClassVar[str] = "file"
    """What such a file is called in a refusal."""

    @classmethod
    def read(cls, path: Path) -> Self:
        """Read a file; raise UserInputError with a sentence for each fault, naming the file and the key."""
        name = f"the {cls.file_kind} {path}"
        text = read_text(name, path)
        given = _toml(name, text)
        unseen = [f"{name}: {sentence}" for sentence in control_characters(given, text)]
        if unseen:
            raise UserInputError(*unseen)
        try:
            return cls.model_validate(given)
        except ValidationError as error:
            raise UserInputError(
                *(f"{name}: {sentence}" for sentence in validation_messages(error, given, cls, text))
            ) from error


MOST_BYTES = 1024 * 1024
"""No file that a person writes for a study is longer; a longer one is a mistake, and slow to read."""

_MOST_DOTS = 1000
_MOST_DOTS_SQUARED = 5_000_000
"""A key with very many dots takes the reader of TOML hours, and so do many with hundreds: its time is their square."""

_LONG_NUMBER = re.compile(r"\d[\d_]{400,}")
"""Far beyond all bounds; Python refuses to read whole numbers of more than 4,300 digits."""


def read_text(name: str, path: Path) -> str:
    """Read a text file of a study; raises UserInputError, in which the file is called ``name``."""
    try:
        with path.open("rb") as file:
            content = file.read(MOST_BYTES + 1)
        if len(content) > MOST_BYTES:
            raise UserInputError(f"{name} is too long: it has more than {MOST_BYTES // 1024} KiB")
        # Some editors begin a file with a mark that is no text, and some end lines in two characters.
        text = content.decode("utf-8-sig").replace("\r\n", "\n")
    except OSError as error:
        raise UserInputError(f"{name} cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise UserInputError(f"{name} is not UTF-8; save it with that encoding") from error
    if unseen := control_character(text):
        line = text.count("\n", 0, unseen.start()) + 1
        raise UserInputError(f"{name}, line {line}, has the control character {code_point(unseen)}; take it out")
    return text


def _toml(name: str, text: str) -> dict[str, Any]:
    dots = [line.count(".") for line in text.split("\n")]
    if max(dots) > _MOST_DOTS or sum(count**2 for count in dots) > _MOST_DOTS_SQUARED:
        raise UserInputError(f"{name} has too many dots to be read: line {dots.index(max(dots)) + 1} has {max(dots)}")
    try:
        try:
            return tomllib.loads(text)
        except tomllib.TOMLDecodeError:
            raise
        except ValueError:
            # Cut short, the number is still too large wherever it stands, so the key that has it gets its sentence.
            return tomllib.loads(_LONG_NUMBER.sub(shortened, text))
    except (ValueError, RecursionError) as error:
        raise UserInputError(f"{name} is not TOML: {toml_error_message(error)}") from error


Milliseconds = Annotated[int, Field(ge=1, le=MS_PER_HOUR), Unit("ms")]
Delay = Annotated[int, Field(ge=0, le=MS_PER_MINUTE), Unit("ms")]
PerCharacter = Annotated[int, Field(ge=1, le=10_000), Unit("ms")]
"""Times; none is so long that a visitor would take the kiosk for broken."""

Lines = Annotated[int, Field(ge=1, le=12)]
"""Rows or columns of a board."""

Metres = Annotated[float, Field(ge=-10, le=10), Unit("m")]
Size = Annotated[float, Field(ge=0.01, le=10), Unit("m")]

MOST_REMINDER = 200
"""Characters of a line of the morning checklist."""
MOST_ENTRIES = 50
"""More languages or questionnaires than any visitor would bear."""


class Timing(ConfigModel):
    """When things happen in a session; all times in milliseconds."""

    mismatch_shown_ms: Annotated[Milliseconds, Field(description="How long two unmatched cards stay open.")] = 1200
    highlight_delay_ms: Annotated[
        Delay,
        Field(description="From the start of a spoken hint to its mark, never later than its end; 0 marks at once."),
    ] = 3500
    highlight_delay_silent_ms: Annotated[
        Delay, Field(description="The same for a hint that is only shown as text.")
    ] = 600
    reading_ms_per_char: Annotated[
        PerCharacter, Field(description="Time to read a sentence without voice, per character.")
    ] = 55
    reading_min_ms: Annotated[Milliseconds, Field(description="The least time to read any sentence.")] = 1500
    speech_deadline_ms_per_char: Annotated[
        PerCharacter, Field(description="The longest that a spoken sentence may hold up the game, per character.")
    ] = 130
    speech_deadline_min_ms: Annotated[Milliseconds, Field(description="The same, whatever its length.")] = 4000
    hold_min_ms: Annotated[
        Delay,
        Field(description="The least time a hint holds the board; if no sentence is longer, all holds are equal."),
    ] = 0
    taps_wait: Annotated[
        bool, Field(description="Whether cards cannot be tapped until a hint has been said, or could be read.")
    ] = True
    tap_ends_sentence: Annotated[
        bool, Field(description="If taps do not wait: whether one ends the sentence; else it is said to its end.")
    ] = True
    mood_ms: Annotated[Milliseconds, Field(description="How long the assistant looks happy, confused or sad.")] = 2500
    finish_ms: Annotated[Milliseconds, Field(description="From the last pair to the result.")] = 1800
    gaze_ms: Annotated[
        Milliseconds,
        Field(description="How long a hint that is only a look holds the board, where `gaze_only` is set."),
    ] = 2000
    thanks_ms: Annotated[Milliseconds, Field(description="How long the thanks stay unless they are tapped away.")] = (
        12_000
    )

    @model_validator(mode="after")
    def _hold_only_what_waits(self) -> Self:
        if self.hold_min_ms and not self.taps_wait:
            raise ValueError("hold_min_ms must be 0 if taps_wait is false: hints do not hold the board then")
        return self

    def reading_time(self, sentence: str) -> int:
        """How long a sentence is shown for reading, in ms."""
        return max(self.reading_min_ms, self.reading_ms_per_char * len(sentence))

    def speech_time(self, sentence: str) -> int:
        """How long a spoken sentence may hold up the game, in ms."""
        return max(self.speech_deadline_min_ms, self.speech_deadline_ms_per_char * len(sentence))


class Idle(ConfigModel):
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
    still_there: Annotated[Milliseconds, Field(description="From that question to the end of the session.")] = 20_000
    pause: Annotated[
        Milliseconds, Field(description="The longest that the experimenter's pause lasts; then the session is over.")
    ] = 900_000

    def of(self, stage: str) -> int:
        """Return the time of the stage of this name, in ms."""
        after: int = getattr(self, stage)
        return after


class Practice(ConfigModel):
    """The game before the game: without measurements, and it may be left at any time."""

    rows: Annotated[Lines, Field(description="Rows of its board.")] = 3
    columns: Annotated[Lines, Field(description="Columns of its board.")] = 4
    deck: Annotated[str, Field(description="Its pictures; not those of the game.")] = "fruit"
    hints: Annotated[
        bool,
        Field(
            description="Whether the helper gives one hint of each kind in it, as the visitor's condition has them: a "
            "column, a row, a card; or a reminder."
        ),
    ] = False
    max_duration_ms: Annotated[Milliseconds, Field(description="The time after which it ends by itself.")] = 300_000


class ConditionConfig(ConfigModel):
    """A condition: which cards hints are about, what is said with them, and which table and times hold.

    `[conditions.NAME]` declares one, under a name of small letters, digits and `_`. These names need no declaration:
    tom, notom, mentalised_unexplained, random_explained and no_assistance. The first two are the study's.
    """

    target_rule: Annotated[
        Literal["mentalised", "most_flipped", "most_recent", "random", "none"],
        Field(
            description="Which card a hint for a first card is about: by what the visitor has seen, as `target_rule` "
            "of [assistance] or one of the two says, or any closed card; none: there is no help."
        ),
    ] = "mentalised"
    explanation: Annotated[bool, Field(description="Whether a hint says what the visitor has seen of its pair.")] = True
    location: Annotated[
        bool,
        Field(description="Whether a hint says where to look; without it, it only reminds of the pair."),
    ] = True
    gaze_only: Annotated[
        bool,
        Field(
            description="Whether a hint is only a look toward its place, with head and eyes: nothing is said, and "
            "nothing is marked on the board."
        ),
    ] = False
    policy: Annotated[
        str, Field(description="Another Q-table than that of [assistance], by its name or path; empty: the same.")
    ] = ""
    timing: Annotated[dict[str, int], Field(description="Keys of [timing] that are different in this condition.")] = {}
    praise: Annotated[
        float,
        Field(
            ge=0,
            le=1,
            description="How often the helper praises a pair, where it does not help with the next card: 1 always, "
            "0 never.",
        ),
    ] = 0.0
    encourage: Annotated[
        float,
        Field(
            ge=0,
            le=1,
            description="How often the helper encourages after a move that missed, where it does not help with the "
            "next card.",
        ),
    ] = 0.0

    @property
    def comments(self) -> bool:
        """Whether the helper comments on moves."""
        return self.praise > 0 or self.encourage > 0

    @property
    def helps(self) -> bool:
        """Whether there is any help."""
        return self.target_rule != "none"

    @property
    def marks(self) -> bool:
        """Whether the place of a hint is marked on the board."""
        return self.location and not self.gaze_only

    @property
    def reminds(self) -> bool:
        """Whether its hints name no place."""
        return self.helps and not self.location

    @field_validator("timing")
    @classmethod
    def _check_the_times(cls, timing: dict[str, int]) -> dict[str, int]:
        try:
            Timing.model_validate(timing)
        except ValidationError as error:
            raise ValueError(validation_messages(error, timing, Timing)[0]) from error
        return timing

    @model_validator(mode="after")
    def _say_something(self) -> Self:
        if self.helps and not (self.explanation or self.location):
            raise ValueError("a hint without an explanation and without a location says nothing; set one of them")
        if self.gaze_only and (self.explanation or not (self.helps and self.location)):
            raise ValueError(
                "gaze_only needs a location and no explanation: a look shows a place, and explains nothing"
            )
        return self


PAPER_CONDITIONS = {
    "tom": ConditionConfig(),
    "notom": ConditionConfig(target_rule="random", explanation=False),
}
"""The paper's two."""

KNOWN_CONDITIONS = PAPER_CONDITIONS | {
    "mentalised_unexplained": ConditionConfig(explanation=False),
    "random_explained": ConditionConfig(target_rule="random"),
    "no_assistance": ConditionConfig(target_rule="none", explanation=False, location=False),
}
"""What is known without a declaration: the cells of the 2 x 2 design, and no assistance."""

_CONDITION = re.compile(r"[a-z][a-z0-9_]{0,39}")


class Allocation(ConfigModel):
    """Who gets which condition: permuted blocks, from a list that is fixed before the first visitor."""

    target_n: Annotated[
        dict[str, Annotated[int, Field(ge=1, le=10_000)]],
        Field(description="The target number of completed games of each condition, per site; empty: no allocation."),
    ] = {"tom": 28, "notom": 28}
    block_size: Annotated[
        int, Field(ge=1, le=1000, description="How many visitors make a block, in which every condition has its share.")
    ] = 8
    seed: Annotated[
        int | None,
        Field(
            ge=0,
            le=2**63 - 1,
            description="From which the list is drawn; by default a secret one, drawn and stored once.",
        ),
    ] = None


class ConsentConfig(ConfigModel):
    """What visitors are told, what they agree to, and how old they must be."""

    text: Annotated[str, Field(description="The folder of assets/consent, or a path: one file per language.")] = "study"
    adult: Annotated[
        int, Unit("years"), Field(ge=1, le=120, description="From this age on a visitor's session may be stored.")
    ] = 18
    contact: Annotated[
        str,
        Field(
            max_length=MOST_CHARACTERS,
            description="Whom to write to for withdrawing, best a mail address; shown with the code.",
        ),
    ] = ""
    on_withdrawal: Annotated[
        Literal["keep", "delete"],
        Field(
            description="What becomes of a session that the visitor stops: it is kept as withdrawn, or deleted at "
            "once. The consent must say the same."
        ),
    ] = "keep"


class Game(ConfigModel):
    """The board."""

    rows: Annotated[Lines, Field(description="Rows of the board.")] = 4
    columns: Annotated[Lines, Field(description="Columns of the board.")] = 6
    deck: Annotated[str, Field(description="The folder of assets/cards that holds the pictures.")] = "animals"


class AssistanceConfig(ConfigModel):
    """Who helps, and how."""

    name: Annotated[
        str,
        Field(max_length=24, description="The helper's name, above what it says; empty: it has none."),
    ] = "Memo"
    condition: Annotated[
        str,
        Field(description="Which help visitors get where nothing is allocated: the name of a condition."),
    ] = "tom"
    policy: Annotated[str, Field(description="The frozen Q-table: a name in policies/, or a path.")] = "default"
    target_rule: Annotated[
        Literal["most_flipped", "most_recent"], Field(description="Where a mentalised hint for a first card points.")
    ] = "most_flipped"
    wording: Annotated[
        str,
        Field(description="A folder of signed wordings that replace the shipped sentences of hints; empty: none."),
    ] = ""
    step: Annotated[
        float,
        Field(
            ge=0,
            le=1,
            description="How far one flip may move a value of the table within a session; 0 keeps it frozen.",
        ),
    ] = 0.0
    memory_model: Annotated[
        bool,
        Field(description="Whether a model of the visitor's memory is kept, and recorded with every decision."),
    ] = False
    timing: Annotated[
        Literal["table", "model"],
        Field(
            description="What decides when to help where the gate is open: the Q-table, or the model of the visitor's "
            "memory."
        ),
    ] = "table"
    threshold_first: Annotated[
        float,
        Field(
            ge=0,
            le=1,
            description="With timing 'model': a first card gets help if the chance that a pair is recalled is below "
            "this.",
        ),
    ] = 0.2
    threshold_second: Annotated[
        float,
        Field(
            ge=0,
            le=1,
            description="With timing 'model': a second card gets help if the chance that its mate is recalled is below "
            "this.",
        ),
    ] = 0.2
    threshold_card: Annotated[
        float,
        Field(
            ge=0,
            le=1,
            description="With timing 'model': the mate of an open card is pointed to itself if it was seen, and the "
            "chance that it is recalled is below this; 0 never.",
        ),
    ] = 0.05
    threshold_flips: Annotated[
        int,
        Field(
            ge=0,
            le=1000,
            description="With timing 'model': no help before so many flips, so that help goes to long games; 0 helps "
            "in all.",
        ),
    ] = 24
    explore: Annotated[
        float,
        Field(
            ge=0,
            le=1,
            description="The chance that a decision is drawn at random among all actions, where the gate is open; 0 "
            "never does.",
        ),
    ] = 0.0
    hesitation_max: Annotated[
        int,
        Field(
            ge=0,
            le=100,
            description="How often in a game a visitor who hesitates gets a hint; 0 never.",
        ),
    ] = 0
    hesitation_times: Annotated[
        float,
        Field(
            ge=1,
            le=20,
            description="A visitor hesitates after this many times their own usual time: the median of their times "
            "for the same card of a move, without help, in this game.",
        ),
    ] = 2.5
    hesitation_flips: Annotated[
        int, Field(ge=1, le=100, description="How many such times make a usual time; before, no one hesitates.")
    ] = 4
    hesitation_least_ms: Annotated[
        int, Field(ge=500, le=120_000, description="The least wait, in ms, that counts as hesitating.")
    ] = 5_000
    hesitation_still_ms: Annotated[
        int, Field(ge=0, le=60_000, description="How long, in ms, the pointer must have rested by then.")
    ] = 1_500
    hesitation_action: Annotated[
        Literal["sug_col", "sug_row", "sug_card"], Field(description="What a hint after hesitating gives away.")
    ] = "sug_col"

    @property
    def models_memory(self) -> bool:
        """Whether there is a model of the visitor's memory."""
        return self.memory_model or self.timing == "model"

    @model_validator(mode="after")
    def _check_that_the_table_decides_if_it_learns(self) -> Self:
        if self.step and self.timing == "model":
            raise ValueError("step must be 0 with timing 'model', as no table decides that could go on learning")
        if self.step and self.hesitation_max:
            raise ValueError("step must be 0 with hesitation_max, as the table would learn from hints it did not give")
        return self


VOICE_ENGINES = ("pico", "hibari", "system")


class VoiceConfig(ConfigModel):
    """The avatar's voice."""

    enabled: Annotated[bool, Field(description="Whether sentences are spoken as well as shown.")] = True
    speakers: Annotated[
        dict[str, Annotated[str, Field(min_length=1, max_length=MOST_CHARACTERS)]],
        Field(
            description="Who speaks each language: an engine ('pico', 'hibari' or 'system', the system's voices), or "
            "the folder of a voice pack; by default the best engine that is installed."
        ),
    ] = {}
    rate: Annotated[
        int, Unit("words per minute"), Field(ge=80, le=300, description="How fast it speaks; 110 is slow.")
    ] = 150
    volume: Annotated[float, Field(ge=0, le=1, description="How loud it speaks, 0 to 1.")] = 0.9
    sounds: Annotated[
        bool,
        Field(
            description="Whether cards and buttons are heard: short sounds as loud as the voice, never during speech."
        ),
    ] = True
    device: Annotated[
        str,
        Field(
            max_length=MOST_CHARACTERS,
            description="The sound device, by its name or a part of it; empty: the system's own. 'null' is heard by "
            "no one.",
        ),
    ] = ""


Side = Literal["left", "right"]


class Screen(ConfigModel):
    """The window."""

    display: Annotated[int, Field(ge=0, le=63, description="Which screen it covers; 0 is the primary one.")] = 0
    operator_display: Annotated[
        int,
        Field(ge=-1, le=63, description="Which screen has the experimenter's strip of one line; -1 is none."),
    ] = -1
    text_size: Annotated[float, Field(ge=0.5, le=1.3, description="All texts, as a factor of their usual size.")] = 1.0
    motion: Annotated[bool, Field(description="Whether cards turn and screens fade; off for reduced motion.")] = True
    contrast: Annotated[
        Literal["normal", "high"], Field(description="Whether colours differ as usual, or as much as they can.")
    ] = "normal"
    keyboard: Annotated[
        Literal["touch", "always", "never"],
        Field(
            description="When the keys on the screen come: for fields that are touched, for those that are clicked "
            "too, or never."
        ),
    ] = "touch"
    board_side: Annotated[Side, Field(description="On which side of the assistant the board is, on a wide screen.")] = (
        "left"
    )

    @model_validator(mode="after")
    def _keep_the_screens_apart(self) -> Self:
        if self.operator_display == self.display:
            raise ValueError("operator_display must not be the screen of the visitors, which display names")
        return self


_TEXT_COLOURS = ("#22313F", "#4A5A68", "#8A4B00")
"""What is written on the background, besides what has the accent's colour."""
_BOX = "#FFFBF2"
"""What is written on buttons, and the colour of boxes in which the accent's colour is written."""
_LEAST_CONTRAST = 4.5
"""WCAG 2.2, level AA."""
_SRGB_LINEAR, _SRGB_OFFSET, _SRGB_GAMMA = 0.04045, 0.055, 2.4


def contrast(one: str, other: str) -> float:
    """Return the contrast of two colours such as ``#22313F``, 1 to 21, by WCAG 2.2."""
    darker, lighter = sorted((luminance(one), luminance(other)))
    return (lighter + 0.05) / (darker + 0.05)


def luminance(colour: str) -> float:
    """Return how light a colour such as ``#22313F`` is, 0 to 1, by WCAG 2.2."""
    shares = (int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5))
    red, green, blue = (
        share / 12.92 if share <= _SRGB_LINEAR else ((share + _SRGB_OFFSET) / (1 + _SRGB_OFFSET)) ** _SRGB_GAMMA
        for share in shares
    )
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def _mixed(colour: str, end: int, share: float) -> str:
    """Return a colour that is so far on its way to black (0) or white (255)."""
    parts = (int(colour[at : at + 2], 16) for at in (1, 3, 5))
    return "#" + "".join(f"{round(part + (end - part) * share):02X}" for part in parts)


def _passing(colour: str, end: int, others: tuple[str, ...]) -> str | None:
    """Return the colour closest to this one that stands out from all the others.

    It is on the way to black or white.
    """
    tried = (_mixed(colour, end, step / 50) for step in range(51))
    return next((each for each in tried if min(contrast(each, other) for other in others) >= _LEAST_CONTRAST), None)


class Look(ConfigModel):
    """The lab's own look: its name and logo on the start screen, and two of the colours."""

    name: Annotated[
        str, Field(max_length=60, description="The lab's name, on the start screen and on the card to take home.")
    ] = ""
    logo: Annotated[
        str, Field(max_length=MOST_CHARACTERS, description="The path of the lab's logo, an SVG file; empty: none.")
    ] = ""
    fonts: Annotated[
        tuple[str, ...],
        Field(
            strict=False,
            max_length=MOST_ENTRIES,
            description="The paths of fonts (.ttf, .otf or .ttc) for letters that the shipped one lacks.",
        ),
    ] = ()
    accent: Annotated[
        str, Field(description="The colour of buttons and titles; at 4.5:1 against light boxes and the background.")
    ] = "#1F5F6B"
    background: Annotated[
        str, Field(description="The colour behind everything, on which dark text is read at 4.5:1.")
    ] = "#FBF6EC"

    @field_validator("accent", "background")
    @classmethod
    def _be_a_colour(cls, colour: str) -> str:
        if not re.fullmatch(r"#[0-9A-Fa-f]{6}", colour):
            raise ValueError(f"{colour!r} is no colour such as '#1F5F6B'")
        return colour

    @model_validator(mode="after")
    def _be_readable(self) -> Self:
        self._check("background", self.background, 255, _TEXT_COLOURS, "the texts on it")
        self._check("accent", self.accent, 0, (_BOX, self.background), "what it is written on")
        return self

    def _check(self, key: str, colour: str, end: int, others: tuple[str, ...], what: str) -> None:
        least = min(contrast(colour, other) for other in others)
        if least < _LEAST_CONTRAST:
            passing = _passing(colour, end, others)
            # Rounded down: 4.49 is not to be read as 4.5.
            raise ValueError(
                f"{key}: the contrast of {colour!r} to {what} is {int(least * 10) / 10}:1, and must be 4.5:1; "
                f"{passing!r} would pass"
            )


NO_ROBOT = "none"
"""The kind of robot of a study in which the avatar helps alone."""


_HOST = re.compile(r"[\w-]{1,63}(\.[\w-]{1,63})*\.?")
_URL = re.compile(r"[a-z][a-z0-9+.-]*://(.*)", re.IGNORECASE | re.DOTALL)


def host_fault(host: str) -> str | None:
    """Say why this is no host, and what to write instead; return None if it is one."""
    if not host.strip():
        return "it is empty; write the robot's name or address, such as '192.168.0.20'"
    url = _URL.fullmatch(host)
    rest = (url[1] if url else host).partition("/")[0]
    _, at, rest = rest.rpartition("@")
    name, colon, port = rest.rpartition(":")
    has_port = bool(colon and port.isdecimal() and (_HOST.fullmatch(name) or name.endswith("]")))
    if not has_port:
        name = rest
    name = name.removeprefix("[").removesuffix("]")
    if name == host and (_HOST.fullmatch(host) or _is_ipv6(host)):
        return None
    what = "a web address" if url else "a user and a host" if at else "a host and a port" if has_port else "no host"
    if not (_HOST.fullmatch(name) or _is_ipv6(name)):
        return f"{host[:_SHOWN]!r} is {what}; write the robot's name or address, such as '192.168.0.20'"
    return f"{host[:_SHOWN]!r} is {what}; write {name!r}" + (f", and {port} as the port" if has_port else " alone")


def _is_ipv6(text: str) -> bool:
    address, _, _ = text.partition("%")
    try:
        IPv6Address(address)
    except ValueError:
        return False
    return True


class RobotConfig(ConfigModel):
    """The robot that speaks in the avatar's place, if there is one; all times in milliseconds, all lengths in metres.

    ``board_middle`` and ``board_size`` are told as the robot sees them: sideways, up, and forward.
    """

    kind: Annotated[str, Field(description="Which robot, by the name of its driver, or none: the avatar alone.")] = (
        NO_ROBOT
    )
    host: Annotated[str, Field(min_length=1, description="Its name or address on the network.")] = "localhost"
    port: Annotated[
        int | None, Field(ge=1, le=65535, description="Its port; by default the one that its driver names.")
    ] = None
    key: Annotated[
        str, Field(exclude=True, description="The key or password that it asks for, if any; never recorded.")
    ] = ""
    options: Annotated[
        dict[str, Any], Field(description="What only this driver knows, by its own names; see the driver's page.")
    ] = {}
    voice: Annotated[str, Field(description="Its voice by name; by default the first one of the language.")] = ""
    pack: Annotated[
        bool,
        Field(
            description="Whether it plays the clips of the avatar's voice pack, so that both sound the same; each is "
            "served over HTTP to the robot's address alone, while the robot says it."
        ),
    ] = False
    pack_port: Annotated[
        int | None,
        Field(ge=1, le=65535, description="The port of this machine that it fetches them from; by default a free one."),
    ] = None
    connect_deadline_ms: Annotated[Milliseconds, Field(description="The longest that reaching it may take.")] = 1000
    answer_deadline_ms: Annotated[
        Milliseconds, Field(description="The longest that any answer but speech may take.")
    ] = 1500
    speech_deadline_ms_per_char: Annotated[
        PerCharacter, Field(description="The longest that it may take to say a sentence, per character.")
    ] = 110
    speech_deadline_min_ms: Annotated[Milliseconds, Field(description="The same, whatever its length.")] = 3500
    heartbeat_ms: Annotated[
        Milliseconds, Field(description="While it speaks, how often to see if it still answers.")
    ] = 1000
    health_check_ms: Annotated[Milliseconds, Field(description="Between sessions, how often to see if it is well.")] = (
        10_000
    )
    backoff_initial_ms: Annotated[
        Milliseconds, Field(description="The first pause before a lost robot is tried again.")
    ] = 2000
    backoff_max_ms: Annotated[Milliseconds, Field(description="The longest such pause; each is twice the last.")] = (
        120_000
    )
    gestures: Annotated[bool, Field(description="Whether it shows moods with its face.")] = True
    gaze: Annotated[bool, Field(description="Whether it looks at the player, and at the hinted place.")] = True
    axes: Annotated[
        str,
        Field(
            description="Its axes for sideways (the visitor's right), up and forward, each with a minus if reversed."
        ),
    ] = "x y z"
    board_middle: Annotated[
        tuple[Metres, Metres, Metres],
        Unit("m"),
        Field(strict=False, description="Where the middle of the board is, seen from its eyes."),
    ] = (0.4, -0.2, 0.5)
    board_size: Annotated[
        tuple[Size, Size],
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
        return max(self.speech_deadline_min_ms, self.speech_deadline_ms_per_char * len(sentence))


class Keys(ConfigModel):
    """The experimenter's shortcuts, in Qt's spelling; an empty one switches the key off."""

    panel: Annotated[str, Field(description="Opens and closes the panel.")] = "Ctrl+Shift+P"
    condition: Annotated[str, Field(description="Chooses the next visitor's condition, one after another.")] = (
        "Ctrl+Shift+C"
    )
    embodiment: Annotated[str, Field(description="Lets the robot or the avatar help from the next session on.")] = (
        "Ctrl+Shift+B"
    )
    repeat: Annotated[str, Field(description="Says the last sentence again.")] = "Ctrl+Shift+A"
    mute: Annotated[str, Field(description="Makes the voice and the sounds silent, or heard again.")] = "Ctrl+Shift+M"
    pause: Annotated[str, Field(description="Stops the session for a while, and lets it go on.")] = "Ctrl+Shift+Space"
    abort: Annotated[str, Field(description="Ends the session, with a reason.")] = "Ctrl+Shift+E"
    volume: Annotated[str, Field(description="Makes voice and sounds louder, step by step, and soft again.")] = (
        "Ctrl+Shift+V"
    )
    next: Annotated[str, Field(description="Gets ready for the next visitor at once.")] = "Ctrl+Shift+N"
    quit: Annotated[str, Field(description="Leaves the kiosk.")] = "Ctrl+Shift+Q"

    @field_validator("*")
    @classmethod
    def _be_out_of_a_visitors_way(cls, shortcut: str) -> str:
        if shortcut and not re.fullmatch(
            r"(Shift\+)?F[1-9]\d?|(?=.*(Ctrl|Alt|Meta)\+)((Ctrl|Shift|Alt|Meta)\+)+[^+\s]+", shortcut
        ):
            raise ValueError(f"{shortcut!r} is no shortcut, such as 'Ctrl+Shift+P', and no function key")
        return shortcut

    @model_validator(mode="after")
    def _name_each_once(self) -> Self:
        shortcuts: dict[frozenset[str], str] = {}
        for key, shortcut in self.model_dump().items():
            other = shortcuts.setdefault(frozenset(shortcut.lower().split("+")), key) if shortcut else key
            if other != key:
                raise ValueError(f"{shortcut!r} stands for {other!r} and for {key!r}")
        return self


def read_hours(text: str) -> tuple[time, time]:
    """Read hours such as ``10:00-18:00``: from when, and until when.

    Raises ValueError for any other form, and where the end does not come after the beginning.
    """
    form = re.fullmatch(r"(\d\d:\d\d) ?- ?(\d\d:\d\d)", text, re.ASCII)
    try:
        opens, closes = map(time.fromisoformat, form.groups() if form is not None else ())
    except ValueError:
        opens = closes = time.min
    if opens >= closes:
        raise ValueError(f"{text!r} is not of the form '10:00-18:00', with the opening first")
    return opens, closes


class ExperimenterConfig(ConfigModel):
    """Who may change a running study."""

    pin_hash: Annotated[
        str,
        Field(
            exclude=True,
            description="The PIN, salted and hashed, as 'study set-pin' prints it; never recorded. Empty: none.",
        ),
    ] = ""
    hold_corner: Annotated[
        bool, Field(description="Whether holding an upper corner of the screen for 3 s asks for the PIN.")
    ] = True
    backup_every: Annotated[
        int,
        Unit("minutes"),
        Field(
            ge=1, le=10_080, description="How long after the last one a backup is made, in minutes, between sessions."
        ),
    ] = 60
    backups: Annotated[int, Field(ge=1, le=1000, description="How many backups are kept.")] = 24
    opening_hours: Annotated[
        str,
        Field(description="When visitors can come, such as '10:00-18:00'; for the alarm that none does. Empty: none."),
    ] = ""
    alone_alarm: Annotated[
        int,
        Unit("minutes"),
        Field(ge=1, le=1440, description="After how many of those minutes without a visitor it comes."),
    ] = 30
    alarm_sound: Annotated[
        Literal["between", "always", "never"],
        Field(description="When alarms sound: between sessions only, always, or never; they are shown in any case."),
    ] = "between"
    reminders: Annotated[
        tuple[Annotated[str, Field(min_length=1, max_length=MOST_REMINDER)], ...],
        Field(
            max_length=MOST_ENTRIES,
            strict=False,
            description="What 'recollect open-day' reminds you of, such as 'Put out fresh information sheets'.",
        ),
    ] = ()

    @field_validator("opening_hours")
    @classmethod
    def _open_before_closing(cls, hours: str) -> str:
        if hours:
            read_hours(hours)
        return hours

    @field_validator("pin_hash")
    @classmethod
    def _hash_the_pin(cls, pin: str) -> str:
        # It is not repeated: it may be the PIN itself.
        if not re.fullmatch(r"(scrypt:1[0-8]:[0-9a-f]{32}:[0-9a-f]{64})?", pin):
            raise ValueError("this is no hashed PIN, such as 'recollect study set-pin' prints")
        return pin


_PORTS = {"mqtt": 1883, "mqtts": 8883}


def read_broker(text: str) -> tuple[str, int, bool]:
    """Read an address such as ``mqtts://broker.lab.example:8883``: the host, the port, and whether TLS is used.

    Raises ValueError for anything else.
    """
    found = re.fullmatch(r"(mqtts?)://([\w.-]+|\[[0-9a-fA-F:.]+\])(?::([0-9]{1,5}))?/?", text, re.ASCII)
    port = int(found[3] or _PORTS[found[1]]) if found else 0
    if found is None or not 0 < port <= 65_535:  # noqa: PLR2004 - the highest port
        raise ValueError(f"{text!r} is no broker's address, such as 'mqtts://broker.lab.example:8883'")
    return found[2].strip("[]"), port, found[1] == "mqtts"


class Remote(ConfigModel):
    """Where the booth's status is published, so that you can watch it from afar.

    It is off as long as ``mqtt`` is empty. Of this section nothing is recorded.
    """

    mqtt: Annotated[
        str,
        Field(description="The MQTT broker: mqtts://HOST or, without TLS, mqtt://HOST. Empty: nothing is published."),
    ] = ""
    booth: Annotated[
        str,
        Field(
            pattern=r"^[A-Za-z0-9._-]{0,64}$",
            description="What this booth is called there; by default its site, or the machine's name.",
        ),
    ] = ""
    topic: Annotated[
        str,
        Field(pattern=r"^[A-Za-z0-9._/-]{1,100}$", description="What its topic begins with; the booth's name follows."),
    ] = "recollect"
    user: Annotated[str, Field(max_length=MOST_CHARACTERS, description="The user's name at the broker, if any.")] = ""
    password_file: Annotated[str, Field(description="A file with the password alone; a path.")] = ""
    ca: Annotated[
        str, Field(description="The certificate of the broker's authority; a path. Empty: those of the system.")
    ] = ""
    certificate: Annotated[str, Field(description="A certificate by which the broker knows the booth; a path.")] = ""
    key: Annotated[str, Field(description="The key of that certificate; a path.")] = ""

    @field_validator("mqtt")
    @classmethod
    def _name_a_broker(cls, text: str) -> str:
        if text:
            read_broker(text)
        return text


@dataclass(frozen=True)
class PackageOrigin:
    """The packed study that settings came from; ``shipped`` are the hashes of what came with Recollect there."""

    path: Path
    sha256: str
    shipped: Mapping[str, str]


class Privacy(ConfigModel):
    """What an export tells of who people are. Exact ages are exported only by those who ask for them."""

    age_items: Annotated[
        tuple[str, ...],
        Field(
            max_length=MOST_ENTRIES,
            strict=False,
            description="The items of questionnaires that ask for an age in years, by their names.",
        ),
    ] = ("age",)
    age_bands: Annotated[
        int, Unit("years"), Field(ge=2, le=50, description="How many years a band of ages has in an export.")
    ] = 5
    pointer_trace: Annotated[
        bool,
        Field(
            description="Records the way of the pointer over the board, 30 places a second, of visitors who agreed to "
            "the purpose 'pointer' of the consent, and of no others."
        ),
    ] = False
    shuffled_ids: Annotated[
        bool,
        Field(
            description="Gives participants names in an export that say nothing of the order in which they came, and "
            "leaves out what else tells that order."
        ),
    ] = False


class ReturningConfig(ConfigModel):
    """Whether a visitor can come back another day as the same participant."""

    enabled: Annotated[
        bool,
        Field(
            description="Lets visitors who agreed to the purpose 'return' of the consent come back with their code, "
            "as the same participant."
        ),
    ] = False
    condition: Annotated[
        Literal["same", "next", "new"],
        Field(
            description="Which help a participant gets who comes back: that of the first visit, the next condition "
            "in the design's order, or a new place of the allocation list, as a new participant would."
        ),
    ] = "same"


class MarkersConfig(ConfigModel):
    """Whether the moments of a session go to recorders of gaze or EEG."""

    lsl: Annotated[
        bool,
        Field(description="Sends a marker of every recorded event to the Lab Streaming Layer; needs the extra 'lsl'."),
    ] = False
    stream: Annotated[
        str, Field(min_length=1, max_length=MOST_CHARACTERS, description="What the stream of markers is called.")
    ] = "Recollect"


def _one_line(text: str) -> str:
    if len(text.splitlines()) > 1:
        raise ValueError(f"{text[:_SHOWN]!r} has more than one line")
    return text


_SHOWN = 40

OwnText = Annotated[str, Field(max_length=MOST_IN_TEXT)]


class Settings(ConfigModel):
    """Everything that one study may set."""

    file_kind = "study file"

    title: Annotated[
        str,
        Field(min_length=1, max_length=MOST_CHARACTERS, description="What the study is called, in the data set."),
        AfterValidator(_one_line),
    ] = "A memory game with a helping robot"
    languages: Annotated[
        tuple[str, ...],
        Field(
            min_length=1,
            max_length=MOST_ENTRIES,
            strict=False,
            description="The languages to choose from; the first is shown at rest.",
        ),
    ] = ("en", "it", "es")
    texts: Annotated[
        dict[str, OwnText | dict[str, OwnText | dict[str, OwnText]]],
        Field(
            max_length=MOST_ENTRIES,
            description="Own words for single messages of a language: [texts.en] with a key for each message, or "
            'en = "texts/en.ftl", a file with them.',
        ),
    ] = {}
    stages: Annotated[
        tuple[str, ...], Field(min_length=1, strict=False, description="The stages of a session, in their order.")
    ] = STAGES
    about_you: Annotated[
        str, Field(description="The questionnaire about the visitor: a name in assets/questionnaires, or a path.")
    ] = "about-you"
    questionnaires: Annotated[
        tuple[str, ...],
        Field(
            min_length=1,
            max_length=MOST_ENTRIES,
            strict=False,
            description="The questionnaires after the game: names, or paths.",
        ),
    ] = ("social-intelligence", "trust")
    game: Game = Game()
    practice: Practice = Practice()
    assistance: AssistanceConfig = AssistanceConfig()
    conditions: Annotated[
        dict[str, ConditionConfig], Field(max_length=MOST_ENTRIES, description="The conditions, by their names.")
    ] = PAPER_CONDITIONS
    randomisation: Allocation = Allocation()
    consent: ConsentConfig = ConsentConfig()
    timing: Timing = Timing()
    idle_ms: Idle = Idle()
    voice: VoiceConfig = VoiceConfig()
    robot: RobotConfig = RobotConfig()
    screen: Screen = Screen()
    look: Look = Look()
    shortcuts: Keys = Keys()
    experimenter: ExperimenterConfig = ExperimenterConfig()
    privacy: Privacy = Privacy()
    returning: ReturningConfig = ReturningConfig()
    markers: MarkersConfig = MarkersConfig()
    remote: Annotated[Remote, Field(exclude=True)] = Remote()

    _file: Path | None = PrivateAttr(None)
    """The study file; what it names by a path lies in its folder. It is no setting, and is not recorded."""
    _package: PackageOrigin | None = PrivateAttr(None)

    @classmethod
    def read(cls, path: Path) -> Self:
        """Read a study file; the paths in it start from its own folder."""
        return super().read(path)._at(path)

    @classmethod
    def from_package(cls, given: Mapping[str, Any], file: Path, package: PackageOrigin) -> Self:
        """Return the settings of a packed study whose files were put beside ``file``; raises ValidationError."""
        return cls.model_validate(given)._at(file, package)

    def _at(self, file: Path, package: PackageOrigin | None = None) -> Self:
        """Note where they were read; raises UserInputError for a robot that is not installed."""
        self._file, self._package = file, package
        # Not in the model: a stored session stays readable where its robot is not installed.
        kinds = (NO_ROBOT, *registered_names(ExtensionGroup.ROBOTS))
        if self.robot.kind not in kinds:
            offered = f"{', '.join(map(repr, kinds[:-1]))} or {kinds[-1]!r}"
            raise UserInputError(f"{self.name}: robot.kind must be {offered}, but it is {self.robot.kind!r}")
        fault = host_fault(self.robot.host)
        if fault:
            line = self.line_of("robot", "host")
            raise UserInputError(f"{self.name}: robot.host: {fault}" + (f" (line {line})" if line else ""))
        return self

    @property
    def package(self) -> PackageOrigin | None:
        """The packed study that they came from; None if they did not."""
        return self._package

    @property
    def name(self) -> str:
        """What to call them in a refusal."""
        if self._package:
            return f"the packed study {self._package.path}"
        return f"the {self.file_kind} {self._file}" if self._file else "the study"

    def line_of(self, *key: str | int) -> int | None:
        """Return the line of a key in the study file, counted from 1; None for what is not there."""
        if self._file is None:
            return None
        try:
            return toml_line(read_text(self.name, self._file), key)
        except UserInputError:
            # The file has changed since it was read.
            return None

    def own_texts(self, code: str) -> Mapping[str, str | Mapping[str, str]]:
        """Return the messages of a language that the study file itself replaces."""
        own = self._texts_of(code)
        return {} if isinstance(own, str) else own

    def own_texts_file(self, code: str) -> Path | None:
        """Return the file that replaces messages of a language, if the study file names one."""
        own = self._texts_of(code)
        return self.beside(own) if isinstance(own, str) else None

    def texts_place(self, code: str, message: str) -> tuple[Path, int | None]:
        """Return the file and the line in which the study file replaces a message."""
        key = next((key for key in self.texts if code_of(key) == code), code)
        return self._file or Path("study.toml"), self.line_of("texts", key, message)

    def _texts_of(self, code: str) -> str | Mapping[str, str | Mapping[str, str]]:
        return next((own for key, own in self.texts.items() if code_of(key) == code), {})

    @field_validator("conditions")
    @classmethod
    def _name_conditions(cls, declared: dict[str, ConditionConfig]) -> dict[str, ConditionConfig]:
        for name, condition in declared.items():
            if not _CONDITION.fullmatch(name):
                raise ValueError(
                    f"{name!r} is no name of a condition: it has small letters, digits and _ only, at most 40, and "
                    "begins with a letter"
                )
            known = KNOWN_CONDITIONS.get(name)
            if known is not None and known != condition.model_copy(update={"policy": "", "timing": {}}):
                raise ValueError(f"{name!r} has a meaning of its own; give a condition that is different another name")
        return declared

    @property
    def all_conditions(self) -> dict[str, ConditionConfig]:
        """Every condition by its name: what is declared, and what is known without that."""
        return KNOWN_CONDITIONS | self.conditions

    def condition(self, name: str) -> ConditionConfig:
        """Return the condition of a name; raises UserInputError with all the names there are."""
        there = self.all_conditions
        if name not in there:
            raise UserInputError(f"there is no condition {name!r}; there are {', '.join(there)}")
        return there[name]

    @model_validator(mode="after")
    def _reword_what_is_spoken(self) -> Self:
        spoken = {code_of(name) for name in self.languages}
        strange = [language for language in self.texts if code_of(language) not in spoken]
        if strange:
            raise ValueError(f"texts: {strange[0]!r} is none of the languages")
        return self

    @model_validator(mode="after")
    def _name_things_once(self) -> Self:
        spoken = {code_of(language) for language in self.voice.speakers} - {code_of(name) for name in self.languages}
        if spoken:
            raise ValueError(f"voice.speakers: {min(spoken)!r} is none of the languages")
        unknown = [name for name in self.voice.speakers.values() if name not in VOICE_ENGINES and not is_path(name)]
        if unknown:
            known = ", ".join(VOICE_ENGINES)
            raise ValueError(
                f"voice.speakers: {unknown[0]!r} is no engine ({known}), and no path such as './voices/en'"
            )
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
        """The hash of every setting, given or default, so that a session's settings can be told apart later."""
        return hashlib.sha256(self.model_dump_json().encode()).hexdigest()

    @property
    def own_fonts(self) -> tuple[Path, ...]:
        """The files of the study's own fonts."""
        return tuple(map(self.beside, self.look.fonts))

    @property
    def voice_from_here(self) -> VoiceConfig:
        """The voice's settings, whose packs are named by whole paths and whose languages as the session has them."""
        speakers = {
            code_of(language): str(self.beside(name).absolute()) if is_path(name) else name
            for language, name in self.voice.speakers.items()
        }
        return self.voice.model_copy(update={"speakers": speakers})

    def with_base_dir(self, other: Settings) -> Settings:
        """Return the same settings, whose paths start from the folder of another study file."""
        copied = self.model_copy()
        copied._file = other._file
        return copied

    @property
    def language_codes(self) -> tuple[str, ...]:
        """List the codes of the languages.

        A language that is named by a path has its folder's name as its code.
        """
        return tuple(code_of(name) for name in self.languages)

    def resolve_asset(self, kind: str, name: str) -> Path:
        """Return the path of what the study file calls by this name, whether it is there or not."""
        found = self.locate(kind, name)
        return self.beside(name) if found is None else found.path

    def is_shipped(self, kind: str, name: str) -> bool:
        """Return whether the study file means something shipped by this name."""
        found = self.locate(kind, name)
        return found is not None and found.is_shipped

    def locate(self, kind: str, name: str) -> Located | None:
        """Find what the study file calls by this name; None if there is nothing.

        A name with a slash or an ending is a path from the study file's own folder, and nothing else. Any other name
        is that of something shipped or, if nothing shipped has it, of something in the study file's folder.
        """
        if not name:
            return None
        ending = _ENDINGS.get(kind, "")
        names = (f"{name}{ending}", name) if ending else (name,)
        own = next((path for path in map(self.beside, names) if _is_there(path, ending)), None)
        shipped = None if is_path(name) else _shipped(kind, name)
        if shipped is not None:
            return Located(shipped, is_shipped=True, unused=own)
        return None if own is None else Located(own)

    def beside(self, name: str) -> Path:
        """Return a path as the study file means it: from its own folder; a backslash is a slash, too."""
        path = Path(name.replace("\\", "/"))
        return self._file.parent / path if self._file else path


_ENDINGS = {"questionnaires": ".toml", "policies": ".json"}
"""What goes by a name is a file with this ending; anything else is a folder."""


@dataclass(frozen=True)
class Located:
    """Where something lies that goes by a name; ``unused`` is what has the same name beside the study file."""

    path: Path
    is_shipped: bool = False
    unused: Path | None = None


PICTURES = (".svg", ".png", ".jpg", ".jpeg", ".webp")
"""The endings of the pictures that a card can have."""


def pictures_in(folder: Path) -> dict[str, Path]:
    """Map the cards of a deck to their pictures, in alphabetical order; a card is called as its file is.

    Of two files with the same name the first is taken; `recollect study check` reports the other.
    """
    found: dict[str, Path] = {}
    for file in files_in(folder):
        if file.suffix.lower() in PICTURES:
            found.setdefault(file.stem, file)
    return found


def files_in(folder: Path) -> list[Path]:
    """List the files of a folder that are not hidden, by name; none if it cannot be read."""
    try:
        files = [file for file in folder.iterdir() if not file.name.startswith(".") and file.is_file()]
    except OSError:
        return []
    return sorted(files, key=lambda file: (file.stem, file.name))


def is_path(name: str) -> bool:
    """Return whether a name is a path: it has a slash, begins with a dot, or has an ending."""
    return "/" in name or "\\" in name or name.startswith(".") or bool(Path(name).suffix)


def code_of(name: str) -> str:
    """Return the language code in the name of a language, which may be a path.

    Without a code it is the name itself.
    """
    last = Path(name.replace("\\", "/")).name
    return standard(last) if is_right(last) else last


def shipped_names(kind: str) -> dict[str, Path]:
    """Map the names of everything shipped of this kind to its path."""
    ending = _ENDINGS.get(kind, "")
    folder = POLICIES if kind == "policies" else ASSETS / kind
    there = (path for path in sorted(folder.glob(f"*{ending}")) if _is_there(path, ending))
    return {path.name.removesuffix(ending): path for path in there}


def _shipped(kind: str, name: str) -> Path | None:
    there = shipped_names(kind)
    if kind == "sentences":
        return next((path for each, path in there.items() if code_of(each) == code_of(name)), None)
    return there.get(name)


def _is_there(path: Path, ending: str) -> bool:
    """Return whether there is such a file or, without an ending, such a folder."""
    try:
        return path.is_file() if ending else path.is_dir()
    except (OSError, ValueError):
        # No file can have such a name.
        return False


def beside_or_inside(name: str) -> Path:
    """Return a folder that stands inside the installed package, or beside it in a checkout."""
    package = Path(__file__).parent
    return package / name if (package / name).is_dir() else package.parent / name


ASSETS = beside_or_inside("assets")
POLICIES = beside_or_inside("policies")


def policy_path(name: str) -> Path:
    """Return the file of a shipped policy by its name, or the path itself."""
    shipped = None if is_path(name) else _shipped("policies", name)
    return Path(name) if shipped is None else shipped
