"""The columns of participants that a study declares: what was agreed to, what was asked about them, and the scales."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial

from kiosk.store.dataset.column import Cell, Column, Kind, Level, Variable
from kiosk.store.dataset.extras import Extra
from kiosk.store.dataset.stored.followed import Asked, Followed, Scale
from kiosk.store.dataset.tables.asked import asked
from kiosk.store.dataset.tables.person import Person
from kiosk.study.declared.differences import facts
from kiosk.study.declared.information import PUBLISHING
from kiosk.study.declared.labels import fold_name
from kiosk.study.declared.questionnaire import Integer, Item, Multiple, Rating, ShortText, Single, TextPage
from kiosk.study.declared.words import in_language


def agreed(study: Followed, taken: set[str]) -> Iterator[Column[Person]]:
    """One column for every purpose of the consent."""
    for name, wordings in study.purposes.items():
        publishing = " Without it a sitting is not published." if name == PUBLISHING else ""
        texts = dict.fromkeys(_quoted(purpose.text) for purpose in wordings)
        yield Column(
            Variable(
                _free(f"agreed_{name}", "consent", taken),
                f"Whether the visitor agreed to this: {', in other versions '.join(texts)}.{publishing}",
                Kind.TRUTH,
                empty="no consent was asked for on the screen",
            ),
            partial(_agreed_to, name),
        )


def _agreed_to(purpose: str, row: Person) -> Cell:
    return None if row.kept.consent is None else purpose in row.kept.consent.purposes


def about_you(study: Followed, extras: frozenset[Extra], taken: set[str]) -> Iterator[Column[Person]]:
    """One column for every item about the visitor; what was typed only if it is asked for."""
    for item, asked_as in told_items(study.about_you, extras).items():
        name = _free(item, "about_you", taken)
        answer = partial(_answer_about_you, item, with_texts=Extra.TEXTS in extras)
        yield Column(item_variable(name, asked_as, study), answer)


def told_items(items: Mapping[str, Asked], extras: frozenset[Extra]) -> dict[str, Asked]:
    """The items whose answers are told: all that are answered, but for typed ones that nobody asked for."""
    untold = (TextPage,) if Extra.TEXTS in extras else (TextPage, ShortText)
    told = {
        name: tuple(each for each in asked_as if not isinstance(each[1], untold)) for name, asked_as in items.items()
    }
    return {name: asked_as for name, asked_as in told.items() if asked_as}


def _answer_about_you(item: str, row: Person, *, with_texts: bool) -> Cell:
    # What is chosen in one version of an item may be typed in another.
    typed = any(each.id == item and isinstance(each, ShortText) for of in asked(row.kept)[:1] for each in of.items)
    return row.about_you[item].value if item in row.about_you and (with_texts or not typed) else None


def item_variable(name: str, asked_as: Asked, study: Followed) -> Variable:
    """An item's column: what was asked, and what could be answered, in each version of its questionnaire."""
    items, language = [item for _, item in asked_as], study.language
    newest = items[0]
    choices = [item for item in items if isinstance(item, Single | Multiple)]
    numbers = [_ends(item) for item in items if isinstance(item, Integer | Rating)]
    kind = Kind.TEXT
    levels: dict[str, Level] = {}
    least: int | None = None
    most: int | None = None
    if len(choices) == len(items):
        kind = Kind.NAMES if any(isinstance(item, Multiple) for item in choices) else Kind.TEXT
        for item in choices:
            for option in item.options:
                levels.setdefault(option.id, Level(option.id, in_language(option.text, language)))
    elif len(numbers) == len(items):
        kind, least, most = Kind.WHOLE, min(low for low, _ in numbers), max(high for _, high in numbers)
    question = _quoted(in_language(newest.text, language))
    return Variable(
        name,
        f"The answer to {question}.{_item_called(name, newest)}{_versions(asked_as, study)}",
        kind,
        levels=tuple(levels.values()),
        empty="nothing was answered",
        least=least,
        most=most,
    )


def _ends(item: Integer | Rating) -> tuple[int, int]:
    return (item.lowest, item.highest) if isinstance(item, Integer) else item.ends


def _item_called(name: str, item: Item) -> str:
    """Which item it is, where the column could not have its name."""
    return "" if name == item.id else f" The item is called {item.id}."


def _versions(asked_as: Asked, study: Followed) -> str:
    """How an item was asked in each version, if it was not the same in all."""
    versions: dict[str, list[str]] = {}
    for form, item in asked_as:
        versions.setdefault(facts(item, study.language), []).append(form.name)
    without = [form.name for form in study.without(asked_as)]
    told = [f"{' and '.join(names)}: {what}" for what, names in versions.items()] if len(versions) > 1 else []
    told += [f"{' and '.join(without)}: not asked"] if without else []
    return f" Not the same in all versions. {'; '.join(told)}." if told else ""


def scales(study: Followed, taken: set[str]) -> Iterator[Column[Person]]:
    """The sum and the mean of every scale."""
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
                Kind.WHOLE,
                empty="not all of them were answered",
                least=min(least * items for (least, _), items in ends),
                most=max(most * items for (_, most), items in ends),
            ),
            partial(_sum, key),
        )
        yield Column(
            Variable(
                f"{name}_mean",
                f"The mean {of} Only those that were answered count.",
                Kind.NUMBER,
                empty="none of them was answered",
                least=min(least for (least, _), _ in ends),
                most=max(most for (_, most), _ in ends),
            ),
            partial(_mean, key),
        )


def _size(scale: Scale) -> str:
    numbers = dict.fromkeys(len(items) for _, items in scale.forms)
    return f"{' or '.join(map(str, numbers))} items"


def _not_alike(scale: Scale) -> str:
    """What the scale is the sum of in each version, if it is not the same in all."""
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
    """The name, or, where another column is called so for any program, the name with a prefix; ``taken`` is folded."""
    wanted = {fold_name(name + ending) for ending in endings or ("",)}
    if wanted & taken:
        return _free(f"{prefix}_{name}", prefix, taken, *endings)
    taken |= wanted
    return name


def _quoted(text: str) -> str:
    return f'"{text.strip()}"'
