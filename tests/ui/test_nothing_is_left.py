"""Nothing of one visitor is left for the next: not in a screen's object, not in the window, not out of sight."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from random import Random

import pytest
from PySide6.QtCore import QAbstractListModel, QObject
from PySide6.QtQuick import QQuickItem

from kiosk.experiment import effects as do
from kiosk.experiment.effects import Outcome
from kiosk.experiment.events import ResponseGiven, StageEntered, WorldEvent
from kiosk.experiment.outcomes import Stage, Status
from kiosk.store.queries import open_repository
from kiosk.ui.app import App
from kiosk.ui.rehearsal import Rehearsal
from kiosk.ui.simulated_visitor import BehaviourKind, BehaviourProfile, lay_out
from tests.ui.conftest import MakeBooth
from tests.ui.headless import SMALL

KEPT_BY_AN_ITEM = (
    *("visible", "enabled", "opacity", "focus", "text", "checked", "value", "contentX", "contentY", "cursorPosition"),
    *("selectedText", "currentIndex", "source", "capitals", "byKeyboard", "position"),
)
"""Whatever of an item a visitor could leave something in."""

OF_EVERY_OBJECT = QObject().metaObject().propertyCount()
"""Properties that have nothing to do with screens."""

PLACE = ("x", "y", "width", "height")
"""The same of an item that is seen; one that is not is laid out anew before it is."""

WALKED_OUT_OF = (Stage.CONSENT, Stage.ABOUT_YOU, Stage.PRACTICE, Stage.GAME, Stage.QUESTIONS, Stage.DEBRIEF)


def of_screens(app: App) -> dict[str, object]:
    """Every Qt property of every screen, and the cards of the board."""
    found: dict[str, object] = {}
    for name, screen in app.screens.by_name.items():
        about = screen.metaObject()
        for index in range(OF_EVERY_OBJECT, about.propertyCount()):
            known = str(about.property(index).name())
            found[f"{name}.{known}"] = getattr(screen, known)
        if isinstance(screen, QAbstractListModel):
            found[f"{name}.rows"] = screen.rowCount()
    return found


def items(item: QQuickItem) -> Iterator[QQuickItem]:
    """Yield an item and all below it, seen or not; from one list, as there are thousands and they lie deep."""
    waiting = [item]
    while waiting:
        found = waiting.pop()
        yield found
        waiting.extend(reversed(found.childItems()))


def of_window(app: App) -> list[dict[str, str]]:
    """Return what every item of the window looks like, in their order."""
    lay_out(app.window)
    return [
        {"kind": re.sub(r"_QML.*", "", item.metaObject().className()), "name": item.objectName()}
        | {
            key: str(item.property(key)).replace("-0.0", "0.0")
            for key in (*KEPT_BY_AN_ITEM, *(PLACE if item.isVisible() else ()))
        }
        for item in items(app.window.contentItem())
    ]


def texts(app: App) -> str:
    """Every text in the window, seen or not."""
    return "\n".join(str(item.property("text") or "") for item in items(app.window.contentItem()))


@dataclass
class Memory:
    """What a visitor has said, typed or been told."""

    sentences: set[str] = field(default_factory=set)
    typed: set[str] = field(default_factory=set)
    codes: set[str] = field(default_factory=set)

    def note(self, app: App, event: WorldEvent, outcome: Outcome) -> None:
        """Keep what comes of an event."""
        self.sentences |= {command.sentence for command in outcome.effects if isinstance(command, do.Speak)}
        if isinstance(event, ResponseGiven) and event.item == "remark" and isinstance(event.value, str):
            self.typed.add(event.value)
        if app.screens.debrief.property("code"):
            self.codes.add(str(app.screens.debrief.property("code")))

    def all(self) -> set[str]:
        """All of it."""
        return self.sentences | self.typed | self.codes


class Watched(Rehearsal):
    """A session in which every stage is searched for what the last visitor left, as soon as it is entered."""

    def __init__(self, app: App, seed: int, visitor: BehaviourProfile, last: Memory) -> None:
        super().__init__(app, seed, visitor=visitor)
        self.own = Memory()
        self.left: list[tuple[str, str]] = []
        self._last = last
        self._go_on_watching = app.runner.on_event
        app.runner.on_event = self._search

    def _search(self, event: WorldEvent, outcome: Outcome, stage: Stage) -> None:
        self.own.note(self._app, event, outcome)
        if any(isinstance(concluded, StageEntered) for concluded in outcome.events):
            others = self._last.all() - self.own.all()
            shown = texts(self._app) if others else ""
            self.left += [(stage.value, text) for text in others if text in shown]
        assert self._go_on_watching is not None
        self._go_on_watching(event, outcome, stage)


def visitors(seed: int) -> Iterator[BehaviourProfile]:
    """Yield some visitors of every kind, in any order and language."""
    chance = Random(seed)
    manners = list(BehaviourKind)
    chance.shuffle(manners)
    for manner in manners:
        yield BehaviourProfile(manner, chance.choice(WALKED_OUT_OF), chance.choice(["en", "it", "es"]))


def differences(before: list[dict[str, str]], after: list[dict[str, str]]) -> list[object]:
    """Where two pictures of the window differ."""
    if len(before) != len(after):
        return [f"{len(before)} items were there, now {len(after)}"]
    return [(one, dict(other.items() - one.items())) for one, other in zip(before, after, strict=True) if one != other]


@pytest.mark.parametrize("seed", [1, 2])
def test_after_any_session_even_of_one_who_taps_everywhere_the_kiosk_is_as_it_was_before_the_first(
    make_booth: MakeBooth, seed: int
) -> None:
    booth = make_booth(settings=SMALL)
    booth.settle()
    booth.prepare_pages()
    screens, window = of_screens(booth.app), of_window(booth.app)
    last, completed = Memory(), 0
    for number, visitor in enumerate(visitors(seed)):
        session = Watched(booth.app, 100 * seed + number, visitor, last)
        session.run()
        booth.settle()
        assert session.left == [], visitor
        assert of_screens(booth.app) == screens, visitor
        assert differences(window, of_window(booth.app)) == [], visitor
        shown = texts(booth.app)
        assert not any(text in shown for text in session.own.all()), visitor
        # Also one who clicks twice and taps everywhere comes to the end.
        if visitor.manner in {BehaviourKind.COMPLETES, BehaviourKind.HASTY}:
            completed += 1
            with open_repository(booth.data) as stored:
                assert [each.status for each in stored.sessions()].count(Status.COMPLETED) == completed
        # One who does all there is to do leaves something of every kind that is searched for.
        if visitor.manner is BehaviourKind.COMPLETES:
            assert session.own.codes
            assert session.own.typed
            assert session.own.sentences
        last = session.own


def test_the_search_for_what_is_left_finds_something(make_booth: MakeBooth) -> None:
    booth = make_booth(settings=SMALL)
    booth.settle()
    screens, window = of_screens(booth.app), of_window(booth.app)
    booth.app.screens.avatar.say("a sentence that was forgotten")
    assert "a sentence that was forgotten" in texts(booth.app)
    assert of_screens(booth.app) != screens
    assert differences(window, of_window(booth.app)) != []
