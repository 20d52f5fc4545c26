"""The columns of participants that a study declares: what was agreed to, what was asked about them, and the scales."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import partial

from kiosk.store.dataset.column import Cell, Column, Kind, Level, Variable
from kiosk.store.dataset.extras import Extra
from kiosk.store.dataset.stored.followed import Followed
from kiosk.store.dataset.tables.person import Person
from kiosk.study.declared.information import PUBLISHING
from kiosk.study.declared.questionnaire import Integer, Item, Multiple, Rating, ShortText, Single, TextPage
from kiosk.study.declared.words import in_language


def agreed(study: Followed, taken: set[str]) -> Iterator[Column[Person]]:
    """One column for every purpose of the consent."""
    for purpose in study.purposes.values():
        publishing = " Without it a sitting is not published." if purpose.id == PUBLISHING else ""
        yield Column(
            Variable(
                _free(f"agreed_{purpose.id}", "consent", taken),
                f"Whether the visitor agreed to this: {_quoted(purpose.text)}.{publishing}",
                Kind.TRUTH,
                empty="no consent was asked for on the screen",
            ),
            partial(_agreed_to, purpose.id),
        )


def _agreed_to(purpose: str, row: Person) -> Cell:
    return None if row.kept.consent is None else purpose in row.kept.consent.purposes


def about_you(study: Followed, extras: frozenset[Extra], taken: set[str]) -> Iterator[Column[Person]]:
    """One column for every item about the visitor; what was typed only if it is asked for."""
    for item in told_items(study.about_you.values(), extras):
        name = _free(item.id, "about_you", taken)
        yield Column(item_variable(name, item, study.language), partial(_answer_about_you, item.id))


def told_items(items: Iterable[Item], extras: frozenset[Extra]) -> list[Item]:
    """The items whose answers are told: all that are answered, but for typed ones that nobody asked for."""
    untold = (TextPage,) if Extra.TEXTS in extras else (TextPage, ShortText)
    return [item for item in items if not isinstance(item, untold)]


def _answer_about_you(item: str, row: Person) -> Cell:
    return row.about_you[item].value if item in row.about_you else None


def item_variable(name: str, item: Item, language: str) -> Variable:
    """An item's column: what was asked, and what could be answered."""
    kind = Kind.TEXT
    levels: tuple[Level, ...] = ()
    least: int | None = None
    most: int | None = None
    match item:
        case Single():
            levels = tuple(Level(option.id, in_language(option.text, language)) for option in item.options)
        case Multiple():
            kind = Kind.NAMES
            levels = tuple(Level(option.id, in_language(option.text, language)) for option in item.options)
        case Integer():
            kind, (least, most) = Kind.WHOLE, (item.lowest, item.highest)
        case _ if isinstance(item, Rating):
            kind, (least, most) = Kind.WHOLE, item.ends
    return Variable(
        name,
        f"The answer to {_quoted(in_language(item.text, language))}.",
        kind,
        levels=levels,
        empty="nothing was answered",
        least=least,
        most=most,
    )


def scales(study: Followed, taken: set[str]) -> Iterator[Column[Person]]:
    """The sum and the mean of every scale."""
    for questionnaire, scale, items in study.scales:
        name = _free(scale, questionnaire.id, taken, "_sum", "_mean")
        least, most = items[0].ends
        of = f"of the scale {scale} of {questionnaire.id}, {len(items)} items, reversed ones turned round."
        empty = "not all of them were answered"
        yield Column(
            Variable(
                f"{name}_sum",
                f"The sum {of}",
                Kind.WHOLE,
                empty=empty,
                least=least * len(items),
                most=most * len(items),
            ),
            partial(_sum, (questionnaire.id, scale)),
        )
        yield Column(
            Variable(
                f"{name}_mean",
                f"The mean {of} Only those that were answered count.",
                Kind.NUMBER,
                empty="none of them was answered",
                least=least,
                most=most,
            ),
            partial(_mean, (questionnaire.id, scale)),
        )


def _sum(scale: tuple[str, str], row: Person) -> Cell:
    return row.scores[scale].total if scale in row.scores else None


def _mean(scale: tuple[str, str], row: Person) -> Cell:
    return row.scores[scale].mean if scale in row.scores else None


def _free(name: str, prefix: str, taken: set[str], *endings: str) -> str:
    """The name, or, where another column is called so, the name with a prefix."""
    wanted = {name + ending for ending in endings or ("",)}
    if wanted & taken:
        return _free(f"{prefix}_{name}", prefix, taken, *endings)
    taken |= wanted
    return name


def _quoted(text: str) -> str:
    return f'"{text.strip()}"'
