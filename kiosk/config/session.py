"""The settings of a session: its stages, game, assistance, conditions and what is kept of a visitor."""

from __future__ import annotations

import re
from typing import Annotated, Literal, Self

from pydantic import (
    Field,
    ValidationError,
    field_validator,
    model_validator,
)

from kiosk.config.models import MOST_CHARACTERS, MOST_ENTRIES, ConfigModel, Delay, Lines, Milliseconds, PerCharacter
from kiosk.errors import (
    validation_messages,
)
from kiosk.units import Unit

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
    mood_ms: Annotated[
        Milliseconds,
        Field(description="How long the assistant looks happy, confused or sad, unless a new card ends it."),
    ] = 2500
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

CONDITION_NAME = re.compile(r"[a-z][a-z0-9_]{0,39}")


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
