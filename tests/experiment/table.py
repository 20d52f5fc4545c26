"""A game that has just begun, and what a visitor may do on purpose who knows where every card lies."""

from __future__ import annotations

from typing import Any

from kiosk.assistance.policy import ActionSpec
from kiosk.config import Timing
from kiosk.experiment import events as happened
from kiosk.game import Position
from tests.experiment.driver import Driver, Voice
from tests.samples import always, plan


def playing(
    action: ActionSpec = ActionSpec.NO_HELP, voice: Voice = Voice.SPEAKS, seed: int = 1, **timing: Any
) -> Driver:
    """Return a game that has just begun, in which the assistant always does the same."""
    driver = Driver(plan(policy=always(action), timing=Timing(**timing)), seed, voice)
    driver.to_the_game()
    return driver


def a_pair(driver: Driver) -> tuple[Position, Position]:
    """Two cards alike that are still closed."""
    dealt = driver.noted(happened.BoardDealt)[-1]
    closed = driver.view.closed
    cards = dict(
        zip((Position(r, c) for r in range(dealt.rows) for c in range(dealt.columns)), dealt.cards, strict=True)
    )
    return closed[0], next(place for place in closed[1:] if cards[place] == cards[closed[0]])


def another(driver: Driver, *not_these: Position) -> Position:
    """Return a closed card that is none of these."""
    return next(place for place in driver.view.closed if place not in not_these)


def miss(driver: Driver) -> tuple[Position, Position]:
    """Flip two different cards."""
    driver.wait_until_open()
    first, mate = a_pair(driver)
    driver.flip(first)
    second = another(driver, mate)
    driver.flip(second)
    return first, second


def seen(driver: Driver, *what: str) -> tuple[object, ...]:
    """Return what the view shows under these names."""
    return tuple(getattr(driver.view, name) for name in what)
