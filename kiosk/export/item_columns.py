"""The columns that a study declares itself: consent, questions about the visitor, and scales."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial

from kiosk.experiment.information import PUBLISHING
from kiosk.experiment.item_responses import ItemResponse
from kiosk.experiment.items import Question, Rating, ShortText, TextPage, in_language
from kiosk.experiment.labels import fold_name
from kiosk.experiment.questionnaire import Item, facts
from kiosk.export.columns import (
    Cell,
    Column,
    ColumnKind,
    ExportOption,
    Level,
    Variable,
)
from kiosk.export.person import Person
from kiosk.export.records import AgeBands, Asked, Scale, StudyMaterials
from kiosk.export.responses import NOT_APPLICABLE, NOT_SHOWN, session_about_you


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
) -> dict[str, tuple[Column[Person], ...]]:
    """Return the columns of each item about the visitor: the answer, and why it is empty.

    What was typed is there only if ``extras`` ask for it. ``taken`` are the folded names of other columns, and grows.
    """
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
