"""Every screen that a session of a study can show, with the effects that show it, for the preview."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from random import Random

from kiosk.config import Game, Practice
from kiosk.experiment import effects as do
from kiosk.experiment.effects import Effect
from kiosk.experiment.items import Response
from kiosk.experiment.outcomes import Stage
from kiosk.experiment.questionnaire import Item, Questionnaire
from kiosk.experiment.questionnaire_stage import item_pages, pages_alike
from kiosk.experiment.relevance import hidden_items
from kiosk.experiment.session_config import SessionConfig
from kiosk.game import CARDS_IN_A_PAIR

EXAMPLE_MOVES, EXAMPLE_MS, EXAMPLE_HINTS = 31, 185_000, 4
"""A result to look at."""


def screen_effects(plan: SessionConfig) -> dict[str, tuple[Effect, ...]]:
    """Return every screen of a session by its name, in their order, with the effects that show it."""
    screens: dict[str, tuple[Effect, ...]] = {"attract": ()}
    for stage in plan.settings.stages:
        screens |= dict(_of_stage(stage, plan))
    return screens | {"still there": (*screens["attract"], do.AskStillThere()), "pause": (do.ShowPause(),)}


def stage_of(screen: str) -> Stage | None:
    """Return the stage that a screen is of; None if it can come in any."""
    name = re.sub(r" \d+$", "", screen).replace(" ", "_")
    return next((stage for stage in Stage if stage.value == name), None)


def _of_stage(  # noqa: C901 - one case per stage
    stage: str, plan: SessionConfig
) -> Iterator[tuple[str, tuple[Effect, ...]]]:
    sheet, game, cell = plan.information, plan.settings.game, plan.cell
    pairs = _pairs(game)
    match stage:
        case "about":
            yield stage, (do.ShowAbout(sheet.about),)
        case "age":
            yield stage, (do.ShowAgeQuestion(plan.settings.consent.adult),)
        case "consent":
            yield stage, (do.ShowConsent(sheet.consent),)
        case "about_you":
            yield from ((name, (page.effect(),)) for name, page in _pages("about you", (plan.about_you,), rates=False))
        case "introduction":
            speech = "introduction-speech" if cell.helps else "introduction-speech-alone"
            said = plan.catalogue.wordings(speech, cards=CARDS_IN_A_PAIR * pairs, pairs=pairs)[0]
            yield stage, (do.ShowIntroduction(helped=cell.helps, points=cell.marks), do.Speak(1, said))
        case "practice":
            board = plan.settings.practice
            yield stage, (do.ShowBoard(board.rows, board.columns, _pairs(board), board.deck, practice=True),)
        case "game":
            yield stage, (do.ShowBoard(game.rows, game.columns, pairs, game.deck), do.UnlockBoard())
        case "result":
            yield stage, (do.ShowResult(pairs, EXAMPLE_MOVES, EXAMPLE_MS, EXAMPLE_HINTS),)
        case "questions":
            yield from ((name, (page.effect(),)) for name, page in _pages("questions", plan.questionnaires, rates=True))
        case "debrief":
            yield stage, (do.ShowDebrief(sheet.debrief),)
        case "thanks":
            yield stage, (do.ShowThanks(), do.Speak(1, plan.catalogue.wordings("thanks-speech")[0]))


def _pairs(board: Game | Practice) -> int:
    return board.rows * board.columns // CARDS_IN_A_PAIR


@dataclass(frozen=True)
class FormPage:
    """A page of a form, and the questionnaire that it is of."""

    asked: Questionnaire
    items: tuple[Item, ...]
    number: int
    of: int
    rates: bool
    alike: tuple[tuple[Item, ...], ...]

    def effect(self, hidden: tuple[str, ...] = ()) -> Effect:
        """Return what shows it."""
        return do.ShowItems(self.items, self.number, self.of, self.rates, hidden, self.asked.title, self.alike)

    def hidden(self, given: Mapping[str, Response]) -> tuple[str, ...]:
        """Return the items that their conditions hide after these answers."""
        hidden = hidden_items(self.asked.items, given)
        return tuple(item.id for item in self.items if item.id in hidden)


def form_pages(plan: SessionConfig) -> dict[str, FormPage]:
    """Return the pages of forms among the screens of a session, by the screen's name."""
    pages: dict[str, FormPage] = {}
    if "about_you" in plan.settings.stages:
        pages |= _pages("about you", (plan.about_you,), rates=False)
    if "questions" in plan.settings.stages:
        pages |= _pages("questions", plan.questionnaires, rates=True)
    return pages


def _pages(name: str, asked: tuple[Questionnaire, ...], *, rates: bool) -> Iterator[tuple[str, FormPage]]:
    pages = [(each, page.items) for each in asked for page in item_pages(each, Random(0))]
    for number, (each, items) in enumerate(pages, 1):
        alike = pages_alike([page for _, page in pages], items)
        yield f"{name} {number}", FormPage(each, items, number, len(pages), rates, alike)
