"""Names in questionnaires, decks and consent that a reader of the data would lose or misread."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from kiosk.experiment.items import Choice
from kiosk.experiment.labels import alike, fold_name, is_reserved, read_as
from kiosk.experiment.questionnaire import Item, Questionnaire

ONE_NAME = "are one name where capitals, - and _ do not count, as in file names and many statistics programs"


def unclear_names(asked: Sequence[tuple[Path, Questionnaire]]) -> Iterator[str]:
    """Yield a sentence for every name that a reader would lose or misread.

    Each names the files.
    """
    yield from _between("questionnaires", [(each.id, file) for file, each in asked])
    yield from _between("items", [(item.id, file) for file, each in asked for item in each.items])
    yield from _between("scales", [(scale, file) for file, each in asked for scale in each.scales])
    for file, each in asked:
        if is_reserved(each.id):
            yield f"the questionnaire {file}: id: Windows keeps the name {each.id!r} for a device; choose another"
        for item in each.items:
            yield from (f"the questionnaire {file}: {item.id}: {sentence}" for sentence in _of_options(item))


def unclear_cards(cards: Iterable[str]) -> Iterator[str]:
    """Yield the same for the cards of a deck."""
    for one, other in alike(cards):
        yield f"the cards {one!r} and {other!r} {ONE_NAME}"


def unclear_purposes(purposes: Iterable[str]) -> Iterator[str]:
    """Yield the same for the purposes of the consent."""
    for one, other in alike(purposes):
        yield f"the purposes {one!r} and {other!r} {ONE_NAME}"


def _between(what: str, named: Sequence[tuple[str, Path]]) -> Iterator[str]:
    """Names of one kind that are written in two ways; that the same one stands twice is said elsewhere."""
    first: dict[str, tuple[str, Path]] = {}
    for name, file in named:
        other, place = first.setdefault(fold_name(name), (name, file))
        if other != name:
            where = (
                f"the questionnaire {file}: the {what} {other!r} and {name!r}"
                if file == place
                else f"the {what} {other!r} in {place} and {name!r} in {file}"
            )
            yield f"{where} {ONE_NAME}"


def _of_options(item: Item) -> Iterator[str]:
    if not isinstance(item, Choice):
        return
    for one, other in alike(item.ids):
        yield f"the options {one!r} and {other!r} {ONE_NAME}"
    for option in item.ids:
        misread = read_as(option)
        if misread:
            yield f"the option {option!r} is taken for {misread} by programs that read tables; choose another id"
