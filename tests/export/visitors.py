"""Simulated participants of all kinds, written as the kiosk writes them, for the data set to be made from."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from random import Random
from types import MappingProxyType

from kiosk.config import ASSETS
from kiosk.experiment.condition import CONDITIONS, Condition
from kiosk.experiment.items import Answer, Integer, Multiple, Rating, Response, Single, TextPage
from kiosk.experiment.outcomes import SessionKind, Stage
from kiosk.experiment.questionnaire import Item, Questionnaire
from kiosk.experiment.session_config import SessionConfig
from kiosk.game import Position
from kiosk.store.recorder import Provenance, Recorder
from tests.experiment.driver import Driver, Voice, at_random, with_memory
from tests.experiment.view import View
from tests.samples import mixed, whole

COMMIT = "abc123"
SHIPPED = ASSETS / "questionnaires"
SCALES = Questionnaire.read(SHIPPED / "social-intelligence.toml")


def study_plan(condition: Condition = Condition.TOM, seed: int = 0) -> SessionConfig:
    """Return a plan with all stages, four scales, and items of every kind about the visitor."""
    return replace(whole(condition, mixed(seed)), questionnaires=(SCALES, *whole().questionnaires))


def visitors(count: int) -> list[tuple[Driver, int]]:
    """So many participants of all kinds: with and without a memory, a voice, patience and answers; and their seeds."""
    return [(visitor(seed), seed) for seed in range(1, count + 1)]


def visitor(seed: int, condition: Condition | None = None) -> Driver:
    """Return a participant whose ways all follow from the seed."""
    chance = Random(f"{seed}/visitor")
    condition = condition or CONDITIONS[seed % len(CONDITIONS)]
    driver = Driver(study_plan(condition, seed % 7), seed, chance.choice(list(Voice)))
    driver.to(Stage.ABOUT_YOU)
    answer_all(driver, chance)
    driver.to(Stage.PRACTICE)
    _practise(driver, chance)
    _play(driver, chance)
    if driver.stage is Stage.RESULT:
        driver.to(Stage.QUESTIONS)
        answer_all(driver, chance)
        driver.to(Stage.OVER)
    return driver


def _practise(driver: Driver, chance: Random) -> None:
    for _ in range(chance.randrange(4)):
        if driver.stage is Stage.PRACTICE:
            driver.flip(chance.choice(driver.view.closed))
    driver.wait_until_open()
    driver.spend(chance.randrange(3000))
    driver.skip()


def _play(driver: Driver, chance: Random) -> None:
    """Play with hesitation and pauses; one in ten leaves, or is ended, in the middle."""
    choose = with_memory(chance.randrange(9)) if chance.random() < 0.7 else at_random(chance.randrange(9))
    leaves_after = chance.randrange(30) if chance.random() < 0.1 else None
    flips = 0
    while driver.stage is Stage.GAME:
        driver.wait_until_open()
        if driver.stage is not Stage.GAME:
            break
        if leaves_after == flips:
            driver.end("called away")
            break
        _hesitate(driver, chance)
        driver.tap(_follow(driver.view, choose, chance))
        flips += 1


def _hesitate(driver: Driver, chance: Random) -> None:
    driver.spend(chance.randrange(200, 2500))
    if chance.random() < 0.03:
        driver.pause()
        driver.spend(chance.randrange(100, 9000))
        driver.end_pause()
        driver.spend(chance.randrange(100, 900))


def _follow(view: View, choose: Callable[[View], Position], chance: Random) -> Position:
    """Go where a hint points, most of the time."""
    own = choose(view)
    if view.mark is None or chance.random() < 0.2:
        return own
    row, column = view.mark
    return next((place for place in view.closed if row in (None, place.row) and column in (None, place.column)), own)


def answer_all(driver: Driver, chance: Random, given: Mapping[str, Answer] = MappingProxyType({})) -> None:
    """Answer page by page, with second thoughts, and skip what need not be answered now and then.

    What is ``given`` for an item is its last answer.
    """
    here = driver.stage
    while driver.stage is here:
        for item in driver.view.page.items if driver.view.page else ():
            if isinstance(item, TextPage):
                continue
            for _ in range(chance.choice((1, 1, 1, 2, 3))):
                driver.spend(chance.randrange(100, 3000))
                driver.answer(chosen(item, chance), item.id)
            if item.id in given:
                driver.answer(given[item.id], item.id)
            elif not item.required and chance.random() < 0.03:
                driver.answer(None, item.id)
        driver.go_on()


def chosen(item: Item, chance: Random) -> Answer:
    """Return an answer that an item accepts, drawn by chance."""
    if isinstance(item, Single):
        return chance.choice(item.ids)
    if isinstance(item, Multiple):
        return tuple(name for name in item.ids if chance.random() < 0.5) or item.ids[:1]
    if isinstance(item, Integer):
        return chance.randint(item.lowest, item.highest)
    if isinstance(item, Rating):
        return chance.randint(*item.ends)
    return chance.choice(('say "so"', "one, two; three", "שלום עולם", "naïve, 日本"))


def unsharing(seed: int) -> Driver:
    """Return a visitor who takes part, but does not want to be published."""
    driver = Driver(study_plan(), seed)
    driver.to(Stage.CONSENT)
    driver.tick("store")
    driver.agree()
    driver.to(Stage.OVER)
    return driver


def answered(about_you: Questionnaire, given: Iterable[tuple[str, Response]]) -> Driver:
    """Return a participant who was asked this about themselves, gave these answers in turn, and then ended."""
    driver = Driver(replace(study_plan(), about_you=about_you), 1)
    driver.to(Stage.ABOUT_YOU)
    for item, response in given:
        driver.answer(response, item)
    driver.go_on()
    driver.end()
    return driver


def store(
    folder: Path, drivers: Sequence[tuple[Driver, int]], *, kind: SessionKind = SessionKind.STUDY, site: str = ""
) -> None:
    """Write sessions that were played into a data folder, all at once each."""
    with Recorder(folder, site) as recorder:
        for driver, seed in drivers:
            recorder.begin(Provenance(driver.plan, seed, "avatar", COMMIT, kind=kind), driver.events)
