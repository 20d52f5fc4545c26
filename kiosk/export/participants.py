"""The table of participants, their measures and the participant flow."""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, fields
from enum import Enum
from functools import cached_property, partial

from kiosk.experiment.condition import AllocationSlot, AllocationSource
from kiosk.experiment.events import (
    HOURS_IN_A_BAND,
    EmbodimentKind,
    EmbodimentName,
    FallbackReason,
    InputDevice,
    PracticeEnd,
    SessionSetup,
    Stage,
    Status,
)
from kiosk.experiment.information import PUBLISHING
from kiosk.experiment.items import Question, Rating, ShortText, TextPage, in_language
from kiosk.experiment.labels import fold_name
from kiosk.experiment.projections import Measures, ScaleScore, item_responses, measure_game
from kiosk.experiment.questionnaire import Item, facts
from kiosk.experiment.session_config import SessionKind
from kiosk.experiment.session_state import ItemResponse, SessionState
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
from kiosk.export.records import TELLS_THE_ORDER, AgeBands, Asked, Scale, StudyMaterials
from kiosk.export.responses import NOT_APPLICABLE, NOT_SHOWN, scores_table, session_about_you, session_forms
from kiosk.store.participants import Disposition, EnrolmentCounts, slots_by_block, slots_from_json
from kiosk.store.session_records import SessionRecord


class FlowQuantity(Enum):
    """What is counted."""

    NOT_STORED = "not_stored"
    QUOTA = "quota"
    CONSUMED = Disposition.CONSUMED.value
    DROPPED_OUT = Disposition.DROPPED_OUT.value
    UNDER_WAY = Disposition.UNDER_WAY.value
    OVERRIDDEN = Disposition.OVERRIDDEN.value
    BEYOND = Disposition.BEYOND.value
    RETURNING = Disposition.RETURNING.value
    UNLISTED = Disposition.UNLISTED.value
    WITHDRAWN = "withdrawn"
    NOT_SHARED = "not_shared"
    NOT_ENDED = "not_ended"
    ENDED_AT = "ended_at"
    EXPORTED = "exported"


MEANINGS = {
    FlowQuantity.NOT_STORED: "people who played without being stored, by reason",
    FlowQuantity.QUOTA: "how many completed games were wanted, by condition",
    FlowQuantity.CONSUMED: "sessions that took a slot of the allocation list and completed the game, by condition",
    FlowQuantity.DROPPED_OUT: "sessions that had a slot and did not complete the game, so that it was given out "
    "again, by condition",
    FlowQuantity.UNDER_WAY: "sessions with a slot that were going on when this was exported, by condition",
    FlowQuantity.OVERRIDDEN: "sessions whose condition the experimenter chose, by condition",
    FlowQuantity.BEYOND: "sessions that began when the list was used up, by condition",
    FlowQuantity.RETURNING: "later visits of participants who came back and took no slot, by condition",
    FlowQuantity.UNLISTED: "sessions without an allocation list, by condition",
    FlowQuantity.WITHDRAWN: "sessions that were deleted because their visitor withdrew, by condition; each is counted "
    "in one of the rows before as well",
    FlowQuantity.NOT_SHARED: "sessions left out here because their visitor did not agree to publishing, by condition",
    FlowQuantity.NOT_ENDED: "sessions left out here because they were going on, by condition",
    FlowQuantity.ENDED_AT: "sessions in this data set that ended before their end, by the stage in which they did",
    FlowQuantity.EXPORTED: "sessions in this data set, by condition",
}


@dataclass
class ParticipantFlow:
    """What was counted on the way through the sessions of people, of rehearsals or of trials."""

    kind: SessionKind
    counts: EnrolmentCounts
    seen: Counter[tuple[FlowQuantity, str]] = field(default_factory=Counter)

    def exported(self, kept: SessionRecord) -> None:
        """Count a session that is in the data set."""
        self.seen[FlowQuantity.EXPORTED, str(kept.row["condition"])] += 1
        if kept.status is not Status.COMPLETED:
            self.seen[FlowQuantity.ENDED_AT, last_stage(kept.state).value] += 1

    def counted(self, kept: SessionRecord, *, unshared: bool) -> bool:
        """Count a session, and return whether it is in the data set; ``unshared`` takes those in as well."""
        if kept.status is None:
            self.left_out(kept, FlowQuantity.NOT_ENDED)
        elif not kept.publishable and not unshared:
            self.left_out(kept, FlowQuantity.NOT_SHARED)
        else:
            self.exported(kept)
            return True
        return False

    def left_out(self, kept: SessionRecord, why: FlowQuantity) -> None:
        """Count one that is not."""
        self.seen[why, str(kept.row["condition"])] += 1


