"""The table of participants."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from functools import lru_cache
from itertools import chain

from kiosk.experiment.events import (
    HOURS_IN_A_BAND,
    FallbackReason,
    InputDevice,
    PracticeEnd,
    SessionSetup,
)
from kiosk.experiment.labels import fold_name
from kiosk.experiment.outcomes import AllocationSource, EmbodimentKind, SessionKind, Stage, Status
from kiosk.export.columns import (
    EMBODIMENT,
    PARTICIPANT,
    ROBOT,
    Cell,
    Column,
    ColumnKind,
    ExportOption,
    Label,
    Level,
    Table,
    Variable,
    condition_variable,
    enum_levels,
    make_columns,
    who_sat_there,
)
from kiosk.export.flow import last_stage
from kiosk.export.item_columns import about_you_columns, consent_columns, scale_columns
from kiosk.export.person import MEASURES, Person
from kiosk.export.records import TELLS_THE_ORDER, StudyMaterials
from kiosk.export.responses import session_forms
from kiosk.store.session_records import SessionRecord


def participants_table(
    study: StudyMaterials, extras: frozenset[ExportOption], elsewhere: frozenset[str]
) -> Table[SessionRecord, Person]:
    """Return the table of participants for a study.

    ``elsewhere`` are the columns of other tables, whose names are taken.
    """
    before, after = _own(study, extras)
    taken = _taken((*before, *after), elsewhere)
    declared = (
        *consent_columns(study, taken),
        *chain(*about_you_columns(study, extras, taken).values()),
        *scale_columns(study, taken),
    )
    columns = (*before, *declared, *after)
    if study.shuffled:
        columns = tuple(column for column in columns if column.variable.name not in TELLS_THE_ORDER)
    return Table(
        "participants",
        "One row for every participant, that is for every session."
        + (" Someone who came back has a row for each visit." if study.lets_return else ""),
        (PARTICIPANT.name,),
        columns,
        lambda kept: [Person(kept)],
    )


def renamed(study: StudyMaterials, elsewhere: frozenset[str]) -> dict[str, str]:
    """Return the items about the visitor that cannot give their column its name, for it is that of another column."""
    extras = frozenset(ExportOption)
    taken = _taken(tuple(column for part in _own(study, extras) for column in part), elsewhere)
    # The columns of the consent take their names first.
    tuple(consent_columns(study, taken))
    columns_of = about_you_columns(study, extras, taken)
    return {item: answer.variable.name for item, (answer, *_) in columns_of.items() if item != answer.variable.name}


_Columns = tuple[Column[Person], ...]


def _own(study: StudyMaterials, extras: frozenset[ExportOption]) -> tuple[_Columns, _Columns]:
    """Return the columns that every study has, before and after those that it declares itself."""
    visits = _VISITS if study.lets_return else ()
    return (*_who(extras), *visits, *_language_and_condition(study), *_WHAT_CAME_OF_IT, *_SETUP), (
        *MEASURES,
        *_what_it_followed(study),
    )


def _taken(own: _Columns, elsewhere: frozenset[str]) -> set[str]:
    return {fold_name(name) for name in (*elsewhere, *(column.variable.name for column in own))}


def _who(extras: frozenset[ExportOption]) -> tuple[Column[Person], ...]:
    started = Variable("started_at", "When the session began, in UTC.", unit="ISO 8601")
    who: list[tuple[Variable, Callable[[Person], Cell]]] = [
        (PARTICIPANT, lambda row: row.kept.name),
        (
            Variable("site", "Where the session was, by a short name.", empty="the study has one site"),
            lambda row: Label(row.kept.row["site"]) or None,
        ),
    ]
    who += [(variable, _has_kind(kind)) for variable, kind in who_sat_there(extras)]
    if ExportOption.DATES in extras:
        who.append((started, lambda row: row.kept.row["started_at"]))
    return make_columns(*who)


_VISITS: tuple[Column[Person], ...] = make_columns(
    (
        Variable("participant", "The person: participant_id of the first visit, at every visit."),
        lambda row: row.kept.participant,
    ),
    (
        Variable(
            "visit", "Which visit of the person it is, from 1; one that was deleted counts too.", ColumnKind.WHOLE
        ),
        lambda row: row.kept.visit,
    ),
    (
        Variable(
            "days_since_first_visit",
            "Days in UTC from that of the first visit to that of this one.",
            ColumnKind.WHOLE,
            "d",
            empty="the first visit was deleted",
        ),
        lambda row: row.kept.days_since_first_visit,
    ),
)
"""The columns of a study that lets visitors come back."""


def _has_kind(kind: SessionKind) -> Callable[[Person], Cell]:
    return lambda row: row.kept.kind is kind


def _language_and_condition(study: StudyMaterials) -> tuple[Column[Person], ...]:
    return make_columns(
        (Variable("language", "The language of the session, by its code."), lambda row: row.kept.row["language"]),
        (condition_variable(plan.settings for plan in study.plans), lambda row: row.kept.row["condition"]),
    )


@lru_cache(maxsize=8)
def _sha256(text: str) -> str:
    """Return the hash of an allocation list, which thousands of sessions may have followed."""
    return hashlib.sha256(text.encode()).hexdigest()


_NOT_NOTED = "it was not noted"


def _of_setup(
    variable: Variable, of: Callable[[SessionSetup], Cell]
) -> tuple[tuple[Variable, Callable[[Person], Cell]], ...]:
    """Return a column about what a session began with."""
    return ((variable, lambda row: None if row.state.setup is None else of(row.state.setup)),)


def _pixels(name: str, what: str) -> Variable:
    return Variable(name, f"The {what} of the screen.", ColumnKind.WHOLE, "px", empty=_NOT_NOTED)


def _hours(band: int) -> str:
    first = band * HOURS_IN_A_BAND
    return f"{first:02} to {first + HOURS_IN_A_BAND:02} o'clock"


_SETUP: tuple[Column[Person], ...] = make_columns(
    *_of_setup(
        Variable(
            "hour_band",
            "The hour of the day at which the session began, local time, in bands of four hours.",
            levels=tuple(Level(_hours(band)) for band in range(24 // HOURS_IN_A_BAND)),
            empty="it was not noted, or a rehearsal had no time of day",
        ),
        lambda setup: None if setup.hour_band is None else _hours(setup.hour_band),
    ),
    *_of_setup(
        Variable(
            "visitors_before",
            "How many stored sessions of the same kind and site had begun before on the same day, local time.",
            ColumnKind.WHOLE,
            empty="it was not noted, or a rehearsal had no time of day",
        ),
        lambda setup: setup.visitors_before,
    ),
    *_of_setup(_pixels("screen_width", "width"), lambda setup: setup.screen_width),
    *_of_setup(_pixels("screen_height", "height"), lambda setup: setup.screen_height),
    *_of_setup(
        Variable(
            "screen_scale",
            "How many pixels of the screen the system counts as one.",
            ColumnKind.NUMBER,
            empty=_NOT_NOTED,
        ),
        lambda setup: setup.screen_scale,
    ),
    *(
        each
        for name, what, of in (
            ("screen_width_mm", "width", lambda setup: setup.screen_width_mm or None),
            ("screen_height_mm", "height", lambda setup: setup.screen_height_mm or None),
        )
        for each in _of_setup(
            Variable(
                name,
                f"The {what} of the screen, as it tells the system; some screens tell something else.",
                ColumnKind.WHOLE,
                "mm",
                empty="the screen does not tell it, or it was not noted",
            ),
            of,
        )
    ),
    *_of_setup(
        Variable("window_width", "The width of the kiosk's window.", ColumnKind.WHOLE, "px", empty=_NOT_NOTED),
        lambda setup: setup.window_width,
    ),
    *_of_setup(
        Variable("window_height", "The height of the kiosk's window.", ColumnKind.WHOLE, "px", empty=_NOT_NOTED),
        lambda setup: setup.window_height,
    ),
    (
        Variable(
            "input_devices",
            "What the visitor turned cards with, in the practice and in the game.",
            ColumnKind.NAMES,
            levels=enum_levels(InputDevice),
            empty="no card was turned, or it was not noted",
        ),
        lambda row: tuple(sorted(device.value for device in row.state.input_devices)) or None,
    ),
)


_WHAT_CAME_OF_IT: tuple[Column[Person], ...] = make_columns(
    (
        Variable(
            "allocation_source",
            "How the session came to its condition.",
            levels=enum_levels(
                AllocationSource,
                list="by the first free slot of a list that was fixed before the first visitor",
                override="by the experimenter",
                beyond="the list was used up, and nothing was drawn: by the study file, the same for all of them",
                returning="by the conditions of earlier visits: the participant came back",
            ),
            empty="there was no allocation list",
        ),
        lambda row: row.kept.row["allocation_source"],
    ),
    (
        Variable(
            "allocation_slot",
            "The slot that the session took in that list, from 1.",
            ColumnKind.WHOLE,
            empty="it took none",
        ),
        lambda row: row.kept.row["allocation_slot"],
    ),
    (
        Variable("allocation_block", "The block of that slot, from 1.", ColumnKind.WHOLE, empty="it took none"),
        lambda row: row.slot.block if row.slot else None,
    ),
    (
        Variable(
            "allocation_block_size",
            "How many slots a block of that list has; its last one may be shorter.",
            ColumnKind.WHOLE,
            empty="it took none",
        ),
        lambda row: row.kept.row["block_size"],
    ),
    (
        Variable(
            "allocation_probability",
            "The probability with which chance gave the slot this condition: the condition's share of the block.",
            ColumnKind.NUMBER,
            empty="it took none",
        ),
        lambda row: row.allocation_probability,
    ),
    (
        Variable("allocation_sha256", "The hash of that list as it is stored.", empty="it took none"),
        lambda row: _sha256(row.kept.row["slots"]) if row.slot else None,
    ),
    (EMBODIMENT, lambda row: row.embodiment.kind.value),
    (ROBOT, lambda row: row.embodiment.driver or None),
    *_of_setup(
        Variable(
            "intended_embodiment",
            "What was meant to help with voice and face when the session began: the robot, if the kiosk had one.",
            levels=enum_levels(EmbodimentKind),
            empty=_NOT_NOTED,
        ),
        lambda setup: setup.intended.kind.value,
    ),
    *_of_setup(
        Variable(
            "embodiment_fallback",
            "Why the avatar helped from the start where a robot was meant to.",
            levels=enum_levels(
                FallbackReason,
                chosen="the experimenter chose the avatar",
                sought="the robot was still being looked for",
                failed="the robot was not found, or had failed",
            ),
            empty="what was meant to help did, or it was not noted",
        ),
        lambda setup: setup.fallback.value if setup.fallback else None,
    ),
    (
        Variable(
            "embodiment_changes",
            "How often another body had to take over; who went on after a cut is in the events.",
            ColumnKind.WHOLE,
        ),
        lambda row: len(row.state.embodiment_changes),
    ),
    (
        Variable(
            "status",
            "How the session ended.",
            levels=enum_levels(
                Status,
                completed="by going through all its stages",
                abandoned="the visitor left",
                stopped="the experimenter ended it",
                withdrawn="the visitor stopped it with the button on the screen",
                interrupted="the program was closed or cut off",
            ),
        ),
        lambda row: row.kept.status.value if row.kept.status else None,
    ),
    (
        Variable("last_stage", "The last stage that the session reached.", levels=enum_levels(Stage)),
        lambda row: last_stage(row.state).value,
    ),
    (
        Variable(
            "game_completed",
            "Whether every pair of the game was found and the last one looked at; with that its slot is consumed.",
            ColumnKind.TRUTH,
        ),
        lambda row: row.state.game_completed,
    ),
    (
        Variable("resumed", "How often the session was cut off and gone on with.", ColumnKind.WHOLE),
        lambda row: len(row.state.resumptions),
    ),
    (
        Variable("pauses", "How often the experimenter paused the session.", ColumnKind.WHOLE),
        lambda row: len(row.state.pauses),
    ),
    (
        Variable(
            "practice_end",
            "How the practice ended.",
            levels=enum_levels(
                PracticeEnd,
                found="every pair was found",
                left="the visitor went on early",
                time="its time was over",
            ),
            empty="there was none, or it was not ended",
        ),
        lambda row: row.state.practice_end.value if row.state.practice_end else None,
    ),
    (
        Variable(
            "duration_ms",
            "From the session's first event to its last.",
            ColumnKind.WHOLE,
            "ms",
        ),
        lambda row: row.kept.records[-1].at_ms if row.kept.records else 0,
    ),
    (
        Variable(
            "consent_version",
            "The version of the information sheet that the visitor agreed to.",
            empty="no consent was asked for on the screen",
        ),
        lambda row: row.state.consent.version if row.state.consent else None,
    ),
)


def _what_it_followed(study: StudyMaterials) -> tuple[Column[Person], ...]:
    return make_columns(
        (
            Variable("program_version", "The version of Recollect that recorded it."),
            lambda row: row.kept.row["version"],
        ),
        (
            Variable("program_commit", "The commit of Recollect that recorded it; -dirty if it had been changed."),
            lambda row: row.kept.row["code_commit"],
        ),
        (
            Variable(
                "study_sha256",
                "The hash of the whole study, as `recollect study pack` prints it; two studies with one hash are the "
                "same in all that sessions follow.",
                empty="it was not known",
            ),
            lambda row: row.kept.row["study_sha256"] or None,
        ),
        (
            Variable(
                "record_sha256",
                "The end of the chain of SHA-256 hashes over all events of the session, as the data folder holds it. "
                "With the folder, or a copy of it, you can compare: `recollect sessions --json` prints it.",
                empty="the data folder has lost it, which `recollect verify` says",
            ),
            lambda row: row.kept.row["record_sha256"].lower() or None,
        ),
        (
            Variable("policy_sha256", "The hash of the table that chose how much to help."),
            lambda row: row.kept.row["policy_sha256"],
        ),
        (
            Variable("settings_sha256", "The hash of all settings of the study."),
            lambda row: row.kept.row["settings_sha256"],
        ),
        (
            Variable(
                "questionnaire_versions",
                "Every questionnaire of the session with its version, as name=version; where two contents have one "
                "version, with the beginning of its hash.",
                ColumnKind.NAMES,
                empty="they cannot be read any more",
            ),
            lambda row: tuple(f"{each.id}={study.label(each)}" for each in session_forms(row.kept)) or None,
        ),
    )
