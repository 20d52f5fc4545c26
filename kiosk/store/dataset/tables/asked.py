"""The tables of what was asked: every answer, and the scores of the scales that answers are summed to."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from kiosk.store.dataset.column import Cell, Column, Kind, Level, Table, Variable
from kiosk.store.dataset.extras import Extra
from kiosk.store.dataset.stored.kept import Kept
from kiosk.store.dataset.tables.shared import PARTICIPANT, columns
from kiosk.study.after.answers import Answered
from kiosk.study.after.answers import answers as answers_in
from kiosk.study.after.scales import Score
from kiosk.study.after.scales import scores as scores_in
from kiosk.study.declared.questionnaire import KINDS, Item, Questionnaire, Rating, ShortText
from kiosk.study.events import ItemsShown

QUESTIONNAIRE = Variable("questionnaire", "The questionnaire, by its name.")
VERSION = Variable("version", "The version of the questionnaire.")
SCALE = Variable("scale", "The scale that items are summed to.", empty="the item is not summed with others")

_UNANSWERED = "nothing was answered"
_ANSWERED_KINDS = tuple(Level(kind) for kind in KINDS if kind != "page")


def asked(kept: Kept) -> tuple[Questionnaire, ...]:
    """The questionnaires of a sitting; none if they cannot be read."""
    return (kept.plan.about_you, *kept.plan.questionnaires) if kept.plan else ()


@dataclass(frozen=True)
class _Answer:
    kept: Kept
    questionnaire: Questionnaire
    item: Item
    place: int | None
    answered: Answered

    @property
    def number(self) -> int | None:
        value = self.answered.value
        return value if isinstance(value, int) else None

    @property
    def scored(self) -> int | None:
        return self.item.scored(self.number) if self.number is not None and isinstance(self.item, Rating) else None


def _answers(kept: Kept) -> Iterator[_Answer]:
    places = _places(kept)
    given = {(answer.questionnaire, answer.item): answer for answer in answers_in(kept.events, asked(kept))}
    for questionnaire in asked(kept):
        for item in questionnaire.items:
            key = (questionnaire.id, item.id)
            if key in given:
                yield _Answer(kept, questionnaire, item, places.get(key), given[key])


def _places(kept: Kept) -> dict[tuple[str, str], int]:
    """At which place each item came in its questionnaire, from 1."""
    shown: dict[str, list[str]] = {}
    for event in kept.events:
        if isinstance(event, ItemsShown):
            come = shown.setdefault(event.questionnaire, [])
            come += [item for item in event.items if item not in come]
    return {(asked, item): place for asked, items in shown.items() for place, item in enumerate(items, 1)}


def answers(extras: frozenset[Extra]) -> Table[Kept, _Answer]:
    """The table of answers; what was typed only if it is asked for."""
    with_texts = Extra.TEXTS in extras
    typed = "" if with_texts else "; or it was typed, and such texts are left out"

    def value(row: _Answer) -> Cell:
        return None if isinstance(row.item, ShortText) and not with_texts else row.answered.value

    given: tuple[Column[_Answer], ...] = columns(
        (PARTICIPANT, lambda row: row.kept.name),
        (QUESTIONNAIRE, lambda row: row.questionnaire.id),
        (VERSION, lambda row: row.questionnaire.version),
        (Variable("item", "The item, by its name in the questionnaire."), lambda row: row.item.id),
        (
            Variable(
                "place", "At which place the item came in its questionnaire, from 1.", Kind.WHOLE, empty="it did not"
            ),
            lambda row: row.place,
        ),
        (
            Variable("kind", "What kind of item it is.", levels=_ANSWERED_KINDS),
            lambda row: row.item.kind,
        ),
        (
            Variable(
                "value",
                "The last answer: a number, the name of an option, or several with a semicolon between them.",
                empty=_UNANSWERED + typed,
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
                "From when the page was shown to the first answer, less pauses.",
                Kind.WHOLE,
                "ms",
                empty=_UNANSWERED,
            ),
            lambda row: row.answered.first_ms,
        ),
        (
            Variable(
                "last_response_ms",
                "The same to the last answer, also one that took it back.",
                Kind.WHOLE,
                "ms",
                empty=_UNANSWERED,
            ),
            lambda row: row.answered.last_ms,
        ),
        (
            Variable("changes", "How often the answer was changed, or taken back, after the first.", Kind.WHOLE),
            lambda row: row.answered.changes,
        ),
    )
    return Table(
        "answers",
        "One row for every item that a participant could be asked, whether it was answered or not. Sittings whose "
        "questionnaires cannot be read any more have none; their events tell what was answered.",
        ("participant_id", "questionnaire", "item"),
        given,
        _answers,
    )


@dataclass(frozen=True)
class _Score:
    kept: Kept
    questionnaire: Questionnaire
    score: Score


def scores(kept: Kept) -> tuple[Score, ...]:
    """The scales of a sitting's questionnaires."""
    return scores_in(answers_in(kept.events, asked(kept)), asked(kept))


def _scores(kept: Kept) -> Iterator[_Score]:
    questionnaires = {questionnaire.id: questionnaire for questionnaire in asked(kept)}
    yield from (_Score(kept, questionnaires[score.questionnaire], score) for score in scores(kept))


_SCORE_COLUMNS: tuple[Column[_Score], ...] = columns(
    (PARTICIPANT, lambda row: row.kept.name),
    (QUESTIONNAIRE, lambda row: row.questionnaire.id),
    (VERSION, lambda row: row.questionnaire.version),
    (SCALE, lambda row: row.score.scale),
    (
        Variable(
            "sum",
            "The sum of the scale's items, reversed ones turned round.",
            Kind.WHOLE,
            empty="not all of them were answered",
        ),
        lambda row: row.score.total,
    ),
    (
        Variable(
            "mean",
            "The mean of those items of the scale that were answered, reversed ones turned round.",
            Kind.NUMBER,
            empty="none of them was answered",
        ),
        lambda row: row.score.mean,
    ),
    (Variable("items", "How many items the scale has.", Kind.WHOLE), lambda row: row.score.items),
    (Variable("answered", "How many of them were answered.", Kind.WHOLE), lambda row: row.score.answered),
)

SCORES = Table(
    "scores",
    "One row for every scale of the questionnaires that a participant could be asked.",
    (PARTICIPANT.name, QUESTIONNAIRE.name, SCALE.name),
    _SCORE_COLUMNS,
    _scores,
)