def last_stage(session: SessionState) -> Stage:
    """Return the last stage that was more than the end."""
    return session.last_stage or Stage.ATTRACT


@dataclass(frozen=True)
class _Count:
    kind: SessionKind
    quantity: FlowQuantity
    group: str
    count: int


def _rows(flows: tuple[ParticipantFlow, ...]) -> Iterator[_Count]:
    for flow in flows:
        counted = _counted(flow.counts) + flow.seen
        for quantity in FlowQuantity:
            for (what, group), count in counted.items():
                if what is quantity:
                    yield _Count(flow.kind, quantity, group, count)


def _counted(counts: EnrolmentCounts) -> Counter[tuple[FlowQuantity, str]]:
    """Return what the database has counted; nothing that is none."""
    counted = Counter({(FlowQuantity.NOT_STORED, why.value): number for why, number in counts.visits.items()})
    for condition, cell in counts.cells.items():
        counted[FlowQuantity.QUOTA, condition.name] = cell.quota
        counted[FlowQuantity.WITHDRAWN, condition.name] = cell.withdrawn
        counted |= Counter({(FlowQuantity(fate.value), condition.name): n for fate, n in cell.fates.items()})
    return +counted


def _is_of(kind: SessionKind) -> Callable[[_Count], Cell]:
    return lambda row: row.kind is kind


def flow_table(extras: frozenset[ExportOption]) -> Table[tuple[ParticipantFlow, ...], _Count]:
    """Return the table of the flow."""
    counted: tuple[Column[_Count], ...] = make_columns(
        *((variable, _is_of(kind)) for variable, kind in who_sat_there(extras)),
        (
            Variable(
                "quantity",
                "What is counted; what is not listed is none.",
                levels=enum_levels(FlowQuantity, **{quantity.value: meaning for quantity, meaning in MEANINGS.items()}),
            ),
            lambda row: row.quantity.value,
        ),
        (Variable("group", "The reason, the condition or the stage that it is counted by."), lambda row: row.group),
        (Variable("count", "How many.", ColumnKind.WHOLE), lambda row: row.count),
    )
    return Table(
        "flow",
        "One row for every count of the participant flow.",
        ("quantity", "group"),
        counted,
        _rows,
    )


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
        return {(score.questionnaire, score.scale): score for score in scores_table(self.kept)}


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


def consent_columns(study: StudyMaterials, taken: set[str]) -> Iterator[Column[Person]]:
    """One column for every purpose of the consent."""
    for name, wordings in study.purposes.items():
        publishing = " Without it a session is not published." if name == PUBLISHING else ""
        texts = dict.fromkeys(_quoted(purpose.text) for purpose in wordings)
        yield Column(
            Variable(
                _free(f"agreed_{name}", "consent", taken),
                f"Whether the visitor agreed to this: {', in other versions '.join(texts)}.{publishing}",
                ColumnKind.TRUTH,
                empty="no consent was asked for on the screen",
            ),
            partial(_agreed_to, name),
        )


def _agreed_to(purpose: str, row: Person) -> Cell:
    return None if row.state.consent is None else purpose in row.state.consent.purposes


def about_you_columns(
    study: StudyMaterials, extras: frozenset[ExportOption], taken: set[str]
) -> Iterator[Column[Person]]:
    """One column for every item about the visitor; what was typed only if it is asked for."""
    for columns in _about_you_columns(study, extras, taken).values():
        yield from columns


def _about_you_columns(
    study: StudyMaterials, extras: frozenset[ExportOption], taken: set[str]
) -> dict[str, tuple[Column[Person], ...]]:
    """Return the columns of each item: its answer, and why it is empty where that can be told."""
    columns: dict[str, tuple[Column[Person], ...]] = {}
    for item, asked_as in exported_items(study.about_you, extras).items():
        name = _free(item, "about_you", taken)
        bands = study.age_bands if is_banded(item, study, extras) else None
        answer = partial(_answer_about_you, item, bands, with_texts=ExportOption.TEXTS in extras)
        columns[item] = (Column(item_variable(name, asked_as, study, extras), answer),)
        for mark in EMPTY_MARKS:
            if mark.can_be(asked_as):
                other = _free(f"{name}_{mark.name}", "about_you", taken)
                columns[item] += (Column(mark.variable(other, name), partial(_is_marked, mark, item)),)
    return columns


