"""The tables of what was asked: every answer, and the scores of the scales that answers are summed to."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from kiosk.experiment.item_responses import ItemResponse
from kiosk.experiment.items import Rating, ShortText
from kiosk.experiment.projections import ScaleScore, item_responses, scale_scores
from kiosk.experiment.questionnaire import KINDS, Item, Questionnaire
from kiosk.export.columns import (
    PARTICIPANT,
    Cell,
    Column,
    ColumnKind,
    ExportOption,
    Level,
    Table,
    Variable,
    make_columns,
)
from kiosk.export.records import StudyMaterials
from kiosk.store.session_records import SessionRecord

QUESTIONNAIRE = Variable("questionnaire", "The questionnaire, by its name.")
VERSION = Variable("version", "The version of the questionnaire.")
SCALE = Variable("scale", "The scale that items are summed to.", empty="the item is not summed with others")

_UNANSWERED = "nothing was answered"
_UNANSWERED_OR_NOT_APPLICABLE = "nothing was answered, or not_applicable or not_shown is true"

NOT_APPLICABLE = Variable(
    "not_applicable",
    "Whether the visitor said that the item does not apply. The answer is then empty and is in no sum or mean.",
    ColumnKind.TRUTH,
)
NOT_SHOWN = Variable(
    "not_shown",
    "Whether the item's condition did not hold in the end. The item was then never shown, or its answer was withdrawn; "
    "it is empty and in no sum or mean.",
    ColumnKind.TRUTH,
)
_ANSWERED_KINDS = tuple(Level(kind) for kind in KINDS if kind != "page")


def session_questionnaires(kept: SessionRecord) -> tuple[Questionnaire, ...]:
    """Return the questionnaires of a session as they were asked at its visit; none if they cannot be read."""
    return (*kept.plan.asked_about_you, *kept.plan.asked_after_game) if kept.plan else ()


def session_forms(kept: SessionRecord) -> tuple[Questionnaire, ...]:
    """Return the questionnaires of which something was asked, with all their items; none if they cannot be read."""
    if kept.plan is None:
        return ()
    forms = (kept.plan.about_you, *kept.plan.questionnaires)
    return tuple(form for form in forms if form.at_visit(kept.plan.visit) is not None)


def session_about_you(kept: SessionRecord) -> tuple[Questionnaire, ...]:
    """Return the questionnaire about the visitor as it was asked; none if it was not, or cannot be read."""
    return kept.plan.asked_about_you if kept.plan else ()


@dataclass(frozen=True)
class _Answer:
    kept: SessionRecord
    questionnaire: Questionnaire
    item: Item
    position: int | None
    answered: ItemResponse

    @property
    def scored(self) -> int | None:
        return None if self.answered.value is None else self.item.score(self.answered.value)


def _answers(kept: SessionRecord) -> Iterator[_Answer]:
    given = {
        (answer.questionnaire, answer.item): answer
        for answer in item_responses(kept.state, session_questionnaires(kept))
    }
    for questionnaire in session_questionnaires(kept):
        positions = {
            item: position for position, item in enumerate(kept.state.shown_items.get(questionnaire.id, ()), 1)
        }
        for item in questionnaire.items:
            key = (questionnaire.id, item.id)
            if key in given:
                yield _Answer(kept, questionnaire, item, positions.get(item.id), given[key])


_ASKED_COLUMNS: tuple[Column[_Answer], ...] = make_columns(
    (PARTICIPANT, lambda row: row.kept.name),
    (QUESTIONNAIRE, lambda row: row.questionnaire.id),
    (VERSION, lambda row: row.questionnaire.version),
    (Variable("item", "The item, by its name in the questionnaire."), lambda row: row.item.id),
    (
        Variable(
            "item_position",
            "The position at which the item came in its questionnaire, from 1.",
            ColumnKind.WHOLE,
            empty="it did not",
        ),
        lambda row: row.position,
    ),
    (
        Variable("kind", "What kind of item it is.", levels=_ANSWERED_KINDS),
        lambda row: row.item.kind,
    ),
)
_COUNTED_COLUMNS: tuple[Column[_Answer], ...] = make_columns(
    (
        Variable(
            "scored",
            "The answer as it counts: of a rating, the number, turned round if the item is reversed.",
            ColumnKind.WHOLE,
            empty="the answer is none, or answers of its kind are not counted",
        ),
        lambda row: row.scored,
    ),
    (
        Variable("reversed", "Whether the item is turned round before it is summed.", ColumnKind.TRUTH),
        lambda row: isinstance(row.item, Rating) and row.item.reverse,
    ),
    (SCALE, lambda row: row.item.scale if isinstance(row.item, Rating) else None),
    (
        Variable(
            "first_response_ms",
            "From when the page was shown to the first answer, less pauses.",
            ColumnKind.WHOLE,
            "ms",
            empty=_UNANSWERED,
        ),
        lambda row: row.answered.first_ms,
    ),
    (
        Variable(
            "last_response_ms",
            "The same to the last answer, also one that took it back.",
            ColumnKind.WHOLE,
            "ms",
            empty=_UNANSWERED,
        ),
        lambda row: row.answered.last_ms,
    ),
    (
        Variable("changes", "How often the answer was changed, or taken back, after the first.", ColumnKind.WHOLE),
        lambda row: row.answered.changes,
    ),
)


def answers_table(study: StudyMaterials, extras: frozenset[ExportOption]) -> Table[SessionRecord, _Answer]:
    """Return the table of answers; what was typed and exact ages only if they are asked for."""
    with_texts = ExportOption.TEXTS in extras
    typed = "" if with_texts else "; or it was typed, and such texts are left out"
    ages = None if ExportOption.AGES in extras else study.age_bands
    aged = "" if ages is None else ", or it is an age in a band"

    def value(row: _Answer) -> Cell:
        if isinstance(row.item, ShortText) and not with_texts:
            return None
        return ages.applied(row.item.id, row.answered.value, row.kept) if ages else row.answered.value

    def number(row: _Answer) -> int | None:
        told = value(row)
        return told if isinstance(told, int) else None

    given: tuple[Column[_Answer], ...] = make_columns(
        (
            Variable(
                "value",
                "The last answer: a number, the name of an option, or several with a semicolon between them, in the "
                "order in which a ranking has them.",
                empty=_UNANSWERED_OR_NOT_APPLICABLE + typed,
            ),
            value,
        ),
        (NOT_APPLICABLE, lambda row: row.answered.does_not_apply),
        (NOT_SHOWN, lambda row: row.answered.hidden),
        (
            Variable(
                "number", "The answer as a number.", ColumnKind.WHOLE, empty="the answer is none, or no number" + aged
            ),
            number,
        ),
    )
    return Table(
        "answers",
        "One row for every item that a participant could be asked, whether it was answered or not. Sessions whose "
        "questionnaires cannot be read any more have none; their events tell what was answered.",
        ("participant_id", "questionnaire", "item"),
        (*_ASKED_COLUMNS, *given, *_COUNTED_COLUMNS),
        _answers,
    )


@dataclass(frozen=True)
class _Score:
    kept: SessionRecord
    questionnaire: Questionnaire
    score: ScaleScore


def session_scores(kept: SessionRecord) -> tuple[ScaleScore, ...]:
    """Return the scales of a session's questionnaires."""
    questionnaires = session_questionnaires(kept)
    return scale_scores(item_responses(kept.state, questionnaires), questionnaires)


