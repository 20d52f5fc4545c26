"""Every screen in every language, and in one that is 40 % longer and runs the other way: no text is cut off."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations
from pathlib import Path

import pytest
from PySide6.QtCore import QRectF
from PySide6.QtQuick import QQuickItem
from pytestqt.qtbot import QtBot

from kiosk.assistant.hint import Reason
from kiosk.assistant.mdp import Card
from kiosk.assistant.wording import Catalogue
from kiosk.cli.wiring import make_plan
from kiosk.settings import ASSETS, Settings
from kiosk.store.recorder import Provenance, Recorder
from kiosk.study.commands import Wait
from kiosk.ui.app import App
from kiosk.ui.rehearsing.rehearsal import lay_out
from kiosk.ui.window import Display, Mode, Pace
from tests import pseudo

SIZES = [(1280, 720), (1920, 1080), (1080, 1920)]
SCREENS = ("attract", "introduction", "game", "result", "questions", "pause")
HALF_A_PIXEL = 0.5
"""Sizes are rounded when texts are measured."""


@pytest.fixture(params=["en", "es", "it", pseudo.LANGUAGE])
def catalogue(request: pytest.FixtureRequest, tmp_path: Path) -> Catalogue:
    """A language's catalogue."""
    if request.param == pseudo.LANGUAGE:
        return Catalogue(pseudo.write(tmp_path))
    return Catalogue(ASSETS / "sentences" / request.param)


@pytest.fixture(params=[1.0, 1.3])
def app(request: pytest.FixtureRequest, catalogue: Catalogue, tmp_path: Path, qtbot: QtBot) -> Iterator[App]:
    """A kiosk in that language, with its texts as large as they are usually, and as large as they can be."""
    if catalogue.language == pseudo.LANGUAGE and request.param > 1:
        pytest.skip("a language that is 40 % longer is test enough at its usual size")
    settings = Settings.model_validate({"screen": {"text_size": request.param}})
    plan = replace(make_plan(settings), catalogue=catalogue)
    provenance = Provenance(plan, 1, "avatar", "a test", simulated=True)
    mode = Mode(Display.NOWHERE, Pace.VIRTUAL)
    with Recorder(tmp_path / "data") as recorder, App(plan, mode, recorder, lambda: provenance) as app:
        qtbot.waitUntil(app.window.isExposed)
        yield app


def longest_hint(catalogue: Catalogue) -> str:
    """The longest that the assistant ever says with a hint."""
    card = catalogue.card("hedgehog")
    reasons = [
        wording
        for which in Card
        for reason in Reason
        if (message := f"reason-{which.value}-{reason.value}") in catalogue
        for wording in catalogue.wordings(message, **card)
    ]
    places = catalogue.wordings("point-second-card", row=4, column=6)
    return f"{max(reasons, key=len)} {max(places, key=len)}"


def texts(item: QQuickItem) -> Iterator[QQuickItem]:
    """Every visible text below an item."""
    if not item.isVisible():
        return
    if item.metaObject().className() == "QQuickText" and item.property("text"):
        yield item
    for child in item.childItems():
        yield from texts(child)


def painted(text: QQuickItem) -> QRectF:
    """Where a text's letters are in the window."""
    width, height = float(text.property("contentWidth")), float(text.property("contentHeight"))
    place = text.mapRectToScene(text.boundingRect())
    return QRectF(place.center().x() - width / 2, place.center().y() - height / 2, width, height)


def fill(app: App, catalogue: Catalogue) -> None:
    """Give every screen as much to show as it can ever have."""
    screens = app.screens
    screens.board.deal(4, 6, 12)
    screens.board.show_progress(12, 188)
    screens.board.hold(Wait.TURNING_BACK)
    screens.result.show(12, 188, 59 * 60_000 + 59_000)
    screens.question.ask("closing", "understood", 5, 3, 3)
    screens.avatar.say(longest_hint(catalogue))


@pytest.mark.parametrize(("width", "height"), SIZES)
def test_no_text_is_cut_off_or_covers_another(
    app: App, catalogue: Catalogue, qtbot: QtBot, width: int, height: int
) -> None:
    window = app.window
    window.resize(width, height)
    qtbot.waitUntil(lambda: window.contentItem().width() == width)
    fill(app, catalogue)
    for screen in SCREENS:
        app.screens.kiosk.show(screen)
        lay_out(window)
        places = [(text, painted(text)) for text in texts(window.contentItem())]
        assert places, screen
        for text, place in places:
            words = (screen, text.property("text"), place)
            assert not text.property("truncated"), words
            assert place.left() >= -HALF_A_PIXEL, words
            assert place.top() >= -HALF_A_PIXEL, words
            assert place.right() <= width + HALF_A_PIXEL, words
            assert place.bottom() <= height + HALF_A_PIXEL, words
        if screen == "pause":
            # It lies over everything by intent.
            continue
        for (one, there), (other, here) in combinations(places, 2):
            assert not there.intersects(here), (screen, one.property("text"), other.property("text"))


def test_the_introduction_is_never_longer_than_its_bubble(app: App, catalogue: Catalogue) -> None:
    sentences = catalogue.wordings("introduction-speech")
    app.screens.avatar.say(max(sentences, key=len))
    app.screens.kiosk.show("introduction")
    lay_out(app.window)
    assert all(painted(text).top() >= 0 for text in texts(app.window.contentItem()))