def can_be_not_applicable(asked_as: Asked) -> bool:
    """Whether a visitor could say of an item, in any of its forms, that it does not apply."""
    return any(isinstance(item, Question) and item.not_applicable for _, item in asked_as)


def can_be_hidden(asked_as: Asked) -> bool:
    """Whether an item, in any of its forms, has a condition to show it."""
    return any(item.relevant for _, item in asked_as)


@dataclass(frozen=True)
class EmptyMark:
    """A column beside an item's answer that tells one reason for an empty answer from all others."""

    name: str
    can_be: Callable[[Asked], bool]
    """Whether the reason can be there for an item, in any of its forms."""
    holds: Callable[[ItemResponse], bool]
    meaning: str

    def variable(self, name: str, of: str) -> Variable:
        """Return the column, called ``name``, of the item whose column is ``of``."""
        meaning = f"{self.meaning.format(of=of)}; {of} is then empty."
        return Variable(name, meaning, ColumnKind.TRUTH, empty=f"{of} was not asked")


EMPTY_MARKS = (
    EmptyMark(
        NOT_APPLICABLE.name,
        can_be_not_applicable,
        lambda response: response.does_not_apply,
        "Whether the visitor said that {of} does not apply",
    ),
    EmptyMark(
        NOT_SHOWN.name,
        can_be_hidden,
        lambda response: response.hidden,
        "Whether the condition of {of} did not hold in the end",
    ),
)


def is_banded(item: str, study: StudyMaterials, extras: frozenset[ExportOption]) -> bool:
    """Whether an item asks for an age that is exported in bands."""
    return ExportOption.AGES not in extras and item in study.age_bands.items


def _is_marked(mark: EmptyMark, item: str, row: Person) -> Cell:
    return mark.holds(row.about_you[item]) if item in row.about_you else None


def exported_items(items: Mapping[str, Asked], extras: frozenset[ExportOption]) -> dict[str, Asked]:
    """Return the items whose answers are exported.

    Those are all that are answered, but for typed ones that were not asked for.
    """
    untold = (TextPage,) if ExportOption.TEXTS in extras else (TextPage, ShortText)
    told = {
        name: tuple(each for each in asked_as if not isinstance(each[1], untold)) for name, asked_as in items.items()
    }
    return {name: asked_as for name, asked_as in told.items() if asked_as}


def _answer_about_you(item: str, bands: AgeBands | None, row: Person, *, with_texts: bool) -> Cell:
    # What is chosen in one version of an item may be typed in another.
    typed = any(
        each.id == item and isinstance(each, ShortText) for of in session_about_you(row.kept) for each in of.items
    )
    if item not in row.about_you or (typed and not with_texts):
        return None
    value = row.about_you[item].value
    return bands.applied(item, value, row.kept) if bands else value


def item_variable(name: str, asked_as: Asked, study: StudyMaterials, extras: frozenset[ExportOption]) -> Variable:
    """Return an item's column: what was asked, and what could be answered, in each version of its questionnaire."""
    items, language = [item for _, item in asked_as], study.language
    newest = items[0]
    formats = [item.answer_format for item in items]
    choices = [each for each in formats if each.options]
    numbers = [each.ends for each in formats if each.ends is not None]
    kind = ColumnKind.TEXT
    levels: dict[str, Level] = {}
    least: int | None = None
    most: int | None = None
    if len(choices) == len(items):
        kind = ColumnKind.NAMES if any(each.several for each in choices) else ColumnKind.TEXT
        for each in choices:
            for option in each.options:
                levels.setdefault(option.id, Level(option.id, in_language(option.text, language)))
    elif len(numbers) == len(items):
        kind, least, most = ColumnKind.WHOLE, min(low for low, _ in numbers), max(high for _, high in numbers)
    banded = ""
    if is_banded(newest.id, study, extras) and not choices:
        kind, least, most = ColumnKind.TEXT, None, None
        banded = f" In bands of {study.age_bands.years} years, such as 20 to {19 + study.age_bands.years}."
    question = _quoted(in_language(newest.text, language))
    return Variable(
        name,
        f"The answer to {question}.{banded}{_item_called(name, newest)}{_versions(asked_as, study)}",
        kind,
        levels=tuple(levels.values()),
        empty="nothing was answered"
        + (", or it does not apply" if can_be_not_applicable(asked_as) else "")
        + (", or its condition did not hold" if can_be_hidden(asked_as) else ""),
        least=least,
        most=most,
    )


