"""What a study that can be run should still be told, and how long a visitor will sit there."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from kiosk.assistant.wording import CARD
from kiosk.game.board import CARDS_IN_A_PAIR
from kiosk.settings import Game, Practice
from kiosk.study.condition import Condition
from kiosk.study.declared.information import PUBLISHING
from kiosk.study.declared.questionnaire import Item, ShortText, TextPage
from kiosk.study.declared.words import in_language
from kiosk.study.plan import Plan, Study
from kiosk.units import MS_PER_MINUTE

SHIPPED_TEXT = "study"
"""The information sheets that come as an example."""

_WITHOUT = {
    "consent": "without the stage 'consent', nobody is asked before their sitting is stored",
    "age": "without the stage 'age', nobody is asked whether they are old enough",
    "debrief": "without the stage 'debrief', nobody sees the code with which to withdraw",
}

PAIR_MS = 15_000
"""For each pair of a game: the study's slower condition took 15 s."""
ANSWER_MS = 3000
TYPING_MS = 15_000
TAP_MS = 2000
"""Our own guesses: from having read an item to its answer, to a typed one, and from the end of a text to the tap."""


def cautions(study: Study) -> tuple[str, ...]:
    """A sentence for everything that can be run but may not be meant."""
    return (*_of_texts(study), *_of_names(study), *_of_cards(study))


def _of_texts(study: Study) -> Iterator[str]:
    settings = study.settings
    yield from (sentence for stage, sentence in _WITHOUT.items() if stage not in settings.stages)
    if settings.consent.text == SHIPPED_TEXT:
        yield "consent.text: the information sheets are the shipped example; an ethics board approves those of a study"
    purposes = {purpose.id for plan in study.plans for purpose in plan.information.consent.purposes}
    if "consent" in settings.stages and PUBLISHING not in purposes:
        yield f"consent.text: no purpose is named {PUBLISHING!r}, so nobody is left out of a data set for publishing"
    if Condition.NO_ASSISTANCE in _given(study):
        yield "in the condition 'no_assistance' nobody helps, but the introduction promises help to everybody"
    if not settings.consent.contact:
        yield "consent.contact is empty, so visitors are not told whom to write to"


def _given(study: Study) -> set[Condition]:
    """The conditions that visitors can get without a decision of the experimenter's."""
    return {plan.condition for plan in study.plans} | {
        Condition.named(name) for name in study.settings.allocation.quotas
    }


def _of_names(study: Study) -> Iterator[str]:
    """Names that mean something shipped, although something beside the study file has them too."""
    for source in study.sources:
        if source.unused is not None:
            yield (
                f"{source.key}: {source.name!r} is the shipped {source.path}, and {source.unused} is not used; "
                f"write {_as_path(source.unused)!r} to use it, or rename it"
            )


def _as_path(path: Path) -> str:
    """How a study file names what lies in its own folder."""
    return path.name if path.suffix else f"./{path.name}"


def _of_cards(study: Study) -> Iterator[str]:
    for plan in study.plans:
        boards: dict[str, tuple[str, ...]] = {plan.settings.practice.deck: plan.practice_deck}
        for deck, cards in (boards | {plan.settings.game.deck: plan.deck}).items():
            folder = plan.settings.find("cards", deck)
            unnamed = [name for name in cards if not plan.catalogue.names(name)]
            if unnamed:
                yield (
                    f"the deck {deck!r} has cards without a name in {plan.language!r}: {', '.join(unnamed)}; "
                    f"until they have one, their files' names are said. {_where_to_write(folder, unnamed, plan)}"
                )


def _where_to_write(folder: Path, unnamed: Sequence[str], plan: Plan) -> str:
    """Say what to write into which file, so that cards have names."""
    odd = [name for name in unnamed if not re.fullmatch(r"[A-Za-z0-9_-]+", name)]
    if odd:
        return f"First rename {odd[0]}.svg: such a name has letters, digits, - and _ only"
    file = folder / f"{plan.language}.ftl"
    return f"Write into {file}: {'; '.join(f'{CARD}-{name} = ...' for name in unnamed)}"


def minutes(plan: Plan) -> float:
    """About how long a visitor needs who reads and answers everything, in minutes."""
    return sum(_stage_times(plan).get(stage, TAP_MS) for stage in plan.settings.stages) / MS_PER_MINUTE


def _stage_times(plan: Plan) -> Mapping[str, float]:
    """What each stage takes in ms, as far as it can be known beforehand."""
    settings, pages = plan.settings, plan.information
    return {
        "about": _reading(plan, *pages.about.paragraphs),
        "consent": _reading(plan, *pages.consent.paragraphs, *(each.text for each in pages.consent.purposes)),
        "about_you": sum(_answering(plan, item) for item in plan.about_you.items),
        "introduction": settings.timing.reading * _INTRODUCTION + TAP_MS,
        "practice": min(settings.practice.longest, _playing(settings.practice)),
        "game": _playing(settings.game),
        "questions": sum(_answering(plan, item) for asked in plan.questionnaires for item in asked.items),
        "debrief": _reading(plan, *pages.debrief.paragraphs),
    }


_INTRODUCTION = 200
"""Characters that the assistant says to a visitor who comes."""


def _reading(plan: Plan, *texts: str) -> int:
    return sum(plan.settings.timing.reading * len(text) for text in texts) + TAP_MS


def _answering(plan: Plan, item: Item) -> int:
    answer = 0 if isinstance(item, TextPage) else TYPING_MS if isinstance(item, ShortText) else ANSWER_MS
    return plan.settings.timing.reading * len(in_language(item.text, plan.language)) + answer


def _playing(board: Game | Practice) -> int:
    return PAIR_MS * board.rows * board.columns // CARDS_IN_A_PAIR
