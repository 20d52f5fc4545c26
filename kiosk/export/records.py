"""What the exported sessions followed, their boards, and which texts people typed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, TypeVar

from kiosk.config import Privacy
from kiosk.experiment.events import (
    AbortRequested,
    EmbodimentChanged,
    ResponseGiven,
    RobotDisconnected,
    SessionStarted,
    SpeechFailed,
    SpeechStarted,
)
from kiosk.experiment.information import Purpose
from kiosk.experiment.items import Answer, Choice, Rating, ShortText
from kiosk.experiment.questionnaire import Item, Questionnaire, differences, summed
from kiosk.experiment.session_config import SessionConfig
from kiosk.store.session_records import EventRecord, SessionRecord

_T = TypeVar("_T")

_SHORT = 8
"""Characters of a hash that tell two contents of one version apart."""


@dataclass(frozen=True)
class Form:
    """A questionnaire as some sessions had it; ``label`` is its version, with a hash if another form has it too."""

    questionnaire: Questionnaire
    label: str

    @property
    def name(self) -> str:
        """What it is called in a description."""
        return f"version {self.label} of {self.questionnaire.id}"


Asked = tuple[tuple[Form, Item], ...]
"""An item in each form that has it, the newest first."""


@dataclass(frozen=True)
class Scale:
    """A scale of a questionnaire in each of its forms that has it, the newest first."""

    questionnaire: str
    name: str
    forms: tuple[tuple[Form, tuple[Rating, ...]], ...]

    @property
    def changed(self) -> bool:
        """Whether its sum does not mean the same in all of them."""
        return len({(form.questionnaire.needed(self.name), summed(items)) for form, items in self.forms}) > 1


TELLS_THE_ORDER = frozenset({"allocation_slot", "allocation_block", "visitors_before", "started_at"})
"""The columns, and fields of events, that are left out where nothing may tell the order in which people came."""


@dataclass(frozen=True)
class AgeBands:
    """Ages in bands of so many years; ``items`` are the items that ask for an age."""

    years: int
    items: frozenset[str]

    def applied(self, item: str, value: Answer | None, kept: SessionRecord) -> Answer | None:
        """Return an answer as it is exported: the band of an age, and any other answer as it is.

        What was typed and is no whole number is left out, and an option is as it is: its bands are the study's.
        """
        if item not in self.items or value is None or isinstance(value, tuple):
            return value
        if isinstance(value, str):
            if any(isinstance(each, Choice) for each in items_called(item, kept)):
                return value
            if not value.strip().isdecimal():
                return None
            value = int(value.strip())
        lowest = value // self.years * self.years
        return f"{lowest} to {lowest + self.years - 1}"


@dataclass(frozen=True)
class StudyMaterials:
    """Everything that gives rise to columns; ``plans`` are those that can be read, the newest first.

    ``shuffled`` says that nothing may tell the order in which people came.
    """

    plans: tuple[SessionConfig, ...]
    shuffled: bool = False

    @property
    def age_bands(self) -> AgeBands:
        """The bands in which ages are exported: the widest that any session's settings asked for."""
        asked = [plan.settings.privacy for plan in self.plans] or [Privacy()]
        return AgeBands(
            max(each.age_bands for each in asked), frozenset(item for each in asked for item in each.age_items)
        )

    @property
    def lets_return(self) -> bool:
        """Whether visitors could come back as the same participant."""
        return any(plan.settings.returning.enabled for plan in self.plans)

    @property
    def asks_for_shuffled_ids(self) -> bool:
        """Whether the settings of any session ask for shuffled names."""
        return any(plan.settings.privacy.shuffled_ids for plan in self.plans)

    @property
    def title(self) -> str:
        """What the study is called now."""
        return self.plans[0].settings.title if self.plans else "A study with Recollect"

    @property
    def language(self) -> str:
        """The study's first language, in which things are described."""
        return self.plans[0].settings.language_codes[0] if self.plans else "en"

    @property
    def languages(self) -> tuple[str, ...]:
        """The languages that sessions were in, the study's first one first."""
        return tuple(sorted({plan.language for plan in self.plans}, key=lambda code: (code != self.language, code)))

    @property
    def purposes(self) -> dict[str, tuple[Purpose, ...]]:
        """What was asked for in consent, by name, in every wording of the first language that has it."""
        # A sheet is in one language; that of the study goes first.
        found: dict[str, tuple[Purpose, ...]] = {}
        for language in self.languages:
            sheets = [plan.information for plan in self.plans if plan.language == language]
            here = _all((purpose.id, purpose) for sheet in sheets for purpose in sheet.consent.purposes)
            found = here | found
        return found

    @cached_property
    def forms(self) -> dict[str, tuple[Form, ...]]:
        """The questionnaires by name, each in all its forms, the newest first."""
        asked = _all((each.id, each) for plan in self.plans for each in (plan.about_you, *plan.questionnaires))
        return {name: _labelled(_changed(contents)) for name, contents in asked.items()}

    def label(self, questionnaire: Questionnaire) -> str:
        """Return what the form of a questionnaire that a session had is called."""
        known, label = self._labels.get(id(questionnaire), (None, ""))
        if known is not questionnaire:
            forms = self.forms.get(questionnaire.id, ())
            same = (form.label for form in forms if _is_same(form.questionnaire, questionnaire))
            label = next(same, questionnaire.version)
            self._labels[id(questionnaire)] = questionnaire, label
        return label

    @cached_property
    def _labels(self) -> dict[int, tuple[Questionnaire, str]]:
        """The labels that were asked for, by the identity of a questionnaire, which sessions of one plan share."""
        return {}

    @property
    def about_you(self) -> dict[str, Asked]:
        """The items about the visitor, by name, each in all forms of the questionnaires that have it."""
        names = dict.fromkeys(plan.about_you.id for plan in self.plans)
        return _all((item.id, (form, item)) for name in names for form, item in self._items(name))

    def without(self, asked: Asked) -> tuple[Form, ...]:
        """Return the forms of the same questionnaires in which an item is not asked."""
        questionnaires = dict.fromkeys(form.questionnaire.id for form, _ in asked)
        having = [form for form, _ in asked]
        return tuple(form for name in questionnaires for form in self.forms[name] if form not in having)

    def items(self, questionnaire: str) -> dict[str, Asked]:
        """Return the items of a questionnaire, by name, each in all forms that have it.

        Those of the newest come first.
        """
        return _all((item.id, (form, item)) for form, item in self._items(questionnaire))

    def _items(self, questionnaire: str) -> Iterator[tuple[Form, Item]]:
        for form in self.forms[questionnaire]:
            for item in form.questionnaire.items:
                yield form, item

    @property
    def scales(self) -> Iterator[Scale]:
        """Every scale with its items."""
        for name, forms in self.forms.items():
            found = _all((scale, (form, items)) for form in forms for scale, items in form.questionnaire.scales.items())
            yield from (Scale(name, scale, of) for scale, of in found.items())

    @property
    def cautions(self) -> tuple[str, ...]:
        """A sentence for everything that was not the same for all, so that it is not compared unawares."""
        return (*self._changed_forms(), *self._changed_sheets())

    def _changed_forms(self) -> Iterator[str]:
        for name, (newest, *older) in self.forms.items():
            differ = dict.fromkeys(
                each for form in older for each in differences(newest.questionnaire, form.questionnaire)
            )
            if differ:
                labels = ", ".join(form.label for form in (newest, *older))
                yield (
                    f"the questionnaire {name!r} was asked in {1 + len(older)} versions ({labels}), which differ in "
                    f"{', '.join(differ)}; the descriptions of the columns say how, and questionnaire_versions says "
                    "who was asked which"
                )

    def _changed_sheets(self) -> Iterator[str]:
        contents = {(plan.language, plan.information.version): set[str]() for plan in self.plans}
        for plan in self.plans:
            contents[plan.language, plan.information.version].add(plan.information.sha256)
        for (language, version), hashes in contents.items():
            if len(hashes) > 1:
                yield (
                    f"the information sheet in {language!r} has {len(hashes)} contents under the version {version!r}, "
                    "so consent_version does not say which of them a visitor agreed to"
                )