def _item_called(name: str, item: Item) -> str:
    """Which item it is, where the column could not have its name."""
    return "" if name == item.id else f" The item is called {item.id}."


def _versions(asked_as: Asked, study: StudyMaterials) -> str:
    """How an item was asked in each version, if it was not the same in all."""
    versions: dict[str, list[str]] = {}
    for form, item in asked_as:
        versions.setdefault(facts(item, study.language), []).append(form.name)
    without = [form.name for form in study.without(asked_as)]
    told = [f"{' and '.join(names)}: {what}" for what, names in versions.items()] if len(versions) > 1 else []
    told += [f"{' and '.join(without)}: not asked"] if without else []
    return f" Not the same in all versions. {'; '.join(told)}." if told else ""


def scale_columns(study: StudyMaterials, taken: set[str]) -> Iterator[Column[Person]]:
    """Yield the sum and the mean of every scale."""
    for scale in study.scales:
        name = _free(scale.name, scale.questionnaire, taken, "_sum", "_mean")
        ends = [(items[0].ends, len(items)) for _, items in scale.forms]
        of = f"of the scale {scale.name} of {scale.questionnaire}, {_size(scale)}, reversed ones turned round."
        of += _not_alike(scale)
        key = scale.questionnaire, scale.name
        yield Column(
            Variable(
                f"{name}_sum",
                f"The sum {of}",
                ColumnKind.WHOLE,
                empty="not all of them were answered, or some did not apply",
                least=min(least * items for (least, _), items in ends),
                most=max(most * items for (_, most), items in ends),
            ),
            partial(_sum, key),
        )
        yield Column(
            Variable(
                f"{name}_mean",
                f"The mean {of} Only those that were answered count, and they must be at least {_needed(scale)}.",
                ColumnKind.NUMBER,
                empty="too few of them were answered",
                least=min(least for (least, _), _ in ends),
                most=max(most for (_, most), _ in ends),
            ),
            partial(_mean, key),
        )


def _size(scale: Scale) -> str:
    numbers = dict.fromkeys(len(items) for _, items in scale.forms)
    return f"{' or '.join(map(str, numbers))} items"


def _needed(scale: Scale) -> str:
    numbers = dict.fromkeys(form.questionnaire.needed(scale.name) for form, _ in scale.forms)
    return " or ".join(map(str, numbers))


def _not_alike(scale: Scale) -> str:
    """Return what the scale is the sum of in each version, if it is not the same in all."""
    if not scale.changed:
        return ""
    told = "; ".join(f"{form.name}: {', '.join(_summand(item) for item in items)}" for form, items in scale.forms)
    return f" Not the same in all versions, so not to be compared between them. {told}."


def _summand(item: Rating) -> str:
    least, most = item.ends
    return f"{item.id} ({least} to {most}{', reversed' if item.reverse else ''})"


def _sum(scale: tuple[str, str], row: Person) -> Cell:
    return row.scores[scale].total if scale in row.scores else None


def _mean(scale: tuple[str, str], row: Person) -> Cell:
    return row.scores[scale].mean if scale in row.scores else None


def _free(name: str, prefix: str, taken: set[str], *endings: str) -> str:
    """Return the name, with a prefix where another column is called so for any program.

    ``taken`` is folded.
    """
    wanted = {fold_name(name + ending) for ending in endings or ("",)}
    if wanted & taken:
        return _free(f"{prefix}_{name}", prefix, taken, *endings)
    taken |= wanted
    return name


def _quoted(text: str) -> str:
    return f'"{text.strip()}"'


def participants_table(
    study: StudyMaterials, extras: frozenset[ExportOption], elsewhere: frozenset[str]
) -> Table[SessionRecord, Person]:
    """Return the table of participants for a study.

    ``elsewhere`` are the columns of other tables, whose names are taken.
    """
    before, after = _own(study, extras)
    taken = _taken((*before, *after), elsewhere)
    declared = (*consent_columns(study, taken), *about_you_columns(study, extras, taken), *scale_columns(study, taken))
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
    columns_of = _about_you_columns(study, extras, taken)
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
        lambda row: hashlib.sha256(row.kept.row["slots"].encode()).hexdigest() if row.slot else None,
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
