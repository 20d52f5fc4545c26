"""The tables of what was written: every event as it happened, and every sentence that was said."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from dataclasses import fields as fields_of
from enum import Enum
from itertools import repeat
from operator import attrgetter
from typing import Any, NamedTuple

from kiosk.experiment.event_records import event_kinds
from kiosk.experiment.events import CardSelected
from kiosk.experiment.experimenter import DEVIATIONS, DeviationReason
from kiosk.experiment.outcomes import Stage
from kiosk.experiment.spoken_sentences import SentencePurpose, SpeechAttempt, SpokenSentence
from kiosk.export.columns import (
    AT,
    EMBODIMENT,
    PARTICIPANT,
    ROBOT,
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
from kiosk.export.records import FREE, TELLS_THE_ORDER, StudyMaterials, safe_fields
from kiosk.store.session_records import Deviation, EventRecord, SessionRecord

FIELDS = "fields"

_FIELDS_CHANGED = frozenset({"trace", "setup", "value"})
_CHANGED = FREE.keys() | {
    name for name, kind in event_kinds().items() if _FIELDS_CHANGED & {field.name for field in fields_of(kind)}
}
"""The events of which a field may be left out or stand otherwise than it was written."""


class SoundDevice(Enum):
    """The kinds of sound devices that names tell apart; the first whose words are in a name is its kind."""

    BLUETOOTH = "bluetooth"
    HEADPHONES = "headphones"
    DISPLAY = "display"
    USB = "usb"
    SPEAKERS = "speakers"
    SYSTEM_DEFAULT = "system_default"
    SILENT = "silent"
    OTHER = "other"

    @classmethod
    def of(cls, name: str) -> SoundDevice:
        """Return the kind of a device of this name."""
        folded = name.casefold()
        if folded == NOWHERE:
            return cls.SILENT
        return next((kind for kind, words in _DEVICE_WORDS.items() if any(word in folded for word in words)), cls.OTHER)


_DEVICE_WORDS = {
    SoundDevice.BLUETOOTH: ("bluetooth", "bluez", "airpods", "buds", "hands-free"),
    SoundDevice.HEADPHONES: ("headphone", "headset", "earphone", "cuffie", "auricular"),
    SoundDevice.DISPLAY: ("hdmi", "displayport", "display audio", "monitor"),
    SoundDevice.USB: ("usb",),
    SoundDevice.SPEAKERS: ("speaker", "built-in", "internal", "analog", "altoparlant", "altavoc", "altavoz"),
    SoundDevice.SYSTEM_DEFAULT: ("system default",),
}

NOWHERE = "null"
"""The device that is heard by no one; as kiosk.robots.sound_device calls it."""


def _without_trace(record: EventRecord) -> str | dict[str, object]:
    """Return the fields of a tap without the way of the pointer, which has a table of its own."""
    fields, payload = record.fields, record.payload
    if "trace" not in fields:
        return payload
    if tuple(fields)[-1] == "trace" and (begin := payload.rfind(_TRACE)) > 0:
        # Within a text the quotes would be escaped, so this is where the last field begins.
        return payload[:begin] + "}"
    return {name: value for name, value in fields.items() if name != "trace"}


_TRACE = ',"trace":['


class _Logged(NamedTuple):
    kept: SessionRecord
    record: EventRecord


def events_table(study: StudyMaterials, extras: frozenset[ExportOption]) -> Table[SessionRecord, _Logged]:
    """Return the table of all events; free texts and exact ages only if they are asked for."""
    with_texts = ExportOption.TEXTS in extras
    ages = None if ExportOption.AGES in extras else study.age_bands
    told = "" if with_texts else " Fields that may hold free text are left out."
    told += "" if ages is None else f" Ages stand in bands of {ages.years} years."

    def fields(row: _Logged) -> str | dict[str, object]:
        record = row.record
        if record.event is not None and record.type not in _CHANGED:
            return record.payload
        if record.type == CardSelected.__name__ and isinstance(record.event, CardSelected):
            return _without_trace(record)
        given = dict(row.record.fields) if with_texts else safe_fields(row.record, row.kept)
        # The way of the pointer has a table of its own.
        given.pop("trace", None)
        if study.shuffled and isinstance(given.get("setup"), dict):
            given["setup"] = {name: told for name, told in given["setup"].items() if name not in TELLS_THE_ORDER}
        item, value = given.get("item"), given.get("value")
        if ages is not None and isinstance(item, str) and isinstance(value, int | str):
            given["value"] = ages.applied(item, value, row.kept)
        return given

    logged: tuple[Column[_Logged], ...] = make_columns(
        (PARTICIPANT, lambda row: row.kept.name),
        (
            Variable("seq", "The number of the event in its session, in the order of writing.", ColumnKind.WHOLE),
            attrgetter("record.seq"),
        ),
        (AT, attrgetter("record.at_ms")),
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
            attrgetter("record.origin"),
        ),
        (Variable("type", "What happened; the codebook lists every kind."), attrgetter("record.type")),
        (STAGE, attrgetter("record.stage._value_")),
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
        lambda kept: map(_Logged, repeat(kept), kept.records),
    )


@dataclass(frozen=True)
class _Attempt:
    kept: SessionRecord
    said: SpokenSentence
    number: int
    what: SpeechAttempt


def _attempts(kept: SessionRecord) -> Iterator[_Attempt]:
    for said in kept.state.sentences:
        yield from (_Attempt(kept, said, number, attempt) for number, attempt in enumerate(said.attempts, 1))


def _by(name: str) -> Callable[[_Attempt], Any]:
    """Read what the record tells of the voice by this name; None if it tells nothing."""

    def read(row: _Attempt) -> Any:
        heard = row.what.heard
        return (getattr(heard, name) if heard else None) or None

    return read


_SENTENCE_COLUMNS: tuple[Column[_Attempt], ...] = make_columns(
    (PARTICIPANT, lambda row: row.kept.name),
    (UTTERANCE, lambda row: row.said.utterance),
    (
        Variable(
            "attempt",
            "Which attempt to say the sentence, from 1; where a robot is lost in mid-sentence, the avatar begins anew.",
            ColumnKind.WHOLE,
        ),
        lambda row: row.number,
    ),
    (STAGE, lambda row: row.said.stage.value),
    (
        Variable(
            "purpose",
            "What the sentence was for.",
            levels=enum_levels(
                SentencePurpose,
                hint="it gave a hint",
                remark="an action without a place: it said something before a flip, and pointed nowhere",
                speech="a greeting, an explanation, a comment or thanks",
                repeat="the experimenter had the last sentence said again",
            ),
        ),
        lambda row: row.said.purpose.value,
    ),
    (SENTENCE, lambda row: row.said.sentence),
    (EMBODIMENT, lambda row: row.what.embodiment.kind.value if row.what.embodiment else None),
    (ROBOT, lambda row: row.what.embodiment.driver or None if row.what.embodiment else None),
    (AT, lambda row: row.what.at_ms),
    (
        Variable(
            "started_ms",
            "When the voice began, from the session's first event.",
            ColumnKind.WHOLE,
            "ms",
            empty="the voice did not begin",
        ),
        lambda row: row.what.started_ms,
    ),
    (
        Variable(
            "finished_ms",
            "When the voice had said it to its end, from the session's first event.",
            ColumnKind.WHOLE,
            "ms",
            empty="it was not said to its end in this attempt",
        ),
        lambda row: row.what.finished_ms,
    ),
    (
        Variable(
            "failed_ms",
            "When the voice failed or the robot was lost, from the session's first event; the next attempt may have "
            "succeeded.",
            ColumnKind.WHOLE,
            "ms",
            empty="the voice did not fail",
        ),
        lambda row: row.what.failed_ms,
    ),
    (
        Variable(
            "cut_ms",
            "When a tap on the next card ended the sentence of a hint, from the session's first event.",
            ColumnKind.WHOLE,
            "ms",
            empty="no tap ended it",
        ),
        lambda row: row.what.cut_ms,
    ),
    *(
        (Variable(name, text, empty="the avatar's voice did not say it, or nothing was noted"), _by(field))
        for name, field, text in (
            ("voice_engine", "engine", "What made the sound: an engine, or a person who was recorded."),
            ("voice_engine_version", "engine_version", "The version of the engine."),
            ("voice", "voice", "The voice."),
            ("voice_pack", "pack", "The SHA-256 of the pack of clips that was played."),
        )
    ),
    (
        Variable(
            "sound_device",
            "What kind of sound device it was, after its name. The name itself may tell a person or a place, so it "
            "stands only in an export with texts, in the events.",
            levels=enum_levels(
                SoundDevice,
                bluetooth="a wireless device",
                headphones="headphones or a headset",
                display="the loudspeakers of a screen",
                usb="a device at a USB port",
                speakers="loudspeakers, built in or at the sound card",
                system_default="what the system has as its default",
                silent="none: it keeps the time and is heard by no one",
                other="its name says nothing of that",
            ),
            empty="the avatar's voice did not say it, or nothing was noted",
        ),
        lambda row: SoundDevice.of(row.what.heard.device).value if row.what.heard and row.what.heard.device else None,
    ),
    (
        Variable(
            "volume",
            "The volume, from 0 to 1.",
            ColumnKind.NUMBER,
            empty="the avatar's voice did not say it, or nothing was noted",
        ),
        lambda row: None if row.what.heard is None else row.what.heard.volume,
    ),
)

SENTENCES = Table(
    "sentences",
    "One row for every attempt to say a sentence. A sentence that no voice said to its end stayed to be read.",
    ("participant_id", "utterance", "attempt"),
    _SENTENCE_COLUMNS,
    _attempts,
)


@dataclass(frozen=True)
class _Deviated:
    kept: SessionRecord
    number: int
    what: Deviation

    @property
    def stage(self) -> Stage | None:
        """The stage that the session was in; None if it had not begun."""
        if self.what.at_ms is None:
            return None
        before = [record.stage for record in self.kept.records if record.at_ms <= self.what.at_ms]
        return before[-1] if before else Stage.ATTRACT

    @property
    def reason(self) -> str | None:
        given = self.what.payload.get("reason")
        return None if given is None else DeviationReason.without_words(str(given))


_DETAILS = ("condition", "embodiment", "language", "volume", "muted", "level", "is_heard")
"""What of a deviation is one of a few values; the rest may hold free text, or tell another session."""

_WORDED = ("reason", "why", "message")
"""What of a deviation is free text."""


_DEVIATION_COLUMNS: tuple[Column[_Deviated], ...] = make_columns(
    (PARTICIPANT, lambda row: row.kept.name),
    (
        Variable("deviation", "The number of the deviation in the session, in the order of time.", ColumnKind.WHOLE),
        lambda row: row.number,
    ),
    (
        Variable(
            "what_deviated",
            "What was done, or happened, at the booth.",
            levels=enum_levels(sorted(DEVIATIONS, key=lambda each: each.value)),
        ),
        lambda row: row.what.kind.value,
    ),
    (
        Variable(
            "deviation_ms",
            "When, from the session's first event.",
            ColumnKind.WHOLE,
            "ms",
            empty="it was before the session and after the one before, and can concern this one",
        ),
        lambda row: row.what.at_ms,
    ),
    (
        Variable(
            "deviation_stage",
            "The stage that the session was in.",
            levels=enum_levels(Stage),
            empty="it was before the session",
        ),
        lambda row: row.stage.value if row.stage else None,
    ),
    (
        Variable(
            "deviation_reason",
            "The reason that the experimenter chose.",
            levels=enum_levels(DeviationReason),
            empty="none was asked for",
        ),
        lambda row: row.reason,
    ),
    (
        Variable(
            "deviation_detail",
            "What was chosen or reported, such as a condition, as one JSON object.",
            ColumnKind.JSON,
            empty="there is nothing to tell",
        ),
        lambda row: {name: row.what.payload[name] for name in _DETAILS if name in row.what.payload} or None,
    ),
)
_DEVIATION_WORDS: tuple[Column[_Deviated], ...] = make_columns(
    (
        Variable(
            "words",
            "What the experimenter typed as a reason, or what a failure said.",
            empty="there were no words",
        ),
        lambda row: next((str(row.what.payload[name]) for name in _WORDED if name in row.what.payload), None),
    ),
)


def deviations_table(extras: frozenset[ExportOption]) -> Table[SessionRecord, _Deviated]:
    """Return the table of deviations; what an experimenter typed and messages only if texts are asked for."""
    return Table(
        "deviations",
        "One row for every deviation at the booth, with the session that it concerns: the one that was under way, or "
        "else the next. The clock of the kiosk tells which. There are none where data of several sites were merged.",
        (PARTICIPANT.name, "deviation"),
        _DEVIATION_COLUMNS + (_DEVIATION_WORDS if ExportOption.TEXTS in extras else ()),
        lambda kept: [_Deviated(kept, number, what) for number, what in enumerate(kept.deviations, 1)],
    )