def _all(named: Iterable[tuple[str, _T]]) -> dict[str, tuple[_T, ...]]:
    """Different things by their names, in their order."""
    found: dict[str, list[_T]] = {}
    for name, thing in named:
        things = found.setdefault(name, [])
        if thing not in things:
            things.append(thing)
    return {name: tuple(things) for name, things in found.items()}


def _changed(contents: Iterable[Questionnaire]) -> tuple[Questionnaire, ...]:
    """Those of them that differ in more than a translation."""
    kept: list[Questionnaire] = []
    for content in contents:
        if not any(_is_same(other, content) for other in kept):
            kept.append(content)
    return tuple(kept)


def _labelled(contents: tuple[Questionnaire, ...]) -> tuple[Form, ...]:
    versions = Counter(content.version for content in contents)

    def label(content: Questionnaire) -> str:
        alone = versions[content.version] == 1
        return content.version if alone else f"{content.version} ({content.sha256[:_SHORT]})"

    return tuple(Form(content, label(content)) for content in contents)


def _is_same(one: Questionnaire, other: Questionnaire) -> bool:
    """Whether two contents are one version, and differ in a translation at most."""
    return one is other or (one.version == other.version and not differences(one, other))


FREE: Mapping[str, frozenset[str]] = {
    AbortRequested.__name__: frozenset({"reason"}),
    SpeechStarted.__name__: frozenset({"device"}),
    SpeechFailed.__name__: frozenset({"why"}),
    RobotDisconnected.__name__: frozenset({"why"}),
    EmbodimentChanged.__name__: frozenset({"why"}),
}
"""The fields of each kind of event that may hold any text at all."""


def safe_fields(record: EventRecord, kept: SessionRecord) -> dict[str, Any]:
    """Return the fields of an event without any that may hold free text; of unknown events nothing is safe."""
    if record.event is None:
        return {}
    free = FREE.get(record.type, frozenset())
    if isinstance(record.event, ResponseGiven) and is_free_text(record.event, kept):
        free = frozenset({"value"})
    told = {name: value for name, value in record.fields.items() if name not in free}
    if isinstance(record.event, SessionStarted) and record.event.setup is not None:
        # What a driver says of its robot may hold an address.
        told["setup"] = {name: value for name, value in told["setup"].items() if name != "detail"}
    return told


def is_free_text(answer: ResponseGiven, kept: SessionRecord) -> bool:
    """Whether an answer was typed; where the questionnaires cannot be read, any text may have been."""
    if not isinstance(answer.value, str):
        return False
    if kept.plan is None:
        return True
    items = items_called(answer.item, kept)
    return not items or any(isinstance(item, ShortText) for item in items)


def items_called(name: str, kept: SessionRecord) -> list[Item]:
    """Return the items of a session's questionnaires that have this name; none if they cannot be read."""
    asked = (kept.plan.about_you, *kept.plan.questionnaires) if kept.plan else ()
    return [item for questionnaire in asked for item in questionnaire.items if item.id == name]
