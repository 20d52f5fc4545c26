"""Compare two studies: what differs, and whether it can change the data."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from enum import Enum
from itertools import zip_longest
from typing import Any

from pydantic import BaseModel

from kiosk.assistance.wording import Catalogue
from kiosk.experiment.information import Information
from kiosk.experiment.items import Choice
from kiosk.experiment.questionnaire import Item, Questionnaire, facts
from kiosk.experiment.session_config import Source, StudyConfig
from kiosk.study.package import LOCAL_KEYS


class Impact(Enum):
    """What a difference does to the data."""

    DATA = "changes the data"
    """Columns, values or their meaning are not the same."""
    BEHAVIOUR = "can change answers"
    """Columns and values are the same, but visitors see, hear or meet something else."""
    NONE = "does not change the data"


@dataclass(frozen=True)
class Difference:
    """One thing in which two studies differ, and what it does to the data, in words."""

    where: str
    what: str
    impact: Impact
    effect: str


_NONE = (
    *("title", "experimenter", "shortcuts", "markers"),
    *(f"{section}.{key}" for section, keys in LOCAL_KEYS.items() for key in keys),
)
_DATA = (
    *("languages", "stages", "game.rows", "game.columns", "assistance.condition", "assistance.policy"),
    *("assistance.target_rule", "assistance.step", "assistance.memory_model", "assistance.timing"),
    *("assistance.threshold", "assistance.explore", "conditions", "randomisation", "consent.adult"),
    "consent.on_withdrawal",
)
"""The beginnings of keys; every other key is something that visitors see, hear or wait for."""

_EFFECTS = {
    "title": "only the data set's title is another one",
    "languages": "the column 'language' has other values",
    "stages": "stages and what they record are added, left out or in another order",
    "game.rows": "games are of another size: scores, flips and times cannot be compared",
    "game.columns": "games are of another size: scores, flips and times cannot be compared",
    "randomisation": "participants are assigned to conditions in another way",
    "conditions": "a condition of one name stands for another treatment",
    "assistance.wording": "the helper gives its hints in other words",
    "assistance": "help is chosen in another way",
    "consent.adult": "other people may take part",
    "consent.on_withdrawal": "sessions that visitors stop are kept or deleted in another way",
}
_NAMED = (
    "questionnaires",
    "about_you",
    "consent.text",
    "game.deck",
    "practice.deck",
    "assistance.policy",
    "look.logo",
    "assistance.wording",
)
"""Keys that name something: what is in it is compared, and not how it is called."""

_SHOWN = 60


def compare(one: StudyConfig, other: StudyConfig) -> list[Difference]:
    """Return every difference between two studies, those that change the data first."""
    found = [
        *_settings(one, other),
        *_questionnaires(one, other),
        *_languages(one, other),
        *_decks(one, other),
        *_policies(one, other),
        *_materials(one, other),
    ]
    order = list(Impact)
    return sorted(found, key=lambda difference: order.index(difference.impact))


def _settings(one: StudyConfig, other: StudyConfig) -> Iterator[Difference]:
    both = [dict(_flat(study.settings.model_dump(mode="json"))) for study in (one, other)]
    for key in dict.fromkeys((*both[0], *both[1])):
        before, after = (each.get(key) for each in both)
        if before == after or key in _NAMED or key.endswith(".policy"):
            continue
        what = f"{_short(before)} becomes {_short(after)}"
        yield Difference(key, what, *_effect(key))


def _flat(told: Mapping[str, Any], before: str = "") -> Iterator[tuple[str, Any]]:
    """Yield every key with its whole path; a list is one value."""
    for key, value in told.items():
        if isinstance(value, dict) and value:
            yield from _flat(value, f"{before}{key}.")
        else:
            yield f"{before}{key}", value


def _effect(key: str) -> tuple[Impact, str]:
    said = next((effect for name, effect in _EFFECTS.items() if _begins(key, name)), "")
    if any(_begins(key, name) for name in _NONE):
        return Impact.NONE, said or "it belongs to the place, not to the study"
    if any(_begins(key, name) for name in _DATA):
        return Impact.DATA, said
    return Impact.BEHAVIOUR, said or "visitors see, hear or wait for something else"


def _begins(key: str, name: str) -> bool:
    return key == name or key.startswith(f"{name}.")


def _short(value: object) -> str:
    words = "nothing" if value is None else json.dumps(value, ensure_ascii=False)
    return words if len(words) <= _SHOWN else f"{words[:_SHOWN]}..."


def _questionnaires(one: StudyConfig, other: StudyConfig) -> Iterator[Difference]:
    both = [{each.id: each for each in _asked(study)} for study in (one, other)]
    for name in dict.fromkeys((*both[0], *both[1])):
        before, after = (each.get(name) for each in both)
        if before is None or after is None:
            words = ("is new", "its columns are added") if before is None else ("is gone", "its columns stay empty")
            yield Difference(f"questionnaire {name}", words[0], Impact.DATA, words[1])
        else:
            yield from _questionnaire(before, after, (*one.languages, *other.languages))
    shared = [[name for name in each if name in both[0] and name in both[1]] for each in both]
    if shared[0] != shared[1]:
        what = f"{', '.join(shared[0])} become {', '.join(shared[1])}"
        yield Difference("questionnaires", what, Impact.BEHAVIOUR, "they are asked in another order")


def _asked(study: StudyConfig) -> tuple[Questionnaire, ...]:
    return (study.plans[0].about_you, *study.plans[0].questionnaires)


def _questionnaire(before: Questionnaire, after: Questionnaire, languages: Iterable[str]) -> Iterator[Difference]:
    where = f"questionnaire {before.id}"
    both = [{item.id: item for item in each.items} for each in (before, after)]
    found = [*_titles(where, before.title or {}, after.title or {}, dict.fromkeys(languages))]
    for name in dict.fromkeys((*both[0], *both[1])):
        old, new = (each.get(name) for each in both)
        found += _item(f"{where}, item {name}", old, new, tuple(dict.fromkeys(languages)))
    kept = [[name for name in each if name in both[0] and name in both[1]] for each in both]
    if kept[0] != kept[1]:
        found.append(Difference(where, "its items stand in another order", Impact.BEHAVIOUR, "order can matter"))
    for key in ("per_page", "order"):
        values = [each.model_dump(mode="json")[key] for each in (before, after)]
        if values[0] != values[1]:
            what = f"{key}: {values[0]} becomes {values[1]}"
            found.append(Difference(where, what, Impact.BEHAVIOUR, "items are shown in another way"))
    yield from found
    if found and before.version == after.version:
        what = f"the version stays {before.version!r}"
        yield Difference(where, what, Impact.NONE, "give the changed questionnaire another version")


def _titles(
    where: str, old: Mapping[str, str], new: Mapping[str, str], languages: Iterable[str]
) -> Iterator[Difference]:
    for language in languages:
        words = old.get(language), new.get(language)
        # A language that only one of two titles has is a translation.
        if words[0] != words[1] and (None not in words or not old or not new):
            what = f"title, {language}: {_short(words[0])} becomes {_short(words[1])}"
            yield Difference(where, what, Impact.BEHAVIOUR, "another wording can change answers")


def _item(where: str, old: Item | None, new: Item | None, languages: tuple[str, ...]) -> Iterator[Difference]:
    if old is None:
        yield Difference(where, "is new", Impact.DATA, "a column is added, empty for earlier sessions")
    elif new is None:
        yield Difference(where, "is gone", Impact.DATA, "its column is empty for later sessions")
    else:
        yield from _answers(where, old, new)
        yield from _wording(where, old, new, languages)


def _answers(where: str, old: Item, new: Item) -> Iterator[Difference]:
    """Yield the differences in what can be answered, and in how it counts."""
    if isinstance(old, Choice) and isinstance(new, Choice) and old.kind == new.kind:
        yield from _options(where, old, new)
    elif facts(old, "") != facts(new, "") or old.kind != new.kind:
        what = f"{old.kind}, {facts(old, '')}, becomes {new.kind}, {facts(new, '')}"
        yield Difference(where, what, Impact.DATA, "values mean something else; do not pool them")
    for key in sorted(type(old).model_fields.keys() & type(new).model_fields.keys() - {"id", "kind", "options"}):
        before, after = getattr(old, key), getattr(new, key)
        if before == after or isinstance(before, Mapping) or key in _IN_FACTS:
            continue
        impact, effect = _FIELDS.get(key, (Impact.BEHAVIOUR, "it is shown in another way"))
        yield Difference(where, f"{key}: {_plain(before)} becomes {_plain(after)}", impact, effect)


_IN_FACTS = frozenset(("points", "reverse", "lowest", "highest"))
_FIELDS = {
    "scale": (Impact.DATA, "the score of the scale is a sum of other items"),
    "required": (Impact.BEHAVIOUR, "more or fewer answers are missing"),
    "relevant": (Impact.DATA, "other visitors are asked, so other answers are missing"),
    "longest": (Impact.DATA, "texts are cut at another length"),
}


def _plain(value: object) -> str:
    return _short(value.model_dump(mode="json") if isinstance(value, BaseModel) else value)


def _options(where: str, old: Choice, new: Choice) -> Iterator[Difference]:
    gone = [each for each in old.ids if each not in new.ids]
    added = [each for each in new.ids if each not in old.ids]
    if gone:
        effect = "earlier answers have values that later ones cannot have"
        yield Difference(where, f"the options {', '.join(gone)} are gone", Impact.DATA, effect)
    if added:
        effect = "later answers have values that earlier ones could not have"
        yield Difference(where, f"the options {', '.join(added)} are new", Impact.DATA, effect)
    kept = [[each for each in ids if each in old.ids and each in new.ids] for ids in (old.ids, new.ids)]
    if kept[0] != kept[1]:
        yield Difference(where, "its options stand in another order", Impact.BEHAVIOUR, "order can matter")


def _wording(where: str, old: Item, new: Item, languages: tuple[str, ...]) -> Iterator[Difference]:
    texts = [[*item.texts()] for item in (old, new)]
    for language in languages:
        for before, after in zip_longest(*texts, fillvalue={}):
            words = before.get(language), after.get(language)
            if words[0] is not None and words[1] is not None and words[0] != words[1]:
                what = f"{language}: {_short(words[0])} becomes {_short(words[1])}"
                yield Difference(where, what, Impact.BEHAVIOUR, "another wording can change answers")


def _languages(one: StudyConfig, other: StudyConfig) -> Iterator[Difference]:
    for language in (each for each in one.languages if each in other.languages):
        before, after = one.plan(language), other.plan(language)
        both = [_messages(plan.catalogue) for plan in (before, after)]
        changed = sorted(name for name in {*both[0], *both[1]} if both[0].get(name) != both[1].get(name))
        if changed:
            named = ", ".join(changed[:5]) + (f" and {len(changed) - 5} more" if len(changed) > 5 else "")  # noqa: PLR2004
            what = f"{len(changed)} of its sentences differ: {named}"
            yield Difference(f"language {language}", what, Impact.BEHAVIOUR, "visitors read or hear other sentences")
        yield from _sheets(language, before.information, after.information)


def _messages(catalogue: Catalogue) -> dict[str, str]:
    """Return the text of every message as it is written, comments left out."""
    return {name: written.text for name, written in catalogue.written.items()}


def _sheets(language: str, before: Information, after: Information) -> Iterator[Difference]:
    where = f"information sheet {language}"
    purposes = [{each.id: each.required for each in sheet.consent.purposes} for sheet in (before, after)]
    if purposes[0] != purposes[1]:
        what = f"purposes: {_short(purposes[0])} become {_short(purposes[1])}"
        yield Difference(where, what, Impact.DATA, "visitors agree to something else")
    pages = [sheet.model_dump(mode="json") for sheet in (before, after)]
    changed = [key for key in ("about", "consent", "debrief") if pages[0][key] != pages[1][key]]
    if changed:
        what = f"the text of {', '.join(changed)} differs"
        yield Difference(where, what, Impact.BEHAVIOUR, "visitors read another text; an ethics board approves texts")
    if before.version != after.version:
        what = f"version {before.version} becomes {after.version}"
        yield Difference(where, what, Impact.DATA, "the column 'consent_version' has another value")


def _decks(one: StudyConfig, other: StudyConfig) -> Iterator[Difference]:
    for where, impact in (("deck", Impact.DATA), ("practice_deck", Impact.BEHAVIOUR)):
        before, after = (set(getattr(study.plans[0], where)) for study in (one, other))
        parts = [f"{words} {', '.join(sorted(cards))}" for words, cards in (("without", before - after),) if cards]
        parts += [f"with {', '.join(sorted(after - before))}"] if after - before else []
        if parts:
            yield Difference(where.replace("_", " "), "; ".join(parts), impact, "visitors meet other cards")


def _policies(one: StudyConfig, other: StudyConfig) -> Iterator[Difference]:
    names = dict.fromkeys((*one.settings.all_conditions, *other.settings.all_conditions))
    both = [{n: (s.plans[0].policies.get(n) or s.plans[0].policy).sha256 for n in names} for s in (one, other)]
    changed = [name for name in names if both[0][name] != both[1][name]]
    if changed:
        where = "policy" if len(changed) == len(names) else f"policy of {', '.join(changed)}"
        yield Difference(where, "the table is another one", Impact.DATA, "help is chosen in another way")


def _materials(one: StudyConfig, other: StudyConfig) -> Iterator[Difference]:
    """Yield what only the hashes tell: pictures and fonts, and what came with another version of Recollect."""
    both = [{source.key: source for source in study.sources if source.pictures} for study in (one, other)]
    for key in (key for key in both[0] if key in both[1]):
        before, after = both[0][key], both[1][key]
        if before.sha256 != after.sha256 and _names(before) == _names(after):
            yield Difference(key, "its files differ", Impact.BEHAVIOUR, "visitors see other pictures")
    shipped = [study.settings.package.shipped if study.settings.package else None for study in (one, other)]
    if shipped[0] is not None and shipped[1] is not None:
        for key in sorted({*shipped[0], *shipped[1]}):
            if shipped[0].get(key) != shipped[1].get(key):
                what = "it came with different versions of Recollect"
                yield Difference(key, what, Impact.BEHAVIOUR, "the sites did not use the same text, table or pictures")


def _names(source: Source) -> set[str]:
    return {file.name for file in source.pictures}
