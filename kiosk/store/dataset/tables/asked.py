"""The tables of what was asked: every answer, and the scores of the scales that answers are summed to."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from statistics import fmean

from kiosk.store.dataset.column import Cell, Column, Kind, Table, Variable
from kiosk.store.dataset.extras import Extra
from kiosk.store.dataset.kept import Kept
from kiosk.store.dataset.tables.shared import PARTICIPANT, columns
from kiosk.study.declared.questionnaire import Answer, Item, Page, Questionnaire, Rating, ShortText
from kiosk.study.events import AnswerGiven, ItemsShown

QUESTIONNAIRE = Variable("questionnaire", "The questionnaire, by its name.")
VERSION = Variable("version", "The version of the questionnaire.", empty="it cannot be read any more")
SCALE = Variable("scale", "The scale that the item belongs to.", empty="the item is not summed with others")


@dataclass
class Answered:
    """An item that was shown: what was answered in the end, and when, in ms from when it came; None if nothing was."""

    questionnaire: str
    item: str
    place: int
    shown_ms: int
    value: Answer | None = None
    first_ms: int | None = None
    last_ms: int | None = None
    changes: int = 0

    def take(self, answer: AnswerGiven) -> None:
        """The visitor gave an answer, changed it, or took it back."""
        if self.first_ms is None:
            self.first_ms = answer.at_ms - self.shown_ms
        elif answer.value != self.value:
            self.changes += 1
        self.last_ms = answer.at_ms - self.shown_ms
        self.value = answer.value


def answered(kept: Kept) -> dict[tuple[str, str], Answered]:
    """Every item that was shown, by questionnaire and item, in the order in which they came first."""
    shown: dict[tuple[str, str], Answered] = {}
    asking = ""
    for event in kept.events:
        match event:
            case ItemsShown(questionnaire=asking, items=items, at_ms=at_ms):
                for item in items:
                    known = shown.setdefault((asking, item), Answered(asking, item, len(shown) + 1, at_ms))
                    known.shown_ms = at_ms
            case AnswerGiven(item=item) if (asking, item) in shown:
                shown[asking, item].take(event)
    return shown


def asked(kept: Kept) -> Mapping[str, Questionnaire]:
    """The questionnaires of a sitting by their names; none if they cannot be read."""
    if kept.plan is None:
        return {}
    return {each.id: each for each in (kept.plan.about_you, *kept.plan.questionnaires)}


def as_cell(value: Answer | None) -> Cell:
    """An answer as it stands in a cell."""
    return value


@dataclass(frozen=True)
class Score:
    """A scale's sum and mean; None unless every item was answered."""

    kept: Kept
    questionnaire: Questionnaire
    scale: str
    items: int
    scored: tuple[int, ...]

    @property
    def sum(self) -> int | None:
        """Of the items' values, reversed ones turned round."""
        return sum(self.scored) if len(self.scored) == self.items else None

    @property
    def mean(self) -> float | None:
        """The same, by the number of items."""
        return fmean(self.scored) if len(self.scored) == self.items else None


def scores(kept: Kept) -> Iterator[Score]:
    """The scales of the questionnaires that were shown."""
    given = answered(kept)
    for questionnaire in asked(kept).values():
        for scale, items in questionnaire.scales.items():
            seen = [
                (item, given[questionnaire.id, item.id].value) for item in items if (questionnaire.id, item.id) in given
            ]
            if seen:
                scored = tuple(item.scored(value) for item, value in seen if isinstance(value, int))
                yield Score(kept, questionnaire, scale, len(items), scored)


@dataclass(frozen=True)
class _Row:
    kept: Kept
    answered: Answered
    questionnaire: Questionnaire | None
    item: Item | None

    @property
    def typed(self) -> bool:
        """Whether it may be anybody's own words."""
        return isinstance(self.answered.value, str) and (self.item is None or isinstance(self.item, ShortText))

    @property
    def number(self) -> int | None:
        value = self.answered.value
        return value if isinstance(value, int) else None

    @property
    def scored(self) -> int | None:
        if self.number is None or not isinstance(self.item, Rating):
            return None
        return self.item.scored(self.number)


