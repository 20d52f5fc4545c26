"""What moves by itself: one thing at a time, nothing that is heard, and nothing that stays when somebody comes."""

from __future__ import annotations

from itertools import pairwise
from random import Random

import pytest
from PySide6.QtCore import QObject

from kiosk.ui.event_loop import VirtualClock
from kiosk.ui.screens.avatar import AvatarScreen, IdleLife
from kiosk.ui.screens.shell import AttractScreen, KioskScreen
from tests.samples import CATALOGUES

MANY = 2_000


class Stage:
    """A screen that nobody plays on, with its life, and who moved when."""

    def __init__(self, seed: int = 1) -> None:
        self.owner = QObject()
        self.clock = VirtualClock()
        catalogues = list(CATALOGUES.values())
        self.kiosk = KioskScreen(catalogues[0], self.owner)
        self.avatar = AvatarScreen(self.owner)
        self.attract = AttractScreen(("a", "b", "c"), catalogues, self.owner)
        self.life = IdleLife(self.kiosk, self.avatar, self.attract, self.clock, Random(seed))

    @property
    def moving(self) -> dict[str, object]:
        """Everything that can move, and how it stands."""
        return {
            "card": self.attract.property("shown"),
            "lids": self.avatar.property("blinking"),
            "eyes": (self.avatar.property("gazeX"), self.avatar.property("gazeY")),
            "bubble": self.avatar.property("bubble"),
            "title": self.attract.property("title"),
        }

    def seen(self, jumps: int = MANY) -> list[set[str]]:
        """What moved at each moment at which something did."""
        found = []
        for _ in range(jumps):
            before = self.moving
            self.clock.jump()
            found.append({name for name, value in self.moving.items() if value != before[name]})
        return [moved for moved in found if moved]


@pytest.fixture
def stage(qapp: object) -> Stage:
    """A screen that nobody plays on."""
    assert qapp is not None
    return Stage()


def test_at_most_one_thing_moves_at_a_time(stage: Stage) -> None:
    seen = stage.seen()
    assert all(len(moved) == 1 for moved in seen)
    assert set().union(*seen) == {"card", "lids", "eyes", "bubble", "title"}


def test_at_most_one_card_is_up_and_one_after_another_is(stage: Stage) -> None:
    shown = []
    for _ in range(MANY):
        stage.clock.jump()
        shown.append(stage.attract.property("shown"))
    turns = [one for before, one in pairwise(shown) if one != before]
    assert {-1, 0, 1, 2} == set(turns)
    assert all((one == -1) != (other == -1) for one, other in pairwise(turns))


def test_greetings_are_rare_and_never_heard(stage: Stage) -> None:
    seen = stage.seen()
    greetings = sum(moved == {"bubble"} for moved in seen) / 2
    minutes = stage.clock.now_ms() / 60_000
    assert 0.2 < greetings / minutes < 3
    assert stage.avatar.property("mouth") == 0


def test_a_greeting_goes_when_somebody_comes_and_none_is_shown_while_they_play(stage: Stage) -> None:
    while not stage.avatar.property("bubble"):
        stage.clock.jump()
    stage.kiosk.show("introduction")
    assert stage.avatar.property("bubble") == ""
    assert set().union(*stage.seen()) == {"lids", "eyes"}


def test_what_is_said_to_a_visitor_is_not_taken_for_a_greeting(stage: Stage) -> None:
    while not stage.avatar.property("bubble"):
        stage.clock.jump()
    stage.avatar.say("Two cards at a time.")
    stage.kiosk.show("introduction")
    stage.seen(50)
    assert stage.avatar.property("bubble") == "Two cards at a time."


@pytest.mark.parametrize("language", CATALOGUES)
def test_every_language_greets(language: str) -> None:
    assert len(CATALOGUES[language].wordings("attract-greeting")) > 1
