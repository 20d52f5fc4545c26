"""The tables of what was written: every event as it happened, and every sentence that was said."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum

from kiosk.experiment.events import (
    HintGiven,
    SentenceRepeated,
    SentenceRequested,
    SpeechFailed,
    SpeechFinished,
    SpeechStarted,
)
from kiosk.export.columns import (
    AT,
    PARTICIPANT,
    SENTENCE,
    STAGE,
    UTTERANCE,
    Column,
    ColumnKind,
    ExportOption,
    Level,
    Table,
    Variable,
    enum_levels,
    make_columns,
)
from kiosk.export.records import safe_fields
from kiosk.store.session_records import EventRecord, SessionRecord

FIELDS = "fields"


@dataclass(frozen=True)
class _Logged:
    kept: SessionRecord
    record: EventRecord


def events_table(extras: frozenset[ExportOption]) -> Table[SessionRecord, _Logged]:
    """The table of all events; free texts only if they are asked for."""
    with_texts = ExportOption.TEXTS in extras
    told = "" if with_texts else " Fields that may hold free text are left out."

    def fields(row: _Logged) -> dict[str, object]:
        return dict(row.record.fields) if with_texts else safe_fields(row.record, row.kept)

    logged: tuple[Column[_Logged], ...] = make_columns(
        (PARTICIPANT, lambda row: row.kept.name),
        (
            Variable("seq", "The number of the event in its session, in the order of writing.", ColumnKind.WHOLE),
            lambda row: row.record.seq,
        ),
        (AT, lambda row: row.record.at_ms),
        (
            Variable(
                "origin",
                "Where the event is from.",
                levels=(
                    Level("world", "from outside: a tap, the end of a wait, the robot's or the voice's word"),
                    Level("session", "the program's conclusion from the event before it"),
                    Level("recovery", "written afterwards, when the session was found cut off"),
                ),
            ),
            lambda row: row.record.origin,
        ),
        (Variable("type", "What happened; the codebook lists every kind."), lambda row: row.record.type),
        (STAGE, lambda row: row.record.stage.value),
        (
            Variable(
                FIELDS,
                "What else is known of the event, as one JSON object; rows and columns in it count from 0." + told,
                ColumnKind.JSON,
            ),
            fields,
        ),
    )
    return Table(
        "events",
        "One row for every event of a session, as it was written; the other tables follow from it.",
        ("participant_id", "seq"),
        logged,
        lambda kept: [_Logged(kept, record) for record in kept.records],
    )


class SentencePurpose(Enum):
    """What a sentence was for."""

    HINT = "hint"
    SPEECH = "speech"
    REPEAT = "repeat"


@dataclass
class _Said:
    """A sentence and what became of it, in ms."""

    kept: SessionRecord
    record: EventRecord
    utterance: int
    sentence: str
    purpose: SentencePurpose
    started_ms: int | None = None
    finished_ms: int | None = None
    failed_ms: int | None = None


def _sentences(kept: SessionRecord) -> Iterator[_Said]:
    said: dict[int, _Said] = {}
    for record in kept.records:
        match record.event:
            case HintGiven(utterance=number, sentence=sentence):
                said[number] = _Said(kept, record, number, sentence, SentencePurpose.HINT)
            case SentenceRequested(utterance=number, sentence=sentence):
                said[number] = _Said(kept, record, number, sentence, SentencePurpose.SPEECH)
            case SentenceRepeated(utterance=number, of=before):
                sentence = said[before].sentence if before in said else ""
                said[number] = _Said(kept, record, number, sentence, SentencePurpose.REPEAT)
            case SpeechStarted(utterance=number, at_ms=at_ms) if number in said:
                said[number].started_ms = at_ms
            case SpeechFinished(utterance=number, at_ms=at_ms) if number in said:
                said[number].finished_ms = at_ms
            case SpeechFailed(utterance=number, at_ms=at_ms) if number in said:
                said[number].failed_ms = at_ms
    yield from said.values()


_SENTENCE_COLUMNS: tuple[Column[_Said], ...] = make_columns(
    (PARTICIPANT, lambda row: row.kept.name),
    (UTTERANCE, lambda row: row.utterance),
    (STAGE, lambda row: row.record.stage.value),
    (
        Variable(
            "purpose",
            "What the sentence was for.",
            levels=enum_levels(
                SentencePurpose,
                hint="it gave a hint",
                speech="a greeting, an explanation, a remark or thanks",
                repeat="the experimenter had the last sentence said again",
            ),
        ),
        lambda row: row.purpose.value,
    ),
    (AT, lambda row: row.record.at_ms),
    (SENTENCE, lambda row: row.sentence),
    (
        Variable(
            "started_ms",
            "When the voice began, from the session's first event.",
            ColumnKind.WHOLE,
            "ms",
            empty="no voice said it",
        ),
        lambda row: row.started_ms,
    ),
    (
        Variable(
            "finished_ms",
            "When the voice had said it to its end, from the session's first event.",
            ColumnKind.WHOLE,
            "ms",
            empty="it was not said to its end, and stayed to be read",
        ),
        lambda row: row.finished_ms,
    ),
    (
        Variable(
            "failed_ms",
            "When a voice failed to say it, from the session's first event; another may have said it all the same.",
            ColumnKind.WHOLE,
            "ms",
            empty="no voice failed",
        ),
        lambda row: row.failed_ms,
    ),
)

SENTENCES = Table(
    "sentences",
    "One row for every sentence that was said or shown in the bubble.",
    ("participant_id", "utterance"),
    _SENTENCE_COLUMNS,
    _sentences,
)