def _rows(kept: Kept) -> Iterator[_Row]:
    questionnaires = asked(kept)
    for answer in answered(kept).values():
        questionnaire = questionnaires.get(answer.questionnaire)
        items = questionnaire.items if questionnaire else ()
        item = next((item for item in items if item.id == answer.item), None)
        if not isinstance(item, Page):
            yield _Row(kept, answer, questionnaire, item)


def answers(extras: frozenset[Extra]) -> Table[Kept, _Row]:
    """The table of answers; what was typed only if it is asked for."""
    with_texts = Extra.TEXTS in extras
    typed = "" if with_texts else "; or it was typed, and such texts are left out"

    def value(row: _Row) -> Cell:
        return None if row.typed and not with_texts else as_cell(row.answered.value)

    given: tuple[Column[_Row], ...] = columns(
        (PARTICIPANT, lambda row: row.kept.name),
        (QUESTIONNAIRE, lambda row: row.answered.questionnaire),
        (VERSION, lambda row: row.questionnaire.version if row.questionnaire else None),
        (Variable("item", "The item, by its name in the questionnaire."), lambda row: row.answered.item),
        (
            Variable("place", "At which place the item came among all that were shown, from 1.", Kind.WHOLE),
            lambda row: row.answered.place,
        ),
        (
            Variable(
                "kind",
                "What kind of item it is, as the questionnaire declares it.",
                empty="the questionnaire cannot be read any more",
            ),
            lambda row: row.item.kind if row.item else None,
        ),
        (
            Variable(
                "value",
                "The last answer: a number, the name of an option, or several with a semicolon between them.",
                empty="nothing was answered" + typed,
            ),
            value,
        ),
        (
            Variable("number", "The answer as a number.", Kind.WHOLE, empty="the answer is none, or no number"),
            lambda row: row.number,
        ),
        (
            Variable(
                "scored",
                "The number as it counts in its scale: turned round if the item is reversed.",
                Kind.WHOLE,
                empty="the answer is none, or the item is no rating",
            ),
            lambda row: row.scored,
        ),
        (
            Variable("reversed", "Whether the item is turned round before it is summed.", Kind.TRUTH),
            lambda row: isinstance(row.item, Rating) and row.item.reverse,
        ),
        (SCALE, lambda row: row.item.scale if isinstance(row.item, Rating) else None),
        (
            Variable(
                "first_response_ms",
                "From when the item was shown to the first answer.",
                Kind.WHOLE,
                "ms",
                empty="nothing was answered",
            ),
            lambda row: row.answered.first_ms,
        ),
        (
            Variable(
                "last_response_ms",
                "From when the item was shown to the answer that counts.",
                Kind.WHOLE,
                "ms",
                empty="nothing was answered",
            ),
            lambda row: row.answered.last_ms,
        ),
        (
            Variable("changes", "How often the answer was changed, or taken back.", Kind.WHOLE),
            lambda row: row.answered.changes,
        ),
    )
    return Table(
        "answers",
        "One row for every item that was shown to a participant, answered or not.",
        ("participant_id", "questionnaire", "item"),
        given,
        _rows,
    )


_SCORE_COLUMNS: tuple[Column[Score], ...] = columns(
    (PARTICIPANT, lambda row: row.kept.name),
    (QUESTIONNAIRE, lambda row: row.questionnaire.id),
    (VERSION, lambda row: row.questionnaire.version),
    (SCALE, lambda row: row.scale),
    (
        Variable(
            "sum",
            "The sum of the scale's items, reversed ones turned round.",
            Kind.WHOLE,
            empty="not all of them were answered",
        ),
        lambda row: row.sum,
    ),
    (
        Variable("mean", "That sum by the number of items.", Kind.NUMBER, empty="not all of them were answered"),
        lambda row: row.mean,
    ),
    (Variable("items", "How many items the scale has.", Kind.WHOLE), lambda row: row.items),
    (Variable("answered", "How many of them were answered.", Kind.WHOLE), lambda row: len(row.scored)),
)

SCORES = Table(
    "scores",
    "One row for every scale of a questionnaire that a participant was shown.",
    ("participant_id", "questionnaire", "scale"),
    _SCORE_COLUMNS,
    scores,
)
