"""The table of participants: one row a sitting, with what was asked of it and what was measured in it."""

from __future__ import annotations

from collections.abc import Callable

from kiosk.store.dataset.column import Cell, Column, Kind, Label, Table, Variable, named
from kiosk.store.dataset.extras import Extra
from kiosk.store.dataset.stored.followed import Followed
from kiosk.store.dataset.stored.kept import Kept
from kiosk.store.dataset.tables.asked import asked
from kiosk.store.dataset.tables.flow import last_stage
from kiosk.store.dataset.tables.measured import MEASURES
from kiosk.store.dataset.tables.person import Person
from kiosk.store.dataset.tables.personal import about_you, agreed, scales, told_items
from kiosk.store.dataset.tables.shared import CONDITION, PARTICIPANT, columns, who_sat_there
from kiosk.study.allocation import Allotted
from kiosk.study.declared.labels import fold_name
from kiosk.study.events import BodyName, PracticeEnd, Stage, Status
from kiosk.study.session_kind import SessionKind


def participants(study: Followed, extras: frozenset[Extra], elsewhere: frozenset[str]) -> Table[Kept, Person]:
    """The table of participants for a study; ``elsewhere`` are the columns of other tables, whose names are taken."""
    before, after = _own(study, extras)
    taken = _taken((*before, *after), elsewhere)
    declared = (*agreed(study, taken), *about_you(study, extras, taken), *scales(study, taken))
    return Table(
        "participants",
        "One row for every participant, that is for every sitting.",
        (PARTICIPANT.name,),
        (*before, *declared, *after),
        lambda kept: [Person(kept)],
    )


def renamed(study: Followed, elsewhere: frozenset[str]) -> dict[str, str]:
    """The items about the visitor that cannot give their column its name, for it is that of another column."""
    extras = frozenset(Extra)
    taken = _taken(tuple(column for part in _own(study, extras) for column in part), elsewhere)
    # The columns of the consent take their names first.
    tuple(agreed(study, taken))
    columns_of = zip(told_items(study.about_you, extras), about_you(study, extras, taken), strict=True)
    return {item: column.variable.name for item, column in columns_of if item != column.variable.name}


_Columns = tuple[Column[Person], ...]


def _own(study: Followed, extras: frozenset[Extra]) -> tuple[_Columns, _Columns]:
    """The columns that every study has, before and after those that it declares itself."""
    return (*_who(extras), *_WHAT_CAME_OF_IT), (*MEASURES, *_what_it_followed(study))


def _taken(own: _Columns, elsewhere: frozenset[str]) -> set[str]:
    return {fold_name(name) for name in (*elsewhere, *(column.variable.name for column in own))}


def _who(extras: frozenset[Extra]) -> tuple[Column[Person], ...]:
    started = Variable("started_at", "When the sitting began, in UTC.", unit="ISO 8601")
    who: list[tuple[Variable, Callable[[Person], Cell]]] = [
        (PARTICIPANT, lambda row: row.kept.name),
        (
            Variable("site", "Where the sitting was, by a short name.", empty="the study has one site"),
            lambda row: Label(row.kept.row["site"]) or None,
        ),
    ]
    who += [(variable, _is_of(kind)) for variable, kind in who_sat_there(extras)]
    if Extra.DATES in extras:
        who.append((started, lambda row: row.kept.row["started_at"]))
    return columns(*who)


def _is_of(kind: SessionKind) -> Callable[[Person], Cell]:
    return lambda row: row.kept.kind is kind


_WHAT_CAME_OF_IT: tuple[Column[Person], ...] = columns(
    (Variable("language", "The language of the sitting, by its code."), lambda row: row.kept.row["language"]),
    (CONDITION, lambda row: row.kept.row["condition"]),
    (
        Variable(
            "allotted",
            "How the sitting came to its condition.",
            levels=named(
                Allotted,
                list="by the first free place of a list that was fixed before the first visitor",
                override="by the experimenter",
                beyond="the list was used up, and nothing was drawn: by the study file, the same for all of them",
            ),
            empty="there was no list of places",
        ),
        lambda row: row.kept.row["allotted"],
    ),
    (
        Variable(
            "list_place",
            "The place that the sitting took in that list, from 1.",
            Kind.WHOLE,
            empty="it took none",
        ),
        lambda row: row.kept.row["place"],
    ),
    (
        Variable("body", "Who helped with voice and face when the sitting began.", levels=named(BodyName)),
        lambda row: row.kept.row["body"],
    ),
    (
        Variable(
            "body_changes",
            "How often another body had to take over; who went on after a cut is in the events.",
            Kind.WHOLE,
        ),
        lambda row: len(row.overview.body_changes),
    ),
    (
        Variable(
            "status",
            "How the sitting ended.",
            levels=named(
                Status,
                completed="by going through all its stages",
                abandoned="the visitor left",
                stopped="the experimenter ended it",
                interrupted="the program was closed or cut off",
            ),
        ),
        lambda row: row.kept.status.value if row.kept.status else None,
    ),
    (
        Variable("last_stage", "The last stage that the sitting reached.", levels=named(Stage)),
        lambda row: last_stage(row.overview).value,
    ),
    (
        Variable(
            "game_completed",
            "Whether every pair of the game was found and the last one looked at; with that its place is consumed.",
            Kind.TRUTH,
        ),
        lambda row: row.overview.game_completed,
    ),
    (
        Variable("resumed", "How often the sitting was cut off and gone on with.", Kind.WHOLE),
        lambda row: len(row.overview.resumptions),
    ),
    (
        Variable("pauses", "How often the experimenter paused the sitting.", Kind.WHOLE),
        lambda row: len(row.overview.pauses),
    ),
    (
        Variable(
            "practice_end",
            "How the practice ended.",
            levels=named(
                PracticeEnd,
                found="every pair was found",
                left="the visitor went on early",
                time="its time was over",
            ),
            empty="there was none, or it was not ended",
        ),
        lambda row: row.practice.value if row.practice else None,
    ),
    (
        Variable(
            "duration_ms",
            "From the sitting's first event to its last.",
            Kind.WHOLE,
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
        lambda row: row.kept.consent.version if row.kept.consent else None,
    ),
)


def _what_it_followed(study: Followed) -> tuple[Column[Person], ...]:
    return columns(
        (
            Variable("program_version", "The version of Recollect that recorded it."),
            lambda row: row.kept.row["version"],
        ),
        (
            Variable("program_commit", "The commit of Recollect that recorded it; -dirty if it had been changed."),
            lambda row: row.kept.row["code_commit"],
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
                "Every questionnaire of the sitting with its version, as name=version; where two contents have one "
                "version, with the beginning of its hash.",
                Kind.NAMES,
                empty="they cannot be read any more",
            ),
            lambda row: tuple(f"{each.id}={study.label(each)}" for each in asked(row.kept)) or None,
        ),
    )
