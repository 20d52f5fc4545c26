"""A participant: one session with what is worked out from all of it, and the measures of its game."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import cached_property

from kiosk.experiment.condition import AllocationSlot
from kiosk.experiment.item_responses import ItemResponse
from kiosk.experiment.outcomes import EmbodimentName
from kiosk.experiment.projections import Measures, ScaleScore, item_responses, measure_game
from kiosk.experiment.session_state import SessionState
from kiosk.export.columns import Cell, Column, ColumnKind, Variable
from kiosk.export.responses import session_about_you, session_scores
from kiosk.store.allocation import slots_by_block, slots_from_json
from kiosk.store.session_records import SessionRecord


@dataclass(frozen=True)
class Person:
    """One session with what is worked out from all of it, once for all columns."""

    kept: SessionRecord

    @property
    def embodiment(self) -> EmbodimentName:
        """What helped when the session began."""
        return self.kept.embodiment

    @cached_property
    def slot(self) -> AllocationSlot | None:
        """Its slot of the allocation list, if it took one."""
        number = self.kept.row["allocation_slot"]
        return None if number is None else slots_from_json(self.kept.row["slots"])[number - 1]

    @property
    def allocation_probability(self) -> float | None:
        """The share of its condition in the block of its slot."""
        if self.slot is None:
            return None
        block = slots_by_block(self.kept.row["slots"])[self.slot.block]
        return block.count(self.slot.condition) / len(block)

    @property
    def state(self) -> SessionState:
        """What the session came to."""
        return self.kept.state

    @cached_property
    def measures(self) -> Measures:
        """What was measured in the game."""
        return measure_game(self.state)

    @cached_property
    def about_you(self) -> dict[str, ItemResponse]:
        """What was answered about the visitor, by item."""
        asked_first = session_about_you(self.kept)
        return {answer.item: answer for answer in item_responses(self.state, asked_first)}

    @cached_property
    def scores(self) -> dict[tuple[str, str], ScaleScore]:
        """The scales, by questionnaire and name."""
        return {(score.questionnaire, score.scale): score for score in session_scores(self.kept)}


def _measured(
    name: str, description: str, kind: ColumnKind = ColumnKind.WHOLE, unit: str = "", empty: str = ""
) -> Variable:
    return Variable(name, description, kind, unit, empty=empty)


_PER_HINT = "no hint was given"
_PER_FIRST = "no hint was given for a first card"

MEASURED = {
    variable.name: variable
    for variable in (
        _measured("flips", "How many cards were turned up in the game; not to be compared with moves."),
        _measured("moves", "How many moves of two flips were completed in the game."),
        _measured("pairs", "How many pairs were found in the game."),
        _measured("hints", "How many hints were given in the game."),
        _measured(
            "completion_ms",
            "The player's own time from the first flip of the game to its last match: less pauses, and less the time "
            "from each hint until the board opened again; 0 without a match. Compare conditions by this one.",
            unit="ms",
        ),
        _measured(
            "completion_with_speech_ms",
            "The same, with the time from each hint until the board opened again. It grows with the length of the "
            "sentences, so it does not compare conditions that say different ones.",
            unit="ms",
        ),
        _measured(
            "assistance_per_flip",
            "The sum of the hints' levels (none 0, column 0.5, row 1, card 2) by the number of flips.",
            ColumnKind.NUMBER,
            empty="no card was turned up",
        ),
        _measured(
            "followed_rate",
            "The share of hints that were followed by a flip of the hinted card, or in the hinted row or column.",
            ColumnKind.NUMBER,
            empty=_PER_HINT,
        ),
        _measured("first_followed_rate", "The same for hints for a first card.", ColumnKind.NUMBER, empty=_PER_FIRST),
        _measured(
            "first_led_to_match_rate",
            "The share of hints for a first card that were followed and whose move ended in a match.",
            ColumnKind.NUMBER,
            empty=_PER_FIRST,
        ),
    )
}
"""What each measure of kiosk.experiment.projections is called here, and what it says."""

_RENAMED = {
    "followed": "followed_rate",
    "first_followed": "first_followed_rate",
    "first_led_to_match": "first_led_to_match_rate",
}
"""A share of hints is not called like the truth about one of them."""


def _value_of(name: str) -> Callable[[Person], Cell]:
    def value(row: Person) -> Cell:
        measured: int | float | None = getattr(row.measures, name)
        return measured

    return value


MEASURES: tuple[Column[Person], ...] = (
    *(Column(MEASURED[_RENAMED.get(field.name, field.name)], _value_of(field.name)) for field in fields(Measures)),
    Column(
        Variable(
            "per_match_ms", "completion_ms by the number of pairs.", ColumnKind.NUMBER, "ms", empty="no pair was found"
        ),
        lambda row: row.measures.per_match_ms,
    ),
    Column(
        Variable(
            "per_match_with_speech_ms",
            "completion_with_speech_ms by the number of pairs.",
            ColumnKind.NUMBER,
            "ms",
            empty="no pair was found",
        ),
        lambda row: row.measures.per_match_with_speech_ms,
    ),
)
