"""What moves by itself: one thing at a time, nothing that is heard, and nothing that stays when a visitor comes."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from random import Random

import pytest
from PySide6.QtCore import QObject
from pytestqt.qtbot import QtBot

from kiosk.ui.event_loop import VirtualClock
from kiosk.ui.screens.attract import AttractScreen, IdleLife
from kiosk.ui.screens.avatar import AvatarScreen
from kiosk.ui.screens.shell import KioskScreen
from kiosk.ui.window import ClockMode, RunMode, WindowMode
from tests.samples import CATALOGUES
from tests.ui.headless import headless, short

MANY = 2_000


class Stage:
    """A screen without a player, with its life, and who moved when."""

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
            "card": (self.attract.property("up"), self.attract.property("found")),
            "mood": self.avatar.property("mood"),
            "lids": self.avatar.property("blinking"),
            "eyes": (self.avatar.property("gazeX"), self.avatar.property("gazeY")),
            "bubble": self.avatar.property("bubble"),
            "title": self.attract.property("title"),
        }

    def seen(self, jumps: int = MANY) -> list[set[str]]:
        """Return what moved at each moment at which something did."""
        found = []
        for _ in range(jumps):
            before = self.moving
            self.clock.jump()
            found.append({name for name, value in self.moving.items() if value != before[name]})
        return [moved for moved in found if moved]


@pytest.fixture
def stage(qapp: object) -> Stage:
    """Return a screen without a game."""
    assert qapp is not None
    return Stage()


def test_at_most_one_thing_moves_at_a_time(stage: Stage) -> None:
    seen = stage.seen()
    # The title and the bubble change their language together.
    assert {frozenset(moved) for moved in seen} == {
        *(frozenset({thing}) for thing in ("card", "mood", "lids", "eyes", "bubble")),
        frozenset({"title", "bubble"}),
    }


def test_a_game_plays_itself_until_every_pair_is_found_and_then_another_one(stage: Stage) -> None:
    attract, games, pairs = stage.attract, [], 0
    attract.dealt.connect(lambda: games.append(attract.cards))
    while len(games) < 4:
        stage.clock.jump()
        up, found = (attract.property(name) for name in ("up", "found"))
        assert set(found) <= set(up)
        assert len(set(up) - set(found)) <= 2
        assert len({attract.cards[place] for place in found}) == len(found) / 2
        if len(found) == len(attract.cards):
            pairs += 1
    assert pairs
    assert len({*games}) > 1
    assert all(sorted(game) == sorted(games[0]) for game in games)


def test_a_pair_is_found_within_twenty_seconds_as_a_rule(stage: Stage) -> None:
    times, last = [], 0
    for _ in range(MANY):
        stage.clock.jump()
        if len(stage.attract.property("found")) > last:
            times.append(stage.clock.now_ms())
        last = len(stage.attract.property("found"))
    gaps = sorted(later - earlier for earlier, later in pairwise(times))
    assert gaps[len(gaps) // 2] < 20_000


def test_the_helper_is_glad_at_a_pair_thoughtful_at_a_miss_and_looks_at_every_card(stage: Stage) -> None:
    turned: list[int] = []
    moods = set()
    stage.attract.turned.connect(turned.append)
    for _ in range(200):
        stage.clock.jump()
        if stage.avatar.property("mood") != "idle":
            two = {stage.attract.cards[place] for place in turned[-2:]}
            moods.add((stage.avatar.property("mood"), len(two)))
    assert moods == {("happy", 1), ("thinking", 2)}


def test_the_bubble_greets_in_every_language_and_nothing_is_heard(stage: Stage) -> None:
    greeted = set()
    for _ in range(MANY):
        stage.clock.jump()
        bubble = stage.avatar.property("bubble")
        greeted |= {code for code, each in CATALOGUES.items() if bubble in each.wordings("attract-greeting")}
        assert not bubble or bubble in stage.attract.greetings
    assert greeted == set(CATALOGUES)
    assert stage.avatar.property("mouth") == 0


@pytest.mark.parametrize("moments", range(0, 40, 3))
def test_whenever_somebody_comes_and_goes_the_game_goes_on(stage: Stage, moments: int) -> None:
    for _ in range(moments):
        stage.clock.jump()
    stage.kiosk.show("about")
    stage.seen(5)
    stage.attract.clear()
    stage.avatar.clear()
    stage.kiosk.show("attract")
    assert {"card", "bubble"} <= set().union(*stage.seen(20))


def test_a_session_that_timed_out_leaves_a_start_screen_that_plays_and_can_be_started(
    qapp: object, qtbot: QtBot, tmp_path: Path
) -> None:
    assert qapp is not None
    fast = RunMode(WindowMode.NOWHERE, ClockMode.WALL, speed=60)
    with headless(short(voice={"enabled": False}), tmp_path, mode=fast) as app:
        kiosk, attract = app.screens.kiosk, app.screens.attract
        for _ in range(2):
            app.runner.start("en")
            qtbot.waitUntil(lambda: kiosk.shown != "attract")
            qtbot.waitUntil(lambda: kiosk.shown == "attract" and kiosk.takes_input, timeout=20_000)
            with qtbot.waitSignal(attract.turned):
                pass


def test_a_greeting_goes_when_somebody_comes_and_none_is_shown_while_they_play(stage: Stage) -> None:
    while not stage.avatar.property("bubble"):
        stage.clock.jump()
    stage.kiosk.show("introduction")
    assert stage.avatar.property("bubble") == ""
    assert set().union(*stage.seen(300)) == {"lids", "eyes"}


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