def _scores(kept: SessionRecord) -> Iterator[_Score]:
    questionnaires = {questionnaire.id: questionnaire for questionnaire in session_questionnaires(kept)}
    yield from (_Score(kept, questionnaires[score.questionnaire], score) for score in session_scores(kept))


_SCORE_COLUMNS: tuple[Column[_Score], ...] = make_columns(
    (PARTICIPANT, lambda row: row.kept.name),
    (QUESTIONNAIRE, lambda row: row.questionnaire.id),
    (VERSION, lambda row: row.questionnaire.version),
    (SCALE, lambda row: row.score.scale),
    (
        Variable(
            "sum",
            "The sum of the scale's items, reversed ones turned round.",
            ColumnKind.WHOLE,
            empty="not all of them were answered, some did not apply, or some were hidden",
        ),
        lambda row: row.score.total,
    ),
    (
        Variable(
            "mean",
            "The mean of those items of the scale that were answered, reversed ones turned round.",
            ColumnKind.NUMBER,
            empty="fewer of them were answered than least_answered says",
        ),
        lambda row: row.score.mean,
    ),
    (Variable("items", "How many items the scale has.", ColumnKind.WHOLE), lambda row: row.score.items),
    (
        Variable("answered", "How many of them were answered; the mean is that of so many.", ColumnKind.WHOLE),
        lambda row: row.score.answered,
    ),
    (
        Variable("items_not_applicable", "How many of them the visitor said do not apply.", ColumnKind.WHOLE),
        lambda row: row.score.not_applicable,
    ),
    (
        Variable("items_not_shown", "How many of them their condition hid.", ColumnKind.WHOLE),
        lambda row: row.score.hidden,
    ),
    (
        Variable("least_answered", "How many of them had to be answered for the mean.", ColumnKind.WHOLE),
        lambda row: row.score.needed,
    ),
)

SCORES = Table(
    "scores",
    "One row for every scale of the questionnaires that a participant could be asked.",
    (PARTICIPANT.name, QUESTIONNAIRE.name, SCALE.name),
    _SCORE_COLUMNS,
    _scores,
)
